// SPDX-License-Identifier: Apache-2.0
// The thesis's pair on real moisture: GFS with a made cloud analysis, judged cloud by cloud.
#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/file.hpp"
#include "input/catalogue.hpp"
#include "input/described/described.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/steps.hpp"
#include "support/made_source.hpp"
#include "support/made_wwmca.hpp"
#include "support/scratch.hpp"

namespace cloudgen {
namespace {

namespace fs = std::filesystem;

const fs::path kGfs = fs::path(CLOUDGEN_SHARED_DIR) / "data" / "gfs_2p5_20110110_f120.grib2";

/// Checkers of 1 degree with other genera in each of three kinds of square; one kind is clear.
std::string checkeredSky() {
  std::string cells[3];
  for (int row = 0; row < 25; ++row)
    for (int column = 0; column < 40; ++column) {
      std::string& list = cells[(2 * row + column) % 3];
      list += (list.empty() ? "[" : ",[") + std::to_string(column) + "," + std::to_string(row) + "]";
    }
  return R"({"cloudgen_sky": 1, "valid_time": "2011-01-15T12:00:00Z", "bbox": [-100, 25, -60, 50],
    "grid": {"columns": 40, "rows": 25}, "layers": [
      {"genus": "Cu", "cover": 0.4, "base_m": 1200, "top_m": 2600, "optical_depth": 10, "cells": [)" +
         cells[0] + R"(]},
      {"genus": "Sc", "cover": 0.8, "base_m": 800, "top_m": 1500, "optical_depth": 9, "cells": [)" +
         cells[1] + R"(]},
      {"genus": "Ci", "cover": 0.5, "base_m": 9000, "top_m": 10000, "optical_depth": 1, "cells": [)" +
         cells[1] + "]}]}";
}

class Pair : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    if (!fs::exists(kGfs)) GTEST_SKIP() << "no " << kGfs;
    const auto sky = input::readDescribedSky(checkeredSky(), "typing.sky.json");
    const test::MadeAnalysis north = test::sampled(*sky, false);
    if (GetParam())
      test::writeWwmcaRaw(north, folder.path());
    else
      test::writeWwmcaGrib(north, folder.path());
    model = input::open({kGfs});
    typing = input::open({folder.path()}, {.time = model->info().validTime});
    options.typing = typing.get();
    options.box = base::GeoBox{-95, 28, -65, 47};
  }

  const test::Scratch folder;
  std::unique_ptr<field::Source> model, typing;
  pipeline::Options options = test::usualOptions(40'000);
};

class OfEitherFormat : public Pair {};

TEST_P(OfEitherFormat, LayersHaveTheGeneraOfTheTyping) {
  const auto pairing = pipeline::locate(*model, options, {}).outcome.pairing;
  ASSERT_TRUE(pairing);
  EXPECT_GT(pairing->typedColumns, 5000u);
  EXPECT_GE(static_cast<double>(pairing->agreeingColumns), 0.99 * static_cast<double>(pairing->typedColumns));
  EXPECT_NEAR(pairing->keptCover / pairing->modelCover, 1, 0.02);
}

TEST_P(Pair, CloudsHaveTheGeneraOfTheTyping) {
  options.box = base::GeoBox{-86, 34, -81, 38};
  const pipeline::Outcome outcome = pipeline::run(*model, options, {});
  std::map<std::uint32_t, std::set<base::Genus>> typed;
  std::vector<std::uint32_t> cells = field::cellsTouching(typing->grid(), *options.box);
  typing->visitLayers(cells,
                      [&](const field::StatedLayer& layer) { typed[layer.cell].insert(*layer.genus); });
  const field::CellFinder finder(typing->grid());
  std::size_t inTyped = 0, agreeing = 0;
  for (const auto& cloud : outcome.scene.clouds) {
    const auto cell = finder.at({cloud.longitudeDegrees, cloud.latitudeDegrees});
    const auto found = cell ? typed.find(*cell) : typed.end();
    if (found == typed.end()) continue;
    ++inTyped;
    agreeing += found->second.contains(cloud.genus);
  }
  EXPECT_GT(inTyped, 200u);
  EXPECT_GE(static_cast<double>(agreeing), 0.99 * static_cast<double>(inTyped));
}

INSTANTIATE_TEST_SUITE_P(GribAndRaw, OfEitherFormat, testing::Bool());
INSTANTIATE_TEST_SUITE_P(Grib, Pair, testing::Values(false));

}  // namespace
}  // namespace cloudgen
