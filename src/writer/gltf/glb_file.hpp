// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cloudgen::writer::gltf {

/// Attribute semantics and the accessors that hold them.
using Attributes = std::vector<std::pair<std::string, int>>;

struct Primitive {
  Attributes attributes;
  int indices = -1, material = -1;
  bool points = false;  ///< points, else triangles
  std::vector<std::pair<std::string, const nlohmann::json*>> extensions = {};
};

struct Node {
  std::string name;
  int mesh = -1;
  glm::dvec3 translation{0};
  double metersPerUnit = 1;  ///< written as a matrix, if it is not 1
  glm::quat rotation{1, 0, 0, 0};
  double scale = 1;  ///< beside a rotation; metersPerUnit is 1 then
  const nlohmann::json* extras = nullptr;
  Attributes instancing;  ///< EXT_mesh_gpu_instancing, or empty
  int farther = -1;       ///< the node that stands for it from afar (MSFT_lod), if any
  bool isInScene = true;
};

enum class Component { Byte = 5120, UnsignedByte = 5121, Short = 5122, UnsignedShort = 5123, Float = 5126 };

/// A column of `count` tuples that lies in a block.
struct Column {
  std::uint64_t start = 0;  ///< in the binary data
  std::size_t count = 0;
  int components = 1;
  Component component = Component::Float;
  bool normalized = false;
  int stride = 0;  ///< bytes from tuple to tuple, a multiple of four; 0: they follow each other
  std::vector<double> least = {}, most = {};  ///< min and max, as POSITION needs them
};

/// A binary glTF file in the making. Its parts are added one by one and referred to by their index, as in
/// glTF itself. Everything is written little-endian and in the order in which it was added, so the bytes
/// depend on nothing else.
class GlbFile {
 public:
  /// `assetExtras` goes to asset.extras.
  explicit GlbFile(const nlohmann::json& assetExtras);
  ~GlbFile();
  GlbFile(const GlbFile&) = delete;
  GlbFile& operator=(const GlbFile&) = delete;

  /// Tuples of `components` (1 to 4) floats. With `withBounds` the accessor gets min and max, as POSITION
  /// needs.
  int addFloats(int components, std::span<const float> values, bool withBounds = false);
  /// Tuples of two or four values 0..65535 that stand for 0..1.
  int addUnitShorts(int components, std::span<const std::uint16_t> values);
  /// In two bytes each where they fit; the same indices again are not written again.
  int addIndices(std::span<const std::uint32_t> values);
  /// An accessor whose values an extension unpacks: tuples of floats, or of bytes that stand for 0..1.
  int addUnpacked(int components, std::size_t count, bool unitBytes = false);
  /// The same with bounds, as POSITION needs.
  int addUnpackedPositions(std::size_t count, const glm::dvec3& lower, const glm::dvec3& upper);
  /// Bytes that an extension reads; returns the buffer view.
  int addBytes(std::string_view bytes);

  /// Columns whose bytes are made when the file is written, so that they need not stand in memory together:
  /// `fill` gets room for all of `bytes`, block after block. Columns are laid into the block by addColumn.
  /// Returns where the block starts, for Column::start.
  std::uint64_t addBlock(std::uint64_t bytes, std::function<void(std::span<char>)> fill);
  /// An accessor of a column within a block.
  int addColumn(const Column& column);

  /// Embeds a PNG file; returns the texture, sampled linearly and clamped at its borders.
  int addPngTexture(const std::string& name, std::string_view png);
  /// The same of a file at a relative path.
  int addTexture(const std::string& name, const std::string& uri);
  /// Blended, two-sided and unlit, with a texture; colour and coverage come from COLOR_0 and the texture.
  int addCardMaterial(const std::string& name, int texture);
  /// Blended and unlit, seen from its front; colour and coverage are the texture's.
  int addPictureMaterial(const std::string& name, int texture);
  /// Opaque and unlit, linear colour.
  int addPlainMaterial(const std::string& name, glm::vec3 color);
  int addMesh(const std::string& name, const Primitive& primitive);
  int addNode(const Node& node);

  /// The name of the one animation.
  void nameAnimation(const std::string& name);
  /// Seconds (1 component, ascending, with the bounds that they need) or values at them (3) of an animation.
  int addKeys(int components, std::span<const float> values);
  /// Animates "translation" or "scale" of a node, linear between its keys.
  void animate(int node, const char* path, int times, int values);

  void useExtension(const std::string& name, bool required);

  /// Writes the file, whole or not at all. Throws OutputError.
  void write(const std::filesystem::path& file) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;

  int addTextureOfLastImage();
  int addView(const void* bytes, std::size_t count, int target);
  int addAccessor(int view, int componentType, int components, std::size_t count);
};

}  // namespace cloudgen::writer::gltf
