// SPDX-License-Identifier: MIT
#include "libeval/surrogate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libeval/centre.h"
#include "libeval/distance.h"

namespace swarmfit {
namespace {

// Shifts tried per track: one would leave the number per frame to chance, many would find the recorded moment again.
constexpr int kCandidates = 4;

// A stretch of frames within which time may be shifted: the whole recording, or one take of it.
struct Episode {
  std::int64_t first = 0, last = 0;  // frame numbers
  std::size_t begin = 0, end = 0;    // entries of tracks.frames()
  std::vector<double> surplus;       // individuals placed so far minus recorded, per frame from `first`
  std::vector<Eigen::Array3d> path;  // of the group, per frame from `first`; zero for a group that stays
  std::int64_t length() const { return last - first + 1; }
};

std::vector<Episode> episodes_of(const Tracks& tracks) {
  std::vector<Episode> out;
  const auto starts = tracks.episodes();
  const auto frames = tracks.frames();
  std::ptrdiff_t before = -1;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::ptrdiff_t take = std::upper_bound(starts.begin(), starts.end(), frames[f].number) - starts.begin();
    if (take != before) out.push_back({frames[f].number, 0, f, f, {}, {}});
    before = take;
    out.back().last = frames[f].number;
    out.back().end = f + 1;
  }
  return out;
}

// Does the group travel farther than it is wide? Compares the variance of the frames' centroids with that about them.
bool travels(const Tracks& tracks, const Episode& e, const std::vector<Eigen::Array3d>& centroid) {
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  double n = 0;
  for (std::size_t f = e.begin; f < e.end; ++f) {
    const auto count = static_cast<double>(tracks.frames()[f].count);
    mean += count * centroid[f];
    n += count;
  }
  mean /= n;
  double between = 0, within = 0;
  for (std::size_t f = e.begin; f < e.end; ++f) {
    const FrameRange& frame = tracks.frames()[f];
    between += static_cast<double>(frame.count) * (centroid[f] - mean).square().sum();
    for (Index row = frame.first; row < frame.first + frame.count; ++row)
      within += (tracks.pos().row(row).transpose() - centroid[f]).square().sum();
  }
  return between > within;
}

// Recorded numbers per frame as what is still missing, and the path of a travelling group.
void prepare(Episode& e, const Tracks& tracks, const std::vector<Eigen::Array3d>& centroid, const std::vector<Eigen::Array3d>& path) {
  const bool moving = travels(tracks, e, centroid);
  const auto length = static_cast<std::size_t>(e.length());
  e.surplus.assign(length, 0);
  e.path.assign(length, Eigen::Array3d::Zero());
  std::size_t f = e.begin;
  for (std::size_t k = 0; k < length; ++k) {
    const std::int64_t number = e.first + static_cast<std::int64_t>(k);
    if (f + 1 < e.end && tracks.frames()[f + 1].number <= number) ++f;
    if (tracks.frames()[f].number == number) e.surplus[k] = -static_cast<double>(tracks.frames()[f].count);
    if (moving) e.path[k] = path[f];
  }
}

// A track within one episode.
struct Part {
  std::uint32_t track;
  std::size_t episode;
  std::span<const Index> rows;
};

std::vector<Part> parts_of(const Tracks& tracks, const std::vector<Episode>& episodes) {
  std::vector<Part> parts;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    auto rows = tracks.rows_of(t);
    for (std::size_t e = 0; e < episodes.size() && !rows.empty(); ++e) {
      const auto in_episode = [&](Index row) { return tracks.frame()[static_cast<std::size_t>(row)] <= episodes[e].last; };
      const auto count = static_cast<std::size_t>(std::partition_point(rows.begin(), rows.end(), in_episode) - rows.begin());
      if (count > 0) parts.push_back({t, e, rows.first(count)});
      rows = rows.subspan(count);
    }
  }
  return parts;
}

class Shifter {
 public:
  Shifter(const Tracks& tracks, const Rng& rng) : tracks_(tracks), rng_(rng), episodes_(episodes_of(tracks)) {
    const auto centroid = centroids(tracks), path = group_path(tracks);
    for (Episode& e : episodes_) prepare(e, tracks, centroid, path);
  }

  Tracks take() {
    auto parts = parts_of(tracks_, episodes_);
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // The long ones first: the short ones can then fill what they leave.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return parts[a].rows.size() > parts[b].rows.size(); });
    start();
    for (const std::size_t k : order) place(parts[k], chosen_shift(parts[k], k));
    TrackMeta meta = tracks_.meta();
    meta.from.synthetic = true;
    return Tracks(std::move(out_), std::move(meta));
  }

 private:
  void start() {
    const auto n = static_cast<std::size_t>(tracks_.rows());
    out_.names = tracks_.names();
    out_.track.resize(n);
    out_.frame.resize(n);
    out_.kind.resize(n);
    out_.pos = tracks_.pos();
    out_.vel = tracks_.vel();
    out_.acc = tracks_.acc();
    out_.episodes.assign(tracks_.episodes().begin(), tracks_.episodes().end());
  }

  std::size_t place_in(const Episode& e, Index row) const {
    return static_cast<std::size_t>(tracks_.frame()[static_cast<std::size_t>(row)] - e.first);
  }

