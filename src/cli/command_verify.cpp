// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/thread.hpp"
#include "cli/command.hpp"
#include "cli/fidelity_maps.hpp"
#include "cli/fidelity_report.hpp"
#include "cli/input_options.hpp"
#include "cli/moment_between.hpp"
#include "cli/verification.hpp"

namespace cloudgen::cli {
namespace {

namespace fs = std::filesystem;

struct VerifyLine {
  InputLine input;
  std::string folder, typing, format = "auto", maps;
  double typingWindowMinutes = 180;
  int threads = 0;
  bool json = false, noMaps = false;
};

/// What the report of a scene says about where and when it is.
struct SceneReport {
  base::GeoBox box;
  std::string definition, validTime;
  double groundMeters = 0;
  bool moves = false;
};

SceneReport readReport(const fs::path& folder) {
  const fs::path file = folder / "report.json";
  try {
    const auto report = nlohmann::json::parse(base::readFile(file, 64 << 20));
    const auto& box = report.at("bbox");
    return {{box.at(0), box.at(1), box.at(2), box.at(3)},
            report.at("frame").at("definition"),
            report.at("valid_times").at(0),
            report.at("frame").at("ground_m"),
            report.at("valid_times").size() > 1};
  } catch (const nlohmann::json::exception& error) {
    throw base::InputError(file.string(), std::string("is not a report of cloudgen (") + error.what() + ")",
                           "name the folder of a scene, or build it again");
  }
}

/// The time of the scene, where the line leaves it open and the input has it.
void takeTime(InputLine& input, const SceneReport& report) {
  if (input.time != "first") return;
  const auto source = openInput(input);
  for (const base::UtcTime time : source->info().validTimes)
    if (base::isoText(time) == report.validTime) input.time = report.validTime;
}

/// Into the scene's own folder unless another is named; the figures are told even if there is no room for
/// the maps there.
void writeMaps(const VerifyLine& line, const check::Fidelity& fidelity, const field::Grid& grid,
               const base::GeoBox& box, const Terminal& terminal) {
  const fs::path folder = line.maps.empty() ? fs::path(line.folder) / "verify" : fs::path(line.maps);
  try {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw base::OutputError(folder.string(), "cannot be made (" + error.message() + ")",
                              "name another folder with -o, or leave the maps out with --no-maps");
    const auto names = writeFidelityMaps(fidelity, grid, box, folder);
    terminal.say(fmt::format("{}: {} maps (model, scene, scene minus model)", folder.string(), names.size()));
  } catch (const base::OutputError& error) {
    if (!line.maps.empty()) throw;
    terminal.warn(fmt::format("no maps: {} {}", error.where(), error.problem()));
  }
}

/// As it stands at a time, if it moves.
check::WrittenScene sceneAt(const VerifyLine& line, base::UtcTime time, const SceneReport& report,
                            const base::LocalFrame& frame, const base::Progress& progress) {
  const auto valid = base::utcFromIso(report.validTime);
  const double seconds = report.moves && valid ? static_cast<double>(time.seconds - valid->seconds) : 0;
  check::WrittenScene scene = readWritten(line.folder, line.format, frame, progress, seconds);
  scene.groundMeters = report.groundMeters;
  return scene;
}

int verifyBetween(const VerifyLine& line, const MomentBetween& moment, const SceneReport& report,
                  const base::LocalFrame& frame, const base::Progress& progress, const Terminal& terminal) {
  if (!line.typing.empty())
    throw base::UsageError("--typing", "is of one time, and --time lies between two", "leave it out");
  const auto scene = sceneAt(line, moment.at, report, frame, progress);
  const BetweenFidelity fidelity = compareBetween(moment, scene, frame, line.input, progress);
  if (line.json)
    print(betweenJson(fidelity).dump(2));
  else if (!terminal.quiet)
    print(betweenText(fidelity));
  return fidelity.passed() ? 0 : static_cast<int>(base::Failure::Output);
}

int verify(const VerifyLine& line, const Terminal& terminal) {
  const base::ThreadLimit limit(line.threads);
  const base::Progress progress = terminal.progress();
  const SceneReport report = readReport(line.folder);
  const base::LocalFrame frame(report.box);
  if (frame.definition() != report.definition)
    throw base::InputError((fs::path(line.folder) / "report.json").string(),
                           "names the frame " + report.definition + ", which is not that of its box",
                           "build the scene again");
  InputLine input = line.input;
  if (report.moves)
    if (const auto moment = momentBetween(input)) return verifyBetween(line, *moment, report, frame, progress, terminal);
  takeTime(input, report);
  const auto source = openInput(input);
  const auto typing = line.typing.empty() ? nullptr
                                          : openTyping(line.typing, input, source->info().validTime,
                                                       line.typingWindowMinutes);
  if (!report.moves && base::isoText(source->info().validTime) != report.validTime)
    terminal.warn(fmt::format("the scene is valid at {}, the input at {}", report.validTime,
                              base::isoText(source->info().validTime)));
  const check::Tolerances tolerances;
  const check::WrittenScene scene = sceneAt(line, source->info().validTime, report, frame, progress);
  const check::Fidelity fidelity =
      check::compareWithModel(scene, frame, *source, typing.get(), tolerances, progress);
  if (!line.noMaps) writeMaps(line, fidelity, source->grid(), report.box, terminal);
  if (line.json)
    print(fidelityJson(fidelity, tolerances).dump(2));
  else if (!terminal.quiet)
    print(fidelityText(fidelity, tolerances));
  return fidelity.breaches.empty() ? 0 : static_cast<int>(base::Failure::Output);
}

}  // namespace

std::function<int()> setupVerify(CLI::App& options, const Terminal& terminal) {
  const auto line = std::make_shared<VerifyLine>();
  options.add_option("DIR", line->folder, "the folder of a scene")->required();
  options.add_option("--against", line->input.inputs, "the input that it was made from")->required();
  addReadingOptions(options, line->input);
  options.add_option("--typing", line->typing, "the cloud typing that it was made with");
  options
      .add_option("--typing-window", line->typingWindowMinutes,
                  "minutes that the typing may be away from the model's time")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  options
      .add_option("--format", line->format,
                  "which file to read: x3d, splats, ply, glb, pack, tiles or auto (the best that is there)")
      ->check(CLI::IsMember({"auto", "x3d", "splats", "ply", "glb", "pack", "tiles"}))
      ->capture_default_str();
  options.add_option(
      "-o,--output", line->maps,
      "folder for maps (PNG) of model, scene and difference side by side (default: DIR/verify)");
  options.add_flag("--no-maps", line->noMaps, "leave the maps out");
  options.add_option("--threads", line->threads, "worker threads (0: all cores)")->check(CLI::Range(0, 1024));
  options.add_flag("--json", line->json, "one JSON object on stdout");
  options.footer(
      "Exit code 4 when a tolerance is broken: cover bias 0.01 and RMSE 0.10 (0.05 where 100 clouds or a\n"
      "full sheet stand in a column), optical depth bias 2 % and correlation 0.98, base and top RMSE 150 m "
      "or\n"
      "half a model level, every stated genus kept. A --time between two of the forecast is compared with both,\n"
      "in the mean over the box: cover within 0.03.");
  return [line, &terminal] { return verify(*line, terminal); };
}

}  // namespace cloudgen::cli
