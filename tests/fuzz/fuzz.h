// SPDX-License-Identifier: MIT
// What is fuzzed: every reader of bytes that others have written. A target takes any bytes; it must come back, or throw what the program
// shows as its one line. Anything else that is thrown, and every fault that a sanitizer sees, is a fault of ours.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit::fuzz {

struct Target {
  std::string name;  // also of the folder of its seeds
  std::function<void(const std::string& bytes)> take;
  bool slow = false;  // starts a process for every input
};

// Those of one program: readers.cpp, meshes.cpp or settings.cpp.
std::vector<Target> targets();

// Ends the process, saying why.
[[noreturn]] void broken(const std::string& why);

// Throws std::runtime_error naming those there are.
const Target& find(const std::vector<Target>& all, std::string_view name);

// Calls work(); InputError, in its one form, and RunError are answers.
void contract(const std::function<void()>& work);

}  // namespace swarmfit::fuzz
