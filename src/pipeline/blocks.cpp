// SPDX-License-Identifier: Apache-2.0
#include "pipeline/blocks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "base/random.hpp"
#include "field/grid_plane.hpp"

namespace cloudgen::pipeline {
namespace {

/// A row of blocks: all of it but the column.
Block rowOfBlocks(const field::Grid& grid, int half, int row, int rows) {
  Block block;
  block.half = half, block.row = row, block.rows = rows;
  const int halfRows = field::latticeRows(grid);
  const int middle = half * halfRows + std::min(row * rows + rows / 2, halfRows - 1);
  block.cellsOfRow = std::max(1, field::columnsOf(grid, middle));
  const std::uint32_t cell = field::cellAt(grid, block.cellsOfRow / 2, middle);
  const glm::dvec2 sides = field::cellSidesMeters(grid, cell);
  const double narrow = std::clamp(sides.y / std::max(sides.x, 1.0), 1.0, 64.0);
  block.columns = rows * static_cast<int>(std::bit_floor(static_cast<unsigned>(narrow)));
  block.sizeMeters = {std::max(sides.x, 1.0) * block.columns, std::max(sides.y, 1.0) * rows};
  return block;
}

int columnOfBlock(const field::Grid& grid, const Block& block, std::uint32_t cell) {
  const double column = (grid.column(cell) + 0.5) * block.cellsOfRow / field::columnsOf(grid, grid.row(cell));
  return static_cast<int>(column) / block.columns;
}

std::uint64_t mixed(std::uint64_t x) {  // SplitMix64 (Steele et al. 2014)
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

std::optional<PlaceInCell> placeIn(const field::Grid& grid, const Block& block, double u, double v) {
  const int halfRows = field::latticeRows(grid);
  const double y = (block.row + v) * block.rows;
  const int row = static_cast<int>(y);
  if (row >= halfRows) return std::nullopt;
  const int gridRow = block.half * halfRows + row, count = field::columnsOf(grid, gridRow);
  const double x = (block.column + u) * block.columns * count / block.cellsOfRow;
  const int column = static_cast<int>(x);
  if (column >= count) return std::nullopt;
  return PlaceInCell{field::cellAt(grid, column, gridRow), x - column, y - row};
}

std::vector<LayerGroup> groupLayers(const field::Grid& grid, const Generalisation& general,
                                    std::span<const field::Layer> layers) {
  std::vector<std::uint32_t> order(layers.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(layers[a].cell, layers[a].ordinal) < std::pair(layers[b].cell, layers[b].ordinal);
  });
  const int halfRows = field::latticeRows(grid);
  std::map<std::tuple<int, int, int>, Block> rowsOfBlocks;
  std::map<std::tuple<std::uint64_t, base::Genus, int>, LayerGroup> groups;
  std::array<int, base::kGenusCount> below{};
  std::optional<std::uint32_t> last;
  for (const std::uint32_t index : order) {
    const field::Layer& layer = layers[index];
    if (last != layer.cell) below.fill(0);
    last = layer.cell;
    if (layer.cloudCount > 0) continue;
    const auto genus = static_cast<std::size_t>(layer.genus);
    const int rows = general.blockCells[genus], row = grid.row(layer.cell);
    const std::tuple key(rows, row / halfRows, row % halfRows / rows);
    const auto [found, isNew] = rowsOfBlocks.try_emplace(key);
    if (isNew) found->second = rowOfBlocks(grid, std::get<1>(key), std::get<2>(key), rows);
    Block block = found->second;
    block.column = columnOfBlock(grid, block, layer.cell);
    const int stack = below[genus]++;
    LayerGroup& group = groups[{block.address(), layer.genus, stack}];
    group.block = block, group.genus = layer.genus, group.stack = stack;
    group.layers.push_back(index);
  }
  std::vector<LayerGroup> out;
  for (auto& [key, group] : groups) out.push_back(std::move(group));
  return out;
}

double evenChance(const Block& block, std::uint64_t seed) {
  double chance = 0, step = 0.25;
  auto column = static_cast<std::uint64_t>(block.column), row = static_cast<std::uint64_t>(block.row);
  for (int level = 0; level < 16; ++level, step *= 0.25) {
    const std::uint64_t quarter = (column & 1) | (row & 1) << 1;
    column >>= 1, row >>= 1;
    // Which quarter comes first is a matter of the square that they make up.
    const std::uint64_t turn = mixed(mixed(seed + 977u * static_cast<std::uint64_t>(level) +
                                           31u * static_cast<std::uint64_t>(block.half)) ^
                                     (column << 32 | row));
    chance += step * static_cast<double>(quarter ^ (turn & 3));
  }
  return chance;
}

}  // namespace cloudgen::pipeline
