// SPDX-License-Identifier: Apache-2.0
#include "writer/page/page_data.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "writer/page/base64.hpp"

namespace cloudgen::writer {
namespace {

using Json = nlohmann::ordered_json;

/// The double that prints as the float does.
double printed(float value) {
  double out = 0;
  base::parseNumber(base::shortest(value), out);
  return out;
}

double millimeters(double meters) { return std::round(meters * 1000) / 1000; }

Json triple(const glm::vec3& v) { return {printed(v.x), printed(v.y), printed(v.z)}; }

/// Colour of a genus's bar in the legend: blues for high clouds, greens and greys for middle ones, warm for
/// heaps.
std::string_view legendColor(base::Genus genus) {
  switch (genus) {
    case base::Genus::Cirrus:
      return "#8fc4ff";
    case base::Genus::Cirrocumulus:
      return "#6fb0f0";
    case base::Genus::Cirrostratus:
      return "#c3dcf7";
    case base::Genus::Altocumulus:
      return "#84d0b8";
    case base::Genus::Altostratus:
      return "#a8c3bb";
    case base::Genus::Nimbostratus:
      return "#8f9db0";
    case base::Genus::Stratocumulus:
      return "#d8c08c";
    case base::Genus::Stratus:
      return "#c8c4bb";
    case base::Genus::Cumulus:
      return "#ffd479";
    case base::Genus::Cumulonimbus:
      return "#ff9a66";
    case base::Genus::Fog:
      return "#cfc6e6";
  }
  return "#ffffff";
}

Json generaOf(const scene::Scene& scene) {
  struct Tally {
    std::uint64_t count = 0;
    float base = 0, top = 0;
  };
  std::map<base::Genus, Tally> tallies;
  for (const scene::CloudRecord& cloud : scene.clouds) {
    Tally& tally = tallies[cloud.genus];
    tally.base = tally.count ? std::min(tally.base, cloud.baseMeters) : cloud.baseMeters;
    tally.top = std::max(tally.top, cloud.topMeters);
    ++tally.count;
  }
  Json out = Json::array();
  for (const auto& [genus, tally] : tallies)
    out.push_back({{"abbreviation", base::abbreviation(genus)},
                   {"name", base::name(genus)},
                   {"count", tally.count},
                   {"color", legendColor(genus)},
                   {"lowestBaseMeters", printed(tally.base)},
                   {"highestTopMeters", printed(tally.top)}});
  return out;
}

/// "36.2 to 37.2°N"; both ends carry their letter when they differ.
std::string rangeText(double from, double to, std::string_view positive, std::string_view negative) {
  const auto letter = [&](double value) { return value < 0 ? negative : positive; };
  const auto number = [](double value) { return base::shortest(std::round(std::abs(value) * 100) / 100); };
  if (letter(from) == letter(to)) return fmt::format("{} to {}°{}", number(from), number(to), letter(to));
  return fmt::format("{}°{} to {}°{}", number(from), letter(from), number(to), letter(to));
}

std::string titleOf(const scene::Scene& scene) {
  const base::GeoBox& box = scene.frame.box();
  const std::string clouds =
      scene.provenance.model.empty() ? "Clouds" : "Clouds of " + scene.provenance.model;
  return fmt::format("{}, {}, {}", clouds, rangeText(box.south, box.north, "N", "S"),
                     rangeText(box.west, box.east, "E", "W"));
}

/// A "<" could end the script element that the text stands in.
std::string safeInHtml(const std::string& json) {
  std::string out;
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string pageData(const scene::Scene& scene, const PageParts& parts) {
  const base::GeoBox& box = scene.frame.box();
  const glm::dvec2 lower = scene.frame.lowerCorner(), upper = scene.frame.upperCorner();
  Json files = Json::array();
  for (const std::string& file : scene.provenance.files)
    files.push_back(std::filesystem::path(file).filename().string());

  Json data;
  data["title"] = titleOf(scene);
  data["validTime"] = base::isoText(scene.validTime);
  data["run"] = scene.provenance.run;
  data["model"] = scene.provenance.model;
  data["files"] = files;
  data["box"] = {{"west", box.west}, {"south", box.south}, {"east", box.east}, {"north", box.north}};
  data["frame"] = {{"definition", scene.frame.definition()},
                   {"lower", {millimeters(lower.x), millimeters(lower.y)}},
                   {"upper", {millimeters(upper.x), millimeters(upper.y)}}};
  data["groundHeightMeters"] = printed(scene.groundHeightMeters);
  if (!scene.terrain.empty()) {
    Json heights = Json::array();
    for (const float height : scene.terrain.heights) heights.push_back(std::lround(height));
    data["terrain"] = {{"columns", scene.terrain.columns},
                       {"rows", scene.terrain.rows},
                       {"origin", {millimeters(scene.terrain.origin.x), millimeters(scene.terrain.origin.y)}},
                       {"step", {millimeters(scene.terrain.step.x), millimeters(scene.terrain.step.y)}},
                       {"heights", heights}};
  }
  data["highestTopMeters"] = printed(scene::highestTop(scene));
  data["sun"] = {{"azimuthDegrees", std::round(scene.sun.azimuthDegrees * 100) / 100},
                 {"elevationDegrees", std::round(scene.sun.elevationDegrees * 100) / 100},
                 {"direction", triple(scene.sun.direction)}};
  data["counts"] = {{"clouds", scene.clouds.size()}, {"puffs", scene::drawnPuffs(scene)}};
  data["genera"] = generaOf(scene);
  data["pack"] = {{"bytes", parts.packBytes},
                  {"file", parts.packFile.empty() ? Json(nullptr) : Json(parts.packFile)}};
  if (!parts.verification.empty()) data["verification"] = Json::parse(parts.verification);
  for (const PageParts::Map& map : parts.maps)
    data["maps"].push_back(
        {{"name", map.name}, {"file", map.file}, {"picture", "data:image/png;base64," + base64(map.png)}});
  // A name in another encoding than UTF-8 is shown with replacement characters, not refused.
  return safeInHtml(data.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace cloudgen::writer
