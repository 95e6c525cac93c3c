// SPDX-License-Identifier: MIT
#include "libtrack/read/choose_id.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "libtrack/error.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

// Enough rows to see what a column is.
constexpr std::size_t kMostRows = 200'000;

// One candidate, its values numbered in the order of their first rows: equal numbers mean that two columns part the rows alike.
struct Claim {
  std::size_t column = 0;
  std::unordered_map<std::string, std::size_t> number{};
  std::vector<std::size_t> of{};  // row → number
  bool new_in_every_row() const { return of.size() > 1 && number.size() == of.size(); }
  void add(std::string_view value) { of.push_back(number.try_emplace(std::string(value), number.size()).first->second); }
};

std::vector<Claim> look_at_rows(const ColumnMap& map, std::string_view rows, char delimiter) {
  std::vector<Claim> claims;
  for (const auto column : map.id_claims) claims.push_back({.column = column});
  Lines lines(rows);
  std::string scratch;
  std::size_t n = 0;
  for (std::string_view line; n < kMostRows && lines.next(line);) {
    if (!has_content(line)) continue;
    ++n;
    Fields fields(line, delimiter);
    std::size_t i = 0;
    for (auto& claim : claims) {
      for (; i < claim.column && !fields.done(); ++i) fields.skip();
      claim.add(fields.done() ? std::string_view{} : fields.text(scratch));  // a short row is refused later
      ++i;
    }
  }
  return claims;
}

}  // namespace

std::string choose_id(ColumnMap& map, const std::string& name, std::string_view bytes, const TextHeader& header) {
  if (map.id_claims.empty()) return {};
  std::sort(map.id_claims.begin(), map.id_claims.end());
  auto claims = look_at_rows(map, bytes.substr(header.data_at), header.delimiter);
  const auto title = [&](const Claim& c) { return header.names[c.column]; };
  std::string numbers_rows;
  for (const auto& c : claims)
    if (c.new_in_every_row()) numbers_rows += (numbers_rows.empty() ? "'" : ", '") + title(c) + "'";
  std::erase_if(claims, [](const Claim& c) { return c.new_in_every_row(); });
  if (claims.empty())
    throw InputError(at(name, header.names_line, 0,
                        fmt::format("{} are new in every row, so they number rows and not individuals; expected `columns` to name the "
                                    "individual (id=NAME,...)",
                                    numbers_rows)));
  for (const auto& c : claims)
    if (c.of != claims[0].of)
      throw InputError(
          at(name, header.names_line, 0,
             fmt::format("both '{}' and '{}' could be the individual, and they disagree; expected `columns` to say which, such "
                         "as `columns` id={},x=...",
                         title(claims[0]), title(c), title(c))));
  auto chosen = claims[0].column;
  for (const auto& c : claims)
    if (map.of[c.column] == FileColumn::id) chosen = c.column;
  std::replace(map.of.begin(), map.of.end(), FileColumn::id, FileColumn::skip);
  map.of[chosen] = FileColumn::id;
  map.spec = by_name(map, header.names);
  if (numbers_rows.empty()) return {};
  return fmt::format("'{}' is the individual: {} is new in every row and numbers the rows", header.names[chosen], numbers_rows);
}

}  // namespace swarmfit
