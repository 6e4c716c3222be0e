// SPDX-License-Identifier: Apache-2.0
#include "check/gltf/gltf_rules.hpp"

#include <algorithm>
#include <array>

namespace cloudgen::check {
namespace {

constexpr std::string_view kSplats = "KHR_gaussian_splatting";
constexpr std::string_view kPacked = "KHR_gaussian_splatting_compression_spz_2";
constexpr double kUnitTolerance = 0.02;  // of a rotation stored in bytes

/// The first element for which the test fails, or nothing.
template <typename Test>
std::optional<Count> firstFailing(const Elements& elements, Test test) {
  for (Count i = 0; !elements.bytes.empty() && i < elements.count; ++i)
    if (!test(i)) return i;
  return {};
}

bool isFiniteList(const Json& values, std::size_t count) {
  return values.is_array() && values.size() == count &&
         std::all_of(values.begin(), values.end(), [](const Json& value) {
           return value.is_number() && std::isfinite(value.get<double>());
         });
}

struct SplatColumn {
  std::string name;
  Count components;
  bool mayBeInteger;
};

/// Coefficients of a degree of the spherical harmonics.
int coefficients(int degree) { return 2 * degree + 1; }

}  // namespace

void checkFinite(const Json& attributes, const ColumnOf& columnOf, const std::string& where,
                 FindingList& findings) {
  for (const auto& [name, index] : attributes.items()) {
    const Elements* elements = columnOf(name);
    if (!elements || !elements->known || !elements->isFloat() || name == "POSITION") continue;
    const auto wrong = firstFailing(*elements, [&](Count i) {
      for (Count k = 0; k < elements->components; ++k)
        if (!std::isfinite(elements->number(i, k))) return false;
      return true;
    });
    if (wrong)
      findings.error({}, "gltf-finite", fmt::format("{}: {} {} is not finite", where, excerpt(name), *wrong),
                     "drop the vertex");
  }
}

void checkSplats(const Json& primitive, const ColumnOf& columnOf, const std::string& where,
                 FindingList& findings) {
  const Json& extension = member(member(primitive, "extensions"), std::string(kSplats).c_str());
  if (!extension.is_object()) return;
  const auto wrong = [&](std::string message, std::string hint) {
    findings.error({}, "gltf-splats", where + ": " + std::move(message), std::move(hint));
  };
  if (integer(primitive, "mode").value_or(4) != 0) wrong("splats are not drawn as points", "set mode to 0");
  if (primitive.contains("indices"))
    wrong("splats have indices", "leave them out: each splat stands for itself");
  if (!member(extension, "kernel").is_string()) wrong("the splats have no kernel", "write \"ellipse\"");
  const Json& space = member(extension, "colorSpace");
  if (space != "srgb_rec709_display" && space != "lin_rec709_display")
    wrong("the splats have no known colour space", "write srgb_rec709_display or lin_rec709_display");
  // The columns of packed splats have types and counts, but no bytes of their own.
  const bool isPacked = member(extension, "extensions").contains(kPacked);
  std::vector<SplatColumn> columns{
      {"ROTATION", 4, true}, {"SCALE", 3, true}, {"OPACITY", 1, true}, {"SH_DEGREE_0_COEF_0", 3, false}};
  const auto columnAt = [&](const std::string& name) {
    return columnOf(fmt::format("{}:{}", kSplats, name));
  };
  for (int degree = 1; degree <= 3; ++degree) {
    int there = 0;
    for (int k = 0; k < coefficients(degree); ++k) {
      const std::string name = fmt::format("SH_DEGREE_{}_COEF_{}", degree, k);
      if (columnAt(name)) ++there, columns.push_back({name, 3, false});
    }
    const bool hasLower = degree == 1 || columnAt(fmt::format("SH_DEGREE_{}_COEF_0", degree - 1));
    if (there > 0 && (there < coefficients(degree) || !hasLower))
      wrong(fmt::format("the harmonics of degree {} are not complete", degree),
            fmt::format("give all {} coefficients, and those of lower degrees", coefficients(degree)));
  }
  for (const SplatColumn& column : columns) {
    const Elements* elements = columnAt(column.name);
    if (!elements && !isPacked)
      wrong(fmt::format("the splats have no {}", column.name), "the extension demands it");
    if (!elements || !elements->known) continue;
    const bool isQuantised =
        column.mayBeInteger && !elements->isFloat() && (elements->normalized || column.name == "SCALE");
    if (elements->components != column.components || (!elements->isFloat() && !isQuantised))
      wrong(fmt::format("{} is of a wrong type", column.name),
            column.mayBeInteger ? "use floats or normalized integers" : "use floats");
  }
  const Elements *opacity = columnAt("OPACITY"), *scale = columnAt("SCALE"), *rotation = columnAt("ROTATION");
  if (opacity && opacity->known && opacity->components == 1)
    if (const auto i = firstFailing(
            *opacity, [&](Count at) { return opacity->number(at, 0) >= 0 && opacity->number(at, 0) <= 1; }))
      wrong(fmt::format("the opacity of splat {} is {}", *i, opacity->number(*i, 0)), "opacities are 0 to 1");
  if (scale && scale->known && scale->components == 3)
    if (const auto i = firstFailing(*scale, [&](Count at) {
          return scale->number(at, 0) > 0 && scale->number(at, 1) > 0 && scale->number(at, 2) > 0;
        }))
      wrong(fmt::format("splat {} has a scale that is not positive", *i),
            "scales are standard deviations, not their logarithms");
  if (rotation && rotation->known && rotation->components == 4)
    if (const auto i = firstFailing(*rotation, [&](Count at) {
          double square = 0;
          for (Count k = 0; k < 4; ++k) square += rotation->number(at, k) * rotation->number(at, k);
          return std::abs(std::sqrt(square) - 1) <= kUnitTolerance;
        }))
      wrong(fmt::format("the rotation of splat {} is no unit quaternion", *i), "normalise it");
}

void checkPlacement(const Json& node, const std::string& where, FindingList& findings) {
  const auto wrong = [&](std::string message, std::string hint) {
    findings.error({}, "gltf-node", where + std::move(message), std::move(hint));
  };
  if (!node.is_object()) return wrong(" is no object", "write {}");
  bool byParts = false;
  for (const auto& [key, count] : {std::pair{"translation", 3u}, {"rotation", 4u}, {"scale", 3u}}) {
    if (!node.contains(key)) continue;
    byParts = true;
    const Json& values = node[key];
    if (!isFiniteList(values, count)) {
      wrong(fmt::format(": {} is not {} numbers", key, count), "see glTF 2.0, 3.5.3");
      continue;
    }
    double square = 0;
    for (const Json& value : values) square += value.get<double>() * value.get<double>();
    if (std::string_view(key) == "rotation" && std::abs(square - 1) > 0.01)
      wrong(": rotation is no unit quaternion", "normalise it");
  }
  if (!node.contains("matrix")) return;
  if (!isFiniteList(node["matrix"], 16)) wrong(": matrix is not 16 numbers", "see glTF 2.0, 3.5.3");
  if (byParts) wrong(" has a matrix and a translation, rotation or scale", "keep one of both");
}

void checkImage(const Json& image, std::string_view bytes, FindingList& findings) {
  const Json& type = member(image, "mimeType");
  const bool isInFile = member(image, "bufferView").is_number();
  const auto wrong = [&](std::string message, std::string hint) {
    findings.error({}, "gltf-image", std::move(message), std::move(hint));
  };
  if (isInFile == member(image, "uri").is_string())
    return wrong("an image has a bufferView and a uri, or neither", "keep one of both");
  if (!isInFile) return;
  if (!type.is_string())
    return wrong("an image in the file has no mimeType", "write image/png or image/jpeg");
  if (bytes.empty()) return;
  const bool isPng = bytes.starts_with("\x89PNG\r\n\x1a\n"), isJpeg = bytes.starts_with("\xff\xd8\xff"),
             isWebp = bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP");
  const bool fits = type == "image/png"    ? isPng
                    : type == "image/jpeg" ? isJpeg
                    : type == "image/webp" ? isWebp
                                           : true;
  if (!fits)
    wrong("the bytes of an image are not " + type.get<std::string>(), "correct the mimeType or the image");
}

}  // namespace cloudgen::check
