// SPDX-License-Identifier: Apache-2.0
#include "pipeline/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "pipeline/archetype.hpp"
#include "pipeline/size.hpp"
#include "pipeline/structure.hpp"

namespace cloudgen::pipeline {
namespace {

constexpr double kMostCandidates = 200'000;
/// Variation of optical depth within a layer, as a deviation of its logarithm: half of what Shonk et al. 2010
/// give for the whole of a cell (fractional deviation 0.75), the other half lies within a cloud.
constexpr double kOpticalDepthDeviation = 0.35;
constexpr double kJitter = 0.55, kThinJitter = 0.2;
/// Rank that a second lattice between the places of the first adds: it fills what those leave open.
constexpr double kReserve = 1000;

/// Of its width, from its middle: as far as a cloud is seen.
constexpr double kReach = 0.5;

/// Columns and rows of a lattice over a cell.
struct Lattice {
  int columns = 1, rows = 1;
};

Lattice latticeOf(const glm::dvec2& sides, double places) {
  const double aspect = std::clamp(sides.x / sides.y, 0.02, 50.0);
  Lattice lattice;
  lattice.columns = std::max(1, static_cast<int>(std::lround(std::sqrt(places * aspect))));
  lattice.rows = std::max(1, static_cast<int>(std::lround(places / lattice.columns)));
  return lattice;
}

double densityOf(const field::Layer& layer, const shape::Recipe& recipe) {
  return recipe.sheet ? 1.0 : std::min(3.0, 0.15 + 3.0 * layer.fraction);
}

/// Depth of an even layer whose lower and upper heights these are.
double wholeDepth(double lowerMeters, double upperMeters) {
  return (upperMeters - lowerMeters) / (1 - 2 * field::kBorderShare);
}

/// Small heaps are shallow, large ones deep: all of them so much deeper that the deepest of those that come
/// first reaches the layer's top.
void reachTheTop(std::span<Candidate> heaps, std::size_t expected, const field::Layer& layer) {
  const auto depth = static_cast<float>(wholeDepth(layer.lowerMeters, layer.upperMeters));
  float deepest = 0;
  for (const Candidate& heap : heaps.first(std::min(heaps.size(), std::max<std::size_t>(1, expected))))
    deepest = std::max(deepest, heap.depthMeters);
  for (Candidate& heap : heaps) {
    heap.depthMeters = std::min(depth, heap.depthMeters * depth / deepest);
    heap.widthMeters = static_cast<float>(drawnWidthMeters(heap.depthMeters, heap.widthMeters));
  }
}

}  // namespace

Candidates candidatesOf(const CandidateContext& context, const field::Layer& layer) {
  const auto& [grid, frame, options, general, layersByCell] = context;
  const shape::Recipe& recipe = options.recipes.of(layer);
  const double meanWidth = meanWidthMeters(general, recipe, layer.depthMeters(), layer.fraction);
  const double covers = coveredSquareMeters(recipe, meanWidth);
  const double area = field::cellAreaSquareMeters(grid, layer.cell);
  const double wanted = std::min(kMostCandidates, densityOf(layer, recipe) * area / covers);
  const glm::dvec2 sides = field::cellSidesMeters(grid, layer.cell);
  const Lattice lattice = latticeOf(sides, wanted);
  const bool thin = isThin(layerClassOf(layer.opticalDepth()));
  // Twice as often as needed, so that there is a choice; thin ones are all taken.
  const double chance = wanted < 1 ? (thin ? layer.fraction : 2) * wanted : 1;
  const double scale = std::sqrt(covers);
  const Structure structure(24 * scale, scale, options.seed * 31 + static_cast<std::uint64_t>(layer.genus));
  const Structure thickness(40 * scale, scale, options.seed * 37 + static_cast<std::uint64_t>(layer.genus));
  std::optional<LayerAround> around;  // asked for where there is a candidate at all
  Candidates candidates;
  candidates.everyCell = wanted >= 1;
  const auto addLattice = [&](std::uint32_t firstNumber, double shift, double later) {
    for (int row = 0; row < lattice.rows; ++row)
      for (int column = 0; column < lattice.columns; ++column) {
        Candidate candidate;
        candidate.number = firstNumber + static_cast<std::uint32_t>(row * lattice.columns + column);
        base::RandomStream stream(options.seed, layer.cell, base::Purpose::CloudPlace,
                                  itemOf(layer, candidate.number));
        const double jitter = !candidates.everyCell || !recipe.sheet ? 1 : (thin ? kThinJitter : kJitter);
        const auto along = [&](int i, int count) {
          const double t = (i + 0.5 + shift + jitter * (stream.uniform() - 0.5)) / count;
          return t < 1 ? t : t - 1;
        };
        const double u = along(column, lattice.columns), v = along(row, lattice.rows);
        if (stream.uniform() >= chance) continue;
        candidate.place = field::pointIn(grid, layer.cell, u, v);
        const bool inside =
            frame.box().contains(candidate.place.longitudeDegrees, candidate.place.latitudeDegrees);
        if (!inside && (!candidates.list.empty() || candidates.outside)) continue;
        if (!around) around = layersByCell.of(layer);
        LayerAtPlace here = around->at(u, v);
        // What stands apart shows no seam between cells, and has the heights of its own.
        if (!recipe.sheet) here.lowerMeters = layer.lowerMeters, here.upperMeters = layer.upperMeters;
        const double softened = recipe.sheet ? 0.1 : 0.6;
        const double deviate =
            structure.along(candidate.place, {layer.windEast, layer.windNorth}, recipe.streets) +
            softened * stream.gaussian();
        candidate.rank = rankOf(deviate / std::sqrt(1 + softened * softened)) / here.fraction + later;
        const double depth = wholeDepth(here.lowerMeters, here.upperMeters);
        const CloudSize size = sizeOf(layer, candidate.number, depth, meanWidth, options);
        candidate.depthMeters = static_cast<float>(size.depthMeters);
        candidate.widthMeters = static_cast<float>(size.widthMeters);
        candidate.baseMeters = static_cast<float>(here.lowerMeters - field::kBorderShare * depth);
        const double deviation = thin ? 0 : kOpticalDepthDeviation;
        candidate.opticalDepth =
            static_cast<float>(here.opticalDepth * std::exp(deviation * thickness.at(candidate.place) -
                                                            0.5 * deviation * deviation));
        if (candidates.everyCell) {
          const glm::dvec2 place = around->awayFromClearSides({u, v}, kReach * size.widthMeters / sides);
          const field::GeoPoint moved = field::pointIn(grid, layer.cell, place.x, place.y);
          if (frame.box().contains(moved.longitudeDegrees, moved.latitudeDegrees)) candidate.place = moved;
        }
        const glm::dvec3 scene =
            frame.toScene(candidate.place.longitudeDegrees, candidate.place.latitudeDegrees, 0);
        candidate.scenePlace = {scene.x, scene.z};
        candidate.yawStep = yawStepOf(layer, candidate.number, candidate.place, options, frame);
        if (inside)
          candidates.list.push_back(candidate);
        else
          candidates.outside = candidate;
      }
  };
  const auto places = static_cast<std::uint32_t>(lattice.columns * lattice.rows);
  addLattice(0, 0, 0);
  candidates.elements = candidates.list.size();
  if (candidates.everyCell && (recipe.sheet || recipe.form == shape::Form::Filaments))
    addLattice(places, 0.5, kReserve);
  if (candidates.everyCell && recipe.form == shape::Form::Filaments && !recipe.sheet)
    addLattice(2 * places, 0.25, 2 * kReserve);
  candidates.nextNumber = 3 * places;
  std::sort(candidates.list.begin(), candidates.list.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(a.rank, a.number) < std::pair(b.rank, b.number);
  });
  if (recipe.form == shape::Form::Heap)
    reachTheTop(candidates.list, static_cast<std::size_t>(std::lround(layer.fraction * area / covers)),
                layer);
  return candidates;
}

