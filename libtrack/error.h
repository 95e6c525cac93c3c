// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace swarmfit {

// Bad input from the user: a file, a flag, a config entry or a parameter. The program prints what() as its one line and exits with 2.
// The message has the form "place: what is wrong; what was expected", place being file[:line[:column]] or a flag.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Something that cannot be done now (disk full, no permission): one line, exit code 1.
struct RunError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// "file:line:column: text", leaving out the parts that are zero.
inline std::string at(const std::string& file, long line, long column, const std::string& text) {
  std::string place = file;
  if (line > 0) place += ':' + std::to_string(line);
  if (line > 0 && column > 0) place += ':' + std::to_string(column);
  return place + ": " + text;
}

}  // namespace swarmfit
