// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/frame.hpp"
#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/interpolation.hpp"

namespace cloudgen::pipeline {

/// A cloud that a layer may have.
struct Candidate {
  field::GeoPoint place;
  glm::dvec2 scenePlace{0};  ///< x and z
  std::uint32_t number = 0;  ///< within its layer; part of every random address
  double rank = 0;           ///< those of low rank come first
  float baseMeters = 0, depthMeters = 0, widthMeters = 0;
  float opticalDepth = 0;  ///< in cloud, at its place
  int yawStep = 0;
};

/// What all candidates are made with.
struct CandidateContext {
  const field::Grid& grid;
  const base::LocalFrame& frame;
  const Options& options;
  const Generalisation& general;
  const LayersByCell& layersByCell;
};

/// What a layer may have.
struct Candidates {
  std::vector<Candidate> list;       ///< best first
  std::size_t elements = 0;          ///< of them, those that would cover the whole cell
  bool everyCell = true;             ///< false where a cloud covers more than a cell: some have none
  std::optional<Candidate> outside;  ///< one that would stand outside the box, if there are no others
  std::uint32_t nextNumber = 0;      ///< that none of them has
};

/// All places inside the box where a cloud of a layer may stand: a jittered lattice over its
/// cell, ranked by a noise that knows no cells and by the cover, which passes smoothly into the neighbours'.
/// About three times as many as the layer needs; elements of a sheet, as many as would cover the whole cell.
/// Where a cell is smaller than what a cloud covers it has one now and then.
Candidates candidatesOf(const CandidateContext& context, const field::Layer& layer);

/// Moves a candidate. False, and nothing done, where the place lies outside the box.
bool moveTo(const CandidateContext& context, const field::Layer& layer, const glm::dvec2& scenePlace,
            Candidate& candidate);

/// The nearest of the candidates of a layer once more, at another place, under the next number. Nothing where
/// the place lies outside the box, or where the layer can have no cloud.
std::optional<Candidate> candidateAt(const CandidateContext& context, const field::Layer& layer,
                                     Candidates& candidates, const glm::dvec2& scenePlace);

}  // namespace cloudgen::pipeline
