// SPDX-License-Identifier: MIT
#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace swarmfit::cli {
namespace {

constexpr auto kRefresh = std::chrono::milliseconds(200);

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_ - kRefresh),
      last_in_phase_(start_) {}

ProgressLine::~ProgressLine() {
  if (!quiet_ && terminal_ && !phase_.empty()) std::fputs("\r\033[K", stderr);
}

// The estimate reaches to the end of this model's pass: how many passes the weights need, nobody knows beforehand.
std::string ProgressLine::text(const CompareProgress& now) const {
  const double rate = static_cast<double>(now.simulations) / std::max(1e-9, seconds(std::chrono::steady_clock::now() - start_));
  const double left = static_cast<double>(std::max<std::int64_t>(0, now.planned - now.simulations)) / rate;
  return fmt::format("pass {}/{}  {} ({} of {})  {}/{} simulations, {:.0f}/s, at most {:.0f} s left for it  best {:.4f}", now.pass,
                     now.passes, now.model, now.index + 1, now.models, now.simulations, now.planned, rate, left, now.best);
}

void ProgressLine::show(const CompareProgress& now) {
  if (quiet_) return;
  const auto time = std::chrono::steady_clock::now();
  const std::string phase = fmt::format("pass {}: {} ({} of {})", now.pass, now.model, now.index + 1, now.models);
  if (phase != phase_) {
    phase_ = phase;
    start_ = last_in_phase_;
    if (!terminal_) std::fprintf(stderr, "%s\n", phase.c_str());
  }
  last_in_phase_ = time;
  if (!terminal_ || time - last_ < kRefresh) return;
  last_ = time;
  std::fprintf(stderr, "\r\033[K%s", text(now).c_str());
  std::fflush(stderr);
}

}  // namespace swarmfit::cli
