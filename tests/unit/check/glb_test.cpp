// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "check/gltf/validate_glb.hpp"
#include "unit/check/good_scene.hpp"
#include "unit/check/made_glb.hpp"

namespace cloudgen::check::test {
namespace {

using Json = nlohmann::json;

/// One triangle with indices.
struct Triangle {
  std::vector<float> points{0, 0, 0, 1, 0, 0, 1, 2, 0};
  std::vector<std::uint16_t> indices{0, 1, 2};
  Json document = Json::parse(
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit"],"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"children":[1]},{"mesh":0}],"materials":[{"extensions":{"KHR_materials_unlit":{}}}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]},
                 {"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[{"byteLength":42}]})");

  std::string bytes() const {
    std::string binary;
    append(binary, points.data(), 4 * points.size());
    append(binary, indices.data(), 2 * indices.size());
    return container(document.dump(), binary);
  }
};

void expectRule(const std::string& bytes, const std::string& rule) {
  const ValidationResult result = validateGlbBytes(bytes, "scene.glb");
  EXPECT_FALSE(result.valid()) << rule;
  bool found = false;
  for (const Finding& finding : result.findings) found |= finding.rule == rule;
  EXPECT_TRUE(found) << "expected " << rule << ", got\n" << texts(result);
}

TEST(Glb, AGoodTriangleHasNoFindings) {
  EXPECT_EQ(texts(validateGlbBytes(Triangle().bytes(), "scene.glb")), "");
}

TEST(Glb, BrokenContainersAreFound) {
  const std::string good = Triangle().bytes();
  expectRule("", "glb-header");
  expectRule("glTX" + good.substr(4), "glb-header");
  expectRule(good.substr(0, good.size() - 4), "glb-chunk");
  expectRule(container("{", ""), "gltf-json");
  expectRule(container("[]", ""), "gltf-json");
  expectRule(container(std::string(100000, '['), ""), "gltf-json");
  expectRule(container("{\"a\":" + std::string(5000, '['), ""), "gltf-json");
  expectRule(container("{}", ""), "gltf-asset");
}

TEST(Glb, BrokenDocumentsAreFound) {
  const std::vector<std::tuple<std::string, Json, std::string>> edits{
      {"/buffers/0/byteLength", 100, "gltf-buffer"},
      {"/bufferViews/1/byteLength", 8, "gltf-buffer-view"},
      {"/bufferViews/0/buffer", 1, "gltf-buffer-view"},
      {"/accessors/0/count", 4, "gltf-accessor"},
      {"/accessors/0/count", 4000000000u, "gltf-accessor"},
      {"/accessors/0/componentType", 1, "gltf-accessor"},
      {"/accessors/0/bufferView", 9, "gltf-accessor"},
      {"/accessors/0/max", Json::array({1, 1, 0}), "gltf-position"},
      {"/accessors/1/byteOffset", 1, "gltf-accessor"},
      {"/meshes/0/primitives/0/indices", 7, "gltf-reference"},
      {"/meshes/0/primitives/0/material", 7, "gltf-reference"},
      {"/meshes/0/primitives/0/attributes", Json::object(), "gltf-attribute"},
      {"/nodes/1/mesh", 3, "gltf-reference"},
      {"/nodes/1/children", Json::array({1}), "gltf-reference"},
      {"/scenes/0/nodes", Json::array({1}), "gltf-reference"},
      {"/extensionsUsed", Json::array(), "gltf-extension"},
      {"/extensionsRequired", Json::array({"EXT_x"}), "gltf-extension"},
  };
  for (const auto& [pointer, value, rule] : edits) {
    Triangle triangle;
    triangle.document[Json::json_pointer(pointer)] = value;
    expectRule(triangle.bytes(), rule);
  }
  Triangle outside;
  outside.indices[2] = 3;
  expectRule(outside.bytes(), "gltf-index-range");
  Triangle infinite;
  infinite.points[4] = std::numeric_limits<float>::infinity();
  expectRule(infinite.bytes(), "gltf-position");
}

