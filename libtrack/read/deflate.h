// SPDX-License-Identifier: MIT
#pragma once

namespace swarmfit {

// deflate cannot do better than this: what claims to be larger than its file could hold is a lie.
inline constexpr double kBestCompression = 1032;

}  // namespace swarmfit
