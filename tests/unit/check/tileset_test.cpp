// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/validate_tileset.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/gzip.hpp"
#include "check/tiles3d/content_path.hpp"
#include "unit/check/made_glb.hpp"

namespace cloudgen::check::test {
namespace {

using Json = nlohmann::json;

/// A point cloud of one point, 100 m above the middle of its axes.
std::string pointAbove(float meters = 100) {
  MadeGlb glb;
  const auto column = glb.column(std::vector<float>{0, meters, 0}, "VEC3", 3);
  glb.document["accessors"][0]["min"] = {0, meters, 0};
  glb.document["accessors"][0]["max"] = {0, meters, 0};
  glb.document["asset"]["version"] = "2.0";
  glb.document["buffers"] = {{{"byteLength", glb.binary.size()}}};
  glb.document["meshes"] = {{{"primitives", {{{"mode", 0}, {"attributes", {{"POSITION", column}}}}}}}};
  glb.document["nodes"] = {{{"mesh", 0}}};
  glb.document["scenes"] = {{{"nodes", {0}}}};
  glb.document["scene"] = 0;
  return glb.bytes();
}

/// A root and two children about 0 N 0 E; the axes of the contents stand there with up along x.
struct Tileset {
  Json document = Json::parse(R"({"asset": {"version": "1.1"}, "geometricError": 1000,
    "schema": {"id": "s", "classes": {"tile": {"properties": {
      "clouds": {"type": "SCALAR", "componentType": "UINT32", "required": true},
      "genera": {"type": "STRING"}}}}},
    "root": {"refine": "REPLACE", "geometricError": 100,
      "transform": [0,1,0,0, 0,0,1,0, 1,0,0,0, 6378137,0,0,1],
      "boundingVolume": {"region": [-0.01, -0.01, 0.01, 0.01, 0, 1000]},
      "content": {"uri": "tiles/0.glb"}, "metadata": {"class": "tile", "properties": {"clouds": 3, "genera": "Cu"}},
      "children": [
        {"geometricError": 0, "boundingVolume": {"region": [-0.01, -0.01, 0.001, 0.01, 0, 1000]},
         "content": {"uri": "tiles/1.glb", "boundingVolume": {"region": [-0.001, -0.001, 0.001, 0.001, 0, 500]}}},
        {"geometricError": 50, "boundingVolume": {"box": [0, 0, 500, 10000, 0, 0, 0, 10000, 0, 0, 0, 400]},
         "content": {"uri": "tiles/2.glb"}}]}})");
  std::map<std::string, std::string> files{
      {"tiles/0.glb", pointAbove()}, {"tiles/1.glb", pointAbove()}, {"tiles/2.glb", pointAbove(300)}};

