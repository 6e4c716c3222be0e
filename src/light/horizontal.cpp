// SPDX-License-Identifier: Apache-2.0
#include "light/horizontal.hpp"

#include <libnova/precession.h>
#include <libnova/transform.h>

#include <cmath>

namespace cloudgen::light {

Horizontal horizontalOf(double rightAscension, double declination, double julianDay, double longitudeDegrees,
                        double latitudeDegrees) {
  ln_lnlat_posn observer{longitudeDegrees, latitudeDegrees};
  ln_equ_posn atJ2000{rightAscension, declination}, equatorial{};
  ln_hrz_posn horizontal{};
  // The sky turns about today's pole (50 arc seconds a year).
  ln_get_equ_prec(&atJ2000, julianDay, &equatorial);
  ln_get_hrz_from_equ(&equatorial, &observer, julianDay, &horizontal);
  // libnova counts azimuth from the south, westwards.
  return {std::fmod(horizontal.az + 180.0, 360.0), horizontal.alt};
}

}  // namespace cloudgen::light
