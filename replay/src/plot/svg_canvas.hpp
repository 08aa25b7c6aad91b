// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dch::cli {

/// A linear map from data to the picture's coordinates.
struct Scale {
  double data_low = 0, data_high = 1;
  double pixel_low = 0, pixel_high = 1;
  double operator()(double value) const {
    return pixel_low + (value - data_low) / (data_high - data_low) * (pixel_high - pixel_low);
  }
};

/// Builds an <svg> element of fixed inner size; text and lines take their colors from the page's style sheet.
class SvgCanvas {
 public:
  static constexpr double kWidth = 640;
  static constexpr double kLeft = 78,
                          kRight = 612;  ///< of the plot area; a tick at its end has room for its label
  static constexpr double kTop = 34;

  explicit SvgCanvas(double height = 300) : height_(height) {}
  double bottom() const { return height_ - 48; }  ///< of the plot area

  void text(double x, double y, const std::string& text, const char* css_class);
  void line(double x1, double y1, double x2, double y2, const char* css_class);
  /// `title` is shown on hovering.
  void rect(double x, double y, double width, double height, const std::string& color,
            const std::string& title);
  void dot(double x, double y, const std::string& color, const std::string& title);
  void polyline(const std::vector<double>& x, const std::vector<double>& y, const std::string& color);
  /// An area of the heat map's color; `outline` is the data of an SVG path.
  void area(const std::string& outline, double opacity, const std::string& title);
  /// A small triangle that points down at (x, y).
  void mark(double x, double y, const std::string& title);

  /// Grid lines and labels, downwards from zero without a sign; returns the scale.
  Scale vertical_axis(const std::vector<double>& ticks, const std::string& label);
  Scale horizontal_axis(double low, double high, const std::vector<double>& ticks, const std::string& label);
  /// Colored squares with names, right-aligned above the plot area.
  void legend(const std::vector<std::pair<std::string, std::string>>& color_and_name);

  std::string finish(const std::string& description) const;

 private:
  double height_;
  std::string body_;
};

}  // namespace dch::cli
