// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::light {

/// Where something in the sky stands. Azimuth clockwise from north; refraction not included.
struct Horizontal {
  double azimuthDegrees = 0, elevationDegrees = 0;
};

/// Of a right ascension and declination of the equinox J2000, in degrees, as seen from the Earth's middle over a place.
Horizontal horizontalOf(double rightAscension, double declination, double julianDay, double longitudeDegrees,
                        double latitudeDegrees);

}  // namespace cloudgen::light
