// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/progress.hpp"
#include "field/cloud_table.hpp"
#include "field/grid.hpp"
#include "pipeline/generalisation.hpp"
#include "pipeline/origin.hpp"
#include "scene/scene.hpp"

namespace cloudgen::pipeline {

/// Step 6: makes the scene. Clouds of one genus whose aspect, optical depth, shear and variant fall into the
/// same class share an archetype; an instance's scale and optical-depth factor make its depth and its optical
/// depth exact. Elements are turned into the wind where the recipe says so; wind shear tilts heaps and
/// towers.
scene::Scene produce(const field::CloudTable& table, const Origin& origin, const Options& options,
                     const Generalisation& general, base::UtcTime validTime, const base::Progress& progress);

}  // namespace cloudgen::pipeline
