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

bool interrupted() { return signalled != 0; }
bool time_is_up() { return deadline && std::chrono::steady_clock::now() >= *deadline; }

struct Handler {
  Handler() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
  }
};

}  // namespace

void stop_after(double seconds) {
  using Clock = std::chrono::steady_clock;
  deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

const Executor& executor() {
  static const Handler handler;
  static const Processes all(cluster(), interrupted, time_is_up);
  return all;
}

}  // namespace swarmfit::cli
