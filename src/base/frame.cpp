// SPDX-License-Identifier: Apache-2.0
#include "base/frame.hpp"

#include <proj.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace cloudgen::base {
namespace {

PJ* projection(const std::shared_ptr<void>& pointer) { return static_cast<PJ*>(pointer.get()); }

std::string mappingOf(const GeoBox& box) {
  constexpr double kWidestAzimuthal = 150.0;
  const double latitude = box.centerLatitude();
  const std::string center = shortest(box.centerLongitude());
  if (box.width() <= kWidestAzimuthal)
    return fmt::format("+proj=laea +lat_0={} +lon_0={} +datum=WGS84 +units=m +type=crs", shortest(latitude),
                       center);
  if (box.south > 0 || box.north < 0)
    return fmt::format("+proj=laea +lat_0={} +lon_0={} +datum=WGS84 +units=m +type=crs",
                       latitude > 0 ? 90 : -90, center);
  return fmt::format("+proj=cea +lat_ts=30 +lon_0={} +datum=WGS84 +units=m +type=crs", center);
}

}  // namespace

double wrappedLongitude(double longitudeDegrees) {
  return longitudeDegrees - 360.0 * std::floor((longitudeDegrees + 180.0) / 360.0);
}

bool GeoBox::contains(double longitudeDegrees, double latitudeDegrees) const {
  if (latitudeDegrees < south || latitudeDegrees > north) return false;
  const double eastward = longitudeDegrees - west;
  return eastward - 360.0 * std::floor(eastward / 360.0) <= width();
}

double GeoBox::centerLongitude() const { return wrappedLongitude(west + 0.5 * width()); }

GeoBox boxFromText(const std::string& text) {
  const auto parts = split(text, ',');
  GeoBox box;
  double* const sides[4] = {&box.west, &box.south, &box.east, &box.north};
  bool numbers = parts.size() == 4;
  for (size_t i = 0; numbers && i < 4; ++i) numbers = parseNumber(parts[i], *sides[i]);
  const std::string example = "give west,south,east,north in degrees, as in --bbox -122.6,36.2,-121.2,37.2";
  if (!numbers) throw UsageError("--bbox " + text, "is not four numbers", example);
  if (box.south < -90 || box.north > 90 || box.south >= box.north)
    throw UsageError("--bbox " + text, "south must be below north, both within -90..90", example);
  if (std::abs(box.west) > 360 || std::abs(box.east) > 360)
    throw UsageError("--bbox " + text, "longitudes must be within -360..360", example);
  if (box.east - box.west >= 360) {
    box.west = -180;
    box.east = 180;
    return box;
  }
  box.west = wrappedLongitude(box.west);
  box.east = wrappedLongitude(box.east);
  if (box.east == -180) box.east = 180;
  if (box.west == box.east)
    throw UsageError("--bbox " + text, "west and east are the same meridian", example);
  return box;
}

LocalFrame::LocalFrame(const GeoBox& box) : box_(box) {
  definition_ = mappingOf(box);
  context_ = std::shared_ptr<void>(proj_context_create(),
                                   [](void* p) { proj_context_destroy(static_cast<PJ_CONTEXT*>(p)); });
  const auto context = static_cast<PJ_CONTEXT*>(context_.get());
  PJ* created = proj_create(context, definition_.substr(0, definition_.find(" +type")).c_str());
  if (!created)
    throw InputError("scene frame", "PROJ refuses " + definition_, "check the box and the PROJ installation");
  projection_ =
      std::shared_ptr<void>(created, [keep = context_](void* p) { proj_destroy(static_cast<PJ*>(p)); });

  const glm::dvec3 corner = toScene(box.west, box.south, 0);
  origin_ = {corner.x, corner.z};
  lower_ = glm::dvec2(1e300);
  upper_ = glm::dvec2(-1e300);
  constexpr int kSteps = 64;
  for (int i = 0; i <= kSteps; ++i) {
    const double along = static_cast<double>(i) / kSteps;
    const double longitude = box.west + along * box.width(), latitude = box.south + along * box.height();
    for (const glm::dvec3& p :
         {toScene(longitude, box.south, 0), toScene(longitude, box.north, 0), toScene(box.west, latitude, 0),
          toScene(box.west + box.width(), latitude, 0)}) {
      lower_ = glm::dvec2(std::min(lower_.x, p.x), std::min(lower_.y, p.z));
      upper_ = glm::dvec2(std::max(upper_.x, p.x), std::max(upper_.y, p.z));
    }
  }
}

glm::dvec3 LocalFrame::toScene(double longitudeDegrees, double latitudeDegrees, double heightMeters) const {
  const PJ_COORD there =
      proj_trans(projection(projection_), PJ_FWD,
                 proj_coord(proj_torad(longitudeDegrees), proj_torad(latitudeDegrees), 0, 0));
  return {there.xy.x - origin_.x, heightMeters, -there.xy.y - origin_.y};
}

glm::dvec3 LocalFrame::toGeographic(const glm::dvec3& scene) const {
  const PJ_COORD there = proj_trans(projection(projection_), PJ_INV,
                                    proj_coord(scene.x + origin_.x, -(scene.z + origin_.y), 0, 0));
  return {proj_todeg(there.lp.lam), proj_todeg(there.lp.phi), scene.y};
}

glm::dvec2 LocalFrame::eastDirection(double longitudeDegrees, double latitudeDegrees) const {
  const double latitude = std::clamp(latitudeDegrees, -89.9, 89.9);
  const glm::dvec3 a = toScene(longitudeDegrees - 1e-4, latitude, 0),
                   b = toScene(longitudeDegrees + 1e-4, latitude, 0);
  const glm::dvec2 step(b.x - a.x, b.z - a.z);
  return step / std::hypot(step.x, step.y);
}

}  // namespace cloudgen::base
