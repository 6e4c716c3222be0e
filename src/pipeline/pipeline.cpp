// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pipeline.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "field/collect.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/location.hpp"
#include "pipeline/origin.hpp"
#include "pipeline/production.hpp"
#include "pipeline/quantity.hpp"
#include "pipeline/size.hpp"
#include "pipeline/type.hpp"

namespace cloudgen::pipeline {
namespace {

std::vector<field::Layer> layersFrom(const field::Source& source, const Origin& origin, Outcome& outcome) {
  if (source.telling() == field::Telling::Layers) {
    auto layers = locateLayers(source, origin.cells);
    outcome.cells = layers.size();
    return layers;
  }
  const field::CloudColumns columns = field::collectColumns(source, origin.cells);
  outcome.cells = columns.cells.size();
  outcome.derived = columns.derived;
  outcome.derived.emplace_back("cover of a layer", "maximum overlap of its levels");
  outcome.derived.emplace_back("genus", "rules in the order of CDFS II: signature, extent, height");
  return locateLayers(columns);
}

/// Names without folders: a scene must not tell where it was made.
std::vector<std::string> fileNames(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const std::string& file : files) names.push_back(std::filesystem::path(file).filename().string());
  return names;
}

}  // namespace

Outcome run(const field::Source& source, const Options& options, const base::Progress& progress) {
  progress.step("origin", 0);
  Origin origin = locateOrigin(source, options);
  const base::GeoBox& box = origin.frame.box();
  Outcome outcome{scene::Scene{origin.frame}};
  outcome.columns = origin.cells.size();

  progress.step("location", 0.05);
  field::CloudTable table;
  table.layers = layersFrom(source, origin, outcome);
  outcome.layers = table.layers.size();
  outcome.patches = joinPatches(source.grid(), table.layers);

  progress.step("type", 0.2);
  typeLayers(source.grid(), table.layers);

  progress.step("quantity", 0.25);
  const Generalisation general = generalise(source.grid(), table.layers, options, box);
  outcome.enlargement = general.enlargement;
  placeClouds(source.grid(), options, general, box, table);

  progress.step("size", 0.35);
  sizeClouds(options, general, table);

  progress.step("production", 0.4);
  outcome.scene = produce(table, origin, options, general, source.info().validTime, progress);
  outcome.scene.provenance = {fileNames(source.info().files), source.info().format, source.info().model,
                              source.info().run ? base::isoText(*source.info().run) : std::string()};
  for (const field::Warning& warning : source.info().warnings) outcome.warnings.push_back(warning.text);
  outcome.warnings.insert(outcome.warnings.end(), origin.warnings.begin(), origin.warnings.end());
  if (general.enlargement > 1.01)
    outcome.warnings.push_back(
        fmt::format("the puff budget of {} draws clouds {:.1f} times as wide as natural, and fewer; raise "
                    "--max-puffs or take a smaller --bbox for natural sizes",
                    options.maxPuffs, general.enlargement));
  const std::uint64_t drawn = scene::drawnPuffs(outcome.scene);
  if (static_cast<double>(drawn) > 1.5 * static_cast<double>(options.maxPuffs))
    outcome.warnings.push_back(fmt::format(
        "the puff budget of {} is too small for this sky, {} puffs are drawn; take a smaller --bbox",
        options.maxPuffs, drawn));
  if (table.clouds.empty())
    outcome.warnings.push_back("the model has no cloud in this box: the sky is clear");
  return outcome;
}

}  // namespace cloudgen::pipeline
