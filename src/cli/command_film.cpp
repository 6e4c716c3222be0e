// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/thread.hpp"
#include "cli/command.hpp"
#include "cli/sky_picture.hpp"

extern char** environ;

namespace cloudgen::cli {
namespace {

namespace fs = std::filesystem;

struct FilmLine {
  std::string folder, output, view = "horizon", size = "960x540";
  double stepMinutes = 10, framesPerSecond = 12;
  int threads = 0;
  bool draft = false;
};

constexpr std::array<std::string_view, 2> kFilms{".webm", ".mp4"};

/// Joins frames by ffmpeg, a program of Debian. Throws OutputError where it is not there or fails.
void encode(const fs::path& frames, const fs::path& film, double framesPerSecond) {
  std::vector<std::string> words{"ffmpeg",
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-y",
                                 "-framerate",
                                 fmt::format("{}", framesPerSecond),
                                 "-i",
                                 (frames / "%05d.png").string(),
                                 "-pix_fmt",
                                 "yuv420p",
                                 "-vf",
                                 "pad=ceil(iw/2)*2:ceil(ih/2)*2"};
  if (base::hasExtension(film, ".webm"))
    words.insert(words.end(), {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0"});
  // The same bytes for the same frames.
  words.insert(words.end(),
               {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", film.string()});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process = 0;
  int status = 0;
  const bool ran = ::posix_spawnp(&process, "ffmpeg", nullptr, nullptr, arguments.data(), environ) == 0 &&
                   ::waitpid(process, &status, 0) == process;
  if (!ran || status != 0)
    throw base::OutputError(
        film.string(), ran ? "could not be encoded by ffmpeg" : "needs the program ffmpeg, which is not here",
        "install ffmpeg, or name a folder for the frames");
}

int film(const FilmLine& line, const Terminal& terminal) {
  const auto size = sizeFromText(line.size);
  const base::ThreadLimit limit(line.threads);
  const base::Progress progress = terminal.progress();
  const bool isFilm = base::hasExtension(line.output, kFilms);
  MovingSkyFile file(line.folder);
  if (file.first() == file.last())
    throw base::InputError(line.folder, "stands still", "build it with --time all from several times");
  WrittenSky sky = file.at(file.first());
  const image::Camera camera = cameraFrom(line.view, size, fs::path(line.folder) / "report.json", sky);
  const auto step = std::max<std::int64_t>(1, std::llround(60 * line.stepMinutes));
  const std::int64_t frames = (file.last().seconds - file.first().seconds) / step + 1;
  // Frames of a film stand beside it until it is whole.
  base::StagedFolder folder(isFilm ? fs::path(line.output).concat(".frames") : fs::path(line.output), false);
  for (std::int64_t i = 0; i < frames; ++i) {
    progress.step("film", static_cast<double>(i) / static_cast<double>(frames));
    sky = file.at({file.first().seconds + i * step});
    image::writePng(folder.path() / fmt::format("{:05}.png", i),
                    image::render(sky.splats, camera, sky.surroundings, {.detail = !line.draft}, {}));
  }
  progress.step("film", 1);
  if (isFilm) {
    const fs::path whole = folder.path() / fs::path(line.output).filename();
    encode(folder.path(), whole, line.framesPerSecond);
    fs::rename(whole, line.output);
  } else {
    folder.commit();
  }
  terminal.say(fmt::format("{}: {} frames, {} to {}", line.output, frames, base::isoText(file.first()),
                           base::isoText(file.last())));
  return 0;
}

}  // namespace

std::function<int()> setupFilm(CLI::App& options, const Terminal& terminal) {
  const auto line = std::make_shared<FilmLine>();
  options.add_option("DIR", line->folder, "the folder of a sky that moves (build --time all)")->required();
  options
      .add_option("-o,--output", line->output,
                  "a film (.webm, .mp4; by ffmpeg), or a folder for its frames (PNG)")
      ->required();
  options
      .add_option("--view", line->view, "top, ground, horizon or EYE:TARGET as lon,lat,height:lon,lat,height")
      ->capture_default_str();
  options.add_option("--size", line->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  options.add_option("--step", line->stepMinutes, "minutes of the sky from frame to frame")
      ->check(CLI::Range(0.02, 1440.0))
      ->capture_default_str();
  options.add_option("--fps", line->framesPerSecond, "frames a second of a film")
      ->check(CLI::Range(1.0, 120.0))
      ->capture_default_str();
  options.add_flag("--draft", line->draft, "smooth puffs, without the finer detail: faster");
  options.add_option("--threads", line->threads, "worker threads (0: all cores)")->check(CLI::Range(0, 1024));
  return [line, &terminal] { return film(*line, terminal); };
}

}  // namespace cloudgen::cli
