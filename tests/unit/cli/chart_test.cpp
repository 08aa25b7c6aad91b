// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

#include "plot/axis.hpp"
#include "plot/svg_chart.hpp"

namespace dch::cli {
namespace {

using testing::DoubleEq;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

TEST(RoundTicks, AreRoundAndCoverTheRange) {
  EXPECT_THAT(round_ticks(0, 10, 5), Pointwise(DoubleEq(), {0.0, 2.0, 4.0, 6.0, 8.0, 10.0}));
  EXPECT_THAT(round_ticks(0.3, 1.1, 4),
              Pointwise(DoubleEq(), {0.2, 0.4, 0.6000000000000001, 0.8, 1.0, 1.2000000000000002}));
  for (const auto& [low, high] : {std::pair{-7.0, 1234.0}, {1e-9, 2e-9}, {52498.0, 52768.0}, {0.0, 1e12}}) {
    const auto ticks = round_ticks(low, high, 5);
    EXPECT_LE(ticks.front(), low * (1 + 1e-9));
    EXPECT_GE(ticks.back(), high * (1 - 1e-9));
    EXPECT_LE(ticks.size(), 9u);
  }
}

TEST(RoundTicks, WidenAnEmptyRange) {
  for (const double value : {0.0, 5.0, -3.0, 1e9}) {
    const auto ticks = round_ticks(value, value, 5);
    EXPECT_LT(ticks.front(), value);
    EXPECT_GT(ticks.back(), value);
  }
}

TEST(TickLabel, IsShort) {
  EXPECT_EQ(tick_label(0), "0");
  EXPECT_EQ(tick_label(0.05), "0.05");
  EXPECT_EQ(tick_label(12000), "12,000");
  EXPECT_EQ(tick_label(2.5e6), "2.5M");
  EXPECT_EQ(tick_label(1e-7), "1e-07");
}

TEST(Grouping, TakesMeansOfNeighbors) {
  const Grouping three(7, 3);
  EXPECT_EQ(three.per_group, 3u);
  EXPECT_EQ(three.groups(), 3u);
  EXPECT_THAT(three.means({1, 2, 3, 4, 5, 6, 10}), testing::ElementsAre(2, 5, 10));
  EXPECT_EQ(Grouping(5, 400).per_group, 1u);
  EXPECT_EQ(Grouping(0, 400).groups(), 0u);
}

FrameChart chart_of(std::vector<std::vector<double>> series) {
  FrameChart chart{"frame", "things", std::vector<double>(series.front().size()), {}, {}, "marked"};
  std::iota(chart.x.begin(), chart.x.end(), 0.0);
  for (auto& y : series) chart.series.push_back({"s", "blue", std::move(y)});
  return chart;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

void expect_drawable(const std::string& svg) {
  EXPECT_THAT(svg, testing::StartsWith("<svg"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, Not(HasSubstr("=\"-")));  // no negative widths, heights or coordinates
}

TEST(Charts, DrawDegenerateData) {
  for (const std::vector<double>& y :
       std::vector<std::vector<double>>{{5}, {0}, {0, 0, 0}, {7, 7, 7}, {0, 1e9}}) {
    expect_drawable(line_chart(chart_of({y})));
    expect_drawable(stacked_bars(chart_of({y, y, y})));
    expect_drawable(up_down_bars(chart_of({y, y})));
    expect_drawable(histogram(y, 0, "neighbors", "% of atoms"));
    expect_drawable(logarithmic_bars({{"level 0", "a node", std::max(1.0, y[0])}}, "nodes"));
  }
}

TEST(LogLogChart, DrawsWhatIsAboveZero) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = log_log_chart(
      {"s", "P(s)", {{1, 0.5, "first"}, {10, 0, "zero"}, {20, none, "none"}, {1000, 1e-5, "last"}}});
  expect_drawable(svg);
  EXPECT_EQ(occurrences(svg, "<circle"), 2u);
  EXPECT_THAT(svg, HasSubstr(">last<"));
  EXPECT_THAT(svg, HasSubstr(">1e-05<"));
  EXPECT_THAT(svg, Not(HasSubstr(">zero<")));
  expect_drawable(log_log_chart({"s", "P(s)", {}}));
  expect_drawable(log_log_chart({"s", "P(s)", {{10, 10, "alone"}}}));
}

TEST(HeatMaps, ShadeByTheLogarithm) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = heat_map({"bead", {0, 1, 3, 6}, {none, 0.001, 1, 0.001, 0, 0, 1, 0, 0.03}, {1}});
  expect_drawable(svg);
  EXPECT_EQ(occurrences(svg, "class=\"heat\""), 3u + 8u) << "three shades, and the key";
  EXPECT_THAT(svg, HasSubstr(">from 0.001<"));
  expect_drawable(heat_map({"bead", {0, 5}, {none}, {}}));
  expect_drawable(heat_map({"bead", {0, 5}, {0.5}, {}}));
  EXPECT_EQ(occurrences(heat_map({"bead", {0, 1, 2}, {0.5, 0.5, 0, 0.5}, {}}), "M"), 2u + 1u)
      << "cells of a row are drawn as one, and a single value has one shade";
}

TEST(Charts, MergeLongRunsAndSaySo) {
  const std::vector<double> y(10000, 3.0);
  EXPECT_EQ(occurrences(stacked_bars(chart_of({y})), "<rect"), 400u);
  EXPECT_EQ(group_note(10000), "each point is the mean of 25 frames");
  EXPECT_EQ(group_note(400), "");
}

TEST(Charts, MarkFramesOnceEach) {
  FrameChart chart = chart_of({{1, 2, 3}, {1, 2, 3}});
  chart.marked = {true, false, true};
  EXPECT_EQ(occurrences(up_down_bars(chart), "class=\"mark\""), 3u);  // two frames and the legend
}

TEST(Charts, EscapeText) {
  EXPECT_EQ(escape_html("a<b> & \"c\"\x01"), "a&lt;b&gt; &amp; &quot;c&quot;");
  FrameChart chart = chart_of({{1}});
  chart.y_label = "<script>";
  EXPECT_THAT(line_chart(chart), Not(HasSubstr("<script>")));
}

}  // namespace
}  // namespace dch::cli
