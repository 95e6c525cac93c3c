// SPDX-License-Identifier: MIT
// A solid body as a closed surface of triangles, and how far it is from anywhere. The nearest triangle is found in a tree of boxes; whether
// a place is inside is told by the pseudonormal of the nearest face, edge or corner, weighted by angles: J. A. Baerentzen, H. Aanaes,
// Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11(3), 2005 (doi:10.1109/TVCG.2005.49).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libswarm/clearance.h"

namespace swarmfit {

using Triangle = std::array<std::uint32_t, 3>;  // corners, counter-clockwise as seen from outside

class Mesh {
 public:
  // Corners at the very same place become one, triangles with two equal corners vanish, and so does the second of two equal ones. A surface
  // that is all inside out is turned; within a larger body a part that is inside out is a cavity. Throws InputError, without a place, on
  // corners that are no finite numbers or not there, triangles without area, an open surface, one whose triangles turn different ways or
  // meet more than two at an edge, and one that encloses nothing. Surfaces that cut through each other are not noticed.
  Mesh(const std::vector<Eigen::Array3d>& corners, const std::vector<Triangle>& triangles);

  struct Near {
    double distance;         // > 0 outside, < 0 inside [unit]
    Eigen::Array3d place;    // of the surface; where several are nearest, one of them
    Eigen::Array3d outward;  // unit vector, the gradient of the distance
  };
  Near nearest(const Eigen::Array3d& place) const;
  double clearance(const Eigen::Array3d& place) const { return clearance_.at(place); }  // see Clearance
  bool inside(const Eigen::Array3d& place) const;                                       // deeper than skin()

  // Where the way from `start` to `start` + `way` comes through the surface from outside for the first time; `place` is skin() outside it.
  struct Hit {
    double share;  // of the way, 0 .. 1
    Eigen::Array3d place, outward;
  };
  std::optional<Hit> first_hit(const Eigen::Array3d& start, const Eigen::Array3d& way) const;

  const std::vector<Eigen::Array3d>& corners() const { return corners_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Eigen::Array3d& lower() const { return boxes_.front().lower; }
  const Eigen::Array3d& upper() const { return boxes_.front().upper; }
  double volume() const { return volume_; }
  double skin() const { return skin_; }  // a billionth of the diagonal: as far as rounding reaches

 private:
  struct Box {  // of the tree; its two children stand at `first` and `first` + 1, or it holds triangles first .. first + count - 1
    Eigen::Array3d lower, upper;
    std::uint32_t first, count;  // count 0: it has children
  };
  struct Pseudonormals {
    Eigen::Array3d face;
    std::array<Eigen::Array3d, 3> edge, corner;  // edge k from corner k to the next
  };
  void plant_tree();
  void split(std::uint32_t box, std::vector<std::uint32_t>& order, std::uint32_t first, std::uint32_t end);
  void find_normals();

  std::vector<Eigen::Array3d> corners_;
  std::vector<Triangle> triangles_;  // in the order of the tree
  std::vector<Box> boxes_;
  std::vector<Pseudonormals> normals_;
  double volume_ = 0, skin_ = 0;
  Clearance clearance_;
};

}  // namespace swarmfit
