// SPDX-License-Identifier: Apache-2.0
#include "pipeline/moving_clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "base/thread.hpp"

namespace cloudgen::pipeline {
namespace {

/// The least size of a cloud that comes or goes; what is left is not there.
constexpr float kLeastGrowth = 0.02f;

/// A cloud that forms (share from 0 to 1) in a layer of a fraction where that of the clouds that dissolve meanwhile was
/// another: cover and water go evenly; nothing is there at first. Clouds that lie over one another by chance cover
/// 1 - exp(-a) with a times the ground in area, so that areas that went evenly would cover too much in between.
scene::Moment formed(double share, double fraction, double other) {
  constexpr double kMostByChance = 0.75;  ///< sheets are more even
  const auto areaOf = [](double cover) { return -std::log1p(-cover); };
  const double own = std::clamp(fraction, 0.01, kMostByChance), its = std::clamp(other, 0.0, kMostByChance);
  const double evenly = share * areaOf(own) + (1 - share) * areaOf(its);
  const double area = share * areaOf(share * own + (1 - share) * its) / std::max(evenly, 1e-9);
  return {glm::vec3(0), std::max(kLeastGrowth, static_cast<float>(std::sqrt(area))),
          area > 0 ? static_cast<float>(share / area) : 0.0f};
}

/// Two dense clouds of one size over one another, each half as dense, cover this much more than either: their edges
/// differ.
constexpr double kMoreOfTwo = 0.2;

/// Of a pair, the one that is there by a share of its water: smaller by what two cover more.
scene::Moment ofPair(double share, double growth, float opticalDepth) {
  const double more = 1 + kMoreOfTwo * (1 - std::exp(-0.5 * opticalDepth)) * 4 * share * (1 - share);
  const double area = growth * growth / more;
  return {glm::vec3(0), static_cast<float>(std::sqrt(area)), static_cast<float>(share / area)};
}

/// Of a width on the way to another, over its own: the area goes evenly.
double grown(float width, float towards, double share) {
  const double ratio = towards / width;
  return std::sqrt(1 + share * (ratio * ratio - 1));
}

double eased(double share) { return share * share * (3 - 2 * share); }

/// How far the straight lines between every `stride`th place of a way leave it.
double cutCorners(const std::vector<glm::dvec2>& way, std::size_t stride) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const std::size_t from = i / stride * stride, to = std::min(from + stride, way.size() - 1);
    const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
    most = std::max(most, glm::distance(way[i], way[from] + share * (way[to] - way[from])));
  }
  return most;
}

/// The same way with every `stride`th place.
std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2>& way, std::size_t stride) {
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i < way.size(); i += stride) out.push_back(way[i]);
  return out;
}

/// Of the pair's way: it leaves the one's and comes into the other's.
glm::dvec2 placeOfPair(const std::vector<glm::dvec2>& forwards, const std::vector<glm::dvec2>& backwards,
                       std::size_t i) {
  const double share = static_cast<double>(i) / static_cast<double>(forwards.size() - 1);
  return forwards[i] + eased(share) * (backwards[i] - forwards[i]);
}

glm::vec3 shiftOf(const glm::dvec2& place, const motion::CarriedCloud& home, double baseMeters) {
  return {place.x - home.place.x, baseMeters - home.baseMeters, place.y - home.place.y};
}

/// What is left of the size of a cloud that is carried out of the box: nothing from its own width on.
float leftBeyond(const CloudsOfTime& time, const motion::CarriedCloud& cloud, const glm::dvec2& place) {
  const auto beyond = [&](const glm::dvec2& at) {
    return glm::length(glm::max(glm::max(time.lower - at, at - time.upper), glm::dvec2(0)));
  };
  const double further = std::max(0.0, beyond(place) - beyond(cloud.place));
  return std::max(kLeastGrowth, static_cast<float>(1 - further / cloud.widthMeters));
}

