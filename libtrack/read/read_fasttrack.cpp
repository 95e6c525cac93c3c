// SPDX-License-Identifier: MIT
// The database of FastTrack (SQLite): head, tail and body of every object per image, in pixels. The body's centre is the position
// unless --node says otherwise. https://www.fasttrack.sh
#include <array>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"
#include "libtrack/read/sqlite_file.h"

namespace swarmfit {
namespace {

const std::vector<std::string> kColumns = {"imageNumber", "id", "xHead", "xTail", "xBody", "yHead", "yTail", "yBody"};

bool recognises(const Source& source, const ReadOptions&) {
  return is_sqlite(source.bytes) && SqliteFile(source.name, source.bytes).has("tracking", kColumns);
}

RawTable read(const Source& source, const ReadOptions& options) {
  const SqliteFile file(source.name, source.bytes);
  if (!file.has("tracking", kColumns))
    throw InputError(source.name + ": there is no table tracking with imageNumber, id and xBody; expected a database of FastTrack");
  const auto data = file.numbers("tracking", kColumns);
  RawTable all;
  add_ids(all, data[1]);
  RawTable table;
  table.file = source.name;
  table.row_name = "table 'tracking' row";
  table.unit = "px";
  table.names = all.names;
  Postures postures(table, options, {"head", "tail", "body"}, "body");
  for (std::size_t i = 0; i < all.track.size(); ++i) {
    const std::array x = {data[2][i], data[3][i], data[4][i]}, y = {data[5][i], data[6][i], data[7][i]};
    postures.add({all.track[i], data[0][i], kNaN, x, y, {}, {}});
  }
  postures.finish();
  check_numbers(table);
  return table;
}

}  // namespace

const Reader kFastTrack = {{"fasttrack-db", "FastTrack database (SQLite)", ".db"}, recognises, read};

}  // namespace swarmfit
