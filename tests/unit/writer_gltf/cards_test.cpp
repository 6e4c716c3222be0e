// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "base/error.hpp"
#include "support/glb_reader.hpp"
#include "support/gltf_scene.hpp"
#include "writer/gltf/card_mesh.hpp"
#include "writer/gltf/gltf.hpp"

namespace cloudgen::writer {
namespace {

/// A data folder with one atlas of 2 x 2 sprites a genus; the pictures are not looked at by the writer.
class Cards : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(data_.path() / "templates");
    std::filesystem::create_directories(data_.path() / "textures");
    nlohmann::json manifest;
    for (const auto genus : base::allGenera()) {
      const std::string file = std::string(base::name(genus)) + ".png";
      manifest["atlases"].push_back({{"genus", base::abbreviation(genus)},
                                     {"file", file},
                                     {"columns", 2},
                                     {"rows", 2},
                                     {"tile_pixels", 64}});
      std::ofstream(data_.path() / "textures" / file, std::ios::binary) << "\x89PNG of " << base::name(genus);
    }
    std::ofstream(data_.path() / "textures" / "manifest.json") << manifest;
    ::setenv("CLOUDGEN_DATA", data_.path().c_str(), 1);
  }
  void TearDown() override { ::unsetenv("CLOUDGEN_DATA"); }

  test::Glb written(const scene::Scene& scene) {
    writeCards(scene, {out_.path(), {}});
    return test::Glb(test::bytesOf(out_.path() / "scene.glb"));
  }

  test::ScratchFolder data_, out_;
};

TEST_F(Cards, EveryCloudIsAnInstanceAtItsPlace) {
  const scene::Scene scene = test::gltfScene();
  const test::Glb glb = written(scene);
  std::map<std::string, glm::vec3> placeOf;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    placeOf[std::to_string(scene.clouds[i].id)] = scene.instances[i].position;
  for (const auto& node : glb.json["nodes"]) {
    if (node["name"] == "ground") continue;
    const auto& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const auto translations = glb.values(attributes["TRANSLATION"]),
               rotations = glb.values(attributes["ROTATION"]), scales = glb.values(attributes["SCALE"]);
    ASSERT_EQ(node["extras"]["clouds"].size() * 3, translations.size());
    EXPECT_EQ(rotations.size() / 4, scales.size() / 3);
    for (std::size_t i = 0; i < translations.size() / 3; ++i) {
      const auto found = placeOf.find(node["extras"]["clouds"][i]);
      ASSERT_NE(found, placeOf.end());
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(translations[3 * i + axis] + node["translation"][axis].get<double>(),
                    found->second[static_cast<int>(axis)], 0.01);
      placeOf.erase(found);
    }
  }
  EXPECT_TRUE(placeOf.empty());
}

TEST_F(Cards, ViewersWithoutInstancingRefuseInsteadOfDrawingAWrongScene) {
  const test::Glb glb = written(test::gltfScene());
  EXPECT_EQ(glb.json["extensionsRequired"], nlohmann::json({"EXT_mesh_gpu_instancing"}));
  EXPECT_EQ(glb.json["extensionsUsed"], nlohmann::json({"KHR_materials_unlit", "EXT_mesh_gpu_instancing"}));
}

TEST_F(Cards, MaterialsAreUnlitBlendedAndCarryTheirGenus) {
  const test::Glb glb = written(test::gltfScene());
  std::vector<std::string> names;
  for (const auto& material : glb.json["materials"]) {
    names.push_back(material["name"]);
    EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
    if (names.back() == "ground") continue;
    EXPECT_EQ(material["alphaMode"], "BLEND");
    EXPECT_EQ(material["doubleSided"], true);
    const auto& texture =
        glb.json["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<int>()];
    const auto& image = glb.json["images"][texture["source"].get<int>()];
    const auto& view = glb.json["bufferViews"][image["bufferView"].get<int>()];
    EXPECT_EQ(image["mimeType"], "image/png");
    EXPECT_EQ(glb.binary.substr(view["byteOffset"], view["byteLength"]),
              "\x89PNG of " + std::string(names.back() == "Cu" ? "cumulus" : "cirrus"));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"ground", "Cu", "Ci"}));
}

TEST_F(Cards, MeshesAreSoundAndBrighterOnTop) {
  const scene::Scene scene = test::gltfScene();
  const image::SpriteAtlas atlas{.columns = 2, .rows = 2, .tilePixels = 64};
  const auto mesh = gltf::cardsOf(scene.archetypes[0], scene.lit[0], 1, atlas);
  const std::size_t vertices = mesh.positions.size() / 3;
  EXPECT_EQ(vertices, 4u * 3 * 9);
  EXPECT_EQ(mesh.textureBoxes.size(), 2 * vertices);
  EXPECT_EQ(mesh.colors.size(), 4 * vertices);
  for (const auto index : mesh.indices) EXPECT_LT(index, vertices);
  for (const float coordinate : mesh.textureBoxes) EXPECT_TRUE(coordinate > 0 && coordinate < 1);
  std::size_t lowest = 0, highest = 0;
  for (std::size_t i = 0; i < vertices; ++i) {
    if (mesh.positions[3 * i + 1] < mesh.positions[3 * lowest + 1]) lowest = i;
    if (mesh.positions[3 * i + 1] > mesh.positions[3 * highest + 1]) highest = i;
  }
  EXPECT_GT(mesh.colors[4 * highest], mesh.colors[4 * lowest]);
  // The picture stands upright: higher on the card is nearer to the upper edge of the sprite (v grows
  // downwards).
  EXPECT_LT(mesh.textureBoxes[2 * 6 + 1], mesh.textureBoxes[1]);
  EXPECT_GT(mesh.positions[3 * 6 + 1], mesh.positions[1]);
}

