// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "image/preview.hpp"
#include "image/view.hpp"

namespace cloudgen::cli {

/// A written sky as the renderer takes it.
struct WrittenSky {
  std::vector<image::Splat> splats;
  image::Surroundings surroundings;
};

/// From scene.splats.glb, as viewers draw it.
WrittenSky readSplatSky(const std::filesystem::path& file);

/// The sky of a folder that moves: its pack, on the terrain of its splats where they are.
class MovingSkyFile {
 public:
  /// Throws InputError where the folder has no sound scene.cgpack.
  explicit MovingSkyFile(const std::filesystem::path& folder);
  ~MovingSkyFile();

  base::UtcTime first() const;
  base::UtcTime last() const;
  /// The clouds at a time, under the sun of that time. Times before the first and after the last are taken there.
  WrittenSky at(base::UtcTime time);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// "top", "ground", "horizon" or "lon,lat,height:lon,lat,height"; `report` is the scene's, or empty for a file without
/// one. Sets the height of the ground, too. Throws UsageError, InputError.
image::Camera cameraFrom(const std::string& view, const std::pair<int, int>& size, const std::filesystem::path& report,
                         WrittenSky& sky);

/// "960x540": width and height in pixels. Throws UsageError.
std::pair<int, int> sizeFromText(const std::string& text);

}  // namespace cloudgen::cli
