// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <queue>

#include "shape/axes.hpp"
#include "shape/file_shape.hpp"

namespace cloudgen::shape {
namespace {

constexpr int kMostPuffs = 6000;

struct Cell {
  glm::dvec3 center;
  double mass;
};

/// A part of the volume: a puff once it is no longer divided.
struct Part {
  std::size_t first = 0, last = 0;  ///< its cells
  double mass = 0;
  glm::dvec3 mean{0};
  glm::dmat3 covariance{0};
};

/// Optical depth along an axis on a raster over the other two, of mean 1.
class Shadow {
 public:
  struct View {
    int across, up;  ///< the axes of the raster
  };
  static constexpr std::array<View, 3> kViews{{{0, 2}, {2, 1}, {0, 1}}};  ///< from above, along x, along z

  /// The raster reaches beyond the box by a tenth of it on each side: puffs may be there, but no cloud.
  Shadow(const View& view, const glm::dvec3& lower, const glm::dvec3& size)
      : view_(view), lower_(lower), size_(size), values_(kRaster * kRaster, 0) {}

  /// Spreads the mass of a box over the pixels that it lies on.
  void addBox(const glm::dvec3& center, const glm::dvec3& edges, double mass) {
    const glm::dvec3 lower = center - 0.5 * edges, upper = center + 0.5 * edges;
    const auto share = [&](int pixel, int axis) {
      const double half = 0.6 / kRaster * size_[axis], middle = placeOf(pixel, axis);
      return std::max(0.0, std::min(upper[axis], middle + half) - std::max(lower[axis], middle - half)) /
             edges[axis];
    };
    for (int row = pixelOf(lower, view_.up); row <= pixelOf(upper, view_.up); ++row)
      for (int column = pixelOf(lower, view_.across); column <= pixelOf(upper, view_.across); ++column)
        values_[indexOf(column, row)] += mass * share(column, view_.across) * share(row, view_.up);
  }

  void addPuff(const Puff& puff) {
    const glm::dmat3 axes = glm::mat3_cast(glm::dquat(puff.rotation));
    glm::dmat3 covariance(0);
    for (int k = 0; k < 3; ++k)
      covariance += glm::outerProduct(axes[k], axes[k]) * static_cast<double>(puff.sigma[k] * puff.sigma[k]);
    const double a = covariance[view_.across][view_.across], b = covariance[view_.across][view_.up],
                 c = covariance[view_.up][view_.up], determinant = std::max(a * c - b * b, 1e-30),
                 peak = extinctionArea(puff) / std::sqrt(determinant);
    const glm::dvec3 center(puff.center);
    glm::dvec3 reach(0);
    reach[view_.across] = 4 * std::sqrt(a), reach[view_.up] = 4 * std::sqrt(c);
    for (int row = pixelOf(center - reach, view_.up); row <= pixelOf(center + reach, view_.up); ++row)
      for (int column = pixelOf(center - reach, view_.across);
           column <= pixelOf(center + reach, view_.across); ++column) {
        const double dx = placeOf(column, view_.across) - center[view_.across],
                     dy = placeOf(row, view_.up) - center[view_.up];
        values_[indexOf(column, row)] +=
            peak * std::exp(-0.5 * (c * dx * dx - 2 * b * dx * dy + a * dy * dy) / determinant);
      }
  }

  /// Root of the mean square of the difference, as a share of that of `should`; both scaled to one mean.
  double errorAgainst(const Shadow& should) const {
    double own = 0, other = 0, square = 0, whole = 0;
    for (const double value : values_) own += value;
    for (const double value : should.values_) other += value;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      square += std::pow(values_[i] / own - should.values_[i] / other, 2);
      whole += std::pow(should.values_[i] / other, 2);
    }
    return std::sqrt(square / whole);
  }

 private:
  static constexpr int kRaster = 40;
  static std::size_t indexOf(int column, int row) { return static_cast<std::size_t>(row * kRaster + column); }
  int pixelOf(const glm::dvec3& place, int axis) const {
    const double share = (place[axis] - lower_[axis]) / size_[axis];
    return static_cast<int>(std::clamp((share + 0.1) / 1.2 * kRaster, 0.0, kRaster - 1.0));
  }
  double placeOf(int pixel, int axis) const {
    return lower_[axis] + ((pixel + 0.5) / kRaster * 1.2 - 0.1) * size_[axis];
  }

