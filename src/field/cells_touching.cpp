// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/thread.hpp"
#include "field/cap.hpp"
#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

bool columnTouches(const Grid& grid, int row, int column, const base::GeoBox& box) {
  const double step = stepOfRow(grid, row), width = std::abs(step);
  const double west = planeX(grid, row, column + 0.5) - 0.5 * width;
  const double eastward = (west - box.west) - 360.0 * std::floor((west - box.west) / 360.0);
  return eastward < box.width() - kSameDegrees || eastward + width > 360.0 + kSameDegrees;
}

/// Exact: rows and columns are latitudes and longitudes.
std::vector<std::uint32_t> geographicCells(const Grid& grid, const base::GeoBox& box) {
  std::vector<std::uint32_t> cells;
  std::vector<int> columns;
  for (int row = 0; row < grid.rows; ++row) {
    const Interval latitudes = rowInterval(grid, row);
    if (latitudes.high <= box.south + kSameDegrees || latitudes.low >= box.north - kSameDegrees) continue;
    if (columns.empty() || !grid.reducedRows.empty()) {
      columns.clear();
      for (int column = 0; column < columnsOf(grid, row); ++column)
        if (columnTouches(grid, row, column, box)) columns.push_back(column);
    }
    for (const int column : columns) cells.push_back(cellAt(grid, column, row));
  }
  return cells;
}

bool strictlyWithin(const base::GeoBox& box, const GeoPoint& place) {
  const double eastward = place.longitudeDegrees - box.west;
  const double along = eastward - 360.0 * std::floor(eastward / 360.0);
  return place.latitudeDegrees > box.south + kSameDegrees &&
         place.latitudeDegrees < box.north - kSameDegrees &&
         ((along > kSameDegrees && along < box.width() - kSameDegrees) || box.width() >= 360);
}

/// By places of the cell that lie in the box, and places of the box that lie in the cell.
bool cellTouches(const Grid& grid, std::uint32_t cell, const base::GeoBox& box) {
  if (!counts(grid, cell)) return false;
  const auto cap = capOf(grid, cell);
  if (cap) {
    const Relation relation = relationOf(*cap, box);
    if (relation != Relation::Across) return relation == Relation::Inside;
  }
  for (const double v : {0.5, 0.001, 0.25, 0.75, 0.999})
    for (const double u : {0.5, 0.001, 0.25, 0.75, 0.999})
      if (strictlyWithin(box, pointIn(grid, cell, u, v))) return true;
  const auto part = cap ? partWithin(box, *cap) : box;
  if (!part) return false;
  constexpr int kSamples = 8;
  const auto along = [](int i) { return std::clamp(static_cast<double>(i) / kSamples, 1e-4, 1 - 1e-4); };
  for (int i = 0; i <= kSamples; ++i)
    for (int k = 0; k <= kSamples; ++k)
      if (holds(grid, cell,
                {base::wrappedLongitude(part->west + along(i) * part->width()),
                 part->south + along(k) * part->height()}))
        return true;
  return false;
}

/// Cells [column, column + columns) of rows [row, row + rows).
struct Block {
  int column = 0, row = 0, columns = 0, rows = 0;
};

/// Halves blocks until they lie on one side of the box's border, so that the work goes with the length of
/// that border.
class Search {
 public:
  Search(const Grid& grid, const base::GeoBox& box) : grid_(grid), box_(box) {}

  void visit(const Block& block) {
    if (block.columns <= 2 && block.rows <= 2) {
      eachCell(block, [&](std::uint32_t cell) {
        if (cellTouches(grid_, cell, box_)) cells.push_back(cell);
      });
      return;
    }
    const Outline outline = outlineOf(block);
    if (outline.offEarth && 8 * block.columns <= grid_.columns && 8 * block.rows <= grid_.rows) return;
    if (outline.cap) {
      const Relation relation = relationOf(*outline.cap, box_);
      if (relation == Relation::Outside || noneCounts(block, *outline.cap)) return;
      if (relation == Relation::Inside && allCount(block, *outline.cap)) {
        eachCell(block, [&](std::uint32_t cell) {
          if (grid_.centers.empty() || counts(grid_, cell)) cells.push_back(cell);
        });
        return;
      }
    }
    Block one = block, other = block;
    if (block.columns >= block.rows) {
      one.columns = block.columns / 2;
      other.column += one.columns, other.columns -= one.columns;
    } else {
      one.rows = block.rows / 2;
      other.row += one.rows, other.rows -= one.rows;
    }
    visit(one);
    visit(other);
  }

