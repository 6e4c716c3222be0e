// SPDX-License-Identifier: Apache-2.0
#include "runtime/pack_rules.hpp"

#include <cmath>

#include "runtime/pack_view.hpp"

namespace cloudgen::runtime {
namespace {

constexpr std::uint32_t kHarmonics = 16;
constexpr int kDepthLimit = 16;
constexpr std::uint32_t kTableLimit = 4'000'000;

template <class Array>
std::uint32_t sizeOf(const Array* array) {
  return array ? array->size() : 0;
}

bool finite(const pack::Vec3& v) { return isFinite(vec3(v)); }

bool isBox(const pack::Vec3* lower, const pack::Vec3* upper) {
  return lower && upper && finite(*lower) && finite(*upper) && lower->x() <= upper->x() &&
         lower->y() <= upper->y() && lower->z() <= upper->z();
}

bool areScales(const flatbuffers::Vector<float>* scales) {
  if (sizeOf(scales) != kHarmonics) return false;
  for (const float scale : *scales)
    if (!std::isfinite(scale)) return false;
  return true;
}

bool allFinite(const pack::Tone& tone) {
  for (const float value : {tone.white_sun(), tone.sky_without_sun(), tone.sky_at_noon(), tone.most_forward(), tone.white(), tone.most_exposure(), tone.contrast(),
                            tone.knee(), tone.room(), tone.mean_sun(), tone.mean_sky(), tone.mean_ground()})
    if (!std::isfinite(value)) return false;
  return true;
}

Status archetypesOf(const pack::RuntimePack& root) {
  const std::uint32_t puffs = root.puffs()->size();
  std::uint64_t used = 0;
  for (const pack::Archetype* archetype : *root.archetypes()) {
    if (!isBox(archetype->lower(), archetype->upper()) ||
        !isBox(archetype->center_lower(), archetype->center_upper()))
      return {"an archetype has no box"};
    if (sizeOf(archetype->levels()) == 0) return {"an archetype has no level of detail"};
    for (const pack::Level* level : *archetype->levels())
      if (level->first() > puffs || level->count() > puffs - level->first() || !std::isfinite(level->error_meters()))
        return {"a level of detail reaches beyond the puffs"};
    // Levels follow each other, and each puff is of one: what is unpacked is no more than the file.
    std::uint64_t next = archetype->levels()->Get(0)->first();
    for (const pack::Level* level : *archetype->levels()) {
      if (level->first() != next) return {"levels of detail do not follow each other"};
      next += level->count();
      used += level->count();
    }
    if (used > puffs) return {"levels of detail share puffs"};
    if (!areScales(archetype->sun_scale()) || !areScales(archetype->forward_scale()) ||
        !std::isfinite(archetype->sun_least()) || !std::isfinite(archetype->sun_most()) ||
        !(archetype->forward_most() >= 0 && archetype->forward_most() < 100) ||
        !(archetype->beam() >= 0 && archetype->beam() < 1e6f))
      return {"an archetype does not say how it answers to light"};
    if (archetype->sun_height() >= sizeOf(root.sun_heights()) || archetype->atlas() >= sizeOf(root.atlases()) ||
        archetype->impostor() >= static_cast<std::int64_t>(sizeOf(root.impostors())))
      return {"an archetype names something that is not there"};
  }
  return {};
}

Status cloudsOf(const pack::RuntimePack& root) {
  const std::uint32_t archetypes = root.archetypes()->size(), clouds = root.instances()->size();
  for (const pack::Instance* cloud : *root.instances())
    if (cloud->archetype() >= archetypes || cloud->yaw_step() >= kYawSteps || !finite(cloud->position()) ||
        !(cloud->scale() > 0 && cloud->scale() < 1e6f) || !std::isfinite(cloud->optical_depth_factor()))
      return {"a cloud has no shape, no place or no size"};
  const auto& tiles = *root.tiles();
  if (tiles.size() == 0 || tiles.Get(0)->count() != clouds) return {"the first tile does not hold all clouds"};
  // A tile has one parent before it: so there is no way round, and all of it is met once.
  std::uint64_t met = 1;
  for (std::uint32_t t = 0; t < tiles.size(); ++t) {
    const pack::Tile& tile = *tiles.Get(t);
    if (!isBox(&tile.lower(), &tile.upper()) || tile.first() > clouds || tile.count() > clouds - tile.first())
      return {"a tile has no box, or clouds that are not there"};
    if (tile.children() == 0) continue;
    if (tile.first_child() != met || tile.first_child() <= t || tile.children() > tiles.size() - tile.first_child())
      return {"the children of a tile do not follow it"};
    met += tile.children();
    // Their clouds are the tile's, each once.
    std::uint64_t next = tile.first();
    for (std::uint32_t c = 0; c < tile.children(); ++c) {
      const pack::Tile& child = *tiles.Get(tile.first_child() + c);
      if (child.first() != next) return {"the children of a tile do not share out its clouds"};
      next += child.count();
    }
    if (next != static_cast<std::uint64_t>(tile.first()) + tile.count())
      return {"the children of a tile do not share out its clouds"};
  }
  return {};
}

Status lightOf(const pack::RuntimePack& root) {
  const auto& days = *root.daylight();
  if (days.size() < 2 || sizeOf(root.sun_heights()) == 0 ||
      root.sun_colors()->size() != static_cast<std::uint64_t>(days.size()) * root.sun_heights()->size())
    return {"the daylight is not whole"};
  for (std::uint32_t i = 0; i < days.size(); ++i) {
    const pack::Daylight& day = *days.Get(i);
    if (!std::isfinite(day.elevation_degrees()) || !finite(day.zenith()) || !finite(day.horizon()) ||
        !finite(day.ground()) || !finite(day.ambient()) || !finite(day.bounce()) ||
        (i > 0 && !(day.elevation_degrees() > days.Get(i - 1)->elevation_degrees())))
      return {"the daylight does not rise with the sun"};
  }
  for (const pack::Vec3* color : *root.sun_colors())
    if (!finite(*color)) return {"the sun has no colour"};
  return finite(root.sun()->direction()) && std::isfinite(root.sun()->azimuth_degrees()) &&
                 std::isfinite(root.sun()->elevation_degrees()) && allFinite(*root.tone()) &&
                     root.lift_lowest() >= 0.01f && root.lift_lowest() <= 1 && root.lift_power() >= 0 && root.lift_power() <= 4
             ? Status{}
             : Status{"the sun has no direction, or the tone curve no figures"};
}

Status keyframesOf(const pack::RuntimePack& root) {
  if (!root.keyframes()) return {};
  double before = -HUGE_VAL;
  for (const pack::Keyframe* frame : *root.keyframes()) {
    if (!std::isfinite(frame->seconds()) || frame->seconds() <= before) return {"time does not go forward"};
    before = frame->seconds();
    if (frame->clouds()) {
      if (frame->clouds()->size() != sizeOf(frame->motions())) return {"a keyframe does not move every cloud that it names"};
      std::int64_t last = -1;
      for (const std::uint32_t cloud : *frame->clouds()) {
        if (cloud <= last || cloud >= root.instances()->size()) return {"a keyframe names a cloud that is not there"};
        last = cloud;
      }
    }
    if (sizeOf(frame->motions()) == 0) continue;
    if (!frame->clouds() && frame->motions()->size() != root.instances()->size())
      return {"a keyframe does not move every cloud"};
    for (const pack::Motion* motion : *frame->motions())
      if (!finite(motion->shift()) || !(motion->growth() > 0 && motion->growth() < 1e6f) ||
          !(motion->presence() >= 0 && motion->presence() < 1e6f))
        return {"a cloud's motion is none"};
  }
  return {};
}

}  // namespace

Status soundnessOf(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < 16 || bytes.size() >= FLATBUFFERS_MAX_BUFFER_SIZE || !pack::RuntimePackBufferHasIdentifier(bytes.data()))
    return {"this is no runtime pack"};
  flatbuffers::Verifier verifier(bytes.data(), bytes.size(), kDepthLimit, kTableLimit);
  if (!pack::VerifyRuntimePackBuffer(verifier)) return {"the pack is cut short or damaged"};
  const pack::RuntimePack& root = *pack::GetRuntimePack(bytes.data());
  if (root.version() < 1 || root.version() > kPackVersion) return {"the pack is of a newer version than is known here"};
  if (!root.archetypes() || !root.puffs() || !root.responses() || !root.instances() || !root.tiles() ||
      !root.atlases() || !root.sun() || !root.daylight() || !root.sun_colors() || !root.tone() ||
      root.responses()->size() != root.puffs()->size())
    return {"a part of the pack is missing"};
  for (const auto check : {archetypesOf, cloudsOf, lightOf, keyframesOf})
    if (const Status status = check(root); !status) return status;
  return {};
}

}  // namespace cloudgen::runtime
