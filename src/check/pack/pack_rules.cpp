// SPDX-License-Identifier: Apache-2.0
#include "check/pack/pack_rules.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cloudgen::check {
namespace {

constexpr std::uint32_t kHarmonics = 16;
constexpr std::size_t kAlignment = 16;
constexpr std::string_view kPngStart = "\x89PNG\r\n\x1a\n";

template <class Array>
std::uint32_t sizeOf(const Array* array) {
  return array ? array->size() : 0;
}

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const pack::Vec3& v) { return finite(vec3(v)); }

bool isBox(const pack::Vec3* lower, const pack::Vec3* upper) {
  return lower && upper && finite(*lower) && finite(*upper) && lower->x() <= upper->x() &&
         lower->y() <= upper->y() && lower->z() <= upper->z();
}

bool isPng(const flatbuffers::Vector<std::uint8_t>* bytes) {
  return sizeOf(bytes) > kPngStart.size() &&
         std::equal(kPngStart.begin(), kPngStart.end(), reinterpret_cast<const char*>(bytes->data()));
}

std::string textOf(const flatbuffers::String* text) { return text ? excerpt(text->string_view()) : "unnamed"; }

bool areScales(const flatbuffers::Vector<float>* scales) {
  return sizeOf(scales) == kHarmonics &&
         std::all_of(scales->begin(), scales->end(), [](float s) { return std::isfinite(s) && s >= 0; });
}

bool isColor(const pack::Vec3& v) { return finite(v) && v.x() >= 0 && v.y() >= 0 && v.z() >= 0; }

/// True if `inner` reaches out of `outer` by more than rounding.
bool reachesOut(const glm::vec3& innerLower, const glm::vec3& innerUpper, const pack::Tile& outer) {
  const glm::vec3 lower = vec3(outer.lower()), upper = vec3(outer.upper());
  const glm::vec3 slack = 1e-3f + 1e-5f * glm::max(glm::abs(lower), glm::abs(upper));
  return glm::any(glm::lessThan(innerLower, lower - slack)) ||
         glm::any(glm::greaterThan(innerUpper, upper + slack));
}

}  // namespace

void PackRules::error(std::string_view rule, std::string message) {
  findings_.error({}, rule, std::move(message), "write it again with: cloudgen build --formats pack");
}

template <class Breaks>
void PackRules::each(std::string_view rule, std::string_view array, std::uint32_t count, std::string_view what,
                     Breaks breaks) {
  std::uint32_t broken = 0, first = 0;
  for (std::uint32_t i = 0; i < count; ++i)
    if (breaks(i) && broken++ == 0) first = i;
  if (broken == 1) error(rule, fmt::format("{}[{}] {}", array, first, what));
  if (broken > 1) error(rule, fmt::format("{}[{}] {}, and {} more", array, first, what, broken - 1));
}

void PackRules::check() {
  if (!arraysAreThere()) return;
  checkAlignment();
  checkArchetypes();
  checkInstances();
  checkRecords();
  checkTiles();
  checkPictures();
  checkLight();
  checkKeyframes();
  findings_.result().nodes = sizeOf(root_.instances());
  findings_.result().elements = sizeOf(root_.instances()) + sizeOf(root_.archetypes()) + sizeOf(root_.puffs()) +
                                sizeOf(root_.tiles()) + sizeOf(root_.atlases());
}

bool PackRules::arraysAreThere() {
  const std::array<std::pair<std::string_view, bool>, 11> parts{{{"archetypes", root_.archetypes()},
                                                                  {"puffs", root_.puffs()},
                                                                  {"responses", root_.responses()},
                                                                  {"instances", root_.instances()},
                                                                  {"tiles", root_.tiles()},
                                                                  {"atlases", root_.atlases()},
                                                                  {"sun", root_.sun()},
                                                                  {"daylight", root_.daylight()},
                                                                  {"sun_heights", root_.sun_heights()},
                                                                  {"sun_colors", root_.sun_colors()},
                                                                  {"tone", root_.tone()}}};
  bool all = true;
  for (const auto& [name, isThere] : parts) {
    if (!isThere) error("missing", fmt::format("{} is missing", name));
    all &= isThere;
  }
  if (all && root_.responses()->size() != root_.puffs()->size()) {
    error("count", fmt::format("{} responses for {} puffs", root_.responses()->size(), root_.puffs()->size()));
    return false;
  }
  return all;
}

