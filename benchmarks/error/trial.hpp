// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <dch/forces/lennard_jones.hpp>

#include "melt.hpp"

namespace dch::bench {

/// One way to run the melt.
struct Trial {
  std::string rule = "certified";  ///< of make_rebuild_rule()
  double skin = 0.3;               ///< [length]
  ForcePrecision precision = ForcePrecision::double_precision;
};

struct TrialLength {
  int steps = 1000;
  int check_every = 5;       ///< steps
  double time_step = 0.005;  ///< [time]
};

/// What a run of the melt was worth.
struct TrialErrors {
  int checks = 0;
  std::int64_t pairs = 0;   ///< within the cutoff, summed up over the checks
  std::int64_t missed = 0;  ///< of them: not in the masks of the cluster pairs, which forces come from
  std::int64_t missed_by_list = 0;  ///< of them: not in the list of the pairs within cutoff + skin, made when
                                    ///< the cluster pairs were
  double force_error = 0;           ///< root mean square over the checks of the relative error
  double largest_force_error = 0;   ///< at one check
  double energy_drift = 0;          ///< slope of the total energy by least squares [energy / atom / time]
  double energy_noise = 0;          ///< root mean square deviation from that line [energy / atom]
  std::int64_t rebuilds = 0;        ///< after the first list
};

/// Runs the trial from `start` by velocity Verlet and compares with truth_of() every `check_every` steps.
TrialErrors errors_of(const Melt& start, const Trial& trial, const TrialLength& length);

/// Processor time of the same run without comparisons [ns / atom / step].
double time_of(const Melt& start, const Trial& trial, const TrialLength& length);

/// The melt after `steps` steps of the certified rule: what trials start from.
Melt melted(Melt crystal, int steps, double time_step);

}  // namespace dch::bench
