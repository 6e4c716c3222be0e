// SPDX-License-Identifier: Apache-2.0
#include "pipeline/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace cloudgen::pipeline {
namespace {

using field::Layer;

constexpr float kWithinMeters = 1000;
constexpr float kLeastCover = 0.005f;

/// Clear air between two layers, m; negative where they overlap.
float gapBetween(const Layer& a, const Layer& b) { return -field::overlapMeters(a, b); }

float middle(const Layer& layer) { return 0.5f * (layer.baseMeters + layer.topMeters); }

/// The nearest of `others` by the middle of its height, among those within reach; -1 if there is none.
template <class Layers>
int nearest(const Layer& layer, const Layers& others, float reachMeters) {
  int best = -1;
  float least = 0;
  for (int i = 0; i < static_cast<int>(others.size()); ++i) {
    const Layer& other = *others[static_cast<std::size_t>(i)];
    if (gapBetween(layer, other) > reachMeters) continue;
    const float distance = std::abs(middle(layer) - middle(other));
    if (best < 0 || distance < least) best = i, least = distance;
  }
  return best;
}

constexpr float kAnyReach = 1e6f;

bool isTyped(const Layer& layer) { return !layer.rule.empty(); }

/// What a typed layer takes of the model's: everything but genus and heights.
Layer typedWithWater(const Layer& typed, const Layer& water, float cover, std::string_view rule) {
  Layer layer = water;
  layer.cell = typed.cell;
  layer.spreadEvenly(typed.baseMeters, typed.topMeters);
  layer.genus = typed.genus;
  layer.rule = isTyped(typed) ? rule : std::string_view();
  layer.fraction = cover;
  return layer;
}

/// One fine cell of a coarse one and its own layers.
struct FineCell {
  std::uint32_t cell = 0;
  double areaSquareMeters = 0;
  std::vector<const Layer*> layers;
};

using LayersOfCell = std::map<std::uint32_t, std::vector<const Layer*>>;

LayersOfCell byCell(const std::vector<Layer>& layers) {
  LayersOfCell cells;
  for (const Layer& layer : layers) cells[layer.cell].push_back(&layer);
  return cells;
}

/// The model's cell and the finer typing's cells whose centres lie in it.
class TypingInModelCell {
 public:
  TypingInModelCell(std::vector<FineCell> cells, const std::vector<const Layer*>& water, Pairing& pairing,
                    std::vector<Layer>& out)
      : cells_(std::move(cells)), water_(water), pairing_(pairing), out_(out), met_(water.size()) {
    for (const FineCell& cell : cells_) area_ += cell.areaSquareMeters;
    meet();
    for (std::size_t w = 0; w < water_.size(); ++w) share(*water_[w], met_[w]);
  }

 private:
  struct Met {
    const FineCell* cell;
    const Layer* typed;
  };

  /// Finds the layer of the model that each typed layer meets; those that meet none keep their own amount.
  void meet() {
    for (const FineCell& cell : cells_)
      for (const Layer* typed : cell.layers) {
        const int w = nearest(*typed, water_, kWithinMeters);
        if (w >= 0)
          met_[static_cast<std::size_t>(w)].push_back({&cell, typed});
        else
          standAlone(cell, *typed);
      }
  }

  void standAlone(const FineCell& cell, const Layer& typed) {
    ++pairing_.typingAlone;
    pairing_.addedCover += typed.fraction * cell.areaSquareMeters;
    Layer layer = typed;
    if (isTyped(layer)) layer.rule = "typing.alone";
    out_.push_back(layer);
  }

  /// Gives the cover of a layer of the model to the typed layers it meets, what does not fit to other cells.
  void share(const Layer& water, const std::vector<Met>& met) {
    double wanted = water.fraction * area_;
    pairing_.modelCover += wanted;
    const double scale = scaleFor(met, wanted);
    double given = 0;
    for (const Met& one : met) {
      const float cover = std::min(1.0f, static_cast<float>(one.typed->fraction * scale));
      given += cover * one.cell->areaSquareMeters;
      ++pairing_.matchedLayers;
      out_.push_back(typedWithWater(*one.typed, water, cover, "typing"));
    }
    const double rest = wanted - given;
    given += spread(water, met, rest);
    pairing_.keptCover += given;
    if (met.empty()) ++pairing_.modelAlone;
  }

  /// The factor by which typed covers (held at 1) sum to the wanted cover, as far as they can.
  static double scaleFor(const std::vector<Met>& met, double wanted) {
    const auto sum = [&](double scale) {
      double covered = 0;
      for (const Met& one : met)
        covered += std::min(1.0, one.typed->fraction * scale) * one.cell->areaSquareMeters;
      return covered;
    };
    double low = 0, high = 1e4;
    if (sum(high) <= wanted) return high;
    for (int i = 0; i < 60; ++i) {
      const double half = 0.5 * (low + high);
      (sum(half) < wanted ? low : high) = half;
    }
    return 0.5 * (low + high);
  }

