// SPDX-License-Identifier: Apache-2.0
#include "check/fidelity/fidelity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "check/fidelity/even_places.hpp"
#include "check/fidelity/genus_score.hpp"
#include "check/fidelity/imager.hpp"

namespace cloudgen::check {
namespace {

/// Columns of which less lies in the box than this part of the largest share are left out.
constexpr double kLeastShareInside = 0.25;
constexpr double kRays = 1'600'000;  ///< of all columns together, about
constexpr int kFewestAcross = 6, kMostAcross = 200;
constexpr std::size_t kWorst = 5;

void leaveOutMargins(std::vector<ModelColumn>& columns) {
  double largest = 0;
  for (const ModelColumn& column : columns) largest = std::max(largest, column.shareInside);
  std::erase_if(columns, [&](const ModelColumn& column) {
    return !(column.shareInside > kLeastShareInside * largest);
  });
}

/// Places evenly over a cell; those within the box, in the scene.
std::vector<glm::dvec2> raysInto(const field::Grid& grid, std::uint32_t cell, int across,
                                 const base::LocalFrame& frame) {
  std::vector<glm::dvec2> rays;
  for (int i = 0; i < across * across; ++i) {
    const glm::dvec2 share = evenPlace(i);
    const auto place = field::pointIn(grid, cell, share.x, share.y);
    if (!frame.box().contains(place.longitudeDegrees, place.latitudeDegrees)) continue;
    const glm::dvec3 scene = frame.toScene(place.longitudeDegrees, place.latitudeDegrees, 0);
    rays.emplace_back(scene.x, scene.z);
  }
  return rays;
}

/// Weighted sums of a difference.
class Differences {
 public:
  void add(double scene, double model, double weight) {
    const double difference = scene - model;
    weight_ += weight;
    sum_ += weight * difference;
    squares_ += weight * difference * difference;
    ++count_;
  }
  Score score() const {
    if (!(weight_ > 0)) return {};
    return {sum_ / weight_, std::sqrt(squares_ / weight_), count_};
  }

 private:
  double weight_ = 0, sum_ = 0, squares_ = 0;
  std::size_t count_ = 0;
};

OpticalDepthScore opticalDepthScore(std::span<const ComparedColumn> columns) {
  double weight = 0, model = 0, scene = 0;
  for (const ComparedColumn& column : columns) {
    weight += column.model.squareMeters;
    model += column.model.squareMeters * column.model.view.opticalDepth;
    scene += column.model.squareMeters * column.scene.opticalDepth;
  }
  OpticalDepthScore score;
  if (!(weight > 0)) return score;
  score.modelMean = model / weight;
  score.sceneMean = scene / weight;
  // A sky that should be clear and is not is wholly wrong.
  score.biasRelative = model > 0 ? scene / model - 1 : scene > 0 ? 1 : 0;
  double mm = 0, ss = 0, ms = 0;
  for (const ComparedColumn& column : columns) {
    const double m = column.model.view.opticalDepth - score.modelMean,
                 s = column.scene.opticalDepth - score.sceneMean;
    mm += column.model.squareMeters * m * m;
    ss += column.model.squareMeters * s * s;
    ms += column.model.squareMeters * m * s;
  }
  const double least = 1e-12 * weight * score.modelMean * score.modelMean;
  if (mm > least && ss > least && columns.size() > 2) score.correlation = ms / std::sqrt(mm * ss);
  return score;
}

/// The columns with the largest differences of a measure; `values` gives (model, scene), or nothing.
template <class Values>
WorstColumns worstOf(std::span<const ComparedColumn> columns, std::string measure, Values values) {
  WorstColumns worst{std::move(measure), {}};
  for (const ComparedColumn& column : columns)
    if (const std::optional<std::pair<double, double>> pair = values(column))
      worst.columns.push_back(
          {column.model.longitudeDegrees, column.model.latitudeDegrees, pair->first, pair->second});
  std::stable_sort(worst.columns.begin(), worst.columns.end(), [](const auto& a, const auto& b) {
    return std::abs(a.scene - a.model) > std::abs(b.scene - b.model);
  });
  if (worst.columns.size() > kWorst) worst.columns.resize(kWorst);
  return worst;
}

std::optional<std::pair<double, double>> both(const std::optional<double>& model,
                                              const std::optional<double>& scene) {
  if (!model || !scene) return std::nullopt;
  return std::pair{*model, *scene};
}

void addWorst(Fidelity& fidelity) {
  const std::span<const ComparedColumn> columns(fidelity.columns);
  using Pair = std::optional<std::pair<double, double>>;
  fidelity.worst.push_back(worstOf(columns, "cover", [](const ComparedColumn& c) {
    return Pair(std::pair{c.model.view.cover, c.scene.cover});
  }));
  fidelity.worst.push_back(worstOf(columns, "optical_depth", [](const ComparedColumn& c) {
    return Pair(std::pair{c.model.view.opticalDepth, c.scene.opticalDepth});
  }));
  fidelity.worst.push_back(worstOf(columns, "base_m", [](const ComparedColumn& c) {
    return both(c.model.view.baseMeters, c.scene.baseMeters);
  }));
  fidelity.worst.push_back(worstOf(columns, "top_m", [](const ComparedColumn& c) {
    return both(c.model.view.topMeters, c.scene.topMeters);
  }));
}

class CoverDifferences {
 public:
  /// All columns, or the populated ones: what is full in one range may be broken in another.
  explicit CoverDifferences(bool populatedOnly) : populatedOnly_(populatedOnly) {}

