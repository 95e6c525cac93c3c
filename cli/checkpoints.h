// SPDX-License-Identifier: MIT
// The checkpoint of a command's run, in its folder.
#pragma once

#include <string>

#include "fit/store/checkpoint.h"

namespace swarmfit::cli {

// A new one, which makes the folder a run's (begin_run) as soon as there is something to keep; with `resume` the one that is there. What
// was interrupted before it had one is begun anew.
Checkpoint checkpoint_in(const std::string& dir, const RunIdentity& run, bool resume);

// When everything has been written.
void remove_checkpoint(const std::string& dir);

// Tells how to go on with a run that was interrupted. Returns the exit code.
int stopped_before_the_end(const std::string& dir);

}  // namespace swarmfit::cli
