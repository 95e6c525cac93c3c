// SPDX-License-Identifier: MIT
#include "cli/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>

#include "cli/cluster.h"

namespace swarmfit::cli {
namespace {

volatile std::sig_atomic_t signalled = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): all a signal handler may touch

std::optional<std::chrono::steady_clock::time_point> deadline;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

std::atomic<bool> kept = false;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): of this process, as the time is

void on_signal(int number) {
  signalled = 1;
  std::signal(number, SIG_DFL);
}

bool time_is_up() { return deadline && kept && std::chrono::steady_clock::now() >= *deadline; }
bool interrupted() { return signalled != 0 || time_is_up(); }

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

void something_was_kept() { kept = true; }

const Executor& executor() {
  static const Handler handler;
  static const Processes all(cluster(), interrupted);
  return all;
}

}  // namespace swarmfit::cli
