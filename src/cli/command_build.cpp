// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/data_dir.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "base/thread.hpp"
#include "cli/cloud_lists.hpp"
#include "cli/command.hpp"
#include "cli/input_options.hpp"
#include "cli/report.hpp"
#include "cli/shape_files.hpp"
#include "cli/verification.hpp"
#include "writer/catalogue.hpp"

namespace cloudgen::cli {
namespace {

/// The command line as written.
struct BuildLine {
  InputLine input;
  std::string output, box, formats, sun = "auto", frame = "local", types, typing, shard, maxMemory,
                                    tiles = "auto", x3dProfile = "portable", fly;
  ShapeLine shape;
  double typingWindowMinutes = 180;
  std::uint64_t seed = 1, maxPuffs = 200'000;
  int threads = 0, splatDegree = 1;
  bool overwrite = false, json = false, verify = false, tilesGzip = false, glbNodes = false,
       splatQuantize = false;
};

void refuseWhatIsNotBuilt(const BuildLine& line) {
  const auto refuse = [](const std::string& option, const std::string& what) {
    throw base::NotBuiltError(option, what + " is not part of this build",
                              "leave it out; `cloudgen --version --json` says what is built");
  };
  if (!line.shard.empty()) refuse("--shard", "building in shards");
  if (!line.maxMemory.empty()) refuse("--max-memory", "a memory limit");
  if (line.x3dProfile == "xite") refuse("--x3d-profile xite", "X3D with shaders of its own");
  if (line.frame == "geo") refuse("--frame geo", "the curved-Earth frame");
  if (line.frame != "local")
    throw base::UsageError("--frame " + line.frame, "is not a known frame", "use local");
}

void refuseWhatCannotBeVerified(const BuildLine& line, std::span<const writer::Format* const> formats) {
  const bool read = std::any_of(formats.begin(), formats.end(), [](const writer::Format* format) {
    return format->name == "x3d" || format->name == "splats" || format->name == "glb" ||
           format->name == "pack" || format->name == "tiles";
  });
  if (line.verify && !read)
    throw base::UsageError("--verify", "reads x3d, splats, glb, pack or tiles, and none is written",
                           "add one of them to --formats");
}

const std::map<std::string, writer::TileContent>& tileContents() {
  static const std::map<std::string, writer::TileContent> kContents{{"auto", writer::TileContent::Auto},
                                                                    {"spz", writer::TileContent::Packed},
                                                                    {"cards", writer::TileContent::Cards},
                                                                    {"splats", writer::TileContent::Splats}};
  return kContents;
}

std::optional<std::pair<double, double>> sunFromText(const std::string& text) {
  if (text == "auto") return std::nullopt;
  const auto parts = base::split(text, ',');
  double azimuth = 0, elevation = 0;
  if (parts.size() != 2 || !base::parseNumber(parts[0], azimuth) || !base::parseNumber(parts[1], elevation) ||
      elevation < -90 || elevation > 90)
    throw base::UsageError("--sun " + text, "is not AZIMUTH,ELEVATION in degrees",
                           "as in --sun 220,35 (clockwise from north, above the horizon), or --sun auto");
  return std::pair{azimuth, elevation};
}

/// The places of --fly as degrees east, degrees north and metres.
std::vector<glm::dvec3> flightFromText(const std::string& text) {
  std::vector<glm::dvec3> flight;
  for (const std::string& place : base::split(text, ';')) {
    const auto parts = base::split(place, ',');
    glm::dvec3 at(0);
    if (parts.size() != 3 || !base::parseNumber(parts[0], at.y) || !base::parseNumber(parts[1], at.x) ||
        !base::parseNumber(parts[2], at.z) || std::abs(at.y) > 90 || std::abs(at.x) > 360 || at.z < -500 ||
        at.z > 50'000)
      throw base::UsageError("--fly " + text, "is not LATITUDE,LONGITUDE,METRES;... in degrees",
                             "as in --fly '46.1,7.2,3000;46.5,7.9,4000'");
    flight.push_back(at);
  }
  if (flight.size() < 2) throw base::UsageError("--fly " + text, "is one place", "a flight has two or more");
  return flight;
}

/// Seconds since the last call, by stage.
class Stopwatch {
 public:
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    laps_.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }
  const std::vector<std::pair<std::string, double>>& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> laps_;
};

/// Gives every option of a TOML file that the command line leaves open. Throws UsageError for what no option
/// knows.
void takeConfig(CLI::App& options, const std::string& file) {
  base::readFile(file, 1 << 20);  // says what is wrong with the path
  try {
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_file(file)) {
      if (item.name == "++" || item.name == "--") continue;  // section marks
      CLI::Option* option = options.get_option_no_throw("--" + item.name);
      if (!option || !item.parents.empty())
        throw base::UsageError(file, "has \"" + item.fullname() + "\", which is not an option of build",
                               "see `cloudgen build --help`");
      if (option->count() > 0) continue;
      option->add_result(item.inputs);
      option->run_callback();
    }
  } catch (const CLI::Error& error) {
    throw base::UsageError(file, error.what(), "see `cloudgen build --help`");
  }
}

/// What a format shows of a sky that moves: with or without its skies between times, or only the first time.
const scene::Scene& playedBy(const writer::Format& format, const pipeline::MovingSky& sky, const scene::Scene& first) {
  if (format.moves(sky.scene)) return sky.scene;
  return sky.uncut && format.moves(*sky.uncut) ? *sky.uncut : first;
}

/// Formats of nodes hold motions of so many clouds only.
void warnOfWhatStandsStill(const scene::Scene& scene, const std::vector<const writer::Format*>& formats,
                           const Terminal& terminal) {
  std::string still;
  std::size_t most = 0;
  for (const writer::Format* format : formats) {
    if (format->mostMovingClouds == 0 || format->moves(scene)) continue;
    still += (still.empty() ? "" : ", ") + std::string(format->name);
    most = format->mostMovingClouds;
  }
  if (!still.empty())
    terminal.warn(fmt::format("{} hold the first time only: {} clouds move, and they play at most {}; lower --max-puffs, or take "
                              "a smaller --bbox",
                              still, scene.instances.size(), most));
  if (std::none_of(formats.begin(), formats.end(), [&](const auto* format) { return format->moves(scene); }))
    terminal.warn("no file holds the motion: the pack does, whatever moves; it is not among --formats");
}

int build(const BuildLine& line, const Terminal& terminal) {
  refuseWhatIsNotBuilt(line);
  const auto formats = writer::chosenFormats(line.formats);
  refuseWhatCannotBeVerified(line, formats);
  pipeline::Options options;
  if (!line.box.empty()) options.box = base::boxFromText(line.box);
  options.seed = line.seed;
  options.maxPuffs = line.maxPuffs;
  options.sunDegrees = sunFromText(line.sun);
  const auto flight = line.fly.empty() ? std::vector<glm::dvec3>() : flightFromText(line.fly);
  const base::ThreadLimit limit(line.threads);
  const base::Progress progress = terminal.progress();
  Stopwatch watch;

  options.recipes = pipeline::readRecipes(line.types.empty() ? base::dataDir() / "templates" / "types"
                                                             : std::filesystem::path(line.types));
  openShapes(options.recipes, line.shape);
  const auto source = openInput(line.input);
  const auto typing = line.typing.empty() ? nullptr
                                          : openTyping(line.typing, line.input, source->info().validTime,
                                                       line.typingWindowMinutes);
  options.typing = typing.get();
  const bool moves = line.input.allTimes() && source->info().validTimes.size() > 1;
  base::StagedFolder folder(line.output, line.overwrite);
  watch.lap("open");
  std::optional<pipeline::MovingSky> moving;
  if (moves) {
    InputLine at = line.input;
    const auto open = [&](base::UtcTime time) {
      at.time = base::isoText(time);
      return openInput(at);
    };
    pipeline::OpenTime typingAt;
    if (typing)
      typingAt = [&](base::UtcTime time) { return openTyping(line.typing, line.input, time, line.typingWindowMinutes); };
    moving = pipeline::runTimes(source->info().validTimes, open, options, progress, typingAt);
  }
  const pipeline::Outcome outcome =
      moving ? std::move(moving->first) : pipeline::run(*source, options, progress);
  watch.lap("pipeline");
  writer::Destination destination{folder.path(), progress};
  destination.tiles = {tileContents().at(line.tiles), line.tilesGzip};
  destination.splats = {line.splatDegree, line.splatQuantize};
  destination.cards.singly = line.glbNodes;
  destination.x3d.onGlobe = line.x3dProfile == "geo";
  destination.flight = flight;
  const auto write = [&](bool showingVerification) {
    for (const writer::Format* format : formats) {
      if (format->showsVerification != showingVerification) continue;
      progress.step(fmt::format("writing {}", format->name), 0);
      format->write(moving ? playedBy(*format, *moving, outcome.scene) : outcome.scene, destination);
      watch.lap(fmt::format("write_{}", format->name));
    }
  };
  write(false);
  writeCloudLists(folder.path(), outcome.scene, outcome.cloudyLayers);
  std::optional<nlohmann::ordered_json> verification;
  if (line.verify) {
    verification = verifyWritten(folder.path(), outcome.scene.frame, outcome.scene.groundHeightMeters,
                                 *source, typing.get(), progress);
    destination.verification = verification->dump();
    watch.lap("verify");
  }
  write(true);
  auto report = reportOf(*source, typing.get(), outcome, folder.path(), watch.laps());
  const auto shapes = shapesOf(options.recipes, outcome.scene);
  if (!shapes.empty()) report["shapes"] = shapes;
  if (verification) report["verify"] = *verification;
  if (moving) {
    report["motion"] = motionOf(*moving);
    report["valid_times"] = nlohmann::ordered_json::array();
    for (const base::UtcTime time : moving->times) report["valid_times"].push_back(base::isoText(time));
  }
  base::writeFile(folder.path() / "report.json", report.dump(2) + "\n");
  progress.step("writing", 1);
  folder.commit();

  for (const std::string& warning : outcome.warnings) terminal.warn(warning);
  if (!flight.empty() && std::ranges::none_of(flight, [&](const glm::dvec3& place) {
        return outcome.scene.frame.box().contains(place.x, place.y);
      }))
    terminal.warn("no place of --fly lies over the scene: LATITUDE stands first");
  if (moving) warnOfWhatStandsStill(moving->uncut ? *moving->uncut : moving->scene, formats, terminal);
  const bool shapeSeen =
      std::any_of(shapes.begin(), shapes.end(), [](const auto& shape) { return shape.at("clouds") > 0; });
  if (!line.shape.file.empty() && !shapeSeen)
    terminal.warn("no cloud has the shape of --shape: this sky has no cumulus and no cumulonimbus");
  if (line.json) print(report.dump(2));
  if (verification && !verification->at("passed").get<bool>())
    terminal.warn(
        fmt::format("the sky is not within {} of the tolerances of verify; report.json has the figures",
                    verification->at("broken").size()));
  terminal.say(fmt::format("{}: {} clouds of {} puffs from {} model columns, valid {}", line.output,
                           outcome.scene.clouds.size(), scene::drawnPuffs(outcome.scene), outcome.columns,
                           base::isoText(outcome.scene.validTime)));
  return 0;
}

}  // namespace

