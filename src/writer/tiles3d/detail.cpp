// SPDX-License-Identifier: Apache-2.0
#include "writer/tiles3d/detail.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>

#include "light/shade.hpp"
#include "writer/tiles3d/merging.hpp"

namespace cloudgen::writer::tiles3d {
namespace {

/// Clouds of one layer are joined, not those above each other.
constexpr double kBandMeters = 1500;
constexpr double kCellGrowth = 1.4142135623730951;

double visibleWidth(std::span<const shape::Puff> puffs) {
  float widest = 0;
  for (const shape::Puff& puff : puffs) widest = std::max({widest, puff.sigma.x, puff.sigma.y, puff.sigma.z});
  return kVisibleSigmas * widest;
}

enum class Drawn { AllPuffs, FewPuffs, OnePuff };

/// What drawing an archetype in fewer puffs loses, at scale 1. One puff has no lit and no shaded side, which is seen
/// until it is half as wide as what else is let go.
struct Loss {
  double fewMeters = 0, oneMeters = 0;
  std::size_t puffs = 0, few = 0;
};

Loss lossOf(const scene::Archetype& archetype) {
  Loss loss{visibleWidth(archetype.farPuffs), 2 * visibleWidth(std::span(&archetype.onePuff, 1)),
            archetype.puffs.size(), archetype.farPuffs.size()};
  if (loss.few == 0 || loss.few >= loss.puffs) loss.few = loss.puffs, loss.fewMeters = 0;
  loss.oneMeters = std::max(loss.oneMeters, loss.fewMeters);
  return loss;
}

Drawn drawnAt(const Loss& loss, double scale, double errorMeters) {
  if (loss.oneMeters * scale <= errorMeters) return Drawn::OnePuff;
  return loss.fewMeters * scale <= errorMeters && loss.few < loss.puffs ? Drawn::FewPuffs : Drawn::AllPuffs;
}

std::size_t countAt(const Loss& loss, double scale, double errorMeters) {
  const Drawn drawn = drawnAt(loss, scale, errorMeters);
  return drawn == Drawn::OnePuff ? 1 : drawn == Drawn::FewPuffs ? loss.few : loss.puffs;
}

using CellKey = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

CellKey cellOf(const glm::vec3& place, double cellMeters) {
  const auto whole = [](double value, double step) {
    return static_cast<std::int64_t>(std::floor(value / step));
  };
  return {whole(place.y, kBandMeters), whole(place.z, cellMeters), whole(place.x, cellMeters)};
}

light::PuffLight lightOf(const scene::Scene& scene, const scene::Instance& cloud,
                         const light::PuffLight& own) {
  return light::inShadow(own, cloud.sunlight, scene.sun.color, scene.sky);
}

LitPuff onePuffOf(const scene::Scene& scene, std::uint32_t cloud) {
  const scene::Instance& instance = scene.instances[cloud];
  const scene::LitArchetype& lit = scene.lit[instance.lit];
  return {scene::placed(scene, instance, scene.archetypes[lit.archetype].onePuff),
          lightOf(scene, instance, lit.onePuff), scene.archetypes[lit.archetype].genus};
}

/// Every cloud as one puff, sorted by cell.
std::vector<LitPuff> joinedClouds(const scene::Scene& scene, Clouds clouds, double cellMeters) {
  std::vector<std::pair<CellKey, std::uint32_t>> places;
  for (const std::uint32_t cloud : clouds)
    places.emplace_back(cellOf(scene.instances[cloud].position, cellMeters), cloud);
  std::sort(places.begin(), places.end());
  std::vector<LitPuff> out, of;
  for (std::size_t i = 0; i < places.size(); ++i) {
    of.push_back(onePuffOf(scene, places[i].second));
    if (i + 1 < places.size() && places[i + 1].first == places[i].first) continue;
    out.push_back(of.size() == 1 ? of.front() : joined(of));
    of.clear();
  }
  return out;
}

std::size_t cellsTaken(const scene::Scene& scene, Clouds clouds, double cellMeters) {
  std::vector<CellKey> keys;
  for (const std::uint32_t cloud : clouds)
    keys.push_back(cellOf(scene.instances[cloud].position, cellMeters));
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
}

/// The puffs of the clouds, each in the fewest that lose no more than that.
std::vector<LitPuff> puffsOfEach(const scene::Scene& scene, Clouds clouds, double errorMeters) {
  std::vector<Loss> losses;
  for (const scene::Archetype& archetype : scene.archetypes) losses.push_back(lossOf(archetype));
  std::vector<LitPuff> out;
  for (const std::uint32_t cloud : clouds) {
    const scene::Instance& instance = scene.instances[cloud];
    const scene::LitArchetype& lit = scene.lit[instance.lit];
    const scene::Archetype& archetype = scene.archetypes[lit.archetype];
    const Drawn drawn = drawnAt(losses[lit.archetype], instance.scale, errorMeters);
    if (drawn == Drawn::OnePuff && errorMeters > 0) {
      out.push_back(onePuffOf(scene, cloud));
      continue;
    }
    const auto& puffs = drawn == Drawn::FewPuffs ? archetype.farPuffs : archetype.puffs;
    const auto& lights = drawn == Drawn::FewPuffs ? lit.farPuffs : lit.puffs;
    const float covering = drawn == Drawn::FewPuffs ? archetype.farCovering : archetype.covering;
    for (std::size_t p = 0; p < lights.size(); ++p)
      out.push_back({scene::placed(scene, instance, puffs[p]), lightOf(scene, instance, lights[p]),
                     archetype.genus, covering});
  }
  return out;
}

}  // namespace

Detail detailWithin(const scene::Scene& scene, Clouds clouds, std::size_t budget, double leastErrorMeters) {
  std::vector<Loss> losses;
  for (const scene::Archetype& archetype : scene.archetypes) losses.push_back(lossOf(archetype));
  const auto lossOfCloud = [&](std::uint32_t cloud) -> const Loss& {
    return losses[scene.lit[scene.instances[cloud].lit].archetype];
  };
  const auto count = [&](double errorMeters) {
    std::size_t puffs = 0;
    for (const std::uint32_t cloud : clouds)
      puffs += countAt(lossOfCloud(cloud), scene.instances[cloud].scale, errorMeters);
    return puffs;
  };
  if (leastErrorMeters <= 0 && count(0) <= budget) return {};
  std::vector<double> errors{leastErrorMeters};
  for (const std::uint32_t cloud : clouds)
    for (const double error : {lossOfCloud(cloud).fewMeters, lossOfCloud(cloud).oneMeters})
      if (const double scaled = error * scene.instances[cloud].scale; scaled > leastErrorMeters)
        errors.push_back(scaled);
  std::sort(errors.begin(), errors.end());
  const auto fits =
      std::partition_point(errors.begin(), errors.end(), [&](double error) { return count(error) > budget; });
  if (fits != errors.end()) return {*fits, 0};
  Detail detail{errors.back(), errors.back() / kVisibleSigmas};
  while (cellsTaken(scene, clouds, detail.cellMeters) > budget) detail.cellMeters *= kCellGrowth;
  detail.errorMeters = std::max(detail.errorMeters, kVisibleSigmas * detail.cellMeters);
  return detail;
}

std::vector<LitPuff> puffsAt(const scene::Scene& scene, Clouds clouds, const Detail& detail) {
  auto puffs = detail.cellMeters > 0 ? joinedClouds(scene, clouds, detail.cellMeters)
                                     : puffsOfEach(scene, clouds, detail.errorMeters);
  return detail.errorMeters > 0 ? mergedWithin(std::move(puffs), detail.errorMeters) : puffs;
}

}  // namespace cloudgen::writer::tiles3d
