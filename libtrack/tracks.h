// SPDX-License-Identifier: MIT
// Tracks: the one table of trajectories. Recorded and simulated motion are the same type.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swarmfit {

using Index = Eigen::Index;
using Rows = Eigen::Array<double, Eigen::Dynamic, 3>;  // structure of arrays: x, y and z are contiguous

// Where a recording came from and what reading it had to do.
struct Provenance {
  std::string path;                // as given by the user; "demo" for the built-in recording
  std::string sha256;              // of the bytes read, hex; empty for simulated tracks
  std::string format;              // name of the reader
  std::string columns;             // the column mapping that was used, as --columns would take it
  std::vector<std::string> notes;  // counted harmless repairs, one sentence each
  bool synthetic = false;          // made by a simulator, and labelled so wherever it appears
};

// What holds for a whole recording.
struct TrackMeta {
  int dims = 3;      // 2 or 3; two-dimensional motion has z = 0
  double dt = 0;     // frame interval [s], > 0
  double t0 = 0;     // time of frame number 0 [s]
  std::string unit;  // length unit, as in the file or as given: "mm", "m", "px", ...
  Provenance from;
  std::vector<std::string> kinds = {};  // what kinds 0, 1, ... are called; may be shorter than there are kinds
};

// One row per observation, in any order: the raw material of Tracks.
struct TrackColumns {
  std::vector<std::string> names;      // track names; a track number is an index into this list
  std::vector<std::uint32_t> track;    // track number
  std::vector<std::int64_t> frame;     // frame number, as in the file
  Rows pos;                            // position [unit]
  Rows vel;                            // recorded velocity [unit/s]; zero rows when the file has none
  Rows acc;                            // recorded acceleration [unit/s²]; zero rows when the file has none
  std::vector<std::uint8_t> kind;      // kind of agent (sheep 0, dog 1, ...); empty: all 0
  std::vector<std::int64_t> episodes;  // first frame of every further take; motion is never differenced across one
};

// The rows [first, first + count) of one frame.
struct FrameRange {
  std::int64_t number;  // frame number as in the file
  Index first, count;
};

// Trajectories of many individuals, sorted by (frame, track). Immutable once built.
//
// A gap stays a gap: next()[row] is the row of the same individual exactly one frame later, or -1 where the track ends, has a
// hole or meets an episode's first frame. All kinematics follow these links, so nothing can be differenced across a gap.
class Tracks {
 public:
  Tracks() = default;
  // Throws std::invalid_argument when columns differ in length, a (track, frame) pair occurs twice, a position is not finite,
  // dims is not 2 or 3, or dt is not positive. Readers check first and report the place in the file.
  Tracks(TrackColumns columns, TrackMeta meta);

  Index rows() const { return columns_.pos.rows(); }
  int dims() const { return meta_.dims; }
  double dt() const { return meta_.dt; }
  double time(std::int64_t frame) const { return meta_.t0 + static_cast<double>(frame) * meta_.dt; }
  const TrackMeta& meta() const { return meta_; }

  const TrackColumns& columns() const { return columns_; }  // sorted: to make other tracks from
  const Rows& pos() const { return columns_.pos; }
  const Rows& vel() const { return columns_.vel; }
  const Rows& acc() const { return columns_.acc; }
  bool has_velocity() const { return columns_.vel.rows() > 0; }
  bool has_acceleration() const { return columns_.acc.rows() > 0; }
  std::span<const std::uint32_t> track() const { return columns_.track; }
  std::span<const std::int64_t> frame() const { return columns_.frame; }
  std::span<const std::int64_t> episodes() const { return columns_.episodes; }
  std::uint8_t kind(Index row) const { return columns_.kind.empty() ? 0 : columns_.kind[static_cast<std::size_t>(row)]; }
  int kinds() const;  // all of them are less than this; at least 1
  const std::vector<std::string>& names() const { return columns_.names; }

  std::span<const FrameRange> frames() const { return frames_; }  // ascending; frames without anybody are absent
  std::size_t track_count() const { return columns_.names.size(); }
  std::span<const Index> rows_of(std::uint32_t track) const;  // ascending in time
  std::span<const Index> next() const { return next_; }       // see above

 private:
  void sort();
  void index_frames();
  void index_tracks();

  TrackColumns columns_;
  TrackMeta meta_;
  std::vector<FrameRange> frames_;
  std::vector<Index> by_track_, track_first_;  // permutation of rows, and where each track starts in it
  std::vector<Index> next_;
};

// Calls visit(first_row_of_segment, length) for every unbroken run of at least `least` consecutive frames of one individual.
template <class Visit>
void for_each_segment(const Tracks& tracks, Index least, Visit&& visit) {
  const auto next = tracks.next();
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    for (std::size_t k = 0; k < rows.size();) {
      std::size_t end = k;
      while (end + 1 < rows.size() && next[static_cast<std::size_t>(rows[end])] >= 0) ++end;
      const Index length = static_cast<Index>(end - k + 1);
      if (length >= least) visit(rows.subspan(k, end - k + 1));
      k = end + 1;
    }
  }
}

// One moment of a simulation, as it streams by. Everything is borrowed and valid only during the call.
struct Snapshot {
  std::int64_t frame;
  std::span<const std::uint32_t> id;
  std::span<const std::uint8_t> kind;
  const Rows& pos;
  const Rows& vel;
  const Eigen::ArrayXXd* own = nullptr;  // the model's private columns (State::own), for whoever counts what they say
};

// The stream form of Tracks, for motion that nobody needs stored.
struct FrameSink {
  virtual ~FrameSink() = default;
  virtual void frame(const Snapshot& now) = 0;
};

// Collects a stream into Tracks. Ids become track numbers; a name list may be given so that they keep the recording's names.
class TrackCollector : public FrameSink {
 public:
  explicit TrackCollector(std::vector<std::string> names = {}, bool keep_velocity = false);
  void frame(const Snapshot& now) override;
  Tracks take(TrackMeta meta);  // leaves the collector empty

 private:
  std::vector<std::string> names_;
  bool keep_velocity_;
  std::vector<std::uint32_t> track_;
  std::vector<std::int64_t> frame_;
  std::vector<std::uint8_t> kind_;
  std::array<std::vector<double>, 6> values_;
};

}  // namespace swarmfit
