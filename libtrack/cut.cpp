// SPDX-License-Identifier: MIT
#include "libtrack/cut.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "libtrack/error.h"

namespace swarmfit {

Tracks cut(const Tracks& tracks, std::int64_t first, std::int64_t last) {
  const auto frame = tracks.frame();
  const auto begin = std::lower_bound(frame.begin(), frame.end(), first) - frame.begin();
  const auto end = std::lower_bound(frame.begin(), frame.end(), last) - frame.begin();
  TrackColumns c;
  c.names = tracks.names();
  c.track.assign(tracks.track().begin() + begin, tracks.track().begin() + end);
  c.frame.assign(frame.begin() + begin, frame.begin() + end);
  c.pos = tracks.pos().middleRows(begin, end - begin);
  if (tracks.has_velocity()) c.vel = tracks.vel().middleRows(begin, end - begin);
  if (tracks.has_acceleration()) c.acc = tracks.acc().middleRows(begin, end - begin);
  if (const auto& kind = tracks.columns().kind; !kind.empty()) c.kind.assign(kind.begin() + begin, kind.begin() + end);
  c.episodes.assign(tracks.episodes().begin(), tracks.episodes().end());
  return Tracks(std::move(c), tracks.meta());
}

Tracks of_kind(const Tracks& tracks, std::uint8_t kind) {
  std::vector<Index> rows;
  for (Index row = 0; row < tracks.rows(); ++row)
    if (tracks.kind(row) == kind) rows.push_back(row);
  TrackColumns c;
  c.kind.assign(rows.size(), kind);
  c.pos = tracks.pos()(rows, Eigen::all);
  if (tracks.has_velocity()) c.vel = tracks.vel()(rows, Eigen::all);
  if (tracks.has_acceleration()) c.acc = tracks.acc()(rows, Eigen::all);
  c.episodes.assign(tracks.episodes().begin(), tracks.episodes().end());
  std::vector<bool> there(tracks.track_count(), false);
  for (const Index row : rows) there[tracks.track()[static_cast<std::size_t>(row)]] = true;
  std::vector<std::uint32_t> number(there.size());
  for (std::size_t t = 0; t < there.size(); ++t) {
    number[t] = static_cast<std::uint32_t>(c.names.size());
    if (there[t]) c.names.push_back(tracks.names()[t]);
  }
  for (const Index row : rows) {
    c.track.push_back(number[tracks.track()[static_cast<std::size_t>(row)]]);
    c.frame.push_back(tracks.frame()[static_cast<std::size_t>(row)]);
  }
  TrackMeta meta = tracks.meta();
  if (const auto others = static_cast<std::size_t>(tracks.rows()) - rows.size(); others > 0)
    meta.from.notes.push_back(fmt::format("{} row{} of other kinds than {} {} left out", others, others == 1 ? "" : "s",
                                          kind < meta.kinds.size() ? meta.kinds[kind] : std::to_string(kind),
                                          others == 1 ? "was" : "were"));
  return Tracks(std::move(c), std::move(meta));
}

std::uint8_t kind_named(const Tracks& tracks, const std::string& name) {
  const auto& names = tracks.meta().kinds;
  std::set<std::uint8_t> there;
  for (Index row = 0; row < tracks.rows(); ++row) there.insert(tracks.kind(row));
  std::vector<std::string> legal;
  for (const std::uint8_t kind : there) {
    const std::string number = std::to_string(kind), own = kind < names.size() ? names[kind] : number;
    if (name == own || name == number) return kind;
    legal.push_back(own == number ? number : fmt::format("{} ({})", own, number));
  }
  throw InputError(fmt::format("`kind` {}: no individual in {} is of that kind; expected one of {}", name, tracks.meta().from.path,
                               fmt::join(legal, ", ")));
}

}  // namespace swarmfit
