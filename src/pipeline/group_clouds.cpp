// SPDX-License-Identifier: Apache-2.0
#include "pipeline/group_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "pipeline/canvas.hpp"
#include "pipeline/quantity.hpp"
#include "pipeline/size.hpp"
#include "pipeline/unevenness.hpp"

namespace cloudgen::pipeline {
namespace {

/// The smallest share of its size that a cloud is shrunk to so that the cover is right.
constexpr double kSmallestShare = 0.35;
constexpr double kFullCover = 0.985;

/// A cloud that may be drawn.
struct Candidate {
  field::Cloud cloud;
  PaintedCloud painted;
  double opticalDepth = 0;  ///< in cloud, relative to the others
  double rank = 0;
};

/// The normal deviate that so much of all others lie under; rational approximation of Abramowitz & Stegun
/// 1964, 26.2.23.
double probit(double share) {
  const double tail = std::clamp(std::min(share, 1 - share), 0.001, 0.5);
  const double t = std::sqrt(-2 * std::log(tail));
  const double deviate = t - (2.515517 + 0.802853 * t + 0.010328 * t * t) /
                                 (1 + 1.432788 * t + 0.189269 * t * t + 0.001308 * t * t * t);
  return share < 0.5 ? -deviate : deviate;
}

/// Makes the clouds of one group.
class Placer {
 public:
  Placer(const GroupContext& context, const LayerGroup& group)
      : context_(context), group_(group), recipe_(context.options.recipes.of(group.genus)) {
    double width = 0;
    for (const std::uint32_t index : group.layers) {
      const field::Layer& layer = context.layers[index];
      const double area = layer.fraction * field::cellAreaSquareMeters(context.grid, layer.cell);
      covered_ += area;
      water_ += area * layer.opticalDepth();
      width += area * meanWidthMeters(context.general, recipe_, layer.depthMeters());
      least_ = std::min<double>(least_, layer.fraction);
      most_ = std::max<double>(most_, layer.fraction);
      byCell_.emplace(layer.cell, index);
    }
    if (covered_ <= 0) return;
    width_ = width / covered_;
    const double opticalDepth = water_ / covered_;
    threshold_ = std::min(kCoveringOpticalDepth, opticalDepth / 3);
    target_ = std::min(1.0, covered_ / (group.block.sizeMeters.x * group.block.sizeMeters.y));
    const field::Layer& first = context.layers[group.layers.front()];
    // The elements of a full sheet reach beyond their places: where the sky beside it is clear, the outermost
    // are left out, as far as the rest reaches.
    if (recipe_.sheet && least_ >= kFullCover)
      edge_ = 0.5 +
              std::min(0.4, 0.6 * width_ / std::sqrt(field::cellAreaSquareMeters(context.grid, first.cell)));
    angle_ = field::axisAngle(context.grid, first.cell);
    mirrored_ = field::pointIn(context.grid, first.cell, 0.5, 0.9).latitudeDegrees >
                field::pointIn(context.grid, first.cell, 0.5, 0.1).latitudeDegrees;
  }

  std::vector<field::Cloud> clouds() {
    if (covered_ <= 0) return {};
    canvas_.emplace(group_.block.sizeMeters, width_ / 10, recipe_.sheet);
    recipe_.sheet ? addSheet() : addSeparate();
    if (taken_.empty()) return {};
    if (!fitLast()) return {};
    return finished();
  }

 private:
  base::RandomStream streamOf(std::uint32_t number) const {
    const auto item = (static_cast<std::uint64_t>(group_.genus) << 48) |
                      (static_cast<std::uint64_t>(group_.stack) << 40) | number;
    return {context_.options.seed, group_.block.address(), base::Purpose::CloudPlace, item};
  }

  const LayerAround& aroundOf(std::uint32_t index) {
    const auto [found, isNew] = around_.try_emplace(index);
    if (isNew) found->second = context_.surroundings.of(context_.layers[index]);
    return found->second;
  }

  /// The cloud at a place of the block; nothing where no layer of the group is.
  std::optional<Candidate> candidateAt(double u, double v, std::uint32_t number, double& fraction) {
    const auto place = placeIn(context_.grid, group_.block, u, v);
    if (!place) return std::nullopt;
    const auto found = byCell_.find(place->cell);
    if (found == byCell_.end()) return std::nullopt;
    const LayerAtPlace here = aroundOf(found->second).at(place->u, place->v);
    fraction = here.fraction;
    const field::GeoPoint point = field::pointIn(context_.grid, place->cell, place->u, place->v);
    Candidate candidate;
    candidate.opticalDepth = here.opticalDepth;
    candidate.cloud.layer = found->second;
    candidate.cloud.ordinal = number;
    candidate.cloud.longitudeDegrees = point.longitudeDegrees;
    candidate.cloud.latitudeDegrees = point.latitudeDegrees;
    candidate.cloud.baseMeters = static_cast<float>(here.baseMeters);
    candidate.cloud.depthMeters = static_cast<float>(here.topMeters - here.baseMeters);
    candidate.painted.place = glm::dvec2(u, v) * group_.block.sizeMeters;
    candidate.rank =
        unevenness(point, recipe_.sheet ? width_ : 8 * width_, group_.genus, context_.options.seed) /
        kUnevennessDeviation;
    return candidate;
  }

