// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>

#include <dch/trajectory/output_file.hpp>

namespace dch::cli {

using trajectory::OutputFile;

/// Nothing if no name was given. @throws trajectory::FileError.
inline std::unique_ptr<OutputFile> open_output(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<OutputFile>(path);
}

/// Where an OutputStream puts its bytes.
class OutputBuffer final : public std::streambuf {
 public:
  explicit OutputBuffer(OutputFile& file) : file_(file) { start(); }

 private:
  void start() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }
  int_type overflow(int_type byte) override {
    sync();
    if (traits_type::eq_int_type(byte, traits_type::eof())) return traits_type::not_eof(byte);
    return sputc(traits_type::to_char_type(byte));
  }
  int sync() override {
    file_.write({pbase(), static_cast<std::size_t>(pptr() - pbase())});
    start();
    return 0;
  }

  OutputFile& file_;
  std::array<char, 1 << 16> bytes_{};
};

/// A stream into an output file, for what is printed to streams; flush() it before commit(). All that prints
/// throws trajectory::FileError, the disk being full, say.
class OutputStream final : public std::ostream {
 public:
  explicit OutputStream(OutputFile& file) : std::ostream(nullptr), buffer_(file) {
    rdbuf(&buffer_);
    exceptions(badbit);  // lets the file's own errors through
  }

 private:
  OutputBuffer buffer_;
};

}  // namespace dch::cli
