// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "fit/compare/compare.h"

namespace swarmfit::cli {

// Progress of a comparison on standard error: one line that renews itself on a terminal; in a pipe one line per model and pass, if wanted.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet, bool phases_in_pipe = true);
  ~ProgressLine();
  void show(const CompareProgress& now, const std::string& before = "");
  void wipe();

 private:
  std::string text(const CompareProgress& now) const;

  bool quiet_, terminal_, phases_in_pipe_;
  std::chrono::steady_clock::time_point start_;          // of the phase: one model's pass
  std::chrono::steady_clock::time_point last_;           // when the line was last drawn
  std::chrono::steady_clock::time_point last_in_phase_;  // of the last report: where the next phase starts
  std::string phase_;
};

// Progress of a study of many comparisons: a line for each that is done, and on a terminal what the next one is doing and how long all may
// take.
class StudyProgress {
 public:
  StudyProgress(bool quiet, std::size_t all);
  void show(const CompareProgress& now);
  void done(const std::string& what);

 private:
  std::string before() const;

  bool quiet_;
  std::size_t all_, done_ = 0;
  std::size_t computed_ = 0;  // of those done; the others were in a checkpoint
  bool computing_ = false;
  std::chrono::steady_clock::duration spent_{};  // on those computed
  std::chrono::steady_clock::time_point last_;   // when one was done
  ProgressLine line_;
};

// How many of equal pieces of work are done, in a line that renews itself on a terminal, with the time left.
class CountLine {
 public:
  CountLine(bool quiet, std::string what);
  ~CountLine();
  CountLine(const CountLine&) = delete;
  CountLine& operator=(const CountLine&) = delete;
  void show(std::size_t done, std::size_t all);  // the first call tells what was found in a checkpoint

 private:
  bool shown_;
  std::string what_;
  std::optional<std::size_t> found_;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace swarmfit::cli
