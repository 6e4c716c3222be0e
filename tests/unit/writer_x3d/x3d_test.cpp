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
#include "support/small_scene.hpp"

namespace cloudgen::writer {
namespace {

namespace fs = std::filesystem;

/// White discs, 4 by 4, in a colour of their own.
image::ByteImage sprites(unsigned char shade) {
  constexpr int kSide = 64, kDisc = 16;
  image::ByteImage image{kSide, kSide, 4, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double away = std::hypot(x % kDisc - 7.5, y % kDisc - 7.5) / 7.5;
      for (int c = 0; c < 3; ++c) image.bytes.push_back(static_cast<unsigned char>(240 + shade));
      image.bytes.push_back(static_cast<unsigned char>(255 * std::max(0.0, 1 - away * away)));
    }
  return image;
}

/// Writes into a folder of its own, with a set of textures of its own.
class X3d : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    for (const char* folder : {"data/textures", "data/templates", "data/schemas", "out"})
      fs::create_directories(root_ / folder);
    std::string atlases;
    for (const base::Genus genus : base::allGenera()) {
      const std::string name(base::name(genus));
      image::writePng(root_ / "data/textures" / (name + ".png"), sprites(static_cast<unsigned char>(genus)));
      atlases += (atlases.empty() ? "" : ",") + std::string(R"({"genus":")") + name + R"(","file":")" + name +
                 R"(.png","columns":4,"rows":4,"tile_pixels":128})";
    }
    base::writeFile(root_ / "data/textures/manifest.json", "{\"atlases\":[" + atlases + "]}");
    setenv("CLOUDGEN_DATA", (root_ / "data").c_str(), 1);
  }
  void TearDown() override {
    unsetenv("CLOUDGEN_DATA");
    fs::remove_all(root_);
  }

  std::string written(void (*write)(const scene::Scene&, const Destination&), const scene::Scene& scene,
                      const char* file) {
    write(scene, {out(), {}});
    return base::readFile(out() / file);
  }
  /// The scene and the files of its tiles, by name.
  std::map<std::string, std::string> writtenFiles(void (*write)(const scene::Scene&, const Destination&),
                                                  const scene::Scene& scene) {
    write(scene, {out(), {}});
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(out()))
      if (entry.is_regular_file()) files[entry.path().filename().string()] = base::readFile(entry.path());
    return files;
  }
  /// All of them in one text.
  std::string writtenText(void (*write)(const scene::Scene&, const Destination&), const scene::Scene& scene) {
    std::string text;
    for (const auto& [file, content] : writtenFiles(write, scene)) text += content;
    return text;
  }
  fs::path out() const { return root_ / "out"; }

  fs::path root_;
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
  const auto files = writtenFiles(writeX3d, test::smallScene());
  EXPECT_GE(files.size(), 3u);
  for (const auto& [file, text] : files) {
    const std::string command =
        "xmllint --nonet --noout --schema '" + schema.string() + "' '" + (out() / file).string() + "' 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << file;
  }
}

