// SPDX-License-Identifier: MIT
#include "libtrack/read/number_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "libtrack/error.h"
#include "libtrack/read/coarse_times.h"
#include "libtrack/read/frame_clock.h"

namespace swarmfit {
namespace {

constexpr double kFine = 65536, kMostFrames = 9e15;

class Numbering {
 public:
  Numbering(RawTable& table, const ReadOptions& options, const std::vector<std::uint32_t>& order, const std::vector<std::size_t>& first)
      : table_(table), options_(options), order_(order), first_(first) {}

  NumberedFrames run() && {
    number();
    return std::move(out_);
  }

 private:
  bool has(FileColumn c) const { return table_.has(c); }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(table_.file + ": " + what); }
  void note(std::string text) { table_.notes.push_back(std::move(text)); }

  std::vector<double> ordered(FileColumn c) const {
    std::vector<double> out;
    out.reserve(order_.size());
    for (const auto row : order_) out.push_back(table_[c][row]);
    return out;
  }

  void number() {
    const double stated = table_.dt > 0 ? table_.dt : options_.fps ? 1 / *options_.fps : 0;
    if (!has(FileColumn::t)) return use_frames(stated, table_.t0);
    const auto time = ordered(FileColumn::t);
    if (has(FileColumn::frame) && stated > 0 && times_are_rounded(time, stated)) return use_frames(stated, table_.t0);
    if (options_.resample && !(stated > 0) && !has(FileColumn::frame)) return use_fine_grid(time);
    FrameClock clock = has(FileColumn::frame) ? fit_known_frames(time, ordered(FileColumn::frame)) : fit_frame_clock(time, first_);
    if (!has(FileColumn::frame)) look_behind_rounding(clock, time, stated);
    if (clock.dt == 0 && stated > 0) return use_rate(time, clock, stated);
    if (clock.dt == 0 && !(time.front() < time.back())) fail(clock.problem + "; expected `fps`, for example `fps` 25");
    if (!clock.problem.empty()) fail(clock.problem + "; expected time stamps at a constant interval (`fps` puts them on one)");
    check_rate(table_, options_, 1 / clock.dt, "the time stamps say");
    if (table_.dt > 0 && std::abs(table_.dt / clock.dt - 1) > 0.01)
      fail(fmt::format("the time stamps say {:.6g} s per frame but the file states {:.6g} s; expected the same within 1 %", clock.dt,
                       table_.dt));
    if (clock.deviation > 1e-6 * clock.dt)
      note(fmt::format("time stamps were binned to the frame interval {:.9g} s; the largest deviation is {:.3g} s ({:.2g} of it)", clock.dt,
                       clock.deviation, clock.deviation / clock.dt));
    if (has(FileColumn::frame) && table_.dt > 0) return use_frames(table_.dt, table_.t0);
    out_.dt = clock.dt;
    out_.t0 = clock.t0;
    out_.frame = std::move(clock.frame);
  }

  // Times without an interval of their own: one single moment, or irregular ones.
  void use_rate(const std::vector<double>& time, const FrameClock& clock, double stated) {
    double worst = 0;
    if (!countable(time, stated) || !(std::abs(table_.t0) / stated <= kMostFrames))
      fail(fmt::format("{}, and frames of {:.6g} s cannot be counted up to it; expected another rate", clock.problem, stated));
    for (const double t : time) {
      out_.frame.push_back(std::llround((t - table_.t0) / stated));
      worst = std::max(worst, std::abs(t - table_.t0 - static_cast<double>(out_.frame.back()) * stated));
    }
    out_.dt = stated;
    const bool moment = *std::min_element(time.begin(), time.end()) == *std::max_element(time.begin(), time.end());
    out_.t0 = table_.dt > 0 ? table_.t0 : moment ? time[0] - static_cast<double>(out_.frame[0]) * stated : 0;
    if (!moment)
      note(fmt::format("{}; rows were put on the nearest frame of {:.6g} s, {}", clock.problem, stated,
                       worst > 0 ? fmt::format("by up to {:.3g} s away", worst) : "where all of them lie"));
  }

  // Times that are resampled count as they stand: on a grid so fine that the nearest frame is the time itself.
  void use_fine_grid(const std::vector<double>& time) {
    const auto [first, last] = std::minmax_element(time.begin(), time.end());
    out_.dt = 1 / (*options_.resample * kFine);
    out_.t0 = std::floor(*first);
    if ((*last - out_.t0) / out_.dt > kMostFrames)
      fail(fmt::format("it lasts {:.6g} s, too long for `resample` {:.6g}; expected a lower rate", *last - *first, *options_.resample));
    for (const double t : time) out_.frame.push_back(std::llround((t - out_.t0) / out_.dt));
  }

  // Whole seconds beside frame numbers at 25 Hz say nothing that the frames do not.
  bool times_are_rounded(const std::vector<double>& time, double dt) {
    const double step = written_step(time);
    if (!(step > dt) || !only_rounded(time, ordered(FileColumn::frame), dt, step)) return false;
    note(fmt::format("times are written in steps of {:.6g} s, more coarsely than frames follow each other: the frame numbers count", step));
    return true;
  }

  // Times with two decimals of a camera at 60 Hz are no clock of 100 Hz with gaps.
  void look_behind_rounding(FrameClock& clock, const std::vector<double>& time, double stated) const {
    const double step = written_step(time);
    if (clock.dt == 0 || step == 0) return;
    if (clock.problem.empty() && !ticks_like_rounding(clock, first_, step)) return;
    auto better = stated > 0 ? clock_behind_rounding(time, first_, step, stated) : clock_behind_rounding(time, step);
    if (better) {
      clock = std::move(*better);
    } else if (clock.problem.empty() && !(stated > 0)) {
      fail(fmt::format("times are written in steps of {:.6g} s, too coarsely to tell the frame interval; expected `fps`", step));
    }
  }

  void use_frames(double dt, double t0) {
    for (const auto row : order_) out_.frame.push_back(static_cast<std::int64_t>(table_[FileColumn::frame][row]));
    out_.dt = dt;
    out_.t0 = t0;
  }

  RawTable& table_;
  const ReadOptions& options_;
  const std::vector<std::uint32_t>& order_;
  const std::vector<std::size_t>& first_;
  NumberedFrames out_;
};

}  // namespace

void check_rate(const RawTable& table, const ReadOptions& options, double in_file, const char* words) {
  if (options.fps && std::abs(*options.fps / in_file - 1) > 0.01)
    throw InputError(table.file + ": " +
                     fmt::format("{} {:.6g} frames per second but `fps` says {:.6g}; expected the same within 1 %, or none given", words,
                                 in_file, *options.fps));
}

NumberedFrames number_frames(RawTable& table, const ReadOptions& options, const std::vector<std::uint32_t>& order,
                             const std::vector<std::size_t>& first) {
  return Numbering(table, options, order, first).run();
}

}  // namespace swarmfit
