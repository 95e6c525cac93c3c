// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace swarmfit {

// Runs `work` in a child process and returns the bytes it returns: for libraries that can crash or hang on damaged input. An InputError or
// RunError that `work` throws arrives here as one; a crash, more than `seconds` of processor time, or more than `memory` bytes beyond what
// this process has now, becomes InputError(on_crash). To be called before any thread is started.
std::string isolated(const std::function<std::string()>& work, int seconds, std::size_t memory, const std::string& on_crash);

}  // namespace swarmfit
