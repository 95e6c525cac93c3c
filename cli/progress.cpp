// SPDX-License-Identifier: MIT
#include "cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace swarmfit::cli {
namespace {

constexpr auto kRefresh = std::chrono::milliseconds(200);

std::string of_part(const CompareProgress& now) { return now.part.empty() ? "" : now.part + ", "; }
// A longer line would wrap, and what wrapped stays when the line is written anew.
std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
}

std::string cut_to(std::size_t width, std::string text) {
  if (text.size() > width) text.resize(width);
  return text;
}

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

ProgressLine::ProgressLine(bool quiet, bool phases_in_pipe)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      phases_in_pipe_(phases_in_pipe),
      start_(std::chrono::steady_clock::now()),
      last_(start_ - kRefresh),
      last_in_phase_(start_) {}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::wipe() {
  if (!quiet_ && terminal_ && !phase_.empty()) std::fputs("\r\033[K", stderr);
}

// The estimate reaches to the end of this model's pass: how many passes the weights need, nobody knows beforehand.
std::string ProgressLine::text(const CompareProgress& now) const {
  const double rate = static_cast<double>(now.simulations) / std::max(1e-9, seconds(std::chrono::steady_clock::now() - start_));
  const double left = static_cast<double>(std::max<std::int64_t>(0, now.planned - now.simulations)) / rate;
  return fmt::format("{}pass {}/{}  {} ({} of {})  {}/{} simulations, {:.0f}/s, at most {:.0f} s left  best {:.4f}", of_part(now), now.pass,
                     now.passes, now.model, now.index + 1, now.models, now.simulations, now.planned, rate, left, now.best);
}

void ProgressLine::show(const CompareProgress& now, const std::string& before) {
  if (quiet_) return;
  const auto time = std::chrono::steady_clock::now();
  const std::string phase = fmt::format("{}pass {}: {} ({} of {})", of_part(now), now.pass, now.model, now.index + 1, now.models);
  if (phase != phase_) {
    phase_ = phase;
    start_ = last_in_phase_;
    if (!terminal_ && phases_in_pipe_) std::fprintf(stderr, "%s\n", phase.c_str());
  }
  last_in_phase_ = time;
  if (!terminal_ || time - last_ < kRefresh) return;
  last_ = time;
  std::fprintf(stderr, "\r\033[K%s", cut_to(terminal_width(), before + text(now)).c_str());
  std::fflush(stderr);
}

StudyProgress::StudyProgress(bool quiet, std::size_t all)
    : quiet_(quiet), all_(all), last_(std::chrono::steady_clock::now()), line_(quiet, false) {}

std::string StudyProgress::before() const {
  std::string out = fmt::format("comparison {} of {}", done_ + 1, all_);
  if (computed_ > 0)
    out +=
        fmt::format(", about {:.0f} min left", seconds(spent_) / 60 * static_cast<double>(all_ - done_) / static_cast<double>(computed_));
  return out + ": ";
}

void StudyProgress::show(const CompareProgress& now) {
  computing_ = true;
  line_.show(now, before());
}

void StudyProgress::done(const std::string& what) {
  const auto now = std::chrono::steady_clock::now();
  if (computing_) {
    spent_ += now - last_;
    ++computed_;
  }
  computing_ = false;
  last_ = now;
  ++done_;
  line_.wipe();
  if (!quiet_) std::fprintf(stderr, "%zu/%zu: %s\n", done_, all_, what.c_str());
}

CountLine::CountLine(bool quiet, std::string what)
    : shown_(!quiet && isatty(STDERR_FILENO) != 0),
      what_(std::move(what)),
      start_(std::chrono::steady_clock::now()),
      last_(start_ - kRefresh) {}

CountLine::~CountLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void CountLine::show(std::size_t done, std::size_t all) {
  if (!found_) found_ = done;
  const auto now = std::chrono::steady_clock::now();
  if (!shown_ || now - last_ < kRefresh) return;
  last_ = now;
  std::string text = fmt::format("{} of {} {}", done, all, what_);
  if (done > *found_) {
    const double each = seconds(now - start_) / static_cast<double>(done - *found_);
    text += fmt::format(", about {:.0f} s left", each * static_cast<double>(all - done));
  }
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
}

}  // namespace swarmfit::cli
