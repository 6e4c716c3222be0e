// SPDX-License-Identifier: Apache-2.0
#include "input/described/described.hpp"

#include "base/error.hpp"

namespace cloudgen::input {
namespace {

const std::string kLayer =
    R"({"genus":"Cu","cover":0.4,"base_m":1100,"top_m":2600,"optical_depth":25,"wind":[5,1],"shear":[3,0]})";

std::string sky(const std::string& layers, const std::string& more = "") {
  return R"({"cloudgen_sky":1,"title":"test","valid_time":"2011-06-15T18:00:00Z","bbox":[-122.6,36.2,-121.2,37.2],)" +
         more + R"("layers":[)" + layers + "]}";
}

std::vector<std::uint32_t> allCells(const field::Source& source) {
  return field::cellsTouching(source.grid(), field::extent(source.grid()));
}

std::vector<field::StatedLayer> layersOf(const field::Source& source,
                                         const std::vector<std::uint32_t>& cells) {
  std::vector<field::StatedLayer> layers;
  source.visitLayers(cells, [&](const field::StatedLayer& layer) { layers.push_back(layer); });
  return layers;
}

TEST(DescribedSky, GivesItsLayersInOneCell) {
  const auto source = readDescribedSky(sky(kLayer), "a.sky.json");
  EXPECT_EQ(source->info().format, "described sky");
  EXPECT_EQ(source->info().model, "test");
  EXPECT_EQ(base::isoText(source->info().validTime), "2011-06-15T18:00:00Z");
  EXPECT_NEAR(field::extent(source->grid()).west, -122.6, 1e-9);
  EXPECT_NEAR(field::extent(source->grid()).north, 37.2, 1e-9);
  const auto layers = layersOf(*source, allCells(*source));
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers[0].genus, base::Genus::Cumulus);
  EXPECT_FLOAT_EQ(layers[0].opticalDepth, 25);
  EXPECT_FLOAT_EQ(layers[0].windNorth, 1);
  EXPECT_FLOAT_EQ(layers[0].shearEast, 3);
  bool visited = false;
  source->visitLevels({}, [&](const field::Level&) { visited = true; });
  EXPECT_FALSE(visited);
}

TEST(DescribedSky, LayersLieInTheirCellsLowestFirst) {
  const std::string high = R"({"genus":"cirrus","cover":1,"base_m":9000,"top_m":10000,"optical_depth":1})";
  const std::string low =
      R"({"genus":"St","cover":1,"base_m":300,"top_m":700,"optical_depth":9,"cells":[[2,1],[0,0]]})";
  const auto source =
      readDescribedSky(sky(high + "," + low, R"("surface_m":50,"grid":{"columns":3,"rows":2},)"), "a");
  const auto cells = allCells(*source);
  ASSERT_EQ(cells.size(), 6u);
  const auto layers = layersOf(*source, cells);
  ASSERT_EQ(layers.size(), 8u);
  EXPECT_EQ(layers[0].cell, 0u);
  EXPECT_EQ(layers[0].genus, base::Genus::Stratus);
  EXPECT_EQ(layers[1].genus, base::Genus::Cirrus);
  EXPECT_EQ(layers[6].cell, 5u);
  EXPECT_EQ(layers[6].genus, base::Genus::Stratus);
  EXPECT_EQ(source->surface(cells).heightMeters, std::vector<float>(6, 50.0f));
  EXPECT_EQ(layersOf(*source, {4}).size(), 1u);
}

TEST(DescribedSky, ComplaintsNameThePlace) {
  const auto layerWith = [](const std::string& from, const std::string& to) {
    std::string layer = kLayer;
    return sky(layer.replace(layer.find(from), from.size(), to));
  };
  const std::pair<std::string, std::string> kCases[] = {
      {"{", "line 1"},
      {"{\n\n\"a\":]}", "line 3"},
      {"[]", "/"},
      {R"({"cloudgen_sky":2})", "/cloudgen_sky"},
      {layerWith("\"Cu\"", "\"Cx\""), "/layers/0/genus"},
      {layerWith("0.4", "40"), "/layers/0/cover"},
      {layerWith("2600", "1000"), "/layers/0/top_m"},
      {layerWith("25", "\"thick\""), "/layers/0/optical_depth"},
      {layerWith("[5,1]", "[5]"), "/layers/0/wind"},
      {layerWith("[3,0]", "[3,1e9]"), "/layers/0/shear/1"},
      {layerWith("cover", "covr"), "did you mean \"cover\""},
      {layerWith("\"shear\":[3,0]", "\"cells\":[3]"), "/layers/0/cells/0"},
      {layerWith("\"shear\":[3,0]", "\"cells\":[[0,0],[1,0]]"), "/layers/0/cells"},
      {sky(kLayer, R"("surface_m":2000,)"), "/layers/0/base_m"},
      {sky(kLayer, R"("grid":{"columns":0,"rows":1},)"), "/grid/columns"},
      {sky(kLayer, R"("grid":{"columns":1.5,"rows":1},)"), "/grid/columns"},
      {sky(kLayer + "," + kLayer, R"("grid":{"columns":2000,"rows":2000},)"), "/layers"},
      {R"({"cloudgen_sky":1,"valid_time":"noon"})", "/valid_time"},
      {R"({"cloudgen_sky":1,"valid_time":"2020-01-01","bbox":[0,10,5,10],"layers":[]})", "/bbox"},
      {R"({"cloudgen_sky":1,"valid_time":"2020-01-01","bbox":[0,10,5,1e999],"layers":[]})", "a.sky.json"},
  };
  for (const auto& [text, place] : kCases) {
    try {
      readDescribedSky(text, "a.sky.json");
      ADD_FAILURE() << "read: " << text;
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  }
}

TEST(DescribedSky, MayLieAcrossTheAntimeridianOrAroundTheEarth) {
  const auto box = [](const std::string& bbox, int columns) {
    return readDescribedSky(R"({"cloudgen_sky":1,"valid_time":"2020-01-01","bbox":)" + bbox +
                                R"(,"grid":{"columns":)" + std::to_string(columns) +
                                R"(,"rows":1},"layers":[]})",
                            "a");
  };
  const auto pacific = box("[170,-10,-170,10]", 4);
  EXPECT_DOUBLE_EQ(pacific->grid().stepX, 5);
  EXPECT_EQ(field::cellsTouching(pacific->grid(), {179, 0, -179, 1}).size(), 2u);
  EXPECT_TRUE(box("[0,-90,360,90]", 36)->grid().wrapsLongitude);
}

}  // namespace
}  // namespace cloudgen::input
