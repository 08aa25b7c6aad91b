// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/replay_report.hpp"

namespace dch::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

FrameRecord record(std::int64_t frame, std::int64_t pairs) {
  FrameRecord record;
  record.frame = frame;
  record.step = 10 * frame;
  record.pairs = pairs;
  record.repairs = 1;
  record.promotions = 3;
  record.demotions = 2;
  record.levels = 2;
  record.read_ms = 1;
  record.maintain_ms = 2;
  record.list_ms = 4;
  return record;
}

ReplayReport sample_report() {
  ReplayReport report;
  report.file = "a & b.lammpstrj";
  report.format = "LAMMPS dump";
  report.unit = "the dump's unit";
  report.fewest_atoms = 3;
  report.most_atoms = 4;
  report.frames_passed = 9;
  report.box_kinds = {"orthorhombic ppp", "none"};
  report.smallest_height = 12.5;
  report.cutoff = 2;
  report.frames = {record(0, 5), record(4, 1000), record(8, 6)};
  report.frames[0].repairs = 0;
  report.frames[0].rebuilds = 1;
  report.frames[2].list_rebuilt = false;
  report.levels = {{1, 2, 4, -1, 3}, {2, 4, 1, 0, 0}};
  report.degree_histogram = {0, 6, 6};
  report.verify.mode = VerifyMode::all;
  report.verify.frames = {0, 4, 8};
  return report;
}

void add_mismatch(ReplayReport& report) {
  Mismatch mismatch;
  mismatch.frame = 4;
  mismatch.what = "missing";
  mismatch.atom_a = 1;
  mismatch.atom_b = 3;
  mismatch.distance = 1.5;
  report.verify.first.push_back(mismatch);
  report.verify.mismatches = 1;
}

TEST(Report, SumsUpTheFrames) {
  const ReplayTotals totals = sample_report().totals();
  EXPECT_EQ(totals.pairs_min, 5);
  EXPECT_EQ(totals.pairs_max, 1000);
  EXPECT_DOUBLE_EQ(totals.pairs_mean, 337);
  EXPECT_EQ(totals.list_rebuilds, 2);
  EXPECT_EQ(totals.repairs, 2);
  EXPECT_EQ(totals.rebuilds, 1);
  EXPECT_EQ(totals.promotions, 9);
  EXPECT_EQ(totals.demotions, 6);
  EXPECT_DOUBLE_EQ(totals.read_ms, 3);
  EXPECT_DOUBLE_EQ(totals.list_ms, 12);
}

/// Two intervals, of which the second could not be followed.
void add_between(ReplayReport& report) {
  IntervalRecord interval;
  interval.next_frame = 4;
  interval.hidden = 2;
  interval.come = 3;
  interval.go = 4;
  interval.undetermined_atoms = 1;
  interval.unmatched_atoms = 5;
  interval.ms = 6;
  report.between.emplace().add(
      interval, {{7, 8, 0.25, 0.5, 1.9, true}, {3, 9, 0.1, 0.2, 1.5, true}, {3, 5, 0, 0.2, 0.5, false}},
      report.cutoff);
  interval = {};
  interval.frame = 4;
  interval.next_frame = 8;
  interval.undetermined = "the box changes";
  report.between->add(interval, {}, report.cutoff);
}

TEST(ReportBetween, CountsWhatIsHidden) {
  ReplayReport report = sample_report();
  add_between(report);
  const auto json = nlohmann::json::parse(render_json(report))["between"];
  EXPECT_EQ(json["intervals"], 2);
  EXPECT_EQ(json["followed"], 1);
  EXPECT_EQ(json["hidden"], 2);
  EXPECT_EQ(json["events"], 11);
  EXPECT_EQ(json["closest"]["distance"], 1.5);
  EXPECT_EQ(json["closest"]["i"], 3);
  EXPECT_EQ(json["closest"]["next_frame"], 4);
  EXPECT_EQ(json["distance_histogram"][75], 1);
  EXPECT_EQ(json["distance_histogram"][95], 1);
  EXPECT_EQ(json["duration_histogram"][25], 1);
  EXPECT_EQ(json["per_interval"]["closest"], (nlohmann::json{1.5, nullptr}));
  EXPECT_EQ(json["per_interval"]["undetermined"], (nlohmann::json{nullptr, "the box changes"}));
  const std::string table = render_table(report);
  for (const char* part : {"2 contacts that no frame shows; 3 come, 4 go (11 events)",
                           "1.5 [the dump's unit]: the ids 3 and 9 between",
                           "1 of 2 intervals (the first after frame 4: the box changes); 1 atom that moved "
                           "half a box or more; 5 atoms in "
                           "one frame alone",
                           "ms an interval  3"}) {
    EXPECT_THAT(table, HasSubstr(part));
  }
  const std::string page = render_html(report);
  for (const char* card :
       {"<h2>Between frames", "<h2>How close hidden contacts come", "<h2>How long hidden contacts last"})
    EXPECT_THAT(page, HasSubstr(card));
  EXPECT_THAT(render_html(sample_report()), Not(HasSubstr("Between frames")));
}

