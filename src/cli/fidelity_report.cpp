// SPDX-License-Identifier: Apache-2.0
#include "cli/fidelity_report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace cloudgen::cli {
namespace {

using check::Fidelity;
using check::Score;
using nlohmann::ordered_json;

constexpr std::array<const char*, check::kRanges> kRangeNames{"low", "middle", "high"};

double rounded(double value, double perUnit) { return std::round(value * perUnit) / perUnit; }

ordered_json coverOf(const Score& score) {
  return {{"bias", rounded(score.bias, 1e5)}, {"rmse", rounded(score.rmse, 1e5)}};
}

ordered_json coversOf(const check::CoverScores& scores) {
  ordered_json covers{{"total", coverOf(scores.total)}};
  for (std::size_t range = 0; range < check::kRanges; ++range)
    covers[kRangeNames[range]] = coverOf(scores.in[range]);
  return covers;
}

ordered_json populatedOf(const Fidelity& fidelity) {
  ordered_json covers = coversOf(fidelity.populatedCover);
  covers["columns"] = fidelity.populatedCover.total.columns;
  return covers;
}

ordered_json heightOf(const Score& score) {
  if (score.columns == 0) return {{"bias", nullptr}, {"rmse", nullptr}, {"columns", 0}};
  return {{"bias", rounded(score.bias, 10)}, {"rmse", rounded(score.rmse, 10)}, {"columns", score.columns}};
}

ordered_json worstOf(const Fidelity& fidelity) {
  ordered_json all = ordered_json::object();
  for (const check::WorstColumns& worst : fidelity.worst) {
    all[worst.measure] = ordered_json::array();
    for (const check::WorstColumn& column : worst.columns)
      all[worst.measure].push_back({{"longitude", rounded(column.longitudeDegrees, 1e4)},
                                    {"latitude", rounded(column.latitudeDegrees, 1e4)},
                                    {"model", rounded(column.model, 1e4)},
                                    {"scene", rounded(column.scene, 1e4)}});
  }
  return all;
}

ordered_json tolerancesOf(const Fidelity& fidelity, const check::Tolerances& tolerances) {
  return {{"cover_bias", tolerances.coverBias},
          {"cover_rmse", tolerances.coverRmse},
          {"populated_cover_rmse", tolerances.populatedCoverRmse},
          {"optical_depth_bias_relative", tolerances.opticalDepthBias},
          {"optical_depth_correlation", tolerances.opticalDepthCorrelation},
          {"base_and_top_rmse_m", rounded(fidelity.heightTolerance, 10)},
          {"slanted_optical_depth", tolerances.slantedOpticalDepth},
          {"slanted_cover", tolerances.slantedCover},
          {"genus_agreement", tolerances.genusAgreement}};
}

ordered_json slantedOf(const check::Slants& slants) {
  const auto viewOf = [](const check::SlantedView& view) {
    return ordered_json{{"zenith_degrees", view.zenithDegrees},
                        {"cover", rounded(view.cover, 1e4)},
                        {"optical_depth", rounded(view.opticalDepth, 1e4)},
                        {"optical_depth_error", rounded(view.opticalDepthError, 1e4)}};
  };
  ordered_json views = ordered_json::array({viewOf(slants.vertical)});
  for (const check::SlantedView& view : slants.slanted) views.push_back(viewOf(view));
  return {{"views", std::move(views)}, {"rays", slants.rays}, {"judged", slants.volumes}};
}

/// Means over the cameras, in octas.
struct SkyAmount {
  double scene = 0, model = 0;
};

SkyAmount skyAmountOf(const std::vector<check::SkyReport>& reports) {
  SkyAmount amount;
  for (const check::SkyReport& report : reports) {
    amount.scene += 8 * report.skyCover / static_cast<double>(reports.size());
    amount.model += 8 * report.modelCover / static_cast<double>(reports.size());
  }
  return amount;
}

ordered_json skyOf(const std::vector<check::SkyReport>& reports) {
  const SkyAmount amount = skyAmountOf(reports);
  ordered_json places = ordered_json::array();
  for (const check::SkyReport& report : reports)
    places.push_back({{"longitude", rounded(report.longitudeDegrees, 1e4)},
                      {"latitude", rounded(report.latitudeDegrees, 1e4)},
                      {"octas", check::octasOf(report.skyCover)},
                      {"model_octas", check::octasOf(report.modelCover)}});
  return {{"bias_octas", rounded(amount.scene - amount.model, 100)},
          {"zenith_degrees", check::kSkyZenithDegrees},
          {"cameras", std::move(places)}};
}

std::string line(const std::string& name, const std::string& text, bool broken) {
  return fmt::format("  {:<15} {}{}\n", name, text, broken ? "   <- out of tolerance" : "");
}

bool isBroken(const Fidelity& fidelity, const std::string& prefix) {
  for (const check::Breach& breach : fidelity.breaches)
    if (breach.measure.starts_with(prefix)) return true;
  return false;
}

std::string heightText(const Score& score) {
  if (score.columns == 0) return "nothing to compare";
  return fmt::format("bias {:+.0f} m   rmse {:.0f} m   ({} columns)", score.bias, score.rmse, score.columns);
}

std::string coverText(const Score& score) {
  return fmt::format("bias {:+.3f}   rmse {:.3f}", score.bias, score.rmse);
}

std::string populatedText(const check::CoverScores& scores) {
  if (scores.total.columns == 0) return "no column has 100 clouds or a full sheet";
  return fmt::format("{}   ({} columns of 100 clouds or a full sheet)", coverText(scores.total),
                     scores.total.columns);
}

std::string slantedText(const check::Slants& slants) {
  std::string text;
  for (const check::SlantedView& view : slants.slanted)
    text += fmt::format(
        "{}{:.0f} deg: cover {:+.3f}, optical depth {:+.1f} %", text.empty() ? "" : "   ", view.zenithDegrees,
        view.cover - slants.vertical.cover,
        slants.vertical.opticalDepth > 0 ? 100 * (view.opticalDepth / slants.vertical.opticalDepth - 1) : 0);
  return text + (slants.volumes ? "" : "   (cards: not judged)");
}

std::string groundText(const std::vector<check::SkyReport>& reports) {
  const SkyAmount amount = skyAmountOf(reports);
  return fmt::format("{:.1f} octas of {} cameras, model {:.1f}", amount.scene, reports.size(), amount.model);
}

std::string worstText(const Fidelity& fidelity) {
  std::string text = "  worst column\n";
  for (const check::WorstColumns& worst : fidelity.worst) {
    if (worst.columns.empty()) continue;
    const check::WorstColumn& column = worst.columns.front();
    text += fmt::format("    {:<13} {:.2f}, {:.2f}: model {:.{}f}, scene {:.{}f}\n", worst.measure,
                        column.longitudeDegrees, column.latitudeDegrees, column.model,
                        worst.measure.ends_with("_m") ? 0 : 2, column.scene,
                        worst.measure.ends_with("_m") ? 0 : 2);
  }
  return text;
}

}  // namespace

