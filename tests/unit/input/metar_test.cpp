// SPDX-License-Identifier: Apache-2.0
#include "input/metar/metar.hpp"

#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "input/metar/bulletin.hpp"
#include "input/metar/metar_sky.hpp"
#include "support/scratch.hpp"

namespace cloudgen::input {
namespace {

using base::Genus;

MetarReport decoded(const std::string& text) {
  const auto raw = findReports(text);
  EXPECT_EQ(raw.size(), 1u) << text;
  const auto report = decodeMetar(raw.at(0).groups);
  EXPECT_TRUE(report) << text;
  return report.value_or(MetarReport{});
}

std::vector<field::StatedLayer> skyOf(const std::string& groups, bool day = true) {
  static std::string text;  // reports hold no views, but the groups do while they are decoded
  text = "METAR KMIA 081353Z " + groups + "=";
  const MetarReport report = decoded(text);
  Air air;
  air.latitudeDegrees = 45;
  air.surfaceMeters = 100;
  air.temperatureC = report.temperatureC.value_or(15);
  return layersOf(report, air, day);
}

std::vector<Genus> generaOf(const std::string& groups, bool day = true) {
  std::vector<Genus> genera;
  for (const field::StatedLayer& layer : skyOf(groups, day)) genera.push_back(*layer.genus);
  return genera;
}

StationTable stations() {
  StationTable table;
  addStations(table,
              "icao,latitude,longitude,elevation_m\nKMIA,25.79,-80.32,2\nKDEN,39.85,-104.66,1655\n"
              "KBJC,39.91,-105.12,1729\nNFFN,-17.8,177.4,18\nNSTU,-14.33,-170.72,3\n",
              "stations.csv");
  return table;
}

std::unique_ptr<field::Source> read(const std::string& text, const OpenOptions& options = {},
                                    const std::string& name = "metar-20240208.txt") {
  return skyOfMetars({{name, text}}, stations(), options);
}

std::vector<field::StatedLayer> layersOf(const field::Source& source) {
  std::vector<field::StatedLayer> layers;
  source.visitLayers(field::cellsTouching(source.grid(), field::extent(source.grid())),
                     [&](const field::StatedLayer& layer) { layers.push_back(layer); });
  return layers;
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

bool warns(const field::Source& source, const std::string& id) {
  const auto& warnings = source.info().warnings;
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const field::Warning& warning) { return warning.id == id; });
}

TEST(Metar, FindsReportsInABulletin) {
  const auto reports = findReports(
      "\x01\r\r\n776 \r\r\nSAUS70 KWBC 081400\r\r\nMETAR\r\r\nKMIA 081403Z 16032KT\r\r\n     BKN016CB "
      "$=\r\r\n"
      "SPECI COR KAMW 081353Z CLR=\njunk TAF KDEN 081130Z 0812/0912 SCT030=\n"
      "2024/02/08 14:00\nKDEN 081353Z OVC010\nKBJC 081353Z CLR\n\x03");
  ASSERT_EQ(reports.size(), 4u);
  EXPECT_EQ(reports[0].groups.size(), 5u);
  EXPECT_EQ(reports[0].line, 5u);
  EXPECT_EQ(reports[1].groups.front(), "KAMW");
  EXPECT_FALSE(reports[1].near);
  EXPECT_EQ(base::isoText(*reports[2].near), "2024-02-08T12:00:00Z");
  EXPECT_EQ(reports[2].groups.size(), 3u);
  EXPECT_EQ(reports[3].groups.front(), "KBJC");
}

TEST(Metar, DecodesTheGroups) {
  const std::string text =
      "KMIA 081403Z 16032G45KT 1 1/2SM R06/0300N +TSRA BR FEW005 SCT016CB BKN/// OVC250 M03/M05 A3003 RMK "
      "SLP1=";
  const MetarReport report = decoded(text);
  EXPECT_NEAR(*report.windSpeed, 16.46, 0.01);
  EXPECT_EQ(*report.windFromDegrees, 160);
  EXPECT_NEAR(*report.visibilityMeters, 2414, 1);
  EXPECT_TRUE(report.weather.thunder);
  EXPECT_EQ(report.weather.intensity, 1);
  ASSERT_EQ(report.clouds.size(), 4u);
  EXPECT_NEAR(*report.clouds[0].heightMeters, 152.4, 0.1);
  EXPECT_TRUE(report.clouds[1].storm);
  EXPECT_FALSE(report.clouds[2].heightMeters);
  EXPECT_EQ(*report.temperatureC, -3);
  EXPECT_EQ(*report.dewPointC, -5);
  const MetarReport other = decoded("EFHK 081350Z VRB02MPS 0400 BCFG NSC 01/01 Q1003 TEMPO BKN002=");
  EXPECT_FALSE(other.windFromDegrees);
  EXPECT_EQ(*other.windSpeed, 2);
  EXPECT_EQ(*other.visibilityMeters, 400);
  EXPECT_NEAR(other.weather.fogCover, 0.3, 1e-9);
  EXPECT_TRUE(other.skyTold);
  EXPECT_TRUE(other.clouds.empty());
}

TEST(Metar, EachLayerHasItsOwnCover) {
  const auto covers = [](const std::string& groups) {
    return ownCovers(decoded("KMIA 081403Z " + groups + "=").clouds);
  };
  EXPECT_NEAR(covers("FEW010 BKN030")[1], (0.75 - 0.1875) / (1 - 0.1875), 1e-6);
  EXPECT_EQ(covers("FEW010 OVC030")[1], 1);
  EXPECT_EQ(covers("OVC010 OVC030")[1], 0);
  const auto equal = covers("SCT010 SCT020");
  EXPECT_GT(equal[1], 0);
  EXPECT_LT(equal[1], 0.25);
  EXPECT_NEAR(covers("BKN010 FEW030")[1], 0.1875, 1e-6);
}

TEST(Metar, NamesTheGenus) {
  using enum Genus;
  const std::map<std::string, std::vector<Genus>> cases{
      {"FEW030CB SCT040 20/10", {Cumulonimbus, Cumulus}},
      {"SCT030TCU 20/10", {Cumulus}},
      {"TSRA BKN030 20/10", {Cumulonimbus, Stratocumulus}},
      {"SHRA SCT030 BKN050 20/10", {Cumulus, Stratocumulus}},
      {"RA OVC010 12/11", {Nimbostratus}},
      {"DZ OVC020 12/11", {Stratus}},
      {"OVC008 12/11", {Stratus}},
      {"BKN030 12/08", {Stratocumulus}},
      {"FEW035 25/14", {Cumulus}},
      {"SCT004 12/12", {Stratus}},
      {"SCT120 BKN300", {Altocumulus, Cirrostratus}},
      {"OVC120", {Altostratus}},
      {"FEW300", {Cirrus}},
      {"0200 FG VV001 08/08", {Fog}},
      {"0300 FG 08/08", {Fog}},
      {"SN VV008 M02/M02", {Nimbostratus}},
      {"SCT010 BKN080 15/09 Q1000 RMK CF3AC4", {Cumulus, Altocumulus}},
      {"CAVOK 25/10", {}},
      {"VCTS FEW035 25/14", {Cumulus}}};
  for (const auto& [groups, genera] : cases) EXPECT_EQ(generaOf(groups), genera) << groups;
  EXPECT_EQ(generaOf("FEW035 25/14", false), std::vector{Stratocumulus});
}

TEST(Metar, HeightsAreAboveTheStation) {
  const auto layers = skyOf("FEW010 OVC100 20/10");
  EXPECT_NEAR(layers[0].baseMeters, 100 + 304.8, 0.1);
  EXPECT_NEAR(layers[1].baseMeters, 100 + 3048, 0.1);
  EXPECT_NEAR(skyOf("BKN/// 20/12")[0].baseMeters, 100 + 1000, 1);
  EXPECT_NEAR(skyOf("////// FEW///CB 20/12")[0].baseMeters, 100 + 1000, 1);
  EXPECT_GT(skyOf("FEW030CB 25/15")[0].topMeters, 9000);
}

TEST(Metar, ThickFogHidesMore) {
  EXPECT_GT(skyOf("0100 FG VV002 08/08")[0].opticalDepth, skyOf("0800 FG VV002 08/08")[0].opticalDepth);
}

TEST(Metar, TheLastReportBeforeTheTimeCounts) {
  const std::string text =
      "KMIA 081353Z CLR=\nKMIA 081453Z FEW020=\nKMIA 081453Z COR OVC020=\nKMIA 081553Z OVC010=";
  OpenOptions options;
  const auto base = [&](const std::string& time) {
    options.time = base::utcFromIso(time);
    const auto layers = layersOf(*read(text, options));
    return layers.empty() ? 0.0f : layers[0].coverFraction * layers[0].baseMeters;
  };
  EXPECT_NEAR(layersOf(*read(text))[0].baseMeters, 2 + 304.8, 1);
  EXPECT_EQ(base("2024-02-08T14:00Z"), 0);
  EXPECT_NEAR(base("2024-02-08T15:00Z"), 2 + 609.6, 1);
  options.time = base::utcFromIso("2024-02-08T13:00Z");
  EXPECT_TRUE(holds(complaint(text, options), "2024-02-08T13:53:00Z to 2024-02-08T15:53:00Z"));
  options.time = base::utcFromIso("2024-02-08T20:00Z");
  EXPECT_TRUE(holds(complaint(text, options), "has nothing for"));
}

TEST(Metar, TheMonthComesFromTheNameOrTheTimeOrIsAssumed) {
  const std::string text = "KMIA 311353Z CLR=";
  EXPECT_EQ(base::isoText(read(text, {}, "x/2024-02-01.txt")->info().validTime), "2024-01-31T13:53:00Z");
  OpenOptions options;
  options.time = base::utcFromIso("2011-07-31T14:00Z");
  const auto timed = read(text, options, "metar.txt");
  EXPECT_EQ(base::isoText(timed->info().validTimes[0]), "2011-07-31T13:53:00Z");
  EXPECT_FALSE(warns(*timed, "metar_month_assumed"));
  const auto assumed = read(text, {}, "metar.txt");
  EXPECT_EQ(base::isoText(assumed->info().validTime), "2000-03-31T13:53:00Z");
  EXPECT_TRUE(warns(*assumed, "metar_month_assumed"));
}

TEST(Metar, StationsTellTheCellsAboutThem) {
  const auto source = read("KDEN 081353Z SCT040 10/00=\nKBJC 081353Z CLR=\nQQQQ 081353Z CLR=\n");
  EXPECT_EQ(source->grid().size(), 2u);
  EXPECT_TRUE(warns(*source, "unknown_station"));
  const auto layers = layersOf(*source);
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_NEAR(field::centerOf(source->grid(), layers[0].cell).longitudeDegrees, -104.66, 0.12);
  EXPECT_NEAR(source->surface(std::vector<std::uint32_t>{layers[0].cell}).heightMeters[0], 1655, 1);
}

TEST(Metar, AStormThatWasSeenIsThere) {
  const auto layers = layersOf(*read("KMIA 081353Z FEW030CB 25/15="));
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers[0].cloudCount, 1);
}

