// SPDX-License-Identifier: MIT
#pragma once

#include "frames/frame_decoder.hpp"

namespace dch::trajectory {

/// GROMACS TRR (GROMACS reference manual, "trr format"): a header with the sizes of the blocks that follow,
/// in single or double precision. Velocities and forces are passed over. A frame without a box has none.
class TrrDecoder final : public FrameDecoder {
 public:
  FrameExtent measure(Bytes head) const override;
  void decode(Bytes bytes, Frame& frame) const override;
};

}  // namespace dch::trajectory