void PackRules::checkAlignment() {
  const auto check = [&](std::string_view name, const auto* array) {
    const auto at = static_cast<std::size_t>(reinterpret_cast<const char*>(array->data()) - start_);
    if (array->size() > 0 && at % kAlignment != 0)
      error("alignment", fmt::format("{} starts at byte {}, which is no multiple of {}", name, at, kAlignment));
  };
  check("puffs", root_.puffs());
  check("responses", root_.responses());
  check("instances", root_.instances());
  check("tiles", root_.tiles());
}

void PackRules::checkArchetypes() {
  const auto& archetypes = *root_.archetypes();
  std::uint64_t used = 0;
  for (const pack::Archetype* archetype : archetypes)
    for (std::uint32_t l = 0; l < sizeOf(archetype->levels()); ++l) used += archetype->levels()->Get(l)->count();
  if (used > root_.puffs()->size()) error("levels", "levels of detail share puffs");
  for (std::uint32_t a = 0; a < archetypes.size() && !findings_.full(); ++a) {
    const pack::Archetype& archetype = *archetypes.Get(a);
    const std::string name = fmt::format("archetype {} {}", a, textOf(archetype.name()));
    if (!isBox(archetype.lower(), archetype.upper()) ||
        !isBox(archetype.center_lower(), archetype.center_upper()))
      error("box", name + " has no box, or one that is inside out");
    else
      checkPuffs(archetype, name);
    if (!areScales(archetype.sun_scale()) || !areScales(archetype.forward_scale()))
      error("scale", fmt::format("{} has not {} finite scales of light", name, kHarmonics));
    if (!(archetype.sun_least() >= 0 && archetype.sun_least() <= archetype.sun_most() &&
          archetype.sun_most() < 100 && archetype.forward_most() >= 0 && archetype.forward_most() < 100 && archetype.beam() >= 0 &&
          archetype.beam() < 1e6f))
      error("range", name + " answers to the sun out of all range");
    if (archetype.sun_height() >= sizeOf(root_.sun_heights()))
      error("index-range", name + " names a height of the sun that is not there");
    if (archetype.atlas() >= sizeOf(root_.atlases()))
      error("index-range", name + " names an atlas that is not there");
    if (archetype.impostor() < -1 || archetype.impostor() >= static_cast<std::int64_t>(sizeOf(root_.impostors())))
      error("index-range", name + " names an impostor that is not there");
  }
}

void PackRules::checkPuffs(const pack::Archetype& archetype, const std::string& name) {
  const std::uint32_t puffs = root_.puffs()->size();
  if (sizeOf(archetype.levels()) == 0) error("levels", name + " has no level of detail");
  const pack::Atlas* atlas =
      archetype.atlas() < root_.atlases()->size() ? root_.atlases()->Get(archetype.atlas()) : nullptr;
  const std::uint32_t tiles = atlas ? static_cast<std::uint32_t>(atlas->columns()) * atlas->rows() : 256;
  float before = -1;
  for (std::uint32_t l = 0; l < sizeOf(archetype.levels()); ++l) {
    const pack::Level& level = *archetype.levels()->Get(l);
    const std::string levelName = fmt::format("{}, level {}", name, l);
    if (level.first() > puffs || level.count() > puffs - level.first()) {
      error("index-range", levelName + " reaches beyond the puffs");
      continue;
    }
    if (l > 0 && level.first() != archetype.levels()->Get(l - 1)->first() + archetype.levels()->Get(l - 1)->count())
      error("levels", levelName + " does not follow the one before");
    if (!std::isfinite(level.error_meters()) || level.error_meters() <= before)
      error("levels", levelName + " has an error that does not rise");
    before = level.error_meters();
    each("puff", levelName + ", puff", level.count(), "has a size or a depth that is none", [&](std::uint32_t i) {
      const PackPuff puff = unpacked(*root_.puffs()->Get(level.first() + i), vec3(*archetype.center_lower()),
                                     vec3(*archetype.center_upper()));
      return !finite(puff.sigma) || glm::any(glm::lessThanEqual(puff.sigma, glm::vec3(0))) ||
             !std::isfinite(puff.opticalDepth) || puff.opticalDepth < 0;
    });
    each("index-range", levelName + ", puff", level.count(), "names a sprite that is not there",
         [&](std::uint32_t i) { return root_.puffs()->Get(level.first() + i)->sprite() >= tiles; });
  }
}

