// SPDX-License-Identifier: MIT
//
// Reports of the command when memory runs out while they are written. A value of the JSON library may take
// memory to be destroyed, where an exception cannot leave: the command has a handler for that, which ends it
// with a message. So each attempt is made in a process of its own, with a handler like that; what must not
// happen is another end.
#include <cstdlib>
#include <exception>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "failing_memory.hpp"
#include "report/contact_report.hpp"
#include "report/replay_report.hpp"

namespace dch::cli {
namespace {

using faults::FailingMemory;
using faults::Shortage;

constexpr int kNothingFailed = 0, kThrew = 1, kLostException = 2, kDidWithout = 3, kWrong = 4;

template <class Render>
int status_with(const Render& render, const std::string& whole, long allocation, Shortage shortage) {
  const pid_t child = fork();
  if (child == 0) {
    std::set_terminate([] { _exit(kLostException); });
    std::string text;
    bool has_failed = false, threw = false;
    {
      const FailingMemory memory(allocation, shortage);
      try {
        text = render();
      } catch (const std::exception&) {
        threw = true;
      }
      has_failed = memory.has_failed();
    }
    if (threw) _exit(has_failed ? kThrew : kWrong);
    if (text != whole) _exit(kWrong);
    _exit(has_failed ? kDidWithout : kNothingFailed);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

template <class Render>
void expect_sound_text(const Render& render, long least_failures) {
  const std::string whole = render();
  ASSERT_GT(whole.size(), 100u);
  for (const Shortage shortage : {Shortage::once, Shortage::lasting}) {
    long failures = 0;
    int status = kThrew;
    for (; status != kNothingFailed; ++failures) {
      status = status_with(render, whole, failures, shortage);
      ASSERT_GE(status, 0) << "allocation " << failures << ": ended by a signal";
      ASSERT_LT(status, kWrong) << "allocation " << failures;
    }
    EXPECT_GE(failures, least_failures);
  }
}

TEST(ReportFaults, JsonOfAReplay) {
  ReplayReport report;
  report.file = "a trajectory with a name that needs memory.lammpstrj";
  report.frames.resize(2);
  report.levels.resize(2);
  report.verify.mode = VerifyMode::all;
  report.verify.frames = {0, 1};
  Mismatch mismatch;
  mismatch.what = "missing";
  report.verify.first.push_back(mismatch);
  IntervalRecord interval;
  interval.undetermined = "a reason of more letters than a short text takes";
  report.between.emplace().add(interval, {}, 1);
  expect_sound_text([&] { return render_json(report); }, 300);
}

TEST(ReportFaults, JsonOfContacts) {
  ContactReport report;
  report.frames.resize(2);
  expect_sound_text([&] { return render_json(report); }, 200);
}

}  // namespace
}  // namespace dch::cli
