// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/time.hpp"
#include "cli/command.hpp"
#include "cli/input_options.hpp"
#include "field/value_traps.hpp"

namespace cloudgen::cli {
namespace {

using nlohmann::ordered_json;

struct InspectOptions {
  InputLine input;
  bool asJson = false;
};

/// What is known only after the data were read.
struct Survey {
  std::vector<field::Warning> warnings;
  std::uint64_t layers = 0;
  std::map<std::string, std::uint64_t>
      genera;  ///< of stated layers; "by rule" where the source leaves it open
};

Survey surveyOf(const field::Source& source) {
  const std::vector<std::uint32_t> cells = field::everyCell(source.grid());
  Survey survey;
  field::ValueTraps traps;
  if (source.telling() == field::Telling::Levels)
    source.visitLevels(cells, [&](const field::Level& level) { traps.look(level); });
  else
    source.visitLayers(cells, [&](const field::StatedLayer& layer) {
      ++survey.layers;
      ++survey.genera[layer.genus ? std::string(base::abbreviation(*layer.genus)) : "by rule"];
    });
  survey.warnings = source.info().warnings;
  const auto found = traps.warnings();
  survey.warnings.insert(survey.warnings.end(), found.begin(), found.end());
  return survey;
}

std::string runText(const field::SourceInfo& info) { return info.run ? base::isoText(*info.run) : ""; }

std::string_view gridKind(const field::Grid& grid) {
  if (!grid.centers.empty()) return "curvilinear";
  if (!grid.southCrs.empty()) return "two hemispheres";
  if (!grid.reducedRows.empty()) return "reduced rows";
  return grid.rowY.empty() ? "lattice" : "uneven rows";
}

/// Sides of the cell in the middle, in km.
glm::dvec2 cellKilometers(const field::Grid& grid) {
  return field::cellSidesMeters(grid, grid.size() / 2 + static_cast<std::uint32_t>(grid.columns) / 2) /
         1000.0;
}

ordered_json gridJson(const field::Grid& grid) {
  const glm::dvec2 sides = cellKilometers(grid);
  return {{"kind", gridKind(grid)},
          {"crs", grid.crs},
          {"columns", grid.columns},
          {"rows", grid.rows},
          {"cells", grid.size()},
          {"first", {grid.firstX, grid.firstY}},
          {"step", {grid.stepX, grid.stepY}},
          {"cell_km", {sides.x, sides.y}},
          {"wraps_longitude", grid.wrapsLongitude}};
}

ordered_json warningsJson(const std::vector<field::Warning>& warnings) {
  auto array = ordered_json::array();
  for (const field::Warning& warning : warnings)
    array.push_back({{"id", warning.id}, {"text", warning.text}});
  return array;
}

std::vector<std::string> isoTexts(const std::vector<base::UtcTime>& times) {
  std::vector<std::string> texts;
  for (const base::UtcTime time : times) texts.push_back(base::isoText(time));
  return texts;
}

std::string inspectedJson(const field::Source& source, const Survey& survey) {
  const field::SourceInfo& info = source.info();
  const base::GeoBox box = field::extent(source.grid());
  const bool levels = source.telling() == field::Telling::Levels;
  ordered_json json{
      {"files", info.files},
      {"format", info.format},
      {"model", info.model},
      {"run", info.run ? ordered_json(runText(info)) : ordered_json(nullptr)},
      {"valid_time", base::isoText(info.validTime)},
      {"valid_times", isoTexts(info.validTimes)},
      {"tells", levels ? "levels" : "layers"},
      {"grid", gridJson(source.grid())},
      {"bbox", {box.west, box.south, box.east, box.north}},
      {"levels", {{"kind", info.levels.kind}, {"unit", info.levels.unit}, {"values", info.levels.values}}},
      {"layers", {{"count", survey.layers}, {"genera", ordered_json(survey.genera)}}},
      {"fields", info.fields},
      {"unused", info.unused},
      {"missing", info.missing},
      {"warnings", warningsJson(survey.warnings)}};
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace);
}

std::string paragraph(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  return fmt::format("{}:\n  {}\n", title, fmt::join(lines, "\n  "));
}

std::string timesText(const field::SourceInfo& info) {
  std::string text = fmt::format("valid time: {}\n", base::isoText(info.validTime));
  if (info.validTimes.size() > 1)
    text += fmt::format("all times:  {} from {} to {}\n", info.validTimes.size(),
                        base::isoText(info.validTimes.front()), base::isoText(info.validTimes.back()));
  return text;
}

std::string gridText(const field::Grid& grid) {
  const base::GeoBox box = field::extent(grid);
  const glm::dvec2 sides = cellKilometers(grid);
  return fmt::format(
      "grid:       {} x {} cells ({}), about {:.3g} x {:.3g} km{}\nprojection: {}\n"
      "box:        {:.6g},{:.6g},{:.6g},{:.6g} (west, south, east, north)\n",
      grid.columns, grid.rows, gridKind(grid), sides.x, sides.y,
      grid.wrapsLongitude ? ", all around the Earth" : "", grid.crs, box.west, box.south, box.east,
      box.north);
}

std::string layersText(const Survey& survey) {
  std::vector<std::string> genera;
  for (const auto& [genus, count] : survey.genera) genera.push_back(fmt::format("{} {}", count, genus));
  return fmt::format("layers:     {} ({})\n", survey.layers, fmt::join(genera, ", "));
}

std::string inspectedText(const field::Source& source, const Survey& survey) {
  const field::SourceInfo& info = source.info();
  std::string text = fmt::format("format:     {}\nmodel:      {}\n", info.format, info.model);
  if (info.run) text += fmt::format("run:        {}\n", runText(info));
  text += timesText(info) + gridText(source.grid());
  if (!info.levels.values.empty())
    text += fmt::format("levels:     {} {} levels, {:g} to {:g}{}{}\n", info.levels.values.size(),
                        info.levels.kind, info.levels.values.front(), info.levels.values.back(),
                        info.levels.unit.empty() ? "" : " ", info.levels.unit);
  if (source.telling() == field::Telling::Layers) text += layersText(survey);
  std::vector<std::string> warnings;
  for (const field::Warning& warning : survey.warnings) warnings.push_back(warning.text);
  text += paragraph("used", info.fields) + paragraph("known but not used", info.unused) +
          paragraph("not in the input", info.missing) + paragraph("warnings", warnings);
  text.pop_back();
  return text;
}

}  // namespace

std::function<int()> setupInspect(CLI::App& app, const Terminal&) {
  auto options = std::make_shared<InspectOptions>();
  addInputOptions(app, options->input);
  app.add_flag("--json", options->asJson, "for machines: schemas/inspect.schema.json");
  return [options]() -> int {
    const auto source = openInput(options->input);
    const Survey survey = surveyOf(*source);
    print(options->asJson ? inspectedJson(*source, survey) : inspectedText(*source, survey));
    return 0;
  };
}

}  // namespace cloudgen::cli
