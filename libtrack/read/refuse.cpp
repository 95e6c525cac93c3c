// SPDX-License-Identifier: MIT
// Files that are often offered but are no recordings, or not ones that can be read: each with what to do instead.
#include <fmt/format.h>

#include <array>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/sqlite_file.h"

namespace swarmfit {
namespace {

using namespace std::string_view_literals;

struct Refusal {
  std::string_view start;  // first bytes of the file; empty: by ending
  std::string_view ending;
  std::string_view reason;
};

constexpr std::string_view kPickle =
    "is a Python pickle of an old protocol; expected one of protocol 2 or later, or a table (in Python: load it with numpy.load(FILE, "
    "allow_pickle=True) and save rows of id,frame,x,y as "
    "CSV)";

constexpr std::array kRefusals = {
    Refusal{"{\\rtf"sv, "", "is a formatted document (RTF); expected a recording"},
    Refusal{"%PDF"sv, "", "is a PDF document; expected a recording"},
    Refusal{"\x89PNG"sv, "", "is an image; expected a recording"},
    Refusal{"<?xml"sv, "", "is an XML file of no known layout; expected one that swarmfit formats lists"},
    Refusal{"", ".md", "is a Markdown document; expected a recording"},
    Refusal{"", ".pkl", kPickle},
    Refusal{"", ".pickle", kPickle},
};

// What an HDF5 file of no known layout holds, for the user to see what it is.
std::string datasets(const Hdf5Contents& contents) {
  std::vector<std::string> shown;
  for (const auto& object : contents.objects)
    if (object.kind != Hdf5Object::Kind::group) shown.push_back(object.shown());
  return shown.empty() ? "nothing" : listed(shown);
}

}  // namespace

void refuse_non_recordings(const Source& source) {
  if (const auto* contents = source.hdf5())
    throw InputError(fmt::format(
        "{}: is an HDF5 file of no known layout, which holds {}; expected one that swarmfit formats lists, or `columns` and `var` "
        "for its arrays",
        source.name, datasets(*contents)));
  if (is_sqlite(source.bytes)) {
    std::vector<std::string> names;
    const SqliteFile file(source.name, source.bytes);
    for (const auto& [table, columns] : file.tables()) names.push_back(table);
    throw InputError(
        fmt::format("{}: is a SQLite database of no known layout, with the tables {}; expected one that swarmfit formats lists",
                    source.name, names.empty() ? "none" : listed(names)));
  }
  for (const auto& refusal : kRefusals) {
    const bool hit = refusal.start.empty() ? source.ends_with(refusal.ending) : source.bytes.starts_with(refusal.start);
    if (hit) throw InputError(fmt::format("{}: {}", source.name, refusal.reason));
  }
}

}  // namespace swarmfit