  ValidationResult result() const { return resultOf(document.dump()); }
  ValidationResult resultOf(const std::string& bytes) const {
    return validateTilesetBytes(bytes, "tileset.json", [&](const std::string& path) {
      const auto found = files.find(path);
      if (found == files.end()) throw base::InputError(path, "is missing", "write it");
      return found->second;
    });
  }
};

std::string texts(const ValidationResult& result) {
  std::string out;
  for (const Finding& finding : result.findings) out += text(finding) + "\n";
  return out;
}

void expectRule(const ValidationResult& result, const std::string& rule, const std::string& what) {
  EXPECT_FALSE(result.valid()) << what;
  bool found = false;
  for (const Finding& finding : result.findings) found |= finding.rule == rule;
  EXPECT_TRUE(found) << what << ": expected " << rule << ", got\n" << texts(result);
}

TEST(Tileset, AGoodOneHasNoFindings) {
  Tileset tileset;
  EXPECT_EQ(texts(tileset.result()), "");
  EXPECT_EQ(tileset.result().nodes, 3u);
  for (auto& [path, bytes] : tileset.files) bytes = base::gzipped(bytes);
  EXPECT_EQ(texts(tileset.resultOf(base::gzipped(tileset.document.dump()))), "") << "all of it as gzip";
}

TEST(Tileset, BrokenOnesAreFound) {
  const std::vector<std::tuple<std::string, Json, std::string>> edits{
      {"asset", Json::object(), "tiles-asset"},
      {"asset/version", "2.0", "tiles-asset"},
      {"geometricError", nullptr, "tiles-required"},
      {"geometricError", "big", "tiles-error"},
      {"geometricError", 10, "tiles-error"},
      {"root", nullptr, "tiles-required"},
      {"root/geometricError", nullptr, "tiles-required"},
      {"root/geometricError", -1, "tiles-error"},
      {"root/children/1/geometricError", 200, "tiles-error"},
      {"root/refine", "replace", "tiles-refine"},
      {"root/children/0/refine", 1, "tiles-refine"},
      {"root/boundingVolume", Json::object(), "tiles-volume"},
      {"root/boundingVolume", nullptr, "tiles-volume"},
      {"root/boundingVolume/region", Json::array({0, 0, 1}), "tiles-volume"},
      {"root/boundingVolume/region/3", 57.0, "tiles-volume"},
      {"root/boundingVolume/region/0", -180.0, "tiles-volume"},
      {"root/boundingVolume/region/1", 0.02, "tiles-volume"},
      {"root/boundingVolume/region/4", 2000, "tiles-volume"},
      {"root/boundingVolume/region/5", 900, "tiles-volume"},
      {"root/children/0/boundingVolume/region/2", 0.02, "tiles-volume"},
      {"root/children/0/boundingVolume/region/5", 1100, "tiles-volume"},
      {"root/children/0/content/boundingVolume/region/5", 1100, "tiles-volume"},
      {"root/children/1/boundingVolume/box/2", 5000, "tiles-volume"},
      {"root/children/1/boundingVolume/box/3", 0, "tiles-volume"},
      {"root/children/1/boundingVolume", Json{{"sphere", {0, 0, 0, -1}}}, "tiles-volume"},
      {"root/children/1/boundingVolume", Json{{"sphere", {0, 0, 0, 5000}}}, "tiles-volume"},
      {"root/transform", Json::array({1, 0, 0}), "tiles-transform"},
      {"root/transform/3", 1, "tiles-transform"},
      {"root/transform/1", 0, "tiles-transform"},
      {"root/children", Json::array(), "tiles-required"},
      {"root/children", 3, "tiles-required"},
      {"root/children/0", "tile", "tiles-required"},
      {"root/content", Json::object(), "tiles-content"},
      {"root/contents", Json::array({Json{{"uri", "tiles/0.glb"}}}), "tiles-content"},
      {"root/content/uri", "tiles/9.glb", "tiles-content"},
      {"root/content/uri", "../0.glb", "tiles-path"},
      {"root/content/uri", "tiles/%2e%2e/%2e%2e/0.glb", "tiles-path"},
      {"root/content/uri", "/tiles/0.glb", "tiles-path"},
      {"root/content/uri", "https://example.org/0.glb", "tiles-path"},
      {"root/content/uri", "", "tiles-path"},
      {"root/transform/12", 6378937, "tiles-content"},
      {"root/children/0/content/boundingVolume/region/4", 200, "tiles-content"},
      {"root/children/1/boundingVolume/box/11", 100, "tiles-content"},
      {"extensionsRequired", Json::array({"3DTILES_x"}), "tiles-extension"},
      {"extensions", Json{{"3DTILES_x", 1}}, "tiles-extension"},
      {"root/metadata/class", "cloud", "tiles-metadata"},
      {"root/metadata/properties", Json{{"genera", "Cu"}}, "tiles-metadata"},
      {"root/metadata/properties/colour", 1, "tiles-metadata"},
      {"root/metadata/properties/clouds", -3, "tiles-metadata"},
      {"root/metadata/properties/genera", 7, "tiles-metadata"},
      {"schema", nullptr, "tiles-metadata"},
  };
  for (const auto& [pointer, value, rule] : edits) {
    Tileset tileset;
    tileset.document[Json::json_pointer("/" + pointer)] = value;
    expectRule(tileset.result(), rule, pointer + " = " + value.dump());
  }
  for (const char* pointer : {"root/refine", "root/boundingVolume", "root"}) {
    Tileset tileset;
    const Json::json_pointer at("/" + std::string(pointer));
    tileset.document[at.parent_pointer()].erase(at.back());
    EXPECT_FALSE(tileset.result().valid()) << pointer;
  }
}

TEST(Tileset, BrokenBytesAreFound) {
  const Tileset tileset;
  const std::string packed = base::gzipped(tileset.document.dump());
  for (const std::string& bytes : {std::string("[]"), std::string("{"), std::string(), std::string(100'000, '['),
                                   "{\"root\":" + std::string(5000, '['), packed.substr(0, packed.size() / 2)})
    expectRule(tileset.resultOf(bytes), "tiles-json", bytes.substr(0, 10));
}

TEST(Tileset, BrokenContentsAreFound) {
  Tileset cut;
  cut.files["tiles/1.glb"].resize(100);
  expectRule(cut.result(), "glb-chunk", "cut short");
  Tileset packed;
  packed.files["tiles/1.glb"] = base::gzipped(pointAbove()).substr(0, 50);
  expectRule(packed.result(), "tiles-content", "broken gzip");
  Tileset low;
  low.files["tiles/1.glb"] = pointAbove(-100);
  expectRule(low.result(), "tiles-content", "below its volume");
  Tileset other;
  other.files["tiles/1.glb"] = "{}";
  EXPECT_TRUE(other.result().valid());
  EXPECT_EQ(other.result().findings.size(), 1u) << "a warning that it is not looked into";
}

TEST(Tileset, ContentsMayNeedOnlyWhatIsTold) {
  Tileset tileset;
  tileset.document["extensionsUsed"] = {"3DTILES_content_gltf"};
  tileset.document["extensions"]["3DTILES_content_gltf"] = Json::object();
  EXPECT_EQ(texts(tileset.result()), "");
  tileset.document["extensions"]["3DTILES_content_gltf"]["extensionsRequired"] = {"KHR_x"};
  expectRule(tileset.result(), "tiles-extension", "required but not used");
}

TEST(Tileset, RegionsMayCrossTheAntimeridian) {
  constexpr double kPi = 3.141592653589793;
  Tileset tileset;
  Json& root = tileset.document["root"];
  root["transform"] = {0, -1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, -6378137, 0, 0, 1};
  root["boundingVolume"]["region"] = {kPi - 0.01, -0.01, -kPi + 0.01, 0.01, 0, 1000};
  root["children"][0]["boundingVolume"]["region"] = {kPi - 0.01, -0.01, -kPi + 0.001, 0.01, 0, 1000};
  root["children"][0]["content"]["boundingVolume"]["region"] = {kPi - 0.001, -0.001, kPi, 0.001, 0, 500};
  EXPECT_EQ(texts(tileset.result()), "");
  root["children"][0]["boundingVolume"]["region"][2] = -kPi + 0.02;
  expectRule(tileset.result(), "tiles-volume", "farther east than the parent");
}

TEST(ContentPath, LeadsNowhereElse) {
  EXPECT_EQ(contentPath("tiles/a.glb"), "tiles/a.glb");
  EXPECT_EQ(contentPath("./tiles/../a%20b.glb?v=1"), "a b.glb");
  for (const char* uri : {"", "..", "../a", "a/../../b", "/a", "a\\b", "c:a", "data:,x", "%2e%2e/a", "a%", "a%zz", ".", "a/"})
    EXPECT_EQ(contentPath(uri), "") << uri;
}

}  // namespace
}  // namespace cloudgen::check::test
