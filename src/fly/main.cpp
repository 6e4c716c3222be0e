// SPDX-License-Identifier: Apache-2.0
// cloudgen-fly: flies through a runtime pack, or through an endless sky of its clouds, and draws what is seen with OpenGL ES
// 3.0, without a screen. Frames are written as PNG files; what they took is told in lines of JSON.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/text.hpp"
#include "fly/flight.hpp"
#include "fly/png.hpp"
#include "runtime/gles/headless.hpp"
#include "runtime/gles/renderer.hpp"

namespace {

using namespace cloudgen;
using Clock = std::chrono::steady_clock;

struct Line {
  std::string pack, view, sun, endless, size = "1280x720";
  std::filesystem::path output;
  int frames = 100, every = 25;
  std::uint64_t seed = 1;
  bool plain = false, volumes = false;
  double seconds = 0, sunDegreesPerFrame = 0, targetFps = 0;
};

void orThrow(runtime::Status status, const std::string& where, const std::string& hint) {
  if (!status) throw base::InputError(where, status.problem, hint);
}

/// Numbers between separators, as many as are asked for.
template <std::size_t Count>
std::array<double, Count> numbersOf(const std::string& option, const std::string& text, char separator) {
  const auto parts = base::split(text, separator);
  std::array<double, Count> numbers{};
  bool read = parts.size() == Count;
  for (std::size_t i = 0; read && i < Count; ++i) read = base::parseNumber(parts[i], numbers[i]);
  if (!read)
    throw base::UsageError(fmt::format("{} {}", option, text), fmt::format("is not {} numbers between '{}'", Count, separator),
                           "see cloudgen-fly --help");
  return numbers;
}

runtime::Vec3 placeOf(const std::string& text) {
  const auto numbers = numbersOf<3>("--view", text, ',');
  return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

/// A picture to draw into.
struct Canvas {
  runtime::gles::Texture color;
  runtime::gles::Framebuffer target;

  Canvas(int width, int height)
      : color(runtime::gles::newTexture2d(GL_RGBA8, width, height, runtime::gles::Filter::Nearest, runtime::gles::Border::Clamp)),
        target(runtime::gles::newFramebuffer(color)) {}
};

class Cockpit {
 public:
  explicit Cockpit(const Line& line) : line_(line) {
    const auto size = numbersOf<2>("--size", line.size, 'x');
    if (size[0] < 16 || size[1] < 16 || size[0] > 8192 || size[1] > 8192)
      throw base::UsageError("--size " + line.size, "is not WIDTHxHEIGHT with sides of 16 to 8192 pixels", "as in --size 1280x720");
    width_ = static_cast<int>(size[0]);
    height_ = static_cast<int>(size[1]);
    runtime::RuntimeOptions options;
    if (line.plain) {
      // Every cloud in every detail, and all sorted in every frame.
      options.detail.errorPixels = 0;
      options.lazy = {.moveMeters = 0, .turnRadians = 4, .slices = 1};
    } else {
      options.detail.impostorPixels = line.volumes ? 1e9f : 40.0f;
    }
    orThrow(sky_.open(line.pack.c_str(), options), line.pack, "cloudgen build INPUT -o DIR --formats pack makes one");
    if (!line.endless.empty()) orThrow(sky_.startEndless({line.endless, line.seed}), "--endless " + line.endless, "as in --endless d200");
    const auto& sun = *sky_.pack().root().sun();
    sun_ = {sun.azimuth_degrees(), sun.elevation_degrees()};
    if (!line.sun.empty()) {
      const auto place = numbersOf<2>("--sun", line.sun, ',');
      sun_ = {static_cast<float>(place[0]), static_cast<float>(place[1])};
    }
    sky_.setSun(sun_);
    if (line.seconds != 0) sky_.setTime(line.seconds);
    if (const auto status = context_.open(); !status)
      throw base::OutputError("EGL", status.problem, "install a driver: Debian's libgl1-mesa-dri draws in software");
    const float target = line.targetFps > 0 ? static_cast<float>(1000 / line.targetFps) : 0.0f;
    if (const auto status = renderer_.make(sky_, fly::decodePng, width_, height_, {1, target, line.volumes}); !status)
      throw base::OutputError("OpenGL ES", status.problem, "cloudgen validate looks at the pack");
    flight_ = fly::flightThrough(sky_.pack());
    if (!line.endless.empty()) flight_ = {{0, 2500, 0}, 3500};
  }

  void fly() {
    const Canvas canvas(width_, height_);
    double cpu = 0, whole = 0, last = 0;
    std::size_t puffs = 0;
    for (int f = 0; f < line_.frames; ++f) {
      const auto start = Clock::now();
      if (line_.sunDegreesPerFrame != 0 && f > 0) {
        sun_.azimuthDegrees += static_cast<float>(line_.sunDegreesPerFrame);
        sky_.setSun(sun_);
        renderer_.setLight();
      }
      const runtime::Camera camera = cameraAt(f);
      const runtime::Frame frame = sky_.update(camera);
      const double updated = millisecondsSince(start);
      renderer_.draw(frame, camera, canvas.target.id(), last);
      glFinish();
      last = millisecondsSince(start);
      cpu += updated;
      whole += last;
      puffs += frame.puffs.size();
      if (line_.output.empty() || f % line_.every != 0) continue;
      const auto file = line_.output / fmt::format("frame_{:05}.png", f);
      glBindFramebuffer(GL_FRAMEBUFFER, canvas.target.id());
      fly::writeFrame(file, fly::readPixels(width_, height_));
      tell({{"frame", f}, {"file", file.filename().string()}, {"puffs", frame.puffs.size()}, {"update_ms", updated}, {"frame_ms", last}, {"scale", renderer_.scale()}});
    }
    const double frames = std::max(line_.frames, 1);
    tell({{"frames", line_.frames}, {"fps", 1000 * frames / std::max(whole, 1e-9)}, {"frame_ms", whole / frames}, {"update_ms", cpu / frames},
          {"puffs", static_cast<double>(puffs) / frames}, {"scale", renderer_.scale()}, {"width", width_}, {"height", height_}});
  }

 private:
  static double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  }
  static void tell(const nlohmann::ordered_json& line) { fmt::print("{}\n", line.dump()); }

  runtime::Camera cameraAt(int frame) const {
    if (line_.view.empty()) return flight_.cameraAt(frame, width_, height_);
    const auto points = base::split(line_.view, ':');
    if (points.size() != 2)
      throw base::UsageError("--view " + line_.view, "is not EYE:TARGET", "as x,y,z:x,y,z in metres of the scene");
    return fly::cameraBetween(placeOf(points[0]), placeOf(points[1]), width_, height_);
  }

  const Line& line_;
  int width_ = 0, height_ = 0;
  runtime::SunPlace sun_;
  fly::Flight flight_;
  // What is drawn goes before the context that draws it.
  runtime::Runtime sky_;
  runtime::gles::HeadlessContext context_;
  runtime::gles::Renderer renderer_;
};

}  // namespace

