// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/x3d.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <regex>
#include <set>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "image/picture.hpp"
#include "support/moving_scene.hpp"
#include "support/scratch.hpp"
#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

namespace fs = std::filesystem;

/// Writes into a folder of its own, with a set of textures of its own (the bytes of a texture do not matter
/// here).
class X3d : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"data/textures", "data/templates", "data/schemas", "out"})
      fs::create_directories(root_ / folder);
    std::string atlases;
    for (const base::Genus genus : base::allGenera()) {
      const std::string name(base::name(genus));
      base::writeFile(root_ / "data/textures" / (name + ".png"), "texture of " + name);
      atlases += (atlases.empty() ? "" : ",") + std::string(R"({"genus":")") + name + R"(","file":")" + name +
                 R"(.png","columns":4,"rows":4,"tile_pixels":128})";
    }
    base::writeFile(root_ / "data/textures/manifest.json", "{\"atlases\":[" + atlases + "]}");
    setenv("CLOUDGEN_DATA", (root_ / "data").c_str(), 1);
  }
  void TearDown() override { unsetenv("CLOUDGEN_DATA"); }

  std::string written(void (*write)(const scene::Scene&, const Destination&), const scene::Scene& scene,
                      const char* file) {
    write(scene, {out(), {}});
    return base::readFile(out() / file);
  }
  /// The scene and the files of its tiles, by name.
  std::map<std::string, std::string> writtenFiles(void (*write)(const scene::Scene&, const Destination&),
                                                  const scene::Scene& scene, bool onGlobe = false) {
    Destination destination{out(), {}};
    destination.x3d.onGlobe = onGlobe;
    write(scene, destination);
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(out()))
      if (entry.is_regular_file()) files[entry.path().filename().string()] = base::readFile(entry.path());
    return files;
  }
  fs::path out() const { return root_ / "out"; }

  test::Scratch scratch_;
  const fs::path root_ = scratch_.path();
};

/// What is left of VRML without its quoted strings and comments.
std::string withoutStringsAndComments(const std::string& vrml) {
  std::string rest;
  for (std::size_t i = 0; i < vrml.size(); ++i) {
    if (vrml[i] == '"') {
      while (vrml[++i] != '"') i += vrml[i] == '\\' ? 1 : 0;
    } else if (vrml[i] == '#') {
      i = vrml.find('\n', i);
    } else {
      rest += vrml[i];
    }
  }
  return rest;
}

/// 500 clouds of 60 puffs, half of them unlike any other: more than stand in one file.
scene::Scene manyClouds() {
  std::vector<scene::Archetype> archetypes;
  for (int i = 0; i < 125; ++i)
    archetypes.push_back(
        test::sheet(fmt::format("Sc_{}", i), base::Genus::Stratocumulus, 600, 200, 60, 1, 1, 4));
  return test::sceneOf(std::move(archetypes), 500);
}

