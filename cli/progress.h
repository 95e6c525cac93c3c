// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "fit/compare.h"

namespace swarmfit::cli {

// Progress of a comparison on standard error: one line that renews itself on a terminal, one line per model and pass in a pipe.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  void show(const CompareProgress& now);

 private:
  std::string text(const CompareProgress& now) const;

  bool quiet_, terminal_;
  std::chrono::steady_clock::time_point start_;          // of the phase: one model's pass
  std::chrono::steady_clock::time_point last_;           // when the line was last drawn
  std::chrono::steady_clock::time_point last_in_phase_;  // of the last report: where the next phase starts
  std::string phase_;
};

}  // namespace swarmfit::cli
