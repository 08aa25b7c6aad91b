// SPDX-License-Identifier: MIT
// What the page of replay --view shows, against all pairs, and what it refuses. tests/golden/replay/view.py
// reads pages.
#include <gtest/gtest.h>
#include <utility>

#include <dch/lists/all_pairs.hpp>
#include <dch/lists/exclusions.hpp>

#include "base/exit_code.hpp"
#include "engines/viewed_hierarchy.hpp"
#include "expect_error.hpp"
#include "list_compare.hpp"
#include "report/view_page.hpp"
#include "scenes.hpp"
#include "small_scene.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

constexpr double kCutoff = 0.3, kSkin = 0.1;

/// A drop in a thin gas.
trajectory::Frame drop_in(const Box& box, std::size_t atoms, scenes::Random& random) {
  trajectory::Frame frame;
  frame.box = box;
  for (std::size_t k = 0; k < atoms; ++k) {
    const Vec3 f{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
    frame.positions.push_back(scenes::from_fractional(box, k % 3 == 0 ? f : 0.3 * f));
  }
  frame.ids.resize(atoms);
  std::iota(frame.ids.begin(), frame.ids.end(), 1);
  return frame;
}

ListParams list_params() {
  ListParams params;
  params.cutoffs = TypeCutoffs(kCutoff);
  params.skin = kSkin;
  return params;
}

ViewedHierarchy viewed_hierarchy() {
  HierarchyParams params;
  params.radius = kCutoff + kSkin;
  return ViewedHierarchy(params);
}

class ViewedBoxes : public testing::TestWithParam<scenes::NamedBox> {
 protected:
  double distance(const trajectory::Frame& frame, std::int32_t a, std::int32_t b) const {
    return std::sqrt(frame.box.distance2(frame.positions[static_cast<std::size_t>(a)],
                                         frame.positions[static_cast<std::size_t>(b)]));
  }

  /// Edges are the pairs of nodes within the threshold.
  void expect_edges(const trajectory::Frame& frame, const ViewedLevel& level) {
    ASSERT_EQ(level.edges.size(), level.nodes.size());
    for (std::size_t a = 0; a < level.nodes.size(); ++a) {
      std::vector<std::int32_t> near;
      for (std::size_t b = a + 1; b < level.nodes.size(); ++b)
        if (distance(frame, level.nodes[a], level.nodes[b]) <= level.edge_threshold)
          near.push_back(static_cast<std::int32_t>(b));
      const Span<const std::int32_t> row = level.edges.row(a);
      EXPECT_EQ(std::vector<std::int32_t>(row.begin(), row.end()), near);
    }
  }

  /// Parents are within the radius, and the nodes of the next level farther apart.
  void expect_cover(const trajectory::Frame& frame, const ViewedLevel& level, const ViewedLevel& above) {
    ASSERT_EQ(level.parents.size(), level.nodes.size());
    for (std::size_t k = 0; k < level.nodes.size(); ++k) {
      ASSERT_GE(level.parents[k], 0);
      const std::int32_t parent = above.nodes.at(static_cast<std::size_t>(level.parents[k]));
      EXPECT_LE(distance(frame, level.nodes[k], parent), level.covering_radius);
    }
    for (std::size_t a = 0; a < above.nodes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_GT(distance(frame, above.nodes[a], above.nodes[b]), level.covering_radius);
  }

  void expect_frame(const trajectory::Frame& frame, const ViewedFrame& shown, const Exclusions* exclusions) {
    ListParams contacts;
    contacts.cutoffs = TypeCutoffs(kCutoff);
    contacts.exclusions = exclusions;
    EXPECT_EQ(first_difference(shown.contacts, all_pairs(frame.positions, frame.box, contacts)), "");
    ASSERT_GE(shown.levels.size(), 2u);
    EXPECT_EQ(shown.levels[0].nodes.size(), frame.positions.size());
    for (std::size_t i = 0; i < shown.levels.size(); ++i) {
      if (i > 0) expect_edges(frame, shown.levels[i]);
      if (i + 1 < shown.levels.size()) expect_cover(frame, shown.levels[i], shown.levels[i + 1]);
    }
    for (std::size_t k = 0; k < frame.positions.size(); ++k) {
      EXPECT_LT(frame.box.distance2(shown.positions[k], frame.positions[k]), 1e-20);
      EXPECT_LT(norm2(shown.positions[k] - frame.box.wrap(frame.positions[k])), 1e-20);
    }
  }
};
INSTANTIATE_TEST_SUITE_P(All, ViewedBoxes, testing::ValuesIn(scenes::all_boxes(5)),
                         [](const auto& scene) { return scene.param.name; });

TEST_P(ViewedBoxes, ShowWhatAllPairsGiveAsAtomsMove) {
  scenes::Random random(3);
  trajectory::Frame frame = drop_in(GetParam().box, 250, random);
  const std::vector<IndexPair> bonds = {{0, 1}, {1, 2}, {4, 7}};
  const Exclusions exclusions = Exclusions::from_bonds(frame.positions.size(), bonds, 2);
  ListParams params = list_params();
  params.exclusions = &exclusions;
  params.kind = ListKind::full;  // contacts are shown once all the same
  ViewedHierarchy viewed = viewed_hierarchy();
  for (int step = 0; step < 4; ++step) {
    frame.step = 10 * step;
    const ViewedFrame& shown = viewed.take(frame, step, params);
    EXPECT_EQ(shown.frame, step);
    EXPECT_EQ(shown.step, 10 * step);
    expect_frame(frame, shown, &exclusions);
    for (Vec3& position : frame.positions) position = position + random.in_ball(0.1);
  }
}

TEST_P(ViewedBoxes, TakeAtomsThatComeAndGo) {
  scenes::Random random(4);
  ViewedHierarchy viewed = viewed_hierarchy();
  for (const std::size_t atoms : {220u, 190u, 190u, 240u}) {
    trajectory::Frame frame = drop_in(GetParam().box, atoms, random);
    frame.ids.back() += 1000;
    expect_frame(frame, viewed.take(frame, 0, list_params()), nullptr);
  }
}

TEST(ViewedHierarchy, ShowsFramesOfHardlyAnyAtoms) {
  ViewedHierarchy viewed = viewed_hierarchy();
  for (const std::size_t atoms : {0u, 1u, 2u, 0u}) {
    const ViewedFrame& shown = viewed.take(random_frame(atoms), 0, list_params());
    EXPECT_EQ(shown.positions.size(), atoms);
    EXPECT_EQ(shown.contacts.size(), atoms);
    for (const ViewedLevel& level : shown.levels) EXPECT_EQ(level.parents.size(), level.nodes.size());
  }
}

class ViewPageTest : public TemporaryFolder {
 protected:
  static ViewHeader header(std::int64_t frames = 1) {
    ViewHeader header;
    header.source = "a<!--<script>b.xtc";
    header.unit = "nm";
    header.cutoff = 1;
    header.frames = frames;
    return header;
  }
};

TEST_F(ViewPageTest, EndsNoScriptByWhatAFileIsCalled) {
  ViewPage page(path("view.html"), header());
  page.append({});
  EXPECT_FALSE(std::filesystem::exists(path("view.html")));
  page.commit();
  const std::string text = content(path("view.html"));
  EXPECT_EQ(text.find("<!--"), std::string::npos);
  EXPECT_NE(text.find("a&lt;!--&lt;script"), std::string::npos);
  EXPECT_NE(text.find("a\\u003c!--\\u003cscript"), std::string::npos);
  EXPECT_NE(text.find("Permission is hereby granted"), std::string::npos);
}

TEST_F(ViewPageTest, RefusesFramesWithTooMuchToDraw) {
  ViewPage page(path("view.html"), header());
  ViewedFrame frame;
  frame.frame = 7;
  frame.contacts.first = {0, ViewPage::kMaxDrawn + 1};
  expect_error<UsageError>([&] { page.append(frame); },
                           {"view.html: frame 7", "2,000,001 contacts", "2,000,000", "smaller cutoff"});
  frame.contacts = {};
  frame.levels.resize(3);
  frame.levels[2].edges.first = {0, ViewPage::kMaxDrawn + 1};
  expect_error<UsageError>([&] { page.append(frame); }, {"2,000,001 edges", "2,000,000", "cutoff or skin"});
  frame.levels.clear();
  frame.positions.resize(ViewPage::kMaxDrawn + 1);
  expect_error<UsageError>([&] { page.append(frame); },
                           {"2,000,001 atoms", "2,000,000", "a part of the atoms"});
}

TEST_F(ViewPageTest, RefusesToGetTooLarge) {
  ViewedFrame frame;
  scenes::Random random(1);
  for (int k = 0; k < 1'900'000; ++k) frame.positions.push_back(random.in_cube(5));
  ViewPage page(path("view.html"), header(20));
  for (int k = 0; k < 3; ++k) page.append(frame);
  expect_error<UsageError>([&] { page.append(frame); }, {"view.html: with 4 of 20 frames", "more than 64 MB",
                                                         "one in 6", "--frames", "smaller cutoff"});
}

TEST_F(ViewPageTest, LeavesNothingBehindIfNotCompleted) {
  {
    ViewPage page(path("view.html"), header());
    page.append({});
  }
  EXPECT_EQ(files(), 0u);
  expect_error<trajectory::FileError>([&] { ViewPage(path("no/view.html"), header()); }, {"no/view.html"});
}

}  // namespace
}  // namespace dch::cli