  std::size_t chosen_shift(const Part& part, std::size_t number) const {
    const Episode& e = episodes_[part.episode];
    const auto length = static_cast<std::size_t>(e.length());
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < kCandidates; ++k) {
      const double u = rng_.uniform(Stream::surrogate, number, k);
      const auto shift = std::min(static_cast<std::size_t>(u * static_cast<double>(length)), length - 1);
      double crowd = 0;
      for (const Index row : part.rows) crowd += e.surplus[(place_in(e, row) + shift) % length];
      if (crowd < least) least = crowd, best = shift;
    }
    return best;
  }

  void place(const Part& part, std::size_t shift) {
    Episode& e = episodes_[part.episode];
    const auto length = static_cast<std::size_t>(e.length());
    const bool seam = place_in(e, part.rows.front()) + shift < length && place_in(e, part.rows.back()) + shift >= length;
    const auto wrapped = static_cast<std::uint32_t>(out_.names.size());
    if (seam) out_.names.push_back(tracks_.names()[part.track] + " (wrapped)");
    for (const Index row : part.rows) {
      const auto r = static_cast<std::size_t>(row);
      const std::size_t from = place_in(e, row), to = (from + shift) % length;
      out_.track[r] = seam && from + shift >= length ? wrapped : part.track;
      out_.frame[r] = e.first + static_cast<std::int64_t>(to);
      out_.kind[r] = tracks_.kind(row);
      out_.pos.row(row) += (e.path[to] - e.path[from]).transpose();
      if (out_.vel.rows() > 0) out_.vel.row(row) += (group_step(e, to) - group_step(e, from)).transpose() / tracks_.dt();
      e.surplus[to] += 1;
    }
  }

  static Eigen::Array3d group_step(const Episode& e, std::size_t k) {
    if (e.path.size() < 2) return Eigen::Array3d::Zero();
    k = std::min(k, e.path.size() - 2);
    return e.path[k + 1] - e.path[k];
  }

  const Tracks& tracks_;
  Rng rng_;
  std::vector<Episode> episodes_;
  TrackColumns out_;
};

// Every row keeps its length and gets the direction of another (Fisher and Yates). Rows without a direction are left alone.
void shuffle_directions(Rows& vectors, const Rng& rng, std::uint32_t draw) {
  const Eigen::ArrayXd length = (vectors.col(0).square() + vectors.col(1).square() + vectors.col(2).square()).sqrt();
  std::vector<Index> who;
  for (Index k = 0; k < length.size(); ++k)
    if (length(k) > 0) who.push_back(k);
  std::vector<Index> like = who;
  for (std::size_t k = like.size(); k > 1; --k) {
    const double u = rng.uniform(Stream::surrogate, k, 0, draw);
    std::swap(like[k - 1], like[std::min(static_cast<std::size_t>(u * static_cast<double>(k)), k - 1)]);
  }
  const Rows before = vectors;
  for (std::size_t k = 0; k < who.size(); ++k) vectors.row(who[k]) = before.row(like[k]) * (length(who[k]) / length(like[k]));
}

}  // namespace

Tracks timeshift(const Tracks& tracks, const Rng& rng) { return Shifter(tracks, rng).take(); }

Tracks shuffled_walker(const Tracks& tracks, const Rng& rng) {
  TrackColumns out;
  out.names = tracks.names();
  out.track.assign(tracks.track().begin(), tracks.track().end());
  out.frame.assign(tracks.frame().begin(), tracks.frame().end());
  out.episodes.assign(tracks.episodes().begin(), tracks.episodes().end());
  for (Index row = 0; row < tracks.rows(); ++row) out.kind.push_back(tracks.kind(row));
  Rows steps = Rows::Zero(tracks.rows(), 3);
  const auto next = tracks.next();
  for (Index row = 0; row < tracks.rows(); ++row)
    if (const Index after = next[static_cast<std::size_t>(row)]; after >= 0)
      steps.row(row) = tracks.pos().row(after) - tracks.pos().row(row);
  shuffle_directions(steps, rng, 0);
  out.pos = tracks.pos();
  // Rows are sorted by frame, so a row is in place before the one that follows it.
  for (Index row = 0; row < tracks.rows(); ++row)
    if (const Index after = next[static_cast<std::size_t>(row)]; after >= 0) out.pos.row(after) = out.pos.row(row) + steps.row(row);
  out.vel = tracks.vel();
  if (out.vel.rows() > 0) shuffle_directions(out.vel, rng, 1);
  TrackMeta meta = tracks.meta();
  meta.from.synthetic = true;
  return Tracks(std::move(out), std::move(meta));
}

double surrogate_p(const Histogram& observed, std::span<const Histogram> surrogates) {
  if (observed.samples == 0 || surrogates.empty()) return std::numeric_limits<double>::quiet_NaN();
  Histogram all = observed;
  for (const Histogram& h : surrogates) all.add(h);
  const auto out_by = [&](const Histogram& h) {
    Histogram others = all;
    for (std::size_t i = 0; i < h.counts.size(); ++i) others.counts[i] -= h.counts[i];
    others.samples -= h.samples;
    return total_variation(h, others);
  };
  const double own = out_by(observed);
  const auto as_far = std::count_if(surrogates.begin(), surrogates.end(), [&](const Histogram& h) { return !(out_by(h) < own); });
  return static_cast<double>(1 + as_far) / static_cast<double>(1 + surrogates.size());
}

}  // namespace swarmfit
