// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/ground.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <set>

#include "light/color.hpp"
#include "light/relief.hpp"

namespace cloudgen::writer {
namespace {

/// Cells along a side of the box where there is no terrain: as many as shadows of clouds need to be seen.
constexpr int kGroundCells = 48;

/// The ground's colours, fading into the haze away from the middle of the stage.
class Haze {
 public:
  Haze(const scene::Scene& scene, const Stage& stage)
      : sky_(scene.sky), middle_(0.5f * (stage.lower + stage.upper)), reach_(2 * stage.extent) {}

  void append(std::vector<float>& out, const glm::vec3& linear, double x, double z) const {
    const double u = (x - middle_.x) / reach_, v = (z - middle_.z) / reach_;
    const float haze = glm::smoothstep(0.3f, 1.0f, static_cast<float>(std::hypot(u, v)));
    const glm::vec3 color = light::srgbFromLinear(glm::mix(linear, sky_.horizon, haze));
    out.insert(out.end(), {color.r, color.g, color.b});
  }

 private:
  light::Sky sky_;
  glm::vec3 middle_;
  float reach_;
};

/// Even lines about the middle, and the edges of the hole for the scene's box.
std::vector<float> linesAlong(float middle, float reach, float low, float high) {
  constexpr int kCells = 24;
  std::set<float> lines;
  for (int i = 0; i <= kCells; ++i) {
    const float line = middle + reach * (2.0f * static_cast<float>(i) / kCells - 1);
    if (line < low || line > high) lines.insert(line);
  }
  lines.insert({low, high});
  return {lines.begin(), lines.end()};
}

/// No ElevationGrid: X3DOM's package does not know it.
void writeFaces(NodeWriter& nodes, const char* def, const std::vector<std::int32_t>& indices,
                const std::vector<float>& colors, const std::vector<float>& points, int decimals) {
  nodes.open("Shape", "children", def);
  nodes.open("IndexedFaceSet", "geometry");
  nodes.integers("coordIndex", indices);
  nodes.boolean("solid", false);
  nodes.open("Color", "color");
  nodes.numbers("color", colors, 3, 3);
  nodes.close();
  nodes.open("Coordinate", "coord");
  nodes.numbers("point", points, 3, decimals);
  nodes.close();
  nodes.close();
  nodes.close();
}

/// The ground around the scene's box.
void writeSurroundings(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage,
                       const base::HeightField& box) {
  const glm::vec3 middle = 0.5f * (stage.lower + stage.upper);
  const glm::vec2 low(box.origin), high(box.origin + glm::dvec2(box.columns - 1, box.rows - 1) * box.step);
  const auto xs = linesAlong(middle.x, 2 * stage.extent, low.x, high.x);
  const auto zs = linesAlong(middle.z, 2 * stage.extent, low.y, high.y);
  const Haze haze(scene, stage);
  std::vector<float> points, colors;
  std::vector<std::int32_t> indices;
  const auto columns = static_cast<int>(xs.size()), rows = static_cast<int>(zs.size());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const float x = xs[static_cast<std::size_t>(column)], z = zs[static_cast<std::size_t>(row)];
      points.insert(points.end(), {x, scene.groundHeightMeters, z});
      haze.append(colors, scene.sky.ground, x, z);
      if (row + 1 == rows || column + 1 == columns) continue;
      const bool inHole = x >= low.x && x < high.x && z >= low.y && z < high.y;
      const int corner = row * columns + column;
      if (!inHole)
        indices.insert(indices.end(), {corner, corner + columns, corner + columns + 1, corner + 1, -1});
    }
  writeFaces(nodes, "Ground", indices, colors, points, 0);
}

/// The ground of the box, with relief and the shadows of the clouds in its colours.
void writeTerrain(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage,
                  const base::HeightField& terrain) {
  const Haze haze(scene, stage);
  std::vector<float> points, colors;
  std::vector<std::int32_t> indices;
  for (int row = 0; row < terrain.rows; ++row)
    for (int column = 0; column < terrain.columns; ++column) {
      const glm::dvec3 point = terrain.point(column, row);
      points.insert(points.end(), {static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)});
      haze.append(colors, light::shadedReliefColor(terrain, column, row, scene.sun, scene.sky, scene.shadows),
                  point.x, point.z);
      if (row + 1 == terrain.rows || column + 1 == terrain.columns) continue;
      const int corner = row * terrain.columns + column, below = corner + terrain.columns;
      indices.insert(indices.end(), {corner, below, below + 1, corner + 1, -1});
    }
  writeFaces(nodes, "Terrain", indices, colors, points, 1);
}

}  // namespace

void writeGround(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage) {
  const base::HeightField box =
      scene.terrain.empty() ? scene::flatGround(scene, kGroundCells) : scene.terrain;
  writeSurroundings(nodes, scene, stage, box);
  writeTerrain(nodes, scene, stage, box);
}

}  // namespace cloudgen::writer
