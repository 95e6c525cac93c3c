// SPDX-License-Identifier: MIT
// A tetrahedron in every format, and files that are broken in one way each.
#include "libswarm/scenario/mesh_file.h"

#include <gmock/gmock.h>

#include <bit>

#include "libswarm/distance_field.h"
#include "libswarm/scenario/read.h"
#include "libtrack/error.h"
#include "libtrack/file.h"

namespace swarmfit {
namespace {

using ::testing::HasSubstr;

constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr std::uint32_t kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

const std::string kObj =
    "# a comment\no body\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nf 1/1/1 3 2\nf 1 2 4\nf 2//1 3 4\nf -4 -1 -2\n";

std::string put(std::uint64_t bits, int bytes, bool big) {
  std::string out;
  for (int k = 0; k < bytes; ++k) out += static_cast<char>(bits >> (8 * (big ? bytes - 1 - k : k)));
  return out;
}
std::string put(float value, bool big = false) { return put(std::bit_cast<std::uint32_t>(value), 4, big); }

std::string stl_text() {
  std::string out = "solid body\n";
  for (const auto& face : kFaces) {
    out += " facet normal 0 0 0\n  outer loop\n";
    for (const auto k : face) {
      const auto& c = kCorners[k];
      out += "   vertex " + std::to_string(c[0]) + " " + std::to_string(c[1]) + " " + std::to_string(c[2]) + "\n";
    }
    out += "  endloop\n endfacet\n";
  }
  return out + "endsolid body\n";
}

std::string stl_binary() {
  std::string out = "solid in name only";  // as some programs write it
  out.resize(80, ' ');
  out += put(4, 4, false);
  for (const auto& face : kFaces) {
    out += std::string(12, '\0');
    for (const auto k : face)
      for (const float x : kCorners[k]) out += put(x);
    out += std::string(2, '\0');
  }
  return out;
}

std::string ply(const std::string& order) {
  std::string out = "ply\nformat " + order +
                    " 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty uchar red\n"
                    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nelement other 1\nproperty list uchar short "
                    "junk\nend_header\n";
  if (order == "ascii") return out + "0 0 9 0\n1 0 9 0\n0 1 9 0\n0 0 9 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n2 7 7\n";
  const bool big = order == "binary_big_endian";
  for (const auto& c : kCorners) out += put(c[0], big) + put(c[1], big) + "\x09" + put(c[2], big);
  for (const auto& face : kFaces) out += "\x03" + put(face[0], 4, big) + put(face[1], 4, big) + put(face[2], 4, big);
  return out + "\x01" + put(7, 2, big);
}

TEST(MeshFile, EveryFormatSaysTheSame) {
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"a.obj", kObj},
                                    {"A.STL", stl_text()},
                                    {"a.stl", stl_binary()},
                                    {"a.ply", ply("ascii")},
                                    {"a.ply", ply("binary_little_endian")},
                                    {"a.ply", ply("binary_big_endian")}}) {
    const auto mesh = read_mesh(name, bytes, 2, {1, 0, 0});
    EXPECT_EQ(mesh->triangles().size(), 4u) << name;
    EXPECT_NEAR(mesh->volume(), 8.0 / 6, 1e-12) << name;
    EXPECT_NEAR(mesh->nearest({1 + 0.4, 0.4, -3}).distance, 3, 1e-12) << name;
  }
}

