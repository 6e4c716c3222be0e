// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/gltf_document.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "check/gltf/gltf_elements.hpp"
#include "check/gltf/gltf_rules.hpp"

namespace cloudgen::check {
namespace {

constexpr int kDepthLimit = 64;

class Checker {
 public:
  Checker(const Json& document, std::string_view binary, bool hasBinary, FindingList& findings,
          const base::Progress& progress)
      : document_(document),
        binary_(binary),
        hasBinary_(hasBinary),
        findings_(findings),
        progress_(progress) {}

  void run() {
    if (member(member(document_, "asset"), "version") != "2.0")
      error("gltf-asset", "asset.version is not \"2.0\"", "every glTF 2 file says so");
    checkBuffers();
    checkBufferViews();
    const Json& accessors = list(document_, "accessors");
    for (std::size_t i = 0; i < accessors.size(); ++i) elements_.push_back(checkAccessor(accessors[i], i));
    checkMeshes();
    checkReferences();
    checkExtensions();
  }

 private:
  void error(std::string_view rule, std::string message, std::string hint) {
    findings_.error({}, rule, std::move(message), std::move(hint));
  }

  void checkBuffers() {
    const Json& buffers = list(document_, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      const auto length = integer(buffers[i], "byteLength");
      if (!length) error("gltf-buffer", fmt::format("buffer {} has no byteLength", i), "say how long it is");
      const bool inFile = i == 0 && !buffers[i].contains("uri");
      if (inFile && (!hasBinary_ || !length || *length > binary_.size() || binary_.size() - *length > 3))
        error("gltf-buffer",
              fmt::format("buffer 0 has {} bytes, the BIN chunk {}", length.value_or(0), binary_.size()),
              "they agree but for padding");
    }
  }

  void checkBufferViews() {
    const Json& views = list(document_, "bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Json& buffers = list(document_, "buffers");
      const auto buffer = integer(views[i], "buffer"), length = integer(views[i], "byteLength");
      if (!buffer || *buffer >= buffers.size() || !length) {
        error("gltf-buffer-view", fmt::format("buffer view {} has no buffer or no length", i),
              "name an existing buffer and a length");
        continue;
      }
      if (integer(views[i], "byteOffset").value_or(0) + *length >
          integer(buffers[*buffer], "byteLength").value_or(0))
        error("gltf-buffer-view", fmt::format("buffer view {} runs over the end of buffer {}", i, *buffer),
              "correct offset or length");
    }
  }

  Elements checkAccessor(const Json& accessor, std::size_t number) {
    Elements elements;
    elements.count = integer(accessor, "count").value_or(0);
    elements.componentType = integer(accessor, "componentType").value_or(0);
    elements.components = componentsOf(member(accessor, "type"));
    const Count size = componentBytes(elements.componentType) * elements.components;
    const auto wrong = [&](std::string_view what) {
      error("gltf-accessor", fmt::format("accessor {} {}", number, what), "see glTF 2.0, 3.6.2");
    };
    elements.normalized = member(accessor, "normalized") == true;
    if (size == 0 || elements.count == 0) return wrong("has no count, type or component type"), Elements{};
    elements.known = true;
    if (!accessor.contains("bufferView")) return elements;  // zeros, or given by an extension
    const Json& views = list(document_, "bufferViews");
    const auto view = integer(accessor, "bufferView");
    if (!view || *view >= views.size()) return wrong("names no buffer view"), Elements{};
    const Json& bufferView = views[*view];
    const Count offset = integer(accessor, "byteOffset").value_or(0),
                stride = integer(bufferView, "byteStride").value_or(size);
    const Count length = integer(bufferView, "byteLength").value_or(0),
                viewOffset = integer(bufferView, "byteOffset").value_or(0);
    if (stride < size || stride > (size > 252 ? size : 252))
      return wrong("has a stride that does not fit its elements"), Elements{};
    if (elements.count > length || offset + (elements.count - 1) * stride + size > length)
      return wrong("runs over the end of its buffer view"), Elements{};
    if ((offset + viewOffset) % componentBytes(elements.componentType) != 0)
      wrong("is not aligned to its components");
    const bool inFile = integer(bufferView, "buffer") == Count{0} && viewOffset + length <= binary_.size() &&
                        !member(bufferView, "extensions").is_object();
    if (inFile)
      elements.bytes = binary_.substr(viewOffset + offset, length - offset), elements.stride = stride;
    return elements;
  }

  const Elements* elementsOf(const Json& index, std::string_view what) {
    if (index.is_number_unsigned() && index.get<Count>() < elements_.size())
      return &elements_[index.get<Count>()];
    error("gltf-reference", fmt::format("{} names no accessor", what), "accessors are counted from 0");
    return nullptr;
  }

  void checkMeshes() {
    const Json& meshes = list(document_, "meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      progress_.step("validate", static_cast<double>(i) / static_cast<double>(meshes.size()));
      const Json& primitives = list(meshes[i], "primitives");
      if (primitives.empty())
        error("gltf-attribute", fmt::format("mesh {} has no primitives", i), "leave the mesh out");
      for (const Json& primitive : primitives) checkPrimitive(primitive, fmt::format("mesh {}", i));
    }
  }

