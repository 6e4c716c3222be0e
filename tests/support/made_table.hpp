// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/generalisation.hpp"
#include "pipeline/location.hpp"
#include "pipeline/quantity.hpp"
#include "support/made_source.hpp"

namespace cloudgen::test {

/// The whole table of a made model: steps 2 to 5.
struct MadeTable {
  MadeTable(const MadeSource& source, const pipeline::Options& options)
      : MadeTable(source, options, layersOf(source)) {}
  MadeTable(const MadeSource& source, const pipeline::Options& options, std::vector<field::Layer> layers) {
    const base::GeoBox box = options.box.value_or(field::extent(source.grid()));
    table.layers = std::move(layers);
    const std::vector<std::uint32_t> cells = field::cellsTouching(source.grid(), box);
    general = pipeline::placeWithinBudget(source.grid(), base::LocalFrame(box), cells, options, table);
  }
  /// With a generalisation that was decided before.
  MadeTable(const MadeSource& source, const pipeline::Options& options, const pipeline::Generalisation& given)
      : general(given) {
    const base::GeoBox box = options.box.value_or(field::extent(source.grid()));
    table.layers = layersOf(source);
    const std::vector<std::uint32_t> cells = field::cellsTouching(source.grid(), box);
    pipeline::FootprintBook footprints(options, general);
    pipeline::placeClouds(source.grid(), base::LocalFrame(box), cells, options, general, footprints, table);
  }

  static std::vector<field::Layer> layersOf(const MadeSource& source) {
    return pipeline::locateLayers(source, field::cellsTouching(source.grid(), field::extent(source.grid())));
  }

  pipeline::Generalisation general;
  field::CloudTable table;
};

}  // namespace cloudgen::test
