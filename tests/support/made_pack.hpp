// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <runtime_pack_generated.h>

#include <functional>

#include "support/pack_scene.hpp"

/// Packs that somebody changed, for the tests of what reads them.
namespace cloudgen::test {

inline std::span<const std::uint8_t> bytesOf(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

/// The pack of a scene after a change to what it says.
inline std::string packOf(const scene::Scene& scene, const std::function<void(pack::RuntimePackT&)>& change) {
  const std::string bytes = packOf(scene);
  const std::unique_ptr<pack::RuntimePackT> content(pack::GetRuntimePack(bytes.data())->UnPack());
  change(*content);
  flatbuffers::FlatBufferBuilder builder;
  pack::FinishRuntimePackBuffer(builder, pack::CreateRuntimePack(builder, content.get()));
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

inline pack::Instance changed(const pack::Instance& cloud, std::uint16_t archetype, float scale) {
  return {cloud.position(), archetype, cloud.yaw_step(), cloud.sunlight(), scale, cloud.optical_depth_factor()};
}

inline pack::Tile withChildren(const pack::Tile& tile, std::uint32_t first, std::uint32_t count) {
  return {tile.lower(), tile.upper(), tile.first(), tile.count(), first, count};
}

}  // namespace cloudgen::test
