// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "field/source.hpp"
#include "pipeline/layer_record.hpp"
#include "pipeline/options.hpp"
#include "pipeline/pairing.hpp"
#include "scene/scene.hpp"

namespace cloudgen::pipeline {

/// What a build read, decided and made; with it the report is written.
struct Outcome {
  scene::Scene scene;
  std::uint64_t columns = 0, cells = 0, layers = 0, patches = 0;
  double enlargement = 1;
  /// ISCCP class, genus, layers: the second opinion on the types.
  std::map<std::string_view, std::map<base::Genus, std::uint64_t>> isccp;
  std::vector<LayerRecord> cloudyLayers;  ///< those that have clouds
  std::optional<Pairing> pairing;         ///< with a typing
  std::vector<std::pair<std::string, std::string>>
      derived;  ///< what was not in the input, and how it was made
  std::vector<std::string> warnings;
};

/// The six steps, from a source to a scene. Throws InputError (no cloud fields, box outside) and
/// InterruptedError.
Outcome run(const field::Source& source, const Options& options, const base::Progress& progress);

}  // namespace cloudgen::pipeline
