// SPDX-License-Identifier: MIT
// Velocities and accelerations of a recording by symmetric differences, in which localisation error cancels to first order.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "libtrack/tracks.h"

namespace swarmfit {

// Rows are symmetric differences in unbroken runs of three frames or more: x̄ = (x_- + x + x_+) / 3, v = (x_+ - x_-) / (2 dt),
// a = (x_+ - 2 x + x_-) / dt². Of a recording with more than 40 000 rows, equal parts of it are used, none of fewer than 200 frames (or
// all there are), and if these are still too many, every second, third, ... individual; the others remain as neighbours.
//
// Holds a reference to the tracks.
class SymmetricDifferences {
 public:
  struct Run {
    Index first, count;  // rows of one individual, a frame apart
  };

  explicit SymmetricDifferences(const Tracks& tracks);

  const Tracks& tracks() const { return tracks_; }
  std::span<const Index> rows() const { return rows_; }  // of the tracks
  std::span<const Run> runs() const { return runs_; }
  const FrameRange& frame_of(Index row) const { return tracks_.frames()[frame_of_[static_cast<std::size_t>(row)]]; }

  // Of any row of the tracks.
  bool whole(Index row) const { return before_[static_cast<std::size_t>(row)] >= 0 && next_of(row) >= 0; }  // has a frame before and after
  Eigen::Array3d x(Index row) const;  // where it was seen, if it is not whole
  Eigen::Array3d v(Index row) const;  // of a one-sided difference, if it is not whole; 0 if there is none either
  Eigen::Array3d a(Index row) const;  // of a whole one

 private:
  Index next_of(Index row) const { return tracks_.next()[static_cast<std::size_t>(row)]; }
  Eigen::Array3d position(Index row) const { return tracks_.pos().row(row).transpose(); }
  Eigen::Array3d last(Index row) const { return position(before_[static_cast<std::size_t>(row)]); }
  Eigen::Array3d next(Index row) const { return position(next_of(row)); }

  const Tracks& tracks_;
  std::vector<Index> before_;
  std::vector<std::size_t> frame_of_;
  std::vector<Index> rows_;
  std::vector<Run> runs_;
};

}  // namespace swarmfit
