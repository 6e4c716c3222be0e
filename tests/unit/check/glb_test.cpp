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

}  // namespace
}  // namespace cloudgen::check::test
