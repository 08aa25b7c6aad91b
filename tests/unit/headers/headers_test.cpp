// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "compiled_headers.hpp"

namespace dch::test {

CompiledHeader::CompiledHeader(const char* header, long compiled_as) : name(header), standard(compiled_as) {
  compiled_headers().push_back(*this);
}

std::vector<CompiledHeader>& compiled_headers() {
  static std::vector<CompiledHeader> headers;
  return headers;
}

namespace {

TEST(PublicHeaders, EachCompilesAlone) {
  EXPECT_EQ(compiled_headers().size(), std::size_t{DCH_HEADER_COUNT});
}

TEST(PublicHeaders, EachIsCpp17) {
  for (const CompiledHeader& header : compiled_headers()) EXPECT_EQ(header.standard, 201703L) << header.name;
}

}  // namespace

}  // namespace dch::test
