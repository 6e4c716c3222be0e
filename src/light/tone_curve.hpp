// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::light {

/// Irradiance of the sun and of the ground on a white surface, as radiances: sunlight of colour 1 and
/// Sky::bounce of 1.
inline constexpr float kSun = 0.92f, kGround = 0.75f;
/// And of an even sky, Sky::ambient of 1: a seventh of what the high sun gives. The sky is shown brighter
/// than that (an eye gets used to it), the more the lower the sun, whose light it then must not drown: from one to the
/// other with the luminance of the sun's colour.
inline constexpr float kSkyAtNoon = 0.45f, kSkyWithoutSun = 0.16f;

/// What a thick cloud's bright faces answer. Those of thinner ones are shown brighter, as the sky behind them
/// is, but by no more than this; what comes out below is not.
inline constexpr float kFace = 0.8f, kBrighter = 1.9f;
/// Level tops take a slanting sun by the sine of its height; they reflect more of it then than of a high one,
/// and an eye that looks down on a deck gets used to the rest, down to this sine.
inline constexpr float kLift = 0.9f, kLowest = 0.3f;
/// Undersides of thick clouds beside faces that a camera is set for.
inline constexpr float kBelow = 0.6f;

/// A white face in sun and sky is exposed to this luminance, but by no more than three stops over noon.
inline constexpr float kWhite = 1.38f, kMostExposure = 9.0f;

/// A photograph's contrast: darks go darker about the tone of a bright face, and highlights above the knee are
/// rolled off towards 1, so that relief on the sunlit side stays visible.
inline constexpr float kContrast = 1.8f, kKnee = 0.8f, kRoom = 1.08f - kKnee;

/// Mean answers of what is seen of a cloud to sun, sky and ground.
inline constexpr float kMeanSun = 0.75f, kMeanSky = 0.8f, kMeanGround = 0.3f;

/// Puffs behind an optical depth of 9 on the clearest side are hidden, before one of 5 seen.
inline constexpr float kHidden = 2e-5f, kSeen = 1e-3f;

/// What a puff answers to a sun of colour 1 where a cloud shows no relief, above and below, and the most that it may.
inline constexpr float kFlatSun = 0.9f, kFlatBelow = 0.4f, kMostSun = 1.15f;
/// The same of the sky and the ground.
inline constexpr float kFlatSky = 1.0f, kFlatGround = 0.5f;
/// The most that the beam's way through adds towards the sun, of its colour, and all that adds.
inline constexpr float kForward = 0.24f, kMostForward = 0.95f;

}  // namespace cloudgen::light
