// SPDX-License-Identifier: MIT
// extend and augment: simulated points beside recorded ones.
#include <fmt/format.h>

#include <cstdio>

#include "cli/commands.h"
#include "cli/recordings.h"
#include "cli/version.h"
#include "fit/compare/portrait.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/write/write.h"
#include "reports/recording/tracks_html.h"

namespace swarmfit::cli {
namespace {

Tracks recording_of(const Arguments& a) {
  if (a.out.empty() && a.html.empty()) throw InputError(a.command + ": nothing to write; expected --out FILE or --html FILE");
  return load(a, a.recordings.front());
}

int written(const Arguments& a, const Tracks& tracks) {
  if (a.out == "-") {
    const std::string text = to_csv(tracks);
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else if (!a.out.empty()) {
    write_csv(a.out, tracks);
  }
  if (!a.html.empty())
    write_file_atomically(a.html, tracks_html(portrait(tracks), tracks.meta(), summarise(tracks), {a.line, kVersion, {}}));
  if (!a.common.quiet) std::fprintf(stderr, "swarmfit: %s\n", tracks.meta().from.notes.back().c_str());
  return 0;
}

}  // namespace

int extend(const Arguments& a) { return written(a, swarmfit::extend(recording_of(a), a.extending)); }

int augment(const Arguments& a) { return written(a, swarmfit::augment(recording_of(a), {a.extending.pilot, a.add})); }

}  // namespace swarmfit::cli
