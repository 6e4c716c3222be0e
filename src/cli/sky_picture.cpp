// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_picture.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/frame.hpp"
#include "base/text.hpp"
#include "check/gltf/read_splats.hpp"
#include "light/color.hpp"
#include "runtime/placed_puffs.hpp"

namespace cloudgen::cli {
namespace {

/// "lon,lat,height:lon,lat,height" in the scene frame.
void aim(image::Camera& camera, const std::string& text, const std::filesystem::path& report) {
  const auto points = base::split(text, ':');
  double values[2][3];
  bool read = points.size() == 2;
  for (std::size_t i = 0; read && i < 2; ++i) {
    const auto numbers = base::split(points[i], ',');
    read = numbers.size() == 3;
    for (std::size_t k = 0; read && k < 3; ++k) read = base::parseNumber(numbers[k], values[i][k]);
  }
  if (!read)
    throw base::UsageError("--view " + text, "is not a known view",
                           "use top, ground, horizon or EYE:TARGET as lon,lat,height:lon,lat,height");
  if (report.empty())
    throw base::UsageError("--view " + text, "needs the folder of the scene, to know where it lies",
                           "name the folder instead of the file");
  const auto box = nlohmann::json::parse(base::readFile(report)).at("bbox");
  const base::LocalFrame frame({box.at(0), box.at(1), box.at(2), box.at(3)});
  camera.eye = frame.toScene(values[0][0], values[0][1], values[0][2]);
  camera.target = frame.toScene(values[1][0], values[1][1], values[1][2]);
}

glm::vec3 vec3(const runtime::Vec3& v) { return {v.x, v.y, v.z}; }

/// Light as writers give it to viewers: the colour plus what is added towards the sun, as harmonics of degree 0 and 1.
image::Splat splatOf(const runtime::PlacedPuff& puff) {
  const glm::vec3 base = vec3(puff.color),
                  lining = light::srgbFromLinear(light::linearFromSrgb(base) + vec3(puff.forward)) - base;
  return {vec3(puff.center),
          vec3(puff.sigma),
          glm::normalize(glm::quat(puff.rotation[3], puff.rotation[0], puff.rotation[1], puff.rotation[2])),
          -std::expm1(-puff.opticalDepth),
          base + 0.25f * lining,
          0.5f * lining};
}

}  // namespace

std::pair<int, int> sizeFromText(const std::string& text) {
  const auto parts = base::split(text, 'x');
  double width = 0, height = 0;
  if (parts.size() != 2 || !base::parseNumber(parts[0], width) || !base::parseNumber(parts[1], height) ||
      width < 16 || height < 16 || width > 16384 || height > 16384)
    throw base::UsageError("--size " + text, "is not WIDTHxHEIGHT with sides of 16 to 16384 pixels",
                           "as in --size 1280x720");
  return {static_cast<int>(width), static_cast<int>(height)};
}

WrittenSky readSplatSky(const std::filesystem::path& path) {
  constexpr float kHarmonic1 = 0.4886025119029199f;
  const check::SplatFile file = check::readSplats(path);
  WrittenSky sky;
  sky.surroundings.sun = light::sunFrom(file.sunAzimuthDegrees, file.sunElevationDegrees);
  sky.surroundings.sky = light::skyUnder(sky.surroundings.sun, file.moonlight);
  sky.surroundings.terrain = file.terrain;
  const glm::vec3& sun = sky.surroundings.sun.direction;
  for (const check::ReadSplat& read : file.splats) {
    // The harmonics of degree 1 hold what is added towards the sun.
    const glm::vec3 towardsSun =
        kHarmonic1 * (-sun.y * read.harmonics[0] + sun.z * read.harmonics[1] - sun.x * read.harmonics[2]);
    sky.splats.push_back({read.center, read.sigma, read.rotation, read.opacity, read.color, towardsSun});
  }
  return sky;
}

struct MovingSkyFile::State {
  runtime::Runtime runtime;
  base::HeightField terrain;
  float groundMeters = 0;
  double longitudeDegrees = 0, latitudeDegrees = 0;
  base::UtcTime first;
  double seconds = 0;
};

MovingSkyFile::MovingSkyFile(const std::filesystem::path& folder) : state_(std::make_unique<State>()) {
  const auto file = folder / "scene.cgpack", splats = folder / "scene.splats.glb";
  if (!std::filesystem::exists(file))
    throw base::InputError(folder.string(), "has no scene.cgpack, which alone holds what moves",
                           "build it with --time all and pack among --formats");
  if (const runtime::Status opened = state_->runtime.open(file.c_str()); !opened)
    throw base::InputError(file.string(), opened.problem, "cloudgen validate says more; build it again");
  const pack::RuntimePack& root = state_->runtime.pack().root();
  const auto time = root.provenance() && root.provenance()->valid_time()
                        ? base::utcFromIso(root.provenance()->valid_time()->str())
                        : std::nullopt;
  if (!root.frame() || !time)
    throw base::InputError(file.string(), "does not say where and when it is", "build it again");
  const base::GeoBox box{root.frame()->west(), root.frame()->south(), root.frame()->east(), root.frame()->north()};
  state_->longitudeDegrees = box.centerLongitude(), state_->latitudeDegrees = box.centerLatitude();
  state_->groundMeters = root.frame()->ground_meters();
  state_->first = *time;
  const runtime::Timeline timeline(state_->runtime.pack());
  state_->seconds = timeline.lastSeconds();
  if (std::filesystem::exists(splats)) state_->terrain = check::readSplats(splats).terrain;
}

MovingSkyFile::~MovingSkyFile() = default;

base::UtcTime MovingSkyFile::first() const { return state_->first; }

base::UtcTime MovingSkyFile::last() const {
  return {state_->first.seconds + static_cast<std::int64_t>(std::lround(state_->seconds))};
}

WrittenSky MovingSkyFile::at(base::UtcTime time) {
  WrittenSky sky;
  sky.surroundings.sun = light::sunAt(time, state_->longitudeDegrees, state_->latitudeDegrees);
  sky.surroundings.sky = light::skyUnder(sky.surroundings.sun);
  sky.surroundings.terrain = state_->terrain;
  sky.surroundings.groundHeightMeters = state_->groundMeters;
  state_->runtime.setSun({static_cast<float>(sky.surroundings.sun.azimuthDegrees),
                          static_cast<float>(sky.surroundings.sun.elevationDegrees)});
  const auto puffs = runtime::placedPuffs(state_->runtime, static_cast<double>(time.seconds - state_->first.seconds));
  sky.splats.reserve(puffs.size());
  for (const runtime::PlacedPuff& puff : puffs) sky.splats.push_back(splatOf(puff));
  return sky;
}

image::Camera cameraFrom(const std::string& view, const std::pair<int, int>& size, const std::filesystem::path& report,
                         WrittenSky& sky) {
  const auto [width, height] = size;
  try {
    if (!report.empty())
      sky.surroundings.groundHeightMeters = nlohmann::json::parse(base::readFile(report)).at("frame").at("ground_m");
    if (view.find(':') == std::string::npos)
      return image::cameraFor(view, sky.splats, sky.surroundings, width, height);
    image::Camera camera;
    camera.width = width;
    camera.height = height;
    aim(camera, view, report);
    return camera;
  } catch (const nlohmann::json::exception& error) {
    throw base::InputError(report.string(), std::string("is not a report of cloudgen (") + error.what() + ")",
                           "build the scene again");
  }
}

}  // namespace cloudgen::cli
