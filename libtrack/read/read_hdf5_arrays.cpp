// SPDX-License-Identifier: MIT
// Plain arrays of numbers in an HDF5 file of no known layout, once --columns or --var says what they are: read like those of NumPy. Names
// are paths without the first slash.
#include <fmt/format.h>

#include "libtrack/error.h"
#include "libtrack/read/array_table.h"
#include "libtrack/read/formats.h"

namespace swarmfit {
namespace {

bool recognises(const Source& source, const ReadOptions& options) {
  return source.hdf5() && !(options.columns.empty() && options.variable.empty());
}

RawTable read(const Source& source, const ReadOptions& options) {
  const auto* contents = source.hdf5();
  if (!contents) throw InputError(source.name + ": this is not an HDF5 file; expected arrays in HDF5");
  std::vector<NumberArray> arrays;
  std::vector<Hdf5Request> requests;
  for (const auto& object : contents->objects) {
    const auto name = object.path.substr(1);
    const bool wanted = options.variable.empty() ? object.dims.size() <= 3 && !object.dims.empty() : name == options.variable;
    if (object.kind != Hdf5Object::Kind::numbers || !wanted) continue;
    arrays.push_back({name, object.dims, {}});
    requests.push_back({object.path});
  }
  auto data = read_hdf5(source.name, source.bytes, requests);
  for (std::size_t i = 0; i < arrays.size(); ++i) arrays[i].value = std::move(data[i].numbers);
  return array_table(source.name, arrays, options);
}

}  // namespace

const Reader kHdf5Arrays = {{"hdf5", "arrays in any HDF5 file, with --columns and --var", ".h5 .hdf5"}, recognises, read};

}  // namespace swarmfit