std::function<int()> setupBuild(CLI::App& options, const Terminal& terminal) {
  const auto line = std::make_shared<BuildLine>();
  addInputOptions(options, line->input);
  options.add_option("-o,--output", line->output, "folder to make; it appears when it is complete")
      ->required();
  options.add_option("--bbox", line->box,
                     "west,south,east,north in degrees (default: the whole model domain)");
  options.add_option("--formats", line->formats,
                     "comma-separated list; `cloudgen formats` lists them (default: all but ply, tiles and impostors)");
  options.add_option("--seed", line->seed, "another seed, another sky of the same statistics")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  options
      .add_option("--threads", line->threads,
                  "worker threads; the result is the same for any number (0: all cores)")
      ->check(CLI::Range(0, 1024));
  options.add_option("--sun", line->sun, "auto (from time and place) or AZIMUTH,ELEVATION in degrees")
      ->capture_default_str();
  options
      .add_option("--max-puffs", line->maxPuffs,
                  "how many puffs the whole scene may draw; fewer make fewer and larger clouds")
      ->check(CLI::Range(std::uint64_t{1000}, std::uint64_t{50'000'000}))
      ->capture_default_str();
  options.add_option("--frame", line->frame, "local: a plane tangent at the middle of the box")
      ->capture_default_str();
  options.add_option("--types", line->types, "folder of recipes, one a genus (default: templates/types)");
  options.add_option("--typing", line->typing,
                     "cloud typing (a WWMCA file or folder) beside a moisture model: it decides the genera");
  options
      .add_option("--typing-window", line->typingWindowMinutes,
                  "minutes that the typing may be away from the model's time")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  options.add_option(
      "--shape", line->shape.file,
      "clouds in heaps (Cu, Cb) take the form of a mesh (.obj .ply .off .gltf .glb), an L-system "
      "(.json) or a volume (.vdb .nc); recipes give shapes to other genera");
  options.add_option("--shape-variable", line->shape.variable,
                     "the grid or variable of a volume (default: density, or cloud water)");
  options.add_flag("--shape-z-up", line->shape.zUp, "z of a mesh or a .vdb is up, not y");
  options
      .add_option(
          "--tiles", line->tiles,
          "what 3D Tiles hold: spz (splats packed small, what CesiumJS draws up to a width), cards (for any "
          "viewer), splats (plain, what three.js draws), or auto (spz where that is enough, else cards)")
      ->check(CLI::IsMember({"auto", "spz", "cards", "splats"}))
      ->capture_default_str();
  options.add_flag("--tiles-gzip", line->tilesGzip,
                   "3D Tiles as gzip under their own names; the server must say Content-Encoding: gzip");
  options.add_flag("--glb-nodes", line->glbNodes,
                   "scene.glb with a node a cloud, for viewers without EXT_mesh_gpu_instancing");
  options
      .add_option("--splat-degree", line->splatDegree,
                  "harmonics of splats: 0 (one colour from all sides), 1, or 2 (sharper towards the sun)")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  options.add_flag("--splat-quantize", line->splatQuantize,
                   "scene.splats.glb in shorts and bytes (KHR_mesh_quantization): about half as large");
  options
      .add_option("--x3d-profile", line->x3dProfile,
                  "portable: what X_ITE, X3DOM and view3dscene all draw; geo: also scene.geo.x3d, which has scene.x3d on the "
                  "globe, for viewers with the Geospatial component (X_ITE); xite (not built yet)")
      ->check(CLI::IsMember({"portable", "geo", "xite"}))
      ->capture_default_str();
  options.add_option(
      "--fly", line->fly,
      "LATITUDE,LONGITUDE,METRES;...: X3D and VRML get a viewpoint that flies along these places");
  options.add_option("--shard", line->shard, "I/N: only a share of the tiles (not built yet)");
  options.add_option("--max-memory", line->maxMemory, "limit of memory (not built yet)");
  const auto config = std::make_shared<std::string>();
  options.add_option("--config", *config,
                     "options from a TOML file, as in seed = 7; the command line goes before it");
  options.add_flag(
      "--verify", line->verify,
      "read the scene back, compare it with the model and put the result into report.json and the page");
  options.add_flag("--overwrite", line->overwrite, "replace a folder that cloudgen made before");
  options.add_flag("--json", line->json, "print the report to stdout");
  return [line, config, &options, &terminal] {
    if (!config->empty()) takeConfig(options, *config);
    return build(*line, terminal);
  };
}

}  // namespace cloudgen::cli
