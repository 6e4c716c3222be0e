// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "light/color.hpp"
#include "support/glb_reader.hpp"
#include "support/gltf_scene.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/gltf/splat_source.hpp"

namespace cloudgen::writer {
namespace {

const std::string kPrefix = "KHR_gaussian_splatting:";

test::Glb written(const scene::Scene& scene) {
  const test::ScratchFolder folder;
  writeSplats(scene, {folder.path(), {}});
  return test::Glb(test::bytesOf(folder.path() / "scene.splats.glb"));
}

/// The splats of the file in the scene frame.
struct Read {
  glm::vec3 center, sigma, degree0;
  glm::quat rotation;
  float opacity;
  std::array<glm::vec3, 3> degree1;
  glm::vec4 fallback;

  glm::vec3 base() const { return degree0 * 0.2820947917738781f + 0.5f; }
  /// The colour that the extension's text prescribes for a look along `direction`.
  glm::vec3 seen(glm::vec3 direction) const {
    return base() + 0.4886025119029199f *
                        (-direction.y * degree1[0] + direction.z * degree1[1] - direction.x * degree1[2]);
  }
};

std::vector<Read> splatsOf(const test::Glb& glb) {
  std::vector<Read> out;
  for (const auto& node : glb.json.at("nodes")) {
    const auto& attributes = glb.json["meshes"].at(node["mesh"].get<int>())["primitives"].at(0)["attributes"];
    const auto column = [&](const std::string& name) { return glb.values(attributes.at(name)); };
    const auto places = column("POSITION"), rotations = column(kPrefix + "ROTATION"),
               scales = column(kPrefix + "SCALE"), opacities = column(kPrefix + "OPACITY"),
               degree0 = column(kPrefix + "SH_DEGREE_0_COEF_0"), colors = column("COLOR_0");
    const std::array degree1{column(kPrefix + "SH_DEGREE_1_COEF_0"), column(kPrefix + "SH_DEGREE_1_COEF_1"),
                             column(kPrefix + "SH_DEGREE_1_COEF_2")};
    const auto vec3 = [](const std::vector<float>& v, std::size_t i) {
      return glm::vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    };
    const auto move = node.value("translation", std::vector<double>{0, 0, 0});
    EXPECT_EQ(opacities.size() * 3, places.size());
    for (std::size_t i = 0; i < opacities.size(); ++i)
      out.push_back({.center = vec3(places, i) + glm::vec3(move[0], move[1], move[2]),
                     .sigma = vec3(scales, i),
                     .degree0 = vec3(degree0, i),
                     .rotation = glm::quat(rotations[4 * i + 3], rotations[4 * i], rotations[4 * i + 1],
                                           rotations[4 * i + 2]),
                     .opacity = opacities[i],
                     .degree1 = {vec3(degree1[0], i), vec3(degree1[1], i), vec3(degree1[2], i)},
                     .fallback = {colors[4 * i], colors[4 * i + 1], colors[4 * i + 2], colors[4 * i + 3]}});
  }
  return out;
}

/// Every puff that should be there, with its light.
std::vector<std::pair<shape::Puff, light::PuffLight>> visiblePuffs(const scene::Scene& scene) {
  std::vector<std::pair<shape::Puff, light::PuffLight>> out;
  for (const auto& instance : scene.instances) {
    const auto& lit = scene.lit[instance.lit];
    for (std::size_t p = 0; p < lit.puffs.size(); ++p) {
      const shape::Puff puff = scene::placed(scene, instance, scene.archetypes[lit.archetype].puffs[p]);
      if (1 - std::exp(-shape::frontalOpticalDepth(puff)) >= 0.004f) out.emplace_back(puff, lit.puffs[p]);
    }
  }
  return out;
}

TEST(Splats, EveryVisiblePuffIsASplatAtItsPlace) {
  const scene::Scene scene = test::gltfScene();
  auto splats = splatsOf(written(scene));
  const auto puffs = visiblePuffs(scene);
  EXPECT_EQ(puffs.size(), scene::drawnPuffs(scene) - 1) << "the scene has one puff too thin to be seen";
  ASSERT_EQ(splats.size(), puffs.size());
  for (const auto& [puff, light] : puffs) {
    const auto found = std::min_element(splats.begin(), splats.end(), [&](const Read& a, const Read& b) {
      return glm::distance(a.center, puff.center) < glm::distance(b.center, puff.center);
    });
    EXPECT_LT(glm::distance(found->center, puff.center), 0.01f);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(found->sigma[axis], puff.sigma[axis] - 1e-3f) << "never narrower than the puff";
      EXPECT_LT(found->sigma[axis], 1.4f * puff.sigma[axis]);
    }
    EXPECT_GT(std::abs(glm::dot(found->rotation, puff.rotation)), 0.99999f);
    EXPECT_LE(found->opacity, 1 - std::exp(-shape::frontalOpticalDepth(puff)) + 1e-5);
    EXPECT_NEAR(found->fallback.a, found->opacity, 0.5 / 255 + 1e-6);
    splats.erase(found);
  }
}

TEST(Splats, LookBrightestTowardsTheSunAndPlainAcross) {
  const scene::Scene scene = test::gltfScene();
  const auto splats = splatsOf(written(scene));
  const glm::vec3 sun = scene.sun.direction, across = glm::normalize(glm::cross(sun, glm::vec3(0, 1, 0)));
  // The uppermost grey puff has the strongest silver lining.
  const auto top = std::max_element(splats.begin(), splats.end(), [](const Read& a, const Read& b) {
    const auto lining = [](const Read& s) {
      return glm::length(s.degree1[0]) + glm::length(s.degree1[1]) + glm::length(s.degree1[2]);
    };
    return lining(a) < lining(b);
  });
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(top->seen(sun)[c], top->seen(across)[c]);
    EXPECT_GT(top->seen(across)[c], top->seen(-sun)[c]);
    EXPECT_NEAR(top->seen(across)[c], top->base()[c], 1e-5);
  }
  // Red is the sun's strongest colour in the afternoon, if not yet saturated.
  EXPECT_GT(scene.sun.color.r, scene.sun.color.b);
}

