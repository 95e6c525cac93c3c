// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <chrono>
#include <csignal>
#include <optional>

#include "cli/cluster.h"

namespace swarmfit::cli {
namespace {

volatile std::sig_atomic_t signalled = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): all a signal handler may touch

std::optional<std::chrono::steady_clock::time_point> deadline;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void on_signal(int number) {
  signalled = 1;
  std::signal(number, SIG_DFL);
}

}  // namespace

void install_interrupt_handler() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

void stop_after(double seconds) {
  using Clock = std::chrono::steady_clock;
  deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool interrupted() { return signalled != 0 || (deadline && std::chrono::steady_clock::now() >= *deadline); }

const Executor& executor() {
  static const Processes all(cluster(), interrupted);
  return all;
}

}  // namespace swarmfit::cli
