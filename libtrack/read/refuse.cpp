// SPDX-License-Identifier: MIT
// Files that are often offered but are no recordings, or not ones that can be read: each with what to do instead.
#include <fmt/format.h>

#include <array>

#include "libtrack/error.h"
#include "libtrack/read/formats.h"

namespace swarmfit {
namespace {

using namespace std::string_view_literals;

struct Refusal {
  std::string_view start;  // first bytes of the file; empty: by ending
  std::string_view ending;
  std::string_view reason;
};

constexpr std::string_view kPickle =
    "is a Python pickle; expected a table (in Python: load it with numpy.load(FILE, allow_pickle=True) and save rows of id,frame,x,y as "
    "CSV)";

constexpr std::array kRefusals = {
    Refusal{"\x80\x02"sv, "", kPickle},
    Refusal{"\x80\x03"sv, "", kPickle},
    Refusal{"\x80\x04"sv, "", kPickle},
    Refusal{"\x80\x05"sv, "", kPickle},
    Refusal{"\x93NUMPY"sv, "", "is a NumPy array; expected a table (in Python: save rows of id,frame,x,y as CSV)"},
    Refusal{"{\\rtf"sv, "", "is a formatted document (RTF); expected a recording"},
    Refusal{"%PDF"sv, "", "is a PDF document; expected a recording"},
    Refusal{"PK\x03\x04"sv, "", "is a zip archive or a spreadsheet; expected a table (unpack it, or save the sheet as CSV)"},
    Refusal{"\x89HDF"sv, "", "is an HDF5 file of no known layout; expected MATLAB 7.3 or a table (convert it to CSV)"},
    Refusal{"\x89PNG"sv, "", "is an image; expected a recording"},
    Refusal{"<?xml"sv, "", "is an XML file; expected a table (TrackMate: export the spots as CSV)"},
    Refusal{"", ".md", "is a Markdown document; expected a recording"},
    Refusal{"", ".pkl", kPickle},
    Refusal{"", ".pickle", kPickle},
};

// A NumPy file whose elements are Python objects is a pickle in a wrapper.
bool holds_objects(std::string_view bytes) {
  return bytes.starts_with("\x93NUMPY") && bytes.substr(0, 256).find("'|O'") != std::string_view::npos;
}

}  // namespace

void refuse_non_recordings(const Source& source) {
  if (holds_objects(source.bytes)) throw InputError(fmt::format("{}: {}", source.name, kPickle));
  for (const auto& refusal : kRefusals) {
    const bool hit = refusal.start.empty() ? source.ends_with(refusal.ending) : source.bytes.starts_with(refusal.start);
    if (hit) throw InputError(fmt::format("{}: {}", source.name, refusal.reason));
  }
}

}  // namespace swarmfit
