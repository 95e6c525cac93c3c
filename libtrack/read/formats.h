// SPDX-License-Identifier: MIT
// The readers, one file each; readers.def lists them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "libtrack/read/hdf5_file.h"
#include "libtrack/read/raw_table.h"
#include "libtrack/read/read.h"

namespace swarmfit {

struct Source {
  const std::string& name;  // path, for messages and for its ending
  std::string_view bytes;
  mutable std::shared_ptr<const Hdf5Contents> contents{};  // see hdf5()
  bool ends_with(std::string_view ending) const;           // ".mat", in any case

  // What is in an HDF5 file, found out once; nullptr: it is none. Throws InputError when it is damaged.
  const Hdf5Contents* hdf5() const;
};

// A reader: does it know this content, and reading it.
struct Reader {
  Format format;
  bool (*recognises)(const Source&, const ReadOptions&);
  RawTable (*read)(const Source&, const ReadOptions&);
};

#define READER(name) extern const Reader name;
#define TEXT_READER(name) extern const Reader name;
#include "libtrack/read/readers.def"
#undef TEXT_READER
#undef READER

// The reader of text that recognises it; there is always one. For containers that hold text.
const Reader& text_reader(const Source& source, const ReadOptions& options);

// Throws InputError for well-known files that are no readable recordings, with advice.
void refuse_non_recordings(const Source& source);

}  // namespace swarmfit
