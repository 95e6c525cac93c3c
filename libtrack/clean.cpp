// SPDX-License-Identifier: MIT
#include "libtrack/clean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

std::string plural(std::size_t n, std::string_view one, std::string_view many) { return fmt::format("{} {}", n, n == 1 ? one : many); }

Tracks with_note(TrackColumns columns, TrackMeta meta, std::string note) {
  meta.from.notes.push_back(std::move(note));
  return Tracks(std::move(columns), std::move(meta));
}

// The rows for which keep(row) holds; individuals without one are forgotten.
template <class Keep>
TrackColumns rows_that(const Tracks& tracks, Keep&& keep) {
  std::vector<Index> rows;
  for (Index row = 0; row < tracks.rows(); ++row)
    if (keep(row)) rows.push_back(row);
  const auto& from = tracks.columns();
  TrackColumns c;
  c.pos = from.pos(rows, Eigen::all);
  if (tracks.has_velocity()) c.vel = from.vel(rows, Eigen::all);
  if (tracks.has_acceleration()) c.acc = from.acc(rows, Eigen::all);
  c.episodes = from.episodes;
  constexpr auto none = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> number(tracks.track_count(), none);
  for (const Index row : rows) number[from.track[static_cast<std::size_t>(row)]] = 0;
  for (std::size_t t = 0; t < number.size(); ++t) {
    if (number[t] == none) continue;
    number[t] = static_cast<std::uint32_t>(c.names.size());
    c.names.push_back(from.names[t]);
  }
  for (const Index row : rows) {
    const auto i = static_cast<std::size_t>(row);
    c.track.push_back(number[from.track[i]]);
    c.frame.push_back(from.frame[i]);
    if (!from.kind.empty()) c.kind.push_back(from.kind[i]);
  }
  return c;
}

// "1.5,2" in front of a unit, or of nothing; at most three numbers above 0, the last of which holds for the axes that follow.
std::string_view take_numbers(std::string_view text, std::array<double, 3>& out) {
  std::size_t n = 0;
  for (;;) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (n == out.size() || error != std::errc() || !(value > 0) || !std::isfinite(value)) return "?";
    for (std::size_t axis = n; axis < out.size(); ++axis) out[axis] = value;
    ++n;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.starts_with(',')) return text;
    text.remove_prefix(1);
  }
}

bool used(const Scale& scale) { return scale.factor != std::array<double, 3>{1, 1, 1} || !scale.to.empty(); }

std::string axes(const std::array<double, 3>& v, int dims) {
  const bool same = v[0] == v[1] && (dims == 2 || v[1] == v[2]);
  return same ? fmt::format("{:.9g}", v[0]) : fmt::format("{:.9g}", fmt::join(v.begin(), v.begin() + dims, ", "));
}

Rows times(const Rows& rows, const std::array<double, 3>& factor) {
  Rows out = rows;
  for (Index axis = 0; axis < 3; ++axis) out.col(axis) *= factor[static_cast<std::size_t>(axis)];
  return out;
}

}  // namespace

Scale parse_scale(const std::string& text) {
  Scale scale;
  const auto fail = [&] {
    return InputError(fmt::format("'{}' is not a scale; expected a factor above 0, as 0.05, 0.05,0.06 (x, y) or 0.05mm/px", text));
  };
  std::string_view unit = take_numbers(text, scale.factor);
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  if (unit.empty()) return scale;
  const auto cut = unit.find('/');
  if (cut == 0 || cut == std::string_view::npos || cut + 1 == unit.size() || unit.find_first_of(" ,?") != std::string_view::npos)
    throw fail();
  scale.to = unit.substr(0, cut);
  scale.from = unit.substr(cut + 1);
  return scale;
}

std::array<double, 3> parse_box(const std::string& text) {
  std::array<double, 3> box{};
  if (!take_numbers(text, box).empty())
    throw InputError(fmt::format("'{}' is not a box; expected its edge, or its edges as 10,20 (x, y) or 10,20,30", text));
  return box;
}

Tracks unwrap(const Tracks& tracks, const std::array<double, 3>& box) {
  TrackColumns c = tracks.columns();
  std::size_t crossings = 0;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    for (int axis = 0; axis < tracks.dims(); ++axis) {
      const double edge = box[static_cast<std::size_t>(axis)];
      double boxes = 0;
      for (std::size_t k = 1; k < rows.size(); ++k) {
        const double crossed = std::round((tracks.pos()(rows[k], axis) - tracks.pos()(rows[k - 1], axis)) / edge);
        boxes -= crossed;
        crossings += crossed != 0;
        c.pos(rows[k], axis) += boxes * edge;
      }
    }
  }
  return with_note(std::move(c), tracks.meta(),
                   fmt::format("periodic boundaries of a box of {} {} were undone: {}", axes(box, tracks.dims()), tracks.meta().unit,
                               plural(crossings, "crossing", "crossings")));
}

