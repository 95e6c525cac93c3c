// SPDX-License-Identifier: MIT
// Aligned columns and wrapped paragraphs for the terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// How text may be marked up.
struct TextStyle {
  bool colour = false;  // ANSI colours: only for a terminal, and not with NO_COLOR
  bool unicode = true;  // else plain ASCII: "+-" for "±", "-" for "–", "omega" for "ω"
};

enum class Align { left, right, centre };
enum class Paint { plain, bold, dim, good, warning };

std::string paint(std::string_view text, Paint, TextStyle);

// Columns of a terminal that a UTF-8 text takes (one per code point: no wide or combining characters are expected here).
std::size_t display_width(std::string_view text);

// `text` broken at spaces into lines of at most `width` columns; every line after the first starts with `indent`.
std::string wrapped(std::string_view text, std::size_t width, std::string_view indent = "");

// Characters beyond ASCII that our own texts use, spelled out.
std::string ascii(std::string_view text);

// Results for the terminal are as wide as this.
inline constexpr std::size_t kTextWidth = 80;

// A paragraph, and a list of items with a title; text of unknown origin is shown without control characters. No items, no list.
std::string paragraph(const std::string& text, const std::string& indent = "");
std::string bullets(const std::string& title, const std::vector<std::string>& items, Paint mark, TextStyle style);

// The whole of it, in ASCII where the style asks for that.
std::string finished(std::string text, TextStyle style);

using TextRows = std::vector<std::vector<std::string>>;

class TextTable {
 public:
  TextTable(std::vector<Align> columns, TextStyle style) : align_(std::move(columns)), style_(style) {}
  TextTable(const TextRows& rows, std::vector<Align> columns, bool headed, TextStyle style);
  void row(std::vector<std::string> cells, Paint paint = Paint::plain);
  // One line per row, columns two spaces apart, lines indented by `indent` spaces.
  std::string text(std::size_t indent = 1) const;
  std::size_t width() const;  // of its longest line
  // In blocks of as many columns as kTextWidth holds, each headed by the first column; an empty line between blocks.
  std::string folded() const;

 private:
  struct Row {
    std::vector<std::string> cells;
    Paint paint;
  };
  std::vector<std::size_t> widths() const;
  std::vector<Align> align_;
  TextStyle style_;
  std::vector<Row> rows_;
};

}  // namespace swarmfit
