// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/harmonic_bonds.hpp>

#include "base/describe.hpp"
#include "same_count.hpp"
#include "simd/force_kernels.hpp"

namespace dch {

HarmonicForces::HarmonicForces(const std::vector<HarmonicBond>& types) {
  for (std::size_t type = 0; type < types.size(); ++type) {
    const HarmonicBond& bond = types[type];
    for (const auto& [name, value] : {std::pair{"k", bond.k}, std::pair{"r0", bond.r0}})
      if (!std::isfinite(value))
        throw InvalidParameter("harmonic bond type " + std::to_string(type) + ": " + name + " is " +
                               detail::describe(value) + "; it must be finite");
    tables_[0].push_back(2 * bond.k);
    tables_[1].push_back(bond.r0);
  }
}

void HarmonicForces::add_forces(Span<const BondOfType> bonds, int first_type, Span<const Vec3> positions,
                                Span<Vec3> forces, std::array<double, 6>* virial) const {
  detail::require_same_count(positions.size(), "positions", forces.size(), "forces");
  if (bonds.empty()) return;
  const detail::BondTask task{bonds.data(),
                              static_cast<std::int64_t>(bonds.size()),
                              first_type,
                              static_cast<std::int32_t>(tables_[0].size()),
                              {tables_[0].data(), tables_[1].data(), nullptr, nullptr},
                              positions.data(),
                              forces.data(),
                              virial ? virial->data() : nullptr};
  detail::force_kernels(instruction_set()).bonds.harmonic(task, nullptr);
}

}  // namespace dch
