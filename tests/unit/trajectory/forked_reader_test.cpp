// SPDX-License-Identifier: MIT
#include "process/forked_reader.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "error_message.hpp"
#include "reading.hpp"

namespace dch::trajectory::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// Two frames with everything in them, then whatever the test wants.
class TwoFrames final : public TrajectoryReader {
 public:
  explicit TwoFrames(std::function<bool()> at_end) : at_end_(std::move(at_end)) {}

  bool read(Frame& frame) override {
    if (frames_ == 2) return at_end_();
    frame = example(frames_);
    ++frames_;
    return true;
  }
  std::string format() const override { return "test"; }
  std::string length_unit() const override { return "furlong"; }

  static Frame example(int k) {
    Frame frame;
    frame.step = 10 + k;
    if (k == 0) {
      frame.time = 1.5;
      frame.box = Box::triclinic({5, 0, 0}, {1, 6, 0}, {2, 3, 7}, {true, false, true}, {1, 2, 3});
    }
    frame.positions = {{1, 2, 3}, {4, 5, 6}};
    frame.ids = {3, 8};
    frame.types = {1, 2};
    frame.molecules = {7, 7};
    frame.images = {{0, 1, 2}, {-1, -2, -3}};
    return frame;
  }

 private:
  std::function<bool()> at_end_;
  int frames_ = 0;
};

ForkedReader make(std::function<bool()> at_end, int seconds = 60) {
  return ForkedReader("test.xyz", [=] { return std::make_unique<TwoFrames>(at_end); },
                      {.seconds_per_frame = seconds, .rights = {}});
}

void expect_failure(std::function<bool()> at_end, const testing::Matcher<const std::string&>& message) {
  ForkedReader reader = make(std::move(at_end));
  Frame frame;
  ASSERT_TRUE(reader.read(frame));
  ASSERT_TRUE(reader.read(frame));
  EXPECT_THAT([&] { reader.read(frame); }, ThrowsMessage<FileError>(message));
  EXPECT_THROW(reader.read(frame), FileError);
}

TEST(ForkedReader, HandsFramesOn) {
  ForkedReader reader = make([] { return false; });
  EXPECT_EQ(reader.format(), "test");
  EXPECT_EQ(reader.length_unit(), "furlong");
  const auto frames = read_all(reader);
  ASSERT_EQ(frames.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    const Frame& frame = frames[static_cast<std::size_t>(k)];
    const Frame expected = TwoFrames::example(k);
    EXPECT_EQ(frame.step, expected.step);
    EXPECT_EQ(frame.time, expected.time);
    EXPECT_EQ(frame.box, expected.box);
    EXPECT_EQ(frame.positions, expected.positions);
    EXPECT_EQ(frame.ids, expected.ids);
    EXPECT_EQ(frame.types, expected.types);
    EXPECT_EQ(frame.molecules, expected.molecules);
    EXPECT_EQ(frame.images, expected.images);
  }
  Frame frame;
  EXPECT_FALSE(reader.read(frame));
}

TEST(ForkedReader, HandsErrorsOn) {
  expect_failure([]() -> bool { throw FileError("test.xyz: frame 2: broken"); }, "test.xyz: frame 2: broken");
  expect_failure([]() -> bool { throw std::runtime_error("other"); }, "test.xyz: other");
  expect_failure([]() -> bool { throw std::bad_alloc(); }, HasSubstr("does not fit into memory"));
  const ReaderFactory broken = []() -> std::unique_ptr<TrajectoryReader> {
    throw FileError("cannot be opened");
  };
  EXPECT_THAT([&] { ForkedReader("test.xyz", broken); }, ThrowsMessage<FileError>("cannot be opened"));
}

TEST(ForkedReader, SurvivesALibraryThatEndsTheProcess) {
  expect_failure(
      []() -> bool {
        std::fputs("Fatal  error:\nno such thing\n", stderr);
        std::exit(1);
      },
      AllOf(HasSubstr("test.xyz: frame 2: "),
            HasSubstr("it ended the process; its last words: Fatal error: no such thing")));
  expect_failure([]() -> bool { std::abort(); }, HasSubstr("signal 6 (Aborted)"));
  expect_failure([]() -> bool { return std::raise(SIGSEGV) == 0; }, HasSubstr("signal 11"));
  const ReaderFactory exits = []() -> std::unique_ptr<TrajectoryReader> { std::exit(0); };
  EXPECT_THAT([&] { ForkedReader("test.xyz", exits); },
              ThrowsMessage<FileError>(HasSubstr("it ended the process")));
}

double processor_seconds_of_children() {
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

// Where others work too, the patience by the clock may end before the child has had its processor time. In no
// case does it have much more.
TEST(ForkedReader, EndsEndlessLoops) {
  constexpr int kSeconds = 1;
  const double before = processor_seconds_of_children();
  {
    ForkedReader reader = make(
        []() -> bool {
          volatile bool forever = true;
          while (forever) {
          }
          return false;
        },
        kSeconds);
    Frame frame;
    ASSERT_TRUE(reader.read(frame));
    ASSERT_TRUE(reader.read(frame));
    const std::string message = ::dch::test::message_of<FileError>([&] { reader.read(frame); });
    EXPECT_THAT(message, AnyOf(HasSubstr("endless loop"), HasSubstr("no answer came (it hung")));
  }
  EXPECT_LE(processor_seconds_of_children() - before, 1.5 * kSeconds);
}

TEST(ForkedReader, DoesNotRunTheExitHandlersOfTheHost) {
  // The host's handler would write into the pipe once for each process that runs it.
  static int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  static const pid_t host = ::getpid();
  std::atexit([] {
    if (::getpid() != host) [[maybe_unused]]
      const auto done = ::write(ends[1], "x", 1);
  });
  std::fputs(" ", stdout);  // stays in the buffer, which exit() would flush a second time
  expect_failure([]() -> bool { std::exit(1); }, HasSubstr("it ended the process"));
  ::close(ends[1]);
  char byte = 0;
  EXPECT_EQ(::read(ends[0], &byte, 1), 0);
  ::close(ends[0]);
}

TEST(ForkedReader, LeavesNoProcessBehind) {
  {
    ForkedReader reader = make([]() -> bool {
      ::pause();
      return false;
    });
    Frame frame;
    EXPECT_TRUE(reader.read(frame));
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // no children at all
}

TEST(ForkedReader, LeavesSignalsOfTheTerminalToTheHost) {
  ForkedReader reader = make([]() -> bool { return std::raise(SIGINT) + std::raise(SIGTERM) != 0; });
  EXPECT_EQ(read_all(reader).size(), 2u);
}

TEST(ForkedReader, KeepsOnlyTheLatestWords) {
  expect_failure(
      []() -> bool {
        for (int k = 0; k < 10000; ++k) std::fprintf(stderr, "message %d\n", k);
        std::exit(1);
      },
      AllOf(HasSubstr("message 9999"), Not(HasSubstr("message 100 "))));
}

}  // namespace
}  // namespace dch::trajectory::test
