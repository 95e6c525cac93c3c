// SPDX-License-Identifier: MIT
// The rules of the house, as far as a program can hold the sources against them: who may include whom, what may not be called below
// cli/, how files begin. Each rule takes one file and returns one line per breach, so that rules can be tested on made-up files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmfit::house {

struct Source {
  std::string path;  // from the repository's root: "libswarm/models/boids.cpp"
  std::string text;

  bool is_header() const { return path.ends_with(".h"); }
  std::string_view room() const { return std::string_view(path).substr(0, path.find('/')); }
};

struct Include {
  std::string name;  // as written, without its brackets or quotes
  bool quoted;       // "..." is ours, <...> is not
  int line;
};

using Breaches = std::vector<std::string>;

std::vector<Include> includes_of(const Source&);

// The text with comments and the contents of string and character literals blanked out; line breaks stay.
std::string code_of(const Source&);

// Data flows libtrack, libswarm and libeval, fit, reports, cli; an include may only point against that, and no room includes a program.
Breaches check_arrows(const Source&);

// Within a room the sub-rooms are floors: an include may only point down, or stay. Since every include obeys, so does every chain of them.
Breaches check_sub_rooms(const Source&);

// Nor does any file reach such a room through what its includes include.
Breaches check_reach(const std::vector<Source>&);

// A library may be included only where its row of the table says, and a heavy one never in a header.
Breaches check_libraries(const Source&);

// Below cli/ nothing prints, reads the clock, the environment or the machine's entropy; nobody draws from std:: distributions or Eigen's
// Random(), whose bits are not ours to promise.
Breaches check_calls(const Source&);

// One licence line at the top; `#pragma once` in headers.
Breaches check_form(const Source&);

// CLI11 takes 14 s to compile: one file includes it.
Breaches check_cli11(const std::vector<Source>&);

// Every test source is one that tests/CMakeLists.txt builds: it lies in a room that is listed there, or is named itself.
Breaches check_tests_are_built(const std::vector<Source>&, std::string_view tests_cmake);

// Every check that .clang-tidy switches off stands with its reason in the comments above.
Breaches check_tidy_reasons(std::string_view clang_tidy);

}  // namespace swarmfit::house
