// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace dch::test {

/// One public header that was compiled on its own, and the language standard it was compiled as.
struct CompiledHeader {
  /// Enters itself in compiled_headers().
  CompiledHeader(const char* name, long standard);

  std::string name;
  long standard;
};

std::vector<CompiledHeader>& compiled_headers();

}  // namespace dch::test
