// SPDX-License-Identifier: MIT
// Spreadsheets: EthoVision's raw data, and any table.
#include <gmock/gmock.h>

#include "tests/track/build.h"
#include "tests/track/packed_make.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using Cells = std::vector<std::vector<std::string>>;

// One sheet per entry; texts inline, every second one shared; empty cells are left out.
std::string xlsx(const std::vector<std::pair<std::string, Cells>>& sheets) {
  std::vector<Member> members = {{"[Content_Types].xml", "<Types/>"}};
  std::string book = "<workbook xmlns:r=\"r\"><sheets>", links = "<Relationships>", shared = "<sst>";
  int strings = 0;
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    const auto n = std::to_string(s + 1);
    book += "<sheet name=\"" + sheets[s].first + "\" r:id=\"rId" + n + "\"/>";
    links += "<Relationship Id=\"rId" + n + "\" Target=\"worksheets/sheet" + n + ".xml\"/>";
    std::string xml = "<worksheet><sheetData>";
    for (std::size_t r = 0; r < sheets[s].second.size(); ++r) {
      xml += "<row r=\"" + std::to_string(r + 1) + "\">";
      for (std::size_t c = 0; c < sheets[s].second[r].size(); ++c) {
        const auto& text = sheets[s].second[r][c];
        if (text.empty()) continue;
        const auto at = "<c r=\"" + std::string(1, static_cast<char>('A' + c)) + std::to_string(r + 1) + "\"";
        if (text.find_first_not_of("0123456789.") == std::string::npos) {
          xml += at + "><v>" + text + "</v></c>";
        } else if ((r + c) % 2 == 0) {
          xml += at + " t=\"inlineStr\"><is><t>" + text + "</t></is></c>";
        } else {
          xml += at + " t=\"s\"><v>" + std::to_string(strings++) + "</v></c>";
          shared += "<si><r><t>" + text.substr(0, 1) + "</t></r><r><t>" + text.substr(1) + "</t></r></si>";
        }
      }
      xml += "</row>";
    }
    members.push_back({"xl/worksheets/sheet" + n + ".xml", xml + "</sheetData></worksheet>"});
  }
  members.push_back({"xl/workbook.xml", book + "</sheets></workbook>"});
  members.push_back({"xl/_rels/workbook.xml.rels", links + "</Relationships>"});
  members.push_back({"xl/sharedStrings.xml", shared + "</sst>"});
  return zipped(members);
}

Cells track(const std::string& subject, const std::string& trial, const std::string& unit = "cm") {
  return {{"Number of header lines:", "6"},
          {"Trial name", trial},
          {"Subject name", subject},
          {"Arena name", "A"},
          {"Trial time", "X center", "Y center", "X nose", "Y nose"},
          {"s", "cm", unit, "cm", "cm"},
          {"0", "1", "2", "11", "12"},
          {"0.04", "-", "-", "-", "-"},
          {"0.08", "3", "4", "13", "14"},
          {"0.12", "5", "6", "15", "16"}};
}

TEST(EthoVision, OneSheetPerSubject) {
  const auto tracks = read(xlsx({{"s1", track("Ada", "T1")}, {"s2", track("Bo", "T1")}, {"notes", {{"any", "text"}}}}));
  EXPECT_EQ(tracks.meta().from.format, "ethovision-xlsx");
  EXPECT_EQ(tracks.meta().unit, "cm");
  EXPECT_NEAR(tracks.dt(), 0.04, 1e-12);
  EXPECT_THAT(tracks.names(), ElementsAre("A Ada", "A Bo"));
  ASSERT_EQ(tracks.rows(), 6);
  EXPECT_EQ(tracks.frame()[2], 2) << "the gap stays a gap";
  EXPECT_EQ(tracks.pos()(5, 1), 6);
  EXPECT_EQ(read(xlsx({{"s1", track("Ada", "T1")}}), {.node = "nose"}).pos()(2, 0), 15);
}

