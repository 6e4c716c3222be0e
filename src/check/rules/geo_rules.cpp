// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>

#include "check/rules/node_record.hpp"

namespace cloudgen::check {
namespace {

/// Ellipsoids of ISO/IEC 19775-1, table 25.3.
constexpr std::array<std::string_view, 23> kEllipsoids{"AA", "AM", "AN", "BN", "BR", "CC", "CD", "EA",
                                                       "EB", "EC", "ED", "EE", "EF", "FA", "HE", "HO",
                                                       "ID", "IN", "KA", "RF", "SA", "WD", "WE"};

bool isEllipsoid(std::string_view text) {
  return std::find(kEllipsoids.begin(), kEllipsoids.end(), text) != kEllipsoids.end();
}

/// "Z1" to "Z60".
bool isZone(std::string_view text) {
  int zone = 0;
  const auto [end, error] =
      std::from_chars(text.data() + std::min<std::size_t>(1, text.size()), text.data() + text.size(), zone);
  return text.starts_with("Z") && error == std::errc() && end == text.data() + text.size() && zone >= 1 &&
         zone <= 60;
}

}  // namespace

void checkGeoSystem(const std::vector<std::string>& strings, Position where, FindingList& findings) {
  const auto wrong = [&](std::string message, std::string hint) {
    findings.error(where, "geo-system", std::move(message), std::move(hint));
  };
  if (strings.empty()) return;
  const std::string& system = strings.front();
  const bool geodetic = system == "GD" || system == "GDC", transverse = system == "UTM";
  if (!geodetic && !transverse && system != "GC" && system != "GCC" && system != "GS")
    return wrong(excerpt(system) + " is no spatial reference frame", "the first string is GD, UTM or GC");
  bool hasZone = false;
  for (std::size_t i = 1; i < strings.size(); ++i) {
    const std::string& part = strings[i];
    const bool isOrder = part == "longitude_first" || part == "latitude_first" || part == "northing_first" ||
                         part == "easting_first";
    if (transverse && isZone(part))
      hasZone = true;
    else if (!(transverse && part == "S") && !isOrder && !isEllipsoid(part) && part != "WGS84")
      return wrong(fmt::format("{} means nothing in a {} geoSystem", excerpt(part), system),
                   transverse ? "a zone Z1 to Z60, S for the southern half, an ellipsoid such as WE"
                              : "an ellipsoid such as WE, or longitude_first");
  }
  if (transverse && !hasZone) wrong("a UTM geoSystem has no zone", "add \"Z1\" to \"Z60\"");
}

}  // namespace cloudgen::check
