// SPDX-License-Identifier: Apache-2.0
#include "check/tiles3d/content_points.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "check/gltf/glb_parts.hpp"
#include "check/gltf/read_spz.hpp"

namespace cloudgen::check {
namespace {

using nlohmann::json;

constexpr int kDeepest = 64;
constexpr std::size_t kMostPoints = 100'000'000, kMostVisits = 1'000'000;

glm::dmat4 placeOf(const json& node) {
  glm::dmat4 matrix(1);
  if (node.contains("matrix")) {
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node["matrix"].at(static_cast<std::size_t>(i));
    return matrix;
  }
  const auto parts = [&](const char* key, std::size_t count, double usual) {
    std::vector<double> values(count, usual);
    for (std::size_t i = 0; node.contains(key) && i < count; ++i) values[i] = node[key].at(i);
    return values;
  };
  const auto move = parts("translation", 3, 0), size = parts("scale", 3, 1);
  auto turn = parts("rotation", 4, 0);
  if (!node.contains("rotation")) turn[3] = 1;
  matrix = glm::translate(matrix, glm::dvec3(move[0], move[1], move[2])) *
           glm::mat4_cast(glm::dquat(turn[3], turn[0], turn[1], turn[2]));
  return glm::scale(matrix, glm::dvec3(size[0], size[1], size[2]));
}

class Walk {
 public:
  Walk(const GlbParts& glb, const std::function<void(const glm::dvec3&)>& visit) : glb_(glb), visit_(visit) {}

  void scene() {
    const json& root = glb_.root();
    if (!root.contains("scenes")) return;
    for (const json& node : root["scenes"].at(root.value("scene", std::size_t{0})).value("nodes", json::array()))
      visitNode(node, glm::dmat4(1), 0);
  }

 private:
  void visitNode(std::size_t index, const glm::dmat4& parent, int depth) {
    if (depth > kDeepest || ++visits_ > kMostVisits) glb_.fail("has nodes within nodes too deep or too often");
    const json& node = glb_.root().at("nodes").at(index);
    const glm::dmat4 matrix = parent * placeOf(node);
    if (node.contains("mesh"))
      for (const json& primitive : glb_.root().at("meshes").at(node["mesh"].get<std::size_t>()).at("primitives"))
        for (const glm::dmat4& instance : instancesOf(node)) visitPrimitive(primitive, matrix * instance);
    for (const json& child : node.value("children", json::array())) visitNode(child, matrix, depth + 1);
  }

  /// Where EXT_mesh_gpu_instancing puts a mesh; as it is written here, moved only.
  std::vector<glm::dmat4> instancesOf(const json& node) const {
    const json extensions = node.value("extensions", json::object());
    if (!extensions.contains("EXT_mesh_gpu_instancing")) return {glm::dmat4(1)};
    const json& attributes = extensions["EXT_mesh_gpu_instancing"].at("attributes");
    if (!attributes.contains("TRANSLATION")) return {glm::dmat4(1)};
    const auto shifts = glb_.floats(attributes["TRANSLATION"], 3);
    std::vector<glm::dmat4> out;
    for (std::size_t i = 0; i + 2 < shifts.size(); i += 3)
      out.push_back(glm::translate(glm::dmat4(1), glm::dvec3(shifts[i], shifts[i + 1], shifts[i + 2])));
    return out;
  }

  void visitPrimitive(const json& primitive, const glm::dmat4& matrix) {
    const auto place = [&](const glm::dvec3& point) {
      if (++points_ > kMostPoints) glb_.fail("has more points than can be looked at");
      visit_(glm::dvec3(matrix * glm::dvec4(point, 1)));
    };
    const json splats = primitive.value("extensions", json::object())
                            .value("KHR_gaussian_splatting", json::object())
                            .value("extensions", json::object());
    if (splats.contains("KHR_gaussian_splatting_compression_spz_2")) {
      const json& view = splats["KHR_gaussian_splatting_compression_spz_2"].at("bufferView");
      const std::size_t count = readPackedSplats(glb_.view(view), glb_.where(),
                                                 [&](const ReadSplat& splat) { place(splat.center); });
      const std::size_t accessor = primitive.at("attributes").at("POSITION");
      if (glb_.root().at("accessors").at(accessor).at("count") != count)
        glb_.fail("has packed splats of another number than their accessors");
      return;
    }
    const auto positions = glb_.floats(primitive.at("attributes").at("POSITION"), 3);
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
      place({positions[i], positions[i + 1], positions[i + 2]});
  }

  const GlbParts& glb_;
  const std::function<void(const glm::dvec3&)>& visit_;
  std::size_t points_ = 0, visits_ = 0;
};

}  // namespace

void visitContentPoints(std::string_view bytes, const std::string& where,
                        const std::function<void(const glm::dvec3&)>& visit) {
  const GlbParts glb(bytes, where, "is it binary glTF?");
  try {
    Walk(glb, visit).scene();
  } catch (const json::exception& error) {
    glb.fail(std::string("cannot be read (") + error.what() + ")");
  }
}

}  // namespace cloudgen::check
