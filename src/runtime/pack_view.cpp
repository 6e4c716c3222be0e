// SPDX-License-Identifier: Apache-2.0
#include "runtime/pack_view.hpp"

#include <algorithm>
#include <bit>
#include <new>

#include "runtime/pack_rules.hpp"

namespace cloudgen::runtime {
namespace {

static_assert(std::endian::native == std::endian::little, "packs are read where they lie");
static_assert(sizeof(pack::Puff) == 20 && sizeof(pack::Response) == 36 && sizeof(pack::Instance) == 24 &&
              sizeof(pack::Tile) == 40);

template <class Struct>
std::span<const Struct> spanOf(const flatbuffers::Vector<const Struct*>* structs) {
  return {reinterpret_cast<const Struct*>(structs->data()), structs->size()};
}

ArchetypeInfo infoOf(const pack::Archetype& archetype) {
  ArchetypeInfo info;
  info.levels = std::min(archetype.levels()->size(), kMostLevels);
  for (std::uint32_t l = 0; l < info.levels; ++l) {
    const pack::Level& level = *archetype.levels()->Get(l);
    info.first[l] = level.first();
    info.count[l] = level.count();
    info.errorMeters[l] = level.error_meters();
  }
  const Vec3 lower = vec3(*archetype.lower()), upper = vec3(*archetype.upper());
  const float acrossX = std::max(std::abs(lower.x), std::abs(upper.x)),
              acrossZ = std::max(std::abs(lower.z), std::abs(upper.z)), halfHeight = 0.5f * (upper.y - lower.y);
  info.middle = {0, 0.5f * (lower.y + upper.y), 0};
  info.radiusMeters = std::sqrt(acrossX * acrossX + acrossZ * acrossZ + halfHeight * halfHeight);
  return info;
}

}  // namespace

float floatOf(std::uint16_t half) noexcept {
  const std::uint32_t sign = (half & 0x8000u) << 16, exponent = half >> 10 & 0x1f, mantissa = half & 0x3ffu;
  if (exponent == 0) {
    const float tiny = std::ldexp(static_cast<float>(mantissa), -24);
    return sign ? -tiny : tiny;
  }
  const std::uint32_t wide = exponent == 31 ? 0xff : exponent + 112;
  return std::bit_cast<float>(sign | wide << 23 | mantissa << 13);
}

Status PackView::open(const char* path) noexcept {
  *this = PackView();
  MappedFile file;
  if (const Status status = file.open(path); !status) return status;
  if (const Status status = open(file.bytes()); !status) return status;
  file_ = std::move(file);
  return {};
}

Status PackView::open(std::span<const std::uint8_t> bytes) noexcept {
  *this = PackView();
  if (const Status status = soundnessOf(bytes); !status) return status;
  root_ = pack::GetRuntimePack(bytes.data());
  puffs_ = spanOf(root_->puffs());
  responses_ = spanOf(root_->responses());
  instances_ = spanOf(root_->instances());
  tiles_ = spanOf(root_->tiles());
  try {
    decode();
  } catch (const std::bad_alloc&) {
    *this = PackView();
    return {"there is no memory for the pack"};
  }
  return {};
}

void PackView::decode() {
  archetypes_.reserve(root_->archetypes()->size());
  centers_.resize(puffs_.size());
  for (const pack::Archetype* archetype : *root_->archetypes()) {
    archetypes_.push_back(infoOf(*archetype));
    const ArchetypeInfo& info = archetypes_.back();
    const Vec3 lower = vec3(*archetype->center_lower()),
               step = (vec3(*archetype->center_upper()) - lower) * (1.0f / 65535);
    for (std::uint32_t l = 0; l < info.levels; ++l)
      for (std::uint32_t p = info.first[l]; p < info.first[l] + info.count[l]; ++p) {
        const pack::Puff& puff = puffs_[p];
        centers_[p] = lower + step * Vec3{static_cast<float>(puff.center_x()), static_cast<float>(puff.center_y()),
                                          static_cast<float>(puff.center_z())};
      }
  }
}

}  // namespace cloudgen::runtime
