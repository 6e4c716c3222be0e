// SPDX-License-Identifier: Apache-2.0
#include "input/weather_code/weather_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/frame.hpp"
#include "input/point/point_source.hpp"
#include "input/point/valid_time.hpp"

namespace cloudgen::input {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
constexpr double kReachMeters = 60'000, kLeastCover = 0.005;

/// The sky of a place at the time that is built.
struct CodedSky {
  field::GeoPoint point;
  double surfaceMeters = 0;
  std::vector<CodedLayer> layers;
};

/// Places without coordinates take the user's; those at the same point are joined.
std::vector<CodedPlace> located(std::vector<CodedPlace> places, const OpenOptions& options) {
  std::map<std::pair<double, double>, CodedPlace> joined;
  for (CodedPlace& place : places) {
    if (!place.point) {
      if (!options.place)
        throw base::InputError(place.name, "does not say where it is (lat, lon)",
                               "give --at LON,LAT[,ELEVATION]");
      place.point = {options.place->longitudeDegrees, options.place->latitudeDegrees};
      if (!place.elevationMeters) place.elevationMeters = options.place->elevationMeters;
    }
    place.point->longitudeDegrees = base::wrappedLongitude(place.point->longitudeDegrees);
    const auto [known, isNew] =
        joined.try_emplace({place.point->longitudeDegrees, place.point->latitudeDegrees}, place);
    if (isNew) continue;
    known->second.hours.insert(known->second.hours.end(), place.hours.begin(), place.hours.end());
    if (!known->second.elevationMeters) known->second.elevationMeters = place.elevationMeters;
  }
  std::vector<CodedPlace> out;
  for (auto& [point, place] : joined) out.push_back(std::move(place));
  return out;
}

double usualTemperatureC(int kind) { return kind == 2 ? -3.0 : (kind == 1 ? 1.0 : 15.0); }

CodedSky skyOf(const CodedPlace& place, const CodedHour& hour) {
  Air air;
  air.latitudeDegrees = place.point->latitudeDegrees;
  air.surfaceMeters = place.elevationMeters.value_or(0.0);
  air.temperatureC = hour.temperatureC.value_or(usualTemperatureC(hour.symbol.kind));
  air.windFromDegrees = hour.windFromDegrees.value_or(0.0);
  air.windSpeed = hour.windFromDegrees ? hour.windSpeed.value_or(0.0) : 0.0;
  const double dewPoint = hour.dewPointC && hour.temperatureC
                              ? *hour.dewPointC
                              : dewPointC(air.temperatureC, usualHumidity(hour.symbol));
  return {*place.point, air.surfaceMeters,
          layersOf(hour.symbol, air, condensationMeters(air.temperatureC, dewPoint))};
}

/// Adds `weight` times the layer to a mean in the making; what is not a cover or a count weighs by cover.
struct Mean {
  double cover = 0, count = 0;
  std::array<double, 9> sums{};
  field::StatedLayer first;

  static auto members() {
    using L = field::StatedLayer;
    return std::array{&L::baseMeters, &L::topMeters, &L::opticalDepth, &L::iceShare,     &L::windEast,
                      &L::windNorth,  &L::shearEast, &L::shearNorth,   &L::spacingMeters};
  }
  void add(const field::StatedLayer& layer, double weight) {
    if (cover == 0) first = layer;
    cover += weight * layer.coverFraction;
    count += weight * layer.cloudCount;
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += weight * layer.coverFraction * static_cast<double>(layer.*members()[i]);
  }
  /// Nothing where next to nothing of it is there.
  std::optional<field::StatedLayer> layer() const {
    if (cover < kLeastCover) return std::nullopt;
    field::StatedLayer mean = first;
    mean.coverFraction = static_cast<float>(std::min(cover, 1.0));
    mean.cloudCount = static_cast<int>(std::lround(count));
    if (first.cloudCount > 0 && mean.cloudCount == 0) return std::nullopt;
    for (std::size_t i = 0; i < sums.size(); ++i) mean.*members()[i] = static_cast<float>(sums[i] / cover);
    return mean;
  }
};

struct Blend {
  std::vector<field::StatedLayer> layers;  ///< upwards
  float surfaceMeters = 0;
};

/// The sky between places. Heights are averaged above ground.
Blend blended(const std::vector<CodedSky>& skies, const std::vector<Near>& near) {
  double all = 0;
  std::vector<double> weights;
  for (const Near& place : near) {
    weights.push_back(1.0 / std::pow(std::max(place.meters, 100.0), 2.0));
    all += weights.back();
  }
  std::array<Mean, kPartCount> means;
  double surface = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const CodedSky& sky = skies[near[i].point];
    surface += weights[i] / all * sky.surfaceMeters;
    for (CodedLayer coded : sky.layers) {
      coded.layer.baseMeters -= static_cast<float>(sky.surfaceMeters);
      coded.layer.topMeters -= static_cast<float>(sky.surfaceMeters);
      means[static_cast<std::size_t>(coded.part)].add(coded.layer, weights[i] / all);
    }
  }
  Blend out{{}, static_cast<float>(surface)};
  std::vector<field::StatedLayer>& layers = out.layers;
  for (const Mean& mean : means)
    if (auto layer = mean.layer()) {
      layer->baseMeters += out.surfaceMeters;
      layer->topMeters += out.surfaceMeters;
      layers.push_back(*layer);
    }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const auto& a, const auto& b) { return a.baseMeters < b.baseMeters; });
  return out;
}

