// SPDX-License-Identifier: Apache-2.0
#pragma once

/// GLSL ES 3.00. What is `common` comes before both stages of every program.
namespace cloudgen::runtime::gles::shader {

/// Sky, haze and the camera.
extern const char* const kCommon;
/// A quad a puff: an ellipse of its Gaussian as the eye sees it, and in it a sprite that the six light maps shade.
extern const char* const kPuffVertex;
extern const char* const kPuffFragment;
/// A cloud as a picture of it.
extern const char* const kImpostorVertex;
extern const char* const kImpostorFragment;
/// A cloud as a volume: rays are marched through its grid.
extern const char* const kVolumeVertex;
extern const char* const kVolumeFragment;
/// One triangle over the whole picture.
extern const char* const kPictureVertex;
/// Sky and ground with the clouds' shadows.
extern const char* const kBackdropFragment;
/// The clouds before those, the sun's glare (SUN_IN_VIEW), and the tone curve of a photograph.
extern const char* const kPictureFragment;
/// A puff's optical depth as it is thrown on the ground along the sun.
extern const char* const kShadowVertex;
extern const char* const kShadowFragment;

}  // namespace cloudgen::runtime::gles::shader
