// SPDX-License-Identifier: MIT
#include "cli/checkpoints.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <thread>

#include "cli/cluster.h"
#include "cli/config_file.h"
#include "cli/interrupt.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/write/run_folder.h"

namespace swarmfit::cli {
namespace {

constexpr int kLongestWait = 200;  // for a killed process to let go of its folder [10 ms]

std::string path_in(const std::string& dir) { return dir + "/checkpoint"; }

bool is_unfinished(const std::string& dir) {
  try {
    unfinished_run(dir);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

// Of two runs into one folder the second is refused: until this process ends the folder is its own.
void hold(const std::string& dir) {
  static std::set<std::string> held;
  if (!cluster().first() || !held.insert(std::filesystem::weakly_canonical(dir).string()).second) return;
  const int folder = open(dir.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);  // closed by the end of the process, which lets go
  // A process that was killed takes a moment to go.
  for (int waited = 0; folder >= 0 && flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++waited) {
    if (waited == kLongestWait)
      throw InputError(dir + ": another run is writing to it; expected another folder, or wait for that run to end");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace

Checkpoint checkpoint_in(const std::string& dir, const RunIdentity& run, bool resume) {
  const std::string path = path_in(dir);
  const bool go_on = resume && std::filesystem::exists(path);
  // The checkpoint knows its config.toml byte for byte; an earlier version may have written the same settings in other words.
  RunIdentity as_begun = run;
  const std::string config = dir + "/config.toml";
  if (go_on && std::filesystem::exists(config))
    if (std::string begun = read_file(config); same_config(begun, run.config)) as_begun.config = std::move(begun);
  // All must take the same path from the same bytes.
  if (cluster().size() > 1) {
    const std::string bytes = cluster().broadcast(go_on && cluster().first() ? read_file(path) : "");
    if (!cluster().first()) return Checkpoint::copy_of(bytes, path, as_begun);
  }
  if (go_on) {
    hold(dir);
    return {path, as_begun};
  }
  return {path, run, [dir, text = run.config] {
            make_directory(dir);
            hold(dir);
            begin_run(dir, text);
          }};
}

void remove_checkpoint(const std::string& dir) {
  if (!cluster().first()) return;
  std::error_code not_there;
  std::filesystem::remove(path_in(dir), not_there);
}

int stopped_before_the_end(const std::string& dir) {
  if (is_unfinished(dir))
    std::fprintf(stderr, "swarmfit: stopped before the end; to continue: swarmfit resume %s\n", dir.c_str());
  else
    std::fprintf(stderr, "swarmfit: interrupted; nothing was written\n");
  return kInterrupted;
}

}  // namespace swarmfit::cli
