// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <dch/base/error.hpp>
#include <dch/base/instruction_set.hpp>
#include <dch/forces/dissipative_pairs.hpp>

#include "base/describe.hpp"
#include "simd/force_kernels.hpp"

namespace dch {
namespace {

void check_dissipative(const DissipativePair& pair, const std::string& where) {
  const auto refuse = [&](const char* what, double value, const char* limit) {
    throw InvalidParameter("dissipative pairs of types " + where + ": the " + what + " is " +
                           detail::describe(value) + "; it must be " + limit);
  };
  if (!std::isfinite(pair.repulsion)) refuse("repulsion", pair.repulsion, "finite");
  if (!(pair.friction >= 0) || !std::isfinite(pair.friction))
    refuse("friction", pair.friction, "finite and 0 or more");
  if (!(pair.cutoff >= 0) || !std::isfinite(pair.cutoff))
    refuse("cutoff", pair.cutoff, "finite and 0 or more");
}

bool same(const DissipativePair& a, const DissipativePair& b) {
  return a.repulsion == b.repulsion && a.friction == b.friction && a.cutoff == b.cutoff;
}

}  // namespace

DissipativePairs::DissipativePairs(const DissipativeParams& params)
    : types_(params.types), seed_(params.seed) {
  const auto n = static_cast<std::size_t>(std::max(params.types, 0));
  if (n == 0 || params.pairs.size() != n * n)
    throw InvalidParameter(std::to_string(params.pairs.size()) + " dissipative pairs given for " +
                           std::to_string(params.types) + " types; give one for each two types, " +
                           std::to_string(n * n));
  for (std::size_t kind = 0; kind < 4; ++kind)
    if (!(params.weight[kind] >= 0 && params.weight[kind] <= 1) || (kind == 0 && params.weight[kind] != 1))
      throw InvalidParameter("the weight of dissipative pairs of kind " + std::to_string(kind) + " is " +
                             detail::describe(params.weight[kind]) +
                             (kind == 0 ? "; it must be 1" : "; it must be from 0 to 1"));
  for (const double weight : params.weight)
    for (std::size_t k = 0; k < n * n; ++k) {
      const DissipativePair& pair = params.pairs[k];
      const std::string where = std::to_string(k / n) + " and " + std::to_string(k % n);
      check_dissipative(pair, where);
      if (!same(pair, params.pairs[k % n * n + k / n]))
        throw InvalidParameter("dissipative pairs of types " + where + " differ from those of types " +
                               std::to_string(k % n) + " and " + std::to_string(k / n) +
                               "; give both the same numbers");
      table_[0].push_back(weight * pair.repulsion);
      table_[1].push_back(weight * pair.friction);
      table_[2].push_back(std::sqrt(24 * weight * pair.friction));  // 2, and 12 by the variance of the noise
      table_[3].push_back(pair.cutoff > 0 ? 1 / pair.cutoff : 1e300);
      table_[4].push_back(0.5 * weight * pair.repulsion * pair.cutoff);
    }
}

void DissipativePairs::compute(const DissipativeStep& step, DissipativeBatch& batch) const {
  const double noise = std::sqrt(step.thermal_energy / step.duration);
  if (!(step.thermal_energy >= 0 && step.duration > 0 && std::isfinite(noise)))
    throw InvalidParameter("dissipative pairs: the thermal energy is " +
                           detail::describe(step.thermal_energy) + " and the time step " +
                           detail::describe(step.duration) + "; both must be finite, 0 or more and above 0");
  if (batch.count < 0 || batch.count > DissipativeBatch::kSize)
    throw InvalidParameter("a batch of dissipative pairs has " + std::to_string(batch.count) +
                           " of them; it may have 0 to " + std::to_string(DissipativeBatch::kSize));
  detail::DissipativeTask task{seed_, static_cast<std::uint64_t>(step.number), noise, types_ * types_, {}};
  for (std::size_t k = 0; k < table_.size(); ++k) task.table[k] = table_[k].data();
  detail::force_kernels(instruction_set()).dissipative.compute(task, batch);
}

}  // namespace dch
