// SPDX-License-Identifier: MIT
//
// Does a sweep find what it is there for?
#include "sweep.hpp"

#include <memory>
#include <new>
#include <vector>

namespace dch::faults {
namespace {

/// Two arrays that have to be equally long.
struct TwoArrays {
  std::vector<int> first, second;

  /// Records in its first step that there is room.
  void grow_and_believe(std::size_t n) {
    if (first.size() >= n) return;
    first.resize(n);
    second.resize(n);
  }
  /// Records it in its last step.
  void grow_and_see(std::size_t n) {
    if (second.size() >= n) return;
    first.resize(n);
    second.resize(n);
  }
};

template <class Grow>
SweepResult sweep_of(const Grow& grow) {
  return sweep([] { return TwoArrays(); }, grow,
               [&](TwoArrays& arrays, Ending) -> std::string {
                 grow(arrays);
                 return arrays.second.size() == arrays.first.size() ? "" : "one is shorter";
               },
               1);
}

TEST(FaultSweep, FindsAnArrayThatIsTooShort) {
  const SweepResult found = sweep_of([](TwoArrays& arrays) { arrays.grow_and_believe(8); });
  EXPECT_EQ(found.failures, 4);  // two allocations, each failing once and for good
  ASSERT_EQ(found.faults.size(), 2u);
  EXPECT_EQ(found.faults[0], "allocation 1: one is shorter");
  EXPECT_EQ(found.faults[1], "allocation 1 and all after it: one is shorter");
  expect_sound(sweep_of([](TwoArrays& arrays) { arrays.grow_and_see(8); }), 4);
}

/// A cache line, for which operator new has a form of its own.
struct alignas(64) Line {
  char bytes[64];
};

TEST(FaultSweep, FailsEveryFormOfNew) {
  struct Kept {
    std::unique_ptr<int> one;
    std::unique_ptr<int[]> some;
    std::unique_ptr<Line> line;
    std::unique_ptr<Line[]> lines;
  };
  const auto allocate = [](Kept& kept) {
    kept.one.reset(new int(1));
    kept.some.reset(new int[3]());
    kept.line.reset(new Line());
    kept.lines.reset(new Line[3]());
  };
  const SweepResult throwing =
      sweep([] { return Kept(); }, allocate,
            [](const Kept& kept, Ending ending) -> std::string {
              return (kept.lines != nullptr) == (ending == Ending::returned) ? "" : "it went on";
            },
            1);
  expect_sound(throwing, 8);
  const SweepResult silent = sweep(
      [] { return Kept(); },
      [](Kept& kept) {
        kept.one.reset(new (std::nothrow) int(1));
        kept.some.reset(new (std::nothrow) int[3]());
        kept.line.reset(new (std::nothrow) Line());
        kept.lines.reset(new (std::nothrow) Line[3]());
      },
      [](const Kept&, Ending ending) -> std::string { return ending == Ending::returned ? "" : "it threw"; },
      1);
  expect_sound(silent, 8);
}

}  // namespace
}  // namespace dch::faults