void PackRules::checkInstances() {
  const auto& instances = *root_.instances();
  each("index-range", "instances", instances.size(), "names an archetype or a yaw that is not there",
       [&](std::uint32_t i) {
         return instances.Get(i)->archetype() >= root_.archetypes()->size() || instances.Get(i)->yaw_step() > 15;
       });
  each("finite", "instances", instances.size(), "has a place, a scale or a factor that is none",
       [&](std::uint32_t i) {
         const pack::Instance& cloud = *instances.Get(i);
         return !finite(cloud.position()) || !(cloud.scale() > 0 && cloud.scale() < 1e6f) ||
                !(cloud.optical_depth_factor() >= 0 && cloud.optical_depth_factor() < 1e9f);
       });
}

void PackRules::checkRecords() {
  if (!root_.records()) return;
  const auto& records = *root_.records();
  if (records.size() != root_.instances()->size())
    error("count", fmt::format("{} records for {} instances", records.size(), root_.instances()->size()));
  each("record", "records", records.size(), "names a rule that is not there, or its heights are none",
       [&](std::uint32_t i) {
         const pack::Record& record = *records.Get(i);
         return record.rule() >= sizeOf(root_.rules()) || !std::isfinite(record.base_meters()) ||
                !(record.base_meters() <= record.top_meters()) || !std::isfinite(record.top_meters()) ||
                !(record.optical_depth() >= 0) || !std::isfinite(record.optical_depth());
       });
}

void PackRules::checkTiles() {
  const auto& tiles = *root_.tiles();
  const std::uint32_t clouds = root_.instances()->size(), count = tiles.size();
  if (count == 0 || tiles.Get(0)->first() != 0 || tiles.Get(0)->count() != clouds) {
    error("tiles", "the first tile does not hold all clouds");
    return;
  }
  bool nested = true;
  std::uint64_t met = 1;  // the root; then the children, tile by tile
  each("tiles", "tiles", count, "has no box, children that do not follow it, or runs that do not share out its clouds",
       [&](std::uint32_t t) {
         const pack::Tile& tile = *tiles.Get(t);
         const std::uint64_t end = static_cast<std::uint64_t>(tile.first_child()) + tile.children();
         bool broken = !isBox(&tile.lower(), &tile.upper()) || tile.first() > clouds ||
                       tile.count() > clouds - tile.first();
         if (tile.children() > 0) broken |= tile.first_child() != met || tile.first_child() <= t || end > count;
         met += tile.children();
         std::uint64_t at = tile.first();
         for (std::uint64_t c = tile.first_child(); !broken && tile.children() > 0 && c < end; ++c) {
           const pack::Tile& child = *tiles.Get(static_cast<std::uint32_t>(c));
           broken |= child.first() != at;
           at += child.count();
         }
         if (tile.children() > 0) broken |= at != static_cast<std::uint64_t>(tile.first()) + tile.count();
         nested &= !broken;
         return broken;
       });
  if (!nested || findings_.result().findings.size() > 0) return;
  each("tiles", "tiles", count, "does not hold its clouds or children", [&](std::uint32_t t) {
    const pack::Tile& tile = *tiles.Get(t);
    for (std::uint32_t c = 0; c < tile.children(); ++c) {
      const pack::Tile& child = *tiles.Get(tile.first_child() + c);
      if (child.count() > 0 && reachesOut(vec3(child.lower()), vec3(child.upper()), tile)) return true;
    }
    for (std::uint32_t i = 0; tile.children() == 0 && i < tile.count(); ++i) {
      const pack::Instance& cloud = *root_.instances()->Get(tile.first() + i);
      const pack::Archetype& archetype = *root_.archetypes()->Get(cloud.archetype());
      const glm::vec3 lower = cloud.scale() * vec3(*archetype.lower()),
                      upper = cloud.scale() * vec3(*archetype.upper()), at = vec3(cloud.position());
      const glm::vec3 half = glm::max(glm::abs(lower), glm::abs(upper));
      const float reach = std::hypot(half.x, half.z);
      if (reachesOut(at + glm::vec3(-reach, lower.y, -reach), at + glm::vec3(reach, upper.y, reach), tile))
        return true;
    }
    return false;
  });
}

void PackRules::checkPictures() {
  const auto& atlases = *root_.atlases();
  each("picture", "atlases", atlases.size(), "has no tiles, or a picture that is no PNG", [&](std::uint32_t i) {
    const pack::Atlas& atlas = *atlases.Get(i);
    return atlas.columns() == 0 || atlas.rows() == 0 || !isPng(atlas.color()) ||
           (atlas.sixway_a() && !isPng(atlas.sixway_a())) || (atlas.sixway_b() && !isPng(atlas.sixway_b()));
  });
  each("picture", "impostors", sizeOf(root_.impostors()), "has no views, no size, or a picture that is no PNG",
       [&](std::uint32_t i) {
         const pack::Impostor& impostor = *root_.impostors()->Get(i);
         return impostor.views_across() == 0 || impostor.tile_pixels() == 0 || !impostor.center() ||
                !finite(*impostor.center()) || !(impostor.radius_meters() > 0) ||
                !std::isfinite(impostor.radius_meters()) || !isPng(impostor.color());
       });
}

