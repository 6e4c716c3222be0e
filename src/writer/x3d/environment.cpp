// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/environment.hpp"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/text.hpp"
#include "light/color.hpp"
#include "writer/film/film.hpp"
#include "writer/x3d/flight.hpp"
#include "writer/x3d/ground.hpp"
#include "writer/x3d/viewpoints.hpp"

namespace cloudgen::writer {
namespace {

using light::srgbFromLinear;

std::string joined(std::span<const std::string> parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

void writeInfo(NodeWriter& nodes, const HeadEntries& head) {
  std::vector<std::string> info;
  for (const auto& [name, content] : head)
    if (name != "title") info.push_back(name + ": " + content);
  nodes.open("WorldInfo");
  nodes.strings("info", info);
  nodes.string("title", head.front().second);
  nodes.close();
}

void writeNavigation(NodeWriter& nodes, const Stage& stage) {
  nodes.open("NavigationInfo");
  // Viewers put the near plane at about half the first size.
  const float collision = std::max(0.5f, stage.extent / 10000);
  nodes.numbers("avatarSize", std::array{collision, 1.7f, 0.75f * collision}, 1, 2);
  nodes.boolean("headlight", false);
  nodes.number("speed", std::max(20.0f, 0.25f * stage.cloudWidth), 0);
  nodes.strings("type", std::vector<std::string>{"FLY", "EXAMINE", "ANY"});
  nodes.number("visibilityLimit", 6 * stage.extent, 0);
  nodes.close();
}

void appendColor(std::vector<float>& out, const glm::vec3& linear) {
  const glm::vec3 c = srgbFromLinear(linear);
  out.insert(out.end(), {c.r, c.g, c.b});
}

void writeBackground(NodeWriter& nodes, const light::Sky& sky) {
  std::vector<float> skyColors, groundColors;
  // From the zenith downwards, as the page has it: the horizon's colour fades as exp(-3.5 sine of elevation).
  constexpr std::array kSkyAngles{0.7f, 1.0f, 1.25f, 1.45f, 1.5707f};
  appendColor(skyColors, glm::mix(sky.zenith, sky.horizon, std::exp(-3.5f)));
  for (const float angle : kSkyAngles)
    appendColor(skyColors, glm::mix(sky.zenith, sky.horizon, std::exp(-3.5f * std::cos(angle))));
  for (const float share : {0.0f, 0.1f, 1.0f, 1.0f})
    appendColor(groundColors, glm::mix(sky.ground, sky.horizon, share));
  nodes.open("Background");
  nodes.numbers("groundAngle", std::array{0.8f, 1.25f, 1.5707f}, 1, 4);
  nodes.numbers("groundColor", groundColors, 3, 3);
  nodes.numbers("skyAngle", kSkyAngles, 1, 4);
  nodes.numbers("skyColor", skyColors, 3, 3);
  nodes.close();
}

void writeViews(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage) {
  for (const View& view : viewsOf(scene, stage)) {
    nodes.open("Viewpoint", "children", view.name);
    if (nodes.encoding() != Encoding::Vrml97) nodes.vector("centerOfRotation", view.target, 1);
    nodes.string("description", view.description);
    nodes.rotation("orientation", view.rotation);
    nodes.vector("position", view.eye, 1);
    nodes.close();
  }
}

/// Nothing is lit by it: all colours are those that the sun has made.
void writeSun(NodeWriter& nodes, const light::Sun& sun) {
  nodes.open("DirectionalLight", "children", "Sun");
  nodes.vector("color", srgbFromLinear(sun.color), 3);
  nodes.vector("direction", -sun.direction, 4);
  if (nodes.encoding() != Encoding::Vrml97) nodes.boolean("on", false);
  nodes.close();
}

/// The step of lines, in degrees, that gives about eight of them.
double lineStep(double degrees) {
  for (const double step : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0})
    if (degrees / step <= 10) return step;
  return 30;
}

void writeGraticule(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage) {
  const base::GeoBox& box = scene.frame.box();
  const double step = lineStep(std::max(box.width(), box.height()));
  const double east = box.west + box.width();
  const float lift = std::max(2.0f, 0.0004f * stage.extent);
  constexpr int kPieces = 32;
  std::vector<float> points;
  std::vector<std::int32_t> indices;
  const auto line = [&](double longitude0, double latitude0, double longitude1, double latitude1) {
    for (int i = 0; i <= kPieces; ++i) {
      const double t = static_cast<double>(i) / kPieces;
      const glm::dvec3 p =
          scene.frame.toScene(glm::mix(longitude0, longitude1, t), glm::mix(latitude0, latitude1, t), 0);
      indices.push_back(static_cast<std::int32_t>(points.size() / 3));
      points.insert(points.end(), {static_cast<float>(p.x), scene::groundAt(scene, p.x, p.z) + lift,
                                   static_cast<float>(p.z)});
    }
    indices.push_back(-1);
  };
  for (double i = std::ceil(box.west / step); i * step <= east; ++i)
    line(i * step, box.south, i * step, box.north);
  for (double i = std::ceil(box.south / step); i * step <= box.north; ++i)
    line(box.west, i * step, east, i * step);
  if (points.empty()) return;
  nodes.open("Shape", "children", "Graticule");
  nodes.open("Appearance", "appearance");
  nodes.open("Material", "material");
  nodes.vector("diffuseColor", glm::vec3(0), 0);
  nodes.vector("emissiveColor", srgbFromLinear(glm::mix(scene.sky.ground, scene.sky.horizon, 0.25f)), 3);
  nodes.close();
  nodes.close();
  nodes.open("IndexedLineSet", "geometry");
  nodes.integers("coordIndex", indices);
  nodes.open("Coordinate", "coord");
  nodes.numbers("point", points, 3, 1);
  nodes.close();
  nodes.close();
  nodes.close();
}

}  // namespace

HeadEntries headOf(const scene::Scene& scene, const Stage& stage) {
  const base::GeoBox& box = scene.frame.box();
  const scene::Provenance& from = scene.provenance;
  std::vector<std::string> files;
  for (const std::string& file : from.files) files.push_back(std::filesystem::path(file).filename().string());
  HeadEntries head{
      {"title", "Clouds of " + base::isoText(scene.validTime)},
      {"creator", "cloudgen"},
      {"generator", "cloudgen"},
      {"description", fmt::format("{} clouds from {} model output, X3D Immersive profile",
                                  scene.instances.size(), from.model.empty() ? "weather" : from.model)}};
  if (!files.empty()) head.emplace_back("source", joined(files));
  if (!from.format.empty()) head.emplace_back("source format", from.format);
  if (!from.model.empty()) head.emplace_back("model", from.model);
  if (!from.run.empty()) head.emplace_back("run", from.run);
  head.emplace_back("valid time", base::isoText(scene.validTime));
  head.emplace_back(
      "bounds", fmt::format("west {} south {} east {} north {} degrees", base::shortest(box.west),
                            base::shortest(box.south), base::shortest(box.east), base::shortest(box.north)));
  std::string meters;
  for (const float value :
       {stage.lower.x, stage.lower.y, stage.lower.z, stage.upper.x, stage.upper.y, stage.upper.z}) {
    if (!meters.empty()) meters += ' ';
    base::appendFixed(meters, value, 0);
  }
  head.emplace_back("bounds in metres", meters);
  head.emplace_back("frame",
                    "metres, x east, y up from mean sea level, z south, origin at the south-west corner; " +
                        scene.frame.definition());
  if (const Film film(scene); film.moves()) head.emplace_back("film", film.description());
  head.emplace_back("seed", std::to_string(scene.seed));
  return head;
}

void writeSurroundings(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage) {
  writeNavigation(nodes, stage);
  writeBackground(nodes, scene.sky);
}

void writeEnvironment(NodeWriter& nodes, const scene::Scene& scene, const Stage& stage,
                      const HeadEntries& head, const std::vector<glm::vec3>& flight) {
  writeInfo(nodes, head);
  writeSurroundings(nodes, scene, stage);
  writeViews(nodes, scene, stage);
  writeFlight(nodes, flight);
  writeSun(nodes, scene.sun);
  writeGround(nodes, scene, stage);
  writeGraticule(nodes, scene, stage);
}

}  // namespace cloudgen::writer