/// A cloud of one of both times on its way; `comes`: of the later one. At its own time all of it is there.
std::vector<scene::Moment> momentsOf(const Passage& passage, const CloudsOfTime& earlier,
                                     const CloudsOfTime& later, std::uint32_t cloud, bool comes) {
  const motion::CarriedCloud& own = (comes ? later : earlier).clouds[cloud];
  const motion::Fate& fate = (comes ? passage.tracking.later : passage.tracking.earlier)[cloud];
  const auto& way = (comes ? passage.backwards : passage.forwards)[cloud];
  // Who crosses the border neither forms nor dissolves: all of it is there as long as it is within.
  const bool crosses = !fate.partner && leftBeyond(earlier, own, comes ? way.front() : way.back()) <= kLeastGrowth;
  const double fraction = (comes ? later : earlier).fractions[cloud],
               other = (comes ? passage.fractionsBefore : passage.fractionsAhead)[cloud];
  std::vector<scene::Moment> moments;
  for (int i = 0; i <= passage.intervals; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double share = static_cast<double>(i) / passage.intervals, away = comes ? 1 - share : share;
    glm::dvec2 place = way[at];
    double base = own.baseMeters;
    scene::Moment moment = formed(crosses && away < 1 ? 1 : 1 - away, fraction, other);
    if (fate.partner) {
      const motion::CarriedCloud& partner = (comes ? earlier : later).clouds[*fate.partner];
      place = comes ? placeOfPair(passage.forwards[*fate.partner], way, at)
                    : placeOfPair(way, passage.backwards[*fate.partner], at);
      base += away * (partner.baseMeters - own.baseMeters);
      if (!fate.aside)
        moment = ofPair(1 - away, grown(own.widthMeters, partner.widthMeters, away), own.opticalDepth);
    }
    const float left = leftBeyond(earlier, own, place);
    moment.growth *= left;
    if (left <= kLeastGrowth) moment.presence = 0;
    moment.shift = shiftOf(place, own, base);
    moments.push_back(moment);
  }
  return moments;
}

/// Of each cloud that the wind takes to `ends`: the greatest cover of the layers whose clouds it lies over there.
std::vector<float> fractionsAt(const CloudsOfTime& time, const std::vector<glm::dvec2>& ends, const CloudsOfTime& there) {
  std::vector<std::uint32_t> byX(there.clouds.size());
  std::iota(byX.begin(), byX.end(), 0u);
  const auto xOf = [&](std::uint32_t i) { return there.clouds[i].place.x; };
  std::ranges::sort(byX, {}, xOf);
  float widest = 0;
  for (const motion::CarriedCloud& cloud : there.clouds) widest = std::max(widest, cloud.widthMeters);
  std::vector<float> fractions(time.clouds.size(), 0);
  base::parallelFor(fractions.size(), [&](std::size_t i) {
    const motion::CarriedCloud& own = time.clouds[i];
    const double reach = 0.5 * (own.widthMeters + widest);
    const auto from = std::ranges::lower_bound(byX, ends[i].x - reach, {}, xOf);
    for (auto it = from; it != byX.end() && xOf(*it) <= ends[i].x + reach; ++it) {
      const motion::CarriedCloud& other = there.clouds[*it];
      const bool isThere = glm::distance(other.place, ends[i]) < 0.5 * (own.widthMeters + other.widthMeters),
                 isAsHigh = other.baseMeters < own.baseMeters + own.depthMeters &&
                            own.baseMeters < other.baseMeters + other.depthMeters;
      if (isThere && isAsHigh) fractions[i] = std::max(fractions[i], there.fractions[*it]);
    }
  });
  return fractions;
}

/// A sequence that fills the square evenly however far it has come (Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences"), by row and column instead of one after another. Squares of some cells turn together: clouds
/// lie over the borders of their cells, and the more borders there are between two times the more they cover.
float turnOf(const field::Grid& grid, std::uint32_t cell) {
  constexpr double kAcross = 0.7548776662466927, kDown = 0.5698402909980532;
  constexpr std::uint32_t kTogether = 3;
  const auto columns = static_cast<std::uint32_t>(std::max(grid.columns, 1));
  const double turn = 0.5 + (cell % columns / kTogether) * kAcross + (cell / columns / kTogether) * kDown;
  return static_cast<float>(turn - std::floor(turn));
}

}  // namespace

CloudsOfTime cloudsOfTime(const field::Grid& grid, const base::LocalFrame& frame,
                          const field::CloudTable& table) {
  CloudsOfTime out{{}, {}, {}, frame.lowerCorner(), frame.upperCorner()};
  for (const field::Cloud& cloud : table.clouds) {
    const glm::dvec3 at = frame.toScene(cloud.longitudeDegrees, cloud.latitudeDegrees, cloud.baseMeters);
    const field::Layer& layer = table.layers[cloud.layer];
    out.clouds.push_back({{at.x, at.z}, cloud.widthMeters, cloud.baseMeters, cloud.depthMeters, layer.genus,
                          cloud.opticalDepth});
    out.turns.push_back(turnOf(grid, layer.cell));
    out.fractions.push_back(layer.fraction);
  }
  return out;
}

