// SPDX-License-Identifier: MIT
#include "cli/recordings.h"

#include "cli/cluster.h"
#include "fit/experiment/plant.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "libtrack/standard_input.h"
#include "libtrack/write/write.h"

namespace swarmfit::cli {

namespace {

Tracks read(const ReadOptions& options, const std::string& path) {
  // The built-in recording goes through the reader like any other, so that --frames, --fill-gaps and the rest hold for it too.
  if (path == "demo") return read_tracks_bytes("demo", to_csv(demo_recording()), options);
  if (path != "-") return read_tracks(path, options);
  if (cluster().size() > 1) throw InputError("-: standard input reaches only one of several processes; expected a file that all can read");
  return read_tracks_bytes("standard input", read_standard_input(), options);
}

}  // namespace

Tracks load(const Arguments& how, const std::string& path) {
  Tracks tracks = read(how.read, path);
  if (!how.kind.empty()) tracks = of_kind(tracks, kind_named(tracks, how.kind));
  return clean(std::move(tracks), how.clean);
}

}  // namespace swarmfit::cli