  void checkPrimitive(const Json& primitive, const std::string& where) {
    const Json& attributes = member(primitive, "attributes");
    if (!attributes.is_object() || !attributes.contains("POSITION"))
      return error("gltf-attribute", where + " has a primitive without POSITION", "it cannot be drawn");
    const Elements* positions = elementsOf(attributes["POSITION"], where + " POSITION");
    if (!positions || !positions->known) return;
    for (const auto& [name, index] : attributes.items()) {
      const Elements* elements = elementsOf(index, where + " " + name);
      if (elements && elements->known && elements->count != positions->count)
        error("gltf-attribute",
              fmt::format("{}: {} has {} elements, POSITION {}", where, name, elements->count,
                          positions->count),
              "all attributes have the same count");
    }
    const auto columnOf = [&](const std::string& name) -> const Elements* {
      const Json& index = member(attributes, name.c_str());
      return index.is_number_unsigned() && index.get<Count>() < elements_.size()
                 ? &elements_[index.get<Count>()]
                 : nullptr;
    };
    checkFinite(attributes, columnOf, where, findings_);
    checkSplats(primitive, columnOf, where, findings_);
    checkPositions(*positions, list(document_, "accessors")[attributes["POSITION"].get<Count>()], where);
    if (primitive.contains("indices")) checkIndices(primitive, positions->count, where);
    const Count mode = integer(primitive, "mode").value_or(4);
    if (mode > 6) error("gltf-attribute", fmt::format("{} has the mode {}", where, mode), "modes are 0 to 6");
    if (mode == 4 && !primitive.contains("indices") && positions->count % 3 != 0)
      error("gltf-attribute",
            fmt::format("{}: {} points are no whole number of triangles", where, positions->count),
            "give three points a triangle, or indices");
  }

  void checkPositions(const Elements& positions, const Json& accessor, const std::string& where) {
    if (positions.componentType != 5126 || positions.components != 3) return;
    std::array<float, 3> low{HUGE_VALF, HUGE_VALF, HUGE_VALF}, high{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    if (positions.bytes.empty()) return;
    for (Count i = 0; i < positions.count; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        float value = 0;
        std::memcpy(&value, positions.bytes.data() + i * positions.stride + 4 * axis, 4);
        if (!std::isfinite(value))
          return error("gltf-position", fmt::format("{}: position {} is not finite", where, i),
                       "drop the vertex");
        low[axis] = std::min(low[axis], value), high[axis] = std::max(high[axis], value);
      }
    for (const auto& [key, extreme] : {std::pair{"min", low}, std::pair{"max", high}}) {
      const Json& stated = list(accessor, key);
      bool right = stated.size() == 3;
      for (std::size_t axis = 0; right && axis < 3; ++axis)
        right = stated[axis].is_number() && stated[axis].get<float>() == extreme[axis];
      if (!right)
        error("gltf-position",
              fmt::format("{}: {} of POSITION is not that of the values ({}, {}, {})", where, key, extreme[0],
                          extreme[1], extreme[2]),
              "viewers cull by it: write the exact extremes");
    }
  }

  void checkIndices(const Json& primitive, Count vertices, const std::string& where) {
    const Elements* indices = elementsOf(primitive["indices"], where + " indices");
    if (!indices || !indices->known) return;
    const Count size = componentBytes(indices->componentType);
    if (indices->components != 1 ||
        (indices->componentType != 5121 && indices->componentType != 5123 && indices->componentType != 5125))
      return error("gltf-attribute", where + " has indices that are no unsigned integers",
                   "use unsigned byte, short or int");
    if (integer(primitive, "mode").value_or(4) == 4 && indices->count % 3 != 0)
      error("gltf-attribute",
            fmt::format("{}: {} indices are no whole number of triangles", where, indices->count),
            "give three indices a triangle");
    for (Count i = 0; !indices->bytes.empty() && i < indices->count; ++i) {
      std::uint32_t index = 0;
      std::memcpy(&index, indices->bytes.data() + i * indices->stride, size);
      if (index >= vertices)
        return error(
            "gltf-index-range",
            fmt::format("{} has the index {}, but there are only {} vertices", where, index, vertices),
            "indices run from 0 to the count less one");
    }
  }

  /// The bytes of a buffer view that lies in the file; empty if there are none.
  std::string_view bytesOfView(const Json& owner) const {
    const auto index = integer(owner, "bufferView");
    const Json& views = list(document_, "bufferViews");
    if (!index || *index >= views.size() || integer(views[*index], "buffer") != Count{0}) return {};
    const Count offset = integer(views[*index], "byteOffset").value_or(0),
                length = integer(views[*index], "byteLength").value_or(0);
    return offset + length <= binary_.size() ? binary_.substr(offset, length) : std::string_view();
  }

  /// EXT_mesh_gpu_instancing: every attribute has one value an instance.
  void checkInstances(const Json& node, const std::string& where) {
    const Json& attributes =
        member(member(member(node, "extensions"), "EXT_mesh_gpu_instancing"), "attributes");
    std::optional<Count> count;
    for (const auto& [name, index] : attributes.items()) {
      const Elements* elements = elementsOf(index, where + " " + name);
      if (!elements || !elements->known) continue;
      if (count.value_or(elements->count) != elements->count)
        error("gltf-instancing", where + " has instance attributes of different counts",
              "give every instance a value in each");
      count = elements->count;
    }
    if (attributes.is_object() && !node.contains("mesh"))
      error("gltf-instancing", where + " has instances of no mesh", "name a mesh");
  }

  void checkTarget(const Json& owner, const char* key, const char* table, const std::string& where) {
    if (!owner.is_object() || !owner.contains(key)) return;
    const auto index = integer(owner, key);
    if (!index || *index >= list(document_, table).size())
      error("gltf-reference",
            fmt::format("{} names {} {}, of which there are {}", where, key,
                        owner[key].dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 20),
                        list(document_, table).size()),
            "references are counted from 0");
  }

