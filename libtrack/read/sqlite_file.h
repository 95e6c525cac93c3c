// SPDX-License-Identifier: MIT
// SQLite databases in memory, read only: no file is opened, no view, trigger or function of the database runs.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;

namespace swarmfit {

inline bool is_sqlite(std::string_view bytes) { return bytes.starts_with(std::string_view("SQLite format 3\0", 16)); }

class SqliteFile {
 public:
  // Throws InputError when the bytes are no sound database. `bytes` must outlive this.
  SqliteFile(const std::string& name, std::string_view bytes);

  // Column names of every table, views left out.
  const std::map<std::string, std::vector<std::string>>& tables() const { return tables_; }
  bool has(const std::string& table, const std::vector<std::string>& columns) const;

  // One vector per column, in the order of the rows; NULL is NaN. Throws InputError for text that is no number.
  std::vector<std::vector<double>> numbers(const std::string& table, const std::vector<std::string>& columns) const;

  // Two columns of texts as key → value.
  std::map<std::string, std::string> pairs(const std::string& table, const std::string& key, const std::string& value) const;

 private:
  struct Close {
    void operator()(sqlite3* db) const;
  };
  [[noreturn]] void fail() const;
  void list_tables();
  template <class Visit>
  void select(const std::string& query, Visit&& visit) const;

  std::string name_;
  std::string copy_;  // of the bytes, where they have to be changed
  std::unique_ptr<sqlite3, Close> db_;
  std::map<std::string, std::vector<std::string>> tables_;
};

}  // namespace swarmfit
