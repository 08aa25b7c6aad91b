// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "plot/axis.hpp"
#include "plot/svg_canvas.hpp"
#include "plot/svg_chart.hpp"

namespace dch::cli {
namespace {

/// Whole decades around data.
struct Decades {
  int low = 0, high = 1;

  void take(double value, bool is_first) {
    const int below = static_cast<int>(std::floor(std::log10(value)));
    const int above = static_cast<int>(std::ceil(std::log10(value)));
    low = is_first ? below : std::min(low, below);
    high = is_first ? std::max(above, below + 1) : std::max(high, above);
  }
  Scale scale(double pixel_low, double pixel_high) const {
    return {static_cast<double>(low), static_cast<double>(high), pixel_low, pixel_high};
  }
  /// Powers of ten; 2 and 5 times them too where there are few.
  std::vector<double> ticks() const {
    std::vector<double> values;
    for (int decade = low; decade <= high; ++decade) {
      const double power = std::pow(10, decade);
      values.push_back(power);
      if (high - low > 2 || decade == high) continue;
      values.push_back(2 * power);
      values.push_back(5 * power);
    }
    return values;
  }
};

void draw_axes(SvgCanvas& canvas, const LogChart& chart, const Decades& x_decades, const Scale& x,
               const Decades& y_decades, const Scale& y) {
  for (const double tick : y_decades.ticks()) {
    const double at = y(std::log10(tick));
    canvas.line(SvgCanvas::kLeft, at, SvgCanvas::kRight, at, "grid");
    canvas.text(SvgCanvas::kLeft - 8, at + 4, tick_label(tick), "y-tick");
  }
  for (const double tick : x_decades.ticks()) {
    const double at = x(std::log10(tick));
    canvas.line(at, SvgCanvas::kTop, at, canvas.bottom(), "grid");
    canvas.text(at, canvas.bottom() + 20, tick_label(tick), "x-tick");
  }
  canvas.text(SvgCanvas::kLeft - 8, 16, chart.y_label, "y-label");
  canvas.text(0.5 * (SvgCanvas::kLeft + SvgCanvas::kRight), canvas.bottom() + 40, chart.x_label, "x-label");
}

}  // namespace

std::string log_log_chart(const LogChart& chart) {
  std::vector<LogPoint> points;
  Decades x_decades, y_decades;
  for (const LogPoint& point : chart.points) {
    const bool drawable = point.x > 0 && point.y > 0 && std::isfinite(point.x) && std::isfinite(point.y);
    if (!drawable) continue;
    x_decades.take(point.x, points.empty());
    y_decades.take(point.y, points.empty());
    points.push_back(point);
  }
  SvgCanvas canvas(360);
  const Scale x = x_decades.scale(SvgCanvas::kLeft, SvgCanvas::kRight);
  const Scale y = y_decades.scale(canvas.bottom(), SvgCanvas::kTop);
  draw_axes(canvas, chart, x_decades, x, y_decades, y);
  std::vector<double> px, py;
  for (const LogPoint& point : points) {
    px.push_back(x(std::log10(point.x)));
    py.push_back(y(std::log10(point.y)));
  }
  canvas.polyline(px, py, "blue");
  for (std::size_t k = 0; k < points.size(); ++k) canvas.dot(px[k], py[k], "blue", points[k].title);
  return canvas.finish(chart.y_label + " over " + chart.x_label);
}

}  // namespace dch::cli
