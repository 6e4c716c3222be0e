// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "check/fidelity/fidelity.hpp"

namespace cloudgen::check {

/// Compares the genera of clouds with what a source of layers states where they stand: with the layer whose
/// base is nearest to their foot, or any of those within 50 m of it. Where one of these has no genus the
/// cloud is not counted.
GenusScore genusScore(std::span<const WrittenCloud> clouds, const base::LocalFrame& frame,
                      const field::Source& stating);

}  // namespace cloudgen::check
