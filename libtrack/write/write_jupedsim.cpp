// SPDX-License-Identifier: MIT
// The layout is JuPedSim's (jupedsim.sqlite_serialization, version 2).
#include <fmt/format.h>
#include <sqlite3.h>

#include <memory>

#include "libtrack/error.h"
#include "libtrack/write/write.h"

namespace swarmfit {
namespace {

class Database {
 public:
  Database() {
    sqlite3* db = nullptr;
    const int state = sqlite3_open(":memory:", &db);
    db_.reset(db);
    require(state == SQLITE_OK);
  }

  void run(const std::string& sql) { require(sqlite3_exec(db_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK); }

  // One row; numbers go as REAL or INTEGER, texts as TEXT.
  class Insert {
   public:
    Insert(Database& db, const std::string& sql) {
      sqlite3_stmt* statement = nullptr;
      require(sqlite3_prepare_v2(db.db_.get(), sql.c_str(), -1, &statement, nullptr) == SQLITE_OK);
      statement_.reset(statement);
    }
    template <class... Values>
    void row(const Values&... values) {
      int at = 0;
      (bind(++at, values), ...);
      require(sqlite3_step(statement_.get()) == SQLITE_DONE && sqlite3_reset(statement_.get()) == SQLITE_OK);
    }

   private:
    void bind(int at, double value) { require(sqlite3_bind_double(statement_.get(), at, value) == SQLITE_OK); }
    void bind(int at, std::int64_t value) { require(sqlite3_bind_int64(statement_.get(), at, value) == SQLITE_OK); }
    void bind(int at, const std::string& value) {
      require(sqlite3_bind_text64(statement_.get(), at, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8) == SQLITE_OK);
    }
    struct Finish {
      void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
    };
    std::unique_ptr<sqlite3_stmt, Finish> statement_;
  };

  std::string bytes() {
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> image(sqlite3_serialize(db_.get(), "main", &size, 0), sqlite3_free);
    require(image != nullptr);
    return {reinterpret_cast<const char*>(image.get()), static_cast<std::size_t>(size)};
  }

 private:
  struct Close {
    void operator()(sqlite3* db) const { sqlite3_close(db); }
  };
  static void require(bool done) {
    if (!done) throw RunError("SQLite cannot make the database in memory");
  }
  std::unique_ptr<sqlite3, Close> db_;
};

constexpr const char* kTables =
    "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, pos_y REAL NOT NULL, "
    "ori_x REAL NOT NULL, ori_y REAL NOT NULL);"
    "CREATE TABLE metadata (key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE geometry (hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
    "CREATE TABLE frame_data (frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);"
    "CREATE TABLE track_names (id INTEGER NOT NULL, name TEXT NOT NULL);";

// Names that are numbers keep them; if some is not, all are counted.
std::vector<std::int64_t> ids_of(const Tracks& tracks) {
  std::vector<std::int64_t> ids;
  for (const auto& name : tracks.names()) {
    const bool number = !name.empty() && name.size() < 10 && name.find_first_not_of("0123456789") == std::string::npos &&
                        (name[0] != '0' || name.size() == 1);
    if (!number) {
      ids.resize(tracks.track_count());
      for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<std::int64_t>(k);
      return ids;
    }
    ids.push_back(std::stoll(name));
  }
  return ids;
}

void write_metadata(Database& db, const Tracks& tracks) {
  const auto& meta = tracks.meta();
  Database::Insert metadata(db, "INSERT INTO metadata VALUES (?, ?)");
  metadata.row(std::string("version"), std::string("2"));
  metadata.row(std::string("fps"), fmt::format("{}", 1 / meta.dt));
  const Eigen::Array2d low = tracks.pos().leftCols(2).colwise().minCoeff().transpose();
  const Eigen::Array2d high = tracks.pos().leftCols(2).colwise().maxCoeff().transpose();
  metadata.row(std::string("xmin"), fmt::format("{}", low[0]));
  metadata.row(std::string("xmax"), fmt::format("{}", high[0]));
  metadata.row(std::string("ymin"), fmt::format("{}", low[1]));
  metadata.row(std::string("ymax"), fmt::format("{}", high[1]));
  metadata.row(std::string("swarmfit_dt"), fmt::format("{}", meta.dt));
  metadata.row(std::string("swarmfit_t0"), fmt::format("{}", meta.t0));
  for (std::size_t k = 0; k < meta.from.notes.size(); ++k) metadata.row(fmt::format("swarmfit_note_{:04}", k), meta.from.notes[k]);
  Database::Insert geometry(db, "INSERT INTO geometry VALUES (0, ?)");
  geometry.row(fmt::format("POLYGON (({0} {1}, {2} {1}, {2} {3}, {0} {3}, {0} {1}))", low[0], low[1], high[0], high[1]));
}

}  // namespace

std::string to_jupedsim(const Tracks& tracks) {
  const auto& meta = tracks.meta();
  if (tracks.dims() != 2) throw InputError("`to` jupedsim: it holds motion in two dimensions; expected another format, such as hdf5");
  if (meta.unit != "m")
    throw InputError(fmt::format("`to` jupedsim: its unit is the metre, and the recording is in {}; expected `scale`, as in 0.01m/{}",
                                 meta.unit, meta.unit));
  Database db;
  db.run("BEGIN");
  db.run(kTables);
  write_metadata(db, tracks);
  const auto ids = ids_of(tracks);
  Database::Insert names(db, "INSERT INTO track_names VALUES (?, ?)");
  for (std::size_t k = 0; k < ids.size(); ++k) names.row(ids[k], tracks.names()[k]);
  Database::Insert frames(db, "INSERT INTO frame_data VALUES (?, 0)");
  for (const auto& frame : tracks.frames()) frames.row(frame.number);
  Database::Insert row(db, "INSERT INTO trajectory_data VALUES (?, ?, ?, ?, ?, ?)");
  for (Index i = 0; i < tracks.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Index next = tracks.next()[at];
    Eigen::Array2d way = Eigen::Array2d::Zero();
    if (next >= 0) way = (tracks.pos().row(next) - tracks.pos().row(i)).leftCols(2).transpose();
    const double length = way.matrix().norm();
    if (length > 0) way /= length;
    row.row(tracks.frame()[at], ids[tracks.track()[at]], tracks.pos()(i, 0), tracks.pos()(i, 1), way[0], way[1]);
  }
  db.run("COMMIT");
  return db.bytes();
}

}  // namespace swarmfit