  void checkReferences() {
    checkTarget(document_, "scene", "scenes", "the document");
    const Json& nodes = list(document_, "nodes");
    findings_.result().nodes = nodes.size();
    std::vector<int> parents(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      checkTarget(nodes[i], "mesh", "meshes", fmt::format("node {}", i));
      checkTarget(nodes[i], "camera", "cameras", fmt::format("node {}", i));
      checkTarget(nodes[i], "skin", "skins", fmt::format("node {}", i));
      checkPlacement(nodes[i], fmt::format("node {}", i), findings_);
      checkInstances(nodes[i], fmt::format("node {}", i));
      for (const Json& child : list(nodes[i], "children")) {
        if (!child.is_number_unsigned() || child.get<Count>() >= nodes.size())
          error("gltf-reference", fmt::format("node {} has a child that is not there", i),
                "nodes are counted from 0");
        else if (++parents[child.get<Count>()] == 2 || child.get<Count>() == i)
          error("gltf-reference", fmt::format("node {} has more than one parent", child.get<Count>()),
                "nodes form trees");
      }
    }
    for (const Json& scene : list(document_, "scenes"))
      for (const Json& node : list(scene, "nodes"))
        if (!node.is_number_unsigned() || node.get<Count>() >= nodes.size())
          error("gltf-reference", "a scene names a node that is not there", "nodes are counted from 0");
        else if (parents[node.get<Count>()] > 0)
          error("gltf-reference", fmt::format("node {} of a scene has a parent", node.get<Count>()),
                "scenes name root nodes");
    for (const Json& texture : list(document_, "textures")) {
      checkTarget(texture, "source", "images", "a texture");
      checkTarget(texture, "sampler", "samplers", "a texture");
    }
    for (const Json& image : list(document_, "images")) {
      checkTarget(image, "bufferView", "bufferViews", "an image");
      checkImage(image, bytesOfView(image), findings_);
    }
    for (const Json& mesh : list(document_, "meshes"))
      for (const Json& primitive : list(mesh, "primitives"))
        checkTarget(primitive, "material", "materials", "a primitive");
  }

  static void collectExtensions(const Json& value, std::set<std::string>& used) {
    if (value.is_structured())
      for (const Json& part : value) collectExtensions(part, used);
    if (!value.is_object() || !value.contains("extensions") || !value["extensions"].is_object()) return;
    for (const auto& [name, ignored] : value["extensions"].items()) used.insert(name);
  }

  void checkExtensions() {
    std::set<std::string> used, declared;
    collectExtensions(document_, used);
    for (const Json& name : list(document_, "extensionsUsed"))
      if (name.is_string()) declared.insert(name.get<std::string>());
    for (const std::string& name : used)
      if (!declared.contains(name))
        error("gltf-extension", excerpt(name) + " is used but not in extensionsUsed", "name it there");
    for (const Json& name : list(document_, "extensionsRequired"))
      if (!name.is_string() || !declared.contains(name.get<std::string>()))
        error("gltf-extension", "extensionsRequired names what extensionsUsed does not", "name it in both");
    findings_.result().elements =
        findings_.result().nodes + elements_.size() + list(document_, "meshes").size();
  }

  const Json& document_;
  std::string_view binary_;
  bool hasBinary_;
  FindingList& findings_;
  const base::Progress& progress_;
  std::vector<Elements> elements_;
};

}  // namespace

void checkGltfDocument(std::string_view json, std::string_view binary, bool hasBinary, FindingList& findings,
                       const base::Progress& progress) {
  bool tooDeep = false;
  const auto limitDepth = [&](int depth, Json::parse_event_t, Json&) {
    tooDeep |= depth > kDepthLimit;
    return !tooDeep;
  };
  const Json document = Json::parse(json, limitDepth, false);
  if (!tooDeep && document.is_object()) return Checker(document, binary, hasBinary, findings, progress).run();
  findings.error({}, "gltf-json",
                 tooDeep ? "the JSON is nested too deep" : "the first chunk is no JSON object",
                 "write it again");
}

}  // namespace cloudgen::check
