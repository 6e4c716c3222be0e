// SPDX-License-Identifier: Apache-2.0
#include "check/ply/validate_ply.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "check/ply/read_ply.hpp"

namespace cloudgen::check {
namespace {

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// What is wrong with a splat; nothing if it can be drawn.
std::string faultOf(const ReadSplat& splat) {
  bool finite = isFinite(splat.center) && isFinite(splat.color) && std::isfinite(splat.opacity);
  for (const glm::vec3& harmonic : splat.harmonics) finite = finite && isFinite(harmonic);
  if (!finite) return "has numbers that are not finite";
  if (!isFinite(splat.sigma) || !(std::min({splat.sigma.x, splat.sigma.y, splat.sigma.z}) > 0))
    return "has a deviation of no size: scales are natural logarithms";
  if (!(glm::length(splat.rotation) > 1e-6f) || !std::isfinite(glm::length(splat.rotation)))
    return "has no rotation";
  return {};
}

}  // namespace

ValidationResult validatePlyBytes(std::string_view bytes, const std::string& name,
                                  const base::Progress& progress) {
  ValidationResult result;
  result.bytes = bytes.size();
  FindingList findings(name, result);
  try {
    readPlySplats(bytes, name, [&](const ReadSplat& splat) {
      if (result.elements++ % 4096 == 0) progress.step("validate", 0);
      if (findings.full()) return;
      if (const std::string fault = faultOf(splat); !fault.empty())
        findings.error({}, "ply-splats", fmt::format("splat {} {}", result.elements - 1, fault), "leave it out");
    });
  } catch (const base::InputError& error) {
    findings.error({}, "ply-header", "the file " + error.problem(), error.hint());
  }
  result.nodes = result.elements;
  return result;
}

ValidationResult validatePly(const std::filesystem::path& file, const ChosenSchema&,
                             const base::Progress& progress) {
  return validatePlyBytes(base::readFile(file, std::uint64_t{1} << 36), file.string(), progress);
}

}  // namespace cloudgen::check
