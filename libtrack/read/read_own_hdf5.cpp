// SPDX-License-Identifier: MIT
// HDF5 that swarmfit convert writes: libtrack/write/write.h.
#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/own_table.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions&) {
  const auto* contents = source.hdf5();
  const auto* root = contents ? contents->find("/") : nullptr;
  return root && root->text(kOwnMark).starts_with("tracks/");
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options)) throw InputError(source.name + ": swarmfit did not write it; expected HDF5 of swarmfit convert");
  OwnParts parts;
  std::vector<Hdf5Request> requests;
  for (const auto& object : source.hdf5()->objects)
    if (object.dims.size() == 1 && object.path.rfind('/') == 0) requests.push_back({object.path});
  auto arrays = read_hdf5(source.name, source.bytes, requests);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    const auto name = requests[k].path.substr(1);
    if (!arrays[k].texts.empty()) parts.texts[name] = std::move(arrays[k].texts);
    if (!arrays[k].numbers.empty()) parts.numbers[name] = std::move(arrays[k].numbers);
  }
  for (const auto& attribute : source.hdf5()->find("/")->attributes) {
    if (!attribute.texts.empty()) parts.texts[attribute.name] = attribute.texts;
    if (!attribute.numbers.empty()) parts.numbers[attribute.name] = attribute.numbers;
  }
  return own_table(source.name, std::move(parts));
}

}  // namespace

const Reader kOwnHdf5 = {{"swarmfit-h5", "HDF5 that swarmfit convert writes", ".h5"}, recognises, read};

}  // namespace swarmfit
