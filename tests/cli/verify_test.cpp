// SPDX-License-Identifier: Apache-2.0
// Written scenes compared with what they were made from, and scenes that somebody changed afterwards.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "cli/fits_schema.hpp"
#include "cli/program.hpp"
#include "support/scratch.hpp"

namespace {

using namespace cloudgen::test;
using Words = std::vector<std::string>;
using nlohmann::json;

/// Stratocumulus under cirrostratus.
constexpr const char* kSky =
    R"({"cloudgen_sky": 1, "title": "a sky to verify", "valid_time": "2026-06-21T20:00:00Z",
  "bbox": [-122.4, 36.6, -122.0, 36.9],
  "layers": [{"genus": "Sc", "cover": 0.8, "base_m": 900, "top_m": 1400, "optical_depth": 3},
             {"genus": "Cs", "cover": 0.6, "base_m": 9000, "top_m": 10000, "optical_depth": 1}]})";

class Verify : public ::testing::Test {
 protected:
  /// Each test has a copy of one build, which it may change.
  void SetUp() override {
    static const Scratch kept;
    static const std::string first = kept.write("two.sky.json", kSky);
    const Ran ran = buildOnce({first, "--formats", "x3d,splats,glb", "--max-puffs", "20000"}, scene);
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
  }
  /// The result for one of the formats, checked against its schema and the exit code.
  json verified(const std::string& format) const {
    const Ran ran =
        runCloudgen({"verify", scene, "--against", sky, "--format", format, "--json", "--no-maps"});
    json result = json::parse(ran.out, nullptr, false);
    if (result.is_discarded()) {
      ADD_FAILURE() << ran.out << ran.err;
      return result;
    }
    expectFitsSchema(result, "verify.schema.json");
    EXPECT_EQ(ran.exitCode, result.at("passed").get<bool>() ? 0 : 4) << ran.err;
    EXPECT_EQ(result.at("passed").get<bool>(), result.at("broken").empty());
    return result;
  }
  void change(const std::string& name, const std::function<void(std::string&)>& edit) const {
    std::string bytes = cloudgen::base::readFile(scene + "/" + name);
    edit(bytes);
    std::ofstream(scene + "/" + name, std::ios::binary) << bytes;
  }
  /// The scene and the tiles that it inlines.
  void changeX3d(const std::function<void(std::string&)>& edit) const {
    for (const auto& entry : std::filesystem::directory_iterator(scene))
      if (entry.path().extension() == ".x3d") change(entry.path().filename().string(), edit);
  }
  static bool breaks(const json& result, const std::string& measure) {
    for (const json& broken : result.at("broken"))
      if (broken.at("measure") == measure) return true;
    return false;
  }

  Scratch folder;
  std::string sky = folder.write("two.sky.json", kSky);
  std::string scene = folder.path() / "scene";
};

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Changes every float of the splats' opacities.
void eachOpacity(std::string& glb, const std::function<float(std::size_t, float)>& change) {
  std::uint32_t jsonBytes = 0;
  std::memcpy(&jsonBytes, glb.data() + 12, 4);
  const json root = json::parse(glb.substr(20, jsonBytes));
  const std::size_t binary = 28 + jsonBytes;
  for (const json& mesh : root.at("meshes")) {
    const json& accessor = root.at("accessors")
                               .at(mesh.at("primitives")
                                       .at(0)
                                       .at("attributes")
                                       .at("KHR_gaussian_splatting:OPACITY")
                                       .get<std::size_t>());
    const json& view = root.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    char* first = glb.data() + binary + view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u);
    for (std::size_t i = 0; i < accessor.at("count").get<std::size_t>(); ++i) {
      float value = 0;
      std::memcpy(&value, first + 4 * i, 4);
      value = change(i, value);
      std::memcpy(first + 4 * i, &value, 4);
    }
  }
}

TEST_F(Verify, ComparesEachFormatWithTheModel) {
  for (const char* format : {"x3d", "splats"}) {
    SCOPED_TRACE(format);
    const json result = verified(format);
    EXPECT_EQ(result.at("read").at("format"), format);
    EXPECT_GT(result.at("read").at("blobs").get<int>(), 1000);
    EXPECT_NEAR(result.at("optical_depth").at("bias_relative").get<double>(), 0, 0.5);
    EXPECT_NEAR(result.at("cover").at("total").at("bias").get<double>(), 0, 0.35);
    EXPECT_EQ(result.at("worst").at("cover").size(),
              result.at("columns").get<std::size_t>() > 5 ? 5u : result.at("columns").get<std::size_t>());
  }
  const json cards = verified("glb");
  EXPECT_EQ(cards.at("read").at("file"), "scene.glb");
  EXPECT_EQ(cards.at("genus").at("agreement"), 1);
  EXPECT_EQ(cards.at("genus").at("clouds"), verified("x3d").at("genus").at("clouds"));
  EXPECT_EQ(verified("x3d").at("genus").at("agreement"), 1);
  EXPECT_EQ(verified("auto").at("genus").at("agreement"), 1);
  EXPECT_TRUE(verified("splats").at("genus").at("agreement").is_null());
}

TEST_F(Verify, TellsThatATenthIsMissing) {
  const json before = verified("splats");
  const double depth = before.at("optical_depth").at("scene_mean");
  change("scene.splats.glb", [](std::string& glb) {
    eachOpacity(glb, [](std::size_t i, float opacity) { return i % 10 == 3 ? 0 : opacity; });
  });
  EXPECT_NEAR(verified("splats").at("optical_depth").at("scene_mean").get<double>() / depth, 0.9, 0.02);
}

