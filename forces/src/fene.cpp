// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/fene.hpp>

#include "base/describe.hpp"
#include "simd/force_kernels.hpp"

namespace dch {

FeneForces::FeneForces(const std::vector<FeneBond>& types) {
  for (std::size_t type = 0; type < types.size(); ++type) {
    const FeneBond& bond = types[type];
    const auto require = [&](bool good, const char* name, double value, const char* limit) {
      if (good && std::isfinite(value)) return;
      throw InvalidParameter("FENE bond type " + std::to_string(type) + ": " + name + " is " +
                             detail::describe(value) + "; it must be " + limit);
    };
    require(true, "k", bond.k, "finite");
    require(bond.r0 > 0, "r0", bond.r0, "finite and > 0");
    require(true, "epsilon", bond.epsilon, "finite");
    require(bond.sigma >= 0, "sigma", bond.sigma, "finite and not negative");
    const double of_type[] = {bond.k, 1 / (bond.r0 * bond.r0), bond.sigma * bond.sigma, 48 * bond.epsilon};
    for (std::size_t k = 0; k < tables_.size(); ++k) tables_[k].push_back(of_type[k]);
  }
}

void FeneForces::add_forces(Span<const BondOfType> bonds, int first_type, Span<const Vec3> positions,
                            Span<Vec3> forces, std::vector<std::int32_t>& too_long,
                            std::array<double, 6>* virial) const {
  if (positions.size() != forces.size())
    throw InvalidParameter("room for " + std::to_string(forces.size()) + " forces given for " +
                           std::to_string(positions.size()) + " particles; give one each");
  too_long.clear();
  if (bonds.empty()) return;
  too_long.resize(bonds.size());
  const detail::BondTask task{bonds.data(),
                              static_cast<std::int64_t>(bonds.size()),
                              first_type,
                              static_cast<std::int32_t>(tables_[0].size()),
                              {tables_[0].data(), tables_[1].data(), tables_[2].data(), tables_[3].data()},
                              positions.data(),
                              forces.data(),
                              virial ? virial->data() : nullptr};
  too_long.resize(
      static_cast<std::size_t>(detail::force_kernels(instruction_set()).bonds.fene(task, too_long.data())));
}

}  // namespace dch