TEST(ReportBetween, OfNoContacts) {
  ReplayReport report = sample_report();
  report.between.emplace().add({}, {}, 1);
  const auto json = nlohmann::json::parse(render_json(report))["between"];
  EXPECT_EQ(json["closest"]["distance"], nullptr);
  EXPECT_THAT(render_table(report), HasSubstr("0 contacts that no frame shows; 0 come, 0 go"));
  EXPECT_THAT(render_table(report), Not(HasSubstr("not followed")));
  EXPECT_THAT(render_html(report), Not(HasSubstr("How close")));
}

TEST(ReportJson, HoldsWhatTheReportHolds) {
  ReplayReport report = sample_report();
  add_mismatch(report);
  const auto json = nlohmann::json::parse(render_json(report));
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["atoms"], 4);
  EXPECT_EQ(json["engine"], "dch");
  EXPECT_EQ(json["pairs_per_frame"], (nlohmann::json{5, 1000, 6}));
  EXPECT_EQ(json["per_frame"]["frame"], (nlohmann::json{0, 4, 8}));
  EXPECT_EQ(json["per_frame"]["list_rebuilt"], (nlohmann::json{true, true, false}));
  EXPECT_EQ(json["timings_ms"]["list"], 12);
  EXPECT_EQ(json["mismatches"], 1);
  EXPECT_EQ(json["verify"]["first_mismatches"][0]["atoms"], (nlohmann::json{1, 3}));
  EXPECT_EQ(json["level_sizes"][0]["edges"], nullptr);
  EXPECT_EQ(json["level_sizes"][1]["edges"], 0);
}

TEST(ReportJson, IsJsonWhateverTheInput) {
  ReplayReport report = sample_report();
  report.smallest_height = std::numeric_limits<double>::infinity();
  report.frames[0].time = std::numeric_limits<double>::quiet_NaN();
  report.file = "not utf-8: \xff\xfe";
  const auto json = nlohmann::json::parse(render_json(report));
  EXPECT_EQ(json["smallest_box_height"], nullptr);
  EXPECT_EQ(json["per_frame"]["time"][0], nullptr);
}

TEST(ReportTable, StatesUnitCountsAndMismatches) {
  const std::string table = render_table(sample_report());
  for (const char* part : {"the dump's unit", "min 5, mean 337, max 1,000", "2 repairs, 1 rebuild",
                           "orthorhombic ppp; none", "read 1, maintain 2, list 4", "mismatches      0",
                           "2 (nodes after the last frame: 4, 1)", "3 to 4"}) {
    EXPECT_THAT(table, HasSubstr(part));
  }
}

TEST(ReportTable, DoesNotClaimAVerificationThatWasNotAskedFor) {
  ReplayReport report = sample_report();
  report.verify.mode = VerifyMode::none;
  EXPECT_THAT(render_table(report), HasSubstr("mismatches      not looked for"));
}

TEST(ReportTable, LeavesOutTheHierarchyOfEnginesThatHaveNone) {
  ReplayReport report = sample_report();
  report.engine.kind = EngineKind::cell;
  report.levels.clear();
  EXPECT_THAT(render_table(report), Not(HasSubstr("promotions")));
}

TEST(ReportPage, ShowsVerdictAndAllDrawings) {
  const std::string page = render_html(sample_report());
  for (const char* part :
       {"0 mismatches in 3 frames verified", "<h2>Pairs</h2>", "<h2>Cost of a frame</h2>", "<h2>Repairs</h2>",
        "<h2>Levels</h2>", "<h2>Neighbors of an atom</h2>", "a &amp; b.lammpstrj"}) {
    EXPECT_THAT(page, HasSubstr(part));
  }
}

TEST(ReportPage, NamesMismatches) {
  ReplayReport report = sample_report();
  add_mismatch(report);
  const std::string page = render_html(report);
  EXPECT_THAT(page, HasSubstr(">1 mismatch<"));
  EXPECT_THAT(page, HasSubstr("frame 4: pair of atoms 1 and 3"));
}

TEST(ReportPage, NeedsNothingFromOutside) {
  const std::string page = render_html(sample_report());
  for (const char* part : {"http", "src=", "href=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(part)));
}

}  // namespace
}  // namespace dch::cli
