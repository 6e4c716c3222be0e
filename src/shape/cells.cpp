// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "base/noise.hpp"
#include "shape/forms.hpp"

namespace cloudgen::shape {
namespace {

struct Cell {
  double x = 0, z = 0;
  double gap = 0;     ///< to its neighbours: 0 none, 1 nothing is left of it
  double height = 0;  ///< of its top in the middle, metres
  double weight = 0;  ///< 0: no cloud here
  bool turret = false;
};

/// A piece of a layer that overturns: cells round places on a jittered lattice, each as far as no other
/// place is nearer (Voronoi), with lanes of sinking clear air between them.
class CellLayer {
 public:
  CellLayer(const Recipe& recipe, const ShapeRequest& request, int across, base::RandomStream& stream)
      : across_(across),
        pitch_(request.widthMeters / across),
        stretch_((1.0 + 0.8 * recipe.fibre) / (1.0 + 0.8 * recipe.waves)),
        rolls_(recipe.genus == base::Genus::Stratocumulus ? recipe.waves : 0),
        seed_(request.seed * 31 + request.variant) {
    for (int row = -kRim; row < across + kRim; ++row)
      for (int column = -kRim; column < across + kRim; ++column)
        cells_.push_back(cellAt(row, column, recipe, request, stream));
    // However few the cells, there is cloud.
    if (std::ranges::any_of(cells_, [](const Cell& cell) { return cell.weight > 0; })) return;
    const auto fromMiddle = [](const Cell& cell) { return std::hypot(cell.x, cell.z); };
    std::ranges::min_element(cells_, {}, fromMiddle)->weight = 1;
  }

  const std::vector<Cell>& cells() const { return cells_; }
  double pitchMeters() const { return pitch_; }
  double stretch() const { return stretch_; }
  std::uint64_t seed() const { return seed_; }

  /// How far inside a cell a point is: 1 in its middle, 0 at the border to the next; below 0 in another's.
  double insideOf(std::size_t index, double x, double z) const {
    // Borders are ragged at all scales below that of a cell.
    const double bend = 0.3 * pitch_, scale = 1.6 / pitch_;
    x += bend * base::fractalNoise({x * scale, 5.1, z * scale}, 3, seed_ + 11);
    z += bend * base::fractalNoise({x * scale, 9.7, z * scale}, 3, seed_ + 12);
    const int side = across_ + 2 * kRim;
    const int row = static_cast<int>(index) / side, column = static_cast<int>(index) % side;
    double nearest = 1e30;
    for (int i = std::max(0, row - 2); i <= std::min(side - 1, row + 2); ++i)
      for (int k = std::max(0, column - 2); k <= std::min(side - 1, column + 2); ++k)
        if (i != row || k != column) {
          const double joined = k == column ? 1.0 + kJoining * rolls_ : 1.0;
          nearest = std::min(nearest, joined * distance(cells_[static_cast<std::size_t>(i * side + k)], x, z));
        }
    return (nearest - distance(cells_[index], x, z)) / pitch_;
  }

 private:
  static constexpr int kRim = 1;
  static constexpr double kJoining = 0.8;  ///< how much further away its neighbour in a roll seems to a cell

  double distance(const Cell& cell, double x, double z) const {
    return std::hypot((x - cell.x) / stretch_, (z - cell.z) * stretch_);
  }

  Cell cellAt(int row, int column, const Recipe& recipe, const ShapeRequest& request,
              base::RandomStream& stream) {
    const double half = 0.5 * request.widthMeters;
    const double order = 1.0 - 0.75 * recipe.waves;
    Cell cell;
    cell.x = (column + 0.5) * pitch_ - half + 0.34 * order * pitch_ * stream.gaussian();
    cell.z = (row + 0.5 + (column & 1 ? 0.5 : 0.0)) * pitch_ - half + 0.3 * pitch_ * stream.gaussian();
    // Rows meander, so that they do not look ruled.
    cell.x +=
        0.9 * pitch_ * base::fractalNoise({cell.x / (7.0 * pitch_), 0.3, cell.z / (5.0 * pitch_)}, 2, seed_);
    const double ragged =
        base::fractalNoise({cell.x / (4.5 * pitch_), 1.7, cell.z / (4.5 * pitch_)}, 3, seed_ + 5);
    const double q = std::hypot(cell.x, cell.z) / half;
    const double fade = 1.0 - base::smoothStep(0.72, 1.08, q + 0.55 * ragged);
    const double vigour = stream.uniform(0.6, 1.2) * (1.0 + 0.9 * ragged);
    cell.turret = stream.uniform() < recipe.turrets;
    const bool clear = fade < 0.04 || vigour * fade < 0.3;
    cell.weight = clear ? 0 : fade;
    cell.gap = std::clamp(
        1.0 - 2.0 * recipe.sectionRadius * std::clamp(vigour, 0.6, 1.2) * (0.7 + 0.3 * fade), 0.03, 0.75);
    const double full = recipe.turrets > 0 && !cell.turret ? 0.5 : 1.0;
    cell.height = full * request.depthMeters * std::clamp(0.4 + 0.6 * vigour, 0.3, 1.0);
    return cell;
  }

