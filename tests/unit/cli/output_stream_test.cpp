// SPDX-License-Identifier: MIT
#include <csignal>
#include <sys/resource.h>

#include <dch/trajectory/file_error.hpp>

#include "expect_error.hpp"
#include "report/output_file.hpp"
#include "temporary_folder.hpp"

namespace dch::cli {
namespace {

class OutputStreamTest : public TemporaryFolder {};

TEST_F(OutputStreamTest, PrintsIntoTheFile) {
  OutputFile file(path("out"));
  OutputStream stream(file);
  std::string expected;
  for (int k = 0; k < 50000; ++k) {
    stream << k << '\n';
    expected += std::to_string(k) + '\n';
  }
  stream << std::string(200000, 'x');
  stream.flush();
  file.commit();
  EXPECT_EQ(content(path("out")), expected + std::string(200000, 'x'));
}

TEST_F(OutputStreamTest, ThrowsWhatTheFileThrows) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit full{100000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &full);
  expect_error<trajectory::FileError>(
      [&] {
        OutputFile file(path("out"));
        OutputStream stream(file);
        for (int k = 0; k < 50000; ++k) stream << k << '\n';
      },
      {path("out"), "cannot be written", "File too large"});
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace dch::cli
