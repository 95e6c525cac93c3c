// SPDX-License-Identifier: MIT
// A group at one moment: where everybody is, where from and where to. What order parameters and curves are computed from, whether the
// motion was recorded or streams out of a simulation.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "libeval/nearest.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// What holds for all moments of a recording.
struct MomentOptions {
  int dims = 3;                                    // 2 or 3
  double dt = 1;                                   // frame interval [s]
  double link = 0;                                 // who is closer is connected [unit]; 0: automatic_link() of every frame
  Eigen::Array3d period = Eigen::Array3d::Zero();  // sides of a periodic box [unit]; 0: open along that axis
  std::vector<std::int64_t> episodes = {};         // first frames of further takes: no step leads there
  std::optional<std::uint8_t> kind = {};           // of this kind of agent only, as if the others had not been there
  std::int64_t every = 1;                          // only frames with a number divisible by this
};
MomentOptions moment_options(const Tracks& tracks, std::optional<std::uint8_t> kind = {});

// Everybody in one frame.
struct Places {
  std::int64_t frame = 0;
  std::vector<std::uint32_t> id;
  Rows pos;   // [unit]
  Rows step;  // from here to the next frame, the shortest way round [unit]; NaN where there is none
  Rows back;  // from the frame before to here, likewise
};

// Those who step, with what they do about the centre of the same individuals at either end of the step.
struct Motion {
  std::vector<Index> row;                               // of Places
  std::vector<Eigen::Vector3d> step;                    // [unit]
  std::vector<Eigen::Vector3d> heading;                 // step / |step|; zero for who stands still
  std::vector<Eigen::Vector3d> from, to;                // place relative to the centre, before and after [unit]
  Eigen::Vector3d mean_step = Eigen::Vector3d::Zero();  // over all who step [unit]
  Index moving = 0;                                     // how many have a heading
};

// Principal axes of a set of places: eigenvalues of their covariance [unit²], largest first, and unit vectors.
struct Axes {
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axis = Eigen::Matrix3d::Identity();  // in columns
};
Axes principal_axes(std::span<const Eigen::Vector3d> places, int dims);

// Groups of places connected by links.
struct Components {
  std::vector<int> of;      // per place: number of its component; they are numbered by size, largest first, equals by their first member
  std::vector<Index> size;  // per component
};

// Computes what is asked for, once. Borrows the places. Not shared by threads.
class Moment {
 public:
  Moment(const MomentOptions& options, const Places& places) : options_(options), places_(places) {}

  const MomentOptions& options() const { return options_; }
  const Places& places() const { return places_; }
  Index size() const { return places_.pos.rows(); }
  Eigen::Vector3d separation(Index a, Index b) const;  // from a to b, the shortest way round
  // In a periodic box a circular mean per axis.
  const Eigen::Vector3d& centre() const;
  const std::vector<Eigen::Vector3d>& offsets() const;  // of all, from the centre
  const Motion& motion() const;
  const Axes& axes() const;  // of all
  const NearestOthers& nearest() const;
  double link() const;  // as the options say, or automatic
  const Components& components() const;

 private:
  const MomentOptions& options_;
  const Places& places_;
  mutable std::optional<Eigen::Vector3d> centre_;
  mutable std::optional<std::vector<Eigen::Vector3d>> offsets_;
  mutable std::optional<Motion> motion_;
  mutable std::optional<Axes> axes_;
  mutable std::optional<NearestOthers> nearest_;
  mutable std::optional<double> link_;
  mutable std::optional<Components> components_;
};

// 5 (plane) or 3 (space) times the mean distance to the nearest neighbour: twice the distance at which a Poisson process of this density
// percolates (mean degree 4.51 and 2.74: Dall and Christensen 2002, doi:10.1103/PhysRevE.66.016121), so that a uniform cloud is one group.
double automatic_link(double mean_nearest, int dims);

// Those of the largest component, as if the others were not there.
Places largest_component(const Moment& moment);

// Calls visit for every frame of a stream, one frame late, since a moment knows the next one; finish() for the last. Steps lead from a
// frame to the next number only, and to no episode's first frame.
class MomentStream : public FrameSink {
 public:
  using Visit = std::function<void(const Moment&)>;
  MomentStream(MomentOptions options, Visit visit) : options_(std::move(options)), visit_(std::move(visit)) {}
  void frame(const Snapshot& now) override;
  void finish();

 private:
  void link(Places& now);
  void emit();

  MomentOptions options_;
  Visit visit_;
  Places held_;
  bool holding_ = false;
};

// Every frame of a recording, as a stream of snapshots without velocities. Track numbers are the ids.
void replay(const Tracks& tracks, FrameSink& sink);

// Every frame of a recording as a moment.
void for_each_moment(const Tracks& tracks, const MomentOptions& options, const MomentStream::Visit& visit);

}  // namespace swarmfit