struct Output {
  void (*write)(const scene::Scene&, const Destination&);
  const char *file, *header;
};
const Output kOutputs[] = {{writeX3d, "scene.x3d", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<X3D "},
                           {writeClassicVrml, "scene.x3dv", "#X3D V4.0 utf8\nPROFILE Immersive\n"},
                           {writeVrml97, "scene.wrl", "#VRML V2.0 utf8\n"}};

/// Every text that the pattern's first group matches, in order.
std::vector<std::string> matches(const std::string& text, const char* pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (auto it = std::sregex_iterator(text.begin(), text.end(), expression); it != std::sregex_iterator();
       ++it)
    found.push_back((*it)[1]);
  return found;
}

/// The values of an attribute of all elements of a type, in order (by hand: std::regex recurses on long
/// ones).
std::vector<std::string> attributes(const std::string& text, const std::string& element,
                                    const std::string& attribute) {
  std::vector<std::string> values;
  for (std::size_t at = text.find("<" + element + " "); at != std::string::npos;
       at = text.find("<" + element + " ", at + 1)) {
    const std::string tag = text.substr(at, text.find('>', at) - at);
    const std::size_t name = tag.find(" " + attribute + "=");
    if (name == std::string::npos) continue;
    const std::size_t start = name + attribute.size() + 3;
    values.push_back(tag.substr(start, tag.find(tag[start - 1], start) - start));
  }
  return values;
}

std::vector<double> numbersIn(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  return {std::istream_iterator<double>(stream), {}};
}

TEST_F(X3d, IsValidByTheOfficialSchema) {
  const fs::path schema = fs::path(CLOUDGEN_SHARED_DIR) / "schemas/x3d-4.0.xsd";
  if (!fs::exists(schema)) GTEST_SKIP() << "the official X3D schema is not there";
  if (std::system("xmllint --version 2>/dev/null") != 0) GTEST_SKIP() << "xmllint is not installed";
  for (const scene::Scene& scene : {test::smallScene(), manyClouds()}) {
    std::string command = "xmllint --nonet --noout --schema '" + schema.string() + "'";
    for (const auto& [file, text] : writtenFiles(writeX3d, scene, true))
      command += " '" + (out() / file).string() + "'";
    EXPECT_EQ(std::system((command + " 2>&1").c_str()), 0);
  }
}

TEST_F(X3d, OnTheGlobeItsViewpointsAreThoseOfTheScene) {
  const scene::Scene scene = test::smallScene();
  const auto files = writtenFiles(writeX3d, scene, true);
  const std::string &plane = files.at("scene.x3d"), &globe = files.at("scene.geo.x3d");
  const auto wanted = attributes(plane, "Viewpoint", "position"), found = attributes(globe, "GeoViewpoint", "position");
  ASSERT_EQ(found.size(), wanted.size());
  ASSERT_GE(found.size(), 4u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto metres = numbersIn(wanted[i]), degrees = numbersIn(found[i]);
    const glm::dvec3 place = scene.frame.toScene(degrees[1], degrees[0], degrees[2]);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(place[axis], metres[static_cast<std::size_t>(axis)], 0.2) << i;
  }
  // What lies in the middle of the frame lies at the tangent point.
  const auto tangent = numbersIn(attributes(globe, "GeoLocation", "geoCoords").front()),
             shift = numbersIn(attributes(globe, "Transform", "translation").front());
  const glm::dvec3 middle = scene.frame.toScene(tangent[1], tangent[0], 0);
  EXPECT_NEAR(middle.x, -shift[0], 0.1);
  EXPECT_NEAR(middle.z, -shift[2], 0.1);
}

TEST_F(X3d, EveryUseHasAnEarlierDefAndEveryDefIsUnique) {
  const std::regex names(R"re((DEF|USE)="([^"]*)")re");
  for (const scene::Scene& scene : {test::smallScene(), manyClouds(), test::moving(manyClouds())}) {
    int uses = 0;
    for (const auto& [file, text] : writtenFiles(writeX3d, scene)) {
      std::set<std::string> defined;
      for (auto it = std::sregex_iterator(text.begin(), text.end(), names); it != std::sregex_iterator();
           ++it) {
        if ((*it)[1] == "DEF") {
          EXPECT_TRUE(defined.insert((*it)[2]).second) << (*it)[2];
          continue;
        }
        ++uses;
        EXPECT_TRUE(defined.count((*it)[2])) << (*it)[2];
      }
    }
    EXPECT_GE(uses, 16);
  }
}

TEST_F(X3d, CloudsStandWhereTheSceneHasThem) {
  const scene::Scene scene = test::smallScene();
  const std::string text = written(writeX3d, scene, "scene.x3d");
  // Only the Transform of a cloud has a scale.
  std::multiset<std::string> written_, wanted;
  for (const std::string& place : matches(text, R"re(<Transform scale="[^"]*" translation="([^"]*)")re"))
    written_.insert(place);
  for (const scene::Instance& instance : scene.instances) {
    std::string place;
    for (int i = 0; i < 3; ++i) {
      if (i > 0) place += ' ';
      base::appendFixed(place, instance.position[i], 1);
    }
    wanted.insert(place);
  }
  EXPECT_EQ(written_, wanted);
  const auto ids = matches(text, R"re(name="id genus rule" value='"([0-9]+)")re");
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), scene.instances.size());
}

