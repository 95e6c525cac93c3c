// SPDX-License-Identifier: MIT
#include "cli/recordings.h"

#include <iostream>
#include <iterator>

#include "fit/experiment/plant.h"
#include "libtrack/write/write.h"

namespace swarmfit::cli {

Tracks load(const ReadOptions& options, const std::string& path) {
  // The built-in recording goes through the reader like any other, so that --frames, --fill-gaps and the rest hold for it too.
  if (path == "demo") return read_tracks_bytes("demo", to_csv(demo_recording()), options);
  if (path != "-") return read_tracks(path, options);
  return read_tracks_bytes("standard input", {std::istreambuf_iterator<char>(std::cin), {}}, options);
}

}  // namespace swarmfit::cli
