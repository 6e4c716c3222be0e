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

/// A scene seen from straight above: optical depth along rays through the points of a raster. Knows nothing
/// of how the clouds came about.
struct PaintedSky {
  int columns = 0, rows = 0;
  double pixelMeters = 0;
  std::vector<float> opticalDepth;

  /// Of the clouds of one genus, or of all.
  PaintedSky(const scene::Scene& scene, double pixel, std::optional<base::Genus> genus = {})
      : pixelMeters(pixel), lower_(scene.frame.lowerCorner()) {
    const glm::dvec2 size = scene.frame.upperCorner() - lower_;
    columns = std::max(1, static_cast<int>(size.x / pixel)),
    rows = std::max(1, static_cast<int>(size.y / pixel));
    opticalDepth.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      if (genus && scene.clouds[i].genus != *genus) continue;
      const auto& lit = scene.lit[scene.instances[i].lit];
      for (const shape::Puff& puff : scene.archetypes[lit.archetype].puffs)
        paint(scene::placed(scene, scene.instances[i], puff));
    }
  }

  struct Seen {
    double pixels = 0, covered = 0, opticalDepth = 0;
    double cover() const { return covered / pixels; }
    double meanOpticalDepth() const { return opticalDepth / pixels; }
  };

  /// By cell of the grid; covered is what has more than `threshold`.
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
        const float depth = at(column, row);
        seen.pixels += 1;
        seen.covered += depth > threshold;
        seen.opticalDepth += depth;
      }
    return cells;
  }

  float at(int column, int row) const {
    return opticalDepth[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(column)];
  }

 private:
  void paint(const shape::Puff& puff) {
    const glm::mat3 axes = glm::mat3_cast(puff.rotation);
    double xx = 0, zz = 0, xz = 0;
    for (int k = 0; k < 3; ++k) {
      const double s = puff.sigma[k];
      xx += s * s * axes[k].x * axes[k].x, zz += s * s * axes[k].z * axes[k].z,
          xz += s * s * axes[k].x * axes[k].z;
    }
    const double det = xx * zz - xz * xz;
    const double peak = shape::extinctionArea(puff) / (2 * std::numbers::pi * std::sqrt(det));
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
        opticalDepth[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)] += static_cast<float>(peak * std::exp(-0.5 * q));
      }
  }

  glm::dvec2 lower_;
};

}  // namespace cloudgen::test
