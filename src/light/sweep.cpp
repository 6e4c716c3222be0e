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

/// What comes through `crossing` to each of a row of cells, whose neighbours across lie `step` apart.
void mix(const Crossing& crossing, const float* __restrict from, int step, int count, float* __restrict to) {
  const float *a = from, *b = from + step, *c = from + 2 * step, *d = from + 3 * step;
  const float *w = crossing.weights, w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3];
  for (int k = 0; k < count; ++k) to[k] = w0 * a[k] + w1 * b[k] + w2 * c[k] + w3 * d[k];
}

/// Depths on the slice before become those in the middles of the cells of a row, and those behind it.
void pass(const float* __restrict extinction, float half, int count, float* __restrict depth,
          float* __restrict behind) {
  for (int k = 0; k < count; ++k) {
    const float own = half * extinction[k], middle = std::max(depth[k], 0.0f) + own;
    depth[k] = middle;
    behind[k] = middle + own;
  }
}

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
  row_.resize(static_cast<std::size_t>(columns));
  cells_.resize(static_cast<std::size_t>(columns));
  const std::vector<float>& extinction = grid_->cells();
  const bool sunAbove = direction[main] > 0;
  for (int slice = 0; slice < size[main]; ++slice) {
    for (int j = 0; j < rows + 2 * kFrame; ++j)
      mix(forward, &reached_[static_cast<std::size_t>(j * width + kFrame + forward.first)], 1, columns,
          &shifted_[static_cast<std::size_t>(j * columns)]);
    const int level = sunAbove ? size[main] - 1 - slice : slice;
    for (int j = 0; j < rows; ++j) {
      float* depth = row_.data();
      mix(across, &shifted_[static_cast<std::size_t>((j + kFrame + across.first) * columns)], columns, columns,
          depth);
      const auto start = static_cast<std::size_t>(level * strides[main] + j * strides[row]),
                 stride = static_cast<std::size_t>(strides[along]);
      float* to = &reached_[static_cast<std::size_t>((j + kFrame) * width + kFrame)];
      if (stride == 1) {
        pass(&extinction[start], half, columns, depth, to);
        std::copy_n(depth, columns, &depths_[start]);
      } else {
        for (std::size_t k = 0; k < cells_.size(); ++k) cells_[k] = extinction[start + k * stride];
        pass(cells_.data(), half, columns, depth, to);
        for (std::size_t k = 0; k < cells_.size(); ++k) depths_[start + k * stride] = depth[k];
      }
    }
  }
}

float DepthSweep::at(const glm::vec3& point) const { return grid_->sample(depths_, point); }

}  // namespace cloudgen::light
