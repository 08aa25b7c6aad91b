// SPDX-License-Identifier: GPL-2.0-or-later
#include "run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dch::lammps {
namespace {

using testing::HasSubstr;
using testing::Not;

RunReport example() {
  RunReport r;
  r.enabled = true;
  r.radius = 2.8;
  r.instructions = "avx2";
  r.counters.builds = 4;
  r.counters.entries = 3000;
  r.counters.structure_seconds = 0.008;
  r.counters.fill_seconds = 0.004;
  r.atoms = 100;
  r.structures_built = 1;
  r.repairs = 3;
  r.refreshes = 5;
  r.promotions = 17;
  r.demotions = 19;
  r.memory_bytes = 3 << 20;
  r.lists = {{1, "pair lj/cut, half, newton on", "", ""},
             {2, "compute coord/atom, full", "built on demand only", ""}};
  return r;
}

TEST(RunReport, SaysWhoseEachListIsAndWhy) {
  const std::string text = format_report(example());
  EXPECT_THAT(text, HasSubstr("DCH neighbor lists: on\n"));
  EXPECT_THAT(text, HasSubstr("list 1, pair lj/cut, half, newton on: DCH\n"));
  EXPECT_THAT(text, HasSubstr("list 2, compute coord/atom, full: native, built on demand only\n"));
}

TEST(RunReport, GivesCountsAndMeans) {
  const std::string text = format_report(example());
  EXPECT_THAT(text, HasSubstr("built 1 times, repaired 3 times, neither 5 times"));
  EXPECT_THAT(text, HasSubstr("promotions, demotions   17, 19"));
  EXPECT_THAT(text, HasSubstr("owned atoms and ghosts in open space"));
  EXPECT_THAT(text, HasSubstr("3000 (30 an atom)"));
  EXPECT_THAT(text, HasSubstr("3 ms: points 0, structure 2, rows 0, lists 1"));
  EXPECT_THAT(text, HasSubstr("3 Mbytes"));
  EXPECT_THAT(text, HasSubstr("instructions            avx2\n"));
}

TEST(RunReport, SaysWhichEngineWasTakenAndWhy) {
  RunReport report = example();
  report.engine = "grid";
  EXPECT_THAT(format_report(report), HasSubstr("engine                  grid\n"));
  report.engine = "auto";
  report.choice = "dch: 9.0 points a cell, spread 7.1";
  EXPECT_THAT(format_report(report),
              HasSubstr("engine                  auto, dch: 9.0 points a cell, spread 7.1\n"));
  report.processes = 3;
  report.processes_on_grid = 2;
  EXPECT_THAT(format_report(report),
              HasSubstr("auto, on process 0 dch: 9.0 points a cell, spread 7.1; 2 of 3 "
                        "processes on the grid\n"));
}

TEST(RunReport, SaysWhetherSizesHaveStructuresOfTheirOwn) {
  RunReport report = example();
  report.size_reason = "cutoffs are equal";
  EXPECT_THAT(format_report(report), HasSubstr("size classes            none: cutoffs are equal\n"));
  report.by_size = true;
  EXPECT_THAT(format_report(report),
              HasSubstr("size classes            a structure for each: cutoffs are equal\n"));
}

TEST(RunReport, SaysWhatThePointsAre) {
  dch::lammps::RunReport report = example();
  report.in_box = true;
  EXPECT_THAT(format_report(report), HasSubstr("points                  the atoms in the box"));
}

TEST(RunReport, SaysInWhichOrderAtomsAre) {
  dch::lammps::RunReport report = example();
  EXPECT_THAT(format_report(report), HasSubstr("atoms in memory         in the order of the structure\n"));
  report.order_obstacle = "'atom_modify sort' is off";
  EXPECT_THAT(format_report(report), HasSubstr("in LAMMPS's order: 'atom_modify sort' is off\n"));
}

TEST(RunReport, SaysWhyThereAreGhosts) {
  dch::lammps::RunReport report = example();
  EXPECT_THAT(format_report(report), HasSubstr("ghosts                  none, as nothing reads them\n"));
  report.ghosts_for = "the box changes";
  EXPECT_THAT(format_report(report), HasSubstr("ghosts                  made: the box changes\n"));
}

TEST(RunReport, SaysWhichRuleEndsListsAndWhatItSaved) {
  dch::lammps::RunReport report = example();
  report.expiry_obstacle = "the box changes";
  EXPECT_THAT(format_report(report), HasSubstr("expiry                  half the skin: the box changes\n"));
  report.expiry_obstacle.clear();
  EXPECT_THAT(format_report(report), Not(HasSubstr("given up")));
  report.counters.builds_saved = 2.4;
  report.counters.expiry_seconds = 0.01;
  report.counters.verdicts = {20, 0, 0, 3, 0, 1};
  EXPECT_THAT(
      format_report(report),
      HasSubstr("exact: about 2.4 builds saved; lists kept beyond half the skin at 20 steps, 0.5 ms each\n"
                "                          given up 3 for many fast atoms, 1 for a missing pair\n"));
}

TEST(RunReport, GivesTheRatioToNativeWhereBuildsWereVerified) {
  RunReport r = example();
  EXPECT_THAT(format_report(r), HasSubstr("no build of the last run; see 'dch verify'"));
  r.verify_every = 2;
  r.counters.verified_builds = 2;
  r.counters.verified_entries = 6000;
  r.counters.verified_native_seconds = 0.02;
  r.counters.verified_dch_seconds = 0.005;
  EXPECT_THAT(format_report(r),
              HasSubstr("2 builds, 6000 pairs, all equal; native 10 ms a build, DCH/native 0.25"));
}

TEST(RunReport, BeforeTheFirstRunThereIsNothingToCount) {
  const std::string text = format_report({});
  EXPECT_THAT(text, HasSubstr("DCH neighbor lists: off\n"));
  EXPECT_THAT(text, HasSubstr("no build of a DCH list yet"));
  EXPECT_THAT(text, Not(HasSubstr("promotions")));
}

}  // namespace
}  // namespace dch::lammps
