// SPDX-License-Identifier: MIT
// What the file's last digit does to a recording: positions lie on a grid, and metrics can be no finer than it.
#pragma once

#include "libeval/metrics.h"

namespace swarmfit {

// Positions are origin + whole number · step, per axis [unit]. Step 0: no grid, as far as can be told.
struct Grid {
  Eigen::Array3d origin = Eigen::Array3d::Zero(), step = Eigen::Array3d::Zero();
  bool any() const { return (step > 0).any(); }
  // The grid's nearest point.
  Eigen::Array3d rounded(const Eigen::Array3d& position) const;
};

// The coarsest grid on which the positions lie: of as many decimals as nearly all of them are written with, at most nine, or of one length,
// such as a pixel, that all gaps between the values of an axis are multiples of. None along an axis on which nobody moves, or everybody by
// the same from frame to frame.
Grid rounding_grid(const Tracks& tracks);

// The metrics of a recording, and how much of each is rounding (MetricSamples::rounding): by how much it changes when positions are moved
// at random within their cells of the grid, which errs as much as rounding did. The seed of that is fixed.
MetricSamples recorded_samples(const Tracks& recording, const MetricOptions& options);

}  // namespace swarmfit
