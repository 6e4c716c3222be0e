// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/frame.hpp"
#include "base/progress.hpp"
#include "check/fidelity/model_columns.hpp"
#include "check/fidelity/sky_camera.hpp"
#include "check/fidelity/slants.hpp"
#include "check/fidelity/written_scene.hpp"

namespace cloudgen::check {

/// How far the sky may be from the model. Heights: the larger of heightRmseMeters and half the mean thickness
/// of the model's cells.
struct Tolerances {
  double coverBias = 0.01, coverRmse = 0.10, populatedCoverRmse = 0.05;
  double opticalDepthBias = 0.02, opticalDepthCorrelation = 0.98;
  double heightRmseMeters = 150;
  /// Of scenes of volumes: how far the optical depth of slanted rays may be from that of vertical ones, for
  /// the same height and beside three standard errors, and how much less their cover may be.
  double slantedOpticalDepth = 0.05, slantedCover = 0.02;
  double genusAgreement = 1;
};

/// Scene minus model, columns weighted by their area.
struct Score {
  double bias = 0, rmse = 0;
  std::size_t columns = 0;  ///< that were compared
};

struct CoverScores {
  Score total;
  std::array<Score, kRanges> in;
};

/// A column is populated when the file names so many clouds that stand in it, or when its cover is that of a
/// full sheet: what is left to chance in it is small.
inline constexpr std::size_t kPopulatedClouds = 100;
inline constexpr double kFullSheet = 0.985;

struct OpticalDepthScore {
  double modelMean = 0, sceneMean = 0, biasRelative = 0;
  /// Nothing where either does not vary.
  std::optional<double> correlation;
};

/// Clouds that stand where the input (or its typing) states a genus, and whose genus is that of the stated
/// layer nearest to their foot, by their record and by their sprites.
struct GenusScore {
  std::size_t clouds = 0, agreeing = 0;
  std::optional<double> agreement() const {
    if (clouds == 0) return std::nullopt;
    return static_cast<double>(agreeing) / static_cast<double>(clouds);
  }
};

struct ComparedColumn {
  ModelColumn model;
  ColumnView scene;
  std::size_t clouds = 0;  ///< that the scene names and whose foot stands in it

  /// In a range, or in all together, by the model's cover there.
  bool isPopulated(double modelCover) const { return clouds >= kPopulatedClouds || modelCover >= kFullSheet; }
};

/// A column that is further off than the others.
struct WorstColumn {
  double longitudeDegrees = 0, latitudeDegrees = 0, model = 0, scene = 0;
};

struct WorstColumns {
  std::string measure;  ///< "cover", "optical_depth", "base_m", "top_m"
  std::vector<WorstColumn> columns;
};

/// A tolerance that is broken: "cover.low.rmse is 0.132, tolerated 0.1".
struct Breach {
  std::string measure;
  double value = 0, tolerated = 0;
};

struct Fidelity {
  std::string file, format;
  std::size_t footprints = 0;
  std::uint64_t saturated = 0;
  int raysAcross = 0;  ///< a column is looked at by the square of it, less where it leaves the box
  std::vector<ComparedColumn> columns;
  CoverScores cover;
  CoverScores populatedCover;  ///< over the populated columns
  Score base, top;
  OpticalDepthScore opticalDepth;
  GenusScore genus;
  Slants slants;
  std::vector<SkyReport> skyReports;
  double heightTolerance = 150;
  std::vector<WorstColumns> worst;
  std::vector<Breach> breaches;
};

/// Compares a written scene, standing in the frame, with its model, column by column. Columns that the box
/// cuts to under a quarter of what it holds of others are left out. Types are compared with the typing, if
/// there is one, else with a source that states its layers. Throws InputError if the model has no column in
/// the frame's box.
Fidelity compareWithModel(const WrittenScene& scene, const base::LocalFrame& frame,
                          const field::Source& model, const field::Source* typing,
                          const Tolerances& tolerances, const base::Progress& progress);

}  // namespace cloudgen::check
