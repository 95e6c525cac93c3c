// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "libtrack/error.h"
#include "libtrack/read/read.h"

namespace swarmfit {

// A file that exists only in the test.
inline Tracks read(std::string bytes, const ReadOptions& options = {}) { return read_tracks_bytes("f.csv", std::move(bytes), options); }

// The message of the InputError; "no error" when there is none.
inline std::string error_of(std::string bytes, const ReadOptions& options = {}, const std::string& name = "f.csv") {
  try {
    read_tracks_bytes(name, std::move(bytes), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Flags for rows of frame numbers.
inline ReadOptions flags(std::string columns = {}) { return {.columns = std::move(columns), .fps = 10, .unit = "m"}; }

}  // namespace swarmfit
