// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <exception>
#include <gtest/gtest.h>
#include <new>
#include <string>
#include <vector>

#include <dch/base/error.hpp>

#include "failing_memory.hpp"

namespace dch::faults {

/// Which allocations fail: each, or each third one under the address and the thread sanitizer, which take ten
/// times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr long kEach = 3;
#else
inline constexpr long kEach = 1;
#endif

struct SweepResult {
  long failures = 0;                ///< calls during which an allocation failed
  long allocations = 0;             ///< that the sweep went over
  std::vector<std::string> faults;  ///< what was wrong afterwards
};

/// How a call ended.
enum class Ending { returned, threw };

/// Makes a call again and again, each time with a later one of its allocations failing, until none does.
/// @param make returns what the call is made on, each time afresh
/// @param call the call, as call(subject)
/// @param fault_of as fault_of(subject, ending): with memory there again, what is wrong, in words; empty if
///   nothing is
/// @param each the first of so many allocations fails
template <class Make, class Call, class FaultOf>
SweepResult sweep(const Make& make, const Call& call, const FaultOf& fault_of, long each = kEach) {
  constexpr std::size_t kEnough = 5;  // faults to know
  SweepResult result;
  for (const Shortage shortage : {Shortage::once, Shortage::lasting}) {
    bool has_failed = true;
    for (long k = 0; has_failed && result.faults.size() < kEnough; k += each) {
      auto subject = make();
      std::string fault;
      Ending ending = Ending::threw;
      {
        const FailingMemory memory(k, shortage);
        try {
          call(subject);
          ending = Ending::returned;
        } catch (const std::bad_alloc&) {
        } catch (const Error&) {
        } catch (const std::exception&) {
          fault = "it threw neither bad_alloc nor Error";
        }
        has_failed = memory.has_failed();
      }
      if (fault.empty() && ending == Ending::threw && !has_failed) fault = "it threw, though nothing failed";
      if (fault.empty()) fault = fault_of(subject, ending);
      result.failures += has_failed;
      result.allocations += each * has_failed;
      if (!fault.empty())
        result.faults.push_back("allocation " + std::to_string(k) +
                                (shortage == Shortage::once ? ": " : " and all after it: ") + fault);
    }
  }
  return result;
}

/// Says what was wrong, and how many failures were injected by this test so far.
inline void report(const SweepResult& result) {
  static const ::testing::TestInfo* test = nullptr;
  static long failures = 0;
  const auto* const now = ::testing::UnitTest::GetInstance()->current_test_info();
  if (test != now) failures = 0;
  test = now;
  failures += result.failures;
  for (const std::string& fault : result.faults) ADD_FAILURE() << fault;
  std::printf("%ld failures injected so far\n", failures);
  ::testing::Test::RecordProperty("failures", std::to_string(failures));
}

/// Has a test fail if something was wrong, or if the calls take so little memory that the sweep shows little.
/// @param least_allocations at least 1; see expect_no_memory()
inline void expect_sound(const SweepResult& result, long least_allocations) {
  report(result);
  ASSERT_GE(least_allocations, 1);
  EXPECT_GE(result.allocations, least_allocations);
}

/// Has a test fail if something was wrong, or if the call takes memory at all.
inline void expect_no_memory(const SweepResult& result) {
  report(result);
  EXPECT_EQ(result.allocations, 0) << "it takes memory";
}

}  // namespace dch::faults
