// SPDX-License-Identifier: MIT
// How much of a recording's motion is measurement error.
#pragma once

#include "libeval/metrics.h"

namespace swarmfit {

// Localisation error estimated from the positions alone.
//
// White error of variance σ² gives the m-th difference of positions the variance C(2m, m) σ²; smooth motion gives it ever less as m grows.
// So Var(Δ^m x) / C(2m, m) falls with m until it levels off at σ² (the variate difference method: Anderson 1929, Tintner 1940). Real
// accelerations that change from frame to frame level off too, so sigma is an upper bound. It is only called an error where it cannot be
// the motion: the spectrum must be white, not that of a random walk, which falls by a quarter over its upper third, and the error must show
// along the way as it does aside, in speeds that change as much as it would change them.
//
// Motion as rough as that of particles in white noise never levels off, and falls as a random walk's does. Error upon it is told by the
// memory of second differences (libeval/white_part.h), which motion of any known kind does not share.
//
// Variances are squared medians of |Δ^m x| / 0.6745: sigma is that of a normal error with the recording's bulk. Identity jumps and wild
// detections do not count, and tails heavier than the normal's are not described: on recordings that have them (the kurtosis of second
// differences is far above 3) a root mean square gives a sigma half as large again, with which no simulation looks like the recording.
//
// Smoothed positions do not level off, or level off at a wrong height; `white` is false then, and sigma only tells what smoothing left
// over.
struct Localisation {
  Eigen::Array3d sigma = Eigen::Array3d::Zero();  // standard deviation per axis [unit]; 0 where nothing can be told
  Index samples = 0;                              // differences it rests on, all axes; 0: too few unbroken stretches
  bool white = false;     // level at rising orders, white over the upper third of the spectrum, seen in speeds, and not rounding; or as
                          // white_part() has it
  bool rounding = false;  // sigma is no more than the rounding of positions in the file (libeval/rounding.h)
  double acceleration_share = 0;  // share of the squared median acceleration that this error explains, 0..1
  double jerk_share = 0;          // likewise for the jerk
};
Localisation estimate_localisation(const Tracks& tracks);

// The same positions with normal error added, independent per axis and frame: a pure function of (seed, track, frame, axis).
Tracks with_error(const Tracks& tracks, const Eigen::Array3d& sigma, std::uint64_t seed);

// Share of each column's spread (squared interquartile range) that is due to an error of this size: adds the same error once more and looks
// how far the spread rises (one step of SIMEX, Cook & Stefanski 1994). The variance itself would not do: in real recordings a few wild
// values make up most of the variance of jerks. 0 where that range, with the error, is less than a tenth of a standard deviation (by the 1
// % and 99 % quantiles), a bin of the histograms: straight flight with rare turns leaves next to nothing to its bulk, error or not, and its
// turns are what counts. 0..1;
// NaN if the metric has no spread. An angle cannot exceed pi: where error already turns headings at random, the share of omega and alpha
// comes out too small.
PerColumn<double> error_share(const Tracks& tracks, const Eigen::Array3d& sigma, std::uint64_t seed, const std::vector<int>& lags = {1});

}  // namespace swarmfit
