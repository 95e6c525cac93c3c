// SPDX-License-Identifier: MIT
// A sheet to draw on, for print: SVG with text as text and nothing outside it. Lengths are points (1/72 inch), from the top left corner.
#pragma once

#include <string>
#include <string_view>

namespace swarmfit::svg {

inline constexpr double kOneColumn = 85, kTwoColumns = 178;  // widths of a journal's figures [mm]
inline constexpr double kTextSize = 7;                       // of everything but superscripts

inline constexpr std::string_view kInk = "#1c2126", kSoft = "#59636e", kFaint = "#c9cfd5";

struct Point {
  double x = 0, y = 0;
};

struct Box {
  double left = 0, top = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

// A line of text of any origin, as SVG. The width is that of Helvetica in the text size; other sans-serif fonts are up to a sixth wider.
struct Text {
  std::string markup;
  double width = 0;
};
Text plain(std::string_view text);
Text italic(std::string_view text);
Text with_power(std::string_view before, int exponent, std::string_view after);  // "before10", the exponent raised, "after"
Text operator+(Text left, const Text& right);

// Text as the content of an XML element or attribute: markup characters become entities; control characters and bytes that are not
// UTF-8 become "?".
std::string xml_escaped(std::string_view text);

// A length, two decimals at most: "12.5", "0".
std::string length(double value);

struct Stroke {
  std::string_view colour = kInk;
  double width = 0.6;
  std::string_view dash;  // as in stroke-dasharray; empty: solid
};

enum class Anchor { start, middle, end };

class Sheet {
 public:
  explicit Sheet(double width_mm) : width_mm_(width_mm) {}
  double width() const { return width_mm_ * 72 / 25.4; }

  void line(Point from, Point to, const Stroke& stroke = {});
  int clip(const Box& box);  // for paths that are to be cut there
  // `d` as in SVG; `fill` may be "none"; `clip` as returned above, 0: whole.
  void path(const std::string& d, const Stroke& stroke, std::string_view fill = "none", int clip = 0);
  // `title` shows where the pointer rests.
  void rectangle(const Box& box, std::string_view fill, const Stroke& stroke, std::string_view title = "");
  void text(Point at, const Text& text, Anchor anchor = Anchor::start, std::string_view colour = kInk);  // `at`: on the base line
  void turned_text(Point at, const Text& text);                                                          // upwards, centred about `at`
  // Soft text broken into lines as wide as the sheet, the first one's base line at y. Returns the y of the line that would follow.
  double note(double y, std::string_view text);

  // The document. `title` and `description` are for readers who cannot see it.
  std::string document(double height, std::string_view title, std::string_view description) const;

 private:
  double width_mm_;
  int clips_ = 0;
  std::string body_;
};

}  // namespace swarmfit::svg