/// What the cards of a mesh hold as extinction, m2, seen from straight above: sprites end at 2.2 deviations.
double heldUpwards(const gltf::CardMesh& mesh) {
  constexpr std::size_t kVertices = 9;
  constexpr double kReach = 2.2, kWithinBorder = 0.9451;
  const auto corner = [&](std::size_t vertex) {
    return glm::dvec3(mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]);
  };
  double held = 0;
  for (std::size_t first = 0; first < mesh.opticalDepths.size(); first += kVertices) {
    const glm::dvec3 right = (corner(first + 2) - corner(first)) / (2 * kReach),
                     up = (corner(first + 6) - corner(first)) / (2 * kReach);
    held += 2 * std::numbers::pi * kWithinBorder * std::abs(glm::cross(right, up).y) *
            static_cast<double>(mesh.opticalDepths[first]);
  }
  return held;
}

TEST_F(Cards, FromAboveTheyHoldWhatTheirPuffsHold) {
  scene::Scene scene = test::gltfScene();
  const glm::quat leaning = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 0.5f, 0.3f)));
  for (const glm::quat& turn : {glm::quat(1, 0, 0, 0), leaning})
    for (const float denser : {0.1f, 1.0f, 40.0f}) {
      scene::Archetype archetype = scene.archetypes[0];
      double expected = 0;
      for (shape::Puff& puff : archetype.farPuffs) {
        puff.rotation = turn;
        puff.extinctionPerMeter *= denser;
        expected += 1.5 * shape::extinctionArea(puff);
      }
      const auto mesh =
          gltf::cardsOf(archetype, scene.lit[0], 1.5f, {.columns = 2, .rows = 2, .tilePixels = 64});
      EXPECT_NEAR(heldUpwards(mesh) / expected, 1, 1e-3) << denser;
      for (const float depth : mesh.opticalDepths) EXPECT_GT(depth, 0);
    }
}

TEST_F(Cards, OpacityIsThatOfTheOpticalDepth) {
  const scene::Scene scene = test::gltfScene();
  const auto mesh =
      gltf::cardsOf(scene.archetypes[1], scene.lit[2], 1.5f, {.columns = 2, .rows = 2, .tilePixels = 64});
  for (std::size_t i = 0; i < mesh.opticalDepths.size(); ++i)
    EXPECT_NEAR(1 - mesh.colors[4 * i + 3] / 65535.0, std::exp(-mesh.opticalDepths[i]), 1e-4);
}

TEST_F(Cards, TheGroundLiesUnderTheBox) {
  const scene::Scene scene = test::gltfScene();
  const test::Glb glb = written(scene);
  const auto& node = glb.json["nodes"][0];
  ASSERT_EQ(node["name"], "ground");
  const auto& accessor =
      glb.json["accessors"]
              [glb.json["meshes"][node["mesh"].get<int>()]["primitives"][0]["attributes"]["POSITION"]
                   .get<int>()];
  EXPECT_NEAR(accessor["min"][0].get<double>() + node["translation"][0].get<double>(),
              scene.frame.lowerCorner().x, 0.01);
  EXPECT_EQ(accessor["min"][1], 20.0);
  EXPECT_EQ(accessor["max"][1], 20.0);
  EXPECT_NEAR(accessor["max"][2].get<double>() + node["translation"][2].get<double>(),
              scene.frame.upperCorner().y, 0.01);
}

TEST_F(Cards, SameSceneSameBytes) {
  writeCards(test::gltfScene(), {out_.path(), {}});
  const std::string first = test::bytesOf(out_.path() / "scene.glb");
  writeCards(test::gltfScene(), {out_.path(), {}});
  EXPECT_EQ(test::bytesOf(out_.path() / "scene.glb"), first);
}

TEST_F(Cards, NameTheMissingTexture) {
  std::filesystem::remove(data_.path() / "textures" / "cumulus.png");
  try {
    written(test::gltfScene());
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_NE(error.where().find("cumulus.png"), std::string::npos);
  }
}

TEST_F(Cards, CloudsInTheShadowOfOthersAreDarker) {
  scene::Scene scene = test::gltfScene();
  const auto colorsIn = [](const test::Glb& glb) {
    int count = 0;
    for (const auto& node : glb.json["nodes"])
      if (node.contains("extensions"))
        count += node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].contains("_COLOR_0");
    return count;
  };
  EXPECT_EQ(colorsIn(written(scene)), 0);
  scene.instances[0].sunlight = 0.4f;
  EXPECT_EQ(colorsIn(written(scene)), 1);
}

TEST_F(Cards, TerrainIsTheGround) {
  scene::Scene scene = test::gltfScene();
  const glm::dvec2 lower = scene.frame.lowerCorner(), upper = scene.frame.upperCorner();
  scene.terrain = {3, 3, lower, 0.5 * (upper - lower), std::vector<float>(9, 20)};
  scene.terrain.heights[4] = 900;
  const test::Glb glb = written(scene);
  for (const auto& mesh : glb.json["meshes"]) {
    if (mesh["name"] != "ground") continue;
    const auto& position =
        glb.json["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(position["max"][1], 900);
    EXPECT_EQ(position["min"][1], 20);
    EXPECT_TRUE(mesh["primitives"][0]["attributes"].contains("NORMAL"));
  }
  EXPECT_EQ(glb.json["asset"]["extras"]["terrain"]["heights_m"][4], 900);
}

}  // namespace
}  // namespace cloudgen::writer
