// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

namespace dch::cli {

/// Expects `action` to throw Exception with each of `parts` in its message.
template <class Exception, class Action>
void expect_error(Action action, std::initializer_list<std::string> parts) {
  try {
    action();
    FAIL() << "nothing was thrown";
  } catch (const Exception& error) {
    for (const std::string& part : parts) EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

}  // namespace dch::cli