  /// Gives a candidate its size and its footprint, and paints it.
  void take(Candidate candidate) {
    const field::Layer& layer = context_.layers[candidate.cloud.layer];
    const CloudSize size =
        sizeOf(layer, candidate.cloud.ordinal, candidate.cloud.depthMeters, width_, context_.options);
    candidate.cloud.widthMeters = static_cast<float>(size.widthMeters);
    candidate.cloud.depthMeters = static_cast<float>(size.depthMeters);
    candidate.painted.widthMeters = size.widthMeters;
    candidate.painted.footprint = &context_.footprints.of(
        shapeKeyOf(layer, candidate.cloud.ordinal, size.depthMeters, size.widthMeters, context_.options));
    const bool windy = recipe_.alongWind && std::hypot(layer.windEast, layer.windNorth) > 0.5;
    candidate.painted.turnRadians =
        (windy ? std::atan2(layer.windNorth, layer.windEast)
               : 0.5 * std::numbers::pi * quarterTurnOf(layer, candidate.cloud.ordinal, context_.options)) -
        angle_;
    candidate.painted.mirrored = mirrored_;
    paint(candidate, 1);
    taken_.push_back(std::move(candidate));
  }

  void paint(const Candidate& candidate, double sign) {
    canvas_->add(candidate.painted, sign * candidate.opticalDepth);
    painted_ += sign * weightOf(candidate);
  }

  static double weightOf(const Candidate& candidate) {
    return candidate.opticalDepth * candidate.painted.widthMeters * candidate.painted.widthMeters;
  }

  /// On the canvas, clouds have their optical depths relative to each other; together they have the group's.
  double paintedThreshold() const { return threshold_ * painted_ / water_; }
  double cover() const { return canvas_->cover(paintedThreshold()); }

  /// True when the canvas is covered enough. Of many clouds not each one is looked at.
  bool enough() const {
    const std::size_t count = taken_.size();
    if (count > 64 && count % (count / 64) != 0) return false;
    return cover() >= target_;
  }

  void addSheet() {
    const double spacing = std::sqrt(coveredSquareMeters(recipe_, width_));
    const glm::dvec2& size = group_.block.sizeMeters;
    const int columns = std::max(1, static_cast<int>(std::lround(size.x / spacing))),
              rows = std::max(1, static_cast<int>(std::lround(size.y / spacing)));
    const auto places = static_cast<std::uint32_t>(rows * columns);
    std::vector<Candidate> candidates;
    for (std::uint32_t number = 0; number < places; ++number) {
      base::RandomStream stream = streamOf(number);
      const double u = (number % static_cast<std::uint32_t>(columns) + 0.5 +
                        0.55 * (stream.uniform() - 0.5)) /
                       columns,
                   v = (number / static_cast<std::uint32_t>(columns) + 0.5 +
                        0.55 * (stream.uniform() - 0.5)) /
                       rows;
      double fraction = 0;
      auto candidate = candidateAt(u, v, number, fraction);
      if (!candidate || fraction <= edge_) continue;
      candidate->rank += probit(fraction) + 0.1 * stream.gaussian();
      candidates.push_back(std::move(*candidate));
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.rank != b.rank ? a.rank > b.rank : a.cloud.ordinal < b.cloud.ordinal;
    });
    for (Candidate& candidate : candidates) {
      take(std::move(candidate));
      if (least_ < kFullCover && enough()) return;
    }
    fillGaps(places);
  }

  /// Where a lattice leaves gaps that should not be, as small blocks do that it meets by chance: clouds in
  /// the gaps.
  void fillGaps(std::uint32_t places) {
    std::uint32_t more = 2 * places + 4;
    for (std::uint32_t i = 0; i < 12 * places + 64 && more > 0 && cover() < target_ - 0.004; ++i) {
      base::RandomStream stream = streamOf(places + i);
      const double u = stream.uniform(), v = stream.uniform();
      if (!taken_.empty() && canvas_->at(glm::dvec2(u, v) * group_.block.sizeMeters) > paintedThreshold())
        continue;
      double fraction = 0;
      auto candidate = candidateAt(u, v, places + i, fraction);
      if (!candidate || (fraction <= edge_ && !taken_.empty())) continue;
      take(std::move(*candidate));
      --more;
    }
  }

