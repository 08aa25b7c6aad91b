// SPDX-License-Identifier: GPL-2.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_report.h"

namespace dch::lammps {
namespace {

using testing::HasSubstr;
using testing::Not;

RunReport explained() {
  RunReport r;
  r.enabled = true;
  r.counters.builds = 4;
  r.engine = "dch";
  r.engine_reason = "'dch on' takes it for lists";
  r.size_reason = "sizes are equal";
  r.script_skin = 0.3;
  r.threads = 2;
  r.lists = {{0, "pair lj/cut/dch, cluster pairs", {}, {}},
             {1, "pair lj/cut, half, newton on", {}, {}},
             {2, "pair sw, full", "no IDs", "'atom_modify id yes'"},
             {3, "compute rdf, full", "built on demand only", {}}};
  r.styles = {{"pair lj/cut/dch", "cluster pairs"}};
  return r;
}

TEST(Explanation, NamesEachListWithReasonAndRemedy) {
  const std::string text = format_explanation(explained());
  EXPECT_THAT(text, HasSubstr("DCH choices: lists on, 1 process\n"));
  EXPECT_THAT(text, HasSubstr("  list 1, pair lj/cut, half, newton on: DCH\n"));
  EXPECT_THAT(text, HasSubstr("  list 2, pair sw, full: native, no IDs; give 'atom_modify id yes'\n"));
  EXPECT_THAT(text, HasSubstr("  list 3, compute rdf, full: native, built on demand only\n"));
}

TEST(Explanation, LeavesClusterPairsToTheirStyle) {
  const std::string text = format_explanation(explained());
  EXPECT_THAT(text, HasSubstr("  pair lj/cut/dch: cluster pairs\n"));
  EXPECT_THAT(text, Not(HasSubstr("pair lj/cut/dch, cluster pairs")));
}

TEST(Explanation, SaysWhatTheRunWentBy) {
  RunReport report = explained();
  std::string text = format_explanation(report);
  EXPECT_THAT(text, HasSubstr("  engine: dch, as 'dch on' takes it for lists\n"));
  EXPECT_THAT(text, HasSubstr("  size classes: one structure for all, as sizes are equal\n"));
  EXPECT_THAT(text, HasSubstr("  skin: 0.3 of the script, as no 'dch skin auto' was given\n"));
  EXPECT_THAT(text, HasSubstr("  order of atoms: that of the structure"));
  EXPECT_THAT(text, HasSubstr("  expiry of lists: when a pair is missing\n"));
  EXPECT_THAT(text, HasSubstr("  threads: 2 of each process"));
  report.by_size = true;
  report.skin = 0.24;
  report.order_obstacle = "'atom_modify sort' is off";
  report.expiry_obstacle = "the box changes";
  text = format_explanation(report);
  EXPECT_THAT(text, HasSubstr("  size classes: a structure for each, as sizes are equal\n"));
  EXPECT_THAT(text, HasSubstr("  skin: 0.24, still being looked for, as 'dch skin auto' was given\n"));
  EXPECT_THAT(text, HasSubstr("  order of atoms: LAMMPS's, as 'atom_modify sort' is off\n"));
  EXPECT_THAT(text, HasSubstr("  expiry of lists: at half the skin, as the box changes\n"));
  report.skin_settled = true;
  EXPECT_THAT(format_explanation(report), HasSubstr("  skin: 0.24, the fastest that was tried"));
  report.skin = 0;
  report.skin_obstacle = "a granular list is in use";
  EXPECT_THAT(format_explanation(report),
              HasSubstr("  skin: 0.3 of the script, as a granular list is in use\n"));
}

TEST(Explanation, SaysWhichEngineEachProcessTook) {
  RunReport report = explained();
  report.engine = "auto";
  report.choice = "dch: 9.0 points a cell";
  EXPECT_THAT(
      format_explanation(report),
      HasSubstr("  engine: auto, as 'dch on' takes it for lists; it has taken dch: 9.0 points a cell\n"));
  report.processes = 3;
  report.processes_on_grid = 2;
  const std::string text = format_explanation(report);
  EXPECT_THAT(text, HasSubstr("lists on, 3 processes\n"));
  EXPECT_THAT(text, HasSubstr("points a cell, on process 0; 2 of 3 processes are on the grid\n"));
}

TEST(Explanation, WithoutListsOrABuildThereIsLessToSay) {
  RunReport report = explained();
  report.enabled = false;
  EXPECT_THAT(format_explanation(report), HasSubstr("  all lists: native, no 'dch on' was given\n"));
  report.counters.builds = 0;
  const std::string text = format_explanation(report);
  EXPECT_THAT(text, HasSubstr("no build of a DCH list yet"));
  EXPECT_THAT(text, Not(HasSubstr("engine: ")));
}

TEST(Explanation, CountsHowOftenThePlainStyleComputed) {
  EXPECT_EQ(describe({98, 0}, "newton is off"), "SIMD kernel 98 times");
  EXPECT_EQ(describe({98, 3}, "newton is off"), "SIMD kernel 98 times, plain style 3 times, newton is off");
}

}  // namespace
}  // namespace dch::lammps
