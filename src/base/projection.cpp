// SPDX-License-Identifier: Apache-2.0
#include "base/projection.hpp"

#include <proj.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.hpp"
#include "base/frame.hpp"

namespace cloudgen::base {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The value of a parameter of a definition, or nothing.
std::string_view parameter(std::string_view definition, std::string_view name) {
  for (std::size_t at = definition.find(name); at != std::string_view::npos;
       at = definition.find(name, at + 1)) {
    const bool whole = at == 0 || definition[at - 1] == '+' || definition[at - 1] == ' ';
    const std::string_view rest = definition.substr(at + name.size());
    if (whole && rest.starts_with('=')) return rest.substr(1, rest.find_first_of(" \t\n") - 1);
  }
  return {};
}

bool namesLongitudeLatitude(std::string_view projection) {
  for (const std::string_view name : {"longlat", "lonlat", "latlong", "latlon"})
    if (projection == name) return true;
  return false;
}

PJ* operation(const std::shared_ptr<void>& pointer) { return static_cast<PJ*>(pointer.get()); }

/// The definition without what would make it a coordinate system instead of a projection.
std::string asOperation(std::string definition) {
  for (const std::string_view flag : {"+type=crs", "+no_defs"})
    if (const auto at = definition.find(flag); at != std::string::npos) definition.erase(at, flag.size());
  return definition;
}

[[noreturn]] void refuse(const std::string& definition, const std::string& why) {
  throw InputError("grid", "PROJ refuses the projection '" + definition + "': " + why,
                   "check the grid definition of the file");
}

bool present(const PJ_COORD& place) {
  return std::isfinite(place.xy.x) && std::isfinite(place.xy.y) && std::abs(place.xy.x) < 1e30 &&
         std::abs(place.xy.y) < 1e30;
}

}  // namespace

bool isLongitudeLatitude(std::string_view definition) {
  return namesLongitudeLatitude(parameter(definition, "proj"));
}

Projection::Projection(const std::string& definition) {
  if (isLongitudeLatitude(definition)) {
    identity_ = inDegrees_ = true;
    periodX_ = 360;
    return;
  }
  context_ = std::shared_ptr<void>(proj_context_create(),
                                   [](void* p) { proj_context_destroy(static_cast<PJ_CONTEXT*>(p)); });
  const auto context = static_cast<PJ_CONTEXT*>(context_.get());
  proj_log_level(context, PJ_LOG_NONE);
  // Anything else (a pipeline, a file of settings) is not a projection, and may read other files.
  if (parameter(definition, "proj").empty() || parameter(definition, "proj") == "pipeline")
    refuse(definition, "it names no projection");
  PJ* created = proj_create(context, asOperation(definition).c_str());
  if (!created) {
    const int code = proj_context_errno(context);
    refuse(definition, code ? proj_context_errno_string(context, code) : "it is no projection");
  }
  operation_ =
      std::shared_ptr<void>(created, [keep = context_](void* p) { proj_destroy(static_cast<PJ*>(p)); });
  if (!proj_angular_input(created, PJ_FWD)) refuse(definition, "it does not start from the Earth");
  if (!proj_pj_info(created).has_inverse) refuse(definition, "it has no inverse");
  inDegrees_ = namesLongitudeLatitude(parameter(definition, "o_proj"));
  // PROJ's word about the unit of rotated longitudes cannot be relied on (9.1 gives radians and denies it),
  // and a definition may scale them by +to_meter: it is measured.
  planeInRadians_ = inDegrees_ && stepsAreRadians();
  periodX_ = measurePeriod(definition);
}

/// A step along y turns by as much, or by as many degrees.
bool Projection::stepsAreRadians() const {
  constexpr double kStep = 1e-3;
  const glm::dvec2 from = toGeographic({0, 0}), to = toGeographic({0, kStep});
  return std::hypot(to.y - from.y, wrappedLongitude(to.x - from.x)) > 0.5 * proj_todeg(kStep);
}

double Projection::measurePeriod(const std::string& definition) const {
  if (inDegrees_) return 360;
  const std::string_view name = parameter(definition, "proj");
  bool cylindrical = false;
  for (const std::string_view known : {"merc", "webmerc", "eqc", "cea", "mill"}) cylindrical |= name == known;
  if (!cylindrical) return 0;
  // One degree of longitude; of two places at least one does not lie at the map's edge.
  const auto degree = [&](double longitude) {
    return std::abs(toPlane({longitude + 1, 0}).x - toPlane({longitude, 0}).x);
  };
  return 360 * std::min(degree(0.25), degree(100.25));
}

std::shared_ptr<const Projection> Projection::of(const std::string& definition) {
  constexpr std::size_t kMostKept = 64;
  thread_local std::map<std::string, std::shared_ptr<const Projection>> known;
  thread_local std::pair<std::string, std::shared_ptr<const Projection>> latest;
  if (latest.second && latest.first == definition) return latest.second;
  const auto found = known.find(definition);
  std::shared_ptr<const Projection> projection =
      found != known.end() ? found->second : std::make_shared<const Projection>(definition);
  if (known.size() >= kMostKept) known.clear();
  known.emplace(definition, projection);
  latest = {definition, projection};
  return projection;
}

glm::dvec2 Projection::toPlane(const glm::dvec2& longitudeLatitude) const {
  if (identity_) return longitudeLatitude;
  const PJ_COORD there =
      proj_trans(operation(operation_), PJ_FWD,
                 proj_coord(proj_torad(longitudeLatitude.x), proj_torad(longitudeLatitude.y), 0, 0));
  if (!present(there)) return {kNone, kNone};
  if (planeInRadians_) return {proj_todeg(there.xy.x), proj_todeg(there.xy.y)};
  return {there.xy.x, there.xy.y};
}

glm::dvec2 Projection::toGeographic(const glm::dvec2& plane) const {
  if (identity_) return {wrappedLongitude(plane.x), plane.y};
  const glm::dvec2 given = planeInRadians_ ? glm::dvec2(proj_torad(plane.x), proj_torad(plane.y)) : plane;
  const PJ_COORD there = proj_trans(operation(operation_), PJ_INV, proj_coord(given.x, given.y, 0, 0));
  if (!present(there)) return {kNone, kNone};
  return {wrappedLongitude(proj_todeg(there.lp.lam)), proj_todeg(there.lp.phi)};
}

}  // namespace cloudgen::base
