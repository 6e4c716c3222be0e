// SPDX-License-Identifier: Apache-2.0
#include "cli/moment_between.hpp"

#include <fmt/format.h>

#include <cmath>

namespace cloudgen::cli {
namespace {

double rounded(double value) { return std::round(value * 1e5) / 1e5; }

}  // namespace

double MomentBetween::share() const {
  return static_cast<double>(at.seconds - from.seconds) / static_cast<double>(to.seconds - from.seconds);
}

std::optional<MomentBetween> momentBetween(const InputLine& input) {
  const auto wanted = base::utcFromIso(input.time);
  if (!wanted) return std::nullopt;
  InputLine first = input;
  first.time = "first";
  const auto times = openInput(first)->info().validTimes;
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    if (times[k].seconds < wanted->seconds && wanted->seconds < times[k + 1].seconds)
      return MomentBetween{times[k], times[k + 1], *wanted};
  return std::nullopt;
}

BetweenFidelity compareBetween(const MomentBetween& moment, const check::WrittenScene& scene, const base::LocalFrame& frame,
                               InputLine input, const base::Progress& progress) {
  BetweenFidelity out{moment};
  for (const bool later : {false, true}) {
    input.time = base::isoText(later ? moment.to : moment.from);
    const auto source = openInput(input);
    const check::Fidelity fidelity = check::compareWithModel(scene, frame, *source, nullptr, {}, progress);
    // Biases are linear in the model's means: so is the bias against what is between.
    const double weight = later ? moment.share() : 1 - moment.share();
    out.file = fidelity.file, out.format = fidelity.format;
    out.total += weight * fidelity.cover.total.bias;
    for (std::size_t range = 0; range < check::kRanges; ++range) out.in[range] += weight * fidelity.cover.in[range].bias;
    out.modelOpticalDepth += weight * fidelity.opticalDepth.modelMean;
    out.sceneOpticalDepth += weight * fidelity.opticalDepth.sceneMean;
  }
  return out;
}

nlohmann::ordered_json betweenJson(const BetweenFidelity& fidelity) {
  const MomentBetween& moment = fidelity.moment;
  const double depth = fidelity.modelOpticalDepth;
  return {{"passed", fidelity.passed()},
          {"read", {{"file", fidelity.file}, {"format", fidelity.format}}},
          {"between", {{"from", base::isoText(moment.from)}, {"to", base::isoText(moment.to)}, {"at", base::isoText(moment.at)}}},
          {"cover",
           {{"total", {{"bias", rounded(fidelity.total)}}},
            {"low", {{"bias", rounded(fidelity.in[0])}}},
            {"middle", {{"bias", rounded(fidelity.in[1])}}},
            {"high", {{"bias", rounded(fidelity.in[2])}}}}},
          {"optical_depth",
           {{"model_mean", rounded(depth)},
            {"scene_mean", rounded(fidelity.sceneOpticalDepth)},
            {"bias_relative", depth > 0 ? rounded(fidelity.sceneOpticalDepth / depth - 1) : 0}}},
          {"tolerances", {{"cover_bias", BetweenFidelity::kTolerance}}}};
}

std::string betweenText(const BetweenFidelity& fidelity) {
  const MomentBetween& moment = fidelity.moment;
  return fmt::format(
      "{} at {}, against the model between {} and {}\n"
      "  cover           bias {:+.3f}   low {:+.3f}   middle {:+.3f}   high {:+.3f}{}\n"
      "  optical depth   {:.2f}, model {:.2f}\n",
      fidelity.file, base::isoText(moment.at), base::isoText(moment.from), base::isoText(moment.to), fidelity.total,
      fidelity.in[0], fidelity.in[1], fidelity.in[2], fidelity.passed() ? "" : "   <- out of tolerance",
      fidelity.sceneOpticalDepth, fidelity.modelOpticalDepth);
}

}  // namespace cloudgen::cli
