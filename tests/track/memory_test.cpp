// SPDX-License-Identifier: MIT
// What reading a file may take: ten times its size and 64 MiB. Of packed files the size is that of what is in them.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "libtrack/rng.h"
#include "libtrack/write/write.h"
#include "tests/track/build.h"
#include "tests/track/packed_make.h"

namespace swarmfit {
namespace {

constexpr std::size_t kRows = 40'000, kMiB = 1 << 20;

// Peak of a process that does this [bytes].
std::size_t peak_of(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  rusage used{};
  int status = 0;
  wait4(child, &status, 0, &used);
  EXPECT_EQ(status, 0);
  return static_cast<std::size_t>(used.ru_maxrss) * 1024;
}

void expect_within_budget(const char* what, const std::string& bytes, std::size_t size, const ReadOptions& options) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const std::size_t before = peak_of([] {});
  const std::size_t taken = peak_of([&] { read_tracks_bytes("f.csv", bytes, options); });
  EXPECT_LT(taken - before, 10 * size + 64 * kMiB) << what << ": " << size << " bytes";
}

std::string csv() {
  const Rng rng{5};
  std::string out = "id,frame,x,y\n";
  for (std::size_t i = 0; i < kRows; ++i)
    out += fmt::format("{},{},{:.6f},{:.6f}\n", i % 20, i / 20, rng.uniform(Stream::probe, i, 0), rng.uniform(Stream::probe, i, 1));
  return out;
}

// The same cells with the attributes that spreadsheets have.
std::string sheet() {
  const Rng rng{5};
  std::string out = "<worksheet><sheetData>";
  out += R"(<row r="1"><c r="A1" t="inlineStr"><is><t>id</t></is></c><c r="B1" t="inlineStr"><is><t>frame</t></is></c>)";
  out += R"(<c r="C1" t="inlineStr"><is><t>x</t></is></c><c r="D1" t="inlineStr"><is><t>y</t></is></c></row>)";
  for (std::size_t i = 0; i < kRows; ++i)
    out += fmt::format(
        R"(<row r="{0}" spans="1:4"><c r="A{0}" s="1"><v>{1}</v></c><c r="B{0}" s="1"><v>{2}</v></c><c r="C{0}" s="2"><v>{3}</v></c>)"
        R"(<c r="D{0}" s="2"><v>{4}</v></c></row>)",
        i + 2, i % 20, i / 20, rng.uniform(Stream::probe, i, 0), rng.uniform(Stream::probe, i, 1));
  return out + "</sheetData></worksheet>";
}

TEST(Memory, Text) {
  const auto bytes = csv();
  expect_within_budget("text", bytes, bytes.size(), flags());
}

TEST(Memory, Packed) {
  const auto bytes = csv();
  expect_within_budget("gzip", gzipped(bytes), bytes.size(), flags());
}

TEST(Memory, Spreadsheet) {
  const auto cells = sheet();
  const auto book =
      zipped({{"xl/workbook.xml", R"(<workbook><sheets><sheet name="a" r:id="r1"/></sheets></workbook>)"},
              {"xl/_rels/workbook.xml.rels", R"(<Relationships><Relationship Id="r1" Target="worksheets/sheet1.xml"/></Relationships>)"},
              {"xl/worksheets/sheet1.xml", cells}});
  expect_within_budget("xlsx", book, book.size(), flags());
}

TEST(Memory, Containers) {
  const auto tracks = read(csv(), flags());
  for (const auto& format : written_formats()) {
    if (!format.write) continue;
    const auto bytes = format.write(tracks);
    expect_within_budget(std::string(format.name).c_str(), bytes, bytes.size(), {});
  }
}

}  // namespace
}  // namespace swarmfit
