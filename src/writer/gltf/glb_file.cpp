// SPDX-License-Identifier: Apache-2.0
#include "writer/gltf/glb_file.hpp"

#include <tiny_gltf.h>

#include <bit>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.hpp"
#include "base/growing_file.hpp"

namespace cloudgen::writer::gltf {
namespace {

static_assert(std::endian::native == std::endian::little,
              "binary glTF is little-endian; this file copies memory as it is");

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
constexpr const char* kLevels = "MSFT_lod";
constexpr const char* kUnlit = "KHR_materials_unlit";

/// tinygltf's own value type. It knows no 64-bit integers: whoever needs one writes it as text.
tinygltf::Value valueOf(const nlohmann::json& json) {
  if (json.is_boolean()) return tinygltf::Value(json.get<bool>());
  if (json.is_number_integer()) return tinygltf::Value(json.get<int>());
  if (json.is_number()) return tinygltf::Value(json.get<double>());
  if (json.is_string()) return tinygltf::Value(json.get<std::string>());
  if (json.is_array()) {
    tinygltf::Value::Array array;
    for (const auto& element : json) array.push_back(valueOf(element));
    return tinygltf::Value(std::move(array));
  }
  tinygltf::Value::Object object;
  for (const auto& [key, element] : json.items()) object.emplace(key, valueOf(element));
  return tinygltf::Value(std::move(object));
}

tinygltf::Value attributesValue(const Attributes& attributes) {
  tinygltf::Value::Object object;
  for (const auto& [semantic, accessor] : attributes) object.emplace(semantic, tinygltf::Value(accessor));
  return tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(std::move(object))}});
}

/// Viewers without the extension fall back to a rough, non-metallic surface.
tinygltf::Material unlitMaterial(const std::string& name) {
  tinygltf::Material material;
  material.name = name;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.extensions[kUnlit] = tinygltf::Value(tinygltf::Value::Object{});
  return material;
}

void append32(std::string& out, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xff);
}

/// By number of components.
constexpr std::array<int, 5> kTypes{0, TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                                    TINYGLTF_TYPE_VEC4};

template <class T>
int indexOfLast(const std::vector<T>& parts) {
  return static_cast<int>(parts.size()) - 1;
}

}  // namespace

/// Bytes of the binary data: as they are, or made when they are written.
struct Piece {
  std::string bytes;
  std::uint64_t length = 0;
  std::function<void(std::span<char>)> fill;
};

struct GlbFile::Parts {
  tinygltf::Model model;  // without its buffer: see write()
  std::vector<Piece> pieces;
  std::uint64_t binaryBytes = 0;
  std::map<std::vector<std::uint32_t>, int> indices;  // accessors of those that are there

  tinygltf::Animation& animation() {
    if (model.animations.empty()) model.animations.emplace_back();
    return model.animations.front();
  }
  void append(std::string_view bytes) {
    if (pieces.empty() || pieces.back().fill) pieces.emplace_back();
    pieces.back().bytes.append(bytes);
    binaryBytes += bytes.size();
  }
  void pad() { append(std::string_view("\0\0\0", (4 - binaryBytes % 4) % 4)); }
};

GlbFile::GlbFile(const nlohmann::json& assetExtras) : parts_(std::make_unique<Parts>()) {
  auto& model = parts_->model;
  model.asset.version = "2.0";
  model.asset.generator = "cloudgen";
  model.asset.extras = valueOf(assetExtras);
  model.scenes.emplace_back();
  model.defaultScene = 0;
}

GlbFile::~GlbFile() = default;

int GlbFile::addView(const void* bytes, std::size_t count, int target) {
  parts_->pad();
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = parts_->binaryBytes;
  view.byteLength = count;
  view.target = target;
  parts_->append({static_cast<const char*>(bytes), count});
  parts_->model.bufferViews.push_back(std::move(view));
  return indexOfLast(parts_->model.bufferViews);
}

