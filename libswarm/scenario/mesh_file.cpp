// SPDX-License-Identifier: MIT
#include "libswarm/scenario/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/utf8.h"

namespace swarmfit {

bool MeshLines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++line_;
    words_.clear();
    while (true) {
      const std::size_t begin = line.find_first_not_of(" \t\r\f\v");
      if (begin == std::string_view::npos) break;
      line.remove_prefix(begin);
      const std::size_t size = std::min(line.find_first_of(" \t\r\f\v"), line.size());
      words_.push_back(line.substr(0, size));
      line.remove_prefix(size);
    }
    if (!words_.empty()) return true;
  }
  return false;
}

std::string MeshLines::shown(std::string_view word) { return plain_name(word.substr(0, 40)); }

void MeshLines::refuse(const std::string& what) const { throw InputError(at(name_, line_, 0, what)); }

std::string_view MeshLines::word(std::size_t number) const {
  if (number >= words_.size()) refuse(fmt::format("{} words; expected at least {}", words_.size(), number + 1));
  return words_[number];
}

double MeshLines::number(std::size_t at) const {
  const std::string_view text = word(at);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    refuse(fmt::format("'{}' is not a finite number; expected one", shown(text)));
  return value;
}

std::int64_t MeshLines::whole(std::size_t at) const {
  const std::string_view text = word(at);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    refuse(fmt::format("'{}' is not a whole number; expected one", shown(text)));
  return value;
}

Eigen::Array3d MeshLines::place(std::size_t first) const { return {number(first), number(first + 1), number(first + 2)}; }

void add_face(MeshText& mesh, const std::vector<std::uint32_t>& corners) {
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) mesh.triangles.push_back({corners[0], corners[k], corners[k + 1]});
}

std::shared_ptr<const Mesh> read_mesh(const std::string& name, std::string_view bytes, double scale, const Eigen::Array3d& shift) {
  std::string ending = name.substr(std::min(name.rfind('.'), name.size()));
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending != ".obj" && ending != ".stl" && ending != ".ply")
    throw InputError(fmt::format("{}: is not a mesh by its ending; expected .obj, .stl or .ply", name));
  MeshText mesh = ending == ".obj" ? read_obj(name, bytes) : ending == ".stl" ? read_stl(name, bytes) : read_ply(name, bytes);
  for (Eigen::Array3d& corner : mesh.corners) corner = scale * corner + shift;
  try {
    return std::make_shared<const Mesh>(mesh.corners, mesh.triangles);
  } catch (const InputError& e) {
    throw InputError(name + ": " + e.what());
  }
}

}  // namespace swarmfit
