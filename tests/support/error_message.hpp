// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <string>

namespace dch::test {

/// The message of the exception that a call throws; the test fails if it throws none.
template <class Exception, class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace dch::test
