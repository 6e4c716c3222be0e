// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "support/glb_reader.hpp"
#include "support/gltf_scene.hpp"
#include "writer/gltf/card_mesh.hpp"
#include "writer/gltf/cloud_mesh.hpp"
#include "writer/gltf/gltf.hpp"
#include "writer/pictures/cloud_pictures.hpp"

namespace cloudgen::writer {
namespace {

class Cards : public testing::Test {
 protected:
  test::Glb written(const scene::Scene& scene) {
    writeCards(scene, {out_.path(), {}});
    return test::Glb(test::bytesOf(out_.path() / "scene.glb"));
  }

  test::ScratchFolder out_;
};

/// Of the scene, without those that stand for others from afar.
std::vector<nlohmann::json> nodesOf(const test::Glb& glb) {
  std::vector<nlohmann::json> nodes;
  for (const auto& node : glb.json["scenes"][0]["nodes"]) nodes.push_back(glb.json["nodes"][node.get<std::size_t>()]);
  return nodes;
}

TEST_F(Cards, FromAfarTheSameCloudsAreFewerTriangles) {
  const test::Glb glb = written(test::gltfScene());
  const auto trianglesOf = [&](const nlohmann::json& node) {
    const auto& primitive = glb.json["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    return glb.json["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<int>() / 3;
  };
  for (const auto& node : nodesOf(glb)) {
    if (node["name"] == "ground") continue;
    const auto& levels = node["extensions"]["MSFT_lod"]["ids"];
    ASSERT_EQ(levels.size(), 1u);
    EXPECT_EQ(node["extras"]["MSFT_screencoverage"].size(), 2u);
    const auto& farther = glb.json["nodes"][levels[0].get<std::size_t>()];
    EXPECT_LE(trianglesOf(farther), 32 * 6);
    EXPECT_LT(trianglesOf(farther), trianglesOf(node) / 4);
    EXPECT_EQ(farther["translation"], node["translation"]);
    EXPECT_EQ(farther["extensions"]["EXT_mesh_gpu_instancing"], node["extensions"]["EXT_mesh_gpu_instancing"]);
  }
}

TEST_F(Cards, EveryCloudIsAnInstanceAtItsPlace) {
  const scene::Scene scene = test::gltfScene();
  const test::Glb glb = written(scene);
  std::map<std::string, glm::vec3> placeOf;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    placeOf[std::to_string(scene.clouds[i].id)] = scene.instances[i].position;
  for (const auto& node : nodesOf(glb)) {
    if (node["name"] == "ground") continue;
    const auto& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const auto translations = glb.values(attributes["TRANSLATION"]), scales = glb.values(attributes["SCALE"]);
    ASSERT_EQ(node["extras"]["clouds"].size() * 3, translations.size());
    EXPECT_EQ(translations.size(), scales.size());
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
  EXPECT_EQ(glb.json["extensionsUsed"], nlohmann::json({"KHR_materials_unlit", "EXT_mesh_gpu_instancing", "MSFT_lod"}));
}

TEST_F(Cards, MaterialsAreUnlitBlendedAndCarryTheirGenus) {
  const test::Glb glb = written(test::gltfScene());
  std::vector<std::string> names;
  for (const auto& material : glb.json["materials"]) {
    names.push_back(material["name"]);
    EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
    if (names.back() == "ground") continue;
    EXPECT_EQ(material["alphaMode"], "BLEND");
    EXPECT_FALSE(material.value("doubleSided", false)) << "a picture from the other side is another one";
    const auto& texture =
        glb.json["textures"][material["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<int>()];
    const auto& image = glb.json["images"][texture["source"].get<int>()];
    const auto& view = glb.json["bufferViews"][image["bufferView"].get<int>()];
    EXPECT_EQ(image["mimeType"], "image/png");
    EXPECT_EQ(glb.binary.substr(view["byteOffset"], 4), "\x89PNG");
  }
  EXPECT_EQ(names, (std::vector<std::string>{"ground", "Ci", "Cu"}));
}

/// Pictures of the heap of the scene, and its mesh.
struct Shell {
  scene::Scene scene = test::gltfScene();
  std::vector<CloudPicture> pictures = shellPictures(scene, 0, 64, 1);
  std::vector<const image::ByteImage*> images = imagesOf(pictures);
  PictureAtlas atlas{images};
  gltf::CloudMesh mesh = gltf::meshOf(pictures, atlas, 0);

  static std::vector<const image::ByteImage*> imagesOf(const std::vector<CloudPicture>& pictures) {
    std::vector<const image::ByteImage*> out;
    for (const CloudPicture& one : pictures) out.push_back(&one.picture.image);
    return out;
  }
  glm::vec3 point(std::uint32_t vertex) const {
    return {mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]};
  }
};

TEST_F(Cards, AHeapIsSeenFromAboveBelowAndFourSides) {
  const Shell shell;
  EXPECT_EQ(shell.pictures.size(), 6u);
  EXPECT_EQ(shell.mesh.positions.size() / 3, shell.mesh.opticalDepths.size());
  EXPECT_EQ(shell.mesh.textureBoxes.size() / 2, shell.mesh.opticalDepths.size());
  for (const auto index : shell.mesh.indices) ASSERT_LT(index, shell.mesh.opticalDepths.size());
  const shape::Bounds box = shape::boundsOf(shell.scene.archetypes[0].puffs, 3);
  for (std::uint32_t vertex = 0; vertex < shell.mesh.opticalDepths.size(); ++vertex) {
    const glm::vec3 place = shell.point(vertex);
    EXPECT_TRUE(glm::all(glm::greaterThan(place, box.lower - 50.0f)) &&
                glm::all(glm::lessThan(place, box.upper + 50.0f)));
  }
}

TEST_F(Cards, FacesLookToWhereTheirPictureIsSeenFrom) {
  const Shell shell;
  std::vector<std::size_t> pictureOf;
  for (std::size_t i = 0; i < shell.pictures.size(); ++i)
    pictureOf.insert(pictureOf.end(), shell.pictures[i].picture.relief.nearness.size(), i);
  ASSERT_EQ(pictureOf.size(), shell.mesh.opticalDepths.size());
  for (std::size_t t = 0; t < shell.mesh.indices.size(); t += 3) {
    const glm::vec3 a = shell.point(shell.mesh.indices[t]), b = shell.point(shell.mesh.indices[t + 1]),
                    c = shell.point(shell.mesh.indices[t + 2]);
    EXPECT_GT(
        glm::dot(glm::cross(b - a, c - a), shell.pictures[pictureOf[shell.mesh.indices[t]]].sight.towards),
        0);
  }
}

/// What level cards hold as extinction, m2, seen from straight above: sprites end at 2.2 deviations.
double heldUpwards(const std::array<gltf::Card, 3>& cards) {
  constexpr double kReach = 2.2, kWithinBorder = 0.9111;
  double held = 0;
  for (const gltf::Card& card : cards)
    held += 2 * std::numbers::pi * kWithinBorder / (kReach * kReach) *
            static_cast<double>(std::abs(glm::cross(card.right, card.up).y) * card.opticalDepth);
  return held;
}

TEST_F(Cards, OfAPuffHoldFromAboveWhatItHolds) {
  shape::Puff puff = test::gltfScene().archetypes[0].farPuffs[0];
  const glm::quat leaning = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 0.5f, 0.3f)));
  for (const glm::quat& turn : {glm::quat(1, 0, 0, 0), leaning})
    for (const float extinctionPerMeter : {0.0008f, 0.008f, 0.32f}) {
      puff.rotation = turn;
      puff.extinctionPerMeter = extinctionPerMeter;
      EXPECT_NEAR(heldUpwards(gltf::cardsOf(puff, 1.5f)) / (1.5 * shape::extinctionArea(puff)), 1, 1e-3);
    }
}

// A primitive without a triangle is not valid glTF.
TEST_F(Cards, WhatIsTooFaintToBeSeenIsNoMesh) {
  scene::Scene scene = test::gltfScene();
  const std::size_t all = written(scene).json["meshes"].size();
  for (shape::Puff& puff : scene.archetypes[scene.lit[0].archetype].puffs) puff.extinctionPerMeter *= 1e-6f;
  const test::Glb glb = written(scene);
  EXPECT_LT(glb.json["meshes"].size(), all);
  for (const auto& accessor : glb.json["accessors"]) EXPECT_GT(accessor["count"], 0);
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

TEST_F(Cards, CloudsInTheShadowOfOthersAreDarker) {
  scene::Scene scene = test::gltfScene();
  const auto colorsIn = [](const test::Glb& glb) {
    int count = 0;
    for (const auto& node : nodesOf(glb))
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
