// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/clouds.hpp"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <numeric>

#include "base/text.hpp"
#include "light/shade.hpp"
#include "shape/heights.hpp"
#include "writer/x3d/clusters.hpp"
#include "writer/x3d/plan_of_quads.hpp"

namespace cloudgen::writer {
namespace {

constexpr std::size_t kMostClusters = 24;  ///< parts of a cloud seen from near
constexpr float kNearSizes = 6;      ///< a cloud is drawn in full up to this many times its own size away
constexpr double kLiveClouds = 120;  ///< clouds that are drawn one by one around the viewer, about
constexpr double kFullClouds = 30;   ///< clouds that are drawn in full around the viewer, about
constexpr std::size_t kFarPuffs = 24000;  ///< puffs in the far shapes of all tiles together, about

/// view3dscene 4.2 refuses the field `level` of VRML97's LOD, and the standard any other name for it: VRML97
/// has no LOD here but this many clouds in full, and up to this many with their far level.
constexpr std::size_t kVrml97Full = 60, kVrml97Simple = 1000;

class CloudWalk {
 public:
  CloudWalk(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage)
      : nodes_(nodes),
        shapes_(shapes),
        scene_(scene),
        stage_(stage),
        defined_(kShades * scene.lit.size()),
        simpleDefined_(kShades * scene.lit.size()) {
    chooseDetail();
  }

  void tile(const scene::Tile& tile) {
    const std::string def = fmt::format("Tile_{}_{}", signedName(tile.column), signedName(tile.row));
    if (vrml97()) {
      nodes_.open("Group", "children", def);
      clouds(tile);
      nodes_.close();
      return;
    }
    nodes_.open("LOD", "children", def);
    nodes_.vector("center", 0.5f * (tile.lower + tile.upper), 1);
    nodes_.numbers("range", std::array{tileRange()}, 1, 0);
    nodes_.open("Group");
    clouds(tile);
    nodes_.close();
    nodes_.open("Group");
    cards(tile.instances, Range::Far);
    nodes_.close();
    nodes_.close();
  }

 private:
  enum class Detail : unsigned char { Full, Simple, Cards };
  enum class Range { Near, Far };

  void clouds(const scene::Tile& tile) {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t i : tile.instances) {
      if (detail_[i] == Detail::Cards)
        others.push_back(i);
      else
        cloud(i);
    }
    cards(others, Range::Near);
  }

  /// XML names and VRML ids hold no minus sign in every viewer.
  static std::string signedName(int value) {
    return value < 0 ? "m" + std::to_string(-value) : std::to_string(value);
  }

  const scene::Archetype& archetypeOf(const scene::Instance& instance) const {
    return scene_.archetypes[scene_.lit[instance.lit].archetype];
  }

  bool vrml97() const { return nodes_.encoding() == Encoding::Vrml97; }

  /// Which clouds become nodes of their own. In VRML97, which does without LOD, those nearest to where the
  /// viewpoints look are drawn in full, more of them as their far level.
  void chooseDetail() {
    detail_.assign(scene_.instances.size(), Detail::Full);
    std::vector<std::uint32_t> order(scene_.instances.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto width = [&](std::uint32_t i) {
      return scene_.instances[i].scale * archetypeOf(scene_.instances[i]).widthMeters;
    };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return width(a) > width(b); });
    chooseParted(order);
    if (!vrml97()) {
      for (size_t i = kMostCloudNodes; i < order.size(); ++i) detail_[order[i]] = Detail::Cards;
      return;
    }
    const auto distance = [&](std::uint32_t i) {
      return glm::distance(scene_.instances[i].position, stage_.focus);
    };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    for (size_t i = kVrml97Full; i < order.size(); ++i)
      detail_[order[i]] = i < kVrml97Simple ? Detail::Simple : Detail::Cards;
  }

  /// As cards the widest clouds are a handful of puffs, the others one: kFarPuffs together.
  void chooseParted(std::span<const std::uint32_t> widestFirst) {
    isParted_.assign(scene_.instances.size(), false);
    std::size_t puffs = scene_.instances.size();
    for (const std::uint32_t i : widestFirst) {
      const std::size_t parts = archetypeOf(scene_.instances[i]).farPuffs.size();
      if (parts == 0) continue;
      puffs += parts - 1;
      if (puffs > kFarPuffs) break;
      isParted_[i] = true;
    }
  }

  /// Distance within which about so many clouds stand, were they spread evenly.
  float reachOf(double clouds) const {
    const double count = static_cast<double>(std::clamp<size_t>(scene_.instances.size(), 1, kMostCloudNodes));
    const double area =
        static_cast<double>(stage_.upper.x - stage_.lower.x) * (stage_.upper.z - stage_.lower.z);
    return static_cast<float>(std::sqrt(clouds * area / (std::numbers::pi * count)));
  }