TEST(Metar, StationsAcrossTheAntimeridianAreNeighbours) {
  const auto source = read("NFFN 081400Z FEW018=\nNSTU 081350Z SCT020=");
  EXPECT_LT(field::extent(source->grid()).width(), 15);
  std::set<std::uint32_t> told;
  for (const field::StatedLayer& layer : layersOf(*source)) told.insert(layer.cell);
  EXPECT_GE(told.size(), 2u);
  EXPECT_LT(told.size(), source->grid().size());
}

TEST(Metar, ReadsTheCacheFiles) {
  const std::string raw = "KXXX 081353Z 10SM FEW070 05/M02";
  const std::string csv =
      "No errors\n1 results\nraw_text,station_id,observation_time,latitude,longitude,elevation_m\n" + raw +
      ",KXXX,2024-02-08T13:53:00Z,39.85,-104.66,1655.0\n";
  const std::string xml =
      "<response><METAR>\n<raw_text>" + raw +
      "</raw_text><observation_time>2024-02-08T13:53:00Z</observation_time><latitude>39.85"
      "</latitude><longitude>-104.66</longitude><elevation_m>1655.0</elevation_m></METAR>";
  const std::string json =
      R"([{"icaoId":"KXXX","obsTime":1707400380,"lat":39.85,"lon":-104.66,"elev":1655,"rawOb":")" + raw +
      R"("}])";
  for (const std::string& text : {csv, xml, json}) {
    EXPECT_TRUE(isMetar(text));
    const auto source = read(text, {}, "metars.cache");
    EXPECT_EQ(base::isoText(source->info().validTime), "2024-02-08T13:53:00Z");
    EXPECT_NEAR(layersOf(*source).at(0).baseMeters, 1655 + 7000 * 0.3048, 1);
  }
}