motion::WindField windOf(const Located& located) {
  const base::LocalFrame& frame = located.origin.frame;
  std::vector<motion::WindSample> samples;
  const auto sample = [&](const field::Grid& grid, std::uint32_t cell, float height, double east, double north) {
    const field::GeoPoint point = field::centerOf(grid, cell);
    const glm::dvec3 at = frame.toScene(point.longitudeDegrees, point.latitudeDegrees, 0);
    const glm::dvec2 direction = frame.eastDirection(point.longitudeDegrees, point.latitudeDegrees);
    samples.push_back({{at.x, at.z},
                       height,
                       glm::vec2(east * direction.x + north * direction.y, east * direction.y - north * direction.x)});
  };
  for (const field::WindAloft& wind : located.winds)
    sample(located.windGrid, wind.cell, wind.heightMeters, wind.windEast, wind.windNorth);
  if (samples.empty())
    for (const field::Layer& layer : located.table.layers)
      for (const float share : {-0.5f, 0.0f, 0.5f})
        sample(located.grid, layer.cell, layer.baseMeters + (0.5f + share) * layer.depthMeters(),
               layer.windEast + share * layer.shearEast, layer.windNorth + share * layer.shearNorth);
  return {frame.lowerCorner(), frame.upperCorner(), samples};
}

Passage passageOf(const CloudsOfTime& earlier, const CloudsOfTime& later, const motion::WindBetween& wind,
                  const motion::Stretch& stretch) {
  constexpr std::size_t kFine = 24;
  Passage passage;
  passage.seconds = (stretch.to - stretch.from) * wind.seconds;
  const auto waysOf = [&](const CloudsOfTime& time, bool backwards) {
    std::vector<std::vector<glm::dvec2>> ways(time.clouds.size());
    base::parallelFor(ways.size(), [&](std::size_t i) {
      const motion::CarriedCloud& cloud = time.clouds[i];
      ways[i] = motion::pathOf(wind, cloud.place, cloud.middleMeters(), kFine, backwards, stretch);
      if (backwards) std::reverse(ways[i].begin(), ways[i].end());
    });
    return ways;
  };
  passage.forwards = waysOf(earlier, false);
  passage.backwards = waysOf(later, true);
  const auto halfway = [](const CloudsOfTime& time, const std::vector<std::vector<glm::dvec2>>& ways) {
    std::vector<motion::CarriedCloud> carried = time.clouds;
    for (std::size_t i = 0; i < carried.size(); ++i) carried[i].place = ways[i][kFine / 2];
    return carried;
  };
  const auto endsOf = [](const std::vector<std::vector<glm::dvec2>>& ways, std::size_t at) {
    std::vector<glm::dvec2> ends;
    for (const auto& way : ways) ends.push_back(way[at]);
    return ends;
  };
  passage.fractionsAhead = fractionsAt(earlier, endsOf(passage.forwards, kFine), later);
  passage.fractionsBefore = fractionsAt(later, endsOf(passage.backwards, 0), earlier);
  passage.tracking = motion::track(halfway(earlier, passage.forwards), halfway(later, passage.backwards));

  // As few intervals as follow the ways of nearly all clouds within a quarter of their width; a stretch is short.
  const bool isWhole = stretch.to - stretch.from > 0.99;
  std::size_t stride = 12;
  for (; isWhole && stride > 1; stride = stride == 12 ? 6 : stride == 6 ? 3 : 1) {
    std::size_t astray = 0;
    for (std::size_t i = 0; i < passage.forwards.size(); ++i)
      astray += cutCorners(passage.forwards[i], stride) > 0.25 * earlier.clouds[i].widthMeters;
    if (20 * astray <= passage.forwards.size()) break;
  }
  stride = std::min<std::size_t>(stride, 6);
  for (auto* ways : {&passage.forwards, &passage.backwards})
    for (auto& way : *ways) way = thinned(way, stride);
  passage.intervals = static_cast<int>(kFine / stride);
  return passage;
}

std::vector<scene::Moment> going(const Passage& passage, const CloudsOfTime& earlier,
                                 const CloudsOfTime& later, std::uint32_t cloud) {
  return momentsOf(passage, earlier, later, cloud, false);
}

std::vector<scene::Moment> coming(const Passage& passage, const CloudsOfTime& earlier,
                                  const CloudsOfTime& later, std::uint32_t cloud) {
  return momentsOf(passage, earlier, later, cloud, true);
}

}  // namespace cloudgen::pipeline
