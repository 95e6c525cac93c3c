// SPDX-License-Identifier: MIT
// trajectories.h5 of idtracker.ai, version 6: positions in pixels, frames x animals x 2, NaN where an animal was not seen; the
// probability of each identity; frame rate among the attributes of the file. https://idtracker.ai
#include <fmt/format.h>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/idtracker_table.h"

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

RawTable read(const Source& source, const ReadOptions& options) {
  const auto* contents = source.hdf5();
  const auto* positions = contents ? contents->find(kPositions) : nullptr;
  if (!is_trajectories(positions))
    throw InputError(
        fmt::format("{}: there are no {} (frames x animals x 2); expected trajectories.h5 of idtracker.ai", source.name, kPositions));
  const auto* root = contents->find("/");
  const auto* sure = contents->find(kConfidence);
  const bool has_confidence = sure && sure->kind == Hdf5Object::Kind::numbers && sure->dims.size() >= 2 &&
                              sure->dims[0] == positions->dims[0] && sure->dims[1] == positions->dims[1] &&
                              (sure->dims.size() == 2 || sure->dims[2] == 1);
  std::vector<Hdf5Request> requests = {{std::string(kPositions)}};
  if (has_confidence) requests.push_back({std::string(kConfidence)});
  auto data = read_hdf5(source.name, source.bytes, requests);

  IdTrackerFile found;
  found.positions = {"", positions->dims, std::move(data[0].numbers)};
  if (has_confidence) found.confidence = {"", sure->dims, std::move(data[1].numbers)};
  found.fps = root->number("frames_per_second");
  if (const auto* stated = root->attribute("identities_labels")) found.names = stated->texts;
  return idtracker_table(source.name, found, options);
}

}  // namespace

const Reader kIdTracker = {{"idtracker", "idtracker.ai trajectories in HDF5", ".h5"}, recognises, read};

}  // namespace swarmfit
