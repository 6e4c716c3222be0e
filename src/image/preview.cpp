// SPDX-License-Identifier: Apache-2.0
#include "image/preview.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <numeric>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "image/backdrop.hpp"

namespace cloudgen::image {
namespace {

constexpr int kTile = 32;

/// A splat on the screen: centre in pixels, inverse covariance, colour as seen from here.
struct Drawn {
  float x = 0, y = 0, depth = 0;
  float a = 0, b = 0, c = 0;     ///< inverse covariance, 1/px2
  float reachX = 0, reachY = 0;  ///< half-size of the box that holds 3 deviations, px
  float opacity = 0;
  glm::vec3 color{0};
};

struct View {
  glm::dvec3 eye{0};
  glm::dmat3 axes{1};  ///< columns: right, up, back
  double focal = 1;
  int width = 0, height = 0;
};

View viewOf(const Camera& camera) {
  View view;
  view.eye = camera.eye;
  const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
  const glm::dvec3 upward = std::abs(back.y) > 0.9999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(upward, back));
  view.axes = glm::dmat3(right, glm::cross(back, right), back);
  view.focal = 0.5 * camera.height / std::tan(0.5 * camera.verticalFieldDegrees * 3.14159265358979 / 180.0);
  view.width = camera.width;
  view.height = camera.height;
  return view;
}

/// Elliptical weighted average projection (Zwicker et al. 2001): the covariance through the Jacobian of the
/// perspective.
bool project(const Splat& splat, const View& view, const Backdrop& backdrop, const glm::vec3& sunDirection,
             Drawn& out) {
  const glm::dmat3 toView = glm::transpose(view.axes);
  const glm::dvec3 p = toView * (glm::dvec3(splat.center) - view.eye);
  const double distance = -p.z;
  const float largest = std::max({splat.sigma.x, splat.sigma.y, splat.sigma.z});
  if (distance < std::max(1.0, 0.4 * static_cast<double>(largest))) return false;
  const double f = view.focal / distance;
  const glm::mat3 axes = glm::mat3_cast(splat.rotation);
  // Off the screen the linear approximation of the perspective blows up: hold it at 1.3 times the field of
  // view.
  const double limitX = 0.65 * view.width / view.focal, limitY = 0.65 * view.height / view.focal;
  const double slopeX = std::clamp(p.x / distance, -limitX, limitX),
               slopeY = std::clamp(p.y / distance, -limitY, limitY);
  double xx = 0.3, xy = 0, yy = 0.3;  // a pixel's own blur
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 v = toView * glm::dvec3(axes[i] * splat.sigma[i]);
    const double sx = f * (v.x + slopeX * v.z), sy = f * (v.y + slopeY * v.z);
    xx += sx * sx;
    xy += sx * sy;
    yy += sy * sy;
  }
  out.x = static_cast<float>(0.5 * view.width + f * p.x);
  out.y = static_cast<float>(0.5 * view.height - f * p.y);
  out.reachX = static_cast<float>(3.0 * std::sqrt(xx));
  out.reachY = static_cast<float>(3.0 * std::sqrt(yy));
  if (out.x + out.reachX < 0 || out.x - out.reachX > view.width || out.y + out.reachY < 0 ||
      out.y - out.reachY > view.height)
    return false;
  const double determinant = xx * yy - xy * xy;
  out.a = static_cast<float>(yy / determinant);
  out.b =
      static_cast<float>(xy / determinant);  // y points down on the screen: the sign of the mixed term turns
  out.c = static_cast<float>(xx / determinant);
  // Spread over the blur: a splat smaller than a pixel must not gain weight.
  const double own = std::max((xx - 0.3) * (yy - 0.3) - xy * xy, 0.0);
  out.opacity = splat.opacity * static_cast<float>(std::sqrt(own / determinant));
  out.depth = static_cast<float>(distance);
  const glm::dvec3 direction = glm::normalize(glm::dvec3(splat.center) - view.eye);
  const float towards = static_cast<float>(glm::dot(direction, glm::dvec3(sunDirection)));
  const glm::vec3 seen = glm::clamp(splat.color + splat.towardsSun * towards, 0.0f, 1.0f);
  out.color = glm::mix(backdrop.hazeColor(direction), seen, backdrop.clarity(view.eye, splat.center));
  return out.opacity > 0.002f;
}

