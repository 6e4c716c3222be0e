// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/film_pose.hpp"

#include "check/rules/keyframes.hpp"

namespace cloudgen::check {

using nlohmann::json;

json nodesAt(const GlbParts& glb, double seconds) {
  json nodes = glb.root().at("nodes");
  const json& film = glb.root().at("asset").at("extras").at("film");
  const auto time = static_cast<float>(seconds / 3600 * film.at("seconds_an_hour").get<double>());
  const json& animation = glb.root().at("animations").at(0);
  for (const json& channel : animation.at("channels")) {
    const json& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
    const auto keys = glb.floats(sampler.at("input").get<std::size_t>(), 1),
               values = glb.floats(sampler.at("output").get<std::size_t>(), 3);
    if (keys.empty() || values.size() != 3 * keys.size()) glb.fail("has an animation whose keys and values do not fit");
    const auto [before, after, share] = keyframeAt(keys, time);
    json value = json::array();
    for (std::size_t axis = 0; axis < 3; ++axis)
      value.push_back(values[3 * before + axis] + share * (values[3 * after + axis] - values[3 * before + axis]));
    const json& target = channel.at("target");
    nodes.at(target.at("node").get<std::size_t>())[target.at("path").get<std::string>()] = std::move(value);
  }
  return nodes;
}

}  // namespace cloudgen::check
