// SPDX-License-Identifier: MIT
#include "reports/draw/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/write/html_table.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit::svg {
namespace {

constexpr double kSmall = 5;  // superscripts
constexpr double kRise = 2.6;

// Advance widths of Helvetica from the space on, thousandths of the size.
constexpr std::array<short, 95> kHelvetica = {
    278, 278, 355, 556, 556, 889, 667, 191, 333,  333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778,
    667, 778, 722, 667, 611, 722, 667, 944, 667,  667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556,
    556, 222, 222, 500, 222, 833, 556, 556, 556,  556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584};
constexpr short kOther = 580;  // Greek letters, signs

double width_of(std::string_view text, double size) {
  int sum = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 32 && byte < 127)
      sum += kHelvetica[byte - 32U];
    else if ((byte & 0xC0) != 0x80)
      sum += kOther;
  }
  return size * sum / 1000;
}

// Bytes of the UTF-8 sequence at the front; 0 if it is none, or one that XML does not allow.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t n = first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : first >= 0xF0 && first < 0xF5 ? 4 : 0;
  if (n == 0 || text.size() < n) return 0;
  unsigned code = first & (0xFFU >> (n + 1));
  for (std::size_t k = 1; k < n; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(k) & 0x3FU);
  }
  const bool overlong = (n == 3 && code < 0x800) || (n == 4 && (code < 0x10000 || code > 0x10FFFF));
  const bool forbidden = (code >= 0xD800 && code < 0xE000) || code == 0xFFFE || code == 0xFFFF;
  return overlong || forbidden ? 0 : n;
}

std::string stroke_attributes(const Stroke& s) {
  if (s.width <= 0) return {};
  std::string out = fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", s.colour, length(s.width));
  return s.dash.empty() ? out : out + fmt::format(" stroke-dasharray=\"{}\"", s.dash);
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t n = sequence_length(text);
    valid += n > 0 ? text.substr(0, n) : "?";
    text.remove_prefix(n > 0 ? n : 1);
  }
  return html_escaped(printable(valid));
}

std::string length(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

Text plain(std::string_view text) { return {xml_escaped(text), width_of(text, kTextSize)}; }

Text italic(std::string_view text) { return {"<tspan font-style=\"italic\">" + xml_escaped(text) + "</tspan>", width_of(text, kTextSize)}; }

Text with_power(std::string_view before, int exponent, std::string_view after) {
  const std::string power = in_print(std::to_string(exponent));
  Text out{fmt::format("{}10<tspan dy=\"-{}\" font-size=\"{}\">{}</tspan>", xml_escaped(before), length(kRise), length(kSmall), power),
           width_of(before, kTextSize) + width_of("10", kTextSize) + width_of(power, kSmall) + width_of(after, kTextSize)};
  // A space at the start of a shifted piece is lost in some renderers.
  const bool apart = after.starts_with(' ');
  after.remove_prefix(apart ? 1 : 0);
  if (!after.empty())
    out.markup += fmt::format("<tspan{} dy=\"{}\">{}</tspan>", apart ? " dx=\"1.9\"" : "", length(kRise), xml_escaped(after));
  return out;
}

Text operator+(Text left, const Text& right) {
  left.markup += right.markup;
  left.width += right.width;
  return left;
}

void Sheet::line(Point from, Point to, const Stroke& stroke) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", length(from.x), length(from.y), length(to.x), length(to.y),
                       stroke_attributes(stroke));
}

int Sheet::clip(const Box& box) {
  body_ += fmt::format("<clipPath id=\"c{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", ++clips_, length(box.left),
                       length(box.top), length(box.width), length(box.height));
  return clips_;
}

void Sheet::path(const std::string& d, const Stroke& stroke, std::string_view fill, int clip) {
  if (d.empty()) return;
  const std::string inside = clip > 0 ? fmt::format(" clip-path=\"url(#c{})\"", clip) : std::string();
  body_ += fmt::format("<path d=\"{}\" fill=\"{}\"{}{}/>\n", d, fill, stroke_attributes(stroke), inside);
}

void Sheet::rectangle(const Box& box, std::string_view fill, const Stroke& stroke, std::string_view title) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"{}{}\n", length(box.left), length(box.top),
                       length(box.width), length(box.height), fill, stroke_attributes(stroke),
                       title.empty() ? "/>" : fmt::format("><title>{}</title></rect>", xml_escaped(title)));
}

void Sheet::text(Point at, const Text& text, Anchor anchor, std::string_view colour) {
  constexpr std::array<std::string_view, 3> kAnchors = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
  body_ += fmt::format("<text x=\"{}\" y=\"{}\"{}{}>{}</text>\n", length(at.x), length(at.y), kAnchors[static_cast<std::size_t>(anchor)],
                       colour == kInk ? std::string() : fmt::format(" fill=\"{}\"", colour), text.markup);
}

void Sheet::turned_text(Point at, const Text& text) {
  body_ += fmt::format("<text transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", length(at.x), length(at.y),
                       text.markup);
}

double Sheet::note(double y, std::string_view text) {
  constexpr double kMargin = 2, kSlack = 0.86;  // other fonts are wider
  while (!text.empty()) {
    std::size_t end = text.size();
    while (width_of(text.substr(0, end), kTextSize) > kSlack * (width() - 2 * kMargin)) {
      const std::size_t space = text.rfind(' ', end - 1);
      if (space == std::string_view::npos || space == 0) break;
      end = space;
    }
    this->text({kMargin, y}, plain(text.substr(0, end)), Anchor::start, kSoft);
    text.remove_prefix(std::min(text.size(), end + 1));
    y += 1.25 * kTextSize;
  }
  return y;
}

std::string Sheet::document(double height, std::string_view title, std::string_view description) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {2} {3}\" role=\"img\"\n"
      "  font-family=\"Helvetica, Arial, 'Liberation Sans', 'Nimbus Sans', sans-serif\" font-size=\"{4}\" fill=\"{5}\" "
      "stroke-linejoin=\"round\">\n"
      "<title>{6}</title>\n<desc>{7}</desc>\n<rect width=\"{2}\" height=\"{3}\" fill=\"#ffffff\"/>\n{8}</svg>\n",
      length(width_mm_), length(height * 25.4 / 72), length(width()), length(height), length(kTextSize), kInk, xml_escaped(title),
      xml_escaped(description), body_);
}

}  // namespace swarmfit::svg
