// SPDX-License-Identifier: MIT
#include "plot/svg_chart.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/number_text.hpp"
#include "plot/axis.hpp"
#include "plot/svg_canvas.hpp"

namespace dch::cli {
namespace {

constexpr std::size_t kMaxGroups = 400;
constexpr std::size_t kMaxDots = 120;  ///< more would run into each other
constexpr int kTicks = 5;
constexpr int kFrameTicks = 8;

/// A chart's data as drawn: frames merged into groups where there are many.
struct Drawn {
  Grouping grouping;
  std::vector<double> x;
  std::vector<std::vector<double>> y;

  explicit Drawn(const FrameChart& chart) : grouping(chart.x.size(), kMaxGroups), x(grouping.means(chart.x)) {
    for (const Series& series : chart.series) y.push_back(grouping.means(series.y));
  }
  /// Distance of two points along x; 1 if there is only one.
  double pitch() const {
    return x.size() < 2 ? 1 : (x.back() - x.front()) / static_cast<double>(x.size() - 1);
  }
};

std::vector<double> frame_ticks(double low, double high) {
  std::vector<double> ticks = round_ticks(low, high, kFrameTicks);
  ticks.erase(
      std::remove_if(ticks.begin(), ticks.end(), [](double tick) { return tick != std::floor(tick); }),
      ticks.end());
  return ticks;
}

Scale frame_axis(SvgCanvas& canvas, const FrameChart& chart, const Drawn& drawn) {
  const double low = drawn.x.front() - 0.5 * drawn.pitch();
  const double high = drawn.x.back() + 0.5 * drawn.pitch();
  const auto ticks = drawn.x.size() == 1 ? std::vector<double>{drawn.x.front()}
                                         : frame_ticks(chart.x.front(), chart.x.back());
  return canvas.horizontal_axis(low, high, ticks, chart.x_label);
}

void draw_legend(SvgCanvas& canvas, const FrameChart& chart) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const Series& series : chart.series) entries.emplace_back(series.color, series.name);
  if (std::find(chart.marked.begin(), chart.marked.end(), true) != chart.marked.end()) {
    entries.emplace_back("mark", chart.mark_name);
  }
  if (entries.size() > 1) canvas.legend(entries);
}

std::string point_title(const FrameChart& chart, const Drawn& drawn, std::size_t series, std::size_t k) {
  const char* of = drawn.grouping.per_group > 1 ? "around frame" : "frame";
  return fmt::format("{} {}: {} {}", of, std::llround(drawn.x[k]), chart.series[series].name,
                     readable(drawn.y[series][k]));
}

void draw_marks(SvgCanvas& canvas, const FrameChart& chart, const Drawn& drawn, const Scale& x) {
  std::size_t last = drawn.x.size();  // none yet
  for (std::size_t frame = 0; frame < chart.marked.size(); ++frame) {
    const std::size_t group = frame / drawn.grouping.per_group;
    if (!chart.marked[frame] || group == last) continue;
    canvas.mark(x(drawn.x[group]), SvgCanvas::kTop - 1,
                fmt::format("frame {}: {}", chart.x[frame], chart.mark_name));
    last = group;
  }
}

/// Width of a bar that leaves a hair's breadth to the next one where there is room.
double bar_width(const Scale& x, double pitch) {
  const double room = x(pitch) - x(0);
  return room > 4 ? std::min(room - 1.5, 60.0) : room;
}

}  // namespace

std::string group_note(std::size_t frames) {
  const Grouping grouping(frames, kMaxGroups);
  if (grouping.per_group == 1) return "";
  return fmt::format("each point is the mean of {} frames", grouping.per_group);
}

std::string line_chart(const FrameChart& chart) {
  const Drawn drawn(chart);
  double low = drawn.y[0].front(), high = low;
  for (const auto& values : drawn.y) {
    low = std::min(low, *std::min_element(values.begin(), values.end()));
    high = std::max(high, *std::max_element(values.begin(), values.end()));
  }
  SvgCanvas canvas;
  const Scale y = canvas.vertical_axis(round_ticks(low, high, kTicks), chart.y_label);
  const Scale x = frame_axis(canvas, chart, drawn);
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    std::vector<double> px, py;
    for (std::size_t k = 0; k < drawn.x.size(); ++k) {
      px.push_back(x(drawn.x[k]));
      py.push_back(y(drawn.y[s][k]));
    }
    canvas.polyline(px, py, chart.series[s].color);
    for (std::size_t k = 0; k < px.size() && px.size() <= kMaxDots; ++k) {
      canvas.dot(px[k], py[k], chart.series[s].color, point_title(chart, drawn, s, k));
    }
  }
  draw_legend(canvas, chart);
  return canvas.finish(chart.y_label + " over " + chart.x_label);
}

