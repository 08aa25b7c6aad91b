// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <dch/trajectory/reader.hpp>

#include "files/byte_source.hpp"

namespace dch::trajectory {

/// Whether a text file must end in a newline. Where it must, a file cut inside its last number is recognized.
enum class FinalNewline { required, optional };

/// The lines of a text file, gzip-compressed or not. Memory: one buffer, whatever the size of the file.
class LineReader {
 public:
  /// @throws FileError as open_byte_source.
  LineReader(std::string path, FinalNewline final_newline, const ReadLimits& limits);

  /// Gets the next line, without its end (LF or CR LF); valid until the next call. False at the end of the
  /// file.
  /// @throws FileError if a line is longer than 1 MiB (not a text file), the final newline is missing, or
  /// compressed
  ///   data are broken or expand to more than the limit within a frame.
  bool next(std::string_view& line);

  /// Makes the next call of next() return the same line again.
  void put_back() { again_ = true; }

  /// The frame that begins here and that messages name; none before the first call.
  void set_frame(std::int64_t frame) {
    frame_ = frame;
    expanded_ = 0;
  }

  /// Number of the line that next() returned last, from 1.
  std::int64_t number() const { return number_; }
  const std::string& path() const { return path_; }

  /// Throws FileError naming the file, the frame if there is one, and a line (by default the one read last).
  [[noreturn]] void fail_here(const std::string& what) const { fail_in_line(number_, what); }
  [[noreturn]] void fail_in_line(std::int64_t line, const std::string& what) const;

 private:
  /// Length of the line at begin_, reading on until its newline is in the buffer; npos if the file ends
  /// before.
  std::size_t find_newline();
  bool fill();
  void count_expanded(std::size_t bytes);

  std::string path_;
  FinalNewline final_newline_;
  ReadLimits limits_;
  std::unique_ptr<ByteSource> source_;
  std::int64_t expanded_ = 0;  ///< bytes of compressed data since the frame began
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  ///< unread bytes are buffer_[begin_, end_)
  std::size_t end_ = 0;
  std::string_view line_;
  std::int64_t number_ = 0;
  std::int64_t frame_ = -1;
  bool again_ = false;
};

}  // namespace dch::trajectory
