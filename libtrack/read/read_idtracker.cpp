// SPDX-License-Identifier: MIT
// trajectories.h5 of idtracker.ai, version 6: positions in pixels, frames x animals x 2, NaN where an animal was not seen; the
// probability of each identity; frame rate among the attributes of the file. https://idtracker.ai
#include <fmt/format.h>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"

namespace swarmfit {
namespace {

constexpr std::string_view kPositions = "/trajectories", kConfidence = "/id_probabilities";

bool is_trajectories(const Hdf5Object* o) { return o && o->kind == Hdf5Object::Kind::numbers && o->dims.size() == 3 && o->dims[2] == 2; }

bool recognises(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  if (!contents || !is_trajectories(contents->find(kPositions))) return false;
  const auto* root = contents->find("/");
  return root && root->attribute("frames_per_second") && root->attribute("body_length");
}

// The animals' names as the user gave them; numbers from 1 where they are not stated for all.
std::vector<std::string> labels(const Hdf5Object& root, std::size_t animals) {
  const auto* stated = root.attribute("identities_labels");
  if (stated && stated->texts.size() == animals) return stated->texts;
  std::vector<std::string> out;
  for (std::size_t k = 1; k <= animals; ++k) out.push_back(std::to_string(k));
  return out;
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto* contents = source.hdf5();
  const auto* positions = contents ? contents->find(kPositions) : nullptr;
  if (!is_trajectories(positions))
    throw InputError(
        fmt::format("{}: there are no {} (frames x animals x 2); expected trajectories.h5 of idtracker.ai", source.name, kPositions));
  const std::size_t frames = positions->dims[0], animals = positions->dims[1];
  const auto* sure = contents->find(kConfidence);
  const bool has_confidence = sure && sure->kind == Hdf5Object::Kind::numbers && sure->dims.size() >= 2 && sure->dims[0] == frames &&
                              sure->dims[1] == animals && (sure->dims.size() == 2 || sure->dims[2] == 1);
  std::vector<Hdf5Request> requests = {{std::string(kPositions)}};
  if (has_confidence) requests.push_back({std::string(kConfidence)});
  const auto data = read_hdf5(source.name, source.bytes, requests);

  RawTable table;
  table.file = source.name;
  table.unit = "px";
  const auto* root = contents->find("/");
  if (const auto fps = root->number("frames_per_second"); fps && *fps > 0) table.dt = 1 / *fps;
  const auto names = labels(*root, animals);
  Postures postures(table, options, {"centroid"});
  for (std::size_t k = 0; k < animals; ++k) {
    const auto track = table.names.number(names[k]);
    for (std::size_t f = 0; f < frames; ++f) {
      const double* at = data[0].numbers.data() + 2 * (f * animals + k);
      const std::span<const double> confidence =
          has_confidence ? std::span(data[1].numbers).subspan(f * animals + k, 1) : std::span<const double>();
      postures.add({track, static_cast<double>(f), kNaN, {at, 1}, {at + 1, 1}, {}, confidence});
    }
  }
  postures.finish();
  return table;
}

}  // namespace

const Reader kIdTracker = {{"idtracker", "idtracker.ai trajectories in HDF5", ".h5"}, recognises, read};

}  // namespace swarmfit
