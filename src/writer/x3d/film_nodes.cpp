// SPDX-License-Identifier: Apache-2.0
#include "writer/x3d/film_nodes.hpp"

#include <algorithm>
#include <array>

namespace cloudgen::writer {
namespace {

constexpr const char* kClock = "Film";
constexpr int kKeyDecimals = 6, kPlaceDecimals = 1, kScaleDecimals = 4;
/// A Transform is not scaled to nothing: viewers invert its matrix.
constexpr float kLeastScale = 0.001f;

}  // namespace

FilmNodes::Span FilmNodes::spanOf(std::uint32_t i) const {
  const Track track = film_.trackOf(i);
  return {track.firstKey, track.firstKey + static_cast<std::uint32_t>(track.places.size()) - 1};
}

void FilmNodes::openFollower(std::uint32_t i, const scene::Instance& still) {
  glm::vec3 place = still.position;
  float scale = still.scale;
  std::string name;
  if (film_.moves()) {
    const Track track = film_.trackOf(i);
    place = track.places.front();
    scale = std::max(track.scales.front(), kLeastScale);
    std::vector<std::string>& names = followers_[i];
    name = fmt::format("Cloud_{}{}", i, names.empty() ? "" : fmt::format("_{}", names.size() + 1));
    names.push_back(name);
  }
  nodes_.open("Transform", "children", name);
  nodes_.vector("scale", glm::vec3(scale), kScaleDecimals);
  nodes_.vector("translation", place, kPlaceDecimals);
}

void FilmNodes::openWhileThere(std::uint32_t i) {
  if (!hasSwitches()) return;
  const Span span = spanOf(i);
  std::vector<std::string>& names = switches_[span];
  names.push_back(fmt::format("While_{}_{}_{}", span.first, span.second, names.size() + 1));
  nodes_.open("Switch", "children", names.back());
  nodes_.integer("whichChoice", film_.isThereAtFirst(i) ? 0 : -1);
  nodes_.open("Group");
}

void FilmNodes::closeWhileThere() {
  if (!hasSwitches()) return;
  nodes_.close();
  nodes_.close();
}

void FilmNodes::interpolator(const std::string& def, std::span<const float> keys, std::span<const float> values,
                             int decimals) {
  nodes_.open("PositionInterpolator", "children", def);
  nodes_.numbers("key", keys, 1, kKeyDecimals);
  nodes_.numbers("keyValue", values, 3, decimals);
  nodes_.close();
}

void FilmNodes::interpolators(std::uint32_t i) {
  const Track track = film_.trackOf(i);
  std::vector<float> keys, places, scales;
  for (std::uint32_t k = 0; k < track.places.size(); ++k) {
    keys.push_back(static_cast<float>(film_.shareAt(track.firstKey + k)));
    const glm::vec3& place = track.places[k];
    places.insert(places.end(), {place.x, place.y, place.z});
    scales.insert(scales.end(), 3, std::max(track.scales[k], kLeastScale));
  }
  interpolator(fmt::format("Way_{}", i), keys, places, kPlaceDecimals);
  interpolator(fmt::format("Size_{}", i), keys, scales, kScaleDecimals);
}

void FilmNodes::sequencer(const std::string& def, const Span& span) {
  std::vector<float> keys;
  std::vector<std::int32_t> choices;
  const auto from = [&](double share, std::int32_t choice) {
    keys.push_back(static_cast<float>(share));
    choices.push_back(choice);
  };
  if (span.first > 0) from(0, -1);
  from(film_.shareAt(span.first), 0);
  if (span.second < film_.lastKey()) from(film_.shareAt(span.second), -1);
  nodes_.open("IntegerSequencer", "children", def);
  nodes_.numbers("key", keys, 1, kKeyDecimals);
  nodes_.integers("keyValue", choices);
  nodes_.close();
}

void FilmNodes::finish() {
  if (followers_.empty()) return;
  const auto choiceOf = [](const Span& span) { return fmt::format("Choice_of_{}_{}", span.first, span.second); };
  nodes_.open("TimeSensor", "children", kClock);
  nodes_.number("cycleInterval", film_.seconds(), 3);
  if (nodes_.encoding() != Encoding::Vrml97) nodes_.string("description", film_.description());
  nodes_.boolean("loop", true);
  nodes_.close();
  for (const auto& [instance, names] : followers_) interpolators(instance);
  for (const auto& [span, names] : switches_) sequencer(choiceOf(span), span);

  const auto drive = [&](const std::string& driver, const std::vector<std::string>& driven, const char* field) {
    nodes_.route(kClock, "fraction_changed", driver, "set_fraction");
    for (const std::string& name : driven) nodes_.route(driver, "value_changed", name, field);
  };
  for (const auto& [instance, names] : followers_) {
    drive(fmt::format("Way_{}", instance), names, "translation");
    drive(fmt::format("Size_{}", instance), names, "scale");
  }
  for (const auto& [span, names] : switches_) drive(choiceOf(span), names, "whichChoice");
}

}  // namespace cloudgen::writer
