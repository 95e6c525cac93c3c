// SPDX-License-Identifier: MIT
#include "libswarm/state.h"

#include <algorithm>
#include <utility>

namespace swarmfit {

Index State::append(Index count) {
  const Index first = size();
  const auto grow = [&](auto& block) {
    block.conservativeResize(first + count, block.cols());
    block.bottomRows(count).setZero();
  };
  grow(pos), grow(vel), grow(own);
  for (Index k = 0; k < count; ++k) id.push_back(next_id++);
  kind.resize(kind.size() + static_cast<std::size_t>(count), 0);
  return first;
}

Index State::spawn(std::uint8_t new_kind, const Eigen::Array3d& position, const Eigen::Array3d& velocity) {
  const Index row = append(1);
  pos.row(row) = position.transpose();
  vel.row(row) = velocity.transpose();
  kind.back() = new_kind;
  return row;
}

Index State::spawn(std::uint8_t new_kind, const Eigen::Array3d& position, const Eigen::Array3d& velocity, std::uint32_t new_id) {
  const std::uint32_t next = std::max(next_id, new_id + 1);
  const Index row = spawn(new_kind, position, velocity);
  id.back() = new_id;
  next_id = next;
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

void State::reorder(std::span<const Index> order) {
  const auto along = [order](auto& block) {
    auto moved = block;
    for (Index column = 0; column < block.cols(); ++column)
      for (Index row = 0; row < block.rows(); ++row) moved(row, column) = block(order[static_cast<std::size_t>(row)], column);
    block = std::move(moved);
  };
  const auto through = [order](auto& values) {
    auto moved = values;
    for (std::size_t row = 0; row < values.size(); ++row) moved[row] = values[static_cast<std::size_t>(order[row])];
    values = std::move(moved);
  };
  along(pos), along(vel), along(own);
  through(id), through(kind);
}

}  // namespace swarmfit
