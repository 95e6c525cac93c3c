// SPDX-License-Identifier: MIT
#include "libtrack/read/read_curve.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/read/xml_file.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

bool parts(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\r' || c == '\n' || c == ';'; }

// Takes the next number off the text; false where there is none.
bool take_number(std::string_view& text, double& value) {
  while (!text.empty() && parts(text.front())) text.remove_prefix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

Curve finished(Curve curve, const std::string& place) {
  auto& p = curve.points;
  if (p.size() > 2 && (p.front() == p.back()).all()) {
    p.pop_back();
    curve.closed = true;
  }
  if (p.size() < 2)
    throw InputError(fmt::format("{}: {} point{}; expected a curve of at least two", place, p.size(), p.size() == 1 ? "" : "s"));
  if (curve.closed && p.size() < 3) curve.closed = false;
  if (!(curve.length() > 0)) throw InputError(place + ": all points are at one place; expected a curve");
  return curve;
}

Curve from_lines(const std::string& name, std::string_view bytes) {
  Curve curve;
  long number = 0;
  while (!bytes.empty()) {
    const auto end = bytes.find('\n');
    std::string_view line = bytes.substr(0, end);
    bytes = end == std::string_view::npos ? std::string_view{} : bytes.substr(end + 1);
    ++number;
    const std::size_t length = line.size();
    while (!line.empty() && parts(line.front())) line.remove_prefix(1);
    if (line.empty() || line.front() == '#') continue;
    double v[3] = {0, 0, 0};
    int count = 0;
    while (count < 3 && take_number(line, v[count])) ++count;
    while (!line.empty() && parts(line.front())) line.remove_prefix(1);
    if (count >= 2 && line.empty()) {
      curve.points.emplace_back(v[0], v[1], v[2]);
    } else if (!curve.points.empty() || count > 0) {  // else a header
      throw InputError(
          fmt::format("{}:{}:{}: no point; expected two or three numbers: x,y or x,y,z", name, number, length - line.size() + 1));
    }
  }
  return finished(std::move(curve), name);
}

Curve from_points(std::string_view text, bool closed, const std::string& place) {
  Curve curve{{}, closed};
  double x = 0, y = 0;
  while (take_number(text, x)) {
    if (!take_number(text, y)) throw InputError(place + ": an x without its y in `points`; expected pairs of numbers");
    curve.points.emplace_back(x, -y, 0);
  }
  while (!text.empty() && parts(text.front())) text.remove_prefix(1);
  if (!text.empty()) throw InputError(fmt::format("{}: '{}' in `points`; expected numbers", place, text.substr(0, 20)));
  return finished(std::move(curve), place);
}

// The lines of a path: M, L, H, V, Z, in capitals from the origin, in small letters from the last point.
Curve from_path(std::string_view text, const std::string& place) {
  Curve curve;
  Array3d at = Array3d::Zero();
  char command = 0;
  for (;;) {
    while (!text.empty() && parts(text.front())) text.remove_prefix(1);
    if (text.empty()) break;
    if (std::strchr("MmLlHhVvZz", text.front())) {
      command = text.front();
      text.remove_prefix(1);
      if (command == 'Z' || command == 'z') {
        curve.closed = true;
        break;
      }
    }
    const bool relative = command >= 'a';
    const char axis = static_cast<char>(command | 0x20);
    double x = 0, y = 0;
    const bool both = axis == 'm' || axis == 'l';
    const bool read = (axis == 'v' || take_number(text, x)) && (axis == 'h' || take_number(text, y));
    if (command == 0 || !read)
      throw InputError(fmt::format("{}: '{}' in the path; expected straight lines only: M, L, H, V, Z", place, text.substr(0, 20)));
    const Array3d base = relative ? at : Array3d(both || axis == 'h' ? 0 : at[0], both || axis == 'v' ? 0 : at[1], 0);
    at = base + Array3d(axis == 'v' ? 0 : x, axis == 'h' ? 0 : -y, 0);
    curve.points.push_back(at);
  }
  return finished(std::move(curve), place);
}

Curve from_svg(const std::string& name, std::string_view bytes) {
  const auto document = parse_xml(name, bytes);
  const auto drawn = document->find_node([](const pugi::xml_node& node) {
    return std::strcmp(node.name(), "polyline") == 0 || std::strcmp(node.name(), "polygon") == 0 || std::strcmp(node.name(), "path") == 0;
  });
  if (!drawn) throw InputError(name + ": no curve; expected a polyline, a polygon or a path");
  const std::string place = xml_place(name, bytes, drawn);
  if (std::strcmp(drawn.name(), "path") == 0) return from_path(drawn.attribute("d").value(), place);
  return from_points(drawn.attribute("points").value(), std::strcmp(drawn.name(), "polygon") == 0, place);
}

}  // namespace

DrawnCurve read_curve(const std::string& name) {
  if (name == "heart") return {heart(), false};
  if (name == "star") return {star(), false};
  const std::string bytes = read_file(name);
  if (xml_root(bytes) == "svg") return {from_svg(name, bytes), false};
  return {from_lines(name, bytes), true};
}

}  // namespace swarmfit
