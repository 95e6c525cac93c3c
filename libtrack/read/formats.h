// SPDX-License-Identifier: MIT
// The readers, one file each; the table that lists them is in read.cpp.
#pragma once

#include <string>
#include <string_view>

#include "libtrack/read/raw_table.h"
#include "libtrack/read/read.h"

namespace swarmfit {

struct Source {
  const std::string& name;  // path, for messages and for its ending
  std::string_view bytes;
  bool ends_with(std::string_view ending) const;  // ".mat", in any case
};

// A reader: does it know this content, and reading it.
struct Reader {
  Format format;
  bool (*recognises)(const Source&, const ReadOptions&);
  RawTable (*read)(const Source&, const ReadOptions&);
};

extern const Reader kMatlab;
extern const Reader kPeTrack;
extern const Reader kDelimitedText;

// Throws InputError for well-known files that are no readable recordings, with advice.
void refuse_non_recordings(const Source& source);

}  // namespace swarmfit
