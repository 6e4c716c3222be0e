// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::light {

/// Asymmetry parameters and single-scattering albedos of the visible: droplets of 10 um radius (Slingo 1989,
/// the band below 0.69 um) and ice crystals (Fu 1996, effective size 50 um). What a cloud absorbs of visible
/// light is under a hundred-thousandth a scattering, so it is counted as nothing.
inline constexpr float kWaterAsymmetry = 0.86f, kIceAsymmetry = 0.77f;
inline constexpr float kSingleScatteringAlbedo = 1.0f;

/// Henyey & Greenstein 1941, per steradian: `cosine` of the angle of deflection, asymmetry -1 < g < 1.
double henyeyGreenstein(double cosine, double asymmetry);

/// Draine 2003, per steradian: Henyey-Greenstein times 1 + alpha cosine^2, normalised.
double draine(double cosine, double g, double alpha);

/// Mean cosine of Draine's function.
double draineAsymmetry(double g, double alpha);

/// Jendersie & d'Eon 2023, "An approximate Mie scattering function for fog and cloud rendering": a blend of
/// Henyey-Greenstein (the diffraction peak) and Draine.
struct DropletPhase {
  double peakG = 0, draineG = 0, draineAlpha = 0, draineShare = 0;
};

/// The fit for droplets of a diameter of 5..50 um; diameters outside are held at the ends.
DropletPhase dropletPhase(double diameterMicrometers);

/// Its value per steradian, and its mean cosine.
double phase(const DropletPhase& droplets, double cosine);
double asymmetry(const DropletPhase& droplets);

}  // namespace cloudgen::light
