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

/// "each point is the mean of 25 frames", or nothing if every frame is drawn.
std::string group_note(std::size_t frames);

}  // namespace dch::cli