void PackRules::checkLight() {
  const auto& days = *root_.daylight();
  const auto& colors = *root_.sun_colors();
  if (days.size() < 2) error("daylight", "there are fewer than two entries of daylight");
  if (root_.sun_heights()->size() == 0 ||
      colors.size() != static_cast<std::uint64_t>(days.size()) * root_.sun_heights()->size())
    error("count", fmt::format("{} colours of the sun for {} elevations at {} heights", colors.size(),
                               days.size(), root_.sun_heights()->size()));
  each("daylight", "daylight", days.size(), "does not rise, or has a colour that is none", [&](std::uint32_t i) {
    const pack::Daylight& day = *days.Get(i);
    return !std::isfinite(day.elevation_degrees()) ||
           (i > 0 && !(day.elevation_degrees() > days.Get(i - 1)->elevation_degrees())) ||
           !isColor(day.zenith()) || !isColor(day.horizon()) || !isColor(day.ground()) ||
           !isColor(day.ambient()) || !isColor(day.bounce());
  });
  each("daylight", "sun_colors", colors.size(), "is no colour",
       [&](std::uint32_t i) { return !isColor(*colors.Get(i)); });
  const glm::vec3 sun = vec3(root_.sun()->direction());
  if (!finite(sun) || std::abs(glm::length(sun) - 1) > 1e-3f) error("sun", "the sun's direction is no unit vector");
  if (!std::isfinite(root_.sun()->azimuth_degrees()) || !std::isfinite(root_.sun()->elevation_degrees()))
    error("sun", "the sun stands nowhere");
  const pack::Tone& tone = *root_.tone();
  for (const float value : {tone.white_sun(), tone.white(), tone.most_exposure(), tone.contrast(), tone.knee(),
                            tone.room()})
    if (!(value > 0 && std::isfinite(value))) {
      error("tone", "a figure of the tone curve is not above zero");
      break;
    }
  if (!(root_.lift_lowest() >= 0.01f && root_.lift_lowest() <= 1 && root_.lift_power() >= 0 && root_.lift_power() <= 4))
    error("lift_lowest", "the lift of level tops is out of bounds (0.01 to 1, power 0 to 4)");
  for (const float value : {tone.sky_without_sun(), tone.sky_at_noon(), tone.most_forward(), tone.mean_sun(), tone.mean_sky(), tone.mean_ground()})
    if (!(value >= 0 && std::isfinite(value))) {
      error("tone", "a figure of the tone curve is below zero");
      break;
    }
}

void PackRules::checkKeyframes() {
  const std::uint32_t count = sizeOf(root_.keyframes()), clouds = root_.instances()->size();
  double before = -HUGE_VAL;
  for (std::uint32_t k = 0; k < count && !findings_.full(); ++k) {
    const pack::Keyframe& frame = *root_.keyframes()->Get(k);
    if (!std::isfinite(frame.seconds()) || frame.seconds() <= before)
      error("keyframes", fmt::format("keyframes[{}] is no later than the one before", k));
    before = frame.seconds();
    if (frame.clouds()) {
      if (frame.clouds()->size() != sizeOf(frame.motions()))
        error("count", fmt::format("keyframes[{}] names {} clouds and moves {}", k, frame.clouds()->size(),
                                   sizeOf(frame.motions())));
      each("keyframes", fmt::format("keyframes[{}].clouds", k), frame.clouds()->size(),
           "is no cloud, or not above the one before", [&](std::uint32_t i) {
             return frame.clouds()->Get(i) >= clouds || (i > 0 && frame.clouds()->Get(i) <= frame.clouds()->Get(i - 1));
           });
    } else if (sizeOf(frame.motions()) != 0 && sizeOf(frame.motions()) != clouds)
      error("count", fmt::format("keyframes[{}] moves {} of {} clouds", k, sizeOf(frame.motions()), clouds));
    each("keyframes", fmt::format("keyframes[{}].motions", k), sizeOf(frame.motions()), "is no motion",
         [&](std::uint32_t i) {
           const pack::Motion& motion = *frame.motions()->Get(i);
           return !finite(motion.shift()) || !(motion.growth() > 0 && motion.growth() < 1e6f) ||
                  !(motion.presence() >= 0 && motion.presence() < 1e6f);
         });
  }
}

}  // namespace cloudgen::check
