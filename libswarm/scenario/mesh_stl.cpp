// SPDX-License-Identifier: MIT
// STL: in text "vertex x y z" three times per facet; in binary 80 bytes of anything, the number of triangles, and for each 50 bytes: normal
// and three corners as 32-bit numbers, little-endian, and two bytes of anything. The normals are not read: the order of corners tells.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "libswarm/scenario/mesh_file.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr std::size_t kHead = 84, kFacet = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 4; k-- > 0;) word = word << 8U | static_cast<unsigned char>(bytes[at + k]);
  return word;
}

MeshText of_binary(std::string_view bytes, std::uint32_t count) {
  MeshText mesh;
  mesh.corners.reserve(3 * std::size_t{count});
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t at = kHead + kFacet * t + 12;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Eigen::Array3d place;
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[static_cast<Eigen::Index>(axis)] = std::bit_cast<float>(word_at(bytes, at + 12 * corner + 4 * axis));
      mesh.corners.push_back(place);
    }
    const auto first = static_cast<std::uint32_t>(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

MeshText of_text(const std::string& name, std::string_view bytes) {
  MeshText mesh;
  MeshLines lines(name, bytes);
  std::vector<std::uint32_t> face;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "vertex") {
      face.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
      mesh.corners.push_back(lines.place(1));
    } else if (words[0] == "endfacet") {
      if (face.size() != 3) lines.refuse(fmt::format("a facet of {} corners; expected three", face.size()));
      add_face(mesh, face);
      face.clear();
    }
  }
  if (!face.empty()) lines.refuse("the file ends within a facet; expected endfacet");
  return mesh;
}

}  // namespace

MeshText read_stl(const std::string& name, std::string_view bytes) {
  if (bytes.size() >= kHead) {
    const std::uint32_t count = word_at(bytes, 80);
    if (bytes.size() == kHead + kFacet * std::size_t{count}) return of_binary(bytes, count);
    if (!bytes.starts_with("solid"))
      throw InputError(fmt::format("{}: {} bytes; expected text that begins with solid, or {} bytes for {} triangles", name, bytes.size(),
                                   kHead + kFacet * std::size_t{count}, count));
  }
  if (!bytes.starts_with("solid")) throw InputError(name + ":1: no STL; expected text that begins with solid, or 84 bytes and more");
  return of_text(name, bytes);
}

}  // namespace swarmfit
