// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/thread.hpp"
#include "cli/command.hpp"
#include "cli/sky_picture.hpp"

namespace cloudgen::cli {
namespace {

struct PreviewLine {
  std::string input, output, view = "horizon", size = "960x540", time;
  int threads = 0;
  bool draft = false;
};

WrittenSky skyAt(const std::filesystem::path& folder, const std::string& text) {
  const auto time = base::utcFromIso(text);
  if (!time)
    throw base::UsageError("--time " + text, "is not an ISO time", "as in --time 2011-01-15T12:30Z");
  MovingSkyFile file(folder);
  if (*time < file.first() || file.last() < *time)
    throw base::InputError(folder.string(), "has no sky for " + base::isoText(*time),
                           fmt::format("it goes from {} to {}", base::isoText(file.first()), base::isoText(file.last())));
  return file.at(*time);
}

int preview(const PreviewLine& line, const Terminal& terminal) {
  const auto size = sizeFromText(line.size);
  const base::ThreadLimit limit(line.threads);
  const bool isFolder = std::filesystem::is_directory(line.input);
  const std::filesystem::path input = line.input;
  if (!line.time.empty() && !isFolder)
    throw base::UsageError("--time " + line.time, "needs the folder of the scene", "name the folder instead of the file");
  WrittenSky sky = line.time.empty() ? readSplatSky(isFolder ? input / "scene.splats.glb" : input) : skyAt(input, line.time);
  const image::Camera camera =
      cameraFrom(line.view, size, isFolder ? input / "report.json" : std::filesystem::path(), sky);
  image::RenderOptions options{.detail = !line.draft};
  // Something to look at while the rest is drawn; the file is replaced as a whole.
  options.coarse = [&](const image::Picture& picture) { image::writePng(line.output, picture); };
  image::writePng(line.output, image::render(sky.splats, camera, sky.surroundings, options, terminal.progress()));
  terminal.say(fmt::format("{}: {} splats, {}x{}", line.output, sky.splats.size(), camera.width, camera.height));
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
  options.add_option("--time", line->time, "of a sky that moves: a time (ISO) between its first and last");
  options.add_option("--size", line->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  options.add_flag("--draft", line->draft, "smooth puffs, without the finer detail: faster");
  options.add_option("--threads", line->threads, "worker threads (0: all cores)")->check(CLI::Range(0, 1024));
  return [line, &terminal] { return preview(*line, terminal); };
}

}  // namespace cloudgen::cli
