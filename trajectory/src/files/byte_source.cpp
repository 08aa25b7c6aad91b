// SPDX-License-Identifier: MIT
#include "files/byte_source.hpp"

#include <vector>
#include <zlib.h>

#include "base/place.hpp"
#include "files/input_file.hpp"

namespace dch::trajectory {
namespace {

class PlainSource final : public ByteSource {
 public:
  explicit PlainSource(InputFile file) : file_(std::move(file)) {}
  std::size_t read(char* data, std::size_t size) override { return file_.read_some(data, size); }

 private:
  InputFile file_;
};

/// Unpacks one gzip member after the other. zlib's own gzread() is not used because it takes garbage after
/// the first member for a normal end.
class GzipSource final : public ByteSource {
 public:
  explicit GzipSource(InputFile file) : file_(std::move(file)), buffer_(std::size_t{1} << 16) {
    constexpr int kGzipOnly = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK)
      fail(file_.path(), "zlib cannot be set up (out of memory?)");
  }
  ~GzipSource() override { inflateEnd(&stream_); }
  GzipSource(const GzipSource&) = delete;
  GzipSource& operator=(const GzipSource&) = delete;

  std::size_t read(char* data, std::size_t size) override {
    stream_.next_out = reinterpret_cast<Bytef*>(data);
    stream_.avail_out = static_cast<uInt>(size);
    while (stream_.avail_out == size) {
      if (stream_.avail_in == 0 && !refill()) {
        if (inside_member_) throw BrokenStream("the compressed data end early: the file is truncated");
        return 0;
      }
      inside_member_ = true;
      unpack();
    }
    return size - stream_.avail_out;
  }
  bool is_compressed() const override { return true; }

 private:
  bool refill() {
    const std::size_t got = file_.read_some(buffer_.data(), buffer_.size());
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
    stream_.avail_in = static_cast<uInt>(got);
    return got > 0;
  }

  void unpack() {
    const int status = inflate(&stream_, Z_NO_FLUSH);
    if (status == Z_STREAM_END) {
      inside_member_ = false;
      inflateReset(&stream_);
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw BrokenStream(std::string("the compressed data are broken (zlib: ") +
                         (stream_.msg != nullptr ? stream_.msg : "no reason given") + ")");
    }
  }

  InputFile file_;
  std::vector<char> buffer_;
  z_stream stream_{};
  bool inside_member_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> open_byte_source(const std::string& path) {
  InputFile file(path);
  if (file.starts_with("\x1f\x8b")) return std::make_unique<GzipSource>(std::move(file));
  return std::make_unique<PlainSource>(std::move(file));
}

}  // namespace dch::trajectory