TEST_F(Verify, TellsDoubledOpticalDepth) {
  const double depth = verified("splats").at("optical_depth").at("scene_mean");
  change("scene.splats.glb", [](std::string& glb) {
    eachOpacity(glb, [](std::size_t, float opacity) { return 1 - (1 - opacity) * (1 - opacity); });
  });
  const json doubled = verified("splats");
  EXPECT_NEAR(doubled.at("optical_depth").at("scene_mean").get<double>() / depth, 2, 0.02);
  EXPECT_TRUE(breaks(doubled, "optical_depth.bias_relative"));
}

TEST_F(Verify, LooksAslantAndFromTheGround) {
  const json result = verified("splats");
  EXPECT_TRUE(result.at("slanted").at("judged").get<bool>());
  EXPECT_FALSE(verified("x3d").at("slanted").at("judged").get<bool>());
  const json& views = result.at("slanted").at("views");
  // Of what hangs over the border only the box as a whole knows.
  EXPECT_NEAR(views.at(0).at("optical_depth").get<double>(),
              result.at("optical_depth").at("scene_mean").get<double>(), 0.6);
  EXPECT_NEAR(views.at(2).at("optical_depth").get<double>(), views.at(0).at("optical_depth").get<double>(),
              0.2);
  for (const json& camera : result.at("from_the_ground").at("cameras"))
    EXPECT_GE(camera.at("octas").get<int>(), 5);
}

TEST_F(Verify, TellsSwappedTypes) {
  changeX3d([](std::string& text) {
    replaceAll(text, "textures/stratocumulus.png", "textures/swapped");
    replaceAll(text, "textures/cirrostratus.png", "textures/stratocumulus.png");
    replaceAll(text, "textures/swapped", "textures/cirrostratus.png");
  });
  const json drawn = verified("x3d");
  EXPECT_EQ(drawn.at("genus").at("agreement"), 0);
  EXPECT_TRUE(breaks(drawn, "genus.agreement"));
}

TEST_F(Verify, TellsAFalseRecord) {
  changeX3d([](std::string& text) { replaceAll(text, "\"Sc\"", "\"Cu\""); });
  const json result = verified("x3d");
  EXPECT_LT(result.at("genus").at("agreement").get<double>(), 1);
  EXPECT_TRUE(breaks(result, "genus.agreement"));
}

TEST_F(Verify, DrawsMapsAndSpeaksToPeople) {
  const Ran ran = runCloudgen({"verify", scene, "--against", sky, "-o", folder.path() / "maps"});
  EXPECT_TRUE(ran.exitCode == 0 || ran.exitCode == 4) << ran.err;
  EXPECT_NE(ran.out.find("optical depth"), std::string::npos) << ran.out;
  EXPECT_LE(std::count(ran.out.begin(), ran.out.end(), '\n'), 24) << ran.out;
  const auto names = namesIn(folder.path() / "maps");
  EXPECT_EQ(names.size(), 7u);
  for (const auto& [name, bytes] : contentOf(folder.path() / "maps"))
    EXPECT_EQ(bytes.substr(1, 3), "PNG") << name;
}

TEST_F(Verify, MapsStandBesideTheScene) {
  const auto before = namesIn(scene);
  runCloudgen({"verify", scene, "--against", sky, "--no-maps"});
  EXPECT_EQ(namesIn(scene), before);
  runCloudgen({"verify", scene, "--against", sky, "-q"});
  EXPECT_TRUE(std::filesystem::exists(scene + "/verify/cover.png"));
}

TEST_F(Verify, ABuildMayVerifyItself) {
  const Ran ran = runCloudgen({"build", sky, "-o", folder.path() / "own", "--formats", "splats",
                               "--max-puffs", "20000", "--verify", "--json"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const json report = json::parse(ran.out);
  expectFitsSchema(report, "report.schema.json");
  expectFitsSchema(report.at("verify"), "verify.schema.json");
  EXPECT_EQ(report.at("verify").at("cover"), verified("splats").at("cover"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "own/verify/cover.png"));
}

TEST_F(Verify, ThePageShowsWhatTheBuildFound) {
  const auto page = [&](const std::string& name, const Words& more) {
    Words words{"build", sky, "-o", folder.path() / name, "--formats", "splats,pack,page", "--max-puffs", "5000"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = runCloudgen(words);
    if (ran.exitCode == 3) return json();  // the page needs npm
    EXPECT_EQ(ran.exitCode, 0) << ran.err;
    const std::string html = cloudgen::base::readFile(folder.path() / name / "index.html");
    const std::string slot = "id=\"cloudgen-scene\">";
    const std::size_t start = html.find(slot) + slot.size();
    return json::parse(html.substr(start, html.find("</script>", start) - start));
  };
  const json unverified = page("plain", {}), shown = page("shown", {"--verify"});
  if (unverified.is_null()) GTEST_SKIP() << "the page is not built";
  EXPECT_FALSE(unverified.contains("verification"));
  const json report = json::parse(cloudgen::base::readFile(folder.path() / "shown/report.json"));
  EXPECT_EQ(shown.at("verification"), report.at("verify"));
  ASSERT_EQ(shown.at("maps").size(), 2u);
  EXPECT_TRUE(shown.at("maps").at(0).at("picture").get<std::string>().starts_with("data:image/png;base64,"));
}

TEST_F(Verify, RefusesADamagedScene) {
  change("scene.x3d", [](std::string& text) { text.resize(text.size() / 2); });
  EXPECT_EQ(runCloudgen({"verify", scene, "--against", sky, "--format", "x3d"}).exitCode, 1);
  change("scene.splats.glb", [](std::string& bytes) { bytes.resize(bytes.size() / 2); });
  EXPECT_EQ(runCloudgen({"verify", scene, "--against", sky}).exitCode, 1);
}

}  // namespace
