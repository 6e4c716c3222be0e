// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "unit/check/made_model.hpp"

namespace cloudgen::check::test {

/// The blobs and clouds of a made sky as the bytes of a file: cards as scene.x3d and scene.glb, volumes as
/// scene.splats.glb. Blob i is that of cloud i; a genus has one opacity, that of its first cloud.
std::string x3dOf(const WrittenScene& scene);
std::string glbOf(const WrittenScene& scene);
std::string splatsOf(const WrittenScene& scene);

}  // namespace cloudgen::check::test
