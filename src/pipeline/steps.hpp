// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "field/cloud_columns.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/origin.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/surroundings.hpp"

namespace cloudgen::pipeline {

/// A build after steps 1 to 3: what there is, before a cloud is placed.
struct Located {
  field::Grid grid;  ///< whose cells the clouds stand in
  Origin origin;
  field::CloudTable table;
  std::vector<Surroundings> surroundings;
  Outcome outcome;
  double typedShare = 1;  ///< of the box, with a typing
  field::Grid windGrid;   ///< whose cells the winds are in
  std::vector<field::WindAloft> winds;
};

/// Origin, location and type.
Located locate(const field::Source& source, const Options& options, const base::Progress& progress);

/// Production, once the clouds of the table are placed: the scene and what is said about it.
Outcome finish(Located&& located, const field::Source& source, const Generalisation& general, const Options& options,
               const base::Progress& progress);

}  // namespace cloudgen::pipeline
