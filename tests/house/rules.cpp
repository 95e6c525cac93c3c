// SPDX-License-Identifier: MIT
#include "tests/house/rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

namespace swarmfit::house {
namespace {

using Names = std::vector<std::string_view>;

// ---- the tables ---------------------------------------------------------------------------------------------------------------

struct Arrow {
  std::string_view room;
  Names may_include;
};

const std::array<Arrow, 8> kArrows{{
    {"libtrack", {"libtrack"}},
    {"libswarm", {"libswarm", "libtrack"}},
    {"libeval", {"libeval", "libtrack"}},
    {"fit", {"fit", "libswarm", "libeval", "libtrack"}},
    {"reports", {"reports", "fit", "libeval", "libtrack"}},
    {"cli", {"cli", "reports", "fit", "libswarm", "libeval", "libtrack"}},
    {"bench", {"bench", "tests", "reports", "fit", "libswarm", "libeval", "libtrack"}},
    {"tests", {"tests", "cli", "reports", "fit", "libswarm", "libeval", "libtrack"}},
}};

// The sub-rooms of a room, lowest first: an include within the room may only point down, or stay. "": files that lie in the room itself.
struct SubRooms {
  std::string_view room;
  Names lowest_first;
};

const std::array<SubRooms, 4> kSubRooms{{
    {"libtrack", {"", "read", "write"}},
    {"libswarm", {"", "models", "scenario"}},
    {"fit", {"results", "store", "optimise", "infer", "experiment", "synthesis", "model_fit", "compare", "study"}},
    {"reports", {"write", "draw", "motion", "comparison", "recording", "study", "run"}},
}};

struct Library {
  std::string_view prefix;  // of what stands between < and >
  Names rooms;              // empty: all
  bool in_headers;
};

// The first row that fits counts. Tests and benchmarks may include anything that stands here.
const std::vector<Library> kLibraries{
    {"Eigen/Sparse", {"fit"}, false},
    {"Eigen/", {}, true},
    {"fmt/", {}, true},
    {"mpi.h", {"cli"}, true},
    {"sched.h", {"cli"}, true},
    {"omp.h", {"libswarm", "fit", "cli"}, true},
    {"boost/", {"libtrack", "libswarm", "libeval", "fit"}, false},
    {"nanoflann", {"libswarm", "libeval"}, false},
    {"matio.h", {"libtrack"}, false},
    {"hdf5", {"libtrack"}, false},
    {"sqlite3.h", {"libtrack"}, false},
    {"minizip/", {"libtrack"}, false},
    {"geodesic.h", {"libtrack"}, false},
    {"zlib.h", {"libtrack", "reports"}, false},
    {"pugixml", {"libtrack"}, false},
    {"openssl/", {"libtrack", "reports"}, false},
    {"immintrin.h", {"libtrack"}, false},  // intrinsics, which come with the compiler
    {"nlopt", {"fit"}, false},
    {"ceres/", {"fit"}, false},
    {"nlohmann/json_fwd.hpp", {"libeval", "fit", "reports", "cli"}, true},
    {"nlohmann/", {"libtrack", "libeval", "fit", "reports", "cli"}, false},
    {"toml++/", {"libswarm", "fit", "cli"}, false},
    {"CLI/", {"cli"}, false},
    {"Random123/", {"tests"}, false},
    {"unsupported/Eigen/", {"tests"}, false},
    {"gtest/", {"tests"}, true},
    {"gmock/", {"tests"}, true},
    {"benchmark/", {"bench"}, true},
    {"libnoise/", {"bench"}, false},
    {"pagmo/", {"bench"}, false},
    {"malloc.h", {"libtrack"}, false},
    {"math.h", {"libtrack", "libeval", "fit"}, false},  // Boost 1.74's pchip does not compile without it
    {"spawn.h", {"cli"}, false},
    {"unistd.h", {"libtrack", "fit", "reports", "cli"}, false},
    {"fcntl.h", {"libtrack", "fit", "reports", "cli"}, false},
    {"sys/", {"libtrack", "fit", "reports", "cli"}, false},
};

const Names kBelowCli{"libtrack", "libswarm", "libeval", "fit", "reports"};

struct Banned {
  std::string_view why;
  std::string_view pattern;
};

const std::array<Banned, 5> kBanned{{
    {"prints", R"(\bstd::(cout|cerr|clog)\b|\b(printf|vprintf|puts|putchar|perror)\s*\(|\bfmt::print\b|\b(stdout|stderr)\b|<iostream>)"},
    {"reads the clock",
     R"(\bstd::(time|clock)\b|\b(system|steady|high_resolution|utc)_clock\b|\btime\s*\(\s*(NULL|nullptr|0)\s*\)|\b(gettimeofday|clock_gettime|omp_get_wtime)\b)"},
    {"reads the environment", R"(\b(secure_)?getenv\b)"},
    {"draws random numbers that are not ours",
     R"(\brandom_device\b|\bs?rand\s*\(|\bstd::(\w+_distribution|mt19937\w*|default_random_engine|shuffle|sample)\b|\bsetRandom\b|::Random\s*\(|<random>)"},
    {"makes a model without make_model, which checks what it asks for", R"(\bspec\s*(\.|->)\s*make\s*\()"},
}};

// ---- reading a source ---------------------------------------------------------------------------------------------------------

bool contains(const Names& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

std::string place(const Source& source, int line) { return source.path + ":" + std::to_string(line) + ": "; }

// Length of the comment or literal that begins at `at`, or 0.
struct Token {
  std::size_t length = 0;
  bool comment = false;
};

std::size_t until(std::string_view text, std::string_view end, std::size_t from) {
  const auto found = text.find(end, from);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

Token quoted(std::string_view text, std::size_t at) {
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != text[at] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
  return {std::min(end + 1, text.size()) - at, false};
}

Token token_at(std::string_view text, std::size_t at) {
  const auto rest = text.substr(at);
  const bool in_word = at > 0 && (std::isalnum(static_cast<unsigned char>(text[at - 1])) != 0 || text[at - 1] == '_');
  if (rest.starts_with("//")) return {std::min(rest.find('\n'), rest.size()), true};
  if (rest.starts_with("/*")) return {until(rest, "*/", 2), true};
  if (rest.starts_with("R\"") && !in_word) {
    const auto open = rest.find('(');
    if (open != std::string_view::npos) return {until(rest, ")" + std::string(rest.substr(2, open - 2)) + "\"", open), false};
  }
  if (rest.starts_with("\"") || (rest.starts_with("'") && !in_word)) return quoted(text, at);  // 1'000 is no literal
  return {};
}

std::string blanked(std::string text, bool literals_too) {
  for (std::size_t at = 0; at < text.size();) {
    const Token token = token_at(text, at);
    if (token.comment || (literals_too && token.length > 0))
      std::replace_if(
          text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(at + token.length),
          [](char c) { return c != '\n'; }, ' ');
    at += std::max<std::size_t>(token.length, 1);
  }
  return text;
}

template <class Visit>
void for_each_line(const std::string& text, Visit visit) {
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) visit(line, number);
}

// A bare name without a dot is the standard library's: <vector>.
bool is_standard(std::string_view name) { return name.find_first_of("./") == std::string_view::npos; }

}  // namespace

std::vector<Include> includes_of(const Source& source) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for_each_line(blanked(source.text, false), [&](const std::string& line, int number) {
    if (std::smatch match; std::regex_search(line, match, kInclude)) found.push_back({match[2], match[1] == "\"", number});
  });
  return found;
}

std::string code_of(const Source& source) { return blanked(source.text, true); }

// ---- the rules ----------------------------------------------------------------------------------------------------------------

Breaches check_arrows(const Source& source) {
  const auto arrow = std::find_if(kArrows.begin(), kArrows.end(), [&](const Arrow& a) { return a.room == source.room(); });
  if (arrow == kArrows.end()) return {source.path + ": " + std::string(source.room()) + "/ is no room of the house"};
  Breaches breaches;
  for (const auto& include : includes_of(source)) {
    const auto room = std::string_view(include.name).substr(0, include.name.find('/'));
    const bool ours = std::any_of(kArrows.begin(), kArrows.end(), [&](const Arrow& a) { return a.room == room; });
    if (include.quoted != ours || include.name.find("..") != std::string::npos)
      breaches.push_back(place(source, include.line) + include.name + " must be written \"room/file.h\" if ours, <like/this> if not");
    else if (ours && !contains(arrow->may_include, room))
      breaches.push_back(place(source, include.line) + std::string(source.room()) + "/ may not include " + include.name);
  }
  return breaches;
}

Breaches check_reach(const std::vector<Source>& sources) {
  std::map<std::string, std::vector<std::string>> includes;
  for (const auto& source : sources)
    for (const auto& include : includes_of(source))
      if (include.quoted) includes[source.path].push_back(include.name);
  Breaches breaches;
  for (const auto& source : sources) {
    const auto arrow = std::find_if(kArrows.begin(), kArrows.end(), [&](const Arrow& a) { return a.room == source.room(); });
    if (arrow == kArrows.end()) continue;
    std::map<std::string, std::string> by{{source.path, ""}};  // through which file each was reached
    for (std::vector<std::string> open{source.path}; !open.empty();) {
      const std::string file = open.back();
      open.pop_back();
      for (const auto& next : includes[file]) {
        if (!by.emplace(next, file).second) continue;
        const auto room = std::string_view(next).substr(0, next.find('/'));
        if (contains(arrow->may_include, room))
          open.push_back(next);
        else
          breaches.push_back(source.path + ": reaches " + next + " through " + file);
      }
    }
  }
  return breaches;
}

Breaches check_sub_rooms(const Source& source) {
  const auto rooms = std::find_if(kSubRooms.begin(), kSubRooms.end(), [&](const SubRooms& r) { return r.room == source.room(); });
  if (rooms == kSubRooms.end()) return {};
  // Where a path of this room lies: 0 is the lowest sub-room; the number of them if it lies in none.
  const auto height = [&](std::string_view path) {
    path.remove_prefix(rooms->room.size() + 1);
    const auto slash = path.find('/');
    const auto sub_room = slash == std::string_view::npos ? "" : path.substr(0, slash);
    return std::find(rooms->lowest_first.begin(), rooms->lowest_first.end(), sub_room) - rooms->lowest_first.begin();
  };
  const auto here = height(source.path);
  if (here == std::ssize(rooms->lowest_first)) return {source.path + ": lies in no sub-room of " + std::string(rooms->room) + "/"};
  Breaches breaches;
  for (const auto& include : includes_of(source))
    if (include.quoted && include.name.starts_with(std::string(rooms->room) + '/') && height(include.name) > here)
      breaches.push_back(place(source, include.line) + source.path + " may not include " + include.name + ", which lies higher");
  return breaches;
}

Breaches check_libraries(const Source& source) {
  Breaches breaches;
  const bool anything = source.room() == "tests" || source.room() == "bench";
  for (const auto& include : includes_of(source)) {
    if (include.quoted || is_standard(include.name)) continue;
    const auto row =
        std::find_if(kLibraries.begin(), kLibraries.end(), [&](const Library& l) { return include.name.starts_with(l.prefix); });
    const auto at = place(source, include.line) + "<" + include.name + "> ";
    if (row == kLibraries.end())
      breaches.push_back(at + "is not a library of the table in tests/house/rules.cpp");
    else if (!anything && !row->rooms.empty() && !contains(row->rooms, source.room()))
      breaches.push_back(at + "has no business in " + std::string(source.room()) + "/");
    else if (!anything && source.is_header() && !row->in_headers)
      breaches.push_back(at + "belongs into a .cpp file");
  }
  return breaches;
}

Breaches check_calls(const Source& source) {
  static const std::vector<std::regex> kPatterns = [] {
    std::vector<std::regex> patterns;
    for (const auto& banned : kBanned) patterns.emplace_back(std::string(banned.pattern), std::regex::optimize);
    return patterns;
  }();
  Breaches breaches;
  if (!contains(kBelowCli, source.room())) return breaches;
  for_each_line(code_of(source), [&](const std::string& line, int number) {
    for (std::size_t k = 0; k < kBanned.size(); ++k)
      if (std::smatch match; std::regex_search(line, match, kPatterns[k]))
        breaches.push_back(place(source, number) + match.str() + " " + std::string(kBanned[k].why));
  });
  return breaches;
}

Breaches check_form(const Source& source) {
  Breaches breaches;
  const auto top = source.text.substr(0, source.text.find('\n'));
  if (top != "// SPDX-License-Identifier: MIT")
    breaches.push_back(place(source, 1) + "the first line must be // SPDX-License-Identifier: MIT");
  if (source.is_header() && source.text.find("\n#pragma once\n") == std::string::npos)
    breaches.push_back(place(source, 1) + "a header needs #pragma once");
  return breaches;
}

Breaches check_cli11(const std::vector<Source>& sources) {
  Breaches includers;
  for (const auto& source : sources)
    for (const auto& include : includes_of(source))
      if (include.name.starts_with("CLI/") && (includers.empty() || !includers.back().starts_with(source.path + ":")))
        includers.push_back(place(source, include.line) + "includes CLI11; one file of cli/ does that for all");
  return includers.size() > 1 ? includers : Breaches{};
}

Breaches check_tests_are_built(const std::vector<Source>& sources, std::string_view tests_cmake) {
  static const std::regex kPath(R"(tests/(\w+)/\w+\.cpp)");
  Breaches breaches;
  for (const auto& source : sources) {
    if (source.room() != "tests" || source.is_header()) continue;
    std::smatch match;
    const bool in_a_room = std::regex_match(source.path, match, kPath);
    const bool room_is_built = in_a_room && tests_cmake.find("\nroom_tests(" + match[1].str() + " ") != std::string_view::npos;
    const bool is_named = tests_cmake.find(source.path.substr(std::string_view("tests/").size())) != std::string_view::npos;
    const std::string fuzzed = source.path.starts_with("tests/fuzz/") ? source.path.substr(std::string_view("tests/fuzz/").size()) : "";
    const bool is_fuzzed =
        !fuzzed.empty() && tests_cmake.find("\nfuzz_target(" + fuzzed.substr(0, fuzzed.find('.')) + ' ') != std::string_view::npos;
    if (!room_is_built && !is_named && !is_fuzzed) breaches.push_back(source.path + ": no line of tests/CMakeLists.txt builds it");
  }
  return breaches;
}

Breaches check_tidy_reasons(std::string_view clang_tidy) {
  const std::string text(clang_tidy);
  const auto checks = text.find("\nChecks:");
  if (checks == std::string::npos) return {".clang-tidy: no Checks"};
  static const std::regex kOff(R"((?:^|[\s,"'])-([a-z][\w.-]*\*?))");
  const auto end = text.find("\n\n", checks);
  const std::string list = text.substr(checks, end == std::string::npos ? end : end - checks), reasons = text.substr(0, checks);
  Breaches breaches;
  for (std::sregex_iterator off(list.begin(), list.end(), kOff); off != std::sregex_iterator(); ++off)
    if (reasons.find("# " + (*off)[1].str() + ": ") == std::string::npos)
      breaches.push_back(".clang-tidy: " + (*off)[1].str() + " is off without a reason in the comments at the top");
  return breaches;
}

}  // namespace swarmfit::house