TEST(Splats, ColorsAreEncodedAndTheFallbackIsLinear) {
  scene::Scene scene = test::gltfScene();
  const glm::vec3 color(0.2f, 0.5f, 0.8f);
  for (auto& lit : scene.lit)
    for (auto& light : lit.puffs) light = {color, 0};
  for (const Read& splat : splatsOf(written(scene))) {
    EXPECT_LT(glm::distance(splat.base(), light::srgbFromLinear(color)), 1e-5f);
    EXPECT_LT(glm::distance(glm::vec3(splat.fallback), color), 0.004f);
    EXPECT_EQ(splat.degree1[0], glm::vec3(0));
  }
}

TEST(Splats, DeclareTheExtensionAndTheirBounds) {
  const scene::Scene scene = test::gltfScene();
  const test::Glb glb = written(scene);
  EXPECT_EQ(glb.json["extensionsUsed"], nlohmann::json({"KHR_gaussian_splatting"}));
  EXPECT_FALSE(glb.json.contains("extensionsRequired")) << "viewers without it may draw points";
  const nlohmann::json expected{{"kernel", "ellipse"},
                                {"colorSpace", "srgb_rec709_display"},
                                {"projection", "perspective"},
                                {"sortingMethod", "cameraDistance"}};
  for (const auto& mesh : glb.json["meshes"]) {
    const auto& primitive = mesh["primitives"][0];
    EXPECT_EQ(primitive["mode"], 0);
    EXPECT_EQ(primitive["extensions"]["KHR_gaussian_splatting"], expected);
    const auto& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    const auto places = glb.values(primitive["attributes"]["POSITION"]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float low = 1e30f, high = -1e30f;
      for (std::size_t i = axis; i < places.size(); i += 3)
        low = std::min(low, places[i]), high = std::max(high, places[i]);
      EXPECT_EQ(accessor["min"][axis].get<float>(), low);
      EXPECT_EQ(accessor["max"][axis].get<float>(), high);
    }
  }
}

