// SPDX-License-Identifier: MIT
#include "reports/write/text_table.h"

#include <algorithm>
#include <array>
#include <utility>

#include "reports/write/plain_text.h"

namespace swarmfit {

namespace {

constexpr std::size_t kApart = 2;  // spaces between columns

bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

std::string padded(const std::string& text, std::size_t width, Align align) {
  const std::size_t own = display_width(text);
  const std::size_t spare = width > own ? width - own : 0;
  const std::size_t left = align == Align::left ? 0 : align == Align::right ? spare : spare / 2;
  std::string out(left, ' ');
  return out.append(text).append(spare - left, ' ');
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

}  // namespace

std::string paint(std::string_view text, Paint paint, TextStyle style) {
  constexpr std::array<std::string_view, 5> kCodes = {"", "\033[1m", "\033[2m", "\033[1;32m", "\033[33m"};
  const std::string_view code = kCodes[static_cast<std::size_t>(paint)];
  if (!style.colour || code.empty()) return std::string(text);
  return std::string(code).append(text).append("\033[0m");
}

std::size_t display_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_code_point));
}

std::string wrapped(std::string_view text, std::size_t width, std::string_view indent) {
  std::string out;
  std::size_t column = 0;
  while (!text.empty()) {
    std::size_t end = std::min(text.find(' '), text.size());
    while (text.substr(end).starts_with(" %")) end = std::min(text.find(' ', end + 1), text.size());  // "95 %" stays together
    const std::string_view word = text.substr(0, end);
    const std::size_t room = display_width(ascii(word));  // as wide as it may become
    if (column > 0 && column + 1 + room > width) {
      out.append("\n").append(indent);
      column = display_width(indent);
    } else if (column > 0) {
      out += ' ';
      ++column;
    }
    out += word;
    column += room;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::string ascii(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kSpelled = {{{"±", "+-"},
                                                                                       {"≤", "<="},
                                                                                       {"–", "-"},
                                                                                       {"—", "-"},
                                                                                       {"…", "..."},
                                                                                       {"·", "|"},
                                                                                       {"×", "x"},
                                                                                       {"²", "^2"},
                                                                                       {"³", "^3"},
                                                                                       {"ω", "omega"},
                                                                                       {"α", "alpha"},
                                                                                       {"μ", "mu"},
                                                                                       {"η", "eta"},
                                                                                       {"σ", "sigma"},
                                                                                       {"\u202f", " "},
                                                                                       {"→", "->"},
                                                                                       {"−", "-"},
                                                                                       {"▲", "!"}}};
  std::string out(text);
  for (const auto& [from, to] : kSpelled) replace_all(out, from, to);
  return out;
}

void TextTable::row(std::vector<std::string> cells, Paint paint) {
  cells.resize(align_.size());
  if (!style_.unicode)
    for (std::string& cell : cells) cell = ascii(cell);
  rows_.push_back({std::move(cells), paint});
}

std::vector<std::size_t> TextTable::widths() const {
  std::vector<std::size_t> width(align_.size(), 0);
  for (const Row& r : rows_)
    for (std::size_t k = 0; k < width.size(); ++k) width[k] = std::max(width[k], display_width(r.cells[k]));
  return width;
}

std::string TextTable::text(std::size_t indent) const {
  const auto width = widths();
  std::string out;
  for (const Row& r : rows_) {
    std::string line;
    for (std::size_t k = 0; k < width.size(); ++k) line.append(k > 0 ? kApart : 0, ' ').append(padded(r.cells[k], width[k], align_[k]));
    out.append(indent, ' ').append(paint(without_trailing_spaces(std::move(line)), r.paint, style_)).append(1, '\n');
  }
  return out;
}

std::size_t TextTable::width() const {
  std::size_t out = 1;
  const auto width = widths();
  for (std::size_t k = 0; k < width.size(); ++k) out += width[k] + (k > 0 ? kApart : 0);
  return out;
}

std::string TextTable::folded() const {
  const auto width = widths();
  std::string out;
  for (std::size_t from = 1; from < width.size();) {
    std::size_t to = from, line = 1 + width.front();
    while (to < width.size() && (to == from || line + kApart + width[to] <= kTextWidth)) line += kApart + width[to++];
    std::vector<Align> align(align_.begin() + static_cast<std::ptrdiff_t>(from), align_.begin() + static_cast<std::ptrdiff_t>(to));
    align.insert(align.begin(), align_.front());
    TextTable block(align, style_);
    for (const Row& r : rows_) {
      std::vector<std::string> cells(r.cells.begin() + static_cast<std::ptrdiff_t>(from),
                                     r.cells.begin() + static_cast<std::ptrdiff_t>(to));
      cells.insert(cells.begin(), r.cells.front());
      block.row(std::move(cells), r.paint);
    }
    out += (out.empty() ? "" : "\n") + block.text();
    from = to;
  }
  return out;
}

std::string paragraph(const std::string& text, const std::string& indent) {
  return indent + wrapped(printable(text), kTextWidth - indent.size(), indent) + '\n';
}

std::string bullets(const std::string& title, const std::vector<std::string>& items, Paint mark, TextStyle style) {
  if (items.empty()) return {};
  std::string out = '\n' + paint(title, mark, style) + '\n';
  for (const std::string& item : items) out += "  - " + wrapped(printable(item), kTextWidth - 4, "    ") + '\n';
  return out;
}

std::string finished(std::string text, TextStyle style) { return style.unicode ? std::move(text) : ascii(text); }

TextTable::TextTable(const TextRows& rows, std::vector<Align> columns, bool headed, TextStyle style)
    : TextTable(std::move(columns), style) {
  for (const auto& cells : rows) row(cells, headed && &cells == &rows.front() ? Paint::bold : Paint::plain);
}

}  // namespace swarmfit
