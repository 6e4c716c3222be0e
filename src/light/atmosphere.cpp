// SPDX-License-Identifier: Apache-2.0
#include "light/atmosphere.hpp"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "light/optics.hpp"

namespace cloudgen::light {
namespace {

constexpr double kEarthMeters = 6'371'000, kTopMeters = 80'000;
constexpr double kAirMeters = 8000, kAerosolMeters = 1200, kAerosolAsymmetry = 0.76;
const glm::dvec3 kAir(5.802e-6, 13.558e-6, 33.1e-6);
constexpr double kAerosol = 2e-5, kAerosolAlbedo = 0.9;
const glm::dvec3 kOzone(0.650e-6, 1.881e-6, 0.085e-6);

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// How much of everything lies along a way, in metres of it at the ground (ozone: at its layer's middle).
struct Column {
  double air = 0, aerosol = 0, ozone = 0;

  void add(double height, double meters) {
    air += std::exp(-height / kAirMeters) * meters;
    aerosol += std::exp(-height / kAerosolMeters) * meters;
    ozone += std::max(0.0, 1 - std::abs(height - 25'000) / 15'000) * meters;
  }
  glm::dvec3 transmittance() const { return glm::exp(-(kAir * air + kAerosol * aerosol + kOzone * ozone)); }
};

/// The distance at which a ray from inside leaves the air, or a negative number if it meets the Earth.
double wayOut(const glm::dvec3& from, const glm::dvec3& direction) {
  const double along = glm::dot(from, direction), square = glm::dot(from, from);
  const double ground = along * along - square + kEarthMeters * kEarthMeters;
  if (along < 0 && ground > 0) return -1;
  const double top = kEarthMeters + kTopMeters;
  return -along + std::sqrt(std::max(0.0, along * along - square + top * top));
}

/// Visits the middles of the pieces of a ray, which are short where it starts: visit(point, length).
template <class Visit>
void walk(const glm::dvec3& from, const glm::dvec3& direction, double length, int steps, Visit&& visit) {
  for (int i = 0; i < steps; ++i) {
    const double a = static_cast<double>(i) / steps, b = (i + 1.0) / steps;
    const double start = length * a * a, end = length * b * b;
    visit(from + direction * (0.5 * (start + end)), end - start);
  }
}

double heightOf(const glm::dvec3& point) { return glm::length(point) - kEarthMeters; }

glm::dvec3 lightFrom(const glm::dvec3& point, const glm::dvec3& sun) {
  const double length = wayOut(point, sun);
  if (length < 0) return glm::dvec3(0);
  Column column;
  walk(point, sun, length, 24,
       [&](const glm::dvec3& at, double meters) { column.add(heightOf(at), meters); });
  return column.transmittance();
}

glm::dvec3 towards(double elevationDegrees, double azimuthDegrees) {
  const double elevation = radians(elevationDegrees), azimuth = radians(azimuthDegrees);
  return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
          std::cos(elevation) * std::sin(azimuth)};
}

}  // namespace

glm::vec3 sunTransmittance(double elevationDegrees, double heightMeters) {
  return glm::vec3(lightFrom({0, kEarthMeters + heightMeters, 0}, towards(elevationDegrees, 0)));
}

glm::vec3 skyRadiance(double elevationDegrees, double azimuthFromSunDegrees, double sunElevationDegrees) {
  const glm::dvec3 eye(0, kEarthMeters + 10, 0),
      sun = towards(sunElevationDegrees, 0),
      view = towards(std::max(elevationDegrees, 0.1), azimuthFromSunDegrees);
  const double cosine = glm::dot(view, sun);
  const double airPhase = draine(cosine, 0, 1), aerosolPhase = henyeyGreenstein(cosine, kAerosolAsymmetry);
  Column column;
  glm::dvec3 radiance(0);
  walk(eye, view, wayOut(eye, view), 32, [&](const glm::dvec3& at, double meters) {
    const double height = heightOf(at);
    column.add(height, 0.5 * meters);
    const glm::dvec3 scattering =
        kAir * std::exp(-height / kAirMeters) * airPhase +
        kAerosol * kAerosolAlbedo * std::exp(-height / kAerosolMeters) * aerosolPhase;
    radiance += column.transmittance() * lightFrom(at, sun) * scattering * meters;
    column.add(height, 0.5 * meters);
  });
  return glm::vec3(radiance);
}

}  // namespace cloudgen::light
