// SPDX-License-Identifier: MIT
// Wavefront OBJ: v x y z, f corner/texture/normal ... with corners counted from 1, or from the end if negative. Everything else is passed
// over.
#include <fmt/format.h>

#include <charconv>

#include "libswarm/scenario/mesh_file.h"

namespace swarmfit {
namespace {

std::uint32_t corner_of(const MeshLines& lines, std::string_view word, std::size_t corners) {
  std::int64_t number = 0;
  const std::string_view text = word.substr(0, word.find('/'));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const auto count = static_cast<std::int64_t>(corners);
  if (error != std::errc() || end != text.data() + text.size() || number == 0 || number > count || number < -count)
    lines.refuse(fmt::format("'{}' is none of the {} corners before it; expected their number, from 1", MeshLines::shown(word), count));
  return static_cast<std::uint32_t>(number > 0 ? number - 1 : count + number);
}

}  // namespace

MeshText read_obj(const std::string& name, std::string_view bytes) {
  MeshText mesh;
  MeshLines lines(name, bytes);
  std::vector<std::uint32_t> face;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") mesh.corners.push_back(lines.place(1));
    if (words[0] != "f") continue;
    if (words.size() < 4) lines.refuse(fmt::format("a face of {} corners; expected three or more", words.size() - 1));
    face.clear();
    for (std::size_t k = 1; k < words.size(); ++k) face.push_back(corner_of(lines, words[k], mesh.corners.size()));
    add_face(mesh, face);
  }
  return mesh;
}

}  // namespace swarmfit
