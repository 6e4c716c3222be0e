// SPDX-License-Identifier: Apache-2.0
#include "pipeline/fitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "field/overlap.hpp"
#include "pipeline/archetype.hpp"
#include "pipeline/misfit.hpp"
#include "scene/scene.hpp"

namespace cloudgen::pipeline {
namespace {

/// Widths that a candidate is tried at, as shares of its own: in the steps that archetypes have.
constexpr std::array<double, 6> kShares{1, 0.7071, 0.5, 0.3536, 0.25, 0.1768};
constexpr int kRounds = 4, kBalancings = 2, kLastBalancings = 8;
/// Candidates that may fail one after the other before a layer is left as it is.
constexpr int kPatience = 12;
/// Places at which one more cloud of a layer is tried, and the least of its candidates' width that it has.
constexpr std::size_t kTrials = 12;
constexpr double kNarrowestOfMore = 0.25;
/// A layer that shows less than this share of its optical depth lacks a cloud.
constexpr double kLittleWater = 0.7;
constexpr double kNear = 0.01;

/// A candidate that stands.
struct Taken {
  std::uint32_t candidate = 0;
  Stamp stamp;
  double share = 0, next = 0;  ///< of the layer's water, m2; and what it comes to after balancing
};

/// The state of a layer while its clouds are found.
struct Filling {
  std::uint32_t layer = 0;    ///< in the table
  std::uint32_t painted = 0;  ///< in the canvas
  std::uint32_t cell = 0;     ///< in the canvas
  Candidates candidates;
  /// Candidates not tried yet, best last: under open sky, under clouds.
  std::vector<std::uint32_t> open, shaded;
  std::vector<Taken> taken;
};

std::uint64_t mixed(std::uint64_t x) {  // SplitMix64 (Steele et al. 2014)
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

class Fitting {
 public:
  Fitting(const CandidateContext& context, std::span<const std::uint32_t> cells,
          std::span<const field::Layer> layers, FootprintBook& footprints, double pixelMeters)
      : context_(context),
        layers_(layers),
        footprints_(footprints),
        canvas_(context.grid, context.frame, cells, layers, pixelMeters),
        misfit_(canvas_, layers) {
    gather();
  }

  std::vector<FittedCloud> run() {
    for (Filling& filling : fillings_) fill(filling);
    misfit_.judgeTheWholeSky();
    for (int round = 0; round < kRounds; ++round) {
      shareOutWater();
      balanceOpticalDepth(round + 1 < kRounds ? kBalancings : kLastBalancings);
      for (Filling& filling : fillings_) {
        if (round + 1 < kRounds || !isFullSheet(filling)) redraw(filling);
        if (round + 1 < kRounds) addWhereSomethingIsMissing(filling);
      }
    }
    std::vector<FittedCloud> clouds;
    for (const Filling& filling : fillings_)
      for (const Taken& taken : filling.taken)
        clouds.push_back({filling.layer, filling.candidates.list[taken.candidate], taken.stamp.widthMeters,
                          taken.stamp.depthMeters, taken.stamp.extinctionArea});
    return clouds;
  }

 private:
  /// One a layer, from the highest of a cell down, cells as if by chance.
  void gather() {
    const auto& cells = canvas_.cells();
    for (std::uint32_t c = 0; c < cells.size(); ++c)
      for (std::uint32_t i = 0; i < cells[c].layerCount; ++i) {
        Filling filling;
        filling.cell = c;
        filling.painted = cells[c].firstLayer + i;
        filling.layer = canvas_.layers()[filling.painted].layer;
        fillings_.push_back(std::move(filling));
      }
    std::sort(fillings_.begin(), fillings_.end(), [&](const Filling& a, const Filling& b) {
      const auto place = [&](const Filling& f) {
        return std::tuple(cells[f.cell].firstLayer + cells[f.cell].layerCount - f.painted,
                          mixed(cells[f.cell].cell), cells[f.cell].cell);
      };
      return place(a) < place(b);
    });
    for (Filling& filling : fillings_) filling.candidates = candidatesOf(context_, layers_[filling.layer]);
  }

  const shape::Recipe& recipeOf(const Filling& filling) const {
    return context_.options.recipes.of(layers_[filling.layer]);
  }

  Stamp stampOf(const field::Layer& layer, const Candidate& candidate, double share) {
    const shape::Recipe& recipe = context_.options.recipes.of(layer);
    Stamp stamp;
    stamp.place = candidate.scenePlace;
    stamp.depthMeters = depthAt(recipe, candidate, share);
    stamp.widthMeters = drawnWidthMeters(stamp.depthMeters, candidate.widthMeters * share);
    stamp.yawRadians = scene::yawRadians(candidate.yawStep);
    stamp.baseMeters = candidate.baseMeters;
    stamp.topMeters = candidate.baseMeters + static_cast<float>(stamp.depthMeters);
    stamp.key = shapeKeyOf(layer, candidate.number, stamp.depthMeters, stamp.widthMeters, context_.options);
    const auto holdOver = [&](double covers) {
      hold(stamp, candidate.opticalDepth * covers * stamp.widthMeters * stamp.widthMeters);
    };
    holdOver(coveredSquareMeters(recipe, 1));
    if (!recipe.sheet) holdOver(stamp.footprint->coveredAlone(candidate.opticalDepth, kCoveringOpticalDepth));
    return stamp;
  }

  /// Gives a stamp that is not on the canvas its extinction, and the footprint that is drawn for it.
  void hold(Stamp& stamp, double extinctionArea) {
    stamp.extinctionArea = extinctionArea;
    stamp.key.opticalDepthClass =
        opticalDepthClassOf(extinctionArea / shape::footprintSquareMeters(stamp.widthMeters));
    stamp.footprint = &footprints_.of(stamp.key);
  }

  /// What a cloud may hold, m2: a few times what it would if its optical depth were the layer's over all that
  /// it covers alone, or that it stands for among others.
  static double mostHeld(const shape::Recipe& recipe, const Candidate& candidate, const Stamp& stamp) {
    constexpr double kDensest = 4;
    const double alone = stamp.footprint->coveredAlone(candidate.opticalDepth, kCoveringOpticalDepth);
    return kDensest * candidate.opticalDepth * stamp.widthMeters * stamp.widthMeters *
           std::max(alone, coveredSquareMeters(recipe, 1));
  }

  /// A narrower heap is less deep, too, where it would else be a column; a form of its own keeps its
  /// proportions.
  static double depthAt(const shape::Recipe& recipe, const Candidate& candidate, double share) {
    constexpr double kSlender = 0.6;  ///< depth over width
    const bool ownForm = recipe.form == shape::Form::File;
    if (recipe.sheet || (recipe.form != shape::Form::Heap && !ownForm)) return candidate.depthMeters;
    if (ownForm) return candidate.depthMeters * std::max(0.3, share);
    const double asSlender = kSlender * share * candidate.widthMeters;
    return std::min<double>(candidate.depthMeters,
                            std::max(asSlender, candidate.depthMeters * std::max(0.3, share)));
  }

  /// Sheets and towers are made narrower only so far, or they would be something else.
  static bool isTooNarrow(const shape::Recipe& recipe, const Candidate& candidate, double share) {
    constexpr double kSheetAspect = 4, kTowerAspect = 1.2;
    const double aspect = share * candidate.widthMeters / candidate.depthMeters;
    if (share >= 0.5) return false;
    return (recipe.sheet && aspect < kSheetAspect) ||
           (recipe.form == shape::Form::Tower && aspect < kTowerAspect);
  }

  void paint() {
    canvas_.paint(stroke_);
    misfit_.note(stroke_);
  }

  /// Takes a candidate at the width that brings the canvas nearest to what is wanted, if any does.
  bool take(Filling& filling, std::uint32_t number) {
    const field::Layer& layer = layers_[filling.layer];
    const bool sheet = context_.options.recipes.of(layer).sheet;
    const PaintedLayer& painted = canvas_.layers()[filling.painted];
    std::optional<Stamp> best;
    double least = 0;
    for (const double share : kShares) {
      if (isTooNarrow(context_.options.recipes.of(layer), filling.candidates.list[number], share)) break;
      const Stamp stamp = stampOf(layer, filling.candidates.list[number], share);
      canvas_.brush(stamp, 1, stroke_);
      const double change = misfit_.changeBy(stroke_);
      if (!best ? change < 0 || (sheet && change <= 0) : change < least) best = stamp, least = change;
      // Narrower ones come in question only where this one covers too much.
      if (best && ownChange(filling) + painted.covered <= painted.wantedCover) break;
    }
    if (!best) return false;
    accept(filling, number, *best);
    return true;
  }

  void accept(Filling& filling, std::uint32_t number, const Stamp& stamp) {
    canvas_.brush(stamp, 1, stroke_);
    paint();
    filling.taken.push_back({number, stamp, 0, 0});
  }

  /// A layer whose ground its neighbours' clouds cover already still has its water: one cloud holds it, at
  /// the width that can and that takes the canvas least further from what is wanted.
  void takeOne(Filling& filling, std::uint32_t number) {
    const field::Layer& layer = layers_[filling.layer];
    const Candidate& candidate = filling.candidates.list[number];
    const double water = canvas_.layers()[filling.painted].wantedOpticalDepth * canvas_.pixelSquareMeters();
    std::optional<Stamp> best;
    double least = 0;
    for (const double share : kShares) {
      const Stamp stamp = stampOf(layer, candidate, share);
      if (best && mostHeld(recipeOf(filling), candidate, stamp) < water) break;
      canvas_.brush(stamp, 1, stroke_);
      const double change = misfit_.changeBy(stroke_);
      if (!best || change < least) best = stamp, least = change;
    }
    accept(filling, number, *best);
    std::erase(filling.open, number);
    std::erase(filling.shaded, number);
  }

  int ownChange(const Filling& filling) const {
    for (const Stroke::Touched& touched : stroke_.touched)
      if (touched.layer == filling.painted) return touched.coveredChange;
    return 0;
  }

  bool isFullSheet(const Filling& filling) const {
    return recipeOf(filling).sheet && layers_[filling.layer].fraction >= kFullCover;
  }

  bool isFull(const Filling& filling) {
    const PaintedLayer& painted = canvas_.layers()[filling.painted];
    const field::Layer& layer = layers_[filling.layer];
    const auto elements = static_cast<double>(filling.candidates.elements),
               taken = static_cast<double>(filling.taken.size());
    // A full sheet has all of its elements, or it would be uneven; a thin one no more than it is owed, or it
    // would be thinner still.
    if (isFullSheet(filling) && taken < elements) return false;
    if (isThin(layerClassOf(layer.opticalDepth()))) {
      const bool isOwed = taken < layer.fraction * elements;
      if (!isOwed || !painted.covers) return !isOwed;
    }
    return painted.covered >= painted.wantedCover - 0.5;
  }

  void fill(Filling& filling) {
    const PaintedCell& cell = canvas_.cells()[filling.cell];
    const PaintedLayer& painted = canvas_.layers()[filling.painted];
    if (cell.pixels == 0) return;
    misfit_.want(filling.cell, cell.pixels * coverDownTo(filling));
    coveredBefore_ = cell.covered;
    for (auto i = static_cast<std::uint32_t>(filling.candidates.list.size()); i-- > 0;)
      (canvas_.coveredByOthers(filling.candidates.list[i].scenePlace, painted) ? filling.shaded
                                                                               : filling.open)
          .push_back(i);
    addMore(filling);
    if (filling.taken.empty() && filling.candidates.everyCell && !filling.candidates.list.empty())
      takeOne(filling, 0);
  }

  /// Of a layer and those above it in its cell together.
  double coverDownTo(const Filling& filling) const {
    const PaintedCell& cell = canvas_.cells()[filling.cell];
    std::vector<field::CoverLayer> above;
    for (std::uint32_t i = filling.painted; i < cell.firstLayer + cell.layerCount; ++i) {
      const field::Layer& layer = layers_[canvas_.layers()[i].layer];
      if (canvas_.layers()[i].covers) above.push_back({layer.fraction, layer.baseMeters, layer.topMeters});
    }
    return field::overlappedCover(above, field::centerOf(context_.grid, cell.cell).latitudeDegrees);
  }

  void addMore(Filling& filling) {
    int failed = 0;
    while (!isFull(filling) && failed < kPatience) {
      const std::optional<std::uint32_t> next = nextOf(filling);
      if (!next) break;
      failed = take(filling, *next) ? 0 : failed + 1;
    }
  }

  /// The best of those under open sky or of those under clouds, whichever lag behind.
  std::optional<std::uint32_t> nextOf(Filling& filling) {
    const PaintedCell& cell = canvas_.cells()[filling.cell];
    const PaintedLayer& painted = canvas_.layers()[filling.painted];
    const double openWanted = misfit_.wantedOfAll(filling.cell) - cell.covered;
    const double wanted = painted.wantedCover - painted.covered;
    const bool open =
        !filling.open.empty() &&
        (filling.shaded.empty() || openWanted * (cell.pixels) >= wanted * (cell.pixels - coveredBefore_));
    std::vector<std::uint32_t>& from = open ? filling.open : filling.shaded;
    if (from.empty()) return std::nullopt;
    const std::uint32_t next = from.back();
    from.pop_back();
    return next;
  }

  /// Draws each cloud wider or narrower with the water that it has, or gives it to the others of its layer,
  /// whatever takes the canvas nearer to what is wanted.
  void redraw(Filling& filling) {
    if (canvas_.cells()[filling.cell].pixels == 0 || (isMatched(filling) && !isFullSheet(filling))) return;
    // Within a full sheet narrower elements would be uneven: only those at its edge change.
    for (std::size_t i = filling.taken.size(); i-- > 0;)
      if (!isFullSheet(filling) || strays(filling.taken[i].stamp)) redraw(filling, i);
  }

  /// True if a stamp that is on the canvas covers something where too much is covered.
  bool strays(const Stamp& stamp) {
    canvas_.brush(stamp, -1, stroke_);
    return std::any_of(stroke_.touched.begin(), stroke_.touched.end(), [&](const Stroke::Touched& touched) {
      const PaintedLayer& layer = canvas_.layers()[touched.layer];
      return touched.coveredChange < 0 &&
             layer.covered > layer.wantedCover + kNear * canvas_.cells()[touched.cell].pixels;
    });
  }

  void addWhereSomethingIsMissing(Filling& filling) {
    const PaintedCell& cell = canvas_.cells()[filling.cell];
    const PaintedLayer& painted = canvas_.layers()[filling.painted];
    if (cell.pixels == 0) return;
    if (painted.covered < painted.wantedCover) {
      coveredBefore_ = cell.covered;
      addMore(filling);
    }
    const bool owesNoMore =
        isThin(layerClassOf(layers_[filling.layer].opticalDepth())) && !isFullSheet(filling);
    if (!painted.covers || owesNoMore) return;
    for (std::size_t added = 0; added < std::max<std::size_t>(1, filling.candidates.elements); ++added) {
      const bool lacksCover = painted.covered < painted.wantedCover - kNear * cell.pixels,
                 lacksWater = painted.opticalDepth < kLittleWater * painted.wantedOpticalDepth;
      if (!lacksCover && !lacksWater) return;
      if (!takeOneAt(filling, lacksCover ? canvas_.gapsOf(cell, painted) : canvas_.placesIn(cell))) return;
    }
  }

  /// Takes one more cloud of a layer at whichever of some places takes the canvas nearest to what is wanted,
  /// if any does: where none of its candidates need stand.
  bool takeOneAt(Filling& filling, std::span<const glm::dvec2> places) {
    const field::Layer& layer = layers_[filling.layer];
    std::optional<Stamp> best;
    Candidate bestCandidate;
    double least = 0;
    for (std::size_t trial = 0; trial < kTrials && !places.empty(); ++trial) {
      const glm::dvec2& place = places[(2 * trial + 1) * places.size() / (2 * kTrials)];
      const std::optional<Candidate> candidate = candidateAt(context_, layer, filling.candidates, place);
      if (!candidate) continue;
      for (const double share : kShares) {
        if (share < kNarrowestOfMore || isTooNarrow(recipeOf(filling), *candidate, share)) break;
        const Stamp stamp = stampOf(layer, *candidate, share);
        canvas_.brush(stamp, 1, stroke_);
        const double change = misfit_.changeBy(stroke_);
        if (change < least) best = stamp, least = change, bestCandidate = *candidate;
      }
    }
    if (!best) return false;
    filling.candidates.list.push_back(bestCandidate);
    accept(filling, static_cast<std::uint32_t>(filling.candidates.list.size() - 1), *best);
    return true;
  }

  /// True where a layer, and all layers of its cell together, cover what they should within a hundredth.
  bool isMatched(const Filling& filling) const {
    const PaintedCell& cell = canvas_.cells()[filling.cell];
    const PaintedLayer& painted = canvas_.layers()[filling.painted];
    const double near = kNear * cell.pixels;
    return std::abs(painted.covered - painted.wantedCover) <= near &&
           std::abs(cell.covered - misfit_.wantedOfAll(filling.cell)) <= near;
  }

  void redraw(Filling& filling, std::size_t i) {
    const Stamp was = filling.taken[i].stamp;
    const bool tooFarOut = strays(was);
    canvas_.brush(was, -1, stroke_);
    const double change = misfit_.changeBy(stroke_);
    paint();
    // The others of its layer would hold its water: what they make of it is no reason to keep it.
    const double asGiven = misfit_.changeAsGiven(stroke_, filling.painted);
    Candidate& candidate = filling.candidates.list[filling.taken[i].candidate];
    const shape::Recipe& recipe = recipeOf(filling);
    const field::Layer& layer = layers_[filling.layer];
    const auto holdsItsWater = [&](const Stamp& stamp) {
      return was.extinctionArea <= mostHeld(recipe, candidate, stamp);
    };
    double least =
        holdsItsWater(was) ? -change : std::numeric_limits<double>::max();  // of drawing it as it was
    Stamp best = was;
    Candidate bestCandidate = candidate;
    const auto tryHere = [&](const Candidate& here) {
      for (const double share : kShares) {
        if (isTooNarrow(recipe, here, share)) break;
        Stamp other = stampOf(layer, here, share);
        if (other.place == was.place && std::abs(other.widthMeters / was.widthMeters - 1) < 0.01) continue;
        if (share < 1 && !holdsItsWater(other)) break;
        hold(other, was.extinctionArea);
        canvas_.brush(other, 1, stroke_);
        const double error = misfit_.changeBy(stroke_);
        if (error < least) best = other, least = error, bestCandidate = here;
      }
    };
    tryHere(candidate);
    // What covers too much next door may stand further in, too.
    const glm::dvec2 middle = canvas_.cells()[filling.cell].middle;
    for (const double inwards : {0.25, 0.5}) {
      Candidate moved = candidate;
      if (tooFarOut && moveTo(context_, layer, glm::mix(candidate.scenePlace, middle, inwards), moved))
        tryHere(moved);
    }
    if (least > asGiven && canBeMissed(filling, i)) return giveAway(filling, i);
    canvas_.brush(best, 1, stroke_);
    paint();
    filling.taken[i].stamp = best;
    candidate = bestCandidate;
  }

  /// True if the others of its layer can hold the water of a cloud, too.
  bool canBeMissed(const Filling& filling, std::size_t i) const {
    double water = 0, room = 0;
    for (std::size_t k = 0; k < filling.taken.size(); ++k) {
      const Taken& taken = filling.taken[k];
      water += taken.stamp.extinctionArea;
      if (k != i) room += mostHeld(recipeOf(filling), filling.candidates.list[taken.candidate], taken.stamp);
    }
    return water <= room;
  }

  /// A cloud that is not on the canvas any more: the others of its layer take its water.
  void giveAway(Filling& filling, std::size_t i) {
    const double water = filling.taken[i].stamp.extinctionArea;
    filling.taken.erase(filling.taken.begin() + static_cast<std::ptrdiff_t>(i));
    double left = 0;
    for (const Taken& taken : filling.taken) left += taken.stamp.extinctionArea;
    for (Taken& taken : filling.taken) {
      canvas_.brush(taken.stamp, -1, stroke_);
      paint();
      taken.share *= 1 + water / left;
      hold(taken.stamp, taken.stamp.extinctionArea * (1 + water / left));
      canvas_.brush(taken.stamp, 1, stroke_);
      paint();
    }
  }

  /// The clouds of each layer hold what the layer holds; those that stand for many cells keep what they have.
  void shareOutWater() {
    for (Filling& filling : fillings_) {
      // Elements of a full sheet that were drawn narrower leave what they held to the others, or they would
      // be knots.
      if (filling.candidates.everyCell && isFullSheet(filling))
        for (Taken& taken : filling.taken)
          taken.stamp.extinctionArea = filling.candidates.list[taken.candidate].opticalDepth *
                                       taken.stamp.widthMeters * taken.stamp.widthMeters;
      double whole = 0;
      for (const Taken& taken : filling.taken) whole += taken.stamp.extinctionArea;
      const double wanted =
          canvas_.layers()[filling.painted].wantedOpticalDepth * canvas_.pixelSquareMeters();
      if (!(whole > 0) || !(wanted > 0)) continue;
      for (Taken& taken : filling.taken) {
        const bool isNew = taken.share == 0;
        if (filling.candidates.everyCell || isNew)
          hold(taken.stamp, taken.stamp.extinctionArea * wanted / whole);
        taken.share = filling.candidates.everyCell || isNew ? taken.stamp.extinctionArea : taken.share;
      }
    }
    repaint();
  }

  /// Moves water between clouds where the canvas shows too much or too little of it: what reaches over
  /// borders. Within bounds, for a thin layer must not give its own away because a thick neighbour leans
  /// over; wider ones where a cloud stands for the layers of many cells.
  void balanceOpticalDepth(int passes) {
    for (int pass = 0; pass < passes; ++pass) balanceOnce();
  }

  void balanceOnce() {
    constexpr double kMost = 3, kMostOfMany = 100, kMostOfThin = 1.15;
    const auto& layers = canvas_.layers();
    for (Filling& filling : fillings_)
      for (Taken& taken : filling.taken) {
        canvas_.brush(taken.stamp, 1, stroke_);
        double whole = 0, wanted = 0;
        for (const Stroke::Touched& touched : stroke_.touched) {
          whole += touched.opticalDepth;
          const PaintedLayer& layer = layers[touched.layer];
          if (layer.opticalDepth > 0)
            wanted += touched.opticalDepth * layer.wantedOpticalDepth / layer.opticalDepth;
        }
        if (!(whole > 0)) continue;
        const double most = filling.candidates.everyCell ? kMost : kMostOfMany;
        const double held =
            mostHeld(recipeOf(filling), filling.candidates.list[taken.candidate], taken.stamp);
        // What is thin would no longer be seen if it gave much away.
        const bool thin = isThin(layerClassOf(layers_[filling.layer].opticalDepth()));
        taken.next =
            std::min(held, std::clamp(taken.stamp.extinctionArea * wanted / whole,
                                      taken.share / (thin ? kMostOfThin : most), taken.share * most));
      }
    for (Filling& filling : fillings_)
      for (Taken& taken : filling.taken)
        if (taken.next > 0) hold(taken.stamp, taken.next);
    repaint();
  }

  void repaint() {
    canvas_.clear();
    misfit_.restart();
    for (const Filling& filling : fillings_)
      for (const Taken& taken : filling.taken) {
        canvas_.brush(taken.stamp, 1, stroke_);
        paint();
      }
  }

  const CandidateContext& context_;
  std::span<const field::Layer> layers_;
  FootprintBook& footprints_;
  Canvas canvas_;
  Misfit misfit_;
  std::vector<Filling> fillings_;
  int coveredBefore_ = 0;
  Stroke stroke_;
};

/// Fine enough to show a cell and what one cloud covers.
double pixelMetersFor(const CandidateContext& context, std::span<const field::Layer> layers) {
  double cell = 0, cloud = 0, weight = 0;
  for (const field::Layer& layer : layers) {
    const double area = field::cellAreaSquareMeters(context.grid, layer.cell) * layer.fraction;
    const shape::Recipe& recipe = context.options.recipes.of(layer);
    // Threads are finer than the clouds that they make up.
    const double finer = recipe.form == shape::Form::Filaments && !recipe.sheet ? 9 : 1;
    const double covers = coveredSquareMeters(recipe, meanWidthMeters(context.general, recipe,
                                                                      layer.depthMeters(), layer.fraction)) /
                          finer;
    // The mean of inverse squares: the finest count most.
    cell += area / field::cellAreaSquareMeters(context.grid, layer.cell);
    cloud += area / covers;
    weight += area;
  }
  if (weight <= 0) return 1e6;
  const double cellMeters = std::sqrt(weight / cell), cloudMeters = std::sqrt(weight / cloud);
  // Where a cloud spans many cells each needs but a pixel or two.
  if (cloudMeters > 2 * cellMeters) return std::max(cellMeters / 2, cloudMeters / 12);
  return std::min(cloudMeters / 4, cellMeters / (cellMeters > cloudMeters ? 20 : 8));
}

}  // namespace

std::vector<FittedCloud> fitClouds(const CandidateContext& context, std::span<const std::uint32_t> cells,
                                   std::span<const field::Layer> layers, FootprintBook& footprints) {
  // Rounded, so that the order of the layers does not show in what stands at the middles of pixels.
  const auto pixelMeters = static_cast<float>(pixelMetersFor(context, layers));
  return Fitting(context, cells, layers, footprints, pixelMeters).run();
}

}  // namespace cloudgen::pipeline