  /// The rest of a layer of the model: alike in all cells that the typing leaves clear, and what they cannot
  /// hold in those whose typed layers do not meet it.
  double spread(const Layer& water, const std::vector<Met>& met, double rest) {
    std::set<const FineCell*> meeting;
    for (const Met& one : met) meeting.insert(one.cell);
    std::vector<const FineCell*> clear, typed;
    for (const FineCell& cell : cells_)
      if (!meeting.contains(&cell)) (cell.layers.empty() ? clear : typed).push_back(&cell);
    const double given = fill(clear, water, met, rest);
    return given + fill(typed, water, met, rest - given);
  }

  double fill(const std::vector<const FineCell*>& cells, const Layer& water, const std::vector<Met>& met,
              double wanted) {
    double area = 0;
    for (const FineCell* cell : cells) area += cell->areaSquareMeters;
    if (area <= 0 || wanted <= kLeastCover * area) return 0;
    const auto cover = static_cast<float>(std::min(1.0, wanted / area));
    for (const FineCell* cell : cells) {
      Layer layer = water;
      layer.cell = cell->cell;
      layer.fraction = cover;
      const int own = nearest(water, cell->layers, kAnyReach);
      const Layer* typed = own >= 0 ? cell->layers[static_cast<std::size_t>(own)]
                                    : (met.empty() ? nullptr : met.front().typed);
      if (typed && isTyped(*typed)) {
        layer.genus = typed->genus;
        layer.rule = "typing.spread";
      }
      out_.push_back(layer);
    }
    return cover * area;
  }

  std::vector<FineCell> cells_;
  const std::vector<const Layer*>& water_;
  Pairing& pairing_;
  std::vector<Layer>& out_;
  std::vector<std::vector<Met>> met_;
  double area_ = 0;
};

/// A coarse typing cell and the finer model's cells whose centres lie in it.
void pairModelInTypingCell(const std::vector<FineCell>& cells, const std::vector<const Layer*>& typed,
                           Pairing& pairing, std::vector<Layer>& out) {
  std::vector<bool> met(typed.size());
  for (const FineCell& cell : cells)
    for (const Layer* water : cell.layers) {
      const double cover = water->fraction * cell.areaSquareMeters;
      pairing.modelCover += cover;
      pairing.keptCover += cover;
      Layer layer = *water;
      int t = nearest(*water, typed, kWithinMeters);
      if (t >= 0) met[static_cast<std::size_t>(t)] = true, ++pairing.matchedLayers;
      if (t < 0) t = nearest(*water, typed, kAnyReach);
      if (t < 0) ++pairing.modelAlone;
      if (t >= 0 && isTyped(*typed[static_cast<std::size_t>(t)])) {
        layer.genus = typed[static_cast<std::size_t>(t)]->genus;
        layer.rule = "typing";
      }
      out.push_back(layer);
    }
  for (std::size_t t = 0; t < typed.size(); ++t) {
    if (met[t]) continue;
    ++pairing.typingAlone;
    for (const FineCell& cell : cells) {
      Layer layer = *typed[t];
      layer.cell = cell.cell;
      if (isTyped(layer)) layer.rule = "typing.alone";
      pairing.addedCover += layer.fraction * cell.areaSquareMeters;
      out.push_back(layer);
    }
  }
}

/// Numbers the layers of each cell upwards.
void number(std::vector<Layer>& layers) {
  std::stable_sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.baseMeters < b.baseMeters;
  });
  for (std::size_t i = 0; i < layers.size(); ++i)
    layers[i].ordinal = static_cast<std::uint16_t>(
        i > 0 && layers[i - 1].cell == layers[i].cell ? layers[i - 1].ordinal + 1 : 0);
}

/// Genera typed in a column of the typing against those built in it; `columnOf` finds a layer's column.
void countAgreement(const std::map<std::uint32_t, std::set<base::Genus>>& typed,
                    const std::map<std::uint32_t, std::uint32_t>& columnOf, const std::vector<Layer>& layers,
                    Pairing& pairing) {
  std::map<std::uint32_t, std::set<base::Genus>> built;
  std::set<std::uint32_t> undecided;
  for (const Layer& layer : layers) {
    const auto column = columnOf.find(layer.cell);
    if (column == columnOf.end() || !typed.contains(column->second)) continue;
    if (isTyped(layer))
      built[column->second].insert(layer.genus);
    else
      undecided.insert(column->second);
  }
  for (const auto& [cell, genera] : typed) {
    ++pairing.typedColumns;
    const auto found = built.find(cell);
    pairing.agreeingColumns += found != built.end() && found->second == genera && !undecided.contains(cell);
  }
}

