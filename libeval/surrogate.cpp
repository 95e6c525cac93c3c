// SPDX-License-Identifier: MIT
#include "libeval/surrogate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "libeval/centre.h"
#include "libeval/distance.h"
#include "libtrack/nan.h"

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

std::vector<Episode> prepared_episodes(const Tracks& tracks) {
  auto episodes = episodes_of(tracks);
  const auto centroid = centroids(tracks), path = group_path(tracks);
  for (Episode& e : episodes) prepare(e, tracks, centroid, path);
  return episodes;
}

// Frames from the first of the episode.
std::size_t place_in(const Episode& e, const Tracks& tracks, Index row) {
  return static_cast<std::size_t>(tracks.frame()[static_cast<std::size_t>(row)] - e.first);
}

Eigen::Array3d group_step(const Episode& e, std::size_t k) {
  if (e.path.size() < 2) return Eigen::Array3d::Zero();
  k = std::min(k, e.path.size() - 2);
  return e.path[k + 1] - e.path[k];
}

class Shifter {
 public:
  Shifter(const Tracks& tracks, const Rng& rng) : tracks_(tracks), rng_(rng), episodes_(prepared_episodes(tracks)) {}

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
    out_ = tracks_.columns();
    out_.kind.resize(static_cast<std::size_t>(tracks_.rows()));
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
      for (const Index row : part.rows) crowd += e.surplus[(place_in(e, tracks_, row) + shift) % length];
      if (crowd < least) least = crowd, best = shift;
    }
    return best;
  }

  void place(const Part& part, std::size_t shift) {
    Episode& e = episodes_[part.episode];
    const auto length = static_cast<std::size_t>(e.length());
    const bool seam = place_in(e, tracks_, part.rows.front()) + shift < length && place_in(e, tracks_, part.rows.back()) + shift >= length;
    const auto wrapped = static_cast<std::uint32_t>(out_.names.size());
    if (seam) out_.names.push_back(tracks_.names()[part.track] + " (wrapped)");
    for (const Index row : part.rows) {
      const auto r = static_cast<std::size_t>(row);
      const std::size_t from = place_in(e, tracks_, row), to = (from + shift) % length;
      out_.track[r] = seam && from + shift >= length ? wrapped : part.track;
      out_.frame[r] = e.first + static_cast<std::int64_t>(to);
      out_.kind[r] = tracks_.kind(row);
      out_.pos.row(row) += (e.path[to] - e.path[from]).transpose();
      if (out_.vel.rows() > 0) out_.vel.row(row) += (group_step(e, to) - group_step(e, from)).transpose() / tracks_.dt();
      e.surplus[to] += 1;
    }
  }

  const Tracks& tracks_;
  Rng rng_;
  std::vector<Episode> episodes_;
  TrackColumns out_;
};

// 0 .. n-1 in random order (Fisher and Yates).
std::vector<std::size_t> permutation(std::size_t n, const Rng& rng, std::uint32_t id, std::uint32_t draw) {
  std::vector<std::size_t> out(n);
  std::iota(out.begin(), out.end(), std::size_t{0});
  for (std::size_t k = n; k > 1; --k) {
    const double u = rng.uniform(Stream::surrogate, k, id, draw);
    std::swap(out[k - 1], out[std::min(static_cast<std::size_t>(u * static_cast<double>(k)), k - 1)]);
  }
  return out;
}

// Every row keeps its length and gets the direction of another. Rows without a direction are left alone.
void shuffle_directions(Rows& vectors, const Rng& rng, std::uint32_t draw) {
  const Eigen::ArrayXd length = (vectors.col(0).square() + vectors.col(1).square() + vectors.col(2).square()).sqrt();
  std::vector<Index> who;
  for (Index k = 0; k < length.size(); ++k)
    if (length(k) > 0) who.push_back(k);
  const auto order = permutation(who.size(), rng, 0, draw);
  const Rows before = vectors;
  for (std::size_t k = 0; k < who.size(); ++k) {
    const Index like = who[order[k]];
    vectors.row(who[k]) = before.row(like) * (length(who[k]) / length(like));
  }
}

