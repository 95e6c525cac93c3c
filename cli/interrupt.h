// SPDX-License-Identifier: MIT
#pragma once

#include "fit/experiment/executor.h"

namespace swarmfit::cli {

inline constexpr int kInterrupted = 130;  // exit code

// Long work ends when this time is up, but not before something has been kept: however short the time, a run that is resumed gets on.
void stop_after(double seconds);

// To be called when something is: Checkpoint::on_add.
void something_was_kept();

// Whoever makes the simulations: all processes. Work ends with Interrupted, within a simulation too, when a signal or the time says so in
// one of them: from the first call on Ctrl-C and SIGTERM only raise a flag, which long work looks at, and a second one ends the program at
// once. Before, while a recording is read, the first one does.
const Executor& executor();

}  // namespace swarmfit::cli
