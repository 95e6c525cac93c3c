// SPDX-License-Identifier: MIT
// Meshes against closed forms and brute force, and surfaces that are none.
#include "libswarm/mesh.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "libswarm/distance_field.h"
#include "libtrack/error.h"
#include "libtrack/rng.h"
#include "tests/swarm/blind.h"
#include "tests/swarm/lane.h"
#include "tests/swarm/meshes.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using ::testing::HasSubstr;

double length(const Array3d& a) { return std::sqrt(a.square().sum()); }

Array3d random_place(std::uint32_t k, double reach) {
  const Rng rng{11};
  const auto xy = rng.uniform2(Stream::start, 0, k, 0);
  return reach * (2 * Array3d(xy[0], xy[1], rng.uniform(Stream::start, 0, k, 1)) - 1);
}

TEST(Mesh, ABoxIsExact) {
  const Array3d lower(-1, -0.5, 0), upper(1, 0.5, 0.75);
  const Mesh mesh = box_mesh(lower, upper).mesh();
  const Obstacle box{.shape = Obstacle::Shape::box, .lower = lower, .upper = upper};
  EXPECT_NEAR(mesh.volume(), 1.5, 1e-12);
  for (std::uint32_t k = 0; k < 20000; ++k) {
    const Array3d p = random_place(k, 2);
    const Surface exact = surface_of(box, p, 3);
    const Mesh::Near near = mesh.nearest(p);
    ASSERT_NEAR(near.distance, exact.distance, 1e-12) << p.transpose();
    if (exact.distance > 1e-6) {
      ASSERT_LT((near.outward - exact.outward).abs().maxCoeff(), 1e-9) << p.transpose();
    }
  }
}

// Of a chord of angle a the sagitta is 1 - cos(a / 2); edges of four levels are at most pi / 2 / 16 long, and a triangle's middle lies
// deeper than that of an edge.
TEST(Mesh, ASphereIsAsRoundAsItsTriangles) {
  const Mesh mesh = sphere_mesh(4).mesh();
  const double sagitta = 0.006;
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const Array3d p = random_place(k, 1.5);
    const double d = mesh.nearest(p).distance, exact = length(p) - 1;
    ASSERT_GE(d, exact - 1e-12);
    ASSERT_LE(d, exact + sagitta);
    if (std::abs(exact) > 2 * sagitta) {
      ASSERT_EQ(mesh.inside(p), exact < 0);
    }
  }
}

TEST(Mesh, ATorusHasAHole) {
  const Mesh mesh = torus_mesh(96).mesh();
  EXPECT_GT(mesh.nearest({0, 0, 0}).distance, 0.59);
  EXPECT_LT(mesh.nearest({1, 0, 0}).distance, -0.39);
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const Array3d p = random_place(k, 1.6);
    const double exact = std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) - 0.4;
    ASSERT_NEAR(mesh.nearest(p).distance, exact, 0.0025) << p.transpose();
  }
}

// The distance to the nearest of all triangles, by sampling none out: over its plane, its edges and its corners, each written out anew.
double to_segment(const Array3d& a, const Array3d& b, const Array3d& p) {
  const double t = std::clamp(((p - a) * (b - a)).sum() / (b - a).square().sum(), 0.0, 1.0);
  return length(p - a - t * (b - a));
}
double to_triangle(const Array3d& a, const Array3d& b, const Array3d& c, const Array3d& p) {
  double best = std::min({to_segment(a, b, p), to_segment(b, c, p), to_segment(c, a, p)});
  const Eigen::Vector3d n = (b - a).matrix().cross((c - a).matrix()).normalized(), at = (p - a).matrix();
  const Eigen::Vector3d foot = at - n.dot(at) * n, u = (b - a).matrix(), v = (c - a).matrix();
  const double wu = n.dot(foot.cross(v)) / n.dot(u.cross(v)), wv = n.dot(u.cross(foot)) / n.dot(u.cross(v));
  if (wu >= 0 && wv >= 0 && wu + wv <= 1) best = std::min(best, std::abs(n.dot(at)));
  return best;
}

