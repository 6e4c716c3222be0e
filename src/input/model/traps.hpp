// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "input/model/choice.hpp"

namespace cloudgen::input::model {

/// What the cover fields of a choice really hold. Reads them until a value tells.
struct CoverScale {
  bool perCent = false;
  double greatest = 0;
  std::vector<field::Warning> warnings;
};

/// Some models write cover as 0..1 under a parameter that is defined in per cent, others the reverse: no
/// value over 1.01 means 0..1, a value over 2 means per cent. Warns where the values belie the stated unit,
/// and where they pass 1 (AROME reaches 100.009 %).
CoverScale coverScale(const std::vector<const Field*>& covers, const field::Grid& grid);

/// What a grid has about it that has misled programs before: the antimeridian or a pole inside a regional
/// domain, a sphere unlike that of other models.
std::vector<field::Warning> gridWarnings(const field::Grid& grid);

}  // namespace cloudgen::input::model
