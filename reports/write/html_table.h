// SPDX-License-Identifier: MIT
// HTML tables and small static drawings. Everything that returns `Html` is safe to insert; plain strings are escaped on the way in.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/nan.h"

namespace swarmfit {

// Text that is already HTML: a type of its own, so that nothing gets there unescaped by mistake.
struct Html {
  std::string text;
  Html& operator+=(const Html& more) {
    text += more.text;
    return *this;
  }
};

// Text as HTML content or attribute value: & < > " ' become entities.
std::string html_escaped(std::string_view text);
Html escaped(std::string_view text);
// Our own markup: a literal, never anything that came from data.
template <std::size_t N>
Html markup(const char (&literal)[N]) {
  return {std::string(literal, N - 1)};
}
// <tag class="classes">content</tag>
Html element(std::string_view tag, std::string_view classes, const Html& content);

// A table in a box that scrolls sideways and can be reached by keyboard.
class HtmlTable {
 public:
  explicit HtmlTable(std::string_view caption) : caption_(caption) {}
  struct Cell {
    Html content;
    bool number = false;  // right-aligned
    bool head = false;
    bool soft = false;   // a metric that is left out
    std::string also{};  // further classes of report.css
    std::string note{};  // what it means, shown where the pointer rests
  };
  HtmlTable& head(const std::vector<Cell>& cells) { return add(head_, "", cells); }
  HtmlTable& row(const std::vector<Cell>& cells, std::string_view classes = "") { return add(body_, classes, cells); }
  HtmlTable& foot(const std::vector<Cell>& cells) { return add(foot_, "", cells); }
  HtmlTable& sortable() {  // by its headings, where the page has the script
    sortable_ = true;
    return *this;
  }
  HtmlTable& look(std::string_view classes) {  // of report.css; "frozen": its first column stays in sight
    classes_ = classes;
    return *this;
  }
  Html html() const;

 private:
  HtmlTable& add(std::string& part, std::string_view classes, const std::vector<Cell>& cells);
  std::string caption_, classes_, head_, body_, foot_;
  bool sortable_ = false;
};

HtmlTable::Cell name_cell(Html content);  // heads a row
HtmlTable::Cell text_cell(std::string_view text);
HtmlTable::Cell number_cell(std::string_view text, bool soft = false);
// Heads a column.
HtmlTable::Cell column(std::string_view title, bool number = false, bool soft = false, std::string_view note = {});

// <div><dt>term</dt><dd>value</dd></div>, for use inside <dl class="facts">; nothing if the value is empty.
Html fact(std::string_view term, std::string_view value, bool wide = false);

// value with its interval on the common scale [lower, upper]; empty unless all are finite.
Html interval_drawing(double value, double low, double high, double lower, double upper, std::size_t series);
// Where a fitted value lies between its bounds, and its interval, if that is finite; all from 0 to 1.
Html place_drawing(double share, bool at_bound, double low = kNaN, double high = kNaN);
// "synthetic data", beside a page's kind.
Html synthetic_badge();
// Line sample of a series in the charts' legend.
Html key_drawing(std::size_t series);
Html recording_key();

}  // namespace swarmfit
