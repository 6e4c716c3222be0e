// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <runtime_pack_generated.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/mapped_file.hpp"
#include "runtime/status.hpp"
#include "runtime/vec3.hpp"

namespace cloudgen::runtime {

inline constexpr int kYawSteps = 16;
/// More levels of detail than this are not looked at.
inline constexpr std::uint32_t kMostLevels = 8;
/// The newest version of the format that is read.
inline constexpr std::uint32_t kPackVersion = 1;

/// An archetype as it is asked for every frame.
struct ArchetypeInfo {
  std::uint32_t levels = 0;
  std::array<std::uint32_t, kMostLevels> first{}, count{};  ///< of the pack's puffs
  std::array<float, kMostLevels> errorMeters{};
  Vec3 middle;             ///< of the sphere about it, from its origin
  float radiusMeters = 0;  ///< of that sphere, whatever the heading
};

/// A pack whose bytes were verified: every index in it is in range and every number that is used is finite. The
/// arrays are those of the file, where they lie.
class PackView {
 public:
  /// Maps a file. On failure the view is empty.
  Status open(const char* path) noexcept;
  /// Takes bytes that start at a multiple of 8 and outlive the view.
  Status open(std::span<const std::uint8_t> bytes) noexcept;

  bool empty() const noexcept { return root_ == nullptr; }
  const pack::RuntimePack& root() const noexcept { return *root_; }
  std::span<const pack::Puff> puffs() const noexcept { return puffs_; }
  std::span<const pack::Response> responses() const noexcept { return responses_; }
  std::span<const pack::Instance> instances() const noexcept { return instances_; }
  std::span<const pack::Tile> tiles() const noexcept { return tiles_; }
  std::span<const ArchetypeInfo> archetypes() const noexcept { return archetypes_; }
  /// Where the puffs stand in their archetypes; one a puff.
  std::span<const Vec3> centers() const noexcept { return centers_; }

 private:
  void decode();

  MappedFile file_;
  const pack::RuntimePack* root_ = nullptr;
  std::span<const pack::Puff> puffs_;
  std::span<const pack::Response> responses_;
  std::span<const pack::Instance> instances_;
  std::span<const pack::Tile> tiles_;
  std::vector<ArchetypeInfo> archetypes_;
  std::vector<Vec3> centers_;
};

/// A 16-bit float.
float floatOf(std::uint16_t half) noexcept;

inline Vec3 vec3(const pack::Vec3& v) noexcept { return {v.x(), v.y(), v.z()}; }

}  // namespace cloudgen::runtime
