// SPDX-License-Identifier: MIT
#include "fit/synthesis/recorded_velocities.h"

namespace swarmfit {

RecordedVelocities::RecordedVelocities(const Tracks& recording) : recording_(recording) {
  for (Index row = 0; row < recording.rows(); ++row)
    if (recording.next()[static_cast<std::size_t>(row)] >= 0) moving_.push_back(row);
}

Eigen::Array3d RecordedVelocities::at(double u) const {
  const Index from = moving_[static_cast<std::size_t>(u * static_cast<double>(moving_.size()))];
  const Index to = recording_.next()[static_cast<std::size_t>(from)];
  return (recording_.pos().row(to) - recording_.pos().row(from)).transpose() / recording_.dt();
}

}  // namespace swarmfit
