// SPDX-License-Identifier: Apache-2.0
#include "input/weather_code/weather_code.hpp"

#include "base/error.hpp"
#include "input/catalogue.hpp"
#include "support/scratch.hpp"

namespace cloudgen::input {
namespace {

using base::Genus;

std::string entry(const std::string& code, const std::string& more = R"(,"temp":16,"wd":270,"ws":5)") {
  return R"({"s":")" + code + R"(","t":"2024-02-05T08:00Z")" + more + "}";
}

std::string forecast(const std::string& entries, const std::string& place = R"("lat":60.2,"lon":24.9,)") {
  return R"({"id":"1",)" + place + R"("weather":[)" + entries + "]}";
}

std::unique_ptr<field::Source> read(const std::string& text, const OpenOptions& options = {}) {
  return skyOfPlaces(readForecaJson(text, "a.json"), {"a.json"}, options);
}

std::vector<field::StatedLayer> layersOf(const field::Source& source) {
  std::vector<field::StatedLayer> layers;
  source.visitLayers(field::cellsTouching(source.grid(), field::extent(source.grid())),
                     [&](const field::StatedLayer& layer) { layers.push_back(layer); });
  return layers;
}

std::vector<field::StatedLayer> skyOf(const std::string& code) {
  return layersOf(*read(forecast(entry(code))));
}

int countOf(const std::vector<field::StatedLayer>& layers, std::initializer_list<Genus> genera) {
  int count = 0;
  for (const field::StatedLayer& layer : layers)
    if (std::find(genera.begin(), genera.end(), *layer.genus) != genera.end()) count += layer.cloudCount;
  return count;
}

bool has(const std::vector<field::StatedLayer>& layers, Genus genus) {
  return std::any_of(layers.begin(), layers.end(),
                     [&](const field::StatedLayer& layer) { return layer.genus == genus; });
}

std::string complaint(const std::string& text, const OpenOptions& options = {}) {
  try {
    read(text, options);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "was read";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(WeatherCode, CloudinessGivesTheCountsOfTheThesis) {
  EXPECT_TRUE(skyOf("d000").empty());
  const std::map<std::string, int> counts{{"d100", 10}, {"d200", 30}, {"d300", 75}, {"d400", 200},
                                          {"d220", 30}, {"d320", 75}, {"d240", 30}, {"d440", 200}};
  for (const auto& [code, count] : counts) {
    const auto layers = skyOf(code);
    EXPECT_EQ(countOf(layers, {Genus::Cumulus, Genus::Stratocumulus, Genus::Cumulonimbus}), count) << code;
    EXPECT_LE(countOf(layers, {Genus::Altostratus}), 2) << code;
    EXPECT_LE(countOf(layers, {Genus::Cirrus}), 2) << code;
  }
}

TEST(WeatherCode, LowCloudsBelowAltostratusBelowCirrus) {
  for (const std::string code : {"d300", "d400"}) {
    const auto layers = skyOf(code);
    ASSERT_GE(layers.size(), 3u);
    EXPECT_EQ(layers.back().genus, Genus::Cirrus);
    EXPECT_EQ(layers[layers.size() - 2].genus, Genus::Altostratus);
    for (std::size_t i = 1; i < layers.size(); ++i)
      EXPECT_GE(layers[i].baseMeters, layers[i - 1].baseMeters) << code;
    EXPECT_LT(layers[layers.size() - 3].topMeters, layers[layers.size() - 2].baseMeters) << code;
  }
}

TEST(WeatherCode, FewCumuliKeepApartAndManyDoNot) {
  EXPECT_GT(skyOf("d100")[0].spacingMeters, 1000);
  EXPECT_GT(skyOf("d200")[0].spacingMeters, 1000);
  EXPECT_EQ(skyOf("d300")[0].spacingMeters, 0);
  EXPECT_EQ(skyOf("d400")[0].spacingMeters, 0);
}

TEST(WeatherCode, EveryCodeIsASky) {
  for (const char letter : {'d', 'n'})
    for (char cloudiness = '0'; cloudiness <= '6'; ++cloudiness)
      for (char precipitation = '0'; precipitation <= '4'; ++precipitation)
        for (char kind = '0'; kind <= '2'; ++kind) {
          const std::string code{letter, cloudiness, precipitation, kind};
          const auto layers = skyOf(code);
          EXPECT_EQ(layers.empty(), cloudiness == '0' && precipitation == '0') << code;
          for (const field::StatedLayer& layer : layers) {
            EXPECT_GT(layer.topMeters, layer.baseMeters) << code;
            EXPECT_GT(layer.opticalDepth, 0) << code;
          }
        }
}

TEST(WeatherCode, PrecipitationNamesItsCloud) {
  EXPECT_TRUE(has(skyOf("d240"), Genus::Cumulonimbus));
  EXPECT_TRUE(has(skyOf("d430"), Genus::Nimbostratus));
  EXPECT_TRUE(has(skyOf("d410"), Genus::Nimbostratus));
  EXPECT_FALSE(has(skyOf("d210"), Genus::Nimbostratus));
  const auto showers = skyOf("d220");
  EXPECT_TRUE(std::any_of(showers.begin(), showers.end(), [](const field::StatedLayer& layer) {
    return layer.genus == Genus::Cumulus && layer.topMeters - layer.baseMeters > 3000;
  }));
  const auto fog = skyOf("d600");
  ASSERT_EQ(fog.size(), 1u);
  EXPECT_EQ(fog[0].genus, Genus::Fog);
  EXPECT_EQ(fog[0].baseMeters, 0);
  EXPECT_TRUE(has(skyOf("d500"), Genus::Cirrostratus));
}

TEST(WeatherCode, NightHasTheSameClouds) {
  const auto day = skyOf("d300"), night = skyOf("n300");
  ASSERT_EQ(day.size(), night.size());
  for (std::size_t i = 0; i < day.size(); ++i) {
    EXPECT_EQ(day[i].genus, night[i].genus);
    EXPECT_EQ(day[i].cloudCount, night[i].cloudCount);
    EXPECT_EQ(day[i].coverFraction, night[i].coverFraction);
  }
}

TEST(WeatherCode, DewPointSetsTheBase) {
  const auto base = [](const std::string& more) {
    return layersOf(*read(forecast(entry("d200", more))))[0].baseMeters;
  };
  EXPECT_NEAR(base(R"(,"temp":20,"dewPoint":12)"), 1000, 1);
  EXPECT_NEAR(base(R"(,"temperature":20,"relHumidity":100)"), 60, 1);
  EXPECT_NEAR(base(R"(,"maxT":33,"minT":18)"), 1875, 1);
  EXPECT_GT(base(R"(,"temp":30)"), base(R"(,"temp":0)"));
}

TEST(WeatherCode, WindComesFromItsDirectionAndGrowsUpwards) {
  const auto layers = skyOf("d300");
  EXPECT_GT(layers.front().windEast, 5);
  EXPECT_NEAR(layers.front().windNorth, 0, 0.01);
  EXPECT_GT(layers.back().windEast, layers.front().windEast);
  EXPECT_LT(layers.back().windEast, 5 * 3);
}

TEST(WeatherCode, OnePlaceIsASkyOfTwentyKilometres) {
  const auto source =
      read(forecast(entry("d100"), R"("location":{"lat":-80,"lon":179.99,"elevation":500},)"));
  EXPECT_EQ(source->grid().size(), 1u);
  const glm::dvec2 sides = field::cellSidesMeters(source->grid(), 0);
  EXPECT_NEAR(sides.x, 20000, 300);
  EXPECT_NEAR(sides.y, 20000, 300);
  EXPECT_GT(layersOf(*source)[0].baseMeters, 560);
  EXPECT_EQ(source->surface(std::vector<std::uint32_t>{0}).heightMeters, std::vector<float>{500});
}

TEST(WeatherCode, SkiesBetweenPlacesAreBetweenTheirs) {
  const auto source = read("[" + forecast(entry("d100"), R"("lat":0,"lon":179.8,)") + "," +
                           forecast(entry("d300"), R"("lat":0,"lon":-179.8,)") + "]");
  EXPECT_EQ(source->grid().rows, 1);
  ASSERT_EQ(source->grid().columns, 3);
  std::map<std::uint32_t, int> low;
  for (const field::StatedLayer& layer : layersOf(*source))
    if (layer.baseMeters < 3000) low[layer.cell] += layer.cloudCount;
  EXPECT_NEAR(low[0], 10, 10);
  EXPECT_NEAR(low[1], 42, 4);
  EXPECT_NEAR(low[2], 75, 10);
  EXPECT_LT(low[0], low[1]);
  EXPECT_LT(low[1], low[2]);
}

TEST(WeatherCode, TheTimeChoosesTheEntry) {
  const std::string two = forecast(entry("d000") + R"(,{"s":"d400","t":"2024-02-05T10:00+01:00"})");
  EXPECT_TRUE(layersOf(*read(two)).empty());
  OpenOptions options;
  options.time = base::utcFromIso("2024-02-05T09:00Z");
  const auto source = read(two, options);
  EXPECT_FALSE(layersOf(*source).empty());
  EXPECT_EQ(source->info().validTimes.size(), 2u);
  options.time = base::utcFromIso("2024-02-06T09:00Z");
  EXPECT_TRUE(holds(complaint(two, options), "2024-02-05T08:00:00Z to 2024-02-05T09:00:00Z"));
}

TEST(WeatherCode, ReadsDaysAndThePublicApi) {
  EXPECT_EQ(
      base::isoText(read(forecast(R"({"d":"2023-09-05","maxT":33,"minT":18,"s":"d100"})"))->info().validTime),
      "2023-09-05T00:00:00Z");
  const std::string api =
      R"({"location":{"lon":5.75,"lat":58.97},"forecast":[{"time":"2021-12-12T18:31+01:00","symbol":"n300",)"
      R"("temperature":6,"dewPoint":4,"windDir":150,"windSpeed":4}]})";
  EXPECT_EQ(base::isoText(read(api)->info().validTime), "2021-12-12T17:31:00Z");
  EXPECT_NEAR(layersOf(*read(api))[0].baseMeters, 250, 1);
}

TEST(WeatherCode, APlaceIsAskedFor) {
  const std::string nowhere = forecast(entry("d100"), "");
  EXPECT_TRUE(holds(complaint(nowhere), "--at LON,LAT"));
  OpenOptions options;
  options.place = Place{24.9, 60.2, 50};
  EXPECT_EQ(read(nowhere, options)->surface(std::vector<std::uint32_t>{0}).heightMeters[0], 50);
}

TEST(WeatherCode, SaysWhereItIsWrong) {
  EXPECT_TRUE(holds(complaint("{\"weather\":\n\n[}"), "line 3"));
  EXPECT_TRUE(holds(complaint(forecast(entry("d700"))), "/weather/0/s"));
  EXPECT_TRUE(holds(complaint(forecast(entry("d100", R"(,"temp":900)"))), "/weather/0/temp"));
  EXPECT_TRUE(holds(complaint(forecast(R"({"s":"d100","t":"yesterday"})")), "/weather/0/t"));
  EXPECT_TRUE(holds(complaint(forecast(R"({"t":"2024-02-05"})")), "lacks \"s\""));
  EXPECT_TRUE(holds(complaint(forecast("")), "/weather"));
}

TEST(WeatherCode, IsToldFromADescribedSky) {
  const test::Scratch scratch;
  EXPECT_EQ(open({scratch.write("x", forecast(entry("d100")))})->info().format, "weather codes (JSON)");
  EXPECT_FALSE(isWeatherCode(R"({"cloudgen_sky":1,"weather":1,"s":1})"));
  EXPECT_FALSE(isWeatherCode(R"({"weather":[]})"));
}

}  // namespace
}  // namespace cloudgen::input
