// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/slab.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr std::size_t kMostAtOnce = std::size_t{1} << 21;

struct Range {
  std::size_t first = 0, last = 0;
  std::size_t length() const { return last - first + 1; }
};

/// A hyperslab with one row and column range, everything else fixed.
class Slab {
 public:
  Slab(const File& file, const Placed& placed, const Slice& slice) : file_(file), placed_(placed) {
    start_.assign(placed.variable->dimensions.size(), 0);
    count_.assign(start_.size(), 1);
    fix(placed.time, slice.time);
    fix(placed.step, slice.step);
    fix(placed.member, slice.member);
    fix(placed.vertical, slice.level);
  }

  void fix(const std::optional<std::size_t>& dimension, std::size_t index) {
    if (dimension) start_[*dimension] = checked(*dimension, index);
  }

  std::vector<double> read(const Range& rows, const Range& columns) {
    const auto spread = [&](const std::optional<std::size_t>& dimension, const Range& range) {
      if (!dimension) return;
      start_[*dimension] = range.first;
      count_[*dimension] = checked(*dimension, range.last) - range.first + 1;
    };
    spread(placed_.y, rows);
    spread(column(), columns);
    return file_.values(*placed_.variable, start_, count_);
  }

  bool rowsFirst() const { return !placed_.y || !column() || *placed_.y < *column(); }

 private:
  std::optional<std::size_t> column() const { return placed_.point ? placed_.point : placed_.x; }

  std::size_t checked(std::size_t dimension, std::size_t index) const {
    if (index >= file_.dimensions()[placed_.variable->dimensions[dimension]].length)
      throw base::InputError(file_.where(*placed_.variable), "is shorter than its coordinates",
                             "give files that belong together");
    return index;
  }

  const File& file_;
  const Placed& placed_;
  std::vector<std::size_t> start_, count_;
};

/// Places by row, so that each row is read once whatever their order.
std::vector<std::size_t> orderByRow(std::span<const Place> places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto byRow = [&](std::size_t a, std::size_t b) { return places[a].row < places[b].row; };
  if (!std::is_sorted(order.begin(), order.end(), byRow)) std::stable_sort(order.begin(), order.end(), byRow);
  return order;
}

std::vector<double> versionAt(Slab& slab, std::span<const Place> places) {
  std::vector<double> values(places.size());
  const std::vector<std::size_t> order = orderByRow(places);
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    Range rows{places[order[first]].row, places[order[first]].row};
    Range columns{places[order[first]].column, places[order[first]].column};
    for (end = first + 1; end < order.size(); ++end) {
      const Place& place = places[order[end]];
      const Range more{std::min(columns.first, place.column), std::max(columns.last, place.column)};
      // Far rows and more than fits at once are read apart.
      if (place.row > rows.last + 16 || (place.row - rows.first + 1) * more.length() > kMostAtOnce) break;
      rows.last = place.row;
      columns = more;
    }
    const std::vector<double> block = slab.read(rows, columns);
    for (std::size_t i = first; i < end; ++i) {
      const std::size_t row = places[order[i]].row - rows.first;
      const std::size_t column = places[order[i]].column - columns.first;
      values[order[i]] =
          block[slab.rowsFirst() ? row * columns.length() + column : column * rows.length() + row];
    }
  }
  return values;
}

}  // namespace

std::vector<double> valuesAt(const File& file, const Placed& placed, const Slice& slice,
                             std::span<const Place> places) {
  if (places.empty()) return {};
  Slab slab(file, placed, slice);
  if (!placed.isHorizontal()) {
    const std::vector<double> one = slab.read({0, 0}, {0, 0});
    return std::vector<double>(places.size(), one.front());
  }
  std::vector<double> values = versionAt(slab, places);
  if (!placed.version) return values;
  const std::size_t versions = file.dimensions()[placed.variable->dimensions[*placed.version]].length;
  for (std::size_t version = 1; version < std::min<std::size_t>(versions, 4); ++version) {
    slab.fix(placed.version, version);
    const std::vector<double> others = versionAt(slab, places);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isnan(values[i])) values[i] = others[i];
  }
  return values;
}

}  // namespace cloudgen::input::netcdf