void drawTile(Picture& picture, const View& view, const Backdrop& backdrop, const std::vector<Drawn>& drawn,
              const std::vector<std::uint32_t>& order, int tileX, int tileY) {
  for (int y = tileY; y < std::min(tileY + kTile, view.height); ++y)
    for (int x = tileX; x < std::min(tileX + kTile, view.width); ++x) {
      glm::vec3 color(0);
      float open = 1;
      const glm::dvec3 ray((x + 0.5 - 0.5 * view.width) / view.focal,
                           (0.5 * view.height - y - 0.5) / view.focal, -1.0);
      const glm::dvec3 direction = glm::normalize(view.axes * ray);
      const double hidden = backdrop.distanceToTerrain(view.eye, direction) / glm::length(ray);
      for (const std::uint32_t index : order) {
        const Drawn& splat = drawn[index];
        if (splat.depth > hidden) break;
        const float dx = x + 0.5f - splat.x, dy = y + 0.5f - splat.y;
        const float r2 = splat.a * dx * dx + 2 * splat.b * dx * dy + splat.c * dy * dy;
        if (r2 > 9.0f) continue;
        const float alpha = std::min(0.999f, splat.opacity * std::exp(-0.5f * r2));
        color += open * alpha * splat.color;
        open *= 1 - alpha;
        if (open < 0.004f) break;
      }
      if (open >= 0.004f) color += open * backdrop.colorAlong(view.eye, direction);
      picture.at(x, y) = color;
    }
}

/// The middle of the densest of 24 x 24 squares: centroid of its splats by opacity.
glm::dvec3 densestPlace(std::span<const Splat> splats, const glm::dvec3& lower, double across) {
  constexpr int kSquares = 24;
  std::vector<glm::dvec4> squares(kSquares * kSquares, glm::dvec4(0));
  for (const Splat& splat : splats) {
    const auto square = [&](double value) {
      return std::clamp(static_cast<int>(value / across * kSquares), 0, kSquares - 1);
    };
    const double weight = splat.opacity * std::max(splat.sigma.x, splat.sigma.z);
    squares[static_cast<size_t>(square(splat.center.z - lower.z) * kSquares +
                                square(splat.center.x - lower.x))] +=
        weight * glm::dvec4(glm::dvec3(splat.center), 1);
  }
  const auto best = std::max_element(squares.begin(), squares.end(),
                                     [](const auto& a, const auto& b) { return a.w < b.w; });
  return best->w > 0 ? glm::dvec3(*best) / best->w : glm::dvec3(lower);
}

}  // namespace

Picture render(std::span<const Splat> splats, const Camera& camera, const Surroundings& surroundings,
               const base::Progress& progress) {
  const View view = viewOf(camera);
  progress.step("preview: shadows", 0);
  const Backdrop backdrop(splats, surroundings);
  std::vector<Drawn> drawn;
  for (const Splat& splat : splats)
    if (Drawn one; project(splat, view, backdrop, surroundings.sun.direction, one)) drawn.push_back(one);
  std::vector<std::uint32_t> nearestFirst(drawn.size());
  std::iota(nearestFirst.begin(), nearestFirst.end(), 0u);
  std::stable_sort(nearestFirst.begin(), nearestFirst.end(),
                   [&](auto a, auto b) { return drawn[a].depth < drawn[b].depth; });

  const int columns = (view.width + kTile - 1) / kTile, rows = (view.height + kTile - 1) / kTile;
  std::vector<std::vector<std::uint32_t>> lists(static_cast<size_t>(columns) * rows);
  for (const std::uint32_t index : nearestFirst) {
    const Drawn& splat = drawn[index];
    const auto tileOf = [](float pixel, int count) {
      return std::clamp(static_cast<int>(std::floor(pixel / kTile)), 0, count - 1);
    };
    for (int row = tileOf(splat.y - splat.reachY, rows); row <= tileOf(splat.y + splat.reachY, rows); ++row)
      for (int column = tileOf(splat.x - splat.reachX, columns);
           column <= tileOf(splat.x + splat.reachX, columns); ++column)
        lists[static_cast<size_t>(row) * columns + column].push_back(index);
  }
  Picture picture(view.width, view.height);
  for (int row = 0; row < rows; ++row) {
    progress.step("preview", static_cast<double>(row) / rows);
    base::parallelFor(static_cast<size_t>(columns), [&](size_t column) {
      drawTile(picture, view, backdrop, drawn, lists[static_cast<size_t>(row) * columns + column],
               static_cast<int>(column) * kTile, row * kTile);
    });
  }
  progress.step("preview", 1);
  return picture;
}

