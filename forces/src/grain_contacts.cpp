// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <utility>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/grain_contacts.hpp>

#include "base/describe.hpp"
#include "same_count.hpp"
#include "simd/contact_kernels.hpp"

namespace dch {
namespace {

void require_one_for_each_pair(std::size_t pairs, std::size_t found, const char* what) {
  if (found == pairs) return;
  throw InvalidParameter(std::to_string(found) + " " + what + " given for " + std::to_string(pairs) +
                         " pairs; give one for each pair");
}

}  // namespace

GrainContacts::GrainContacts(const ContactParams& params) : params_(params) {
  for (const auto& [name, value] :
       {std::pair{"stiffness", params.stiffness}, std::pair{"shear_stiffness", params.shear_stiffness},
        std::pair{"damping", params.damping}, std::pair{"shear_damping", params.shear_damping},
        std::pair{"friction", params.friction}})
    if (!(std::isfinite(value) && value >= 0))
      throw InvalidParameter(std::string("contacts of grains: ") + name + " is " + detail::describe(value) +
                             "; it must be finite and at least 0");
}

void GrainContacts::add_forces(const Grains& grains, const ListedContacts& pairs, double timestep,
                               std::vector<GrainContact>* found) const {
  const std::size_t count = grains.positions.size();
  detail::require_same_count(count, "positions", grains.velocities.size(), "velocities");
  detail::require_same_count(count, "positions", grains.spins.size(), "spins");
  detail::require_same_count(count, "positions", grains.bodies.size(), "bodies");
  detail::require_same_count(count, "positions", grains.forces.size(), "forces");
  detail::require_same_count(count, "positions", grains.torques.size(), "torques");
  const bool keeps_history = params_.form != ContactForm::hooke;
  require_one_for_each_pair(pairs.i.size(), pairs.j.size(), "second grains");
  if (keeps_history) {
    require_one_for_each_pair(pairs.i.size(), pairs.touching.size(), "marks of touching pairs");
    require_one_for_each_pair(pairs.i.size(), pairs.slips.size(), "slips");
  }
  if (pairs.i.empty()) return;
  const bool advances = timestep >= 0;
  const detail::ContactTask task{grains.positions.data(),
                                 grains.velocities.data(),
                                 grains.spins.data(),
                                 grains.bodies.data(),
                                 grains.forces.data(),
                                 grains.torques.data(),
                                 static_cast<std::int32_t>(grains.owned),
                                 pairs.i.data(),
                                 pairs.j.data(),
                                 static_cast<std::int64_t>(pairs.i.size()),
                                 keeps_history ? pairs.touching.data() : nullptr,
                                 keeps_history ? pairs.slips.data() : nullptr,
                                 params_,
                                 advances ? timestep : 0.0,
                                 advances,
                                 found};
  const detail::ContactKernels& kernels = detail::contact_kernels(instruction_set());
  switch (params_.form) {
    case ContactForm::hooke:
      return kernels.hooke(task);
    case ContactForm::hooke_history:
      return kernels.hooke_history(task);
    case ContactForm::hertz_history:
      return kernels.hertz_history(task);
  }
}

}  // namespace dch