TEST_F(X3d, IndicesAreInRangeAndAttributesBounded) {
  // 5 sheets of 3000 round puffs: far more cards than one Shape holds.
  const auto scene =
      test::sceneOf({test::sheet("Sc_1", base::Genus::Stratocumulus, 9000, 400, 3000, 1, 1, 4)}, 5);
  const std::string text = written(writeX3d, scene, "scene.x3d");
  const std::string end = "</IndexedTriangleSet>";
  int sets = 0;
  for (std::size_t at = text.find("<IndexedTriangleSet"); at != std::string::npos;
       at = text.find("<IndexedTriangleSet", at + 1), ++sets) {
    const std::string set = text.substr(at, text.find(end, at) - at);
    const auto all = [&](const char* element, const char* attribute) {
      const auto values = attributes(set, element, attribute);
      return values.empty() ? std::vector<double>{} : numbersIn(values.front());
    };
    const auto index = all("IndexedTriangleSet", "index"), box = all("TextureCoordinate", "point"),
               rgba = all("ColorRGBA", "color"), rgb = all("Color", "color");
    const std::size_t points = all("Coordinate", "point").size() / 3;
    EXPECT_LT(points, 100000u);
    EXPECT_LT(index.size(), 100000u);
    EXPECT_EQ(rgba.size() / 4 + rgb.size() / 3, points);
    EXPECT_TRUE(box.empty() || box.size() / 2 == points);
    EXPECT_EQ(index.size() % 3, 0u);
    EXPECT_LT(*std::ranges::max_element(index), static_cast<double>(points));
    EXPECT_GE(*std::ranges::min_element(index), 0);
    for (const auto& values : {rgba, rgb, box})
      for (const double value : values) EXPECT_TRUE(value >= 0 && value <= 1) << value;
  }
  EXPECT_GE(sets, 5);
}

TEST_F(X3d, LevelsOfDetailHaveAscendingRanges) {
  const std::string text = written(writeX3d, test::smallScene(), "scene.x3d");
  const auto ranges = attributes(text, "LOD", "range");
  EXPECT_GE(ranges.size(), 4u);
  for (const std::string& range : ranges) {
    const auto values = numbersIn(range);
    ASSERT_FALSE(values.empty());
    EXPECT_GT(values[0], 0);
    EXPECT_TRUE(std::ranges::is_sorted(values)) << range;
  }
}

TEST_F(X3d, TilesAreFilesThatAreLoadedOnceTheViewerIsNear) {
  for (const Output& output : std::span(kOutputs).first(2)) {
    const std::string extension = fs::path(output.file).extension().string();
    fs::remove_all(out());
    fs::create_directories(out());
    const auto files = writtenFiles(output.write, manyClouds());
    const std::string& root = files.at(output.file);
    std::size_t clouds = 0, atHand = 0;
    for (const auto& [file, text] : files) {
      const std::size_t own = matches(text, R"re((id genus rule))re").size();
      clouds += own;
      if (&text == &root) atHand = own;
    }
    EXPECT_EQ(clouds, 500u);
    EXPECT_GT(atHand, 20u);  // about the places that the viewpoints look at
    EXPECT_LT(atHand, 300u);
    const auto tiles = matches(root, R"re(scene\.tile_([m0-9_]*)\.x3d)re");
    EXPECT_EQ(tiles.size() + 1, files.size());
    for (const std::string& tile : tiles) {
      EXPECT_TRUE(files.contains(fmt::format("scene.tile_{}{}", tile, extension))) << tile;
      for (const auto& [from, fromField, to, toField] :
           {std::array{"Near_", "isActive", "Clouds_", "load"},
            std::array{"Loaded_", "isLoaded", "Choose_", "set_boolean"},
            std::array{"Choose_", "triggerValue", "Choice_", "whichChoice"}}) {
        const std::string route =
            extension == ".x3d"
                ? fmt::format("fromNode=\"{}{}\" fromField=\"{}\" toNode=\"{}{}\" toField=\"{}\"", from, tile,
                              fromField, to, tile, toField)
                : fmt::format("ROUTE {}{}.{} TO {}{}.{}", from, tile, fromField, to, tile, toField);
        EXPECT_NE(root.find(route), std::string::npos) << route;
      }
    }
  }
}

