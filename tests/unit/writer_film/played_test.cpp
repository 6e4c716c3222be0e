// SPDX-License-Identifier: Apache-2.0
// What X3D and glTF animate is where the runtime has the clouds of the pack.
#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>
#include <regex>

#include "base/file.hpp"
#include "base/text.hpp"
#include "check/catalogue.hpp"
#include "check/fidelity/written_scene.hpp"
#include "runtime/timeline.hpp"
#include "support/glb_reader.hpp"
#include "support/made_pack.hpp"
#include "support/moving_scene.hpp"
#include "writer/film/film.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/x3d/x3d.hpp"

namespace cloudgen::writer {
namespace {

/// On the hour, halfway, and in between.
constexpr std::array kHours{0.0, 0.25, 0.5, 0.9, 1.0, 1.5, 2.0};

/// Keys and values of one that is linear between them.
struct Interpolator {
  std::vector<double> keys, values;

  glm::dvec3 at(double key) const {
    const auto value = [&](std::size_t k) { return glm::dvec3(values[3 * k], values[3 * k + 1], values[3 * k + 2]); };
    std::size_t after = 1;
    while (after + 1 < keys.size() && keys[after] < key) ++after;
    const double share = std::clamp((key - keys[after - 1]) / (keys[after] - keys[after - 1]), 0.0, 1.0);
    return value(after - 1) + share * (value(after) - value(after - 1));
  }
};

/// Of each cloud.
using Ways = std::map<std::uint64_t, Interpolator>;

class Played : public testing::Test {
 protected:
  void SetUp() override {
    bytes_ = test::packOf(scene_);
    ASSERT_TRUE(view_.open(test::bytesOf(bytes_)));
  }

  Destination destination() { return {folder_.path(), {}}; }

  /// Clouds that are there stand where the runtime has them; keys count so many an hour.
  void expectAsInThePack(const Ways& ways, double keysAnHour, double tolerance) {
    ASSERT_EQ(ways.size(), scene_.instances.size());
    runtime::Timeline timeline(view_);
    for (const double hours : kHours) {
      timeline.setTime(3600 * hours);
      std::size_t seen = 0;
      for (std::size_t i = 0; i < timeline.instances().size(); ++i) {
        const pack::Instance& cloud = timeline.instances()[i];
        if (!(cloud.optical_depth_factor() > 0)) continue;
        const glm::dvec3 place = ways.at(view_.root().records()->Get(static_cast<std::uint32_t>(i))->id()).at(keysAnHour * hours);
        EXPECT_NEAR(place.x, cloud.position().x(), tolerance) << hours;
        EXPECT_NEAR(place.y, cloud.position().y(), tolerance) << hours;
        EXPECT_NEAR(place.z, cloud.position().z(), tolerance) << hours;
        ++seen;
      }
      EXPECT_GT(seen, 5u) << hours;
    }
  }

  const scene::Scene scene_ = test::moving(test::packScene());
  test::ScratchFolder folder_;
  std::string bytes_;
  runtime::PackView view_;
};

std::vector<double> numbersIn(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  return {std::istream_iterator<double>(stream), {}};
}

/// The interpolators of a kind in X3D or VRML, by the number of their cloud.
std::map<std::size_t, Interpolator> interpolators(const std::string& text, const std::string& kind, bool isXml) {
  const std::regex pattern(isXml ? "<PositionInterpolator DEF=\"" + kind + "_(\\d+)\" key=\"([^\"]*)\" keyValue=\"([^\"]*)\"/>"
                                 : "DEF " + kind + "_(\\d+) PositionInterpolator \\{\\s*key \\[([^\\]]*)\\]\\s*keyValue \\[([^\\]]*)\\]");
  std::map<std::size_t, Interpolator> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found[std::stoul((*it)[1])] = {numbersIn((*it)[2]), numbersIn((*it)[3])};
  return found;
}

TEST_F(Played, X3dAndVrmlGoAsThePack) {
  struct Encoded {
    void (*write)(const scene::Scene&, const Destination&);
    const char* ending;
  };
  for (const auto& [write, ending] : {Encoded{writeX3d, ".x3d"}, {writeClassicVrml, ".x3dv"}, {writeVrml97, ".wrl"}}) {
    write(scene_, destination());
    Ways ways;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().extension() != ending) continue;
      const std::string text = base::readFile(entry.path());
      for (const auto& [i, way] : interpolators(text, "Way", std::string(ending) == ".x3d")) {
        EXPECT_GE(way.keys.size(), 3u);
        ways[scene_.clouds[i].id] = way;
        EXPECT_NE(text.find(fmt::format("Cloud_{}", i)), text.npos);
      }
    }
    SCOPED_TRACE(ending);
    expectAsInThePack(ways, 0.5, 0.1);  // the film is one of two hours, and places are written in tenths of metres
  }
}

