// SPDX-License-Identifier: MIT
// Analysis files of SLEAP (HDF5): tracks x 2 x nodes x frames, NaN where a node was not seen; names of tracks and nodes; scores of
// points. Pixels; the frame rate is that of the video, which is not in the file. https://sleap.ai
#include <fmt/format.h>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"

namespace swarmfit {
namespace {

bool is_tracks(const Hdf5Object* o) {
  return o && o->kind == Hdf5Object::Kind::numbers && o->dims.size() == 4 && (o->dims[1] == 2 || o->dims[1] == 3);
}

bool recognises(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  return contents && is_tracks(contents->find("/tracks")) && contents->find("/node_names");
}

// The names in the file where there is one for each, else numbers from `first`.
std::vector<std::string> names_or_numbers(const std::vector<std::string>& stated, std::size_t count, std::string_view prefix) {
  if (stated.size() == count) return stated;
  std::vector<std::string> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(fmt::format("{}{}", prefix, k));
  return out;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto* contents = source.hdf5();
  const auto* tracks = contents ? contents->find("/tracks") : nullptr;
  if (!is_tracks(tracks) || !contents->find("/node_names"))
    throw InputError(source.name +
                     ": there are no /tracks (tracks x 2 x nodes x frames) with /node_names; expected an analysis file of SLEAP");
  const std::size_t count = tracks->dims[0], axes = tracks->dims[1], nodes = tracks->dims[2], frames = tracks->dims[3];
  std::vector<Hdf5Request> requests = {{"/tracks"}, {"/node_names"}};
  const auto* scores = contents->find("/point_scores");
  const bool scored = scores && scores->dims == std::vector{count, nodes, frames};
  if (scored) requests.push_back({"/point_scores"});
  const auto* named = contents->find("/track_names");
  const bool names = named && named->kind == Hdf5Object::Kind::text;
  if (names) requests.push_back({"/track_names"});
  const auto data = read_hdf5(source.name, source.bytes, requests);

  RawTable table;
  table.file = source.name;
  table.unit = "px";
  const auto track_names = names_or_numbers(names ? data.back().texts : std::vector<std::string>(), count, "");
  Postures postures(table, options, names_or_numbers(data[1].texts, nodes, "node"));
  std::vector<double> point[4];
  for (auto& p : point) p.resize(nodes);
  for (std::size_t k = 0; k < count; ++k) {
    const auto track = table.names.number(track_names[k]);
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t n = 0; n < nodes; ++n) {
        for (std::size_t a = 0; a < axes; ++a) point[a][n] = data[0].numbers[((k * axes + a) * nodes + n) * frames + f];
        if (scored) point[3][n] = data[2].numbers[(k * nodes + n) * frames + f];
      }
      using Span = std::span<const double>;
      postures.add(
          {track, static_cast<double>(f), kNaN, point[0], point[1], axes == 3 ? Span(point[2]) : Span(), scored ? Span(point[3]) : Span()});
    }
  }
  postures.finish();
  return table;
}

}  // namespace

const Reader kSleap = {{"sleap", "SLEAP analysis files (HDF5)", ".h5"}, recognises, read};

}  // namespace swarmfit
