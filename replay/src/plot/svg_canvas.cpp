// SPDX-License-Identifier: MIT
#include "plot/svg_canvas.hpp"

#include <cmath>
#include <fmt/format.h>

#include "plot/axis.hpp"
#include "plot/svg_chart.hpp"

namespace dch::cli {

std::string escape_html(const std::string& text) {
  std::string escaped;
  for (const char character : text) {
    switch (character) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(character) >= 0x20) escaped += character;
    }
  }
  return escaped;
}

void SvgCanvas::text(double x, double y, const std::string& text, const char* css_class) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\">{}</text>\n", x, y, css_class,
                       escape_html(text));
}

void SvgCanvas::line(double x1, double y1, double x2, double y2, const char* css_class) {
  body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1,
                       y1, x2, y2, css_class);
}

void SvgCanvas::rect(double x, double y, double width, double height, const std::string& color,
                     const std::string& title) {
  body_ += fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
      "class=\"{}\"><title>{}</title></rect>\n",
      x, y, width, height, color, escape_html(title));
}

void SvgCanvas::dot(double x, double y, const std::string& color, const std::string& title) {
  body_ +=
      fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" class=\"{}\"><title>{}</title></circle>\n",
                  x, y, color, escape_html(title));
}

void SvgCanvas::polyline(const std::vector<double>& x, const std::vector<double>& y,
                         const std::string& color) {
  body_ += fmt::format("<polyline class=\"line-{}\" points=\"", color);
  for (std::size_t k = 0; k < x.size(); ++k) body_ += fmt::format("{:.1f},{:.1f} ", x[k], y[k]);
  body_ += "\"/>\n";
}

void SvgCanvas::area(const std::string& outline, double opacity, const std::string& title) {
  body_ += fmt::format("<path class=\"heat\" fill-opacity=\"{:.2f}\" d=\"{}\"><title>{}</title></path>\n",
                       opacity, outline, escape_html(title));
}

void SvgCanvas::mark(double x, double y, const std::string& title) {
  body_ += fmt::format("<path d=\"M{:.1f} {:.1f} l-4 -7 h8 z\" class=\"mark\"><title>{}</title></path>\n", x,
                       y, escape_html(title));
}

Scale SvgCanvas::vertical_axis(const std::vector<double>& ticks, const std::string& label) {
  const Scale scale{ticks.front(), ticks.back(), bottom(), kTop};
  for (const double tick : ticks) {
    line(kLeft, scale(tick), kRight, scale(tick), tick == 0 ? "zero" : "grid");
    text(kLeft - 8, scale(tick) + 4, tick_label(std::abs(tick)), "y-tick");
  }
  text(kLeft - 8, 16, label, "y-label");
  return scale;
}

Scale SvgCanvas::horizontal_axis(double low, double high, const std::vector<double>& ticks,
                                 const std::string& label) {
  const Scale scale{low, high, kLeft, kRight};
  for (const double tick : ticks) {
    if (tick < low || tick > high) continue;
    line(scale(tick), bottom(), scale(tick), bottom() + 5, "tick");
    text(scale(tick), bottom() + 20, tick_label(tick), "x-tick");
  }
  line(kLeft, bottom(), kRight, bottom(), "tick");
  text(0.5 * (kLeft + kRight), bottom() + 40, label, "x-label");
  return scale;
}

void SvgCanvas::legend(const std::vector<std::pair<std::string, std::string>>& color_and_name) {
  constexpr double kCharacterWidth = 7, kSquare = 11, kGap = 18;
  double x = kRight;
  for (auto entry = color_and_name.rbegin(); entry != color_and_name.rend(); ++entry) {
    x -= kCharacterWidth * static_cast<double>(entry->second.size());
    text(x, 16, entry->second, "legend");
    x -= kSquare + 5;
    if (entry->first == "mark") {
      mark(x + 6, 15, entry->second);
    } else {
      rect(x, 6, kSquare, kSquare, entry->first, entry->second);
    }
    x -= kGap;
  }
}

std::string SvgCanvas::finish(const std::string& description) const {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n", kWidth,
                     height_, escape_html(description), body_);
}

}  // namespace dch::cli