Tracks cut_jumps(const Tracks& tracks, double speed) {
  TrackColumns c = tracks.columns();
  std::set<std::string> taken(c.names.begin(), c.names.end());
  std::size_t cuts = 0;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    std::uint32_t number = t;
    for (std::size_t k = 1, part = 2; k < rows.size(); ++k) {
      const auto now = static_cast<std::size_t>(rows[k]), before = static_cast<std::size_t>(rows[k - 1]);
      const double time = static_cast<double>(c.frame[now] - c.frame[before]) * tracks.dt();
      const double moved = (tracks.pos().row(rows[k]) - tracks.pos().row(rows[k - 1])).matrix().norm();
      if (moved > speed * time) {
        std::string name;
        do name = fmt::format("{}-{}", tracks.names()[t], part++);
        while (!taken.insert(name).second);
        number = static_cast<std::uint32_t>(c.names.size());
        c.names.push_back(std::move(name));
        ++cuts;
      }
      c.track[now] = number;
    }
  }
  return with_note(std::move(c), tracks.meta(),
                   fmt::format("tracks were cut where they move faster than {:.6g} {}/s: {}", speed, tracks.meta().unit,
                               plural(cuts, "place", "places")));
}

Tracks scaled(const Tracks& tracks, const Scale& scale) {
  TrackMeta meta = tracks.meta();
  if (!scale.from.empty() && meta.unit != scale.from)
    throw InputError(
        fmt::format("`scale` from {}: {} is in {}; expected {}/{}", scale.from, meta.from.path, meta.unit, scale.to, meta.unit));
  TrackColumns c = tracks.columns();
  c.pos = times(c.pos, scale.factor);
  c.vel = times(c.vel, scale.factor);
  c.acc = times(c.acc, scale.factor);
  if (!c.pos.isFinite().all()) throw InputError("`scale`: positions become infinite; expected a smaller factor");
  std::string note = fmt::format("lengths were multiplied by {}", axes(scale.factor, meta.dims));
  if (!scale.to.empty()) {
    note += fmt::format(", from {} to {}", scale.from, scale.to);
    meta.unit = scale.to;
  }
  return with_note(std::move(c), std::move(meta), std::move(note));
}

Tracks flip_y(const Tracks& tracks) {
  TrackColumns c = tracks.columns();
  for (Rows* rows : {&c.pos, &c.vel, &c.acc})
    if (rows->rows() > 0) rows->col(1) = -rows->col(1);
  return with_note(std::move(c), tracks.meta(), "y was flipped (-y)");
}

Tracks thin(const Tracks& tracks, int stride) {
  const std::int64_t first = tracks.frames().front().number;
  TrackColumns c = rows_that(tracks, [&](Index row) { return (tracks.frame()[static_cast<std::size_t>(row)] - first) % stride == 0; });
  for (auto& frame : c.frame) frame = (frame - first) / stride;
  for (auto& start : c.episodes) start = (start - first + stride - 1) / stride;
  TrackMeta meta = tracks.meta();
  meta.t0 = tracks.time(first);
  meta.dt *= stride;
  return with_note(std::move(c), std::move(meta), fmt::format("one frame of {} was kept, beginning with {}", stride, first));
}

Tracks only(const Tracks& tracks, const std::vector<std::string>& names) {
  const auto& all = tracks.names();
  std::vector<bool> wanted(all.size(), false);
  for (const auto& name : names) {
    const auto hit = std::find(all.begin(), all.end(), name);
    constexpr std::size_t most = 20;
    if (hit == all.end())
      throw InputError(fmt::format("`tracks`: no individual in {} is called '{}'; expected some of {}{}", tracks.meta().from.path, name,
                                   fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(most, all.size())), ", "),
                                   all.size() > most ? fmt::format(", ... ({} in all)", all.size()) : ""));
    wanted[static_cast<std::size_t>(hit - all.begin())] = true;
  }
  TrackColumns c = rows_that(tracks, [&](Index row) { return wanted[tracks.track()[static_cast<std::size_t>(row)]]; });
  if (c.names.empty()) throw InputError(fmt::format("`tracks`: none of them is ever seen in {}; expected others", tracks.meta().from.path));
  const auto left_out = tracks.track_count() - c.names.size();
  return with_note(std::move(c), tracks.meta(), fmt::format("{} left out by name", plural(left_out, "individual was", "individuals were")));
}

Tracks longer_than(const Tracks& tracks, std::int64_t rows) {
  std::size_t longest = 0;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) longest = std::max(longest, tracks.rows_of(t).size());
  if (longest <= static_cast<std::size_t>(rows))
    throw InputError(fmt::format("`longer-than` {}: no individual in {} is seen in more than {} frames; expected fewer", rows,
                                 tracks.meta().from.path, longest));
  TrackColumns c = rows_that(tracks, [&](Index row) {
    return tracks.rows_of(tracks.track()[static_cast<std::size_t>(row)]).size() > static_cast<std::size_t>(rows);
  });
  const auto left_out = tracks.track_count() - c.names.size();
  return with_note(std::move(c), tracks.meta(),
                   fmt::format("{} left out: seen in {} frames or fewer", plural(left_out, "individual was", "individuals were"), rows));
}

Tracks clean(Tracks tracks, const Cleaning& how) {
  if (how.box[0] > 0) tracks = unwrap(tracks, how.box);
  if (how.fastest > 0) tracks = cut_jumps(tracks, how.fastest);
  if (used(how.scale)) tracks = scaled(tracks, how.scale);
  if (how.flip) tracks = flip_y(tracks);
  if (how.stride > 1) tracks = thin(tracks, how.stride);
  if (!how.individuals.empty()) tracks = only(tracks, how.individuals);
  if (how.longer_than > 0) tracks = longer_than(tracks, how.longer_than);
  return tracks;
}

}  // namespace swarmfit
