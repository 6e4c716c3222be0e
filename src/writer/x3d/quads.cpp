// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/quads.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <numeric>

#include "light/color.hpp"

namespace cloudgen::writer {
namespace {

/// Quads are wider than their puffs, or what a sprite's border cuts off would be missing from the cover.
constexpr float kWidening = 1.12f;
constexpr float kFaintest = 0.005f;     ///< opacity below which a quad is left out
constexpr float kSmallestPlane = 0.7f;  ///< area of a plane, to the largest, below which it is left out
/// Opacity of upright planes: edge-on, from above, they show as needles.
constexpr float kUprightShare = 0.7f;

/// How much wider than its puff a quad is.
float wideningOf(float opticalDepth, float covering) {
  return std::max(kWidening, shape::blendedWidening(opticalDepth, covering));
}

/// Of a quad that is so much wider than a puff of an optical depth through its centre.
float opticalDepthOfQuad(float opticalDepth, float widening) {
  return opticalDepth / (image::kWithinSprite * widening * widening);
}

glm::vec4 colorOf(const LitPuff& lit, float opticalDepth) {
  return glm::vec4(light::srgbFromLinear(lit.color), -std::expm1(-opticalDepth));
}

glm::mat3 covariance(const shape::Puff& puff) {
  const glm::mat3 axes = glm::mat3_cast(puff.rotation);
  glm::mat3 scaled(0);
  for (int i = 0; i < 3; ++i) scaled[i] = axes[i] * (puff.sigma[i] * puff.sigma[i]);
  return scaled * glm::transpose(axes);
}

/// Half-axes, one standard deviation long, of the ellipse that a puff shows to a viewer on the z axis; the
/// first is the one nearer to the x axis, so that sprites stay upright.
std::array<glm::vec3, 2> shownAxes(const shape::Puff& puff) {
  const glm::mat3 c = covariance(puff);
  const float xx = c[0][0], yy = c[1][1], xy = c[1][0];
  const float middle = 0.5f * (xx + yy), reach = std::hypot(0.5f * (xx - yy), xy);
  if (reach < 0.02f * middle) return {glm::vec3(std::sqrt(xx), 0, 0), glm::vec3(0, std::sqrt(yy), 0)};
  // The half-angle form of the principal direction; within 45 degrees of the x axis by the choice of the
  // root.
  float angle = 0.5f * std::atan2(2 * xy, xx - yy), first = middle + reach, second = middle - reach;
  const float quarter = std::numbers::pi_v<float> / 4;
  if (std::abs(angle) > quarter) {
    angle -= std::copysign(2 * quarter, angle);
    std::swap(first, second);
  }
  const float cosine = std::cos(angle), sine = std::sin(angle);
  return {std::sqrt(first) * glm::vec3(cosine, sine, 0),
          std::sqrt(std::max(second, 0.0f)) * glm::vec3(-sine, cosine, 0)};
}

constexpr int kSides = 6, kLevelSides = 4;
/// The side of the box that a direction points to most: 0..5 = +z -z +x -x +y -y.
int sideOf(const glm::vec3& normal) {
  const glm::vec3 size = glm::abs(normal);
  const int axis = size.y >= size.x && size.y >= size.z ? 1 : size.x > size.z ? 0 : 2;
  constexpr std::array<int, 3> kOrder{2, 4, 0};
  return kOrder[static_cast<size_t>(axis)] + (normal[axis] < 0 ? 1 : 0);
}

}  // namespace

QuadMesh facingQuads(const std::vector<LitPuff>& puffs, const glm::vec3& origin,
                     const image::SpriteAtlas& atlas) {
  std::vector<size_t> order(puffs.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return puffs[a].puff.center.z < puffs[b].puff.center.z; });
  QuadMesh mesh;
  for (const size_t i : order) {
    const shape::Puff& puff = puffs[i].puff;
    const auto axes = shownAxes(puff);
    // The quad turns: it shows the same from all sides, and from all sides all of the puff.
    const double area = 2 * std::numbers::pi * glm::length(axes[0]) * glm::length(axes[1]);
    const auto opticalDepth = static_cast<float>(shape::extinctionArea(puff) / std::max(area, 1e-6));
    const float widening = wideningOf(opticalDepth, puffs[i].covering), reach = widening * image::kSpriteReach;
    const float drawnDepth = opticalDepthOfQuad(opticalDepth, widening);
    const glm::vec4 color = colorOf(puffs[i], drawnDepth);
    if (color.a < kFaintest) continue;
    mesh.faces.push_back(static_cast<std::uint32_t>(2 * mesh.quads.size()));
    mesh.quads.push_back({puff.center - origin, reach * axes[0], reach * axes[1],
                          atlas.textureBox(puff.sprite % atlas.tiles()), color, drawnDepth, widening});
  }
  return mesh;
}