ordered_json fidelityJson(const Fidelity& fidelity, const check::Tolerances& tolerances) {
  ordered_json json;
  json["passed"] = fidelity.breaches.empty();
  json["read"] = {{"file", fidelity.file},
                  {"format", fidelity.format},
                  {"blobs", fidelity.footprints},
                  {"saturated", fidelity.saturated}};
  json["columns"] = fidelity.columns.size();
  ordered_json cover = coversOf(fidelity.cover);
  cover["populated"] = populatedOf(fidelity);
  json["cover"] = std::move(cover);
  const check::OpticalDepthScore& depth = fidelity.opticalDepth;
  json["optical_depth"] = {{"model_mean", rounded(depth.modelMean, 1e4)},
                           {"scene_mean", rounded(depth.sceneMean, 1e4)},
                           {"bias_relative", rounded(depth.biasRelative, 1e5)},
                           {"correlation", depth.correlation ? ordered_json(rounded(*depth.correlation, 1e5))
                                                             : ordered_json(nullptr)}};
  json["base_m"] = heightOf(fidelity.base);
  json["top_m"] = heightOf(fidelity.top);
  const auto agreement = fidelity.genus.agreement();
  json["genus"] = {{"agreement", agreement ? ordered_json(rounded(*agreement, 1e6)) : ordered_json(nullptr)},
                   {"clouds", fidelity.genus.clouds}};
  json["slanted"] = slantedOf(fidelity.slants);
  json["from_the_ground"] = skyOf(fidelity.skyReports);
  json["worst"] = worstOf(fidelity);
  json["instrument"] = {{"rays_across_a_column", fidelity.raysAcross},
                        {"cloudy_optical_depth", check::kCloudyOpticalDepth},
                        {"low_below_m", check::kRangeBorders[0]},
                        {"high_from_m", check::kRangeBorders[1]},
                        {"base_and_top_share", check::kBorderShare},
                        {"populated_clouds", check::kPopulatedClouds},
                        {"full_sheet_cover", check::kFullSheet},
                        {"overlap", "maximum within a layer, exponential-random between layers"}};
  json["tolerances"] = tolerancesOf(fidelity, tolerances);
  json["broken"] = ordered_json::array();
  for (const check::Breach& breach : fidelity.breaches)
    json["broken"].push_back({{"measure", breach.measure},
                              {"value", rounded(breach.value, 1e5)},
                              {"tolerated", rounded(breach.tolerated, 1e5)}});
  return json;
}

