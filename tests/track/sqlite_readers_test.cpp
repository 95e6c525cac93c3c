// SPDX-License-Identifier: MIT
// Recordings in SQLite, each made here as the program that writes them lays it out.
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "tests/track/build.h"

namespace swarmfit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string database(const std::string& statements) {
  sqlite3* db = nullptr;
  sqlite3_open(":memory:", &db);
  char* error = nullptr;
  sqlite3_exec(db, statements.c_str(), nullptr, nullptr, &error);
  EXPECT_EQ(error, nullptr) << error;
  sqlite3_int64 size = 0;
  unsigned char* data = sqlite3_serialize(db, "main", &size, 0);
  std::string bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
  sqlite3_free(data);
  sqlite3_close(db);
  return bytes;
}

std::string jupedsim(const std::string& version, const std::string& rows) {
  return database(
      "CREATE TABLE trajectory_data(frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL, pos_y REAL, ori_x REAL, ori_y REAL);"
      "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
      "INSERT INTO metadata VALUES ('version', '" +
      version + "'), ('fps', '12.5'); INSERT INTO trajectory_data VALUES " + rows);
}

TEST(JuPedSim, BothVersions) {
  for (const char* version : {"1", "2"}) {
    const auto tracks = read(jupedsim(version, "(0, 7, 1.5, 2.5, 0, 0), (0, 9, 3, 4, 0, 0), (1, 7, 1.75, 2.5, 0, 0)"));
    EXPECT_EQ(tracks.meta().from.format, "jupedsim");
    EXPECT_EQ(tracks.dt(), 0.08);
    EXPECT_EQ(tracks.meta().unit, "m");
    EXPECT_THAT(tracks.names(), ElementsAre("7", "9"));
    ASSERT_EQ(tracks.rows(), 3);
    EXPECT_EQ(tracks.pos()(2, 0), 1.75);
    EXPECT_EQ(tracks.pos()(1, 1), 4);
  }
}

TEST(JuPedSim, FaultsAreNamed) {
  EXPECT_EQ(error_of(jupedsim("3", "(0, 7, 1, 2, 0, 0)")), "f.csv: the version of the layout is '3'; expected 1 or 2");
  EXPECT_EQ(error_of(jupedsim("2", "(0, 7, 1, 2, 0, 0), (1, 7, 'west', 2, 0, 0)")),
            "f.csv: table 'trajectory_data' row 2: pos_x is not a number; expected a number");
  EXPECT_THAT(error_of(database("CREATE TABLE t(a, b)")), StartsWith("f.csv: is a SQLite database of no known layout, with the tables t"));
  EXPECT_THAT(error_of(database("CREATE TABLE t(a, b)"), {.format = "jupedsim"}), HasSubstr("expected trajectories of JuPedSim"));
}

TEST(JuPedSim, ViewsAreNotRun) {
  const auto bytes = database(
      "CREATE TABLE metadata(key, value); INSERT INTO metadata VALUES ('version', '2'), ('fps', '1');"
      "CREATE VIEW trajectory_data AS WITH RECURSIVE n(frame) AS (SELECT 0 UNION ALL SELECT frame + 1 FROM n) "
      "SELECT frame, 1 AS id, 0 AS pos_x, 0 AS pos_y FROM n");
  EXPECT_THAT(error_of(bytes), HasSubstr("no known layout"));
}

TEST(FastTrack, TheBodyUnlessAnotherPointIsNamed) {
  const auto bytes = database(
      "CREATE TABLE tracking(xHead REAL, yHead REAL, xTail REAL, yTail REAL, xBody REAL, yBody REAL, imageNumber INTEGER, id INTEGER);"
      "INSERT INTO tracking VALUES (1, 2, 3, 4, 5, 6, 0, 0), (11, 12, 13, 14, 15, 16, 1, 0)");
  const auto tracks = read(bytes, {.fps = 10});
  EXPECT_EQ(tracks.meta().from.format, "fasttrack-db");
  EXPECT_EQ(tracks.meta().unit, "px");
  ASSERT_EQ(tracks.rows(), 2);
  EXPECT_EQ(tracks.pos()(1, 0), 15);
  EXPECT_EQ(read(bytes, {.fps = 10, .node = "head"}).pos()(1, 1), 12);
  EXPECT_EQ(read(bytes, {.fps = 10, .node = "mean"}).pos()(0, 0), 3);
  EXPECT_THAT(error_of(bytes, {.fps = 10, .node = "nose"}), HasSubstr("expected mean or one of head, tail, body"));
}

// Every byte of the database changed in turn: an answer or one line.
TEST(Sqlite, DamageIsOneLine) {
  const auto bytes = jupedsim("2", "(0, 7, 1, 2, 0, 0), (1, 7, 1, 2, 0, 0)");
  for (std::size_t at = 16; at < bytes.size(); at += 37) {
    auto damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    const auto error = error_of(damaged, {.format = "jupedsim"});
    EXPECT_THAT(error, testing::AnyOf("no error", StartsWith("f.csv: "))) << at;
    EXPECT_EQ(error.find('\n'), std::string::npos) << at;
  }
  for (std::size_t size = 100; size < bytes.size(); size += 511)
    EXPECT_THAT(error_of(bytes.substr(0, size)), StartsWith("f.csv: the SQLite database is cut off")) << size;
}

}  // namespace
}  // namespace swarmfit