QuadMesh crossedQuads(const std::vector<LitPuff>& puffs, const glm::vec3& origin,
                      const image::SpriteAtlas& atlas) {
  QuadMesh mesh;
  for (const LitPuff& lit : puffs) {
    const glm::mat3 axes = glm::mat3_cast(lit.puff.rotation);
    const glm::vec3& s = lit.puff.sigma;
    // Plane i lies across axis i.
    const std::array<float, 3> areas{s.y * s.z, s.z * s.x, s.x * s.y};
    const float largest = std::max({areas[0], areas[1], areas[2]});
    const std::array<float, 3> levelness{std::abs(axes[0].y), std::abs(axes[1].y), std::abs(axes[2].y)};
    const auto mostLevel = std::ranges::max_element(levelness) - levelness.begin();
    const auto isUpright = [&](int i) { return levelness[static_cast<size_t>(i)] < 0.5f; };
    // Its most level plane holds what is seen from above, however small.
    const auto isDrawn = [&](int i) {
      return i == mostLevel || areas[static_cast<size_t>(i)] >= kSmallestPlane * largest;
    };
    // From above a plane that is tilted is narrower than its puff: what they show together is the puff's.
    float levelShare = 0;
    for (int i = 0; i < 3; ++i)
      if (isDrawn(i) && !isUpright(i)) levelShare += levelness[static_cast<size_t>(i)];
    for (int i = 0; i < 3; ++i) {
      if (!isDrawn(i)) continue;
      const bool upright = isUpright(i);
      const float opticalDepth =
          shape::centralOpticalDepth(lit.puff.extinctionPerMeter, s[i]) / (upright ? 1 : levelShare);
      const float widening = wideningOf(opticalDepth, lit.covering), reach = widening * image::kSpriteReach;
      const float drawnDepth = opticalDepthOfQuad(opticalDepth, widening);
      glm::vec4 color = colorOf(lit, drawnDepth);
      if (upright) color.a *= kUprightShare;
      if (color.a < kFaintest) continue;
      int right = (i + 1) % 3, up = (i + 2) % 3;
      if (std::abs(axes[right].y) > std::abs(axes[up].y)) std::swap(right, up);
      mesh.quads.push_back({lit.puff.center - origin, reach * s[right] * axes[right],
                            reach * s[up] * axes[up], atlas.textureBox(lit.puff.sprite % atlas.tiles()),
                            color, drawnDepth, widening});
    }
  }
  for (std::uint32_t face = 0; face < 2 * mesh.quads.size(); ++face) mesh.faces.push_back(face);
  orderFaces(mesh, LevelFaces::Last);
  return mesh;
}

void orderFaces(QuadMesh& mesh, LevelFaces level) {
  struct Face {
    int side;
    float depth;
    std::uint32_t face;
  };
  std::vector<Face> faces;
  for (const std::uint32_t face : mesh.faces) {
    const Quad& quad = mesh.quads[face / 2];
    const glm::vec3 normal = glm::cross(quad.right, quad.up), &center = quad.center;
    const int side = sideOf(face % 2 ? -normal : normal);
    const std::array<float, 6> depths{center.z, -center.z, center.x, -center.x, center.y, -center.y};
    const bool isFirst = side >= kLevelSides && level == LevelFaces::First;
    faces.push_back({isFirst ? side - kSides : side, depths[static_cast<size_t>(side)], face});
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
    return std::tie(a.side, a.depth, a.face) < std::tie(b.side, b.depth, b.face);
  });
  std::ranges::transform(faces, mesh.faces.begin(), &Face::face);
}

}  // namespace cloudgen::writer
