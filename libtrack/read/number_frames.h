// SPDX-License-Identifier: MIT
// When each row was filmed: frame numbers from frames, from times, or from both.
#pragma once

#include <cstdint>
#include <vector>

#include "libtrack/read/raw_table.h"

namespace swarmfit {

struct NumberedFrames {
  std::vector<std::int64_t> frame;  // along `order`
  double dt = 0, t0 = 0;            // [s] of a frame, and of frame 0
};

// `order`: rows of the table, grouped by individual and ascending in time; individual k has order[first[k] .. first[k + 1]). What was
// decided on the way becomes a note of the table. Throws InputError where times and rates contradict each other, or do not tell the frames.
NumberedFrames number_frames(RawTable& table, const ReadOptions& options, const std::vector<std::uint32_t>& order,
                             const std::vector<std::size_t>& first);

// That `fps`, if it is given, is this rate within 1 %; `words` begin the message.
void check_rate(const RawTable& table, const ReadOptions& options, double in_file, const char* words);

}  // namespace swarmfit
