// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace cloudgen::input::grib {

/// The 2 n latitudes of a Gaussian grid in degrees, from the north: the zeros of the Legendre polynomial of
/// degree 2 n in the sine of latitude (Newton's iteration; Abramowitz & Stegun 22.16.6 for the start).
std::vector<double> gaussianLatitudes(int n);

}  // namespace cloudgen::input::grib
