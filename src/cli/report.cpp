// SPDX-License-Identifier: Apache-2.0
#include "cli/report.hpp"

#include <algorithm>
#include <cmath>

namespace cloudgen::cli {
namespace {

using nlohmann::ordered_json;

double rounded(double value, double perUnit) { return std::round(value * perUnit) / perUnit; }

ordered_json generaOf(const scene::Scene& scene) {
  ordered_json genera = ordered_json::object();
  for (const base::Genus genus : base::allGenera()) {
    const auto count = std::count_if(scene.clouds.begin(), scene.clouds.end(),
                                     [&](const auto& cloud) { return cloud.genus == genus; });
    if (count > 0) genera[std::string(base::abbreviation(genus))] = count;
  }
  return genera;
}

ordered_json rulesOf(const scene::Scene& scene) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& cloud : scene.clouds) ++counts[cloud.rule];
  return ordered_json(counts);
}

ordered_json isccpOf(const pipeline::Outcome& outcome) {
  ordered_json classes = ordered_json::object();
  for (const auto& [name, genera] : outcome.isccp)
    for (const auto& [genus, count] : genera)
      classes[std::string(name)][std::string(base::abbreviation(genus))] = count;
  return classes;
}

ordered_json filesIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  ordered_json files = ordered_json::array();
  for (const auto& path : paths)
    files.push_back({{"name", path.lexically_relative(folder).generic_string()},
                     {"bytes", std::filesystem::file_size(path)}});
  return files;
}

ordered_json fileNames(const field::SourceInfo& info) {
  ordered_json files = ordered_json::array();
  for (const std::string& file : info.files) files.push_back(std::filesystem::path(file).filename().string());
  return files;
}

ordered_json typingOf(const field::Source& typing, const pipeline::Pairing& pairing,
                      base::UtcTime modelTime) {
  const field::SourceInfo& info = typing.info();
  const auto share = [](double part, double whole) { return whole > 0 ? rounded(part / whole, 1e6) : 1.0; };
  return {{"files", fileNames(info)},
          {"format", info.format},
          {"valid_time", base::isoText(info.validTime)},
          {"minutes_after_model", static_cast<double>(info.validTime.seconds - modelTime.seconds) / 60},
          {"typed_columns", pairing.typedColumns},
          {"agreement",
           share(static_cast<double>(pairing.agreeingColumns), static_cast<double>(pairing.typedColumns))},
          {"matched_layers", pairing.matchedLayers},
          {"typing_alone", pairing.typingAlone},
          {"model_alone", pairing.modelAlone},
          {"cover_kept", share(pairing.keptCover, pairing.modelCover)},
          {"cover_added", share(pairing.addedCover, pairing.modelCover)}};
}

}  // namespace

ordered_json motionOf(const pipeline::MovingSky& sky) {
  ordered_json hours = ordered_json::array();
  for (const pipeline::HourOfMotion& hour : sky.hours)
    hours.push_back({{"from", base::isoText(hour.from)},
                     {"to", base::isoText(hour.to)},
                     {"stretches", hour.stretches},
                     {"matched", hour.matched},
                     {"matched_share", rounded(hour.matchedShare, 1e4)},
                     {"splits", hour.splits},
                     {"mergers", hour.mergers},
                     {"births", hour.births},
                     {"deaths", hour.deaths},
                     {"wind_m_s", rounded(hour.windMetersPerSecond, 100)},
                     {"drift_over_wind", rounded(hour.driftOverWind, 1e4)},
                     {"pattern_m_s", rounded(hour.patternMetersPerSecond, 100)}});
  return {{"hours", hours},
          {"lifetimes", sky.lifetimes},
          {"clouds", sky.scene.instances.size()},
          {"keyframes", sky.scene.keySeconds.size()}};
}

ordered_json reportOf(const field::Source& source, const field::Source* typing,
                      const pipeline::Outcome& outcome, const std::filesystem::path& folder,
                      const std::vector<std::pair<std::string, double>>& timingsSeconds) {
  const scene::Scene& scene = outcome.scene;
  const field::SourceInfo& info = source.info();
  const base::GeoBox& box = scene.frame.box();
  ordered_json report;
  report["cloudgen"] = CLOUDGEN_VERSION;
  report["source"] = {{"files", fileNames(info)},
                      {"format", info.format},
                      {"model", info.model},
                      {"run", info.run ? ordered_json(base::isoText(*info.run)) : ordered_json(nullptr)},
                      {"fields", info.fields}};
  if (typing && outcome.pairing) report["typing"] = typingOf(*typing, *outcome.pairing, info.validTime);
  report["valid_times"] = {base::isoText(scene.validTime)};
  report["bbox"] = {box.west, box.south, box.east, box.north};
  report["frame"] = {{"kind", "local"},
                     {"definition", scene.frame.definition()},
                     {"origin", {box.west, box.south}},
                     {"axes", "x east, y up, z south, metres"},
                     {"ground_m", scene.groundHeightMeters}};
  report["sun"] = {{"azimuth", rounded(scene.sun.azimuthDegrees, 100)},
                   {"elevation", rounded(scene.sun.elevationDegrees, 100)}};
  report["seed"] = scene.seed;
  report["counts"] = {{"columns", outcome.columns},
                      {"cells", outcome.cells},
                      {"layers", outcome.layers},
                      {"patches", outcome.patches},
                      {"clouds", scene.clouds.size()},
                      {"puffs", scene::drawnPuffs(scene)},
                      {"archetypes", scene.archetypes.size()},
                      {"tiles", scene::tilesOf(scene).size()}};
  report["genera"] = generaOf(scene);
  report["rules"] = rulesOf(scene);
  report["isccp"] = isccpOf(outcome);
  report["enlargement"] = rounded(outcome.enlargement, 1000);
  report["derived"] = ordered_json::array();
  for (const auto& [what, how] : outcome.derived) report["derived"].push_back({{"what", what}, {"how", how}});
  report["warnings"] = outcome.warnings;
  report["files"] = filesIn(folder);
  report["timings_seconds"] = ordered_json::object();
  for (const auto& [stage, seconds] : timingsSeconds)
    report["timings_seconds"][stage] = rounded(seconds, 1000);
  return report;
}

}  // namespace cloudgen::cli
