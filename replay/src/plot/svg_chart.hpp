// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dch::cli {

/// Text with the characters that mean something in HTML replaced, and control characters dropped.
std::string escape_html(const std::string& text);

/// One series of a chart: its class names the color (see the page's style sheet: "blue", "green", "amber",
/// "red").
struct Series {
  std::string name;
  std::string color;
  std::vector<double> y;
};

/// Values over the frames. All series are as long as x.
struct FrameChart {
  std::string x_label, y_label;
  std::vector<double> x;  ///< ascending frame numbers
  std::vector<Series> series;
  std::vector<bool> marked;  ///< frames that carry a mark at the top; may be empty
  std::string mark_name;     ///< what a mark says
};

/// One bar with a label in front and a note behind.
struct LabelledBar {
  std::string label, note;
  double value = 0;
};

/// Each function gives one <svg> element that scales with its container; hovering shows values (<title>).
/// Runs of more than 400 frames are drawn as means of groups; group_note() says so.
std::string line_chart(const FrameChart& chart);
std::string stacked_bars(const FrameChart& chart);
/// The first series upwards, the second downwards.
std::string up_down_bars(const FrameChart& chart);
/// Horizontal bars on a logarithmic axis from 1; values are >= 1.
std::string logarithmic_bars(const std::vector<LabelledBar>& bars, const std::string& axis_label);
/// shares[k] in percent at k, k + 1, ...; `mean` is marked.
std::string histogram(const std::vector<double>& shares, double mean, const std::string& x_label,
                      const std::string& y_label);

/// A point of a chart with two logarithmic axes.
struct LogPoint {
  double x = 0, y = 0;
  std::string title;  ///< shown on hovering
};

struct LogChart {
  std::string x_label, y_label;
  std::vector<LogPoint> points;  ///< in order of x
};

/// Points joined by a line; those that are not above 0 in x and y cannot be drawn and are left out.
std::string log_log_chart(const LogChart& chart);

/// A square matrix over consecutive intervals, drawn like one: the first row is on top.
struct HeatMap {
  std::string axis_label;
  std::vector<double> edges;   ///< of the intervals, ascending; one more than there are
  std::vector<double> values;  ///< by row; those not above 0 are left blank
  std::vector<double> lines;   ///< drawn across, in both directions
};

/// Values in eight shades, logarithmic from the least to the largest.
std::string heat_map(const HeatMap& map);

/// "each point is the mean of 25 frames", or nothing if every frame is drawn.
std::string group_note(std::size_t frames);

}  // namespace dch::cli