TEST(Splats, SayWhereTheyComeFrom) {
  const nlohmann::json extras = written(test::gltfScene()).json["asset"]["extras"];
  EXPECT_EQ(extras["source"]["files"], nlohmann::json({"model.grib2"}));
  EXPECT_EQ(extras["source"]["model"], "ICON-D2");
  EXPECT_EQ(extras["valid_time"], "2026-06-21T14:00:00Z");
  EXPECT_EQ(extras["seed"], "18364758544493064720");
  EXPECT_NEAR(extras["frame"]["origin_longitude"].get<double>(), 10.0, 1e-6);
  EXPECT_NEAR(extras["frame"]["origin_latitude"].get<double>(), 50.0, 1e-6);
  EXPECT_EQ(extras["sun"]["azimuth_degrees"], 225.0);
}

TEST(Splats, TilesAreFewAndHoldTheirSplats) {
  for (const int rows : {1, 4, 12}) {
    const scene::Scene scene = test::gltfScene(20, rows);
    const test::Glb glb = written(scene);
    EXPECT_LE(glb.json["nodes"].size(), scene::kMostTiles);
    std::size_t clouds = 0;
    for (const auto& node : glb.json["nodes"]) {
      clouds += node["extras"]["clouds"].get<std::size_t>();
      const auto& accessor =
          glb.json["accessors"]
                  [glb.json["meshes"][node["mesh"].get<int>()]["primitives"][0]["attributes"]["POSITION"]
                       .get<int>()];
      for (int axis = 0; axis < 3; ++axis) {
        const double move = node["translation"][axis];
        EXPECT_GE(accessor["min"][axis].get<double>() + move, node["extras"]["lower"][axis].get<double>());
        EXPECT_LE(accessor["max"][axis].get<double>() + move, node["extras"]["upper"][axis].get<double>());
      }
    }
    EXPECT_EQ(clouds, scene.instances.size());
  }
}

TEST(Splats, LargeTilesAreCutIntoParts) {
  scene::Scene scene = test::gltfScene(70'000, 1);
  for (auto& instance : scene.instances) instance.position = {100, 1000, -100};
  const test::Glb glb = written(scene);
  std::size_t total = 0;
  for (const auto& mesh : glb.json["meshes"]) {
    const std::size_t count =
        glb.json["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<int>()]["count"];
    EXPECT_LE(count, 200'000u);
    total += count;
  }
  EXPECT_EQ(glb.json["meshes"].size(), 2u);
  EXPECT_EQ(total, 280'001u);
}

TEST(Splats, NeighboursInTheFileAreNeighboursInSpace) {
  const test::Glb glb = written(test::gltfScene(400, 4));
  double steps = 0, spread = 0;
  for (const auto& mesh : glb.json["meshes"]) {
    const auto places = glb.values(mesh["primitives"][0]["attributes"]["POSITION"]);
    const auto at = [&](std::size_t i) {
      return glm::vec3(places[3 * i], places[3 * i + 1], places[3 * i + 2]);
    };
    const std::size_t count = places.size() / 3;
    for (std::size_t i = 1; i < count; ++i) {
      steps += glm::distance(at(i), at(i - 1));
      spread += glm::distance(at(i), at(i * 7919 % count));
    }
  }
  EXPECT_LT(steps, 0.2 * spread);
}

TEST(Splats, SameSceneSameBytesAndNoCloudsNoNodes) {
  const test::ScratchFolder a, b;
  writeSplats(test::gltfScene(), {a.path(), {}});
  writeSplats(test::gltfScene(), {b.path(), {}});
  EXPECT_EQ(test::bytesOf(a.path() / "scene.splats.glb"), test::bytesOf(b.path() / "scene.splats.glb"));
  EXPECT_FALSE(written({.frame = base::LocalFrame({0, 0, 1, 1})}).json.contains("nodes"));
}

TEST(Splats, CanBeInterrupted) {
  const test::ScratchFolder folder;
  base::Progress progress{.cancelled = [] { return true; }};
  EXPECT_THROW(writeSplats(test::gltfScene(), {folder.path(), progress}), base::InterruptedError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace cloudgen::writer
