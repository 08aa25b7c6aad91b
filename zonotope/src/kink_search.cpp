// SPDX-License-Identifier: MIT
#include "kink_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "vectors.hpp"

namespace dch::zonotope {
namespace {

constexpr int kAstray = 8;  // vertices that rounding puts outside of the strip, in all

/// The line y = slope x + height, and its weight b.
struct Line {
  double a, weight, slope, height;
  std::size_t index;

  double at(double x) const { return slope * x + height; }
};

struct Turn {
  double cosine, sine;

  double a(const KinkLine& line) const { return line.a * cosine + line.b * sine; }
  double b(const KinkLine& line) const { return line.b * cosine - line.a * sine; }
};

/// An angle by which the plane is turned so that no line is nearly vertical. Each of n lines forbids a share
/// of 1 / (4 pi n) of the angles, so that one of the first few will do.
Turn turn_for(Span<const KinkLine> lines) {
  const double least = 1 / (8 * static_cast<double>(lines.size()));
  Turn turn{1, 0};
  for (int k = 1; k <= 64; ++k) {
    const double angle = 0.7 + 1.9416 * k;  // multiples of an angle that is no simple fraction of a circle
    turn = {std::cos(angle), std::sin(angle)};
    if (std::all_of(lines.begin(), lines.end(), [&](const KinkLine& line) {
          return std::abs(turn.b(line)) >= least * std::hypot(line.a, line.b);
        }))
      break;
  }
  return turn;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Uniform below count, but for a bias of count / 2^64 (G. Steele et al., SplitMix64).
  std::int64_t below(std::int64_t count) {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(count));
  }

 private:
  std::uint64_t state_;
};

class Search {
 public:
  Search(Span<const KinkLine> lines, std::uint64_t seed) : turn_(turn_for(lines)), random_(seed) {
    for (std::size_t k = 0; k < lines.size(); ++k) {
      double a = turn_.a(lines[k]), b = turn_.b(lines[k]), c = lines[k].c;
      if (b == 0) continue;  // both are 0: a constant
      if (b < 0) a = -a, b = -b, c = -c;
      lines_.push_back({a, b, -a / b, -c / b, k});
    }
  }

  KinkMinimum run() {
    if (lines_.empty()) return result_;
    low_ = sorted(-kInfinite);
    high_ = sorted(kInfinite);
    const std::int64_t first = inversions(-1);
    if (first == 0) {  // all are parallel
      look_at(0);
      return turned_back();
    }
    int astray = 0;
    for (std::int64_t left = first; left > 0; left = inversions(-1)) {
      inversions(random_.below(left));
      const double x =
          (found_->second->height - found_->first->height) / (found_->first->slope - found_->second->slope);
      if (!(x > low_x_ && x < high_x_)) {  // rounding has it outside
        if (++astray > kAstray) break;
        continue;
      }
      const int side = look_at(x);
      if (side == 0) break;
      settle(x, side > 0);
      (side < 0 ? high_x_ : low_x_) = x;
      (side < 0 ? high_ : low_) = std::move(order_);
    }
    return turned_back();
  }

 private:
  using Order = std::vector<const Line*>;

  /// The lines from below along a vertical line, or just right of it where they meet.
  Order sorted(double x) {
    Order order;
    for (const Line& line : lines_) order.push_back(&line);
    const auto is_below = [&](const Line* a, const Line* b) {
      ++result_.operations;
      if (std::isfinite(x)) {
        const double y_a = a->at(x), y_b = b->at(x);
        if (y_a != y_b) return y_a < y_b;
        return a->slope != b->slope ? a->slope < b->slope : a->index < b->index;
      }
      if (a->slope != b->slope) return (a->slope < b->slope) == (x > 0);
      return a->height != b->height ? a->height < b->height : a->index < b->index;
    };
    std::sort(order.begin(), order.end(), is_below);
    return order;
  }

