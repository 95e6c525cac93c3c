// SPDX-License-Identifier: MIT
#pragma once

#include "libeval/rounding.h"
#include "libtrack/rng.h"

namespace swarmfit {

// What the camera would have made of a simulation: only individuals that the recording shows in a frame are seen, every seen position
// carries a localisation error of its own, and is rounded as the file's positions are. Sits between a simulation and the evaluator; ids are
// track numbers of the recording.
class Observer : public FrameSink {
 public:
  // mask: the recording whose presence and gaps are applied, or null to see everybody with an id below `tracked`. sigma: error per axis
  // [unit].
  Observer(const Tracks* mask, const Eigen::Array3d& sigma, Rng rng, FrameSink& out, std::uint32_t tracked = UINT32_MAX,
           const Grid& grid = {});
  void frame(const Snapshot& now) override;

 private:
  bool seen(std::uint32_t id) const;
  void advance_to(std::int64_t frame);

  const Tracks* mask_;
  Eigen::Array3d sigma_;
  Rng rng_;
  FrameSink& out_;
  std::uint32_t tracked_;
  Grid grid_;
  std::size_t cursor_ = 0;                  // first frame of the mask not before the present one
  std::span<const std::uint32_t> visible_;  // track numbers seen in this frame, ascending
  std::vector<Index> rows_;                 // seen in this frame
  std::vector<std::uint32_t> id_;           // buffers of the frame passed on
  std::vector<std::uint8_t> kind_;
  Rows pos_, vel_, error_;
};

}  // namespace swarmfit
