// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "base/number_text.hpp"
#include "plot/axis.hpp"
#include "plot/svg_canvas.hpp"
#include "plot/svg_chart.hpp"

namespace dch::cli {
namespace {

constexpr int kShades = 8;
constexpr double kSide = 424;  ///< of the matrix as drawn; leaves room for the key
constexpr int kMapTicks = 6;

/// From values to shades, in equal steps of their logarithm.
class Shades {
 public:
  explicit Shades(const std::vector<double>& values) {
    for (const double value : values) {
      if (!(value > 0)) continue;
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    }
  }

  /// The first shade in use; there is only the last if all values are equal, and none without values.
  int first() const {
    if (high_ == 0) return kShades;
    return high_ > low_ ? 0 : kShades - 1;
  }
  /// Shade of a value, 0 .. kShades - 1; -1 for none.
  int operator()(double value) const {
    if (!(value > 0)) return -1;
    if (!(high_ > low_)) return kShades - 1;
    const double part = std::log(value / low_) / std::log(high_ / low_);
    return std::clamp(static_cast<int>(part * kShades), 0, kShades - 1);
  }
  static double opacity(int shade) { return 0.12 + 0.88 * shade / (kShades - 1); }
  /// Where a shade begins; shade kShades is the end of the last.
  double begin(int shade) const {
    return low_ * std::pow(high_ / low_, static_cast<double>(shade) / kShades);
  }
  std::string text(int shade) const { return readable(begin(shade)) + " to " + readable(begin(shade + 1)); }

 private:
  double low_ = std::numeric_limits<double>::max(), high_ = 0;
};

std::string rectangle(double left, double top, double width, double height) {
  return fmt::format("M{0:.1f} {1:.1f}h{2:.1f}v{3:.1f}h-{2:.1f}z", left, top, width, height);
}

/// One outline for each shade; cells of a row that are alike are drawn as one.
void draw_cells(SvgCanvas& canvas, const HeatMap& map, const Shades& shades, const Scale& x, const Scale& y) {
  const std::size_t size = map.edges.size() - 1;
  std::array<std::string, kShades> outlines;
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t begin = 0; begin < size;) {
      const auto shade_at = [&](std::size_t column) { return shades(map.values[row * size + column]); };
      const int shade = shade_at(begin);
      std::size_t end = begin + 1;
      while (end < size && shade_at(end) == shade) ++end;
      if (shade >= 0) {
        const double left = x(map.edges[begin]), top = y(map.edges[row]);
        outlines[static_cast<std::size_t>(shade)] +=
            rectangle(left, top, x(map.edges[end]) - left, y(map.edges[row + 1]) - top);
      }
      begin = end;
    }
  }
  for (int shade = 0; shade < kShades; ++shade) {
    const std::string& outline = outlines[static_cast<std::size_t>(shade)];
    if (!outline.empty()) canvas.area(outline, Shades::opacity(shade), shades.text(shade));
  }
}

void draw_frame(SvgCanvas& canvas, const HeatMap& map, const Scale& x, const Scale& y) {
  const double low = map.edges.front(), high = map.edges.back();
  for (const double line : map.lines) {
    canvas.line(x(line), y(low), x(line), y(high), "grid");
    canvas.line(x(low), y(line), x(high), y(line), "grid");
  }
  for (const double edge : {low, high}) {
    canvas.line(x(edge), y(low), x(edge), y(high), "tick");
    canvas.line(x(low), y(edge), x(high), y(edge), "tick");
  }
  for (const double tick : round_ticks(low, high, kMapTicks)) {
    if (tick < low || tick > high || tick != std::floor(tick)) continue;
    canvas.text(x(low) - 8, y(tick) + 4, tick_label(tick), "y-tick");
    canvas.text(x(tick), y(high) + 20, tick_label(tick), "x-tick");
  }
  canvas.text(0.5 * (x(low) + x(high)), y(high) + 40, map.axis_label, "x-label");
}

void draw_key(SvgCanvas& canvas, const Shades& shades) {
  constexpr double kStep = 22, kSquare = 14;
  const double left = SvgCanvas::kLeft + kSide + 14;
  for (int shade = shades.first(); shade < kShades; ++shade) {
    const double top = SvgCanvas::kTop + kStep * (kShades - 1 - shade);
    canvas.area(rectangle(left, top, kSquare, kSquare), Shades::opacity(shade), shades.text(shade));
    canvas.text(left + kSquare + 5, top + 12, "from " + readable(shades.begin(shade)), "legend");
  }
}

}  // namespace

std::string heat_map(const HeatMap& map) {
  SvgCanvas canvas(SvgCanvas::kTop + kSide + 48);
  const Shades shades(map.values);
  const double low = map.edges.front(), high = map.edges.back();
  const Scale x{low, high, SvgCanvas::kLeft, SvgCanvas::kLeft + kSide};
  const Scale y{low, high, SvgCanvas::kTop, SvgCanvas::kTop + kSide};
  draw_cells(canvas, map, shades, x, y);
  draw_frame(canvas, map, x, y);
  draw_key(canvas, shades);
  return canvas.finish("matrix over " + map.axis_label);
}

}  // namespace dch::cli
