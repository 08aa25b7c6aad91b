// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/angles.hpp>

#include "base/describe.hpp"
#include "same_count.hpp"
#include "simd/force_kernels.hpp"

namespace dch {
namespace {

void require_finite_of_angle(const char* form, std::size_t type, const char* name, double value) {
  if (!std::isfinite(value))
    throw InvalidParameter(std::string(form) + " angle type " + std::to_string(type) + ": " + name + " is " +
                           detail::describe(value) + "; it must be finite");
}

}  // namespace

AngleForces::AngleForces(const std::vector<HarmonicAngle>& types) : is_harmonic_(true) {
  for (std::size_t type = 0; type < types.size(); ++type) {
    const HarmonicAngle& angle = types[type];
    require_finite_of_angle("harmonic", type, "k", angle.k);
    require_finite_of_angle("harmonic", type, "theta0", angle.theta0);
    tables_[0].push_back(2 * angle.k);
    tables_[1].push_back(angle.theta0);
  }
}

AngleForces::AngleForces(const std::vector<CosineAngle>& types) : is_harmonic_(false) {
  for (std::size_t type = 0; type < types.size(); ++type) {
    require_finite_of_angle("cosine", type, "k", types[type].k);
    tables_[0].push_back(types[type].k);
  }
}

void AngleForces::add_forces(Span<const AngleOfType> angles, int first_type, Span<const Vec3> positions,
                             Span<Vec3> forces, std::array<double, 6>* virial) const {
  detail::require_same_count(positions.size(), "positions", forces.size(), "forces");
  if (angles.empty()) return;
  const detail::AngleTask task{angles.data(),
                               static_cast<std::int64_t>(angles.size()),
                               first_type,
                               static_cast<std::int32_t>(tables_[0].size()),
                               {tables_[0].data(), tables_[1].data()},
                               positions.data(),
                               forces.data(),
                               virial ? virial->data() : nullptr};
  const detail::AngleKernels& kernels = detail::force_kernels(instruction_set()).angles;
  (is_harmonic_ ? kernels.harmonic : kernels.cosine)(task);
}

}  // namespace dch