// The same individuals in the same frames; positions and velocities are still to be filled in, accelerations are dropped.
TrackColumns same_rows(const Tracks& tracks) {
  TrackColumns out = tracks.columns();
  out.acc = Rows(0, 3);
  return out;
}

Tracks finished(TrackColumns columns, const Tracks& from) {
  TrackMeta meta = from.meta();
  meta.from.synthetic = true;
  return Tracks(std::move(columns), std::move(meta));
}

// How far out one of several is, in one column: total variation distance to all others, `all` being their sum with it.
double out_by(const Histogram& one, const Histogram& all) {
  Histogram others = all;
  for (std::size_t i = 0; i < one.counts.size(); ++i) others.counts[i] -= one.counts[i];
  others.samples -= one.samples;
  return total_variation(one, others);
}

}  // namespace

Tracks timeshift(const Tracks& tracks, const Rng& rng) { return Shifter(tracks, rng).take(); }

Tracks shuffled_walker(const Tracks& tracks, const Rng& rng) {
  TrackColumns out = same_rows(tracks);
  Rows steps = Rows::Zero(tracks.rows(), 3);
  const auto next = tracks.next();
  for (Index row = 0; row < tracks.rows(); ++row)
    if (const Index after = next[static_cast<std::size_t>(row)]; after >= 0)
      steps.row(row) = tracks.pos().row(after) - tracks.pos().row(row);
  shuffle_directions(steps, rng, 0);
  // Rows are sorted by frame, so a row is in place before the one that follows it.
  for (Index row = 0; row < tracks.rows(); ++row)
    if (const Index after = next[static_cast<std::size_t>(row)]; after >= 0) out.pos.row(after) = out.pos.row(row) + steps.row(row);
  if (out.vel.rows() > 0) shuffle_directions(out.vel, rng, 1);
  return finished(std::move(out), tracks);
}

Tracks shuffled_places(const Tracks& tracks, const Rng& rng) {
  TrackColumns out = same_rows(tracks);
  const auto episodes = prepared_episodes(tracks);
  const auto parts = parts_of(tracks, episodes);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto rows = parts[p].rows;
    const Episode& e = episodes[parts[p].episode];
    const auto order = permutation(rows.size(), rng, static_cast<std::uint32_t>(p), 2);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Index from = rows[order[k]], to = rows[k];
      const std::size_t before = place_in(e, tracks, from), after = place_in(e, tracks, to);
      out.pos.row(to) = tracks.pos().row(from) + (e.path[after] - e.path[before]).transpose();
      if (out.vel.rows() > 0)
        out.vel.row(to) = tracks.vel().row(from) + (group_step(e, after) - group_step(e, before)).transpose() / tracks.dt();
    }
  }
  return finished(std::move(out), tracks);
}

double surrogate_p(const PerColumn<Histogram>& observed, std::span<const PerColumn<Histogram>> surrogates, const PerColumn<bool>& used) {
  if (surrogates.empty()) return kNaN;
  double own = 0, columns = 0;
  std::vector<double> others(surrogates.size(), 0.0);
  for (std::size_t j = 0; j < used.size(); ++j) {
    if (!used[j]) continue;
    if (observed[j].samples == 0) return kNaN;
    Histogram all = observed[j];
    for (const auto& h : surrogates) all.add(h[j]);
    own += out_by(observed[j], all);
    for (std::size_t k = 0; k < others.size(); ++k) others[k] += out_by(surrogates[k][j], all);
    ++columns;
  }
  if (columns == 0) return kNaN;
  const auto as_far = std::count_if(others.begin(), others.end(), [&](double d) { return !(d < own); });
  return static_cast<double>(1 + as_far) / static_cast<double>(1 + surrogates.size());
}

double surrogate_p(const Histogram& observed, std::span<const Histogram> surrogates) {
  PerColumn<bool> one(1, true);
  PerColumn<Histogram> of(1);
  of[0] = observed;
  std::vector<PerColumn<Histogram>> all;
  for (const Histogram& h : surrogates) all.emplace_back(1).at(0) = h;
  return surrogate_p(of, all, one);
}

}  // namespace swarmfit