// How often the surface winds round a place, from the solid angles of its triangles (van Oosterom and Strackee 1983): 1 inside, 0 outside.
double winding(const RawMesh& m, const Array3d& p) {
  double sum = 0;
  for (const auto& [i, j, k] : m.triangles) {
    const Eigen::Vector3d a = (m.corners[i] - p).matrix(), b = (m.corners[j] - p).matrix(), c = (m.corners[k] - p).matrix();
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

// A star with sharp tips, where the normal of one face alone would tell the wrong side.
RawMesh star() {
  RawMesh m = sphere_mesh(2);
  for (std::size_t k = 0; k < m.corners.size(); ++k) m.corners[k] *= k % 3 == 0 ? 1.6 : 0.5;
  return m;
}

TEST(Mesh, AgreesWithBruteForce) {
  for (const RawMesh& raw : {star(), torus_mesh(9), sphere_mesh(0)}) {
    const Mesh mesh = raw.mesh();
    for (std::uint32_t k = 0; k < 4000; ++k) {
      const Array3d p = random_place(k, 1.8);
      double brute = std::numeric_limits<double>::infinity();
      for (const auto& [a, b, c] : raw.triangles) brute = std::min(brute, to_triangle(raw.corners[a], raw.corners[b], raw.corners[c], p));
      const double d = mesh.nearest(p).distance;
      ASSERT_NEAR(std::abs(d), brute, 1e-12) << p.transpose();
      if (brute > 1e-9) {
        ASSERT_EQ(d<0, winding(raw, p)> 0.5) << p.transpose();
      }
    }
  }
}

TEST(Mesh, ClearanceIsNeverMoreThanTheDistanceAndNeverOnTheWrongSide) {
  for (const RawMesh& raw : {star(), torus_mesh(48), box_mesh({-1, -0.5, 0}, {1, 0.5, 0.01})}) {
    const Mesh mesh = raw.mesh();
    int known = 0;
    for (std::uint32_t k = 0; k < 4000; ++k) {
      const Array3d p = random_place(k, 1.8);
      const double least = mesh.clearance(p), distance = mesh.nearest(p).distance;
      ASSERT_LE(std::abs(least), std::abs(distance));
      ASSERT_GE(least * distance, 0);
      known += least != 0 ? 1 : 0;
    }
    EXPECT_GT(known, 2800);
  }
}

TEST(Mesh, WaysMeetItFirstWhereBruteForceSays) {
  const RawMesh raw = star();
  const Mesh mesh = raw.mesh();
  int met = 0;
  for (std::uint32_t k = 0; k < 4000; ++k) {
    const Array3d start = random_place(k, 1.8), way = random_place(k + 5000, 3);
    if (mesh.inside(start)) continue;
    double brute = std::numeric_limits<double>::infinity();
    for (const auto& [i, j, l] : raw.triangles) {
      Eigen::Matrix3d columns;  // start + share way = a + u (b - a) + v (c - a)
      const Array3d& a = raw.corners[i];
      columns << way.matrix(), (a - raw.corners[j]).matrix(), (a - raw.corners[l]).matrix();
      const Eigen::Vector3d x = columns.fullPivLu().solve((a - start).matrix());
      if (x[1] >= 0 && x[2] >= 0 && x[1] + x[2] <= 1 && x[0] >= 0 && x[0] <= 1) brute = std::min(brute, x[0]);
    }
    const auto hit = mesh.first_hit(start, way);
    ASSERT_EQ(hit.has_value(), std::isfinite(brute)) << k;
    if (!hit) continue;
    ++met;
    ASSERT_NEAR(hit->share, brute, 1e-9);
    ASSERT_FALSE(mesh.inside(hit->place));
    ASSERT_LT((hit->outward * way).sum(), 0);
  }
  EXPECT_GT(met, 500);
}

std::string refusal(const RawMesh& raw) {
  try {
    static_cast<void>(raw.mesh());
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

TEST(Mesh, SurfacesOfNoBodyAreRefused) {
  const RawMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  RawMesh open = box, flipped = box, thick = box, flat = box, far = box, line = box, sheet, nobody;
  open.triangles.pop_back();
  EXPECT_THAT(refusal(open), HasSubstr("the surface is open at the edge from ("));
  std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
  EXPECT_THAT(refusal(flipped), HasSubstr("turn different ways; expected all counter-clockwise"));
  thick.corners.emplace_back(2, 2, 2);
  thick.triangles.push_back({0, 4, 8});
  EXPECT_THAT(refusal(thick), HasSubstr("meet at the edge from"));
  flat.corners[3][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(flat), HasSubstr("corner 4 is (1, nan, 0); expected finite numbers"));
  far.triangles[0][2] = 99;
  EXPECT_THAT(refusal(far), HasSubstr("triangle 1 has corner 100; expected corners 1 to 8"));
  line.corners.emplace_back(0, 0, 0.5);
  line.triangles.push_back({0, 4, 8});
  EXPECT_THAT(refusal(line), HasSubstr("triangle 13 has no area"));
  sheet.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_THAT(refusal(sheet), HasSubstr("encloses nothing"));
  EXPECT_THAT(refusal(nobody), HasSubstr("no triangles"));
}

// Every triangle with corners of its own, one of them twice, one with two equal corners, and all inside out.
TEST(Mesh, WhatCanBeMendedIs) {
  const RawMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  RawMesh soup;
  for (const Triangle& t : box.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.corners.size());
    for (const std::size_t k : {0U, 2U, 1U}) soup.corners.push_back(box.corners[t[k]]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  soup.triangles.push_back({1, 2, 0});
  soup.triangles.push_back({4, 4, 5});
  const Mesh mesh = soup.mesh();
  EXPECT_EQ(mesh.triangles().size(), 12u);
  EXPECT_NEAR(mesh.volume(), 1, 1e-12);
  EXPECT_NEAR(mesh.nearest({0.5, 0.5, 0.25}).distance, -0.25, 1e-12);
}

// A box within a box, inside out: a cavity.
TEST(Mesh, ACavityIsOutside) {
  RawMesh hollow = box_mesh({0, 0, 0}, {4, 4, 4});
  const RawMesh inner = box_mesh({1, 1, 1}, {3, 3, 3});
  for (const auto& corner : inner.corners) hollow.corners.push_back(corner);
  for (const auto& [a, b, c] : inner.triangles) hollow.triangles.push_back({a + 8, c + 8, b + 8});
  const Mesh mesh = hollow.mesh();
  EXPECT_NEAR(mesh.volume(), 64 - 8, 1e-9);
  EXPECT_NEAR(mesh.nearest({2, 2, 2}).distance, 1, 1e-12);
  EXPECT_NEAR(mesh.nearest({0.5, 2, 2}).distance, -0.5, 1e-12);
}

Obstacle body(RawMesh raw, Bounds::Wall wall) {
  return {.shape = Obstacle::Shape::mesh, .wall = wall, .mesh = std::make_shared<const Mesh>(raw.mesh())};
}

TEST(Mesh, WallsHoldWhateverTheModelKnows) {
  for (const auto wall : {Bounds::Wall::reflect, Bounds::Wall::slip})
    for (const RawMesh& raw : {star(), torus_mesh(9)}) {
      const Walls walls({body(raw, wall)});
      Lane lane;
      lane.world.bounds.kind = Bounds::Kind::box;
      lane.world.bounds.lower.setConstant(-2);
      lane.world.bounds.upper.setConstant(2);
      lane.world.add(walls.clone());
      for (std::uint32_t k = 0; k < 60; ++k) lane.state.spawn(0, random_place(k, 2), {0, 0, 0});  // some within
      Recorded out;
      lane.out = &out;
      cpu_backend().run(test::Blind{}, {.frame_dt = 0.2, .frames = 300}, {&lane, 1});
      EXPECT_FALSE(lane.blew_up);
      for (std::size_t m = 1; m < out.moments.size(); ++m)
        for (Index i = 0; i < 60; ++i) {
          const Array3d p = out.moments[m].pos.row(i).transpose();
          ASSERT_LT(winding(raw, p), 0.5 + 1e-6) << m << ": " << p.transpose();
          ASSERT_LE(p.abs().maxCoeff(), 2);
        }
    }
}

// A shell a millionth thick: nobody gets to its other side in one step.
TEST(Mesh, NobodyPassesThroughAThinOne) {
  RawMesh shell = sphere_mesh(3), inner = sphere_mesh(3);
  const auto n = static_cast<std::uint32_t>(shell.corners.size());
  for (const auto& corner : inner.corners) shell.corners.emplace_back((1 - 1e-6) * corner);
  for (const auto& [a, b, c] : inner.triangles) shell.triangles.push_back({a + n, c + n, b + n});
  World world;
  world.add(std::make_unique<Walls>(std::vector<Obstacle>{body(shell, Bounds::Wall::reflect)}));
  State before, after;
  for (std::uint32_t k = 0; k < 2000; ++k) {
    const Array3d from = random_place(k, 0.5), to = random_place(k + 3000, 4);
    before.spawn(0, from, to - from);
    after.spawn(0, to, to - from);
  }
  world.constrain(before, after);
  for (Index i = 0; i < after.size(); ++i) ASSERT_LT(length(after.pos.row(i).transpose()), 1) << i;
}

}  // namespace
}  // namespace swarmfit
