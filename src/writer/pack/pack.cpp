// SPDX-License-Identifier: Apache-2.0
#include "writer/pack/pack.hpp"

#include <runtime_pack_generated.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "light/tone_curve.hpp"
#include "writer/pack/levels.hpp"
#include "writer/pack/pictures.hpp"
#include "writer/pack/quantise.hpp"
#include "writer/pack/tile_tree.hpp"

namespace cloudgen::writer {
namespace {

using namespace packed;
using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kAlignment = 16;

template <class T>
using Vector = Offset<flatbuffers::Vector<T>>;

/// Structs that start at a multiple of 16 bytes.
template <class Struct>
Vector<const Struct*> aligned(FlatBufferBuilder& builder, const std::vector<Struct>& structs) {
  builder.ForceVectorAlignment(structs.size(), sizeof(Struct), kAlignment);
  return builder.CreateVectorOfStructs(structs);
}

Vector<std::uint8_t> fileBytes(FlatBufferBuilder& builder, std::string_view bytes) {
  return builder.CreateVector(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// The puffs of all archetypes, one after another.
struct PuffTable {
  std::vector<pack::Puff> puffs;
  std::vector<pack::Response> responses;
};

shape::Bounds centersOf(const std::vector<Level>& levels) {
  shape::Bounds box{glm::vec3(1e30f), glm::vec3(-1e30f)};
  for (const Level& level : levels)
    for (const shape::Puff& puff : level.puffs) {
      box.lower = glm::min(box.lower, puff.center);
      box.upper = glm::max(box.upper, puff.center);
    }
  return box.lower.x > box.upper.x ? shape::Bounds{} : box;
}

template <class Value>
std::uint8_t indexOf(const std::vector<Value>& values, const Value& value) {
  return static_cast<std::uint8_t>(std::find(values.begin(), values.end(), value) - values.begin());
}

Offset<pack::Archetype> addArchetype(FlatBufferBuilder& builder, const scene::Archetype& archetype,
                                     const std::vector<base::Genus>& atlases,
                                     const std::vector<float>& sunHeights, PuffTable& table) {
  const auto levels = levelsOf(archetype);
  const shape::Bounds centers = centersOf(levels);
  std::vector<light::PuffResponse> responses;
  for (const Level& level : levels)
    responses.insert(responses.end(), level.responses.begin(), level.responses.end());
  const ResponseScale scale = scaleOf(responses);
  std::vector<pack::Level> runs;
  for (const Level& level : levels) {
    runs.emplace_back(static_cast<std::uint32_t>(table.puffs.size()),
                      static_cast<std::uint32_t>(level.puffs.size()), level.errorMeters);
    for (std::size_t p = 0; p < level.puffs.size(); ++p)
      table.puffs.push_back(quantised(level.puffs[p], centers, level.responses[p].level));
  }
  for (const light::PuffResponse& response : responses) table.responses.push_back(quantised(response, scale));

  const auto name = builder.CreateString(archetype.name);
  const auto genus = builder.CreateSharedString(std::string(base::abbreviation(archetype.genus)));
  const auto runsAt = builder.CreateVectorOfStructs(runs);
  const auto sunScale = builder.CreateVector(scale.sun.data(), scale.sun.size());
  const auto forwardScale = builder.CreateVector(scale.forward.data(), scale.forward.size());
  const pack::Vec3 centerLower = vec3(centers.lower), centerUpper = vec3(centers.upper),
                   lower = vec3(archetype.bounds.lower), upper = vec3(archetype.bounds.upper);
  pack::ArchetypeBuilder out(builder);
  out.add_name(name);
  out.add_genus(genus);
  out.add_center_lower(&centerLower);
  out.add_center_upper(&centerUpper);
  out.add_lower(&lower);
  out.add_upper(&upper);
  out.add_width_meters(archetype.widthMeters);
  out.add_depth_meters(archetype.depthMeters);
  out.add_optical_depth(archetype.opticalDepth);
  out.add_levels(runsAt);
  out.add_sun_scale(sunScale);
  out.add_forward_scale(forwardScale);
  out.add_sun_least(archetype.response.sunLeast);
  out.add_sun_most(archetype.response.sunMost);
  out.add_forward_most(light::kForward);
  out.add_beam(archetype.response.beam);
  out.add_sun_height(indexOf(sunHeights, archetype.response.sunHeightMeters));
  out.add_atlas(indexOf(atlases, archetype.genus));
  return out.Finish();
}

std::vector<pack::Instance> instancesOf(const scene::Scene& scene, const std::vector<std::uint32_t>& order) {
  std::vector<pack::Instance> instances;
  instances.reserve(order.size());
  for (const std::uint32_t i : order) {
    const scene::Instance& cloud = scene.instances[i];
    const scene::LitArchetype& lit = scene.lit[cloud.lit];
    const float sunlight = std::clamp(cloud.sunlight, 0.0f, 1.0f);
    instances.emplace_back(vec3(cloud.position), static_cast<std::uint16_t>(lit.archetype),
                           static_cast<std::uint8_t>(lit.yawStep),
                           static_cast<std::uint8_t>(std::lround(255 * sunlight)), cloud.scale,
                           cloud.opticalDepthFactor);
  }
  return instances;
}

/// The records in the order of the pack, and the rules that they name.
std::vector<pack::Record> recordsOf(const scene::Scene& scene, const std::vector<std::uint32_t>& order,
                                    std::vector<std::string>& rules) {
  std::map<std::string, std::uint16_t> numberOf;
  std::vector<pack::Record> records;
  records.reserve(order.size());
  for (const std::uint32_t i : order) {
    const scene::CloudRecord& cloud = scene.clouds[i];
    const auto [rule, isNew] = numberOf.try_emplace(cloud.rule, static_cast<std::uint16_t>(rules.size()));
    if (isNew) rules.push_back(cloud.rule);
    records.emplace_back(cloud.id, cloud.baseMeters, cloud.topMeters, cloud.opticalDepth, rule->second,
                         cloud.layer);
  }
  return records;
}

std::vector<pack::Daylight> daylight(const std::vector<float>& sunHeights, std::vector<pack::Vec3>& sunColors) {
  std::vector<pack::Daylight> out;
  // Finer where the colours change fast.
  for (double elevation = -12; elevation <= 90; elevation += elevation < 12 ? 1 : 3) {
    const light::Sky sky = light::skyUnder(light::sunFrom(180, elevation));
    out.emplace_back(static_cast<float>(elevation), vec3(sky.zenith), vec3(sky.horizon), vec3(sky.ground),
                     vec3(sky.ambient), vec3(sky.bounce));
    for (const float height : sunHeights)
      sunColors.push_back(vec3(light::sunColorAt(elevation, static_cast<double>(height))));
  }
  return out;
}

pack::Tone tone() {
  using namespace light;
  return {kSun,  kSkyWithoutSun, kSkyAtNoon, kWhite, kMostExposure, kContrast, kKnee, kRoom, kMeanSun * kSun,
          kMeanSky, kMeanGround * kGround, kMostForward};
}

Offset<pack::Provenance> addProvenance(FlatBufferBuilder& builder, const scene::Scene& scene) {
  return pack::CreateProvenance(
      builder, builder.CreateString("cloudgen"), builder.CreateVectorOfStrings(scene.provenance.files),
      builder.CreateString(scene.provenance.format), builder.CreateString(scene.provenance.model),
      builder.CreateString(scene.provenance.run), builder.CreateString(base::isoText(scene.validTime)),
      scene.seed);
}

Offset<pack::Frame> addFrame(FlatBufferBuilder& builder, const scene::Scene& scene) {
  const base::GeoBox& box = scene.frame.box();
  const glm::dvec3 origin = scene.frame.toGeographic(glm::dvec3(0));
  return pack::CreateFrame(builder, builder.CreateString(scene.frame.definition()), box.west, box.south,
                           box.east, box.north, origin.x, origin.y, scene.groundHeightMeters);
}

/// The clouds that are there at each key, in the order of the pack.
std::vector<Offset<pack::Keyframe>> addKeyframes(FlatBufferBuilder& builder, const scene::Scene& scene,
                                                 const std::vector<std::uint32_t>& order) {
  std::vector<Offset<pack::Keyframe>> frames;
  for (std::uint32_t key = 0; key < scene.keySeconds.size(); ++key) {
    std::vector<pack::Motion> motions;
    std::vector<std::uint32_t> clouds;
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      const scene::Motion& motion = scene.motions[order[i]];
      if (key < motion.firstKey || key >= motion.firstKey + motion.moments.size()) continue;
      const scene::Moment& moment = motion.moments[key - motion.firstKey];
      motions.emplace_back(vec3(moment.shift), moment.growth, moment.presence);
      clouds.push_back(i);
    }
    const auto motionsAt = builder.CreateVectorOfStructs(motions);
    const auto cloudsAt = builder.CreateVector(clouds);
    frames.push_back(pack::CreateKeyframe(builder, scene.keySeconds[key], motionsAt, cloudsAt));
  }
  return frames;
}

}  // namespace

std::string packBytes(const scene::Scene& scene, std::span<const Pictures> pictures) {
  FlatBufferBuilder builder(1 << 20);
  std::vector<base::Genus> genera;
  std::vector<Offset<pack::Atlas>> atlases;
  for (const Pictures& sheet : pictures) {
    genera.push_back(sheet.genus);
    atlases.push_back(pack::CreateAtlas(
        builder, builder.CreateString(std::string(base::abbreviation(sheet.genus))),
        static_cast<std::uint16_t>(sheet.columns), static_cast<std::uint16_t>(sheet.rows),
        fileBytes(builder, sheet.color), fileBytes(builder, sheet.sixwayA), fileBytes(builder, sheet.sixwayB)));
  }
  std::set<float> heights;
  for (const scene::Archetype& archetype : scene.archetypes) heights.insert(archetype.response.sunHeightMeters);
  if (heights.empty()) heights.insert(0);
  const std::vector<float> sunHeights(heights.begin(), heights.end());

  PuffTable table;
  std::vector<Offset<pack::Archetype>> archetypes;
  for (const scene::Archetype& archetype : scene.archetypes)
    archetypes.push_back(addArchetype(builder, archetype, genera, sunHeights, table));
  const TileTree tree = tileTreeOf(scene);
  std::vector<std::string> rules;
  const auto records = recordsOf(scene, tree.order, rules);
  std::vector<pack::Vec3> sunColors;
  const auto days = daylight(sunHeights, sunColors);

  const auto archetypesAt = builder.CreateVector(archetypes);
  const auto atlasesAt = builder.CreateVector(atlases);
  const auto puffsAt = aligned(builder, table.puffs);
  const auto responsesAt = aligned(builder, table.responses);
  const auto instancesAt = aligned(builder, instancesOf(scene, tree.order));
  const auto recordsAt = aligned(builder, records);
  const auto rulesAt = builder.CreateVectorOfStrings(rules);
  const auto tilesAt = aligned(builder, tree.tiles);
  const auto daylightAt = builder.CreateVectorOfStructs(days);
  const auto heightsAt = builder.CreateVector(sunHeights);
  const auto colorsAt = builder.CreateVectorOfStructs(sunColors);
  const auto keyframes = addKeyframes(builder, scene, tree.order);
  const auto keyframesAt = keyframes.empty() ? Vector<Offset<pack::Keyframe>>() : builder.CreateVector(keyframes);
  const auto frame = addFrame(builder, scene);
  const auto provenance = addProvenance(builder, scene);
  const pack::Sun sun(static_cast<float>(scene.sun.azimuthDegrees), static_cast<float>(scene.sun.elevationDegrees),
                      vec3(scene.sun.direction));
  const pack::Tone curve = tone();
  pack::RuntimePackBuilder out(builder);
  out.add_version(kVersion);
  out.add_archetypes(archetypesAt);
  out.add_puffs(puffsAt);
  out.add_responses(responsesAt);
  out.add_instances(instancesAt);
  out.add_records(recordsAt);
  out.add_rules(rulesAt);
  out.add_tiles(tilesAt);
  out.add_atlases(atlasesAt);
  out.add_sun(&sun);
  out.add_daylight(daylightAt);
  out.add_sun_heights(heightsAt);
  out.add_sun_colors(colorsAt);
  out.add_tone(&curve);
  out.add_lift_power(light::kLift);
  out.add_lift_lowest(light::kLowest);
  out.add_frame(frame);
  out.add_provenance(provenance);
  if (!keyframes.empty()) out.add_keyframes(keyframesAt);
  pack::FinishRuntimePackBuffer(builder, out.Finish());
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

void writePack(const scene::Scene& scene, const Destination& destination) {
  const auto file = destination.folder / "scene.cgpack";
  if (scene.archetypes.size() > 0xffff)
    throw base::OutputError(file.string(),
                            fmt::format("cannot number {} cloud shapes", scene.archetypes.size()),
                            "choose a smaller --bbox, or leave pack out of --formats");
  const auto pictures = picturesOf(scene);
  destination.progress.step("pack", 0);
  base::writeFile(file, packBytes(scene, pictures));
  destination.progress.step("pack", 1);
}

}  // namespace cloudgen::writer
