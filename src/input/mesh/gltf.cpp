// SPDX-License-Identifier: Apache-2.0
#include <tiny_gltf.h>

#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "input/mesh/mesh_builder.hpp"
#include "input/mesh/mesh_file.hpp"

namespace cloudgen::input::mesh {
namespace {

/// The numbers of an accessor, read within their buffer; what reaches beyond is refused.
class Numbers {
 public:
  Numbers(const tinygltf::Model& model, int accessor, int components, const MeshBuilder& builder) {
    const auto& it = part(model.accessors, accessor, builder, "an accessor");
    if (it.sparse.isSparse) builder.refuse("has a sparse accessor");
    const auto& view = part(model.bufferViews, it.bufferView, builder, "a buffer view");
    const auto& bytes = part(model.buffers, view.buffer, builder, "a buffer").data;
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(it.componentType)),
              stride = it.ByteStride(view);
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(it.type)) != components || size <= 0 ||
        stride < size * components)
      builder.refuse("has an accessor of a wrong type");
    count_ = it.count, stride_ = static_cast<std::size_t>(stride), type_ = it.componentType;
    size_ = static_cast<std::size_t>(size);
    const std::size_t begin = view.byteOffset + it.byteOffset;
    if (begin < view.byteOffset || begin > bytes.size() || count_ > bytes.size() ||
        (count_ > 0 &&
         (bytes.size() - begin < size_ * static_cast<std::size_t>(components) ||
          (bytes.size() - begin - size_ * static_cast<std::size_t>(components)) / stride_ < count_ - 1)))
      builder.refuse("has an accessor that reaches beyond its buffer");
    begin_ = bytes.data() + begin;
  }

  std::size_t count() const { return count_; }
  bool floats() const { return type_ == TINYGLTF_COMPONENT_TYPE_FLOAT; }
  double at(std::size_t item, std::size_t component) const {
    const unsigned char* from = begin_ + item * stride_ + component * size_;
    switch (type_) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return as<std::uint8_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return as<std::uint16_t>(from);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return as<std::uint32_t>(from);
      case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return as<float>(from);
      default:
        return -1;
    }
  }

  template <class T>
  static const T& part(const std::vector<T>& parts, int index, const MeshBuilder& builder, const char* what) {
    if (index < 0 || index >= static_cast<int>(parts.size()))
      builder.refuse(std::string("names ") + what + " that is not in it");
    return parts[static_cast<std::size_t>(index)];
  }

 private:
  template <class T>
  static double as(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return static_cast<double>(value);
  }

  const unsigned char* begin_ = nullptr;
  std::size_t count_ = 0, stride_ = 0, size_ = 0;
  int type_ = 0;
};

glm::dmat4 placeOf(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  glm::dmat4 place(1);
  if (node.translation.size() == 3)
    place[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
  if (node.rotation.size() == 4)
    place *=
        glm::mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
  for (int i = 0; node.scale.size() == 3 && i < 3; ++i) place[i] *= node.scale[static_cast<std::size_t>(i)];
  return place;
}

void addPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const glm::dmat4& place,
                  MeshBuilder& builder) {
  if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) return;
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) builder.refuse("has triangles without POSITION");
  const Numbers points(model, position->second, 3, builder);
  if (!points.floats()) builder.refuse("has positions that are not floats");
  const auto first = static_cast<std::int64_t>(builder.points());
  for (std::size_t i = 0; i < points.count(); ++i)
    builder.addPoint(place * glm::dvec4(points.at(i, 0), points.at(i, 1), points.at(i, 2), 1));
  std::array<std::int64_t, 3> corners{};
  if (primitive.indices < 0) {
    for (std::int64_t i = 0; i + 2 < static_cast<std::int64_t>(points.count()); i += 3) {
      corners = {first + i, first + i + 1, first + i + 2};
      builder.addPolygon(corners);
    }
    return;
  }
  const Numbers indices(model, primitive.indices, 1, builder);
  for (std::size_t i = 0; i + 2 < indices.count(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) corners[k] = first + static_cast<std::int64_t>(indices.at(i + k, 0));
    builder.addPolygon(corners);
  }
}

/// A node and what hangs on it. Trees deeper or larger than any real one are circles.
struct Walk {
  const tinygltf::Model& model;
  MeshBuilder& builder;
  int nodes = 0;

  void visit(int index, const glm::dmat4& parent, int depth) {
    constexpr int kDeepest = 64, kMostNodes = 100'000;
    if (depth > kDeepest || ++nodes > kMostNodes) builder.refuse("has nodes in a circle, or too many");
    const tinygltf::Node& node = Numbers::part(model.nodes, index, builder, "a node");
    const glm::dmat4 place = parent * placeOf(node);
    if (node.mesh >= 0)
      for (const auto& primitive : Numbers::part(model.meshes, node.mesh, builder, "a mesh").primitives)
        addPrimitive(model, primitive, place, builder);
    for (const int child : node.children) visit(child, place, depth + 1);
  }
};

/// Pictures say nothing about a shape.
bool skipImage(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
               void*) {
  return true;
}

/// Files of the folder itself only.
bool readBeside(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* folder) {
  const auto& own = *static_cast<const std::filesystem::path*>(folder);
  try {
    const std::string bytes = base::readFile(own / std::filesystem::path(name).filename(), 512ull << 20);
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const base::InputError& problem) {
    *error += std::string(problem.what());
    return false;
  }
}

bool isBeside(const std::string& name, void* folder) {
  const auto& own = *static_cast<const std::filesystem::path*>(folder);
  std::error_code none;
  return !own.empty() && std::filesystem::is_regular_file(own / std::filesystem::path(name).filename(), none);
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

base::Mesh readGltf(std::string_view bytes, const std::string& where, const std::filesystem::path& folder) {
  MeshBuilder builder(where);
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  auto own = folder;
  loader.SetImageLoader(skipImage, nullptr);
  loader.SetFsCallbacks(
      {isBeside, [](const std::string& path, void*) { return path; }, readBeside, nullptr, &own});
  const auto size = static_cast<unsigned int>(bytes.size());
  bool read = false;
  try {
    read = bytes.starts_with("glTF")
               ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(bytes.data()), size)
               : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "");
  } catch (const std::exception& problem) {  // its JSON parser's
    error = problem.what();
  }
  if (!read) builder.refuse("is not glTF 2.0 (" + firstLine(error) + ")");
  Walk walk{model, builder};
  const int scene = model.defaultScene >= 0 ? model.defaultScene : 0;
  if (!model.scenes.empty())
    for (const int root : Numbers::part(model.scenes, scene, builder, "a scene").nodes)
      walk.visit(root, glm::dmat4(1), 0);
  return builder.finished();
}

}  // namespace cloudgen::input::mesh