std::uint64_t GlbFile::addBlock(std::uint64_t bytes, std::function<void(std::span<char>)> fill) {
  parts_->pad();
  const std::uint64_t start = parts_->binaryBytes;
  parts_->pieces.push_back({{}, bytes, std::move(fill)});
  parts_->binaryBytes += bytes;
  return start;
}

int GlbFile::addColumn(const Column& column) {
  const int width = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(column.component));
  const int tight = width * column.components;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = column.start;
  view.byteStride = static_cast<std::size_t>(column.stride);
  view.byteLength = column.count * static_cast<std::size_t>(column.stride ? column.stride : tight);
  view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
  parts_->model.bufferViews.push_back(std::move(view));
  tinygltf::Accessor accessor;
  accessor.bufferView = indexOfLast(parts_->model.bufferViews);
  accessor.componentType = static_cast<int>(column.component);
  accessor.type = kTypes[static_cast<std::size_t>(column.components)];
  accessor.normalized = column.normalized;
  accessor.count = column.count;
  accessor.minValues = column.least;
  accessor.maxValues = column.most;
  parts_->model.accessors.push_back(std::move(accessor));
  return indexOfLast(parts_->model.accessors);
}

int GlbFile::addFloats(int components, std::span<const float> values, bool withBounds) {
  const int view = addView(values.data(), values.size_bytes(), TINYGLTF_TARGET_ARRAY_BUFFER);
  const auto width = static_cast<std::size_t>(components);
  const int index = addAccessor(view, TINYGLTF_COMPONENT_TYPE_FLOAT, components, values.size() / width);
  if (!withBounds) return index;
  auto& accessor = parts_->model.accessors.back();
  accessor.minValues.assign(width, std::numeric_limits<double>::max());
  accessor.maxValues.assign(width, std::numeric_limits<double>::lowest());
  for (std::size_t i = 0; i < values.size(); ++i) {
    accessor.minValues[i % width] = std::min<double>(accessor.minValues[i % width], values[i]);
    accessor.maxValues[i % width] = std::max<double>(accessor.maxValues[i % width], values[i]);
  }
  return index;
}

int GlbFile::addAccessor(int view, int componentType, int components, std::size_t count) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.componentType = componentType;
  accessor.type = kTypes[static_cast<std::size_t>(components)];
  accessor.count = count;
  parts_->model.accessors.push_back(std::move(accessor));
  return indexOfLast(parts_->model.accessors);
}

int GlbFile::addUnitShorts(int components, std::span<const std::uint16_t> values) {
  const int view = addView(values.data(), values.size_bytes(), TINYGLTF_TARGET_ARRAY_BUFFER);
  const int accessor = addAccessor(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, components,
                                   values.size() / static_cast<std::size_t>(components));
  parts_->model.accessors.back().normalized = true;
  return accessor;
}

int GlbFile::addIndices(std::span<const std::uint32_t> values) {
  const auto [found, isNew] = parts_->indices.try_emplace({values.begin(), values.end()}, 0);
  if (!isNew) return found->second;
  constexpr int kTarget = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  // 65535 is left out: it restarts primitives.
  const bool isSmall = std::ranges::all_of(values, [](std::uint32_t index) { return index < 65535; });
  if (isSmall) {
    const std::vector<std::uint16_t> shorts(values.begin(), values.end());
    found->second = addAccessor(addView(shorts.data(), shorts.size() * sizeof(std::uint16_t), kTarget),
                                TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, 1, values.size());
  } else {
    found->second = addAccessor(addView(values.data(), values.size_bytes(), kTarget),
                                TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 1, values.size());
  }
  return found->second;
}

int GlbFile::addUnpacked(int components, std::size_t count, bool unitBytes) {
  tinygltf::Accessor accessor;
  accessor.componentType = unitBytes ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE : TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.normalized = unitBytes;
  accessor.type = kTypes[static_cast<std::size_t>(components)];
  accessor.count = count;
  parts_->model.accessors.push_back(std::move(accessor));
  return indexOfLast(parts_->model.accessors);
}

