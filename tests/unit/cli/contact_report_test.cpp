// SPDX-License-Identifier: MIT
#include "report/contact_report.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>
#include <limits>

#include <dch/trajectory/file_error.hpp>

#include "expect_error.hpp"
#include "hdf5_read.hpp"
#include "report/contact_file.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

using necklace::Contact;
using necklace::ContactEvent;
using necklace::Necklace;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A chain of four beads in two frames, as far as reports go.
ContactReport small_report(const std::vector<Contact>& contacts) {
  const Necklace necklace = Necklace::chain({0.5, 0.5, 0.5, 0.5});
  ContactReport report;
  report.file = "a<b.xtc";
  report.unit = "nm";
  report.topology = "a.chains";
  report.box_kinds = {"none"};
  report.smallest_height = std::numeric_limits<double>::infinity();
  report.chains = 1;
  report.beads = report.shortest_chain = report.longest_chain = 4;
  report.query.gap = 0.25;
  report.map = necklace::ContactMap(necklace, report.query);
  report.probability = necklace::ContactProbability(necklace, report.query);
  report.chain_ends = {0, 4};
  necklace::ContactEvents events;
  for (int frame = 0; frame < 3; ++frame) {
    const std::vector<Contact> now = frame == 1 ? contacts : std::vector<Contact>();
    report.map.add(now);
    report.probability.add(now);
    report.events.add(events.add(frame, now));
    ContactFrame record;
    record.frame = frame;
    record.within = static_cast<std::int64_t>(now.size());
    report.frames.push_back(record);
  }
  report.events.add(events.finish());
  return report;
}

const std::vector<Contact> kTwo{{0, 2, 0, {}, {}}, {0, 3, 0, {}, {}}};

TEST(ContactReportTest, SumsUp) {
  const ContactReport report = small_report(kTwo);
  const FrameSpread spread = report.contacts();
  EXPECT_EQ(spread.least, 0);
  EXPECT_EQ(spread.most, 2);
  EXPECT_DOUBLE_EQ(spread.mean, 2.0 / 3);
  EXPECT_EQ(report.events.events(), 2);
  EXPECT_EQ(report.events.complete(), 2);
  EXPECT_EQ(report.events.mean_duration(), 0);
  EXPECT_THAT(report.events.by_frames(), ElementsAre(0, 2));
}

TEST(ContactReportTest, EventsThatAreCutDoNotCountForDurations) {
  EventSummary summary;
  const std::vector<ContactEvent> events{
      {0, 3, 0, 2, 0, 10, true, false}, {1, 3, 1, 2, 5, 8, false, false}, {0, 2, 4, 9, 20, 90, false, true}};
  summary.add(events);
  EXPECT_EQ(summary.events(), 3);
  EXPECT_EQ(summary.begun_before(), 1);
  EXPECT_EQ(summary.not_ended(), 1);
  EXPECT_EQ(summary.complete(), 1);
  EXPECT_EQ(summary.mean_duration(), 3);
  EXPECT_EQ(summary.longest(), 70);
  EXPECT_EQ(EventSummary().mean_duration(), 0);
}

TEST(ContactReportTest, TableNamesWhatWasFound) {
  const std::string table = render_table(small_report(kTwo));
  EXPECT_THAT(table, HasSubstr("chains          1 chain of 4 beads, 4 in all (from a.chains)"));
  EXPECT_THAT(table, HasSubstr("surfaces at most 0.25 nm apart, more than 1 bond between"));
  EXPECT_THAT(table, HasSubstr("in a frame      min 0, mean 0.6667, max 2"));
  EXPECT_THAT(table, HasSubstr("0.1667 at s = 2, 0.3333 at s = 3"));
}

TEST(ContactReportTest, PageIsWholeAndEscaped) {
  for (const auto& contacts : {kTwo, std::vector<Contact>()}) {
    const std::string page = render_html(small_report(contacts));
    EXPECT_THAT(page, HasSubstr("a&lt;b.xtc"));
    EXPECT_THAT(page, HasSubstr("Contact map"));
    EXPECT_THAT(page, HasSubstr("P(s)"));
    EXPECT_THAT(page, Not(HasSubstr("nan")));
    EXPECT_THAT(page, Not(HasSubstr("inf")));
  }
}

TEST(ContactReportTest, JsonHasNoNumbersThatAreNone) {
  const std::string json = render_json(small_report({}));
  EXPECT_THAT(json, HasSubstr("\"mean_duration\": null"));
  EXPECT_THAT(json, HasSubstr("\"smallest_box_height\": null"));
  EXPECT_THAT(json, HasSubstr("\"skip_bonds\": 1"));
}

using ContactFileTest = TemporaryFolder;

TEST_F(ContactFileTest, HoldsWhatItWasGiven) {
  const ContactReport report = small_report(kTwo);
  ContactFile file(path("contacts.h5"), {"a.xtc", "a.chains", "nm", "step", report.query},
                   Necklace::chain({0.5, 0.5, 0.5, 0.5}), {3, 4, 8, 9});
  for (const ContactFrame& frame : report.frames) file.append(frame);
  file.append(std::vector<ContactEvent>{{0, 2, 1, 1, 1, 1, false, false}});
  file.append(std::vector<ContactEvent>());
  file.append(std::vector<ContactEvent>{{0, 3, 1, 2, 1, 2, false, true}});
  EXPECT_FALSE(std::filesystem::exists(path("contacts.h5")));
  file.finish(report.map, report.probability);
  EXPECT_EQ(files(), 1u);

  const hid_t data = H5Fopen(path("contacts.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(data, 0);
  EXPECT_THAT(read_integers(data, "chains/ids"), ElementsAre(3, 4, 8, 9));
  EXPECT_THAT(read_integers(data, "frames/within"), ElementsAre(0, 2, 0));
  EXPECT_THAT(read_integers(data, "events/i"), ElementsAre(3, 3));
  EXPECT_THAT(read_integers(data, "events/j"), ElementsAre(8, 9));
  EXPECT_THAT(read_integers(data, "events/not_ended"), ElementsAre(0, 1));
  EXPECT_THAT(read_integers(data, "map/first_place"), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(read_integers(data, "map/contacts"),
              ElementsAre(0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0));
  EXPECT_THAT(read_integers(data, "separation/pairs"), ElementsAre(0, 0, 2, 1));
  H5Fclose(data);
}

TEST_F(ContactFileTest, LeavesNothingBehindIfNotCompleted) {
  { ContactFile file(path("contacts.h5"), {}, Necklace::chain({1}), {1}); }
  EXPECT_EQ(files(), 0u);
  expect_error<trajectory::FileError>(
      [&] { ContactFile(path("no/contacts.h5"), {}, Necklace::chain({1}), {1}); }, {"no/contacts.h5"});
}

}  // namespace
}  // namespace dch::cli
