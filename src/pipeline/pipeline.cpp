// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "field/collect.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/isccp.hpp"
#include "pipeline/location.hpp"
#include "pipeline/origin.hpp"
#include "pipeline/production.hpp"
#include "pipeline/quantity.hpp"
#include "pipeline/steps.hpp"
#include "pipeline/type.hpp"

namespace cloudgen::pipeline {
namespace {

using Cells = std::vector<std::uint32_t>;

using Winds = std::vector<field::WindAloft>;

std::vector<field::Layer> layersFrom(const field::Source& source, const Cells& cells, Outcome& outcome, Winds& winds) {
  if (source.telling() == field::Telling::Layers) {
    auto layers = locateLayers(source, cells);
    outcome.cells = layers.size();
    return layers;
  }
  field::CloudColumns columns = field::collectColumns(source, cells);
  winds = std::move(columns.winds);
  outcome.cells = columns.cells.size();
  outcome.derived = columns.derived;
  outcome.derived.emplace_back("cover of a layer", "maximum overlap of its levels");
  outcome.derived.emplace_back("genus", "rules in the order of CDFS II: signature, extent, height");
  return locateLayers(columns);
}

/// The layers of the model and of the typing joined on the finer grid, in the cells of the box.
std::vector<field::Layer> pairedLayersFrom(const field::Source& model, const field::Source& typing,
                                           bool typingFiner, const Origin& origin, Outcome& outcome,
                                           Winds& winds) {
  const base::GeoBox& box = origin.frame.box();
  const base::GeoBox grown = grownBox(model.grid(), typing.grid(), box);
  const base::GeoBox around = grownBox(model.grid(), typing.grid(), grown);
  const Cells modelCells = field::cellsTouching(model.grid(), typingFiner ? around : grown),
              typingCells = field::cellsTouching(typing.grid(), typingFiner ? grown : around);
  auto paired =
      pairLayers(model.grid(), layersFrom(model, modelCells, outcome, winds), typing.grid(),
                 locateLayers(typing, typingCells), typingFiner, typingFiner ? typingCells : modelCells);
  std::erase_if(paired.layers, [&](const field::Layer& layer) {
    return !std::binary_search(origin.cells.begin(), origin.cells.end(), layer.cell);
  });
  outcome.pairing = paired.pairing;
  return std::move(paired.layers);
}

/// Names without folders: a scene must not tell where it was made.
std::vector<std::string> fileNames(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(std::filesystem::path(file).filename().string());
  return names;
}

}  // namespace

Located locate(const field::Source& source, const Options& options, const base::Progress& progress) {
  progress.step("origin", 0);
  const field::Source* const typing = options.typing;
  const base::GeoBox wanted = options.box.value_or(field::extent(source.grid()));
  const Overlay overlay = typing ? overlayOf(source.grid(), typing->grid(), wanted) : Overlay{};
  const bool typingFiner = overlay.standOnTyping();
  const field::Grid& grid = typingFiner ? typing->grid() : source.grid();
  Origin origin = locateOrigin(source, grid, options);
  Outcome outcome{scene::Scene{origin.frame}};
  outcome.columns = origin.cells.size();

  progress.step("location", 0.05);
  field::CloudTable table;
  Winds winds;
  table.layers = typing ? pairedLayersFrom(source, *typing, typingFiner, origin, outcome, winds)
                        : layersFrom(source, origin.cells, outcome, winds);
  outcome.layers = table.layers.size();
  outcome.patches = joinPatches(grid, table.layers);

  progress.step("type", 0.2);
  auto surroundings = typeLayers(grid, table.layers);
  outcome.isccp = isccpConfusion(table.layers);
  return {grid, std::move(origin), std::move(table), std::move(surroundings), std::move(outcome),
          typing ? overlay.typedShare : 1.0, source.grid(), std::move(winds)};
}

Outcome finish(Located&& located, const field::Source& source, const Generalisation& general, const Options& options,
               const base::Progress& progress) {
  auto& [grid, origin, table, surroundings, outcome, typedShare, windGrid, winds] = located;
  outcome.enlargement = enlargementOf(general, table.layers, options);
  standOnTerrain(origin.ground, origin.frame, table);

  progress.step("production", 0.4);
  outcome.cloudyLayers = layersWithClouds(table, surroundings);
  outcome.scene = produce(table, origin, options, general, source.info().validTime, progress);
  outcome.scene.provenance = {fileNames(source.info().files), source.info().format, source.info().model,
                              source.info().run ? base::isoText(*source.info().run) : std::string()};
  for (const field::Warning& warning : source.info().warnings) outcome.warnings.push_back(warning.text);
  if (typedShare < 1)
    outcome.warnings.push_back(fmt::format(
        "the typing covers {:.0f} % of the box: clouds stand in the model's cells, and where it has "
        "nothing they are typed by rule; take a --bbox inside it for its own detail",
        100 * typedShare));
  if (options.typing)
    for (const field::Warning& warning : options.typing->info().warnings)
      outcome.warnings.push_back("typing: " + warning.text);
  outcome.warnings.insert(outcome.warnings.end(), origin.warnings.begin(), origin.warnings.end());
  if (outcome.enlargement > 1.01)
    outcome.warnings.push_back(
        fmt::format("the puff budget of {} draws clouds {:.1f} times as wide as natural, and fewer; raise "
                    "--max-puffs or take a smaller --bbox for natural sizes",
                    options.maxPuffs, outcome.enlargement));
  const std::uint64_t drawn = scene::drawnPuffs(outcome.scene);
  if (static_cast<double>(drawn) > 1.5 * static_cast<double>(options.maxPuffs))
    outcome.warnings.push_back(fmt::format(
        "the puff budget of {} is too small for this sky, {} puffs are drawn; take a smaller --bbox",
        options.maxPuffs, drawn));
  if (table.clouds.empty())
    outcome.warnings.push_back("the model has no cloud in this box: the sky is clear");
  return std::move(outcome);
}

Outcome run(const field::Source& source, const Options& options, const base::Progress& progress) {
  Located located = locate(source, options, progress);
  progress.step("quantity", 0.25);
  const Generalisation general =
      placeWithinBudget(located.grid, located.origin.frame, located.origin.cells, options, located.table);
  return finish(std::move(located), source, general, options, progress);
}

}  // namespace cloudgen::pipeline