  void add(const ComparedColumn& column) {
    add(total_, column, column.scene.cover, column.model.view.cover);
    for (std::size_t range = 0; range < kRanges; ++range)
      add(in_[range], column, column.scene.coverIn[range], column.model.view.coverIn[range]);
  }
  CoverScores score() const {
    CoverScores scores{total_.score(), {}};
    for (std::size_t range = 0; range < kRanges; ++range) scores.in[range] = in_[range].score();
    return scores;
  }

 private:
  void add(Differences& differences, const ComparedColumn& column, double scene, double model) const {
    if (!populatedOnly_ || column.isPopulated(model))
      differences.add(scene, model, column.model.squareMeters);
  }

  bool populatedOnly_;
  Differences total_;
  std::array<Differences, kRanges> in_;
};

void countClouds(const WrittenScene& scene, const base::LocalFrame& frame, const field::Grid& grid,
                 std::vector<ComparedColumn>& columns) {
  std::map<std::uint32_t, std::size_t> clouds;
  const field::CellFinder finder(grid);
  for (const WrittenCloud& cloud : scene.clouds) {
    const glm::dvec3 place = frame.toGeographic(glm::dvec3(cloud.foot));
    if (const auto cell = finder.at({place.x, place.y})) ++clouds[*cell];
  }
  for (ComparedColumn& column : columns)
    if (const auto found = clouds.find(column.model.cell); found != clouds.end())
      column.clouds = found->second;
}

void score(Fidelity& fidelity, const Tolerances& tolerances) {
  CoverDifferences cover(false), populated(true);
  Differences base, top, thickness;
  for (const ComparedColumn& column : fidelity.columns) {
    const ColumnView& model = column.model.view;
    const double weight = column.model.squareMeters;
    cover.add(column);
    populated.add(column);
    if (model.baseMeters && column.scene.baseMeters) {
      base.add(*column.scene.baseMeters, *model.baseMeters, weight);
      thickness.add(column.model.levelMeters, 0, weight);
    }
    if (model.topMeters && column.scene.topMeters) top.add(*column.scene.topMeters, *model.topMeters, weight);
  }
  fidelity.cover = cover.score();
  fidelity.base = base.score();
  fidelity.top = top.score();
  fidelity.populatedCover = populated.score();
  fidelity.opticalDepth = opticalDepthScore(fidelity.columns);
  fidelity.heightTolerance = std::max(tolerances.heightRmseMeters, 0.5 * thickness.score().bias);
}

void judge(Fidelity& fidelity, const Tolerances& tolerances) {
  const auto atMost = [&](const std::string& measure, double value, double tolerated) {
    if (!(std::abs(value) <= tolerated)) fidelity.breaches.push_back({measure, value, tolerated});
  };
  const auto atLeast = [&](const std::string& measure, const std::optional<double>& value, double tolerated) {
    if (value && !(*value >= tolerated)) fidelity.breaches.push_back({measure, *value, tolerated});
  };
  const auto judgeCover = [&](const std::string& name, const CoverScores& cover, std::optional<double> bias,
                              double rmse) {
    constexpr std::array<const char*, kRanges> kNames{"low", "middle", "high"};
    const auto judgeOne = [&](const std::string& measure, const Score& score) {
      if (bias) atMost(measure + ".bias", score.bias, *bias);
      atMost(measure + ".rmse", score.rmse, rmse);
    };
    judgeOne(name + ".total", cover.total);
    for (std::size_t range = 0; range < kRanges; ++range)
      judgeOne(fmt::format("{}.{}", name, kNames[range]), cover.in[range]);
  };
  judgeCover("cover", fidelity.cover, tolerances.coverBias, tolerances.coverRmse);
  // A full sheet can only lack cover: its errors have one sign, and their mean says no more than they do.
  judgeCover("cover.populated", fidelity.populatedCover, std::nullopt, tolerances.populatedCoverRmse);
  atMost("optical_depth.bias_relative", fidelity.opticalDepth.biasRelative, tolerances.opticalDepthBias);
  atLeast("optical_depth.correlation", fidelity.opticalDepth.correlation, tolerances.opticalDepthCorrelation);
  atMost("base_m.rmse", fidelity.base.rmse, fidelity.heightTolerance);
  atMost("top_m.rmse", fidelity.top.rmse, fidelity.heightTolerance);
  for (const SlantedView& view : fidelity.slants.slanted) {
    const SlantedView& vertical = fidelity.slants.vertical;
    if (!fidelity.slants.volumes || !(vertical.opticalDepth > 0)) continue;
    const std::string name = fmt::format("slanted.{:.0f}", view.zenithDegrees);
    const double chance = 3 * std::hypot(view.opticalDepthError, vertical.opticalDepthError);
    atMost(name + ".optical_depth", view.opticalDepth / vertical.opticalDepth - 1,
           tolerances.slantedOpticalDepth + chance / vertical.opticalDepth);
    atLeast(name + ".cover_gain", view.cover - vertical.cover, -tolerances.slantedCover);
  }
  atLeast("genus.agreement", fidelity.genus.agreement(), tolerances.genusAgreement);
}

}  // namespace

Fidelity compareWithModel(const WrittenScene& scene, const base::LocalFrame& frame,
                          const field::Source& model, const field::Source* typing,
                          const Tolerances& tolerances, const base::Progress& progress) {
  Fidelity fidelity;
  fidelity.file = scene.file;
  fidelity.format = scene.format;
  fidelity.saturated = scene.saturated;
  progress.step("verify: model", 0);
  auto columns = modelColumns(model, frame.box());
  leaveOutMargins(columns);
  if (columns.empty())
    throw base::InputError(model.info().files.empty() ? "input" : model.info().files.front(),
                           "has no column in the box of the scene", "name the input that it was made from");
  fidelity.raysAcross = std::clamp(
      static_cast<int>(
          std::lround(std::sqrt(kRays / static_cast<double>(std::max<std::size_t>(1, columns.size()))))),
      kFewestAcross, kMostAcross);

  progress.step("verify: look", 0.3);
  const std::vector<Footprint> footprints = footprintsOf(scene.blobs, scene.pivots, View{});
  fidelity.footprints = footprints.size();
  const Imager imager(footprints);
  fidelity.columns.resize(columns.size());
  // A map projection serves one thread at a time: rays are placed here, batch by batch, and followed in
  // parallel.
  constexpr std::size_t kBatch = 256;
  for (std::size_t first = 0; first < columns.size(); first += kBatch) {
    progress.step("verify: look",
                  0.3 + 0.7 * static_cast<double>(first) / static_cast<double>(columns.size()));
    const std::size_t count = std::min(kBatch, columns.size() - first);
    std::vector<std::vector<glm::dvec2>> rays(count);
    for (std::size_t i = 0; i < count; ++i)
      rays[i] = raysInto(model.grid(), columns[first + i].cell, fidelity.raysAcross, frame);
    base::parallelFor(count, [&](std::size_t i) {
      fidelity.columns[first + i] = {columns[first + i], imager.look(rays[i], columns[first + i]), 0};
    });
  }
  fidelity.slants = lookAslant(scene, frame, progress);
  fidelity.skyReports = lookUp(scene, frame, columns, progress);
  const field::Source* const stating = typing                                      ? typing
                                       : model.telling() == field::Telling::Layers ? &model
                                                                                   : nullptr;
  if (stating) fidelity.genus = genusScore(scene.clouds, frame, *stating);
  countClouds(scene, frame, model.grid(), fidelity.columns);
  score(fidelity, tolerances);
  addWorst(fidelity);
  judge(fidelity, tolerances);
  progress.step("verify", 1);
  return fidelity;
}

}  // namespace cloudgen::check
