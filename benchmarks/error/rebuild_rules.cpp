// SPDX-License-Identifier: MIT
#include "rebuild_rules.hpp"

#include <charconv>

#include <dch/base/error.hpp>
#include <dch/lists/stale_test.hpp>

namespace dch::bench {
namespace {

class CertifiedRule : public RebuildRule {
 public:
  CertifiedRule(double cutoff, double skin) : list_radius_(cutoff + skin), test_(skin) {}
  bool is_due(const std::vector<Vec3>& positions, const Box& box) override {
    return test_.is_stale(positions, box);
  }
  void remember(const std::vector<Vec3>& positions, const Box& box) override {
    test_.remember(positions, box, list_radius_);
  }
  bool is_certified() const override { return true; }

 private:
  double list_radius_;
  StaleTest test_;
};

class FixedRule : public RebuildRule {
 public:
  explicit FixedRule(int steps) : steps_(steps) {}
  bool is_due(const std::vector<Vec3>&, const Box&) override { return ++since_ >= steps_; }
  void remember(const std::vector<Vec3>&, const Box&) override { since_ = 0; }

 private:
  int steps_, since_ = 0;
};

class OpenMmRule : public RebuildRule {
 public:
  OpenMmRule(double cutoff, double skin)
      : cutoff2_(cutoff * cutoff), skin_(skin), far2_((cutoff + skin) * (cutoff + skin)) {}

  bool is_due(const std::vector<Vec3>& positions, const Box&) override {
    moved_.clear();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double moved2 = norm2(positions[i] - reference_[i]);
      if (moved2 > 0.5 * skin_ * skin_) return true;
      if (moved2 > 0.25 * skin_ * skin_) moved_.push_back(i);
    }
    return moved_.size() > positions.size() / 10 || has_new_pair(positions);
  }
  void remember(const std::vector<Vec3>& positions, const Box&) override { reference_ = positions; }

 private:
  bool has_new_pair(const std::vector<Vec3>& positions) const {
    for (std::size_t a = 0; a < moved_.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const std::size_t i = moved_[a], j = moved_[b];
        if (norm2(positions[i] - positions[j]) < cutoff2_ && norm2(reference_[i] - reference_[j]) > far2_)
          return true;
      }
    return false;
  }

  double cutoff2_, skin_, far2_;
  std::vector<Vec3> reference_;
  std::vector<std::size_t> moved_;  ///< more than skin / 2
};

constexpr std::string_view kEvery = "every:";

int steps_in(const std::string& name) {
  int steps = 0;
  const char* end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + kEvery.size(), end, steps);
  if (read.ec != std::errc() || read.ptr != end || steps < 1)
    throw Error("'" + name + "' is no rebuild rule; give the number of steps, 1 or more, as in every:20");
  return steps;
}

}  // namespace

std::unique_ptr<RebuildRule> make_rebuild_rule(const std::string& name, double cutoff, double skin) {
  if (name == "certified") return std::make_unique<CertifiedRule>(cutoff, skin);
  if (name == "openmm") return std::make_unique<OpenMmRule>(cutoff, skin);
  if (name.starts_with(kEvery)) return std::make_unique<FixedRule>(steps_in(name));
  throw Error("unknown rebuild rule '" + name + "'; there are certified, every:N and openmm");
}

std::string title_of_rule(const std::string& name) {
  if (name.starts_with(kEvery)) return "every " + std::to_string(steps_in(name)) + " steps";
  return name == "openmm" ? "OpenMM's rule" : name;
}

}  // namespace dch::bench
