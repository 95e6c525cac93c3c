// SPDX-License-Identifier: MIT
// NumPy arrays that swarmfit convert writes: libtrack/write/write.h.
#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/npy.h"
#include "libtrack/read/own_table.h"
#include "libtrack/read/unpack.h"

namespace swarmfit {
namespace {

constexpr std::string_view kEnding = ".npy";

bool recognises(const Source& source, const ReadOptions& options) {
  return is_zip(source.bytes) && options.variable.empty() && ZipFile(source.name, source.bytes).has(std::string(kOwnMark) + ".npy");
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!recognises(source, options)) throw InputError(source.name + ": swarmfit did not write it; expected .npz of swarmfit convert");
  const ZipFile zip(source.name, source.bytes);
  OwnParts parts;
  for (const auto& member : zip.members()) {
    if (!member.ends_with(kEnding)) continue;
    const auto name = member.substr(0, member.size() - kEnding.size());
    const auto bytes = zip.read(member);
    if (is_npy_text(bytes))
      parts.texts[name] = parse_npy_texts(source.name, name, bytes);
    else
      parts.numbers[name] = parse_npy(source.name, name, bytes).value;
  }
  return own_table(source.name, std::move(parts));
}

}  // namespace

const Reader kOwnNpz = {{"swarmfit-npz", "NumPy arrays that swarmfit convert writes", ".npz"}, recognises, read};

}  // namespace swarmfit
