// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/time.hpp"
#include "cli/command.hpp"
#include "input/catalogue.hpp"

namespace cloudgen::cli {
namespace {

struct InspectOptions {
  std::vector<std::filesystem::path> inputs;
  bool asJson = false;
};

std::string runText(const field::SourceInfo& info) { return info.run ? base::isoText(*info.run) : ""; }

std::vector<std::string> texts(const std::vector<field::Warning>& warnings) {
  std::vector<std::string> lines;
  for (const field::Warning& warning : warnings) lines.push_back(warning.text);
  return lines;
}

nlohmann::ordered_json warningsJson(const field::SourceInfo& info) {
  auto array = nlohmann::ordered_json::array();
  for (const field::Warning& warning : info.warnings)
    array.push_back({{"id", warning.id}, {"text", warning.text}});
  return array;
}

std::string inspectedJson(const field::Source& source) {
  const field::SourceInfo& info = source.info();
  const field::Grid& grid = source.grid();
  const base::GeoBox box = field::extent(grid);
  nlohmann::ordered_json json{
      {"files", info.files},
      {"format", info.format},
      {"model", info.model},
      {"run", runText(info)},
      {"valid_time", base::isoText(info.validTime)},
      {"grid",
       {{"crs", grid.crs},
        {"columns", grid.columns},
        {"rows", grid.rows},
        {"first", {grid.firstX, grid.firstY}},
        {"step", {grid.stepX, grid.stepY}},
        {"wraps_longitude", grid.wrapsLongitude}}},
      {"bbox", {box.west, box.south, box.east, box.north}},
      {"levels", {{"kind", info.levels.kind}, {"unit", info.levels.unit}, {"values", info.levels.values}}},
      {"fields", info.fields},
      {"missing", info.missing},
      {"warnings", warningsJson(info)}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string paragraph(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  return fmt::format("{}:\n  {}\n", title, fmt::join(lines, "\n  "));
}

std::string inspectedText(const field::Source& source) {
  const field::SourceInfo& info = source.info();
  const field::Grid& grid = source.grid();
  const base::GeoBox box = field::extent(grid);
  std::string text = fmt::format("format:     {}\nmodel:      {}\n", info.format, info.model);
  if (info.run) text += fmt::format("run:        {}\n", runText(info));
  text += fmt::format("valid time: {}\n", base::isoText(info.validTime));
  text += fmt::format("grid:       {} x {} cells of {:g} x {:g} degrees{}\n", grid.columns, grid.rows,
                      std::abs(grid.stepX), std::abs(grid.stepY),
                      grid.wrapsLongitude ? ", all around the Earth" : "");
  text += fmt::format("box:        {:g},{:g},{:g},{:g} (west, south, east, north)\n", box.west, box.south,
                      box.east, box.north);
  if (!info.levels.values.empty())
    text += fmt::format("levels:     {} {} levels, {:g} to {:g} {}\n", info.levels.values.size(),
                        info.levels.kind, info.levels.values.front(), info.levels.values.back(),
                        info.levels.unit);
  text += paragraph("used", info.fields) + paragraph("not in the input", info.missing) +
          paragraph("warnings", texts(info.warnings));
  text.pop_back();
  return text;
}

}  // namespace

std::function<int()> setupInspect(CLI::App& app, const Terminal&) {
  auto options = std::make_shared<InspectOptions>();
  app.add_option("INPUT", options->inputs, "model output (GRIB) or a described sky")->required();
  app.add_flag("--json", options->asJson, "for machines");
  return [options]() -> int {
    const auto source = input::open(options->inputs);
    print(options->asJson ? inspectedJson(*source) : inspectedText(*source));
    return 0;
  };
}

}  // namespace cloudgen::cli
