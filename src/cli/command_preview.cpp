// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/frame.hpp"
#include "base/text.hpp"
#include "base/thread.hpp"
#include "check/gltf/read_splats.hpp"
#include "cli/command.hpp"
#include "image/preview.hpp"

namespace cloudgen::cli {
namespace {

struct PreviewLine {
  std::string input, output, view = "horizon", size = "960x540";
  int threads = 0;
  bool draft = false;
};

/// The picture as viewers draw it: the harmonics of degree 1 hold what is added towards the sun.
std::vector<image::Splat> splatsOf(const check::SplatFile& file, const glm::vec3& sunDirection) {
  constexpr float kHarmonic1 = 0.4886025119029199f;
  std::vector<image::Splat> splats;
  splats.reserve(file.splats.size());
  for (const check::ReadSplat& read : file.splats) {
    const glm::vec3 towardsSun =
        kHarmonic1 * (-sunDirection.y * read.harmonics[0] + sunDirection.z * read.harmonics[1] -
                      sunDirection.x * read.harmonics[2]);
    splats.push_back({read.center, read.sigma, read.rotation, read.opacity, read.color, towardsSun});
  }
  return splats;
}

std::pair<int, int> sizeFromText(const std::string& text) {
  const auto parts = base::split(text, 'x');
  double width = 0, height = 0;
  if (parts.size() != 2 || !base::parseNumber(parts[0], width) || !base::parseNumber(parts[1], height) ||
      width < 16 || height < 16 || width > 16384 || height > 16384)
    throw base::UsageError("--size " + text, "is not WIDTHxHEIGHT with sides of 16 to 16384 pixels",
                           "as in --size 1280x720");
  return {static_cast<int>(width), static_cast<int>(height)};
}

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

int preview(const PreviewLine& line, const Terminal& terminal) {
  const auto [width, height] = sizeFromText(line.size);
  const base::ThreadLimit limit(line.threads);
  const bool isFolder = std::filesystem::is_directory(line.input);
  const std::filesystem::path splatFile =
      isFolder ? std::filesystem::path(line.input) / "scene.splats.glb" : std::filesystem::path(line.input);
  const std::filesystem::path report =
      isFolder ? std::filesystem::path(line.input) / "report.json" : std::filesystem::path();
  const check::SplatFile file = check::readSplats(splatFile);
  image::Surroundings surroundings;
  surroundings.sun = light::sunFrom(file.sunAzimuthDegrees, file.sunElevationDegrees);
  surroundings.sky = light::skyUnder(surroundings.sun);
  surroundings.terrain = file.terrain;
  const auto splats = splatsOf(file, surroundings.sun.direction);
  image::Camera camera;
  try {
    if (!report.empty())
      surroundings.groundHeightMeters =
          nlohmann::json::parse(base::readFile(report)).at("frame").at("ground_m");
    if (line.view.find(':') != std::string::npos) {
      camera.width = width;
      camera.height = height;
      aim(camera, line.view, report);
    } else {
      camera = image::cameraFor(line.view, splats, surroundings, width, height);
    }
  } catch (const nlohmann::json::exception& error) {
    throw base::InputError(report.string(), std::string("is not a report of cloudgen (") + error.what() + ")",
                           "build the scene again");
  }
  image::RenderOptions options{.detail = !line.draft};
  // Something to look at while the rest is drawn; the file is replaced as a whole.
  options.coarse = [&](const image::Picture& picture) { image::writePng(line.output, picture); };
  image::writePng(line.output, image::render(splats, camera, surroundings, options, terminal.progress()));
  terminal.say(fmt::format("{}: {} splats, {}x{}", line.output, splats.size(), width, height));
  return 0;
}

}  // namespace

std::function<int()> setupPreview(CLI::App& options, const Terminal& terminal) {
  const auto line = std::make_shared<PreviewLine>();
  options.add_option("INPUT", line->input, "the folder of a scene, or its scene.splats.glb")->required();
  options.add_option("-o,--output", line->output, "the PNG to write")->required();
  options
      .add_option("--view", line->view, "top, ground, horizon or EYE:TARGET as lon,lat,height:lon,lat,height")
      ->capture_default_str();
  options.add_option("--size", line->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  options.add_flag("--draft", line->draft, "smooth puffs, without the finer detail: faster");
  options.add_option("--threads", line->threads, "worker threads (0: all cores)")->check(CLI::Range(0, 1024));
  return [line, &terminal] { return preview(*line, terminal); };
}

}  // namespace cloudgen::cli