  View view_;
  glm::dvec3 lower_, size_;
  std::vector<double> values_;
};

/// The volume divided again and again, always where most is gained: part 0 is all of it; the i-th division is
/// of part order[i] and makes parts 2i + 1 and 2i + 2.
struct Division {
  glm::dvec3 size{0};  ///< of the cloudy box
  std::vector<Part> parts;
  std::vector<std::size_t> order;
  std::vector<Shadow> shadows;  ///< of the volume itself, one a view
  double wider = 1;             ///< of puffs than their parts, so that they are even where the volume is
};

Part partOf(const std::vector<Cell>& cells, std::size_t first, std::size_t last, const glm::dvec3& spacing) {
  Part part{first, last};
  for (std::size_t i = first; i < last; ++i) {
    part.mass += cells[i].mass;
    part.mean += cells[i].mass * cells[i].center;
  }
  part.mean /= part.mass;
  for (std::size_t i = first; i < last; ++i) {
    const glm::dvec3 away = cells[i].center - part.mean;
    part.covariance += cells[i].mass / part.mass * glm::outerProduct(away, away);
  }
  // A cell's own: somewhat more than that of a box (a twelfth), so that parts of one cell overlap.
  for (int axis = 0; axis < 3; ++axis) part.covariance[axis][axis] += spacing[axis] * spacing[axis] / 5;
  return part;
}

/// Cells with less than a thousandth of the densest are no cloud.
std::vector<Cell> cloudyCells(const base::Volume& volume, Division& division) {
  const float densest = *std::max_element(volume.extinction.begin(), volume.extinction.end());
  std::vector<Cell> cells;
  glm::dvec3 lower(1e300), upper(-1e300);
  for (int z = 0; z < volume.size.z; ++z)
    for (int y = 0; y < volume.size.y; ++y)
      for (int x = 0; x < volume.size.x; ++x) {
        const float extinction = volume.extinction[volume.at({x, y, z})];
        if (!(extinction > 1e-3f * densest)) continue;
        const glm::dvec3 corner = glm::dvec3(x, y, z) * volume.spacing;
        lower = glm::min(lower, corner), upper = glm::max(upper, corner + volume.spacing);
        cells.push_back({corner + 0.5 * volume.spacing, extinction});
      }
  division.size = upper - lower;
  const glm::dvec3 foot(0.5 * (lower.x + upper.x), lower.y, 0.5 * (lower.z + upper.z));
  for (Cell& cell : cells) cell.center -= foot;
  return cells;
}

std::vector<Shadow> shadowsOf(const std::vector<Cell>& cells, const Division& division,
                              const glm::dvec3& spacing) {
  std::vector<Shadow> shadows;
  const glm::dvec3 lower(-0.5 * division.size.x, 0, -0.5 * division.size.z);
  for (const Shadow::View& view : Shadow::kViews) {
    Shadow& shadow = shadows.emplace_back(view, lower, division.size);
    for (const Cell& cell : cells) shadow.addBox(cell.center, spacing, cell.mass);
  }
  return shadows;
}

Division divided(const base::Volume& volume) {
  Division division;
  std::vector<Cell> cells = cloudyCells(volume, division);
  division.shadows = shadowsOf(cells, division, volume.spacing);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry> worst;
  const auto add = [&](std::size_t first, std::size_t last) {
    division.parts.push_back(partOf(cells, first, last, volume.spacing));
    const Part& part = division.parts.back();
    if (last - first > 1)
      worst.emplace(part.mass * principalAxes(part.covariance).variance.x, division.parts.size() - 1);
  };
  add(0, cells.size());
  while (!worst.empty() && division.order.size() + 1 < kMostPuffs) {
    const std::size_t index = worst.top().second;
    worst.pop();
    const Part part = division.parts[index];
    const glm::dvec3 along = principalAxes(part.covariance).axes[0];
    const auto begin = cells.begin();
    std::sort(
        begin + static_cast<std::ptrdiff_t>(part.first), begin + static_cast<std::ptrdiff_t>(part.last),
        [&](const Cell& a, const Cell& b) { return glm::dot(a.center, along) < glm::dot(b.center, along); });
    std::size_t middle = part.first + 1;
    for (double mass = cells[part.first].mass; middle + 1 < part.last && mass < 0.5 * part.mass; ++middle)
      mass += cells[middle].mass;
    division.order.push_back(index);
    add(part.first, middle);
    add(middle, part.last);
  }
  return division;
}

/// Puffs of the moments of `count` parts, or of all there are.
std::vector<Puff> puffsOf(const Division& division, int count, const glm::dvec3& scale) {
  const std::size_t divisions =
      std::min(division.order.size(), static_cast<std::size_t>(std::max(1, count) - 1));
  std::vector<bool> isDivided(2 * divisions + 1, false);
  for (std::size_t i = 0; i < divisions; ++i) isDivided[division.order[i]] = true;
  const glm::dmat3 stretch(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0), glm::dvec3(0, 0, scale.z));
  std::vector<Puff> puffs;
  for (std::size_t i = 0; i < isDivided.size(); ++i) {
    if (isDivided[i]) continue;
    const Part& part = division.parts[i];
    const PrincipalAxes axes = principalAxes(stretch * part.covariance * stretch);
    Puff puff;
    puff.center = part.mean * scale;
    puff.sigma = glm::sqrt(axes.variance) * division.wider;
    puff.rotation = glm::quat(glm::normalize(glm::quat_cast(axes.axes)));
    puff.extinctionPerMeter = 1;
    puff.extinctionPerMeter = static_cast<float>(part.mass / extinctionArea(puff));
    puffs.push_back(puff);
  }
  return puffs;
}

