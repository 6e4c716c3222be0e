// SPDX-License-Identifier: Apache-2.0
// A described sky, written as a cloud analysis and read again, is the same sky.
#include <gtest/gtest.h>

#include <map>

#include "input/catalogue.hpp"
#include "input/described/described.hpp"
#include "unit/input/cdfs_support.hpp"

namespace cloudgen::input {
namespace {

const std::string kSky =
    R"({"cloudgen_sky": 1, "valid_time": "2011-01-15T12:00:00Z", "bbox": [-30, -40, 60, 70],
  "grid": {"columns": 3, "rows": 2}, "layers": [
  {"genus": "Cu", "cover": 0.33, "base_m": 1003, "top_m": 2207, "optical_depth": 8.4, "cells": [[0,0],[1,1]]},
  {"genus": "Cb", "cover": 0.2, "base_m": 900, "top_m": 13700, "optical_depth": 80, "cells": [[2,0]]},
  {"genus": "As", "cover": 0.755, "base_m": 3900, "top_m": 5600, "optical_depth": 7, "cells": [[0,0],[2,1]]},
  {"genus": "Ci", "cover": 0.5, "base_m": 9000, "top_m": 10400, "optical_depth": 0.7}]})";

using LayersByCell = std::map<std::uint32_t, std::vector<field::StatedLayer>>;

LayersByCell byCell(const field::Source& source) {
  LayersByCell cells;
  for (const field::StatedLayer& layer : layersOf(source)) cells[layer.cell].push_back(layer);
  return cells;
}

/// Every cell of the analysis tells the layers of the sky at its centre.
void expectSameSky(const field::Source& analysis, bool basesToo) {
  const auto sky = readDescribedSky(kSky, "sky");
  const field::CellFinder finder(sky->grid());
  const LayersByCell wanted = byCell(*sky), told = byCell(analysis);
  std::size_t cloudy = 0;
  for (std::uint32_t cell = 0; cell < analysis.grid().size(); ++cell) {
    if (field::cellAreaSquareMeters(analysis.grid(), cell) == 0) continue;
    const auto place = finder.at(field::centerOf(analysis.grid(), cell));
    if (!place) {
      EXPECT_FALSE(told.contains(cell));
      continue;
    }
    const auto& there = wanted.at(*place);
    ASSERT_TRUE(told.contains(cell));
    const auto& here = told.at(cell);
    ASSERT_EQ(here.size(), there.size());
    ++cloudy;
    for (std::size_t i = 0; i < here.size(); ++i) {
      // Without bases, layers may come in another order.
      const auto same = std::find_if(there.begin(), there.end(), [&](const field::StatedLayer& layer) {
        return layer.genus == here[i].genus;
      });
      ASSERT_NE(same, there.end());
      EXPECT_NEAR(here[i].coverFraction, same->coverFraction, 0.00501f);
      EXPECT_NEAR(here[i].topMeters, same->topMeters, 0.5f);
      if (!basesToo) continue;
      EXPECT_NEAR(here[i].baseMeters, same->baseMeters, 0.5f);
      EXPECT_NEAR(here[i].opticalDepth, same->opticalDepth, 0.0501f);
    }
  }
  EXPECT_GT(cloudy, 50u);
}

TEST(RoundTrip, OfADescribedSkyThroughGrib) {
  const test::Scratch scratch;
  const auto sky = readDescribedSky(kSky, "sky");
  for (const bool south : {false, true}) test::writeWwmcaGrib(test::sampled(*sky, south, 64), scratch.path());
  expectSameSky(*open({scratch.path()}), true);
}

TEST(RoundTrip, OfADescribedSkyThroughRawFilesOfEitherOrder) {
  const auto sky = readDescribedSky(kSky, "sky");
  for (const std::endian order : {std::endian::big, std::endian::little}) {
    const test::Scratch scratch;
    auto files = test::writeWwmcaRaw(test::sampled(*sky, false, 64), scratch.path(), order);
    for (const auto& file : test::writeWwmcaRaw(test::sampled(*sky, true, 64), scratch.path(), order))
      files.push_back(file);
    expectSameSky(*openCdfs(files, {}, 64), false);
  }
}

}  // namespace
}  // namespace cloudgen::input
