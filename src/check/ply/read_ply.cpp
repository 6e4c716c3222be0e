// SPDX-License-Identifier: Apache-2.0
#include "check/ply/read_ply.hpp"

#include <cmath>
#include <cstring>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"

namespace cloudgen::check {
namespace {

constexpr std::size_t kMostHeaderBytes = 1 << 16, kMostSplats = 1'000'000'000;
constexpr std::string_view kEnd = "end_header\n";

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw base::InputError(where, what, "write splats as binary little-endian PLY of float properties");
}

/// The properties of the vertices by name, and how many splats there are.
std::map<std::string, std::size_t> propertiesOf(std::string_view header, const std::string& where,
                                                PlyHeader& out) {
  std::map<std::string, std::size_t> places;
  bool isLittleEndian = false, hasVertices = false;
  for (const std::string& line : base::split(std::string(header), '\n')) {
    const auto words = base::split(line, ' ');
    if (words.empty() || words[0] == "ply" || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "format") {
      isLittleEndian = words.size() == 3 && words[1] == "binary_little_endian";
    } else if (words[0] == "element") {
      double count = 0;
      if (hasVertices || words.size() != 3 || words[1] != "vertex" || !base::parseNumber(words[2], count) ||
          !(count >= 0 && count <= static_cast<double>(kMostSplats)) || count != std::floor(count))
        fail(where, "has an element beside its vertices, or a count that cannot be");
      hasVertices = true;
      out.count = static_cast<std::size_t>(count);
    } else if (words[0] == "property") {
      if (!hasVertices || words.size() != 3 || (words[1] != "float" && words[1] != "float32"))
        fail(where, "has a property that is no float of a vertex");
      if (!places.emplace(words[2], places.size()).second) fail(where, "has a property twice");
    } else if (!line.empty()) {
      fail(where, "has a header that is not PLY");
    }
  }
  if (!isLittleEndian) fail(where, "is not binary little-endian");
  if (!hasVertices) fail(where, "has no vertices");
  return places;
}

}  // namespace

PlyHeader readPlyHeader(std::string_view bytes, const std::string& where) {
  if (!bytes.starts_with("ply\n")) fail(where, "is no PLY file");
  const std::size_t end = bytes.substr(0, kMostHeaderBytes).find(kEnd);
  if (end == std::string_view::npos) fail(where, "has no end of its header");
  PlyHeader header;
  const auto places = propertiesOf(bytes.substr(0, end), where, header);
  header.headerBytes = end + kEnd.size();
  header.floats = places.size();
  const auto find = [&](const std::string& name) {
    const auto found = places.find(name);
    if (found == places.end()) fail(where, "has no property " + name);
    return found->second;
  };
  const auto run = [&](const std::string& stem, const char* first, int count) {
    const std::size_t start = find(stem + first);
    for (int i = 1; i < count; ++i)
      if (find(stem + static_cast<char>(*first + i)) != start + static_cast<std::size_t>(i))
        fail(where, "has its properties " + stem + " in another order");
    return start;
  };
  header.place = run("", "x", 3);
  header.color = run("f_dc_", "0", 3);
  header.scale = run("scale_", "0", 3);
  header.rotation = run("rot_", "0", 4);
  header.opacity = find("opacity");
  std::size_t rest = 0;
  while (places.contains("f_rest_" + std::to_string(rest))) ++rest;
  if (rest != 0 && rest != 9 && rest != 24 && rest != 45) fail(where, "has harmonics of no whole degree");
  header.coefficients = rest / 3;
  for (std::size_t i = 0; i < rest; ++i)
    if (find("f_rest_" + std::to_string(i)) != find("f_rest_0") + i)
      fail(where, "has its properties f_rest_ in another order");
  if (rest > 0) header.rest = find("f_rest_0");
  const std::size_t record = header.floats * sizeof(float);
  if ((bytes.size() - header.headerBytes) / record != header.count ||
      (bytes.size() - header.headerBytes) % record != 0)
    fail(where, "has bytes of another number of splats than it says");
  return header;
}

void readPlySplats(std::string_view bytes, const std::string& where,
                   const std::function<void(const ReadSplat&)>& visit) {
  const PlyHeader header = readPlyHeader(bytes, where);
  std::vector<float> record(header.floats);
  for (std::size_t i = 0; i < header.count; ++i) {
    std::memcpy(record.data(), bytes.data() + header.headerBytes + i * header.floats * sizeof(float),
                header.floats * sizeof(float));
    const auto triple = [&](std::size_t at) { return glm::vec3(record[at], record[at + 1], record[at + 2]); };
    ReadSplat splat;
    splat.center = triple(header.place);
    const glm::vec3 scale = triple(header.scale);
    splat.sigma = {std::exp(scale.x), std::exp(scale.y), std::exp(scale.z)};
    const float* turn = record.data() + header.rotation;
    splat.rotation = glm::quat(turn[0], turn[1], turn[2], turn[3]);
    const float logit = record[header.opacity];
    splat.opticalDepth = logit > 15 ? logit : std::log1p(std::exp(logit));
    splat.opacity = 1 / (1 + std::exp(-logit));
    splat.color = triple(header.color) * 0.2820947917738781f + 0.5f;
    for (std::size_t k = 0; header.coefficients > 0 && k < 3; ++k)
      for (std::size_t channel = 0; channel < 3; ++channel)
        splat.harmonics[k][static_cast<int>(channel)] =
            record[header.rest + channel * header.coefficients + k];
    visit(splat);
  }
}

}  // namespace cloudgen::check