  /// A viewer in the middle of a tile always sees its clouds.
  float tileRange() const {
    const float side = tileSide(stage_);
    return std::clamp(reachOf(kLiveClouds) + 0.5f * side, 0.9f * side, std::max(4 * stage_.extent, side));
  }

  /// In full from near, but not so far that more than about kFullClouds are; in metres of the archetype.
  float cloudRange(float size) const {
    return std::clamp(reachOf(kFullClouds), 2.5f * size, kNearSizes * size);
  }

  void cloud(std::uint32_t i) {
    const scene::Instance& instance = scene_.instances[i];
    nodes_.open("Transform");
    nodes_.vector("scale", glm::vec3(instance.scale), 4);
    nodes_.vector("translation", instance.position, 1);
    if (i < scene_.clouds.size()) record(scene_.clouds[i]);
    if (vrml97())
      fixedLevel(shadedOf(instance), detail_[i]);
    else
      levels(shadedOf(instance));
    nodes_.close();
  }

  void record(const scene::CloudRecord& cloud) {
    const std::string genus(base::abbreviation(cloud.genus)), id = std::to_string(cloud.id);
    const std::array<float, 3> measures{cloud.baseMeters, cloud.topMeters, cloud.opticalDepth};
    if (nodes_.encoding() == Encoding::Vrml97) {
      std::string numbers = "base_m ";
      base::appendFixed(numbers, measures[0], 0);
      numbers += " top_m ";
      base::appendFixed(numbers, measures[1], 0);
      numbers += " optical_depth ";
      base::appendFixed(numbers, measures[2], 2);
      nodes_.open("WorldInfo");
      nodes_.strings("info", std::vector<std::string>{"id " + id, "genus " + genus, "rule " + cloud.rule,
                                                      "cell " + std::to_string(cloud.cell), numbers});
      nodes_.string("title", "cloud");
      nodes_.close();
      return;
    }
    nodes_.open("MetadataSet", "metadata");
    nodes_.string("name", "cloud");
    nodes_.open("MetadataString", "value");
    nodes_.string("name", "id genus rule");
    nodes_.strings("value", std::vector<std::string>{id, genus, cloud.rule});
    nodes_.close();
    nodes_.open("MetadataInteger", "value");
    nodes_.string("name", "cell");
    nodes_.integers("value", std::array{static_cast<std::int32_t>(cloud.cell)});
    nodes_.close();
    nodes_.open("MetadataFloat", "value");
    nodes_.string("name", "base_m top_m optical_depth");
    nodes_.numbers("value", measures, 1, 2);
    nodes_.close();
    nodes_.close();
  }

  /// A lit archetype in one of a few steps of shadow from other clouds, which clouds share by DEF and USE.
  struct Shaded {
    std::uint32_t lit;
    int shade;  ///< 0 in full sun .. kShades - 1 in none
    std::size_t index() const { return kShades * lit + static_cast<std::size_t>(shade); }
  };
  static constexpr std::size_t kShades = 4;

  static Shaded shadedOf(const scene::Instance& instance) {
    return {instance.lit, static_cast<int>(std::lround((1 - instance.sunlight) * (kShades - 1)))};
  }

  /// The puffs of a shaded archetype, turned by its yaw.
  std::vector<LitPuff> turned(const Shaded& shaded, std::span<const shape::Puff> puffs,
                              std::span<const light::PuffLight> lights) const {
    const glm::quat turn =
        glm::angleAxis(scene::yawRadians(scene_.lit[shaded.lit].yawStep), glm::vec3(0, 1, 0));
    const glm::vec3 dimming =
        light::dimming(1 - static_cast<float>(shaded.shade) / (kShades - 1), scene_.sun.color, scene_.sky);
    std::vector<LitPuff> out;
    for (size_t i = 0; i < puffs.size(); ++i) {
      LitPuff one{puffs[i], dimming * (i < lights.size() ? lights[i].color : glm::vec3(1))};
      one.puff.center = turn * one.puff.center;
      one.puff.rotation = turn * one.puff.rotation;
      out.push_back(one);
    }
    return out;
  }

  std::string nameOf(const Shaded& shaded) const {
    const scene::LitArchetype& lit = scene_.lit[shaded.lit];
    return fmt::format("{}_yaw{}{}", scene_.archetypes[lit.archetype].name, lit.yawStep,
                       shaded.shade > 0 ? fmt::format("_shade{}", shaded.shade) : "");
  }