Camera cameraFor(std::string_view name, std::span<const Splat> splats, const Surroundings& surroundings,
                 int width, int height) {
  glm::dvec3 lower(1e300), upper(-1e300), mean(0);
  double weight = 0;
  for (const Splat& splat : splats) {
    lower = glm::min(lower, glm::dvec3(splat.center));
    upper = glm::max(upper, glm::dvec3(splat.center));
    mean += static_cast<double>(splat.opacity) * glm::dvec3(splat.center);
    weight += splat.opacity;
  }
  if (splats.empty()) lower = glm::dvec3(0), upper = glm::dvec3(10000), weight = 1;
  mean = splats.empty() ? 0.5 * (lower + upper) : mean / weight;
  Camera camera;
  camera.width = width;
  camera.height = height;
  const glm::dvec3 size = upper - lower;
  const double across = std::max(size.x, size.z), ground = surroundings.groundHeightMeters;
  const auto groundUnder = [&](const glm::dvec3& place) {
    const base::HeightField& terrain = surroundings.terrain;
    const bool relief = !terrain.empty() && terrain.covers(place.x, place.z);
    return relief ? std::max(ground, terrain.heightAt(place.x, place.z)) : ground;
  };
  if (name == "top") {
    const double aspect = static_cast<double>(width) / height;
    camera.target = {0.5 * (lower.x + upper.x), ground, 0.5 * (lower.z + upper.z)};
    camera.eye = camera.target + glm::dvec3(0, upper.y + 1.22 * std::max(size.z, size.x / aspect) + 500, 0);
  } else if (name == "ground") {
    // Far enough to see the tops, not so far that they sink into the haze; the sun over the shoulder.
    const glm::dvec3 sun(surroundings.sun.direction);
    glm::dvec3 away = glm::dvec3(sun.x * 0.4 - sun.z * 0.9, 0, sun.z * 0.4 + sun.x * 0.9);
    away /= std::max(1e-9, glm::length(away));
    const glm::dvec3 crowd = densestPlace(splats, lower, across);
    camera.eye = glm::dvec3(crowd.x, ground + 20, crowd.z) +
                 away * std::min(2.2 * crowd.y + 4000.0, 0.8 * across + 3000);
    camera.eye.y = groundUnder(camera.eye) + 20;
    camera.target = glm::dvec3(crowd.x, std::min(0.6 * upper.y, crowd.y * 1.2), crowd.z);
    camera.verticalFieldDegrees = 55;
  } else if (name == "horizon") {
    camera.eye = {mean.x, 1.15 * upper.y + 0.05 * across, upper.z + 0.12 * across};
    camera.target = {mean.x, 0.4 * mean.y, mean.z};
  } else {
    throw base::UsageError("--view " + std::string(name), "is not a known view",
                           "use top, ground, horizon or EYE:TARGET as lon,lat,height:lon,lat,height");
  }
  return camera;
}

}  // namespace cloudgen::image
