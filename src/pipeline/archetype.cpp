// SPDX-License-Identifier: Apache-2.0
#include "pipeline/archetype.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/canvas.hpp"
#include "scene/scene.hpp"
#include "shape/heights.hpp"
#include "shape/reduce.hpp"

namespace cloudgen::pipeline {
namespace {

/// Thin cells that cover nearly all have no gaps between them; thick ones hide theirs, but where there is
/// none.
constexpr float kClosed = 0.9f, kWithoutGaps = 0.985f;
constexpr int kClosedClass = 1;
constexpr std::uint64_t kDither = 1ull << 62;  ///< the address of another draw
constexpr double kAspectStep = 1.4142135623730951, kOpticalDepthStep = 2.0;

int classOf(double value, double step) {
  return static_cast<int>(std::lround(std::log(value) / std::log(step)));
}

/// Share of the extinction in puffs of which nothing would be seen, or whose opacity is below what formats
/// keep, if all is multiplied by a factor.
double faintShare(const std::vector<shape::Puff>& puffs, double factor) {
  constexpr float kFaintest = 0.01f;
  double whole = 0, faint = 0;
  for (const shape::Puff& puff : puffs) {
    const double area = shape::extinctionArea(puff);
    whole += area;
    if (factor * shape::frontalOpticalDepth(puff) < kFaintest) faint += area;
  }
  return whole > 0 ? faint / whole : 0;
}

/// Fewer puffs than a genus is told by near at hand are larger, so that together they fill as much space (as
/// much ground, where they lie side by side).
void fillWithFew(std::vector<shape::Puff>& puffs, const shape::Recipe& recipe, int asked) {
  constexpr double kWidest = 3;
  const double fewer = static_cast<double>(fewestPuffs(recipe)) / std::max(1, asked);
  const bool fillsAnyway = recipe.form == shape::Form::Veil || recipe.form == shape::Form::Filaments ||
                           recipe.form == shape::Form::File;
  if (fillsAnyway || fewer <= 1) return;
  const bool flat = recipe.form == shape::Form::Cells;
  const auto wider = static_cast<float>(std::min(kWidest, flat ? std::sqrt(fewer) : std::cbrt(fewer)));
  const glm::vec3 by(wider, flat ? 1.0f : wider, wider);
  for (shape::Puff& puff : puffs) {
    puff.sigma *= by;
    puff.extinctionPerMeter /= by.x * by.y * by.z;
  }
}

/// Few puffs of a sheet are wide: what they reach out beyond the element they are drawn in again, or it would
/// cover more than its width says.
void holdWithin(std::vector<shape::Puff>& puffs, double widthMeters) {
  constexpr double kDeviation = 0.31;  ///< of an element of many puffs, in widths
  double whole = 0, square = 0;
  for (const shape::Puff& puff : puffs) {
    const glm::mat3 axes = glm::mat3_cast(puff.rotation);
    double own = 0;
    for (int k = 0; k < 3; ++k)
      own += std::pow(puff.sigma[k], 2) * (std::pow(axes[k].x, 2) + std::pow(axes[k].z, 2));
    const double area = shape::extinctionArea(puff);
    whole += area;
    square += area * 0.5 * (own + puff.center.x * puff.center.x + puff.center.z * puff.center.z);
  }
  const double deviation = std::sqrt(square / whole);
  if (!(deviation > kDeviation * widthMeters)) return;
  const auto narrower = static_cast<float>(kDeviation * widthMeters / deviation);
  for (shape::Puff& puff : puffs) {
    puff.center *= glm::vec3(narrower, 1, narrower);
    puff.sigma *= glm::vec3(narrower, 1, narrower);
    puff.extinctionPerMeter /= narrower * narrower;
  }
}

/// 0 calm, 1 sheared, 2 strongly sheared: the lean of the top over the depth is a quarter of the class.
int shearClassOf(const field::Layer& layer) {
  const double shear = std::hypot(layer.shearEast, layer.shearNorth);
  return shear < 6 ? 0 : (shear < 18 ? 1 : 2);
}

/// Where half of the water lies, as a share of the height between those of kBorderShare, in five classes: of
/// layers so deep that it shows.
constexpr float kGatheringStep = 0.15f, kShallowMeters = 1000;

int gatheringClassOf(const field::Layer& layer) {
  const float depth = layer.upperMeters - layer.lowerMeters;
  if (!(depth > kShallowMeters)) return 0;
  const float middle = (layer.middleMeters - layer.lowerMeters) / depth;
  return static_cast<int>(std::lround(std::clamp((middle - 0.5f) / kGatheringStep, -2.0f, 2.0f)));
}

}  // namespace

std::uint64_t itemOf(const field::Layer& layer, std::uint32_t ordinal) {
  return (static_cast<std::uint64_t>(layer.ordinal) << 40) | ordinal;
}

int yawStepOf(const field::Layer& layer, std::uint32_t ordinal, const field::GeoPoint& place,
              const Options& options, const base::LocalFrame& frame) {
  if (options.recipes.of(layer).alongWind && std::hypot(layer.windEast, layer.windNorth) > 0.5) {
    const glm::dvec2 east = frame.eastDirection(place.longitudeDegrees, place.latitudeDegrees);
    const double x = layer.windEast * east.x + layer.windNorth * east.y,
                 z = layer.windEast * east.y - layer.windNorth * east.x;
    const double steps = std::atan2(-z, x) / (2.0 * std::numbers::pi) * scene::kYawSteps;
    return (static_cast<int>(std::lround(steps)) + scene::kYawSteps) % scene::kYawSteps;
  }
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudYaw, itemOf(layer, ordinal));
  return scene::kYawSteps / 4 * stream.index(4);
}