  void levels(const Shaded& shaded) {
    const shape::Bounds& box = scene_.archetypes[scene_.lit[shaded.lit].archetype].bounds;
    if (defined_[shaded.index()]) return nodes_.use("LOD", "children", nameOf(shaded));
    defined_[shaded.index()] = true;
    const glm::vec3 size = box.upper - box.lower;
    nodes_.open("LOD", "children", nameOf(shaded));
    nodes_.vector("center", glm::vec3(0, 0.5f * (box.lower.y + box.upper.y), 0), 1);
    nodes_.numbers("range", std::array{cloudRange(std::max({size.x, size.y, size.z}))}, 1, 0);
    level(shaded, Detail::Full, {});
    level(shaded, Detail::Simple, {});
    nodes_.close();
  }

  void fixedLevel(const Shaded& shaded, Detail detail) {
    std::vector<bool>& defined = detail == Detail::Full ? defined_ : simpleDefined_;
    const std::string def = nameOf(shaded) + (detail == Detail::Full ? "" : "_far");
    if (defined[shaded.index()]) return nodes_.use("Group", "children", def);
    defined[shaded.index()] = true;
    level(shaded, detail, def);
  }

  /// A Group with the puffs (or, simple, the far puffs as one part) of a shaded archetype.
  void level(const Shaded& shaded, Detail detail, const std::string& def) {
    const scene::LitArchetype& lit = scene_.lit[shaded.lit];
    const scene::Archetype& archetype = scene_.archetypes[lit.archetype];
    if (detail == Detail::Full)
      parts(archetype.genus, turned(shaded, archetype.puffs, lit.puffs), archetype.sectionStart,
            kMostClusters, def);
    else if (archetype.farPuffs.empty())
      parts(archetype.genus, turned(shaded, archetype.puffs, lit.puffs), {}, 1, def);
    else
      parts(archetype.genus, turned(shaded, archetype.farPuffs, lit.farPuffs), {}, 1, def);
  }

  /// A part of a cloud: its quads, about a Billboard's origin where it turns.
  struct Drawn {
    Cluster cluster;
    std::vector<LitPuff> members;
  };

  QuadMesh quadsOf(base::Genus genus, const Drawn& drawn) const {
    return drawn.cluster.turns ? facingQuads(drawn.members, drawn.cluster.center, shapes_.atlas(genus))
                               : crossedQuads(drawn.members, glm::vec3(0), shapes_.atlas(genus));
  }

  void parts(base::Genus genus, const std::vector<LitPuff>& puffs, std::span<const std::uint32_t> sections,
             std::size_t most, const std::string& def) {
    std::vector<shape::Puff> bare;
    for (const LitPuff& lit : puffs) bare.push_back(lit.puff);
    std::vector<Drawn> all;
    for (Cluster& cluster : clustersOf(bare, sections, most)) {
      Drawn drawn{std::move(cluster), {}};
      for (const std::uint32_t i : drawn.cluster.puffs) drawn.members.push_back(puffs[i]);
      if (!drawn.cluster.turns) spreadAsFlat(drawn.members);
      all.push_back(std::move(drawn));
    }
    coverAsPuffs(genus, bare, all);
    nodes_.open("Group", "children", def);
    for (const Drawn& drawn : all) {
      if (!drawn.cluster.turns) {
        shapes_.write(genus, quadsOf(genus, drawn));
        continue;
      }
      nodes_.open("Transform");
      nodes_.vector("translation", drawn.cluster.center, 1);
      nodes_.open("Billboard");
      nodes_.vector("axisOfRotation", glm::vec3(0), 0);
      shapes_.write(genus, quadsOf(genus, drawn));
      nodes_.close();
      nodes_.close();
    }
    nodes_.close();
  }

  /// What turns to the viewer shows its side from above, too, which is less than its plan where it is flat:
  /// quads are so wide that from above they cover together what the puffs do.
  void coverAsPuffs(base::Genus genus, std::span<const shape::Puff> puffs, std::vector<Drawn>& all) const {
    const double wanted = shape::coveredSquareMeters(puffs);
    const float covering = shape::coveringThat(wanted, [&](float tried) {
      PlanOfQuads plan(puffs);
      for (Drawn& drawn : all) {
        for (LitPuff& lit : drawn.members) lit.covering = tried;
        if (drawn.cluster.turns)
          plan.addTurning(quadsOf(genus, drawn), drawn.cluster.center);
        else
          plan.add(quadsOf(genus, drawn));
      }
      return plan.coveredSquareMeters();
    });
    for (Drawn& drawn : all)
      for (LitPuff& lit : drawn.members) lit.covering = covering;
  }