int main(int count, char** arguments) {
  Line line;
  CLI::App app("Flies through a runtime pack of cloudgen and draws it without a screen (OpenGL ES 3.0).", "cloudgen-fly");
  app.add_option("PACK", line.pack, "scene.cgpack")->required();
  app.add_option("-o,--output", line.output, "a folder for frames as PNG files");
  app.add_option("--every", line.every, "write every so many frames")->check(CLI::Range(1, 1'000'000))->capture_default_str();
  app.add_option("--frames", line.frames, "fly so many frames of 1/25 s at 250 m/s")->check(CLI::Range(1, 10'000'000))->capture_default_str();
  app.add_option("--size", line.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  app.add_option("--view", line.view, "stand still and look: EYE:TARGET as x,y,z:x,y,z in metres of the scene");
  app.add_option("--endless", line.endless, "a sky without end by weather code: d000, d100, d200, d300 or d400");
  app.add_option("--seed", line.seed, "of the endless sky")->capture_default_str();
  app.add_option("--sun", line.sun, "AZIMUTH,ELEVATION in degrees; else the pack's");
  app.add_option("--sun-moves", line.sunDegreesPerFrame, "degrees of azimuth a frame");
  app.add_option("--time", line.seconds, "seconds from the pack's valid time");
  app.add_option("--fps", line.targetFps, "draw clouds coarser where frames take longer than this asks for");
  app.add_flag("--volumes", line.volumes, "march rays through the clouds instead of drawing their puffs");
  app.add_flag("--plain", line.plain, "no culling, levels of detail, impostors or lazy order: to see what they save");
  try {
    app.parse(count, arguments);
    if (!line.output.empty()) std::filesystem::create_directories(line.output);
    Cockpit(line).fly();
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(base::Failure::Usage);
  } catch (const base::Error& error) {
    fmt::print(stderr, "cloudgen-fly: {}: {}\n  {}\n", error.where(), error.problem(), error.hint());
    return static_cast<int>(error.failure());
  } catch (const std::exception& error) {
    fmt::print(stderr, "cloudgen-fly: {}\n", error.what());
    return static_cast<int>(base::Failure::Output);
  }
}