/// What the places tell and what not, for inspect.
void describe(field::SourceInfo& info, const std::vector<CodedPlace>& places,
              const std::vector<const CodedHour*>& chosen) {
  std::set<std::string> codes;
  bool temperature = true, dewPoint = true, wind = true, elevation = true;
  for (std::size_t i = 0; i < places.size(); ++i) {
    elevation = elevation && places[i].elevationMeters;
    if (!chosen[i]) continue;
    const Symbol& symbol = chosen[i]->symbol;
    codes.insert(fmt::format("{}{}{}{}", symbol.night ? 'n' : 'd', symbol.cloudiness, symbol.precipitation,
                             symbol.kind));
    temperature = temperature && chosen[i]->temperatureC;
    dewPoint = dewPoint && chosen[i]->dewPointC && chosen[i]->temperatureC;
    wind = wind && chosen[i]->windFromDegrees && chosen[i]->windSpeed;
  }
  info.fields.push_back(fmt::format("weather symbol: {} at {} place{} (counts, genera and covers of clouds)",
                                    fmt::join(codes, " "), places.size(), places.size() == 1 ? "" : "s"));
  if (temperature) info.fields.push_back("temperature: base, heights of altostratus and cirrus");
  if (dewPoint)
    info.fields.push_back("dew point, humidity or a day's minimum: base, 125 m a degree of spread");
  if (wind) info.fields.push_back("wind at 10 m: by the power law (1/7) at cloud level");
  if (!temperature) info.missing.push_back("temperature: 15 C is taken, 1 C with sleet, -3 C with snow");
  if (!dewPoint) info.missing.push_back("humidity: the usual one of the weather symbol is taken");
  if (!wind) info.missing.push_back("wind: the clouds stand still");
  if (!elevation) info.missing.push_back("elevation: sea level is taken (--at LON,LAT,ELEVATION)");
}

}  // namespace

bool isWeatherCode(std::string_view firstBytes) {
  const std::size_t first = firstBytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string_view::npos || (firstBytes[first] != '{' && firstBytes[first] != '[')) return false;
  const auto has = [&](std::string_view text) { return firstBytes.find(text) != std::string_view::npos; };
  if (has("\"cloudgen_sky\"") || !(has("\"weather\"") || has("\"forecast\"") || has("\"current\"")))
    return false;
  return has("\"s\"") || has("\"symbol\"");
}

std::unique_ptr<field::Source> skyOfPlaces(std::vector<CodedPlace> given,
                                           const std::vector<std::string>& files,
                                           const OpenOptions& options) {
  const std::vector<CodedPlace> places = located(std::move(given), options);
  field::SourceInfo info;
  info.files = files;
  info.format = "weather codes (JSON)";
  info.model = "Foreca weather symbols";
  for (const CodedPlace& place : places)
    for (const CodedHour& hour : place.hours) info.validTimes.push_back(hour.time);
  info.validTimes = ascending(std::move(info.validTimes));
  info.validTime = options.time.value_or(info.validTimes.front());
  if (!std::binary_search(info.validTimes.begin(), info.validTimes.end(), info.validTime))
    failForTime(files.front(), info.validTime, info.validTimes);

  std::vector<CodedSky> skies;
  std::vector<field::GeoPoint> points;
  std::vector<const CodedHour*> chosen;
  for (const CodedPlace& place : places) {
    const auto hour = std::find_if(place.hours.begin(), place.hours.end(),
                                   [&](const CodedHour& each) { return each.time == info.validTime; });
    chosen.push_back(hour == place.hours.end() ? nullptr : &*hour);
    if (!chosen.back()) continue;
    skies.push_back(skyOf(place, *hour));
    points.push_back(skies.back().point);
  }
  if (points.size() < places.size())
    info.warnings.push_back({"place_without_time",
                             fmt::format("{} of {} places have nothing for {}", places.size() - points.size(),
                                         places.size(), base::isoText(info.validTime))});
  describe(info, places, chosen);

  const field::Grid grid = latticeOver(points, kSkySideMeters);
  const auto near = pointsNear(grid, points, kReachMeters);
  double meanSurface = 0;
  for (const CodedSky& sky : skies) meanSurface += sky.surfaceMeters / static_cast<double>(skies.size());
  std::vector<float> surface(grid.size(), static_cast<float>(meanSurface));
  std::vector<field::StatedLayer> layers;
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
    if (near[cell].empty()) continue;
    const Blend sky = blended(skies, near[cell]);
    surface[cell] = sky.surfaceMeters;
    for (field::StatedLayer layer : sky.layers) {
      layer.cell = cell;
      layers.push_back(layer);
    }
  }
  return std::make_unique<PointSource>(std::move(info), grid, std::move(layers), std::move(surface));
}

std::unique_ptr<field::Source> openWeatherCode(const std::vector<std::filesystem::path>& files,
                                               const OpenOptions& options) {
  std::vector<CodedPlace> places;
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) {
    names.push_back(file.string());
    for (CodedPlace& place : readForecaJson(base::readFile(file, kMostBytes), names.back()))
      places.push_back(std::move(place));
  }
  return skyOfPlaces(std::move(places), names, options);
}

}  // namespace cloudgen::input