ArchetypeKey shapeKeyOf(const field::Layer& layer, std::uint32_t ordinal, double depthMeters,
                        double widthMeters, const Options& options) {
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudVariant, itemOf(layer, ordinal));
  ArchetypeKey key;
  key.genus = layer.genus;
  key.aspectClass = classOf(depthMeters / widthMeters, kAspectStep);
  const shape::Form form = options.recipes.of(layer).form;
  key.shearClass = form == shape::Form::Heap || form == shape::Form::Tower ? shearClassOf(layer) : 0;
  key.variant = stream.index(kVariants);
  key.layerClass = layerClassOf(layer.opticalDepth());
  key.gatheringClass = gatheringClassOf(layer);
  key.closed = form == shape::Form::Cells &&
               layer.fraction >= (key.layerClass <= kClosedClass ? kClosed : kWithoutGaps);
  return key;
}

ArchetypeKey keyOf(const field::Layer& layer, const field::Cloud& cloud, const Options& options) {
  ArchetypeKey key = shapeKeyOf(layer, cloud.ordinal, cloud.depthMeters, cloud.widthMeters, options);
  const double opticalDepth = std::max(0.02f, cloud.opticalDepth);
  key.opticalDepthClass = static_cast<int>(std::floor(std::log(opticalDepth) / std::log(kOpticalDepthStep)));
  const double below = std::pow(kOpticalDepthStep, key.opticalDepthClass);
  base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudVariant,
                            itemOf(layer, cloud.ordinal) | kDither);
  if (stream.uniform() < (opticalDepth / below - 1) / (kOpticalDepthStep - 1)) ++key.opticalDepthClass;
  return key;
}

int opticalDepthClassOf(double opticalDepth) {
  return classOf(std::max(0.02, opticalDepth), kOpticalDepthStep);
}

ArchetypeKey shapeKeyOf(const ArchetypeKey& key) {
  ArchetypeKey shapeKey = key;
  shapeKey.opticalDepthClass = 0;
  return shapeKey;
}

double drawnWidthMeters(double depthMeters, double widthMeters) {
  return depthMeters / std::pow(kAspectStep, classOf(depthMeters / widthMeters, kAspectStep));
}

