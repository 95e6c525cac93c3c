// SPDX-License-Identifier: MIT
// Samples of recorded motion: what FASTSWARM chooses its velocities among.
// W. Xiang et al., FASTSWARM: A data-driven framework for real-time flying insect swarm simulation, Comput. Anim. Virtual Worlds 31: e1957,
// 2020 (doi:10.1002/cav.1957), section 3.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "libtrack/rng.h"
#include "libtrack/tracks.h"

namespace swarmfit {

struct ReferenceOptions {
  std::size_t samples = 300;  // k, >= 10; all there are if there are fewer
  std::size_t groups = 10;    // of equal size, by speed; 1 .. samples
  bool yaw = false;           // each sample is turned about the vertical, z, by a random angle: 300 directions are few
};

// k velocities of a recording, each with the acceleration that followed it, sorted by speed and cut into groups. Immutable.
//
// Forward differences within unbroken tracklets of at least three frames: v_k = (p_{k+1} - p_k) / dt and a_k = v_{k+1} - v_k, a change of
// velocity per frame. All of them are sorted by speed and cut into k strata of equal size, and one is drawn from each: the paper does not
// say how its 300 were chosen. One set per recording: recordings are never mixed.
class ReferenceSet {
 public:
  static constexpr std::size_t kFewest = 10;
  // A row each, and four rows of zeros behind them, so that they can be gone through by fours.
  using Column = std::vector<double>;
  using Vectors = std::array<Column, 3>;
  struct Span {
    std::size_t first, end;
  };

  // Throws InputError if fewer than kFewest places of the recording are followed by two further frames of the same individual.
  ReferenceSet(const Tracks& recording, const ReferenceOptions& options, const Rng& rng);

  std::size_t size() const { return size_; }
  double dt() const { return dt_; }                              // of the recording [s]
  const Vectors& velocity() const { return velocity_; }          // [unit/s]
  const Vectors& heading() const { return heading_; }            // v / |v|, 0 for 0
  const Vectors& acceleration() const { return acceleration_; }  // change of velocity per frame [unit/s]
  const Vectors& turn() const { return turn_; }                  // a / |a|, 0 for 0
  const Column& speed() const { return speed_; }                 // |v|, ascending [unit/s]
  const Column& change() const { return change_; }               // |a| [unit/s]
  double rms_change() const { return rms_change_; }              // root mean square of |a| [unit/s]

  // The group into which this speed falls, with `window` groups to each side.
  Span like(double speed, std::size_t window) const;
  Span all() const { return {0, size_}; }

 private:
  std::size_t size_ = 0;
  double dt_ = 0, rms_change_ = 0;
  Vectors velocity_, heading_, acceleration_, turn_;
  Column speed_, change_;
  std::vector<std::size_t> group_first_;  // and one past the last
};

}  // namespace swarmfit