glm::dvec3 scaleTo(const Division& division, double widthMeters, double depthMeters) {
  const double across = widthMeters / std::sqrt(division.size.x * division.size.z);
  return {across, depthMeters / division.size.y, across};
}

/// The error of optical depth in each view of puffs that stand for the volume, wherever they stand.
std::array<double, 3> errorsOf(const Division& division, std::span<const Puff> puffs,
                               const glm::dvec3& scale) {
  glm::dvec3 centroid(0);
  double whole = 0;
  for (const Puff& puff : puffs) {
    centroid += extinctionArea(puff) * glm::dvec3(puff.center);
    whole += extinctionArea(puff);
  }
  centroid /= whole;
  const glm::dvec3 size = division.size * scale, aside = centroid - division.parts.front().mean * scale,
                   lower(aside.x - 0.5 * size.x, 0, aside.z - 0.5 * size.z);
  std::array<double, 3> errors{};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    Shadow shadow(Shadow::kViews[i], lower, size);
    for (const Puff& puff : puffs) shadow.addPuff(puff);
    errors[i] = shadow.errorAgainst(division.shadows[i]);
  }
  return errors;
}

/// Moments alone make puffs that leave gaps between them.
void chooseWidth(Division& division) {
  constexpr int kPuffs = 300;
  double least = 1e300, best = 1;
  for (const double wider : {1.0, 1.1, 1.2, 1.3, 1.4}) {
    division.wider = wider;
    const auto errors = errorsOf(division, puffsOf(division, kPuffs, glm::dvec3(1)), glm::dvec3(1));
    const double sum = errors[0] + errors[1] + errors[2];
    if (sum < least) least = sum, best = wider;
  }
  division.wider = best;
}

}  // namespace

FileShape shapeFromVolume(const base::Volume& volume) {
  const auto division = std::make_shared<Division>(divided(volume));
  chooseWidth(*division);
  FileShape shape;
  shape.kind = "volume";
  shape.widthOverDepth = std::sqrt(division->size.x * division->size.z) / division->size.y;
  shape.shape = [division](const Recipe&, const ShapeRequest& request) {
    return RawShape{
        puffsOf(*division, request.puffs, scaleTo(*division, request.widthMeters, request.depthMeters)), {}};
  };
  shape.opticalDepthErrors = [division](std::span<const Puff> puffs, double widthMeters, double depthMeters) {
    return errorsOf(*division, puffs, scaleTo(*division, widthMeters, depthMeters));
  };
  return shape;
}

}  // namespace cloudgen::shape
