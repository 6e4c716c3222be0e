// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::light {

/// Asymmetry parameters of the visible. Droplets of an effective radius of 10 um: Slingo 1989, band 0.25 to
/// 0.69 um, g = 0.829 + 0.002482 r. Ice crystals of a generalised effective size of 50 um: Fu 1996, equation
/// 3.9c, band 0.2 to 0.7 um, g = 0.74813 + 9.568e-4 D - 1.115e-6 D^2 - 8.156e-9 D^3. By the same papers a
/// scattering absorbs 1.6 and 5 millionths of visible light, which is counted as nothing.
inline constexpr float kWaterAsymmetry = 0.854f, kIceAsymmetry = 0.792f;
inline constexpr float kSingleScatteringAlbedo = 1.0f;

/// Henyey & Greenstein 1941, per steradian: `cosine` of the angle of deflection, asymmetry -1 < g < 1.
double henyeyGreenstein(double cosine, double asymmetry);

/// Light that a thin cloud scatters once, beside what it sends square to the beam: `even + towards * (1/4 +
/// 1/2 cosine)` of the angle between the line of sight and the direction to the sun. The line that Gaussian
/// splats can hold (their harmonics of degree 1) through Henyey-Greenstein's values at 90 and 180 degrees; the
/// glare about the sun is more than it. {1, 0} is the same to all sides.
struct ScatteredOnce {
  float even = 1, towards = 0;
};
ScatteredOnce scatteredOnce(double asymmetry);

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
