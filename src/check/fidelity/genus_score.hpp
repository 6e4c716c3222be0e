// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "check/fidelity/fidelity.hpp"

namespace cloudgen::check {

/// Compares the genera of clouds with what a source of layers states where they stand.
GenusScore genusScore(std::span<const WrittenCloud> clouds, const base::LocalFrame& frame,
                      const field::Source& stating);

}  // namespace cloudgen::check