std::optional<std::uint32_t> middleCell(const field::Grid& grid, const base::GeoBox& box) {
  return field::CellFinder(grid).at({box.centerLongitude(), box.centerLatitude()});
}

double longestSideMeters(const field::Grid& grid, const base::GeoBox& box) {
  const auto cell = middleCell(grid, box);
  if (!cell) return 0;
  const glm::dvec2 sides = field::cellSidesMeters(grid, *cell);
  return std::max(sides.x, sides.y);
}

}  // namespace

Overlay overlayOf(const field::Grid& model, const field::Grid& typing, const base::GeoBox& box) {
  constexpr int kPlaces = 32;
  const field::CellFinder inModel(model), inTyping(typing);
  double places = 0, typed = 0, modelArea = 0, typingArea = 0;
  for (int row = 0; row < kPlaces; ++row)
    for (int column = 0; column < kPlaces; ++column) {
      const field::GeoPoint place{base::wrappedLongitude(box.west + box.width() * (column + 0.5) / kPlaces),
                                  box.south + box.height() * (row + 0.5) / kPlaces};
      const auto own = inModel.at(place), theirs = inTyping.at(place);
      if (!own) continue;
      ++places;
      if (!theirs) continue;
      ++typed;
      modelArea += field::cellAreaSquareMeters(model, *own);
      typingArea += field::cellAreaSquareMeters(typing, *theirs);
    }
  return {places > 0 ? typed / places : 0, typed > 0 && typingArea < modelArea};
}

base::GeoBox grownBox(const field::Grid& model, const field::Grid& typing, const base::GeoBox& box) {
  constexpr double kMetersPerDegree = 111195;
  const double margin =
      1.3 * std::max(longestSideMeters(model, box), longestSideMeters(typing, box)) / kMetersPerDegree;
  base::GeoBox grown = box;
  grown.south = std::max(-90.0, box.south - margin);
  grown.north = std::min(90.0, box.north + margin);
  const double steepest = std::max(std::abs(grown.south), std::abs(grown.north));
  const double sideways = margin / std::max(0.01, std::cos(steepest * 0.017453292519943295));
  if (box.width() + 2 * sideways >= 360) {
    grown.west = -180;
    grown.east = 180;
  } else {
    grown.west = base::wrappedLongitude(box.west - sideways);
    grown.east = base::wrappedLongitude(box.east + sideways);
  }
  return grown;
}

PairedLayers pairLayers(const field::Grid& model, const std::vector<Layer>& modelLayers,
                        const field::Grid& typing, const std::vector<Layer>& typedLayers, bool typingFiner,
                        const std::vector<std::uint32_t>& fineCells) {
  const field::Grid &fine = typingFiner ? typing : model, &coarse = typingFiner ? model : typing;
  const LayersOfCell fineLayers = byCell(typingFiner ? typedLayers : modelLayers),
                     coarseLayers = byCell(typingFiner ? modelLayers : typedLayers);
  const field::CellFinder finder(coarse);
  std::map<std::uint32_t, std::vector<FineCell>> children;
  std::vector<FineCell> orphans;  // beyond the coarse grid
  for (const std::uint32_t cell : fineCells) {
    FineCell child{cell, field::cellAreaSquareMeters(fine, cell), {}};
    if (const auto found = fineLayers.find(cell); found != fineLayers.end()) child.layers = found->second;
    const auto parent = finder.at(field::centerOf(fine, cell));
    (parent ? children[*parent] : orphans).push_back(std::move(child));
  }

  PairedLayers paired;
  static const std::vector<const Layer*> kNone;
  const auto pair = [&](std::vector<FineCell> cells, const std::vector<const Layer*>& above) {
    if (typingFiner)
      TypingInModelCell(std::move(cells), above, paired.pairing, paired.layers);
    else
      pairModelInTypingCell(cells, above, paired.pairing, paired.layers);
  };
  std::map<std::uint32_t, std::set<base::Genus>> typed;
  std::map<std::uint32_t, std::uint32_t> columnOf;
  for (auto& [parent, cells] : children) {
    const auto found = coarseLayers.find(parent);
    const auto& above = found == coarseLayers.end() ? kNone : found->second;
    for (const FineCell& cell : cells) {
      const std::uint32_t column = typingFiner ? cell.cell : parent;
      columnOf[cell.cell] = column;
      for (const Layer* layer : typingFiner ? cell.layers : above)
        if (isTyped(*layer)) typed[column].insert(layer->genus);
    }
    pair(std::move(cells), above);
  }
  pair(std::move(orphans), kNone);
  number(paired.layers);
  countAgreement(typed, columnOf, paired.layers, paired.pairing);
  return paired;
}

}  // namespace cloudgen::pipeline
