// SPDX-License-Identifier: MIT
#include "libtrack/read/sqlite_file.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cstdint>

#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

struct Finalize {
  void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
};

std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string text(sqlite3_stmt* row, int column) {
  const auto* letters = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return letters ? letters : "";
}

int stop(void*) { return 1; }

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes) value = 256 * value + static_cast<unsigned char>(c);
  return value;
}

// SQLite reads what is there; the header says how much there should be, where it was kept up to date (SQLite file format, 1.3.7).
bool cut_off(std::string_view bytes) {
  if (bytes.size() < 100) return true;
  const std::uint32_t stated = big_endian(bytes.substr(16, 2)), page = stated == 1 ? 65536 : stated;
  const bool valid = bytes.substr(24, 4) == bytes.substr(92, 4);
  return valid && bytes.size() < std::uint64_t{page} * big_endian(bytes.substr(28, 4));
}

}  // namespace

void SqliteFile::Close::operator()(sqlite3* db) const { sqlite3_close(db); }

SqliteFile::SqliteFile(const std::string& name, std::string_view bytes) : name_(name) {
  if (cut_off(bytes)) throw InputError(name + ": the SQLite database is cut off; expected an undamaged file");
  // Bytes 18 and 19 say that there may be a write-ahead log beside the file, which a database in memory cannot have.
  if (bytes.size() > 100 && bytes[18] == 2) {
    copy_ = bytes;
    copy_[18] = copy_[19] = 1;
    bytes = copy_;
  }
  sqlite3* db = nullptr;
  const int opened = sqlite3_open_v2(":memory:", &db, SQLITE_OPEN_READWRITE, nullptr);
  db_.reset(db);
  if (opened != SQLITE_OK) fail();
  sqlite3_db_config(db, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(db, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(db, SQLITE_LIMIT_LENGTH, 1 << 24);
  sqlite3_limit(db, SQLITE_LIMIT_COLUMN, 1000);
  // Rows cannot be many more than bytes: more steps than this are a loop.
  const double steps = 1e6 + 100.0 * static_cast<double>(bytes.size());
  sqlite3_progress_handler(db, static_cast<int>(std::min(steps, 2e9)), stop, nullptr);
  auto* data = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));  // not written to
  const auto size = static_cast<sqlite3_int64>(bytes.size());
  if (sqlite3_deserialize(db, "main", data, size, size, SQLITE_DESERIALIZE_READONLY) != SQLITE_OK) fail();
  list_tables();
}

void SqliteFile::fail() const {
  std::string why = sqlite3_errmsg(db_.get());  // which can quote the file
  std::replace_if(
      why.begin(), why.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  throw InputError(fmt::format("{}: the SQLite database cannot be read ({}); expected an undamaged file", name_, why.substr(0, 100)));
}

template <class Visit>
void SqliteFile::select(const std::string& query, Visit&& visit) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(db_.get(), query.c_str(), -1, &statement, nullptr) != SQLITE_OK) fail();
  const std::unique_ptr<sqlite3_stmt, Finalize> owner(statement);
  int state = SQLITE_OK;
  while ((state = sqlite3_step(statement)) == SQLITE_ROW) visit(statement);
  if (state != SQLITE_DONE) fail();
}

void SqliteFile::list_tables() {
  std::vector<std::string> names;
  select("SELECT name FROM sqlite_master WHERE type = 'table' AND sql NOT LIKE 'CREATE VIRTUAL%'",
         [&](sqlite3_stmt* row) { names.push_back(text(row, 0)); });
  for (const auto& name : names) {
    auto& columns = tables_[name];
    select(fmt::format("PRAGMA table_info({})", quoted(name)), [&](sqlite3_stmt* row) { columns.push_back(text(row, 1)); });
  }
}

bool SqliteFile::has(const std::string& table, const std::vector<std::string>& columns) const {
  const auto hit = tables_.find(table);
  return hit != tables_.end() && std::all_of(columns.begin(), columns.end(), [&](const auto& c) {
           return std::find(hit->second.begin(), hit->second.end(), c) != hit->second.end();
         });
}

std::vector<std::vector<double>> SqliteFile::numbers(const std::string& table, const std::vector<std::string>& columns) const {
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(quoted(column));
  std::vector<std::vector<double>> out(columns.size());
  select(fmt::format("SELECT {} FROM {}", fmt::join(names, ", "), quoted(table)), [&](sqlite3_stmt* row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const int i = static_cast<int>(c), type = sqlite3_column_type(row, i);
      if (type == SQLITE_TEXT || type == SQLITE_BLOB)
        throw InputError(fmt::format("{}: table '{}' row {}: {} is not a number; expected a number", name_, table, out[0].size() + (c == 0),
                                     columns[c]));
      out[c].push_back(type == SQLITE_NULL ? kNaN : sqlite3_column_double(row, i));
    }
  });
  return out;
}

std::map<std::string, std::string> SqliteFile::pairs(const std::string& table, const std::string& key, const std::string& value) const {
  std::map<std::string, std::string> out;
  select(fmt::format("SELECT {}, {} FROM {}", quoted(key), quoted(value), quoted(table)),
         [&](sqlite3_stmt* row) { out[text(row, 0)] = text(row, 1); });
  return out;
}

}  // namespace swarmfit