/// Two splats as floats.
struct Splats {
  std::vector<float> positions{0, 0, 0, 1, 1, 1}, rotations{0, 0, 0, 1, 0, 1, 0, 0}, scales{1, 2, 3, 1, 1, 1},
      opacities{0.5, 1}, colours{0, 0, 0, 1, 1, 1};
  Json document = Json::parse(
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_gaussian_splatting"],"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"mode":0,"attributes":{"POSITION":0,"KHR_gaussian_splatting:ROTATION":1,"KHR_gaussian_splatting:SCALE":2,
      "KHR_gaussian_splatting:OPACITY":3,"KHR_gaussian_splatting:SH_DEGREE_0_COEF_0":4},
      "extensions":{"KHR_gaussian_splatting":{"kernel":"ellipse","colorSpace":"srgb_rec709_display"}}}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
      {"bufferView":1,"componentType":5126,"count":2,"type":"VEC4"},{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"},
      {"bufferView":3,"componentType":5126,"count":2,"type":"SCALAR"},{"bufferView":4,"componentType":5126,"count":2,"type":"VEC3"}],
    "bufferViews":[{"buffer":0,"byteLength":24},{"buffer":0,"byteOffset":24,"byteLength":32},{"buffer":0,"byteOffset":56,"byteLength":24},
      {"buffer":0,"byteOffset":80,"byteLength":8},{"buffer":0,"byteOffset":88,"byteLength":24}],"buffers":[{"byteLength":112}]})");

  std::string bytes() const {
    std::string binary;
    for (const auto* values : {&positions, &rotations, &scales, &opacities, &colours})
      append(binary, values->data(), 4 * values->size());
    return container(document.dump(), binary);
  }
};

TEST(Glb, SplatsAreChecked) {
  EXPECT_EQ(texts(validateGlbBytes(Splats().bytes(), "scene.glb")), "");
  const std::string primitive = "/meshes/0/primitives/0",
                    extension = primitive + "/extensions/KHR_gaussian_splatting";
  const std::vector<std::pair<std::string, Json>> edits{
      {primitive + "/mode", 4},
      {extension + "/kernel", 7},
      {extension + "/colorSpace", "rgb"},
      {"/accessors/3/componentType", 5125},
      {"/accessors/4/type", "VEC2"},
      {primitive + "/attributes/KHR_gaussian_splatting:SH_DEGREE_1_COEF_0", 4},
      {primitive + "/attributes/KHR_gaussian_splatting:SH_DEGREE_2_COEF_0", 4},
  };
  for (const auto& [pointer, value] : edits) {
    Splats splats;
    splats.document[Json::json_pointer(pointer)] = value;
    SCOPED_TRACE(pointer);
    expectRule(splats.bytes(), "gltf-splats");
  }
  Splats bare;
  bare.document["meshes"][0]["primitives"][0]["attributes"].erase("KHR_gaussian_splatting:SCALE");
  expectRule(bare.bytes(), "gltf-splats");
  for (const auto& [column, value] : {std::pair{&Splats::opacities, 1.5f},
                                      {&Splats::opacities, -0.1f},
                                      {&Splats::scales, 0.0f},
                                      {&Splats::scales, -4.0f},
                                      {&Splats::rotations, 0.5f}}) {
    Splats splats;
    (splats.*column)[1] = value;
    expectRule(splats.bytes(), "gltf-splats");
  }
  Splats infinite;
  infinite.colours[2] = std::numeric_limits<float>::infinity();
  expectRule(infinite.bytes(), "gltf-finite");
}

TEST(Glb, PlacementsInstancesAndImagesAreChecked) {
  const std::vector<std::tuple<std::string, Json, std::string>> edits{
      {"/nodes/1/rotation", Json::array({0, 0, 0, 2}), "gltf-node"},
      {"/nodes/1/scale", Json::array({1, 1}), "gltf-node"},
      {"/nodes/1/matrix", Json::array({1}), "gltf-node"},
      {"/images", Json::array({Json::object()}), "gltf-image"},
      {"/images", Json::array({Json{{"bufferView", 0}}}), "gltf-image"},
      {"/images", Json::array({Json{{"bufferView", 0}, {"mimeType", "image/png"}}}), "gltf-image"},
      {"/nodes/0/extensions", Json::parse(R"({"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}})"),
       "gltf-instancing"},
      {"/nodes/1/extensions", Json::parse(R"({"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":9}}})"),
       "gltf-reference"},
  };
  for (const auto& [pointer, value, rule] : edits) {
    Triangle triangle;
    triangle.document[Json::json_pointer(pointer)] = value;
    expectRule(triangle.bytes(), rule);
  }
}

}  // namespace
}  // namespace cloudgen::check::test
