// SPDX-License-Identifier: MIT
// Python pickles of plain values, alone or behind the header of an .npy, read without unpickling: trajectories.npy of idtracker.ai before
// version 6, a dict with the same entries as its HDF5; an array of NumPy, or a dict of them, read like those of .npy and .npz.
#include <fmt/format.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/read/array_table.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/idtracker_table.h"
#include "libtrack/read/pickle.h"

namespace swarmfit {
namespace {

constexpr std::string_view kPositions = "trajectories", kConfidence = "id_probabilities";

std::string_view pickled(const Source& source) { return is_pickle(source.bytes) ? source.bytes : npy_pickle(source.bytes); }

bool is_pickled(const Source& source, const ReadOptions&) { return !pickled(source).empty(); }

Pickle opened(const Source& source) {
  if (!is_pickled(source, {})) throw InputError(source.name + ": is not a Python pickle; expected one");
  return {source.name, pickled(source)};
}

// The array of this name if it has so many dimensions.
const PickleValue* array_of(const Pickle& pickle, std::string_view name, std::size_t dims) {
  const auto* value = pickle.find(pickle.root(), name);
  return value && value->kind == PickleValue::Kind::array && value->dims.size() == dims ? value : nullptr;
}

const PickleValue* positions_of(const Pickle& pickle) {
  const auto* array = array_of(pickle, kPositions, 3);
  return array && array->dims[2] == 2 ? array : nullptr;
}

// A number, or an array of one: how NumPy pickles its own.
std::optional<double> number_of(const Pickle& pickle, std::string_view name) {
  const auto* value = pickle.find(pickle.root(), name);
  if (value && value->kind == PickleValue::Kind::number) return value->number;
  if (!value || value->kind != PickleValue::Kind::array || !value->dims.empty()) return std::nullopt;
  return pickle.array(std::string(name), *value).value.at(0);
}

std::vector<std::string> names_of(const Pickle& pickle) {
  const auto* list = pickle.find(pickle.root(), "identities_labels");
  std::vector<std::string> out;
  if (!list || list->kind != PickleValue::Kind::sequence) return out;
  for (std::size_t k = 0; k < list->items.size(); ++k)
    if (const auto& name = pickle.item(*list, k); name.kind == PickleValue::Kind::text) out.emplace_back(name.text);
  return out;
}

bool is_idtracker(const Source& source, const ReadOptions& options) {
  // Any pickle that cannot be read is refused by the next reader, with the reason.
  if (!is_pickled(source, options)) return false;
  try {
    return positions_of(opened(source)) != nullptr;
  } catch (const InputError&) {
    return false;
  }
}

RawTable read_idtracker(const Source& source, const ReadOptions& options) {
  const Pickle pickle = opened(source);
  const auto* positions = positions_of(pickle);
  if (!positions)
    throw InputError(
        fmt::format("{}: there are no {} (frames x animals x 2); expected trajectories.npy of idtracker.ai", source.name, kPositions));
  IdTrackerFile found;
  found.positions = pickle.array(std::string(kPositions), *positions);
  for (const std::size_t dims : {2U, 3U})
    if (const auto* sure = array_of(pickle, kConfidence, dims)) found.confidence = pickle.array(std::string(kConfidence), *sure);
  found.fps = number_of(pickle, "frames_per_second");
  found.names = names_of(pickle);
  return idtracker_table(source.name, found, options);
}

RawTable read_arrays(const Source& source, const ReadOptions& options) {
  auto arrays = opened(source).arrays();
  if (!options.variable.empty()) std::erase_if(arrays, [&](const NumberArray& a) { return a.name != options.variable; });
  return array_table(source.name, arrays, options);
}

}  // namespace

const Reader kIdTrackerPickle = {{"idtracker-npy", "idtracker.ai trajectories in a Python pickle", ".npy"}, is_idtracker, read_idtracker};
const Reader kPickle = {{"pickle", "NumPy arrays in a Python pickle", ".npy .pkl"}, is_pickled, read_arrays};

}  // namespace swarmfit
