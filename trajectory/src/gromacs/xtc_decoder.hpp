// SPDX-License-Identifier: MIT
#pragma once

#include "frames/frame_decoder.hpp"

namespace dch::trajectory {

/// GROMACS XTC (GROMACS reference manual, "xtc format"): a header, the box, and the coordinates as integers,
/// the multiples of 1/precision, in a bit stream; up to nine atoms as they are. Magic 1995, and 2023 of
/// GROMACS 2023 and later for above 3e8 atoms, where the length of the stream has 64 bits.
///
/// A coordinate outside of the range that the header gives is an error: writers take the range from all of
/// the frame's coordinates.
class XtcDecoder final : public FrameDecoder {
 public:
  FrameExtent measure(Bytes head) const override;
  void decode(Bytes bytes, Frame& frame) const override;
};

}  // namespace dch::trajectory