TEST_F(X3d, EveryUseHasAnEarlierDefAndEveryDefIsUnique) {
  const std::regex names(R"re((DEF|USE)="([^"]*)")re");
  int uses = 0;
  for (const auto& [file, text] : writtenFiles(writeX3d, test::smallScene())) {
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

TEST_F(X3d, CloudsStandWhereTheSceneHasThem) {
  const scene::Scene scene = test::smallScene();
  const std::string text = writtenText(writeX3d, scene);
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
  const std::string text = writtenText(writeX3d, scene);
  const auto indices = attributes(text, "IndexedTriangleSet", "index");
  const auto colors = attributes(text, "ColorRGBA", "color");
  const auto boxes = attributes(text, "TextureCoordinate", "point");
  ASSERT_EQ(indices.size(), colors.size());
  ASSERT_EQ(indices.size(), boxes.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto index = numbersIn(indices[i]), color = numbersIn(colors[i]), box = numbersIn(boxes[i]);
    const double points = static_cast<double>(color.size() / 4);
    EXPECT_LT(points, 100000);
    EXPECT_LT(index.size(), 100000u);
    EXPECT_EQ(box.size() / 2, color.size() / 4);
    EXPECT_EQ(index.size() % 3, 0u);
    EXPECT_LT(*std::max_element(index.begin(), index.end()), points);
    EXPECT_GE(*std::min_element(index.begin(), index.end()), 0);
    for (const auto& values : {color, box})
      for (const double value : values) EXPECT_TRUE(value >= 0 && value <= 1) << value;
  }
}

TEST_F(X3d, LevelsOfDetailHaveOneRangeLessThanLevelsAscending) {
  const std::string text = writtenText(writeX3d, test::smallScene());
  const auto ranges = attributes(text, "LOD", "range");
  EXPECT_GE(ranges.size(), 5u);
  for (const std::string& range : ranges) {
    const auto values = numbersIn(range);
    ASSERT_EQ(values.size(), 1u);
    EXPECT_GT(values[0], 0);
  }
}

TEST_F(X3d, EveryTileIsAFileThatIsLoadedOnceTheViewerIsNear) {
  const auto scene =
      test::sceneOf({test::sheet("Sc_1", base::Genus::Stratocumulus, 1500, 200, 20, 1, 1, 4)}, 400);
  const auto files = writtenFiles(writeX3d, scene);
  std::size_t clouds = 0, tiles = 0;
  for (const auto& [file, text] : files) {
    clouds += matches(text, R"re((name="id genus rule"))re").size();
    for (const std::string& tile : matches(text, R"re(<Inline DEF="Clouds_([^"]*)" load="false")re")) {
      ++tiles;
      EXPECT_TRUE(files.contains("scene.tile_" + tile + ".x3d")) << tile;
      for (const std::string& route :
           {"fromNode=\"Near_" + tile + "\" fromField=\"isActive\" toNode=\"Clouds_" + tile +
                "\" toField=\"load\"",
            "fromNode=\"Loaded_" + tile + "\" fromField=\"isLoaded\"",
            "toNode=\"Choice_" + tile + "\" toField=\"whichChoice\""})
        EXPECT_NE(text.find(route), std::string::npos) << route;
    }
  }
  EXPECT_EQ(clouds, 400u);
  EXPECT_GE(tiles, 20u);
  EXPECT_EQ(tiles + 1, files.size());
}

TEST_F(X3d, CloudsThatTurnArePicturesFromAfar) {
  const auto files = writtenFiles(writeX3d, test::smallScene());
  const std::string& root = files.at("scene.x3d");
  // LODs choose one of eight azimuths, and for each whether it is seen from high above.
  EXPECT_GE(attributes(root, "LOD", "range").size(), 16u);
  for (const std::string& url : matches(root, R"re(url='"(textures/tile_[^"]*)")re")) {
    const image::ByteImage picture = image::readPng(out() / url);
    std::size_t seen = 0;
    for (std::size_t i = 3; i < picture.bytes.size(); i += 4) seen += picture.bytes[i] > 100;
    EXPECT_GT(seen, picture.bytes.size() / 4 / 5) << url;
  }
}

TEST_F(X3d, NumbersArePlain) {
  for (const auto& [write, file, header] : kOutputs) {
    const std::string text = writtenText(write, test::smallScene());
    EXPECT_TRUE(matches(text, R"(([^\w](?:nan|inf)[^\w]))").empty()) << file;
    EXPECT_TRUE(matches(text, R"((\d[eE][-+]?\d))").empty()) << file;
    EXPECT_EQ(text.find("-0 "), std::string::npos) << file;
  }
}

TEST_F(X3d, SameBytesTwice) {
  const scene::Scene scene = test::smallScene();
  for (const auto& [write, file, header] : kOutputs)
    EXPECT_EQ(writtenFiles(write, scene), writtenFiles(write, scene));
}

TEST_F(X3d, TexturesOfTheGeneraAreCopiedAndNoOthers) {
  const std::string text = writtenText(writeX3d, test::smallScene());
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(out() / "textures"))
    files.insert(entry.path().filename().string());
  std::erase_if(files, [](const std::string& file) { return file.starts_with("tile_"); });
  EXPECT_EQ(files, (std::set<std::string>{"cirrus.png", "cumulus.png"}));
  EXPECT_EQ(base::readFile(out() / "textures/cirrus.png"),
            base::readFile(root_ / "data/textures/cirrus.png"));
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
  for (const char* later : {"IndexedTriangleSet", "ColorRGBA", "Metadata", "centerOfRotation", "LOD {"})
    EXPECT_EQ(text.find(later), std::string::npos) << later;
  EXPECT_NE(text.find("transparency"), std::string::npos);  // the thin cirrus
  EXPECT_NE(text.find("\"genus Ci\""), std::string::npos);
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
