// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/genus.hpp"

namespace cloudgen::light {

/// Relief that clouds of a genus show, 0..1 (shadePuffs): cirrocumulus no shading at all, cirrus and cirrostratus next
/// to none (WMO atlas). The small elements of altocumulus and the rolls of stratocumulus light each other, which their
/// archetype does not know.
float shadingOf(base::Genus genus);

/// Asymmetry of what a genus is made of: ice scatters less sharply forward than droplets do.
float asymmetryOf(base::Genus genus);

/// Where clouds of a genus see the sun from, metres: the middles of the etages of the WMO, and the tops of
/// cumulonimbus, which are all that a low sun reaches. High clouds glow when it has set for low ones.
double lightHeightOf(base::Genus genus);

}  // namespace cloudgen::light
