// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "base/genus.hpp"
#include "shape/placement.hpp"

namespace cloudgen::shape {

/// How the sections of a cloud are filled.
enum class Form {
  Heap,       ///< lobes on lobes over a flat base: cumulus
  Tower,      ///< a heap drawn up, with anvil and precipitation: cumulonimbus
  Cells,      ///< a field of rounded elements: stratocumulus, altocumulus, cirrocumulus
  Veil,       ///< a continuous layer: stratus, altostratus, cirrostratus, nimbostratus, fog
  Filaments,  ///< threads and hooks bent by shear: cirrus
  File        ///< a mesh, a grammar or a volume from a file
};

struct FileShape;

struct Range {
  float low = 0, high = 0;
};

/// What a cloud type is made of: a file of templates/types/. Lengths in metres; shares are of the cloud's
/// width unless said.
struct Recipe {
  base::Genus genus{};
  Form form = Form::Heap;
  // Form::File alone.
  std::string shapeFile;      ///< path; in the text of a recipe relative to it
  std::string shapeVariable;  ///< of a file with several; empty: the one that is cloud water or density
  bool zUp = false;           ///< which axis of the file is up: y, or z
  bool flatBase = false;      ///< cut off at a condensation level
  std::shared_ptr<const FileShape> fileShape;  ///< the file as opened; recipeFromJson leaves it empty
  // Sections: the parts of a cloud (lobes, cells, threads).
  Placement sectionPlacement;  ///< radius and height are shares of half the width and of the depth
  int sections = 1;
  float sectionRadius = 0.2f;  ///< share of the width (cells and filaments: of the distance to the next)
  // Billboards: the puffs of a section.
  Placement billboardPlacement;
  int billboards = 8;           ///< at the coarsest level, a section
  float billboardSize = 0.28f;  ///< standard deviation as a share of the section radius
  float flattening = 1;         ///< vertical over horizontal deviation of a billboard; of a veil at most
  // The cloud.
  Range widthMeters, thicknessMeters;
  float opticalDepth = 10;  ///< typical, vertical
  bool sheet = false;       ///< covers by overlapping elements that fade out, not by separate clouds
  float fibre = 0;          ///< 0 smooth .. 1 strongly drawn out along the wind
  float raggedness = 0.3f;  ///< wisps and scud about the edges, 0..1
  float precipitation = 0;  ///< optical depth of the shaft below the base, as a share of the cloud's
  bool alongWind = false;   ///< elements are turned into the wind
  float waves = 0;          ///< cells: 0 in no order .. 1 ranked in rolls across the wind
  float turrets = 0;        ///< cells: share of them that tower over the others (castellanus)
  float streets = 0;        ///< length of cloud streets along the wind, in clouds; 0: none
};

/// Reads a recipe from the text of its JSON file, checked against schemas/recipe.schema.json by the caller.
/// `where` names the file in messages. Throws InputError.
Recipe recipeFromJson(const std::string& json, const std::string& where);

}  // namespace cloudgen::shape