bool moveTo(const CandidateContext& context, const field::Layer& layer, const glm::dvec2& scenePlace,
            Candidate& candidate) {
  const glm::dvec3 geo = context.frame.toGeographic({scenePlace.x, 0, scenePlace.y});
  // Beyond the edge of the globe's map there is no place at all.
  if (!std::isfinite(geo.x) || !std::isfinite(geo.y) || !context.frame.box().contains(geo.x, geo.y))
    return false;
  candidate.place = {geo.x, geo.y};
  candidate.scenePlace = scenePlace;
  candidate.yawStep = yawStepOf(layer, candidate.number, candidate.place, context.options, context.frame);
  return true;
}

std::optional<Candidate> candidateAt(const CandidateContext& context, const field::Layer& layer,
                                     Candidates& candidates, const glm::dvec2& scenePlace) {
  const auto nearest = std::min_element(
      candidates.list.begin(), candidates.list.end(), [&](const Candidate& a, const Candidate& b) {
        const auto away = [&](const Candidate& c) { return glm::distance(c.scenePlace, scenePlace); };
        return std::pair(away(a), a.number) < std::pair(away(b), b.number);
      });
  if (nearest == candidates.list.end() && !candidates.outside) return std::nullopt;
  Candidate candidate = nearest == candidates.list.end() ? *candidates.outside : *nearest;
  candidate.number = candidates.nextNumber;
  if (!moveTo(context, layer, scenePlace, candidate)) return std::nullopt;
  ++candidates.nextNumber;
  return candidate;
}

}  // namespace cloudgen::pipeline