std::string stacked_bars(const FrameChart& chart) {
  const Drawn drawn(chart);
  std::vector<double> total(drawn.x.size(), 0.0);
  for (const auto& values : drawn.y) {
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += values[k];
  }
  SvgCanvas canvas;
  const Scale y = canvas.vertical_axis(round_ticks(0, *std::max_element(total.begin(), total.end()), kTicks),
                                       chart.y_label);
  const Scale x = frame_axis(canvas, chart, drawn);
  const double width = bar_width(x, drawn.pitch());
  std::vector<double> base(drawn.x.size(), 0.0);
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    for (std::size_t k = 0; k < drawn.x.size(); ++k) {
      const double top = base[k] + drawn.y[s][k];
      canvas.rect(x(drawn.x[k]) - 0.5 * width, y(top), width, y(base[k]) - y(top), chart.series[s].color,
                  point_title(chart, drawn, s, k));
      base[k] = top;
    }
  }
  draw_legend(canvas, chart);
  return canvas.finish(chart.y_label + " over " + chart.x_label);
}

std::string up_down_bars(const FrameChart& chart) {
  const Drawn drawn(chart);
  const double up = *std::max_element(drawn.y[0].begin(), drawn.y[0].end());
  const double down = *std::max_element(drawn.y[1].begin(), drawn.y[1].end());
  SvgCanvas canvas;
  const Scale y = canvas.vertical_axis(round_ticks(-down, up, kTicks), chart.y_label);
  const Scale x = frame_axis(canvas, chart, drawn);
  const double width = bar_width(x, drawn.pitch());
  for (std::size_t k = 0; k < drawn.x.size(); ++k) {
    const double left = x(drawn.x[k]) - 0.5 * width;
    const double rise = drawn.y[0][k], fall = drawn.y[1][k];
    canvas.rect(left, y(rise), width, y(0) - y(rise), chart.series[0].color, point_title(chart, drawn, 0, k));
    canvas.rect(left, y(0), width, y(-fall) - y(0), chart.series[1].color, point_title(chart, drawn, 1, k));
  }
  draw_marks(canvas, chart, drawn, x);
  draw_legend(canvas, chart);
  return canvas.finish(chart.y_label + " over " + chart.x_label);
}

std::string logarithmic_bars(const std::vector<LabelledBar>& bars, const std::string& axis_label) {
  constexpr double kPitch = 26, kBar = 18, kRoomForNotes = 190;
  double largest = 10;
  for (const LabelledBar& bar : bars) largest = std::max(largest, bar.value);
  const int decades = static_cast<int>(std::ceil(std::log10(largest) - 1e-9));
  SvgCanvas canvas(SvgCanvas::kTop + kPitch * static_cast<double>(bars.size()) + 48);
  const Scale x{0, static_cast<double>(decades), SvgCanvas::kLeft, SvgCanvas::kRight - kRoomForNotes};
  for (int decade = 0; decade <= decades; ++decade) {
    canvas.line(x(decade), SvgCanvas::kTop, x(decade), canvas.bottom(), "grid");
    canvas.text(x(decade), canvas.bottom() + 18, tick_label(std::pow(10, decade)), "x-tick");
  }
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const double top = SvgCanvas::kTop + kPitch * static_cast<double>(k) + 0.5 * (kPitch - kBar);
    const double length = std::max(2.0, x(std::log10(std::max(1.0, bars[k].value))) - x(0));
    canvas.rect(x(0), top, length, kBar, "blue", bars[k].label + ": " + bars[k].note);
    canvas.text(x(0) - 8, top + 13, bars[k].label, "y-tick");
    canvas.text(x(0) + length + 6, top + 13, bars[k].note, "legend");
  }
  canvas.text(0.5 * (x(0) + x(decades)), canvas.bottom() + 40, axis_label, "x-label");
  return canvas.finish(axis_label);
}

std::string histogram(const std::vector<double>& shares, double mean, const std::string& x_label,
                      const std::string& y_label) {
  const Grouping grouping(shares.size(), kMaxGroups);
  const std::vector<double> heights = grouping.means(shares);
  SvgCanvas canvas;
  const double largest = *std::max_element(heights.begin(), heights.end());
  const Scale y = canvas.vertical_axis(round_ticks(0, largest, kTicks), y_label);
  const double last = static_cast<double>(shares.size()) - 1;
  const Scale x = canvas.horizontal_axis(-0.5, last + 0.5, frame_ticks(0, std::max(1.0, last)), x_label);
  const auto pitch = static_cast<double>(grouping.per_group);
  const double width = bar_width(x, pitch);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (heights[k] <= 0) continue;
    const double center = pitch * static_cast<double>(k) + 0.5 * (pitch - 1);
    canvas.rect(x(center) - 0.5 * width, y(heights[k]), width, y(0) - y(heights[k]), "blue",
                fmt::format("{} neighbors: {} % of the atoms", readable(center), readable(heights[k])));
  }
  canvas.line(x(mean), SvgCanvas::kTop - 6, x(mean), canvas.bottom(), "mean");
  const bool label_left = x(mean) > 0.5 * (SvgCanvas::kLeft + SvgCanvas::kRight);
  canvas.text(x(mean) + (label_left ? -6 : 6), SvgCanvas::kTop - 8, "mean " + readable(mean),
              label_left ? "mean-label left" : "mean-label");
  return canvas.finish(y_label + " over " + x_label);
}

}  // namespace dch::cli