  int across_;
  double pitch_, stretch_;
  double rolls_;  ///< 0 cells apart .. 1 joined across the wind, as the large ones of stratocumulus are
  std::uint64_t seed_;
  std::vector<Cell> cells_;
};

int cellsAcross(const Recipe& recipe, const ShapeRequest& request) {
  const int affordable = std::max(3, static_cast<int>(std::sqrt(request.puffs / 4.0)));
  // A smaller piece of the layer has fewer elements, not narrower ones.
  constexpr double kUsualAspect = 22;
  const double share = std::min(1.0, request.widthMeters / (kUsualAspect * request.depthMeters));
  return std::min(std::max(2, static_cast<int>(std::lround(recipe.sections * share))), affordable);
}

/// A puff of a cell: in a lens with a lumpy top over a nearly level base.
Puff puffIn(const CellLayer& layer, std::size_t index, const Recipe& recipe, const ShapeRequest& request,
            double sigma, base::RandomStream& stream) {
  const Cell& cell = layer.cells()[index];
  const double pitch = layer.pitchMeters(), stretch = layer.stretch();
  const double widest = 0.8 * pitch * (1.0 - 0.6 * cell.gap);
  double x = cell.x, z = cell.z, inside = 1;
  for (int attempt = 0; attempt < 10; ++attempt) {
    // By the recipe's system; what falls into a lane or another cell is drawn anew.
    const glm::dvec3 p = place(recipe.billboardPlacement, 1, stream).front();
    const double atX = cell.x + p.x * widest * stretch, atZ = cell.z + p.z * widest / stretch;
    const double within = layer.insideOf(index, atX, atZ);
    if (within < cell.gap + 0.5 * sigma / pitch) continue;
    x = atX, z = atZ, inside = within;
    break;
  }
  const double dome = std::sqrt(base::smoothStep(0.3 * cell.gap, 0.7, inside));
  const double lump = base::billowNoise({x * 3.0 / pitch, 0.7, z * 3.0 / pitch}, 3, layer.seed() + 9) - 0.72;
  const double level = stream.uniform() < 0.35 ? stream.uniform(0.8, 1.0) : stream.uniform();
  // Rounded below, too: the rims hang higher than the middle.
  const double low = request.depthMeters * (0.05 + 0.25 * (1.0 - dome) - 0.3 * std::min(0.0, lump));
  const double top = std::max(cell.height * (0.3 + 0.6 * dome + 0.6 * lump * dome), low + 0.1 * cell.height);
  Puff puff;
  const double size = sigma * stream.uniform(0.75, 1.25) * (0.7 + 0.3 * level);
  double y = std::max(low, low + (top - low) * level);
  // Seen from below none may stand out as a disc: they are broad and thin there, and none lies flat on the base.
  const double broad = 1.0 + 0.9 * (1.0 - base::smoothStep(0.0, 0.45, level)) * (1.0 - recipe.turrets);
  const double sigmaY = std::min(size * recipe.flattening, 0.25 * cell.height);
  y = std::min(std::max(y, 1.1 * sigmaY), request.depthMeters - 0.8 * sigmaY);
  const double narrower = cell.turret ? 1.0 - 0.65 * y / cell.height : 1.0;
  puff.center = glm::dvec3(cell.x + (x - cell.x) * narrower, y, cell.z + (z - cell.z) * narrower);
  const double across = size * std::sqrt(narrower);
  puff.sigma = glm::vec3(broad * across * stretch, sigmaY, broad * across / stretch);
  puff.extinctionPerMeter = static_cast<float>(cell.weight * (0.25 + 0.9 * dome) / (broad * broad) *
                                               std::clamp(1.0 + recipe.raggedness * 2.0 * lump, 0.2, 1.6));
  puff.section = static_cast<std::uint16_t>(index);
  return puff;
}

}  // namespace

RawShape shapeCells(const Recipe& recipe, const ShapeRequest& request) {
  base::RandomStream places(request.seed, request.variant, base::Purpose::SectionPlace);
  base::RandomStream fills(request.seed, request.variant, base::Purpose::BillboardPlace);
  const CellLayer layer(recipe, request, cellsAcross(recipe, request), places);
  const double pitch = layer.pitchMeters();
  const auto areaOf = [&](const Cell& cell) {
    return cell.weight > 0 ? std::pow(pitch * (1.0 - cell.gap), 2.0) : 0.0;
  };
  double totalArea = 0;
  for (const Cell& cell : layer.cells()) totalArea += areaOf(cell);
  RawShape shape;
  double owed = 0;
  for (std::size_t index = 0; index < layer.cells().size(); ++index) {
    const double area = areaOf(layer.cells()[index]);
    if (area <= 0) continue;
    owed += request.puffs * area / totalArea;
    const int share = std::max(1, static_cast<int>(owed));
    owed -= share;
    const double sigma =
        std::min(0.75 * recipe.billboardSize * std::sqrt(area), 0.7 * std::sqrt(area / share));
    for (int i = 0; i < share; ++i)
      shape.puffs.push_back(puffIn(layer, index, recipe, request, sigma, fills));
  }
  return shape;
}

}  // namespace cloudgen::shape
