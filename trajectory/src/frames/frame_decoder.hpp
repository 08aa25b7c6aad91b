// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include <dch/trajectory/frame.hpp>

namespace dch::trajectory {

using Bytes = std::span<const unsigned char>;

/// Bytes that are no frame of their format. The reader turns it into a FileError with file and frame.
class BrokenFrame : public std::runtime_error {
 public:
  /// @param offset of what is wrong, from the first byte of the frame
  BrokenFrame(std::int64_t offset, const std::string& what) : std::runtime_error(what), offset_(offset) {}
  std::int64_t offset() const { return offset_; }

 private:
  std::int64_t offset_;
};

/// What the header of a frame tells.
struct FrameExtent {
  std::int64_t atoms = 0;
  bool has_positions = true;
  std::int64_t needed = 0;  ///< bytes from the first of the frame up to the last that decode() looks at
  std::int64_t total = 0;   ///< bytes of the whole frame
};

/// Decodes the frames of one binary format from bytes in memory: no files, no state, no memory but the
/// frame's. Any bytes may be handed in; every access is checked.
class FrameDecoder {
 public:
  virtual ~FrameDecoder() = default;

  /// Bytes that measure() looks at, at most.
  static constexpr std::size_t kLongestHeader = 128;

  /// The extent of the frame that begins with these bytes: kLongestHeader of them, or all up to the end of
  /// the file. Atoms are at most kMaxAtomsPerByte times `needed`.
  /// @throws BrokenFrame.
  virtual FrameExtent measure(Bytes head) const = 0;
  static constexpr std::int64_t kMaxAtomsPerByte = 4;

  /// Step, time, box and positions of a frame that has positions; ids and the rest are left alone.
  /// @param bytes the first `needed` ones of the frame
  /// @throws BrokenFrame; InvalidBox.
  virtual void decode(Bytes bytes, Frame& frame) const = 0;
};

}  // namespace dch::trajectory