TEST(Metar, SaysWhatIsWrong) {
  EXPECT_TRUE(holds(complaint("QQQQ 081353Z CLR="), "unknown stations only (QQQQ)"));
  EXPECT_TRUE(holds(complaint("\n\nKMIA 991353Z CLR="), "line 3"));
  EXPECT_TRUE(holds(complaint("KMIA 081353Z 10SM="), "no METAR report that tells the sky"));
  StationTable table;
  try {
    addStations(table, "# a\nKMIA,95,0,\n", "s.csv");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_TRUE(holds(error.what(), "s.csv, line 2"));
  }
}

TEST(Metar, TheOwnTableKnowsTheWorld) {
  const StationTable table = readStations({});
  EXPECT_GT(table.size(), 7000u);
  EXPECT_NEAR(table.at("KDEN").point.latitudeDegrees, 39.87, 0.05);
  EXPECT_NEAR(*table.at("KDEN").elevationMeters, 1655, 30);
  EXPECT_TRUE(elevationNear(table, table.at("KAMW").point));
}

TEST(Metar, RealBulletinWholeAndCut) {
  const std::filesystem::path file =
      std::filesystem::path(CLOUDGEN_SHARED_DIR) / "data" / "metar_collective.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_TRUE(isMetar(std::string_view(text).substr(0, 4096)));
  const StationTable table = readStations({});
  const auto source = skyOfMetars({{"metar_collective.txt", text}}, table, {});
  EXPECT_TRUE(warns(*source, "unknown_station"));
  EXPECT_LE(source->grid().size(), 200'000u);
  const auto layers = layersOf(*source);
  EXPECT_TRUE(std::any_of(layers.begin(), layers.end(), [](const field::StatedLayer& layer) {
    return layer.genus == Genus::Cumulonimbus;
  }));
  for (int part = 0; part <= 50; ++part) {
    const std::string cut = text.substr(0, text.size() * static_cast<std::size_t>(part) / 50);
    try {
      layersOf(*skyOfMetars({{"cut", cut}}, table, {}));
    } catch (const base::InputError&) {
    }
  }
}

TEST(Metar, AReportThatBreaksOffIsLeftOutAndSaid) {
  const std::string whole = "METAR KMIA 081353Z 10SM BKN020=\nMETAR KDEN 081353Z 10SM OVC080=\n";
  EXPECT_FALSE(warns(*read(whole), "report_cut_off"));
  const auto cut = read(whole.substr(0, whole.size() - 4));
  EXPECT_TRUE(warns(*cut, "report_cut_off"));
  EXPECT_LT(layersOf(*cut).size(), layersOf(*read(whole)).size());
  EXPECT_FALSE(warns(*read("METAR KMIA 081353Z 10SM BKN020"), "report_cut_off")) << "a line by hand";
}

}  // namespace
}  // namespace cloudgen::input