TEST_F(X3d, AViewpointFliesAlongThePlaces) {
  Destination destination{out(), {}};
  destination.flight = {{7.05, 46.05, 3000}, {7.2, 46.05, 3000}, {7.2, 46.15, 2000}};
  writeX3d(test::smallScene(), destination);
  const std::string text = base::readFile(out() / "scene.x3d");
  const auto keys = numbersIn(attributes(text, "PositionInterpolator", "key").at(0));
  ASSERT_EQ(keys.size(), 3u);
  EXPECT_EQ(keys.front(), 0);
  EXPECT_EQ(keys.back(), 1);
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  const auto places = numbersIn(attributes(text, "PositionInterpolator", "keyValue").at(0));
  ASSERT_EQ(places.size(), 9u);
  EXPECT_NEAR(places[1], 3000, 50);
  EXPECT_NEAR(places[7], 2000, 50);
  const auto turnKeys = numbersIn(attributes(text, "OrientationInterpolator", "key").at(0));
  EXPECT_TRUE(std::is_sorted(turnKeys.begin(), turnKeys.end()));
  EXPECT_EQ(numbersIn(attributes(text, "OrientationInterpolator", "keyValue").at(0)).size(),
            4 * turnKeys.size());
  EXPECT_EQ(matches(text, R"re((toNode="View_Flight"))re").size(), 2u);
  EXPECT_EQ(written(writeX3d, test::smallScene(), "scene.x3d").find("Flight"), std::string::npos);
}

TEST_F(X3d, NumbersArePlain) {
  for (const auto& [write, file, header] : kOutputs) {
    const std::string text = written(write, test::smallScene(), file);
    EXPECT_TRUE(matches(text, R"(([^\w](?:nan|inf)[^\w]))").empty()) << file;
    EXPECT_TRUE(matches(text, R"((\d[eE][-+]?\d))").empty()) << file;
    EXPECT_EQ(text.find("-0 "), std::string::npos) << file;
  }
}

TEST_F(X3d, SameBytesTwice) {
  const scene::Scene small = test::smallScene(), many = manyClouds();
  for (const auto& [write, file, header] : kOutputs)
    EXPECT_EQ(writtenFiles(write, small), writtenFiles(write, small));
  EXPECT_EQ(writtenFiles(writeX3d, many), writtenFiles(writeX3d, many));
}

