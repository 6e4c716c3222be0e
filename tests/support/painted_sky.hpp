// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>
#include <vector>

#include "field/grid.hpp"
#include "scene/scene.hpp"

namespace cloudgen::test {

/// A scene seen from straight above: optical depth along rays through the points of a raster, of the puffs
/// and of the blobs that viewers blend for them. Knows nothing of how the clouds came about.
struct PaintedSky {
  int columns = 0, rows = 0;
  double pixelMeters = 0;
  std::vector<float> opticalDepth, drawn;

  /// Of the clouds of one genus, or of all.
  PaintedSky(const scene::Scene& scene, double pixel, std::optional<base::Genus> genus = {})
      : pixelMeters(pixel), lower_(scene.frame.lowerCorner()) {
    const glm::dvec2 size = scene.frame.upperCorner() - lower_;
    columns = std::max(1, static_cast<int>(size.x / pixel)),
    rows = std::max(1, static_cast<int>(size.y / pixel));
    opticalDepth.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
    drawn = opticalDepth;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      if (genus && scene.clouds[i].genus != *genus) continue;
      const auto& lit = scene.lit[scene.instances[i].lit];
      const scene::Archetype& archetype = scene.archetypes[lit.archetype];
      for (const shape::Puff& puff : archetype.puffs) {
        const shape::Puff placed = scene::placed(scene, scene.instances[i], puff);
        paint(placed, opticalDepth, [depth = shape::frontalOpticalDepth(placed)](double gaussian) {
          return depth * static_cast<float>(gaussian);
        });
        const shape::Puff blob = shape::widenedAcross(placed, archetype.covering);
        paint(blob, drawn, shape::BlendedProfile(shape::frontalOpticalDepth(blob)));
      }
    }
  }

  struct Seen {
    double pixels = 0, covered = 0, opticalDepth = 0;
    double cover() const { return covered / pixels; }
    double meanOpticalDepth() const { return opticalDepth / pixels; }
  };

  /// By cell of the grid; covered is where more than `threshold` is drawn.
  std::map<std::uint32_t, Seen> byCell(const scene::Scene& scene, const field::Grid& grid,
                                       double threshold = 0.1) const {
    std::map<std::uint32_t, Seen> cells;
    const field::CellFinder finder(grid);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const glm::dvec3 place = scene.frame.toGeographic(
            {lower_.x + (column + 0.5) * pixelMeters, 0, lower_.y + (row + 0.5) * pixelMeters});
        if (!scene.frame.box().contains(place.x, place.y)) continue;
        const auto cell = finder.at({place.x, place.y});
        if (!cell) continue;
        Seen& seen = cells[*cell];
        seen.pixels += 1;
        seen.covered += drawn[indexOf(column, row)] > threshold;
        seen.opticalDepth += at(column, row);
      }
    return cells;
  }

  float at(int column, int row) const { return opticalDepth[indexOf(column, row)]; }

 private:
  std::size_t indexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }

  template <class Profile>
  void paint(const shape::Puff& puff, std::vector<float>& onto, Profile profile) {
    const glm::mat3 axes = glm::mat3_cast(puff.rotation);
    double xx = 0, zz = 0, xz = 0;
    for (int k = 0; k < 3; ++k) {
      const double s = puff.sigma[k];
      xx += s * s * axes[k].x * axes[k].x, zz += s * s * axes[k].z * axes[k].z,
          xz += s * s * axes[k].x * axes[k].z;
    }
    const double det = xx * zz - xz * xz;
    const double x = puff.center.x - lower_.x, z = puff.center.z - lower_.y;
    const double reachX = 4 * std::sqrt(xx), reachZ = 4 * std::sqrt(zz);
    const int left = std::max(0, static_cast<int>((x - reachX) / pixelMeters)),
              right = std::min(columns - 1, static_cast<int>((x + reachX) / pixelMeters)),
              top = std::max(0, static_cast<int>((z - reachZ) / pixelMeters)),
              bottom = std::min(rows - 1, static_cast<int>((z + reachZ) / pixelMeters));
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column) {
        const double dx = (column + 0.5) * pixelMeters - x, dz = (row + 0.5) * pixelMeters - z;
        const double q = (zz * dx * dx - 2 * xz * dx * dz + xx * dz * dz) / det;
        onto[indexOf(column, row)] += profile(std::exp(-0.5 * q));
      }
  }

  glm::dvec2 lower_;
};

}  // namespace cloudgen::test
