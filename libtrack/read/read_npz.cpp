// SPDX-License-Identifier: MIT
// Plain NumPy arrays, .npy and .npz: a table of rows, positions by frame and individual, or one array per column.
#include <fmt/format.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/read/array_table.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/unpack.h"

namespace swarmfit {
namespace {

constexpr std::string_view kEnding = ".npy";

bool is_npz(const Source& source) {
  if (!is_zip(source.bytes)) return false;
  const ZipFile zip(source.name, source.bytes);
  return std::any_of(zip.members().begin(), zip.members().end(), [](const auto& m) { return m.ends_with(kEnding); });
}

bool recognises(const Source& source, const ReadOptions&) { return is_npy(source.bytes) || is_npz(source); }

// Members that hold no numbers (texts, pickles) are not looked at unless one is asked for.
std::vector<NumberArray> arrays(const Source& source, const std::string& variable) {
  if (is_npy(source.bytes)) return {parse_npy(source.name, "", source.bytes)};
  const ZipFile zip(source.name, source.bytes);
  std::vector<NumberArray> out;
  std::string first_fault;
  for (const auto& member : zip.members()) {
    if (!member.ends_with(kEnding)) continue;
    const auto name = member.substr(0, member.size() - kEnding.size());
    if (!variable.empty() && name != variable) continue;
    try {
      out.push_back(parse_npy(source.name, name, zip.read(member)));
    } catch (const InputError& error) {
      if (!variable.empty()) throw;
      if (first_fault.empty()) first_fault = error.what();
    }
  }
  if (out.empty() && !first_fault.empty()) throw InputError(first_fault);
  return out;
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options)) throw InputError(source.name + ": there is no NumPy array in it; expected .npy or .npz");
  return array_table(source.name, arrays(source, options.variable), options);
}

}  // namespace

const Reader kNumpy = {{"numpy", "NumPy arrays of numbers, .npy and .npz", ".npy .npz"}, recognises, read};

}  // namespace swarmfit