TEST_F(X3d, TexturesOfTheGeneraAreCopiedAndNoOthers) {
  const std::string text = written(writeX3d, test::smallScene(), "scene.x3d");
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(out() / "textures"))
    files.insert(entry.path().filename().string());
  EXPECT_EQ(files, (std::set<std::string>{"cirrus.png", "cumulus.png"}));
  EXPECT_EQ(base::readFile(out() / "textures/cirrus.png"), "texture of cirrus");
  for (const std::string& url : matches(text, R"re(url='"([^"]*)")re"))
    EXPECT_TRUE(fs::exists(out() / url)) << url;
}

TEST_F(X3d, ClassicAndVrml97HaveTheirHeadersAndBalancedBrackets) {
  for (const auto& [write, file, header] : kOutputs) {
    const std::string all = written(write, test::smallScene(), file);
    EXPECT_TRUE(all.starts_with(header)) << file;
    const std::string text = withoutStringsAndComments(all);
    for (const auto& [open, close] : {std::pair{'{', '}'}, {'[', ']'}})
      EXPECT_EQ(std::count(text.begin(), text.end(), open), std::count(text.begin(), text.end(), close))
          << file;
  }
}

TEST_F(X3d, Vrml97KnowsOnlyNodesOfItsTime) {
  const std::string text = written(writeVrml97, test::smallScene(), "scene.wrl");
  const std::string moving = written(writeVrml97, test::moving(test::smallScene()), "scene.wrl");
  for (const char* later : {"IndexedTriangleSet", "ColorRGBA", "Metadata", "centerOfRotation", "LOD {", "Sequencer"})
    EXPECT_EQ((text + moving).find(later), std::string::npos) << later;
  EXPECT_NE(text.find("\"genus Ci\""), std::string::npos);
}

/// Viewers wait for each texture and each node.
TEST_F(X3d, Vrml97ShowsEachCloudAsAPictureThatTurnsInOneTexture) {
  const scene::Scene scene = test::smallScene();
  const std::string text = written(writeVrml97, scene, "scene.wrl");
  EXPECT_EQ(matches(text, R"re((url \[))re").size(), 1u);
  EXPECT_TRUE(fs::exists(out() / "textures/vrml_clouds.png"));
  EXPECT_EQ(matches(text, R"re(("cloud"))re").size(), scene.clouds.size());
  const auto turning = matches(text, R"(DEF (Picture_\d+_shade\d) Group \{\s*children \[\s*Transform[^{]*\{[^{]*Billboard)");
  EXPECT_GE(turning.size(), 1u);
  const auto defined = matches(text, R"(DEF (Picture_\w+))"), used = matches(text, R"(USE (Picture_\w+))");
  EXPECT_EQ(defined.size() + used.size(), scene.instances.size());
}

/// Of the clouds that are in the shadow of others, by the standard no colour reaches a texture.
TEST_F(X3d, Vrml97PaintsShadowsIntoThePictures) {
  scene::Scene scene = test::smallScene();
  scene.instances.resize(1);
  scene.clouds.resize(1);
  const auto brightest = [&] {
    written(writeVrml97, scene, "scene.wrl");
    const std::string png = base::readFile(out() / "textures/vrml_clouds.png");
    const image::ByteImage image = image::imageFromPng({reinterpret_cast<const unsigned char*>(png.data()), png.size()});
    unsigned char most = 0;
    for (std::size_t i = 1; i < image.bytes.size(); i += 4)
      if (image.bytes[i + 2] > 200) most = std::max(most, image.bytes[i]);
    return most;
  };
  const unsigned char inTheSun = brightest();
  scene.instances[0].sunlight = 0;
  EXPECT_LT(brightest(), inTheSun);
  EXPECT_GT(brightest(), 0);
}

/// Those beyond have no node of their own, but are all there.
TEST_F(X3d, Vrml97OfManyCloudsStaysShort) {
  scene::Scene scene = manyClouds();
  for (int i = 0; i < 4; ++i) scene.instances.insert(scene.instances.end(), scene.instances.begin(), scene.instances.begin() + 500);
  const std::string text = written(writeVrml97, scene, "scene.wrl");
  EXPECT_EQ(matches(text, R"((?:DEF|USE) (Picture_\w+))").size(), 1000u);
  EXPECT_TRUE(fs::exists(out() / "textures/vrml_afar.png"));
  EXPECT_LT(text.size(), 3u << 20);
}

TEST_F(X3d, ASceneWithoutCloudsIsWritten) {
  scene::Scene scene = test::smallScene();
  scene.instances.clear();
  scene.clouds.clear();
  const std::string text = written(writeX3d, scene, "scene.x3d");
  EXPECT_NE(text.find("Ground"), std::string::npos);
  EXPECT_TRUE(matches(text, R"((\bnan\b|\binf\b))").empty());
}

TEST_F(X3d, AFileThatCannotBeMadeIsAnOutputError) {
  fs::create_directories(out() / "taken/scene.x3d");
  EXPECT_THROW(writeX3d(test::smallScene(), {out() / "taken", {}}), base::OutputError);
}

}  // namespace
}  // namespace cloudgen::writer