ArchetypeShape shapeOf(const ArchetypeKey& key, const Options& options, const Generalisation& general) {
  const shape::Recipe& recipe = options.recipes.of(key.genus, isThin(key.layerClass));
  shape::ShapeRequest request;
  request.depthMeters =
      std::sqrt(static_cast<double>(recipe.thicknessMeters.low) * recipe.thicknessMeters.high);
  request.widthMeters = request.depthMeters / std::pow(kAspectStep, key.aspectClass);
  request.opticalDepth = std::pow(kOpticalDepthStep, key.opticalDepthClass);
  request.even = isThin(key.layerClass);
  request.closed = key.closed;
  request.tilt = 0.25 * key.shearClass;
  request.puffs = general.puffsPerCloud[static_cast<size_t>(key.genus)];
  request.seed = options.seed;
  request.variant = (static_cast<std::uint64_t>(key.genus) << 32) | static_cast<std::uint64_t>(key.variant);
  ArchetypeShape out{request.widthMeters, request.depthMeters, request.opticalDepth,
                     shape::generate(recipe, request)};
  // So faint that it would not be drawn: fewer, stronger puffs.
  const double perOne = std::exp2(key.layerClass) * coveredSquareMeters(recipe, 1) /
                        (shape::footprintSquareMeters(1) * request.opticalDepth);
  while (request.puffs > 12 && faintShare(out.cloud.puffs, perOne) > 0.01) {
    request.puffs = request.puffs * 2 / 3;
    out.cloud = shape::generate(recipe, request);
  }
  // Heaps bulge in the middle: they end where a little of them is left over, or they would be drawn out to
  // columns.
  const bool heaped = recipe.form == shape::Form::File ||
                      ((recipe.form == shape::Form::Heap || recipe.form == shape::Form::Tower) &&
                       request.puffs >= fewestPuffs(recipe));
  fillWithFew(out.cloud.puffs, recipe, request.puffs);
  if (recipe.form == shape::Form::Veil) holdWithin(out.cloud.puffs, out.widthMeters);
  const shape::Ends ends = !heaped                             ? shape::Ends::Flat
                           : recipe.form == shape::Form::Tower ? shape::Ends::Overshooting
                                                               : shape::Ends::Round;
  if (key.gatheringClass != 0)
    shape::gatherAt(out.cloud.puffs, 0.5 + kGatheringStep * key.gatheringClass, field::kBorderShare);
  shape::spreadBetween(out.cloud.puffs, heaped ? 0.03 : field::kBorderShare, out.depthMeters, ends);
  shape::standOverCentroid(out.cloud.puffs);
  return out;
}

double opticalDepthOver0(const ArchetypeKey& key) {
  static_assert(kOpticalDepthStep == 2);
  return std::exp2(key.opticalDepthClass);
}

ArchetypeShape inClassOf(const ArchetypeKey& key, const ArchetypeShape& ofClass0) {
  const double by = opticalDepthOver0(key);
  ArchetypeShape shape = ofClass0;
  shape.opticalDepth *= by;
  for (shape::Puff& puff : shape.cloud.puffs) puff.extinctionPerMeter *= static_cast<float>(by);
  return shape;
}

double groundCovered(std::span<const shape::Puff> puffs, double widthMeters, double opticalDepth) {
  return Footprint(puffs, widthMeters).coveredAlone(opticalDepth, kCoveringOpticalDepth);
}

std::vector<shape::Puff> fewerPuffs(std::span<const shape::Puff> puffs, int count, double widthMeters,
                                    double opticalDepth, double ground) {
  std::vector<shape::Puff> few = shape::reduce(puffs, count);
  // Moments alone make few blobs that reach out further than the many did.
  for (int pass = 0; pass < 3; ++pass) {
    const double covered = groundCovered(few, widthMeters, opticalDepth);
    const auto by = static_cast<float>(std::clamp(std::sqrt(ground / covered), 0.7, 1.4));
    for (shape::Puff& puff : few) {
      puff.sigma *= glm::vec3(by, 1, by);
      puff.extinctionPerMeter /= by * by;
    }
  }
  return few;
}

std::string nameOf(const ArchetypeKey& key) {
  const auto text = [](int value) {
    return value < 0 ? fmt::format("m{}", -value) : fmt::format("{}", value);
  };
  constexpr std::array<const char*, 5> kGathered{"_lower", "_low", "", "_high", "_higher"};
  return fmt::format("{}_a{}_t{}_l{}_s{}_v{}{}{}", base::abbreviation(key.genus), text(key.aspectClass),
                     text(key.opticalDepthClass), text(key.layerClass), key.shearClass, key.variant,
                     key.closed ? "_c" : "", kGathered.at(static_cast<std::size_t>(key.gatheringClass + 2)));
}

}  // namespace cloudgen::pipeline
