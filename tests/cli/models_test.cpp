// SPDX-License-Identifier: MIT
// The pages of docs/models say what the program says.
#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const fs::path kPages = fs::path(SWARMFIT_SOURCE_DIR) / "docs/models";
constexpr const char* kAdvice = ": out of date; run docs/make_models";

std::string printed(const std::string& arguments) {
  FILE* pipe = popen(("'" SWARMFIT_PROGRAM "' " + arguments).c_str(), "r");
  std::string out;
  std::array<char, 4096> buffer;
  for (std::size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) out.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << arguments;
  return out;
}

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> all;
  const auto document = nlohmann::json::parse(printed(list + " --json"));
  for (const auto& entry : document.at(list)) all.push_back(entry.at("name"));
  return all;
}

std::vector<std::string> names() { return names_in("models"); }

TEST(ModelPages, SayWhatTheProgramSays) {
  ASSERT_GE(names().size(), 2u);
  for (const auto& name : names())
    EXPECT_THAT(content(kPages / (name + ".md")), StartsWith(printed("models " + name + " --page"))) << name << kAdvice;
}

TEST(ModelPages, HaveASmallPicture) {
  for (const auto& name : names()) {
    const auto picture = content(kPages / (name + ".svg"));
    EXPECT_THAT(picture, StartsWith("<svg ")) << name << kAdvice;
    EXPECT_LT(picture.size(), 60'000u) << name;
  }
}

TEST(ModelPages, NoneIsLeftOver) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(kPages)) files += entry.is_regular_file();
  EXPECT_EQ(files, 2 * names().size()) << kPages << kAdvice;
}

TEST(ModelPages, SayHowTheirPictureWasMade) {
  for (const auto& name : names()) {
    std::string scene = printed("models " + name + " --scene");
    ASSERT_FALSE(scene.empty()) << name;
    scene.pop_back();
    EXPECT_THAT(content(kPages / (name + ".md")), HasSubstr("`swarmfit simulate " + scene + " --picture")) << name << kAdvice;
  }
}

TEST(Gallery, IsSmallAndOfTheseScenarios) {
  const auto page = content(kPages / "../gallery.html");
  EXPECT_LT(page.size(), 6'000'000u);
  for (const auto& name : names_in("scenarios")) EXPECT_THAT(page, HasSubstr("<h2 id=\"" + name + "-title\">")) << name << kAdvice;
}

TEST(Pages, AreWrittenBesideTheText) {
  const auto page = fs::temp_directory_path() / "swarmfit_cli_page.html";
  EXPECT_THAT(printed("describe demo --frames 0:30 --html '" + page.string() + "'"), HasSubstr("demo"));
  EXPECT_THAT(content(page), HasSubstr("<code>swarmfit describe demo --frames 0:30 --html " + page.string() + "</code>"));
  EXPECT_THAT(printed("simulate vicsek --set 'eta=0.1' --frames 5 --html '" + page.string() + "'"), testing::IsEmpty());
  EXPECT_THAT(content(page), HasSubstr("<h1>vicsek</h1>"));
  EXPECT_THAT(printed("gallery '" + page.string() + "'"), testing::IsEmpty());
  EXPECT_THAT(content(page), HasSubstr("scenes in motion"));
  fs::remove(page);
}

// The manual is the comment that opens the model's file, without comment signs and licence.
TEST(ModelPages, ManualIsTheCommentOfTheModel) {
  for (const auto& name : names()) {
    const auto manual = printed("models " + name);
    EXPECT_THAT(manual, StartsWith(name + " – "));
    EXPECT_THAT(manual, Not(HasSubstr("SPDX")));
    EXPECT_THAT(manual, Not(HasSubstr("\n//")));
  }
}

}  // namespace