  /// Puts lines that meet at a border to rounding into their order within the strip, to the right of it or to
  /// the left: else vertices on the border would count as ones of the strip, and where many lines meet hide
  /// those that are.
  void settle(double x, bool is_right) {
    const auto rounding = [&](const Line* line) {
      return 8 * 0x1p-53 * (std::abs(line->slope * x) + std::abs(line->height));
    };
    for (std::size_t first = 0, last = 1; first < order_.size(); first = last++) {
      for (; last < order_.size(); ++last) {
        const Line *below = order_[last - 1], *above = order_[last];
        if (above->at(x) - below->at(x) > rounding(below) + rounding(above)) break;
      }
      std::sort(order_.begin() + static_cast<std::ptrdiff_t>(first),
                order_.begin() + static_cast<std::ptrdiff_t>(last), [&](const Line* a, const Line* b) {
                  ++result_.operations;
                  if (a->slope != b->slope) return (a->slope < b->slope) == is_right;
                  return a->height != b->height ? a->height < b->height : a->index < b->index;
                });
    }
  }

  /// How many pairs stand in another order along high_ than along low_; the one with the given number is
  /// found_.
  std::int64_t inversions(std::int64_t wanted) {
    rank_.resize(lines_.size());
    for (std::size_t k = 0; k < high_.size(); ++k)
      rank_[static_cast<std::size_t>(high_[k] - lines_.data())] = k;
    merged_ = low_;
    buffer_.resize(merged_.size());
    wanted_ = wanted;
    return merge_sort(0, merged_.size());
  }

  std::size_t rank(const Line* line) const { return rank_[static_cast<std::size_t>(line - lines_.data())]; }

  std::int64_t merge_sort(std::size_t first, std::size_t last) {
    if (last - first < 2) return 0;
    const std::size_t middle = first + (last - first) / 2;
    std::int64_t count = merge_sort(first, middle);
    count += merge_sort(middle, last);
    std::size_t left = first, right = middle;
    for (std::size_t k = first; k < last; ++k) {
      ++result_.operations;
      if (right == last || (left < middle && rank(merged_[left]) < rank(merged_[right]))) {
        buffer_[k] = merged_[left++];
        continue;
      }
      const auto crossed = static_cast<std::int64_t>(middle - left);
      if (wanted_ >= 0 && wanted_ < crossed)
        found_ = {merged_[left + static_cast<std::size_t>(wanted_)], merged_[right]};
      wanted_ -= crossed;  // below 0 when it has been found, or was never wanted
      count += crossed;
      buffer_[k] = merged_[right++];
    }
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(first),
              buffer_.begin() + static_cast<std::ptrdiff_t>(last),
              merged_.begin() + static_cast<std::ptrdiff_t>(first));
    return count;
  }

  /// The minimum on the vertical line at x; tells on which side of it smaller values are: -1, 0 or 1.
  int look_at(double x) {
    ++result_.rounds;
    order_ = sorted(x);
    double slope = 0, gradient = 0;  // along y, and along x from above all kinks that were passed
    for (const Line* line : order_) {
      slope -= line->weight;
      gradient -= line->a;
    }
    std::size_t k = 0;
    for (; k + 1 < order_.size() && slope + 2 * order_[k]->weight < 0; ++k) {
      slope += 2 * order_[k]->weight;
      gradient += 2 * order_[k]->a;
    }
    result_.operations += static_cast<std::int64_t>(3 * order_.size());
    const Line& line = *order_[k];
    const double y = line.at(x), value = value_at(x, y);
    if (value < least_) {
      least_ = value;
      result_.x = x;
      result_.y = y;
      result_.line = line.index;
    }
    // Along this line, on which its own term stays 0: where the minimum is on one side, values fall along it
    // there.
    const double rate = gradient + line.a + (slope + line.weight) * line.slope;
    return rate > 0 ? -1 : rate < 0 ? 1 : 0;
  }

  double value_at(double x, double y) const {
    double sum = 0;
    for (const Line& line : lines_) sum += line.weight * std::abs(y - line.at(x));
    return sum;
  }

  KinkMinimum turned_back() const {
    KinkMinimum result = result_;
    result.x = turn_.cosine * result_.x - turn_.sine * result_.y;
    result.y = turn_.sine * result_.x + turn_.cosine * result_.y;
    return result;
  }

  Turn turn_;
  Random random_;
  std::vector<Line> lines_;
  Order low_, high_, order_, merged_, buffer_;
  double low_x_ = -kInfinite, high_x_ = kInfinite, least_ = kInfinite;
  std::vector<std::size_t> rank_;
  std::int64_t wanted_ = -1;
  std::optional<std::pair<const Line*, const Line*>> found_;
  KinkMinimum result_;
};

}  // namespace

KinkMinimum least_kinks(Span<const KinkLine> lines, std::uint64_t seed) { return Search(lines, seed).run(); }

}  // namespace dch::zonotope