TEST(MeshFile, FacesOfManyCornersAreCut) {
  const auto mesh = read_mesh("box.obj",
                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf "
                              "2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  EXPECT_EQ(mesh->triangles().size(), 12u);
  EXPECT_NEAR(mesh->volume(), 1, 1e-12);
}

std::string refusal(const std::string& name, const std::string& bytes) {
  try {
    read_mesh(name, bytes);
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(MeshFile, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal("a.fbx", ""), HasSubstr("a.fbx: is not a mesh by its ending; expected .obj, .stl or .ply"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 x 0\n"), HasSubstr("a.obj:2: 'x' is not a finite number"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 nan\n"), HasSubstr("a.obj:1: 'nan' is not a finite number"));
  EXPECT_THAT(refusal("a.obj", "v 0 0\n"), HasSubstr("a.obj:1: 3 words; expected at least 4"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nf 1 2 3\n"), HasSubstr("a.obj:2: '2' is none of the 1 corners before it"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nf 1 1\n"), HasSubstr("a.obj:2: a face of 2 corners"));
  EXPECT_THAT(refusal("a.obj", kObj.substr(0, kObj.rfind("f "))), HasSubstr("a.obj: the surface is open at the edge from"));
  EXPECT_THAT(refusal("a.obj", ""), HasSubstr("a.obj: no triangles"));
  EXPECT_THAT(refusal("a.stl", "nothing"), HasSubstr("a.stl:1: no STL"));
  EXPECT_THAT(refusal("a.stl", stl_binary() + "x"), HasSubstr("expected"));
  EXPECT_THAT(refusal("a.stl", "solid\nvertex 0 0 0\nendfacet\n"), HasSubstr("a.stl:3: a facet of 1 corners"));
  EXPECT_THAT(refusal("a.stl", "solid\nvertex 0 0 0\n"), HasSubstr("ends within a facet"));
  EXPECT_THAT(refusal("a.ply", "plu\n"), HasSubstr("a.ply:1: no PLY"));
  EXPECT_THAT(refusal("a.ply", "ply\nelement vertex 3\n"), HasSubstr("ends within its header"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 999999999999\n"), HasSubstr("expected 0 to 1e8"));
  const std::string binary = ply("binary_little_endian");
  EXPECT_THAT(refusal("a.ply", binary.substr(0, binary.size() - 9)), HasSubstr("the file ends before its last element"));
  std::string text = ply("ascii");
  text.replace(text.find("3 0 2 1"), 7, "3 0 2 9");
  EXPECT_THAT(refusal("a.ply", text), HasSubstr("has corner 9; expected 0 to 3"));
}

// Messages end at a zero byte, and may be shown on a terminal.
TEST(MeshFile, WordsOfBinaryFilesAreShownOnOneLine) {
  using namespace std::string_literals;
  EXPECT_THAT(refusal("a.obj", "v 0 0 \0\x1b[\n"s), HasSubstr("a.obj:1: '\\x00\\x1b[' is not a finite number; expected one"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nf \xff 1 1\n"s), HasSubstr("'\\xff' is none of the 1 corners before it; expected"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\nelement \0 1\nend_header\n"s), HasSubstr("element \\x00 has no property; expected"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\nelement a 1\nproperty \0 b\n"s), HasSubstr("'\\x00' is not a type; expected"));
}

std::string scene_with(const std::string& obstacle) { return "title = \"t\"\nmodel = \"brownian\"\n[[obstacle]]\n" + obstacle; }

TEST(MeshFile, ScenariosFindItBesideThemselvesOrAmongTheProgramsOwn) {
  const std::string folder = ::testing::TempDir() + "/meshes";
  make_directory(folder);
  write_file_atomically(folder + "/body.obj", kObj);
  const Scenario scene =
      read_scenario(folder + "/scene.toml", scene_with("shape = \"mesh\"\nfile = \"body.obj\"\nscale = 3\nat = [5, 0, 0]\n"));
  ASSERT_EQ(scene.obstacles.size(), 1u);
  EXPECT_NEAR(surface_of(scene.obstacles[0], {5.5, 0.5, -2}, 3).distance, 2, 1e-12);
  EXPECT_NO_THROW(read_scenario(folder + "/scene.toml", scene_with("shape = \"mesh\"\nfile = \"hamlet.obj\"\n")));
  try {
    read_scenario("scene.toml", scene_with("shape = \"mesh\"\nfile = \"no.obj\"\n"));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("scene.toml:5:8: [[obstacle]] file = 'no.obj' is not there; expected a mesh beside scene.toml"));
  }
  try {
    read_scenario("scene.toml", "title = \"t\"\nmodel = \"brownian\"\ndims = 2\n[[obstacle]]\nshape = \"mesh\"\n");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("'mesh' is not allowed"));
  }
}

}  // namespace
}  // namespace swarmfit
