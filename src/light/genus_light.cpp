// SPDX-License-Identifier: Apache-2.0
#include "light/genus_light.hpp"

#include "light/optics.hpp"

namespace cloudgen::light {

using base::Genus;

float shadingOf(Genus genus) {
  if (genus == Genus::Cirrocumulus) return 0.05f;
  if (genus == Genus::Cirrus || genus == Genus::Cirrostratus) return 0.2f;
  if (genus == Genus::Altocumulus) return 0.7f;
  if (genus == Genus::Stratocumulus) return 0.85f;
  return 1.0f;
}

float asymmetryOf(Genus genus) {
  const bool ice = genus == Genus::Cirrus || genus == Genus::Cirrocumulus || genus == Genus::Cirrostratus;
  return ice ? kIceAsymmetry : kWaterAsymmetry;
}

double lightHeightOf(Genus genus) {
  if (genus == Genus::Cirrus || genus == Genus::Cirrocumulus || genus == Genus::Cirrostratus) return 9000;
  if (genus == Genus::Cumulonimbus) return 8000;
  if (genus == Genus::Altocumulus || genus == Genus::Altostratus) return 4500;
  return 1000;
}

}  // namespace cloudgen::light