int GlbFile::addUnpackedPositions(std::size_t count, const glm::dvec3& lower, const glm::dvec3& upper) {
  const int index = addUnpacked(3, count);
  auto& accessor = parts_->model.accessors.back();
  accessor.minValues = {lower.x, lower.y, lower.z};
  accessor.maxValues = {upper.x, upper.y, upper.z};
  return index;
}

int GlbFile::addBytes(std::string_view bytes) { return addView(bytes.data(), bytes.size(), 0); }

int GlbFile::addPngTexture(const std::string& name, std::string_view png) {
  tinygltf::Image image;
  image.name = name;
  image.mimeType = "image/png";
  image.bufferView = addView(png.data(), png.size(), 0);
  parts_->model.images.push_back(std::move(image));
  return addTextureOfLastImage();
}

int GlbFile::addTexture(const std::string& name, const std::string& uri) {
  tinygltf::Image image;
  image.name = name;
  image.uri = uri;
  parts_->model.images.push_back(std::move(image));
  return addTextureOfLastImage();
}

int GlbFile::addTextureOfLastImage() {
  auto& model = parts_->model;
  if (model.samplers.empty()) {
    tinygltf::Sampler sampler;
    // No mipmaps: their small levels mix the sprites of an atlas, and a card seen edge-on would become a hard
    // line.
    sampler.magFilter = sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.samplers.push_back(sampler);
  }
  tinygltf::Texture texture;
  texture.sampler = 0;
  texture.source = indexOfLast(model.images);
  model.textures.push_back(std::move(texture));
  return indexOfLast(model.textures);
}

int GlbFile::addPictureMaterial(const std::string& name, int texture) {
  tinygltf::Material material = unlitMaterial(name);
  material.alphaMode = "BLEND";
  material.pbrMetallicRoughness.baseColorTexture.index = texture;
  useExtension(kUnlit, false);
  parts_->model.materials.push_back(std::move(material));
  return indexOfLast(parts_->model.materials);
}

int GlbFile::addCardMaterial(const std::string& name, int texture) {
  const int material = addPictureMaterial(name, texture);
  parts_->model.materials.back().doubleSided = true;
  return material;
}

int GlbFile::addPlainMaterial(const std::string& name, glm::vec3 color) {
  tinygltf::Material material = unlitMaterial(name);
  material.pbrMetallicRoughness.baseColorFactor = {color.x, color.y, color.z, 1.0};
  useExtension(kUnlit, false);
  parts_->model.materials.push_back(std::move(material));
  return indexOfLast(parts_->model.materials);
}

int GlbFile::addMesh(const std::string& name, const Primitive& primitive) {
  tinygltf::Primitive out;
  for (const auto& [semantic, accessor] : primitive.attributes) out.attributes[semantic] = accessor;
  out.indices = primitive.indices;
  out.material = primitive.material;
  out.mode = primitive.points ? TINYGLTF_MODE_POINTS : TINYGLTF_MODE_TRIANGLES;
  for (const auto& [extension, value] : primitive.extensions) {
    out.extensions[extension] = valueOf(*value);
    useExtension(extension, false);
  }
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives.push_back(std::move(out));
  parts_->model.meshes.push_back(std::move(mesh));
  return indexOfLast(parts_->model.meshes);
}

