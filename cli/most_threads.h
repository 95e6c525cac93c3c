// SPDX-License-Identifier: MIT
#pragma once

namespace swarmfit::cli {

inline constexpr int kMostThreads = 1024;  // libgomp ends the program where the system has no more

}  // namespace swarmfit::cli
