// SPDX-License-Identifier: MIT
#pragma once

#include "fit/experiment/executor.h"

namespace swarmfit::cli {

inline constexpr int kInterrupted = 130;  // exit code

// From now on Ctrl-C and SIGTERM only raise a flag, which long work looks at; a second one ends the program at once.
void install_interrupt_handler();
// The same as a signal, when this time is up.
void stop_after(double seconds);
bool interrupted();

// Whoever makes the simulations: all processes; work ends with Interrupted when interrupted() says so in one of them.
const Executor& executor();

}  // namespace swarmfit::cli
