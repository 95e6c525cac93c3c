// SPDX-License-Identifier: MIT
#include "libtrack/write/own_columns.h"

namespace swarmfit {
namespace {

void add_vector(std::vector<OwnColumn>& out, const std::string& prefix, const Rows& rows, int dims) {
  for (int axis = 0; axis < dims; ++axis)
    out.push_back({prefix + std::string(1, "xyz"[axis]), {rows.col(axis).data(), rows.col(axis).data() + rows.rows()}});
}

}  // namespace

std::vector<OwnColumn> own_columns(const Tracks& tracks) {
  std::vector<OwnColumn> out(3);
  out[0] = {"track", {tracks.track().begin(), tracks.track().end()}};
  out[1] = {"frame", {}};
  out[2] = {"t", {}};
  for (const auto frame : tracks.frame()) {
    out[1].values.push_back(static_cast<double>(frame));
    out[2].values.push_back(tracks.time(frame));
  }
  add_vector(out, "", tracks.pos(), tracks.dims());
  if (tracks.has_velocity()) add_vector(out, "v", tracks.vel(), tracks.dims());
  if (tracks.has_acceleration()) add_vector(out, "a", tracks.acc(), tracks.dims());
  if (const auto& kind = tracks.columns().kind; !kind.empty()) out.push_back({"kind", {kind.begin(), kind.end()}});
  return out;
}

}  // namespace swarmfit
