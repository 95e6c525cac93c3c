// SPDX-License-Identifier: MIT
#pragma once

#include "fit/experiment/executor.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Passes frames on, and ends the simulation that makes them with Interrupted where its executor was asked to stop: one simulation may take
// longer than anybody waits.
class StopBetweenFrames : public FrameSink {
 public:
  StopBetweenFrames(const Executor& by, FrameSink& to) : by_(by), to_(to) {}
  void frame(const Snapshot& now) override {
    by_.stop_if_asked();
    to_.frame(now);
  }

 private:
  const Executor& by_;
  FrameSink& to_;
};

}  // namespace swarmfit