  std::vector<std::uint32_t> cells;

 private:
  struct Outline {
    std::optional<Cap> cap;
    bool offEarth = true;
  };

  /// From places along the border of a block: nothing inside is further from its middle.
  Outline outlineOf(const Block& block) const {
    constexpr int kSide = 6;
    Outline outline;
    const GeoPoint center =
        pointIn(grid_, grid_.index(block.column + block.columns / 2, block.row + block.rows / 2), 0.5, 0.5);
    outline.offEarth = !isPlace(center);
    const glm::dvec3 middle = vectorOf(center);
    bool whole = isPlace(center);
    double reach = 0, gap = 0;
    glm::dvec3 before{0};
    for (int step = 0; step <= 4 * kSide; ++step) {
      const GeoPoint place = borderOf(block, step / kSide % 4, step % kSide / static_cast<double>(kSide));
      whole = whole && isPlace(place);
      outline.offEarth = outline.offEarth && !isPlace(place);
      const glm::dvec3 here = vectorOf(place);
      reach = std::max(reach, angleBetween(middle, here));
      if (step > 0) gap = std::max(gap, angleBetween(before, here));
      before = here;
    }
    if (whole) outline.cap = Cap{center, (reach + 0.75 * gap) / kDegree};
    return outline;
  }

  GeoPoint borderOf(const Block& block, int side, double along) const {
    const double x = side == 0 ? along : side == 1 ? 1 : side == 2 ? 1 - along : 0;
    const double y = side == 0 ? 0 : side == 1 ? along : side == 2 ? 1 : 1 - along;
    const double right = x * block.columns, down = y * block.rows;
    const int column = std::min(static_cast<int>(right), block.columns - 1),
              row = std::min(static_cast<int>(down), block.rows - 1);
    return pointIn(grid_, grid_.index(block.column + column, block.row + row), right - column, down - row);
  }

  double towardsPole(const Block& block, const Cap& cap) const {
    return (block.row < latticeRows(grid_) ? 1 : -1) * cap.center.latitudeDegrees;
  }
  bool noneCounts(const Block& block, const Cap& cap) const {
    return !grid_.southCrs.empty() && towardsPole(block, cap) + cap.radiusDegrees < 0;
  }
  bool allCount(const Block& block, const Cap& cap) const {
    return grid_.southCrs.empty() || towardsPole(block, cap) - cap.radiusDegrees > 0;
  }

  template <class Visit>
  void eachCell(const Block& block, const Visit& visit) const {
    for (int row = block.row; row < block.row + block.rows; ++row)
      for (int column = block.column; column < block.column + block.columns; ++column)
        visit(grid_.index(column, row));
  }

  const Grid& grid_;
  const base::GeoBox& box_;
};

/// Blocks to begin with, the same whatever the threads; none lies in both hemispheres.
std::vector<Block> firstBlocks(const Grid& grid) {
  constexpr int kAcross = 8;
  std::vector<Block> blocks;
  const int rows = latticeRows(grid);
  const auto part = [](int count, int i) {
    return static_cast<int>(static_cast<std::int64_t>(count) * i / kAcross);
  };
  for (int first = 0; first + rows <= grid.rows && rows > 0; first += rows)
    for (int i = 0; i < kAcross; ++i)
      for (int k = 0; k < kAcross; ++k) {
        const Block block{part(grid.columns, k), first + part(rows, i),
                          part(grid.columns, k + 1) - part(grid.columns, k),
                          part(rows, i + 1) - part(rows, i)};
        if (block.columns > 0 && block.rows > 0) blocks.push_back(block);
      }
  return blocks;
}

}  // namespace

std::vector<std::uint32_t> cellsTouching(const Grid& grid, const base::GeoBox& box) {
  if (isGeographic(grid)) return geographicCells(grid, box);
  std::vector<std::uint32_t> cells;
  if (!grid.reducedRows.empty()) {
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
      if (cellTouches(grid, cell, box)) cells.push_back(cell);
    return cells;
  }
  const std::vector<Block> blocks = firstBlocks(grid);
  std::vector<std::vector<std::uint32_t>> found(blocks.size());
  base::parallelFor(blocks.size(), [&](std::size_t i) {
    Search search(grid, box);
    search.visit(blocks[i]);
    found[i] = std::move(search.cells);
  });
  for (const auto& part : found) cells.insert(cells.end(), part.begin(), part.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

}  // namespace cloudgen::field