/// A second clip, a missing channel or one of another node would be somebody else's cloud.
TEST_F(Played, GlbGoesAsThePack) {
  writeCards(scene_, destination());
  const test::Glb glb(test::bytesOf(folder_.path() / "scene.glb"));
  ASSERT_EQ(glb.json["animations"].size(), 1u);
  const auto& animation = glb.json["animations"][0];
  Ways ways, sizes;
  for (const auto& channel : animation["channels"]) {
    const auto& node = glb.json["nodes"][channel["target"]["node"].get<std::size_t>()];
    const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const auto keys = glb.values(sampler["input"]), values = glb.values(sampler["output"]);
    const std::uint64_t id = std::stoull(node["extras"]["clouds"][0].get<std::string>());
    (channel["target"]["path"] == "scale" ? sizes : ways)[id] = {{keys.begin(), keys.end()}, {values.begin(), values.end()}};
  }
  expectAsInThePack(ways, kFilmSecondsPerHour, 0.01);
  EXPECT_EQ(sizes.size(), ways.size());
  EXPECT_EQ(glb.json.value("extensionsUsed", nlohmann::json::array()).dump().find("instancing"), std::string::npos);
  for (const auto& node : glb.json["nodes"]) {
    if (!node.contains("extras") || !node["extras"].contains("clouds")) continue;
    const std::uint64_t id = std::stoull(node["extras"]["clouds"][0].get<std::string>());
    const bool isThere = node.value("scale", nlohmann::json{1, 1, 1})[0] != 0;
    EXPECT_EQ(isThere, sizes.at(id).at(0).x > 0 && sizes.at(id).keys.front() == 0);
  }
}

TEST_F(Played, WhatIsWrittenIsValid) {
  writeX3d(scene_, destination());
  writeClassicVrml(scene_, destination());
  writeVrml97(scene_, destination());
  writeCards(scene_, destination());
  const std::filesystem::path official = std::filesystem::path(CLOUDGEN_SHARED_DIR) / "schemas/x3d-4.0.xsd";
  const bool hasOfficial = std::filesystem::exists(official) && std::system("xmllint --version 2>/dev/null") == 0;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const auto result = check::validateFile(entry.path(), {}, {});
    EXPECT_TRUE(result.valid()) << entry.path() << ": " << (result.findings.empty() ? "" : result.findings[0].message);
    if (!hasOfficial || entry.path().extension() != ".x3d") continue;
    const std::string command = fmt::format("xmllint --nonet --noout --schema '{}' '{}' 2>&1", official.string(), entry.path().string());
    EXPECT_EQ(std::system(command.c_str()), 0) << entry.path();
  }
  EXPECT_GE(files, 4u);
}

/// `verify` sees the clouds of a time where they are.
TEST_F(Played, ReadersSeeTheCloudsOfATime) {
  writeX3d(scene_, destination());
  writeCards(scene_, destination());
  const auto feetOf = [](const check::WrittenScene& written) {
    std::vector<glm::vec3> feet;
    for (const check::WrittenCloud& cloud : written.clouds) feet.push_back(cloud.foot);
    std::ranges::sort(feet, {}, [](const glm::vec3& foot) { return std::tuple(std::round(foot.x), foot.z); });
    return feet;
  };
  for (const double seconds : {0.0, 1800.0, 4500.0, 5400.0}) {
    const auto wanted = feetOf(check::readPackScene(bytes_, "moving.cgpack", seconds));
    for (const auto& read : {feetOf(check::readX3dScene(folder_.path() / "scene.x3d", {}, seconds)),
                             feetOf(check::readGlbScene(folder_.path() / "scene.glb", seconds))}) {
      ASSERT_EQ(read.size(), wanted.size()) << seconds;
      for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_LT(glm::distance(read[i], wanted[i]), 0.2f) << seconds;
    }
  }
}

TEST_F(Played, ASkyThatStandsStillHasNoClock) {
  const scene::Scene still = test::packScene();
  writeX3d(still, destination());
  writeCards(still, destination());
  const std::string text = base::readFile(folder_.path() / "scene.x3d");
  for (const char* word : {"TimeSensor", "Interpolator", "IntegerSequencer", "DEF=\"Cloud_", "film"})
    EXPECT_EQ(text.find(word), text.npos) << word;
  EXPECT_FALSE(test::Glb(test::bytesOf(folder_.path() / "scene.glb")).json.contains("animations"));
}

}  // namespace
}  // namespace cloudgen::writer
