// SPDX-License-Identifier: Apache-2.0
#include "motion/tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "base/thread.hpp"

namespace cloudgen::motion {
namespace {

using base::Genus;

/// How far apart two clouds may stand, as a share of the sum of their widths.
constexpr double kReach = 0.9;
constexpr std::size_t kMostPartners = 12;

/// Genera that one cloud passes through.
bool kin(Genus a, Genus b) {
  constexpr std::array<std::pair<Genus, Genus>, 13> kPairs{{{Genus::Cumulus, Genus::Cumulonimbus},
                                                            {Genus::Cumulus, Genus::Stratocumulus},
                                                            {Genus::Stratocumulus, Genus::Stratus},
                                                            {Genus::Stratus, Genus::Fog},
                                                            {Genus::Stratus, Genus::Nimbostratus},
                                                            {Genus::Altostratus, Genus::Nimbostratus},
                                                            {Genus::Altocumulus, Genus::Altostratus},
                                                            {Genus::Altocumulus, Genus::Stratocumulus},
                                                            {Genus::Altostratus, Genus::Cirrostratus},
                                                            {Genus::Cirrus, Genus::Cirrostratus},
                                                            {Genus::Cirrus, Genus::Cirrocumulus},
                                                            {Genus::Cirrocumulus, Genus::Cirrostratus},
                                                            {Genus::Cumulonimbus, Genus::Nimbostratus}}};
  return std::any_of(kPairs.begin(), kPairs.end(), [&](const auto& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
}

struct Pair {
  double likeness;
  std::uint32_t earlier, later;
  bool operator<(const Pair& other) const {
    return std::tuple(-likeness, earlier, later) < std::tuple(-other.likeness, other.earlier, other.later);
  }
};

/// Clouds by squares of the ground.
class Squares {
 public:
  Squares(std::span<const CarriedCloud> clouds, double sideMeters) : side_(sideMeters) {
    for (std::uint32_t i = 0; i < clouds.size(); ++i) squares_[squareOf(clouds[i].place)].push_back(i);
  }
  template <class Work>
  void around(const glm::dvec2& place, const Work& work) const {
    const auto [row, column] = squareOf(place);
    for (int dr = -1; dr <= 1; ++dr)
      for (int dc = -1; dc <= 1; ++dc)
        if (const auto found = squares_.find({row + dr, column + dc}); found != squares_.end())
          for (const std::uint32_t i : found->second) work(i);
  }

 private:
  std::pair<int, int> squareOf(const glm::dvec2& place) const {
    return {static_cast<int>(std::floor(place.y / side_)), static_cast<int>(std::floor(place.x / side_))};
  }
  double side_;
  std::map<std::pair<int, int>, std::vector<std::uint32_t>> squares_;
};

/// Of each earlier cloud the later ones that it may be, the likest first.
std::vector<std::vector<Pair>> pairsOf(std::span<const CarriedCloud> earlier, std::span<const CarriedCloud> later) {
  double widest = 1;
  for (const auto clouds : {earlier, later})
    for (const CarriedCloud& cloud : clouds) widest = std::max(widest, static_cast<double>(cloud.widthMeters));
  const Squares squares(later, 2 * kReach * widest);
  std::vector<std::vector<Pair>> pairs(earlier.size());
  base::parallelFor(earlier.size(), [&](std::size_t i) {
    squares.around(earlier[i].place, [&](std::uint32_t k) {
      if (const double like = likeness(earlier[i], later[k]); like > 0)
        pairs[i].push_back({like, static_cast<std::uint32_t>(i), k});
    });
    std::sort(pairs[i].begin(), pairs[i].end());
    if (pairs[i].size() > kMostPartners) pairs[i].resize(kMostPartners);
  });
  return pairs;
}

/// An earlier cloud that found none takes the partner of another that has a second choice still free.
void changePartners(const std::vector<std::vector<Pair>>& pairs, Tracking& tracking) {
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    if (tracking.earlier[i].partner) continue;
    const Pair *taken = nullptr, *second = nullptr;
    double gain = 0;
    for (const Pair& own : pairs[i]) {
      const std::uint32_t rival = *tracking.later[own.later].partner;
      double now = 0;
      for (const Pair& other : pairs[rival])
        if (other.later == own.later) now = other.likeness;
      for (const Pair& other : pairs[rival]) {
        if (tracking.later[other.later].partner) continue;
        if (const double better = own.likeness + other.likeness - now; better > gain)
          gain = better, taken = &own, second = &other;
        break;
      }
    }
    if (!taken) continue;
    tracking.earlier[second->earlier].partner = second->later;
    tracking.later[second->later].partner = second->earlier;
    tracking.earlier[i].partner = taken->later;
    tracking.later[taken->later].partner = i;
  }
}

}  // namespace

double likeness(const CarriedCloud& a, const CarriedCloud& b) {
  const double across = kReach * (a.widthMeters + b.widthMeters), apart = glm::distance(a.place, b.place);
  if (!(apart < across)) return 0;
  if (a.genus != b.genus && !kin(a.genus, b.genus)) return 0;
  const double rise = std::abs(a.middleMeters() - b.middleMeters()) / (1000 + 0.5 * (a.depthMeters + b.depthMeters));
  const double near = 1 - apart / across;
  return near * near * std::exp(-rise) * std::min(a.widthMeters, b.widthMeters) /
         std::max(a.widthMeters, b.widthMeters) * (a.genus == b.genus ? 1.0 : 0.5);
}

Tracking track(std::span<const CarriedCloud> earlier, std::span<const CarriedCloud> later) {
  const auto pairs = pairsOf(earlier, later);
  std::vector<Pair> all;
  for (const auto& of : pairs) all.insert(all.end(), of.begin(), of.end());
  std::sort(all.begin(), all.end());
  Tracking tracking{std::vector<Fate>(earlier.size()), std::vector<Fate>(later.size())};
  for (const Pair& pair : all) {
    if (tracking.earlier[pair.earlier].partner || tracking.later[pair.later].partner) continue;
    tracking.earlier[pair.earlier].partner = pair.later;
    tracking.later[pair.later].partner = pair.earlier;
  }
  changePartners(pairs, tracking);
  for (const Pair& pair : all) {
    Fate &before = tracking.earlier[pair.earlier], &after = tracking.later[pair.later];
    if (glm::distance(earlier[pair.earlier].place, later[pair.later].place) >
        0.5 * std::max(earlier[pair.earlier].widthMeters, later[pair.later].widthMeters))
      continue;
    if (!before.partner) before = {pair.later, true};
    if (!after.partner) after = {pair.earlier, true};
  }
  return tracking;
}

}  // namespace cloudgen::motion
