// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "field/curvilinear.hpp"
#include "field/grid_plane.hpp"
#include "field/sphere.hpp"

namespace cloudgen::field {
namespace {

/// Bins of about the same area in longitude and latitude, each with the cells that may reach into it.
class Bins {
 public:
  explicit Bins(const Grid& grid) {
    const double side = std::sqrt(std::max(1.0, static_cast<double>(grid.size()) / 4));
    bands_ = std::clamp(static_cast<int>(side), 1, 1024);
    corners_.resize(grid.size());
    areas_.resize(grid.size());
    GeoPoint first{0, 0};
    Interval latitudes{90, -90}, longitudes{180, -180};
    bool begun = false;
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
      corners_[cell] = curvilinearCorners(grid, cell);
      if (!present(cell)) continue;
      const GeoPoint center = centerOf(grid, cell);
      if (!begun) first = center;
      begun = true;
      areas_[cell] = reachOf(cell, center, first.longitudeDegrees);
      latitudes = {std::min(latitudes.low, areas_[cell].south), std::max(latitudes.high, areas_[cell].north)};
      longitudes = {std::min(longitudes.low, areas_[cell].west),
                    std::max(longitudes.high, areas_[cell].east)};
    }
    origin_ = first.longitudeDegrees;
    south_ = latitudes.low, north_ = latitudes.high;
    west_ = longitudes.low, east_ = longitudes.high;
    fill();
  }

  std::optional<std::uint32_t> at(const GeoPoint& place) const {
    if (!isPlace(place) || !(north_ > south_)) return std::nullopt;
    const double longitude = base::wrappedLongitude(place.longitudeDegrees - origin_);
    if (place.latitudeDegrees < south_ || place.latitudeDegrees > north_ || longitude < west_ ||
        longitude > east_)
      return std::nullopt;
    const std::size_t bin = binOf(columnOf(longitude), bandOf(place.latitudeDegrees));
    const glm::dvec3 vector = vectorOf(place);
    for (std::uint32_t i = start_[bin]; i < start_[bin + 1]; ++i)
      if (quadHolds(corners_[cells_[i]], vector)) return cells_[i];
    return std::nullopt;
  }

 private:
  /// Degrees; longitudes eastwards of the origin, within [-180, 180]. Where it crosses the far side, all.
  struct Reach {
    double west = 0, south = 0, east = 0, north = 0;
  };

  bool present(std::uint32_t cell) const {
    for (const glm::dvec3& corner : corners_[cell])
      if (!std::isfinite(corner.x)) return false;
    return true;
  }

  Reach reachOf(std::uint32_t cell, const GeoPoint& center, double origin) const {
    double angle = 0;
    const glm::dvec3 middle = vectorOf(center);
    for (const glm::dvec3& corner : corners_[cell]) angle = std::max(angle, angleBetween(middle, corner));
    const double latitude = center.latitudeDegrees * kDegree;
    Reach reach;
    reach.south = std::max(-90.0, center.latitudeDegrees - angle / kDegree);
    reach.north = std::min(90.0, center.latitudeDegrees + angle / kDegree);
    const bool pole = std::abs(latitude) + angle >= 0.5 * std::numbers::pi;
    const double half = pole ? 180 : std::asin(std::min(1.0, std::sin(angle) / std::cos(latitude))) / kDegree;
    const double longitude = base::wrappedLongitude(center.longitudeDegrees - origin);
    reach.west = longitude - half, reach.east = longitude + half;
    if (reach.west < -180 || reach.east > 180) reach.west = -180, reach.east = 180;
    return reach;
  }

  int bandOf(double latitude) const {
    return std::clamp(static_cast<int>((latitude - south_) / (north_ - south_) * bands_), 0, bands_ - 1);
  }
  int columnOf(double longitude) const {
    return std::clamp(static_cast<int>((longitude - west_) / (east_ - west_) * bands_), 0, bands_ - 1);
  }
  std::size_t binOf(int column, int band) const {
    return static_cast<std::size_t>(band) * static_cast<std::size_t>(bands_) +
           static_cast<std::size_t>(column);
  }

  template <class Visit>
  void eachBinOf(std::uint32_t cell, const Visit& visit) const {
    if (!present(cell)) return;
    const Reach& reach = areas_[cell];
    for (int band = bandOf(reach.south); band <= bandOf(reach.north); ++band)
      for (int column = columnOf(reach.west); column <= columnOf(reach.east); ++column)
        visit(binOf(column, band));
  }

  void fill() {
    start_.assign(static_cast<std::size_t>(bands_) * static_cast<std::size_t>(bands_) + 1, 0);
    for (std::uint32_t cell = 0; cell < corners_.size(); ++cell)
      eachBinOf(cell, [&](std::size_t bin) { ++start_[bin + 1]; });
    for (std::size_t bin = 1; bin < start_.size(); ++bin) start_[bin] += start_[bin - 1];
    cells_.resize(start_.back());
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    for (std::uint32_t cell = 0; cell < corners_.size(); ++cell)
      eachBinOf(cell, [&](std::size_t bin) { cells_[next[bin]++] = cell; });
    areas_ = {};
  }

  int bands_ = 1;
  double origin_ = 0, west_ = 0, east_ = 0, south_ = 0, north_ = 0;
  std::vector<std::array<glm::dvec3, 4>> corners_;
  std::vector<Reach> areas_;
  std::vector<std::uint32_t> start_, cells_;
};

}  // namespace

struct CellFinder::Search {
  Grid lattice;
  std::optional<Bins> bins;
};

CellFinder::CellFinder(const Grid& grid) : search_(std::make_unique<Search>()) {
  if (grid.centers.empty())
    search_->lattice = grid;
  else
    search_->bins.emplace(grid);
}

CellFinder::~CellFinder() = default;

std::optional<std::uint32_t> CellFinder::at(const GeoPoint& place) const {
  return search_->bins ? search_->bins->at(place) : latticeCell(search_->lattice, place);
}

}  // namespace cloudgen::field