  /// Quads have no thickness: they stand further apart, so that they begin and end where the puffs do.
  static void spreadAsFlat(std::vector<LitPuff>& members) {
    constexpr double kBorderShare = 0.05, kEndShare = 0.01;
    std::vector<shape::Puff> puffs;
    for (const LitPuff& lit : members) puffs.push_back(lit.puff);
    const double lower = shape::heightOfShare(puffs, kBorderShare),
                 upper = shape::heightOfShare(puffs, 1 - kBorderShare),
                 lowest = shape::heightOfShare(puffs, kEndShare),
                 highest = shape::heightOfShare(puffs, 1 - kEndShare);
    for (shape::Puff& puff : puffs) puff.sigma = glm::vec3(1e-3f), puff.extinctionPerMeter = 1;
    for (std::size_t i = 0; i < members.size(); ++i)
      puffs[i].extinctionPerMeter = static_cast<float>(shape::extinctionArea(members[i].puff));
    const double flatLower = shape::heightOfShare(puffs, kBorderShare),
                 flatUpper = shape::heightOfShare(puffs, 1 - kBorderShare);
    if (!(flatUpper - flatLower > 0.05 * (upper - lower))) return;  // all in one plane
    const double stretch = std::min(3.0, (upper - lower) / (flatUpper - flatLower));
    for (LitPuff& lit : members)
      lit.puff.center.y = static_cast<float>(
          std::clamp(0.5 * (lower + upper) + stretch * (lit.puff.center.y - 0.5 * (flatLower + flatUpper)),
                     lowest, highest));
  }

  /// Level quads have no thickness: several, from where a uniform layer of the puff's depth begins to where
  /// it ends, tell base and top, and each height between that they are far apart.
  static void addLevels(const LitPuff& whole, std::vector<LitPuff>& out) {
    constexpr float kAway = 1.5f, kThin = 0.02f, kStepMeters = 1500;
    const float reach = kAway * whole.puff.sigma.y;
    const int levels = std::clamp(1 + static_cast<int>(std::lround(2 * reach / kStepMeters)), 2, 6);
    for (int i = 0; i < levels; ++i) {
      LitPuff level = whole;
      level.planes = Planes::Level;
      level.puff.center +=
          whole.puff.rotation * glm::vec3(0, reach * (2.0f * static_cast<float>(i) / (levels - 1) - 1), 0);
      level.puff.sigma.y *= kThin;
      level.puff.extinctionPerMeter /= kThin * static_cast<float>(levels);
      level.covering /= static_cast<float>(levels);  // of all of them together
      out.push_back(level);
    }
  }

  /// Clouds as crossed cards, one Shape a genus, in the scene frame.
  void cards(std::span<const std::uint32_t> instances, Range range) {
    std::map<base::Genus, std::vector<LitPuff>> puffs;
    for (const std::uint32_t i : instances) {
      const scene::Instance& instance = scene_.instances[i];
      const scene::LitArchetype& lit = scene_.lit[instance.lit];
      const scene::Archetype& archetype = archetypeOf(instance);
      const bool inParts = isParted_[i];
      const std::span<const shape::Puff> source =
          inParts ? std::span(archetype.farPuffs) : std::span(&archetype.onePuff, 1);
      const std::span<const light::PuffLight> lights =
          inParts ? std::span(lit.farPuffs) : std::span(&lit.onePuff, 1);
      const glm::vec3 dimming = light::dimming(instance.sunlight, scene_.sun.color, scene_.sky);
      std::vector<LitPuff> placed;
      for (size_t p = 0; p < source.size(); ++p)
        placed.push_back(
            {scene::placed(scene_, instance, source[p]), dimming * lights[p].color,
             inParts ? archetype.farCovering : static_cast<float>(shape::kCoveringOpticalDepth)});
      auto& all = puffs[archetype.genus];
      // From afar nobody tells how dense a cloud is, or where within it: one quad less to blend.
      if (range == Range::Far) {
        all.insert(all.end(), placed.begin(), placed.end());
        continue;
      }
      for (LitPuff& whole : placed) {
        addLevels(whole, all);
        whole.planes = Planes::Upright;
        all.push_back(whole);
      }
    }
    for (const auto& [genus, all] : puffs)
      shapes_.write(genus, crossedQuads(all, glm::vec3(0), shapes_.atlas(genus)));
  }

  NodeWriter& nodes_;
  QuadShapes& shapes_;
  const scene::Scene& scene_;
  const Stage& stage_;
  std::vector<Detail> detail_;
  std::vector<bool> isParted_;
  std::vector<bool> defined_, simpleDefined_;
};

}  // namespace

void writeClouds(NodeWriter& nodes, QuadShapes& shapes, const scene::Scene& scene, const Stage& stage,
                 const base::Progress& progress) {
  CloudWalk walk(nodes, shapes, scene, stage);
  const auto tiles = scene::tilesOf(scene, tileSide(stage));
  for (size_t i = 0; i < tiles.size(); ++i) {
    progress.step("writing X3D", static_cast<double>(i) / static_cast<double>(tiles.size()));
    walk.tile(tiles[i]);
  }
}

}  // namespace cloudgen::writer
