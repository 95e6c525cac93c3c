// SPDX-License-Identifier: MIT
#include "libswarm/state.h"

#include <algorithm>

namespace swarmfit {

Index State::spawn(std::uint8_t new_kind, const Eigen::Array3d& position, const Eigen::Array3d& velocity) {
  return spawn(new_kind, position, velocity, next_id);
}

Index State::spawn(std::uint8_t new_kind, const Eigen::Array3d& position, const Eigen::Array3d& velocity, std::uint32_t new_id) {
  const Index row = size();
  pos.conservativeResize(row + 1, 3);
  vel.conservativeResize(row + 1, 3);
  own.conservativeResize(row + 1, own.cols());
  pos.row(row) = position.transpose();
  vel.row(row) = velocity.transpose();
  own.row(row).setZero();
  id.push_back(new_id);
  kind.push_back(new_kind);
  next_id = std::max(next_id, new_id + 1);
  return row;
}

void State::remove(Index row) {
  const auto drop = [row, n = size()](auto& block) {
    for (Index column = 0; column < block.cols(); ++column)
      for (Index i = row; i + 1 < n; ++i) block(i, column) = block(i + 1, column);
    block.conservativeResize(n - 1, block.cols());
  };
  drop(own);
  drop(vel);
  drop(pos);
  id.erase(id.begin() + row);
  kind.erase(kind.begin() + row);
  if (row < entered) --entered;
}

}  // namespace swarmfit
