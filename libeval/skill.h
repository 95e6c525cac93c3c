// SPDX-License-Identifier: MIT
// How far is a set of tracks from the recording, on a scale that the recording itself sets?
#pragma once

#include "libeval/energy.h"
#include "libtrack/nan.h"

namespace swarmfit {

// Distances shrink with the number of samples, so all are taken between one half of the recording and the other half of the counterpart.
// The frames are cut into eight blocks of equal length; a half is four of them, and a distance is the mean over all 70 choices of four.
// Distance: total variation of histograms on the axes of Binning::standard(reference), end bins clipped, whatever the score uses.
// Immutable, shared by threads.
class HalfDistance {
 public:
  static constexpr std::size_t kBlocks = 8;
  using Blocks = std::array<PerColumn<Histogram>, kBlocks>;

  // Needs 32 frames with individuals; with fewer every distance is NaN. Throws InputError as metric_samples does.
  explicit HalfDistance(const Tracks& recording, const MetricOptions& options = {});

  // Histograms per block of frames of the recording. Nothing is differenced across the end of a block.
  Blocks blocks(const Tracks& tracks) const;
  Blocks no_blocks() const;  // without samples
  // Per column, in [0, 1]; NaN where it is undefined, in the recording or here. Columns for which `wanted` is false are NaN too.
  PerColumn<double> to(const Blocks& other, const PerColumn<bool>& wanted) const;
  PerColumn<double> to(const Blocks& other) const { return to(other, all()); }

  // The recording against itself: the least distance that can be asked for. Standard deviation over the choices of halves.
  const PerColumn<double>& floor() const { return floor_; }
  const PerColumn<double>& floor_sd() const { return floor_sd_; }
  // Of the mean over some columns; undefined, with count 0, if one of them is or none is used.
  Moments floor_over(const PerColumn<bool>& used) const;

  // All blocks pooled.
  static PerColumn<Histogram> pooled(const Blocks& blocks);
  const Blocks& recording() const { return recording_; }
  double bin_width() const;  // [sd of the recording]
  const std::vector<Column>& columns() const { return target_.columns(); }
  PerColumn<bool> all() const { return PerColumn<bool>(columns().size(), true); }

 private:
  MetricOptions options_;
  Target target_;
  std::vector<std::int64_t> first_frame_;  // of each block; empty: too few frames
  Blocks recording_;
  PerColumn<double> floor_, floor_sd_;
};

// skill = 1 - (D - D_floor)/(D_null - D_floor): 1 as close as two halves of the recording are, 0 no closer than the null, below 0 worse.
// Means over the columns with `used`; `slope` turns the standard error of D into that of the skill. NaN unless the mean null exceeds the
// mean floor.
struct SkillScale {
  double floor = kNaN, null = kNaN;  // means over the used columns
  double skill(double distance) const;
  double slope() const;  // d skill / d D, as a positive number
};
SkillScale skill_scale(const PerColumn<double>& floor, const PerColumn<double>& null, const PerColumn<bool>& used);

// Mean over the used columns; NaN if one of them is, or none is used.
double mean_used(const PerColumn<double>& values, const PerColumn<bool>& used);

}  // namespace swarmfit
