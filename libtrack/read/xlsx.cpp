// SPDX-License-Identifier: MIT
#include "libtrack/read/xlsx.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <pugixml.hpp>

#include "libtrack/error.h"
#include "libtrack/read/xml_file.h"

namespace swarmfit {
namespace {

// Names without their namespace: "x:row" → "row".
std::string_view plain(std::string_view name) { return name.substr(name.find(':') == std::string_view::npos ? 0 : name.find(':') + 1); }

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  for (const auto c : node.children())
    if (plain(c.name()) == name) return c;
  return {};
}

// The text of a shared or inline string: plain, or in runs of one look each.
std::string string_of(const pugi::xml_node& node) {
  std::string out;
  for (const auto part : node.children()) {
    if (plain(part.name()) == "t") out += part.text().get();
    if (plain(part.name()) == "r") out += child(part, "t").text().get();
  }
  return out;
}

class Book {
 public:
  Book(const std::string& name, const ZipFile& zip) : name_(name), zip_(zip) {
    if (!zip.has("xl/sharedStrings.xml")) return;
    const auto document = parse_xml(name, zip.read("xl/sharedStrings.xml"));
    for (const auto item : document->document_element().children()) shared_.push_back(string_of(item));
  }

  std::vector<Sheet> sheets() {
    const auto relations = parse_xml(name_, zip_.read("xl/_rels/workbook.xml.rels"));
    std::map<std::string, std::string> target;
    for (const auto r : relations->document_element().children()) target[r.attribute("Id").value()] = r.attribute("Target").value();
    const auto book = parse_xml(name_, zip_.read(std::string(kWorkbook)));
    std::vector<Sheet> out;
    for (const auto sheet : child(book->document_element(), "sheets").children()) {
      std::string path = target[sheet.attribute("r:id").value()];
      if (path.starts_with('/'))
        path.erase(0, 1);
      else
        path.insert(0, "xl/");
      out.push_back({sheet.attribute("name").value(), cells(path)});
    }
    return out;
  }

 private:
  [[noreturn]] void damaged() const { throw InputError(name_ + ": the spreadsheet cannot be read; expected an undamaged file"); }

  // "C12" → column 2; `next` where the cell does not say.
  std::size_t column(std::string_view reference, std::size_t next) const {
    if (reference.empty()) return next;
    std::size_t value = 0;
    for (const char c : reference) {
      if (c < 'A' || c > 'Z') break;
      value = 26 * value + static_cast<std::size_t>(c - 'A') + 1;
      if (value > 16384) damaged();
    }
    if (value == 0) damaged();
    return value - 1;
  }

  std::string value(const pugi::xml_node& cell) const {
    const std::string_view type = cell.attribute("t").value();
    if (type == "inlineStr") return string_of(child(cell, "is"));
    std::string text = child(cell, "v").text().get();
    if (type != "s") return text;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size() || index >= shared_.size()) damaged();
    return shared_[index];
  }

  // The sheet is parsed row by row: as a whole it would take ten times its text.
  std::vector<std::vector<std::string>> cells(const std::string& path) {
    const auto bytes = zip_.read(path);
    const std::size_t most = 100'000 + bytes.size();  // empty cells between full ones take room here, and none in the file
    std::size_t count = 0;
    std::vector<std::vector<std::string>> rows;
    std::string_view rest = bytes;
    for (auto text = next_row(rest); !text.empty(); text = next_row(rest)) {
      pugi::xml_document document;
      if (!document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment)) damaged();
      const auto row = document.first_child();
      const auto number = row.attribute("r").as_uint(static_cast<unsigned>(rows.size() + 1));
      if (number <= rows.size() || number > most) damaged();
      rows.resize(number);
      add_cells(row, rows.back(), count, most);
    }
    return rows;
  }

  // From "<row" to "</row>", whatever stands before "row:" in both; nothing behind the last one.
  std::string_view next_row(std::string_view& rest) const {
    for (;;) {
      const auto open = rest.find('<');
      if (open == std::string_view::npos) return {};
      rest.remove_prefix(open);
      const auto tag = rest.substr(1, std::min(rest.find_first_of(" \t\r\n/>", 1), rest.size()) - 1);
      if (plain(tag) == "row") break;
      rest.remove_prefix(1);
    }
    const auto tag = rest.substr(1, rest.find_first_of(" \t\r\n/>", 1) - 1);
    const auto end_of_tag = rest.find('>');
    if (end_of_tag == std::string_view::npos) damaged();
    std::size_t length = end_of_tag + 1;
    if (rest[end_of_tag - 1] != '/') {
      const auto close = rest.find(fmt::format("</{}>", tag), length);
      if (close == std::string_view::npos) damaged();
      length = close + tag.size() + 3;
    }
    const auto row = rest.substr(0, length);
    rest.remove_prefix(length);
    return row;
  }

  void add_cells(const pugi::xml_node& row, std::vector<std::string>& out, std::size_t& count, std::size_t most) const {
    for (const auto cell : row.children()) {
      const auto at = column(cell.attribute("r").value(), out.size());
      if (at < out.size()) damaged();
      count += at + 1 - out.size();
      if (count > most) damaged();
      out.resize(at + 1);
      out[at] = value(cell);
    }
  }

  const std::string& name_;
  const ZipFile& zip_;
  std::vector<std::string> shared_;
};

}  // namespace

std::vector<Sheet> read_xlsx(const std::string& name, const ZipFile& zip) { return Book(name, zip).sheets(); }

}  // namespace swarmfit
