// SPDX-License-Identifier: MIT
#include "reports/write/html_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/write/number.h"

namespace swarmfit {

namespace {

constexpr std::size_t kColours = 8;  // as in report.css
// As in report.js, so that lines differ without colour, too.
constexpr std::array<std::string_view, 8> kDashes = {"", "7 3", "2 2", "9 3 2 3", "4 2", "12 4", "1 3", "6 2 1 2 1 2"};

std::string classes(const HtmlTable::Cell& cell) {
  std::string out;
  if (cell.number) out += "n ";
  if (cell.soft) out += "out ";
  if (cell.head && !cell.number) out += "name ";
  if (!cell.also.empty()) out += cell.also + ' ';
  if (!out.empty()) out.pop_back();
  return out;
}

std::string opened(std::string_view tag, std::string_view classes) {
  return classes.empty() ? fmt::format("<{}>", tag) : fmt::format("<{} class=\"{}\">", tag, classes);
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

Html escaped(std::string_view text) {
  std::string out = html_escaped(text);
  for (std::size_t k = 1; k + 1 < out.size(); ++k)  // "95 %" stays on one line
    if (out[k] == ' ' && out[k + 1] == '%' && out[k - 1] >= '0' && out[k - 1] <= '9') out.replace(k, 1, "\u00a0");
  return {out};
}

Html element(std::string_view tag, std::string_view classes, const Html& content) {
  return {fmt::format("{}{}</{}>", opened(tag, classes), content.text, tag)};
}

HtmlTable& HtmlTable::add(std::string& part, std::string_view row_classes, const std::vector<Cell>& cells) {
  const bool heading = &part == &head_;
  part += opened("tr", row_classes);
  for (const Cell& cell : cells) {
    std::string tag = cell.head ? (heading ? "th scope=\"col\"" : "th scope=\"row\"") : "td";
    if (!cell.note.empty()) tag += fmt::format(" title=\"{}\"", html_escaped(cell.note));
    part += opened(tag, classes(cell)) + cell.content.text + (cell.head ? "</th>" : "</td>");
  }
  part += "</tr>\n";
  return *this;
}

Html HtmlTable::html() const {
  const std::string caption = html_escaped(caption_);
  std::string look = classes_;
  if (sortable_) look += look.empty() ? "sortable" : " sortable";
  std::string out =
      fmt::format("<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{0}\"><table{1}><caption>{0}</caption>\n", caption,
                  look.empty() ? "" : fmt::format(" class=\"{}\"", look));
  if (!head_.empty()) out += "<thead>" + head_ + "</thead>\n";
  out += "<tbody>" + body_ + "</tbody>\n";
  if (!foot_.empty()) out += "<tfoot>" + foot_ + "</tfoot>\n";
  return {out + "</table></div>\n"};
}

HtmlTable::Cell name_cell(Html content) { return {.content = std::move(content), .head = true}; }
HtmlTable::Cell text_cell(std::string_view text) { return {.content = escaped(text)}; }
HtmlTable::Cell number_cell(std::string_view text, bool soft) { return {.content = escaped(in_print(text)), .number = true, .soft = soft}; }
HtmlTable::Cell column(std::string_view title, bool number, bool soft, std::string_view note) {
  return {.content = escaped(title), .number = number, .head = true, .soft = soft, .note = std::string(note)};
}

Html fact(std::string_view term, std::string_view value, bool wide) {
  if (value.empty()) return {};
  return {fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", wide ? " class=\"long\"" : "", html_escaped(term), html_escaped(value))};
}

Html interval_drawing(double value, double low, double high, double lower, double upper, std::size_t series) {
  if (!std::isfinite(value) || !(upper > lower)) return {};
  const auto x = [=](double v) { return 4 + 136 * std::clamp((v - lower) / (upper - lower), 0.0, 1.0); };
  std::string out =
      "<svg class=\"interval\" viewBox=\"0 0 144 18\" aria-hidden=\"true\"><line class=\"axis\" x1=\"4\" x2=\"140\" y1=\"9\" y2=\"9\"/>";
  if (std::isfinite(low) && std::isfinite(high))
    out += fmt::format("<line class=\"s{}\" stroke-width=\"3\" x1=\"{:.2f}\" x2=\"{:.2f}\" y1=\"9\" y2=\"9\"/>", series % kColours, x(low),
                       x(high));
  out += fmt::format("<rect x=\"{:.2f}\" y=\"3.5\" width=\"2\" height=\"11\" stroke-width=\"1\"/></svg>", x(value) - 1);
  return {out};
}

Html place_drawing(double share, bool at_bound, double low, double high) {
  if (!std::isfinite(share)) return {};
  const auto x = [](double v) { return 5 + 102 * std::clamp(v, 0.0, 1.0); };
  const std::string reach = std::isfinite(low + high)
                                ? fmt::format("<line class=\"reach\" x1=\"{:.2f}\" x2=\"{:.2f}\" y1=\"7\" y2=\"7\"/>", x(low), x(high))
                                : std::string();
  return {fmt::format(
      "<svg class=\"place{}\" viewBox=\"0 0 112 14\" aria-hidden=\"true\"><line class=\"axis\" x1=\"5\" x2=\"107\" y1=\"7\" y2=\"7\"/>"
      "{}<circle cx=\"{:.2f}\" cy=\"7\" r=\"5\"/></svg>",
      at_bound ? " bound" : "", reach, x(share))};
}

Html synthetic_badge() { return markup("<span class=\"badge\">synthetic data</span>"); }

Html key_drawing(std::size_t series) {
  return {
      fmt::format("<svg class=\"key\" viewBox=\"0 0 30 12\" aria-hidden=\"true\"><line class=\"s{}\" x1=\"0\" x2=\"30\" y1=\"6\" y2=\"6\" "
                  "stroke-dasharray=\"{}\"/></svg>",
                  series % kColours, kDashes[series % kDashes.size()])};
}

Html recording_key() {
  return markup("<svg class=\"key\" viewBox=\"0 0 30 12\" aria-hidden=\"true\"><rect x=\"1\" y=\"1\" width=\"28\" height=\"10\"/></svg>");
}

}  // namespace swarmfit