TEST(EthoVision, WhatIsNotOneRecording) {
  const auto trials = xlsx({{"s1", track("Ada", "T1")}, {"s2", track("Ada", "T2")}});
  EXPECT_THAT(error_of(trials), HasSubstr("its sheets are of 2 trials, which are not one recording; expected `var` SHEET, one of s1, s2"));
  EXPECT_THAT(read(trials, {.variable = "s2"}).names(), ElementsAre("Ada"));
  EXPECT_THAT(error_of(xlsx({{"s1", track("Ada", "T1", "mm")}})), HasSubstr("sheet 's1' row 6 has positions in several units"));
  auto wrong = track("Ada", "T1");
  wrong[8][1] = "west";
  EXPECT_EQ(error_of(xlsx({{"s1", wrong}})), "f.csv: sheet 's1' row 9 has 'west' among its numbers; expected a number or -");
  wrong = track("Ada", "T1");
  wrong[0][1] = "99";
  EXPECT_THAT(error_of(xlsx({{"s1", wrong}})), HasSubstr("does not say how many header lines there are"));
}

TEST(Spreadsheet, AnyTable) {
  const auto bytes =
      xlsx({{"data", {{"id", "frame", "x", "y"}, {"a,b", "0", "1", "2"}, {"a,b", "1", "3", ""}, {"c", "1", "5", "6"}}}, {"empty", {}}});
  const auto tracks = read(bytes, flags());
  EXPECT_EQ(tracks.meta().from.format, "xlsx");
  EXPECT_THAT(tracks.names(), ElementsAre("a,b", "c"));
  EXPECT_EQ(tracks.rows(), 2);
  const Cells table = {{"id", "frame", "x", "y"}, {"1", "0", "1", "2"}};
  EXPECT_EQ(error_of(xlsx({{"p", table}, {"q", table}}), flags()),
            "f.csv: the spreadsheet has the sheets p, q; expected `var` SHEET to choose one");
  EXPECT_EQ(read(xlsx({{"p", table}, {"q", table}}), {.fps = 1, .unit = "m", .variable = "q"}).rows(), 1);
}

TEST(Spreadsheet, ClaimsAreChecked) {
  const auto book = [](const std::string& sheet) {
    return zipped({{"xl/workbook.xml", "<workbook><sheets><sheet name='a' r:id='1'/></sheets></workbook>"},
                   {"xl/_rels/workbook.xml.rels", "<R><R Id='1' Target='worksheets/sheet1.xml'/></R>"},
                   {"xl/worksheets/sheet1.xml", "<worksheet><sheetData>" + sheet + "</sheetData></worksheet>"}});
  };
  for (const std::string cells :
       {"<row r='4000000000'><c><v>1</v></c></row>", "<row><c r='ZZZZZZZ1'><v>1</v></c></row>", "<row><c r='7'/></row>",
        "<row><c t='s'><v>5</v></c></row>", "<row><c t='s'><v>x</v></c></row>", "<row><c r='B1'/><c r='A1'/></row>"})
    EXPECT_EQ(error_of(book(cells)), "f.csv: the spreadsheet cannot be read; expected an undamaged file") << cells;
  std::string wide;
  for (int r = 1; r < 100; ++r) wide += "<row><c r='XFD" + std::to_string(r) + "'/></row>";
  EXPECT_THAT(error_of(book(wide)), HasSubstr("the spreadsheet cannot be read"));
  EXPECT_THAT(error_of(book("<row>")), HasSubstr("the spreadsheet cannot be read"));
}

TEST(Spreadsheet, WideTablesAreReadAsTheirTextWouldBe) {
  const auto book = xlsx({{"Data", {{"frame", "x1", "y1", "x2", "y2"}, {"0", "1", "2", "3", "4"}, {"1", "1.5", "2", "3", "4.5"}}}});
  const auto tracks = read(book, {.fps = 10, .unit = "m", .wide = true});
  EXPECT_EQ(tracks.track_count(), 2U);
  EXPECT_EQ(tracks.rows(), 4);
  EXPECT_EQ(tracks.pos()(3, 1), 4.5);
  EXPECT_EQ(tracks.meta().from.format, "xlsx");
}

}  // namespace
}  // namespace swarmfit
