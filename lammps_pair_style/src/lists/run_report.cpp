// SPDX-License-Identifier: GPL-2.0-or-later
#include "run_report.h"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace dch::lammps {
namespace {

std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string line(const char* format, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, format);
  // NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): va_start has just initialized it
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return std::string(text) + "\n";
}

double per(double amount, std::int64_t count) {
  return count > 0 ? amount / static_cast<double>(count) : 0.0;
}

std::string settings(const RunReport& r) {
  std::string text = std::string("DCH neighbor lists: ") + (r.enabled ? "on" : "off");
  if (r.verify_every == 1) text += ", verified at every build";
  if (r.verify_every > 1) text += ", verified at every " + std::to_string(r.verify_every) + "th build";
  return text + "\n";
}

std::string list_table(const RunReport& r) {
  std::string text;
  for (const ListNote& note : r.lists) {
    text += "  " + (note.number > 0 ? "list " + std::to_string(note.number) + ", " : "") + note.name + ": " +
            (note.reason.empty() ? "DCH" : "native, " + note.reason) + "\n";
  }
  return text.empty() ? "  no lists: they are assigned when a run begins\n" : text;
}

/// Each process chooses for its own atoms.
std::string engine_line(const RunReport& r) {
  std::string text = "  engine                  " + r.engine;
  if (!r.choice.empty()) text += (r.processes > 1 ? ", on process 0 " : ", ") + r.choice;
  if (!r.choice.empty() && r.processes > 1)
    text += "; " + std::to_string(r.processes_on_grid) + " of " + std::to_string(r.processes) +
            " processes on the grid";
  return text + "\n";
}

/// Why lists were given up, in the order of ExpiryVerdict from the second one on.
constexpr std::array<const char*, kExpiryVerdicts - 1> kReasons{
    "for what cannot be told", "for an atom that moved more than the skin", "for many fast atoms",
    "for an atom near the last ghosts", "for a missing pair"};

std::string expiry_lines(const RunReport& r) {
  if (!r.expiry_obstacle.empty())
    return "  expiry                  half the skin: " + r.expiry_obstacle + "\n";
  const auto& verdicts = r.counters.verdicts;
  std::string text = line(
      "  expiry                  exact: about %.3g builds saved; lists kept beyond half the skin at %lld "
      "steps, %.3g "
      "ms each",
      r.counters.builds_saved, static_cast<long long>(verdicts[0]),
      per(1e3 * r.counters.expiry_seconds, verdicts[0]));
  std::string reasons;
  for (std::size_t k = 1; k < verdicts.size(); ++k)
    if (verdicts[k] > 0)
      reasons += (reasons.empty() ? "" : ", ") + std::to_string(verdicts[k]) + " " + kReasons[k - 1];
  return reasons.empty() ? text : text + "                          given up " + reasons + "\n";
}

std::string points_of(const RunReport& r) {
  if (r.in_box) return "the atoms in the box";
  std::string text = "owned atoms and ghosts in open space";
  if (r.leaves_ghosts_to_others) text += ", but for ghosts whose pairs others take";
  if (r.leaves_far_ghosts)
    text += std::string(r.leaves_ghosts_to_others ? " and" : ", but for") + " those too far for their types";
  return text;
}

std::string work_table(const RunReport& r) {
  const RunCounters& n = r.counters;
  std::string text;
  text += line("  builds in the last run  %lld", static_cast<long long>(n.builds));
  text += engine_line(r);
  text += line(
      "  structure               radius %g, %d levels; built %lld times, repaired %lld times, "
      "neither %lld times",
      r.radius, r.levels, static_cast<long long>(r.structures_built), static_cast<long long>(r.repairs),
      static_cast<long long>(r.refreshes));
  text += std::string("  size classes            ") + (r.by_size ? "a structure for each: " : "none: ") +
          r.size_reason + "\n";
  text += "  points                  " + points_of(r) + "\n";
  text += "  atoms in memory         " +
          (r.order_obstacle.empty() ? "in the order of the structure"
                                    : "in LAMMPS's order: " + r.order_obstacle) +
          "\n";
  text += "  ghosts                  " +
          (r.ghosts_for.empty() ? "none, as nothing reads them" : "made: " + r.ghosts_for) + "\n";
  text += expiry_lines(r);
  text += "  instructions            " + r.instructions + "\n";
  if (r.skin > 0)
    text += line("  skin                    %g, %s", r.skin,
                 r.skin_settled ? "the fastest that was tried" : "still being looked for");
  text += line("  promotions, demotions   %lld, %lld", static_cast<long long>(r.promotions),
               static_cast<long long>(r.demotions));
  text += line("  points added, removed   %lld, %lld", static_cast<long long>(r.inserted),
               static_cast<long long>(r.removed));
  text += line("  pairs at the last build %lld (%g an atom)", static_cast<long long>(n.entries),
               per(static_cast<double>(n.entries), r.atoms));
  text += line(
      "  time a build            %.4g ms: points %.3g, structure %.3g, rows %.3g, lists %.3g, cluster pairs "
      "%.3g",
      per(1e3 * n.seconds(), n.builds), per(1e3 * n.points_seconds, n.builds),
      per(1e3 * n.structure_seconds, n.builds), per(1e3 * n.rows_seconds, n.builds),
      per(1e3 * n.fill_seconds, n.builds), per(1e3 * n.clusters_seconds, n.builds));
  text +=
      line("  memory                  %.4g Mbytes", static_cast<double>(r.memory_bytes) / (1024.0 * 1024.0));
  return text;
}

std::string verify_line(const RunReport& r) {
  const RunCounters& n = r.counters;
  if (n.verified_builds == 0) return "  verified                no build of the last run; see 'dch verify'\n";
  return line(
      "  verified                %lld builds, %lld pairs, all equal; native %.4g ms a build, DCH/native %.3g",
      static_cast<long long>(n.verified_builds), static_cast<long long>(n.verified_entries),
      per(1e3 * n.verified_native_seconds, n.verified_builds),
      n.verified_native_seconds > 0 ? n.verified_dch_seconds / n.verified_native_seconds : 0.0);
}

}  // namespace

std::string format_report(const RunReport& report) {
  std::string text = settings(report) + list_table(report);
  if (report.counters.builds == 0) return text + "  no build of a DCH list yet: give 'dch on' and a run\n";
  return text + work_table(report) + verify_line(report);
}

}  // namespace dch::lammps