std::string fidelityText(const Fidelity& fidelity, const check::Tolerances& tolerances) {
  std::string text = fmt::format(
      "{}: {} blobs over {} model columns: {}\n", fidelity.file, fidelity.footprints, fidelity.columns.size(),
      fidelity.breaches.empty() ? "the sky matches the model" : "the sky does not match the model");
  text += line("cover", coverText(fidelity.cover.total), isBroken(fidelity, "cover.total"));
  for (std::size_t range = 0; range < check::kRanges; ++range)
    text += line(fmt::format("  {}", kRangeNames[range]), coverText(fidelity.cover.in[range]),
                 isBroken(fidelity, fmt::format("cover.{}", kRangeNames[range])));
  text += line("  populated", populatedText(fidelity.populatedCover), isBroken(fidelity, "cover.populated"));
  const check::OpticalDepthScore& depth = fidelity.opticalDepth;
  text += line(
      "optical depth",
      fmt::format("bias {:+.1f} %   correlation {}   (mean {:.2f}, model {:.2f})", 100 * depth.biasRelative,
                  depth.correlation ? fmt::format("{:.3f}", *depth.correlation) : "-", depth.sceneMean,
                  depth.modelMean),
      isBroken(fidelity, "optical_depth"));
  text += line("base", heightText(fidelity.base), isBroken(fidelity, "base_m"));
  text += line("top", heightText(fidelity.top), isBroken(fidelity, "top_m"));
  const auto agreement = fidelity.genus.agreement();
  text += line("genus",
               agreement ? fmt::format("{:.1f} % of {} clouds", 100 * *agreement, fidelity.genus.clouds)
                         : "nothing to compare: the input states none, or the format names no clouds",
               isBroken(fidelity, "genus"));
  text += line("aslant", slantedText(fidelity.slants), isBroken(fidelity, "slanted"));
  text += line("from the ground", groundText(fidelity.skyReports), false);
  text += worstText(fidelity);
  text += fmt::format(
      "  tolerated: cover {} bias, {} rmse ({} populated); optical depth {:.0f} %, correlation {}; heights "
      "{:.0f} m",
      tolerances.coverBias, tolerances.coverRmse, tolerances.populatedCoverRmse,
      100 * tolerances.opticalDepthBias, tolerances.opticalDepthCorrelation, fidelity.heightTolerance);
  if (fidelity.saturated > 0)
    text += fmt::format("\n  {} blobs are as opaque as can be written: their optical depth is a lower bound",
                        fidelity.saturated);
  return text;
}

}  // namespace cloudgen::cli