  void addSeparate() {
    const double expected = covered_ / coveredSquareMeters(recipe_, width_);
    const auto most =
        static_cast<std::uint32_t>(std::min(8e6, 64 * (1 + expected / std::max(0.05, 1.02 - target_))));
    // Threads so thin that together they cannot cover what they should end somewhere.
    const auto room = static_cast<std::size_t>(8 + 40 * target_ * group_.block.sizeMeters.x *
                                                       group_.block.sizeMeters.y / (width_ * width_));
    for (std::uint32_t number = 0; number < most; ++number) {
      base::RandomStream stream = streamOf(number);
      const double u = stream.uniform(), v = stream.uniform(), chance = stream.uniform();
      double fraction = 0;
      auto candidate = candidateAt(u, v, number, fraction);
      if (!candidate) continue;
      // A field thins out towards its border, where its neighbours are clearer, so that it is no square.
      const double inner = std::min(1.0, fraction / most_),
                   favour = 1 / (1 + std::exp(-2.5 * candidate->rank));
      if (chance >= inner * inner * favour && !(taken_.empty() && number > most / 2)) continue;
      // Where clouds are many they stand beside each other rather than in each other.
      if (target_ > 0.25 && canvas_->at(candidate->painted.place) > paintedThreshold()) continue;
      take(std::move(*candidate));
      if (enough() || taken_.size() >= room) return;
    }
  }

  /// Makes the last cloud as small as the cover wants it. A group whose only cloud is still too large has it
  /// by chance; false: not.
  bool fitLast() {
    Candidate last = taken_.back();
    if (taken_.size() > 200 || cover() <= target_) return true;
    const CloudSize whole{last.cloud.widthMeters, last.cloud.depthMeters};
    const auto resize = [&](double share) {
      paint(last, -1);
      last.painted.widthMeters = share * whole.widthMeters;
      last.cloud.widthMeters = static_cast<float>(share * whole.widthMeters);
      last.cloud.depthMeters = static_cast<float>(share * whole.depthMeters);
      paint(last, 1);
      return cover();
    };
    double small = kSmallestShare, large = 1;
    const double least = resize(small);
    if (least < target_) {
      for (int i = 0; i < 6; ++i) {
        const double middle = 0.5 * (small + large);
        (resize(middle) < target_ ? small : large) = middle;
      }
      resize(0.5 * (small + large));
    } else if (taken_.size() > 1) {
      paint(last, -1);
      if (target_ - cover() <= least - target_) {
        taken_.pop_back();
        return true;
      }
      paint(last, 1);
    } else {
      const double chance = target_ / least;
      if (evenChance(group_.block, context_.options.seed + 131u * static_cast<std::uint64_t>(group_.genus) +
                                       7u * static_cast<std::uint64_t>(group_.stack)) >= chance)
        return false;
      covered_ /= chance;
      water_ /= chance;
    }
    taken_.back() = last;
    return true;
  }

  /// The group's water and cover shared out.
  std::vector<field::Cloud> finished() const {
    double squares = 0, weights = 0;
    for (const Candidate& candidate : taken_) {
      squares += candidate.painted.widthMeters * candidate.painted.widthMeters;
      weights += weightOf(candidate);
    }
    std::vector<field::Cloud> clouds;
    for (const Candidate& candidate : taken_) {
      field::Cloud cloud = candidate.cloud;
      const double square = candidate.painted.widthMeters * candidate.painted.widthMeters;
      cloud.coversSquareMeters = covered_ * square / squares;
      cloud.opticalDepth = static_cast<float>(water_ * weightOf(candidate) / weights /
                                              shape::footprintSquareMeters(candidate.painted.widthMeters));
      clouds.push_back(cloud);
    }
    return clouds;
  }

  const GroupContext& context_;
  const LayerGroup& group_;
  const shape::Recipe& recipe_;
  double covered_ = 0, water_ = 0;  ///< square metres; and times optical depth
  double width_ = 0, threshold_ = 0, target_ = 0, least_ = 1, most_ = 0, angle_ = 0, painted_ = 0;
  double edge_ = 0;  ///< the fraction at a place that an element of a full sheet wants
  bool mirrored_ = false;
  std::map<std::uint32_t, std::uint32_t> byCell_;
  std::map<std::uint32_t, LayerAround> around_;
  std::optional<Canvas> canvas_;
  std::vector<Candidate> taken_;
};

}  // namespace

std::vector<field::Cloud> groupClouds(const GroupContext& context, const LayerGroup& group) {
  return Placer(context, group).clouds();
}

}  // namespace cloudgen::pipeline