int GlbFile::addNode(const Node& node) {
  tinygltf::Node out;
  out.name = node.name;
  out.mesh = node.mesh;
  if (const double scale = node.metersPerUnit; scale != 1)
    out.matrix = {scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0,
                  node.translation.x, node.translation.y, node.translation.z, 1};
  else if (node.translation != glm::dvec3(0))
    out.translation = {node.translation.x, node.translation.y, node.translation.z};
  if (node.rotation != glm::quat(1, 0, 0, 0))
    out.rotation = {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
  if (node.scale != 1) out.scale = {node.scale, node.scale, node.scale};
  if (node.extras) out.extras = valueOf(*node.extras);
  if (!node.instancing.empty()) {
    out.extensions[kInstancing] = attributesValue(node.instancing);
    // Required: a viewer that ignored it would draw one cloud an archetype, all of them at the node's place.
    useExtension(kInstancing, true);
  }
  if (node.farther >= 0) {
    out.extensions[kLevels] = valueOf({{"ids", {node.farther}}});
    useExtension(kLevels, false);
  }
  auto& model = parts_->model;
  model.nodes.push_back(std::move(out));
  if (node.isInScene) model.scenes[0].nodes.push_back(indexOfLast(model.nodes));
  return indexOfLast(model.nodes);
}

void GlbFile::nameAnimation(const std::string& name) { parts_->animation().name = name; }

int GlbFile::addKeys(int components, std::span<const float> values) {
  const int index = addAccessor(addView(values.data(), values.size_bytes(), 0), TINYGLTF_COMPONENT_TYPE_FLOAT,
                                components, values.size() / static_cast<std::size_t>(components));
  if (components == 1) {
    parts_->model.accessors.back().minValues = {values.front()};
    parts_->model.accessors.back().maxValues = {values.back()};
  }
  return index;
}

void GlbFile::animate(int node, const char* path, int times, int values) {
  tinygltf::Animation& animation = parts_->animation();
  tinygltf::AnimationSampler sampler;
  sampler.input = times;
  sampler.output = values;
  sampler.interpolation = "LINEAR";
  animation.samplers.push_back(std::move(sampler));
  tinygltf::AnimationChannel channel;
  channel.sampler = indexOfLast(animation.samplers);
  channel.target_node = node;
  channel.target_path = path;
  animation.channels.push_back(std::move(channel));
}

void GlbFile::useExtension(const std::string& name, bool required) {
  const auto addOnce = [&](std::vector<std::string>& names) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  addOnce(parts_->model.extensionsUsed);
  if (required) addOnce(parts_->model.extensionsRequired);
}

// tinygltf makes the JSON; the container around it is made here, with data that need not be there yet. tinygltf
// 2.7 keeps the binary data twice while it writes a GLB and does not look whether the stream took the bytes.
void GlbFile::write(const std::filesystem::path& file) const {
  std::ostringstream stream;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&parts_->model, stream, false, false);
  auto document = nlohmann::json::parse(stream.str());
  const std::uint64_t binaryBytes = parts_->binaryBytes;
  if (binaryBytes > 0) document["buffers"][0]["byteLength"] = binaryBytes;
  std::string json = document.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');

  const std::uint64_t padding = (4 - binaryBytes % 4) % 4, binaryLength = binaryBytes + padding;
  const std::uint64_t total = 12 + 8 + json.size() + (binaryLength ? 8 + binaryLength : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw base::OutputError(file.string(), fmt::format("would have {} bytes, over the 4 GiB of a GLB", total),
                            "take a smaller --bbox or a lower --max-puffs");
  std::string head = "glTF";
  append32(head, 2);
  append32(head, total);
  append32(head, json.size());
  head += "JSON";
  head += json;
  if (binaryLength) {
    append32(head, binaryLength);
    head += std::string_view("BIN\0", 4);
  }
  base::GrowingFile out(file);
  out.append(head);
  std::vector<char> made;
  for (const Piece& piece : parts_->pieces) {
    if (piece.fill) {
      made.resize(piece.length);
      piece.fill(made);
      out.append({made.data(), made.size()});
    } else {
      out.append(piece.bytes);
    }
  }
  out.append(std::string_view("\0\0\0", padding));
  out.commit();
}

}  // namespace cloudgen::writer::gltf
