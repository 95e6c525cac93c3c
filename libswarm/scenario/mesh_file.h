// SPDX-License-Identifier: MIT
// Files that hold a mesh: Wavefront OBJ, STL (text or binary) and PLY (text or binary). Only corners and faces are read; faces with more
// than three corners are cut into triangles from their first corner, as if they were flat and convex.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "libswarm/mesh.h"

namespace swarmfit {

// The format is told by the ending of `name`, which is also how errors call the file. Throws InputError "name[:line]: what is wrong; what
// was expected".
std::shared_ptr<const Mesh> read_mesh(const std::string& name, std::string_view bytes, double scale = 1,
                                      const Eigen::Array3d& shift = Eigen::Array3d::Zero());

// What a file says, before anybody asks whether it is the surface of a body.
struct MeshText {
  std::vector<Eigen::Array3d> corners;
  std::vector<Triangle> triangles;
};
MeshText read_obj(const std::string& name, std::string_view bytes);
MeshText read_stl(const std::string& name, std::string_view bytes);
MeshText read_ply(const std::string& name, std::string_view bytes);

// Lines and words of a text, for readers of the above.
class MeshLines {
 public:
  MeshLines(const std::string& name, std::string_view text) : name_(name), rest_(text) {}
  bool next();  // the next line with a word on it; false at the end
  const std::vector<std::string_view>& words() const { return words_; }
  double number(std::size_t word) const;
  std::int64_t whole(std::size_t word) const;
  Eigen::Array3d place(std::size_t first_word) const;
  [[noreturn]] void refuse(const std::string& what) const;
  static std::string shown(std::string_view word);  // for messages: its beginning, on one line
  std::string_view rest() const { return rest_; }   // what stands behind this line

 private:
  std::string_view word(std::size_t number) const;
  std::string name_;
  std::string_view rest_;
  std::vector<std::string_view> words_;
  long line_ = 0;
};

// Adds the triangles of a face with these corners.
void add_face(MeshText& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace swarmfit
