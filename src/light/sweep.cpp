// SPDX-License-Identifier: Apache-2.0
#include "light/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cloudgen::light {
namespace {

constexpr int kFrame = 3;  ///< crossings reach from 2 cells before to 3 beyond

/// Where a ray crosses a line of cells, as four weights from cell `first` on: the cubic through four values.
/// Two values would do, but their means, slice after slice, blur shadows over several cells.
struct Crossing {
  int first;
  float weights[4];

  explicit Crossing(float shift) {
    const float whole = std::floor(shift), t = shift - whole;
    first = static_cast<int>(whole) - 1;
    weights[0] = -t * (t - 1) * (t - 2) / 6;
    weights[1] = (t + 1) * (t - 1) * (t - 2) / 2;
    weights[2] = -(t + 1) * t * (t - 2) / 2;
    weights[3] = (t + 1) * t * (t - 1) / 6;
  }
};

}  // namespace

DepthSweep::DepthSweep(const ExtinctionGrid& grid) : grid_(&grid), depths_(grid.cells().size(), 0.0f) {}

void DepthSweep::towards(const glm::vec3& direction) {
  const glm::ivec3 size = grid_->size();
  const int strides[3] = {1, size.x, size.x * size.y};
  int main = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[axis]) > std::abs(direction[main])) main = axis;
  int row = (main + 2) % 3, along = (main + 1) % 3;
  if (strides[along] > strides[row]) std::swap(row, along);

  const float advance = std::abs(direction[main]);
  const float half = 0.5f * grid_->cellMeters() / advance;
  // The ray of a cell crosses the slice before at the same offset everywhere: constant weights.
  const Crossing across(direction[row] / advance), forward(direction[along] / advance);

  const int rows = size[row], columns = size[along], width = columns + 2 * kFrame;
  reached_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows + 2 * kFrame), 0.0f);
  shifted_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows + 2 * kFrame), 0.0f);
  const std::vector<float>& extinction = grid_->cells();
  const bool sunAbove = direction[main] > 0;
  for (int slice = 0; slice < size[main]; ++slice) {
    for (int j = 0; j < rows + 2 * kFrame; ++j) {
      const float* from = &reached_[static_cast<std::size_t>(j * width + kFrame + forward.first)];
      float* to = &shifted_[static_cast<std::size_t>(j * columns)];
      for (int k = 0; k < columns; ++k)
        to[k] = forward.weights[0] * from[k] + forward.weights[1] * from[k + 1] +
                forward.weights[2] * from[k + 2] + forward.weights[3] * from[k + 3];
    }
    const int level = sunAbove ? size[main] - 1 - slice : slice;
    for (int j = 0; j < rows; ++j) {
      const float* from = &shifted_[static_cast<std::size_t>((j + kFrame + across.first) * columns)];
      float* to = &reached_[static_cast<std::size_t>((j + kFrame) * width + kFrame)];
      const int start = level * strides[main] + j * strides[row];
      for (int k = 0; k < columns; ++k) {
        const auto cell = static_cast<std::size_t>(start + k * strides[along]);
        const float before = across.weights[0] * from[k] + across.weights[1] * from[k + columns] +
                             across.weights[2] * from[k + 2 * columns] +
                             across.weights[3] * from[k + 3 * columns];
        const float depth = std::max(before, 0.0f) + half * extinction[cell];
        depths_[cell] = depth;
        to[k] = depth + half * extinction[cell];
      }
    }
  }
}

float DepthSweep::at(const glm::vec3& point) const { return grid_->sample(depths_, point); }

}  // namespace cloudgen::light
