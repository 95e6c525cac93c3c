// SPDX-License-Identifier: MIT
// Holds every source of the repository against the rules.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/house/rules.h"

namespace swarmfit::house {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SWARMFIT_SOURCE_DIR;
constexpr std::array kRooms{"libtrack", "libswarm", "libeval", "fit", "reports", "cli", "tests", "bench"};

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::vector<Source>& sources() {
  static const std::vector<Source> all = [] {
    std::vector<Source> found;
    for (const auto* room : kRooms) {
      if (!fs::exists(kRoot / room)) continue;
      for (const auto& entry : fs::recursive_directory_iterator(kRoot / room))
        if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h")
          found.push_back({fs::relative(entry.path(), kRoot).generic_string(), read(entry.path())});
    }
    std::sort(found.begin(), found.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
    return found;
  }();
  return all;
}

Breaches in_all_sources(Breaches (*rule)(const Source&)) {
  Breaches all;
  for (const auto& source : sources()) std::ranges::copy(rule(source), std::back_inserter(all));
  return all;
}

TEST(House, HasSources) { EXPECT_GT(sources().size(), 20U); }
TEST(House, IncludesFollowTheArrows) { EXPECT_THAT(in_all_sources(check_arrows), testing::IsEmpty()); }
TEST(House, IncludesPointDownWithinARoom) { EXPECT_THAT(in_all_sources(check_sub_rooms), testing::IsEmpty()); }
TEST(House, NoRoomIsReachedRoundACorner) { EXPECT_THAT(check_reach(sources()), testing::IsEmpty()); }
TEST(House, LibrariesStayInTheirRooms) { EXPECT_THAT(in_all_sources(check_libraries), testing::IsEmpty()); }
TEST(House, OneFileIncludesCli11) { EXPECT_THAT(check_cli11(sources()), testing::IsEmpty()); }
TEST(House, NothingBelowCliPrintsOrLooksOutside) { EXPECT_THAT(in_all_sources(check_calls), testing::IsEmpty()); }
TEST(House, FilesBeginAlike) { EXPECT_THAT(in_all_sources(check_form), testing::IsEmpty()); }

TEST(House, EveryTestIsBuilt) { EXPECT_THAT(check_tests_are_built(sources(), read(kRoot / "tests/CMakeLists.txt")), testing::IsEmpty()); }

TEST(House, LinterChecksAreOffForAReason) { EXPECT_THAT(check_tidy_reasons(read(kRoot / ".clang-tidy")), testing::IsEmpty()); }

TEST(House, SourcesLieInKnownRooms) {
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const auto name = entry.path().filename().string();
    if (!entry.is_directory() || name.starts_with(".") || name == "build" || std::ranges::find(kRooms, name) != kRooms.end()) continue;
    for (const auto& file : fs::recursive_directory_iterator(entry.path()))
      EXPECT_FALSE(file.path().extension() == ".cpp" || file.path().extension() == ".h") << file.path() << " lies in no room";
  }
}

}  // namespace
}  // namespace swarmfit::house
