// SPDX-License-Identifier: MIT
#include "files/line_reader.hpp"

#include <cstring>
#include <fmt/format.h>
#include <utility>

#include "base/place.hpp"

namespace dch::trajectory {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;
constexpr std::size_t kFirstBuffer = std::size_t{1}
                                     << 16;  ///< pages of a longer one cost a short file most of its time

}  // namespace

LineReader::LineReader(std::string path, FinalNewline final_newline, const ReadLimits& limits)
    : path_(std::move(path)),
      final_newline_(final_newline),
      limits_(limits),
      source_(open_byte_source(path_)),
      buffer_(kFirstBuffer) {}

bool LineReader::next(std::string_view& line) {
  if (!std::exchange(again_, false)) {
    std::size_t length = find_newline();
    const bool whole = length != std::string_view::npos;
    if (!whole) length = end_ - begin_;
    if (!whole && length == 0) return false;
    ++number_;
    if (!whole && final_newline_ == FinalNewline::required) {
      fail_here(
          "the file ends inside this line: it is truncated (if it is complete, add the missing final "
          "newline)");
    }
    line_ = std::string_view(buffer_.data() + begin_, length);
    begin_ += length + (whole ? 1 : 0);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  }
  line = line_;
  return true;
}

std::size_t LineReader::find_newline() {
  std::size_t searched = 0;
  while (true) {
    const char* from = buffer_.data() + begin_ + searched;
    if (const void* found = std::memchr(from, '\n', end_ - begin_ - searched)) {
      return static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data()) - begin_;
    }
    searched = end_ - begin_;
    if (searched > kLongestLine) {
      fail_in_line(number_ + 1, "is longer than 1 MiB: this is not a text file of the expected format");
    }
    if (!fill()) return std::string_view::npos;
  }
}

bool LineReader::fill() try {
  const bool is_full = end_ == buffer_.size();
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (is_full && buffer_.size() < 2 * kLongestLine) buffer_.resize(2 * buffer_.size());
  const std::size_t got = source_->read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += got;
  if (source_->is_compressed()) count_expanded(got);
  return got > 0;
} catch (const BrokenStream& error) {
  fail_in_line(number_ + 1, error.what());
}

/// The buffer may hold the beginning of the next frame, so that a frame may be taken for one buffer longer.
void LineReader::count_expanded(std::size_t bytes) {
  expanded_ += static_cast<std::int64_t>(bytes);
  if (expanded_ <= limits_.expanded + static_cast<std::int64_t>(buffer_.size())) return;
  fail_in_line(
      number_ + 1,
      fmt::format("the compressed data expand to more than {} bytes{}: if the file is sound, raise the "
                  "limit with --max-expanded",
                  limits_.expanded, frame_ >= 0 ? " within one frame" : ""));
}

void LineReader::fail_in_line(std::int64_t line, const std::string& what) const {
  if (frame_ >= 0) fail_at_line(path_, frame_, line, what);
  fail_at_line(path_, line, what);
}

}  // namespace dch::trajectory
