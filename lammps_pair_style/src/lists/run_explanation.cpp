// SPDX-License-Identifier: GPL-2.0-or-later
// What `dch explain` prints.
#include <cstdio>

#include "run_report.h"

namespace dch::lammps {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string explained_list(const ListNote& note) {
  std::string text = "  " + (note.number > 0 ? "list " + std::to_string(note.number) + ", " : "") + note.name;
  if (note.reason.empty()) return text + ": DCH\n";
  text += ": native, " + note.reason;
  return text + (note.remedy.empty() ? "" : "; give " + note.remedy) + "\n";
}

std::string chosen_engine(const RunReport& r) {
  std::string text = "  engine: " + r.engine + ", as " + r.engine_reason;
  if (!r.choice.empty()) text += "; it has taken " + r.choice;
  if (!r.choice.empty() && r.processes > 1)
    text += ", on process 0; " + std::to_string(r.processes_on_grid) + " of " + std::to_string(r.processes) +
            " processes are on the grid";
  return text + "\n";
}

std::string chosen_skin(const RunReport& r) {
  if (r.skin > 0)
    return "  skin: " + number(r.skin) + ", " +
           (r.skin_settled ? "the fastest that was tried" : "still being looked for") +
           ", as 'dch skin auto' was given\n";
  return "  skin: " + number(r.script_skin) + " of the script, as " +
         (r.skin_obstacle.empty() ? "no 'dch skin auto' was given" : r.skin_obstacle) + "\n";
}

std::string settings_of_run(const RunReport& r) {
  std::string text = chosen_engine(r);
  text += std::string("  size classes: ") +
          (r.by_size ? "a structure for each, as " : "one structure for all, as ") + r.size_reason + "\n";
  text += chosen_skin(r);
  text += "  order of atoms: " +
          (r.order_obstacle.empty() ? "that of the structure, in which neighbors are near in memory"
                                    : "LAMMPS's, as " + r.order_obstacle) +
          "\n";
  text +=
      "  expiry of lists: " +
      (r.expiry_obstacle.empty() ? "when a pair is missing" : "at half the skin, as " + r.expiry_obstacle) +
      "\n";
  return text + "  threads: " + std::to_string(r.threads) + " of each process, as 'dch threads' says\n";
}

}  // namespace

std::string describe(const Turns& turns, const std::string& why) {
  std::string text = "SIMD kernel " + std::to_string(turns.by_kernel) + " times";
  if (turns.by_plain > 0) text += ", plain style " + std::to_string(turns.by_plain) + " times, " + why;
  return text;
}

std::string format_explanation(const RunReport& report) {
  std::string text = "DCH choices: lists " + std::string(report.enabled ? "on" : "off") + ", " +
                     std::to_string(report.processes) +
                     (report.processes == 1 ? " process\n" : " processes\n");
  if (!report.enabled) text += "  all lists: native, no 'dch on' was given\n";
  for (const ListNote& note : report.lists)
    if (note.number > 0) text += explained_list(note);
  for (const StyleNote& style : report.styles) text += "  " + style.name + ": " + style.how + "\n";
  if (report.counters.builds == 0)
    return text + "  no build of a DCH list yet, so nothing else was chosen: give 'dch on' and a run\n";
  return text + settings_of_run(report);
}

}  // namespace dch::lammps
