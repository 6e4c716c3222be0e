// SPDX-License-Identifier: Apache-2.0
#include "input/weather_code/symbol.hpp"

#include <algorithm>
#include <array>

namespace cloudgen::input {
namespace {

using base::Genus;

constexpr std::array<int, 7> kLowClouds{0, 10, 30, 75, 200, 0, 0};
constexpr std::array<double, 7> kCover{0, 0.1, 0.3, 0.75, 1, 0, 0};
constexpr double kHeapCover = 0.01;  // of one cumulus, see kSkySideMeters
constexpr float kHeapSpacingMeters = 2700;
// Sheets whose elements are as wide as the sky are told by so many, lest chance leave them out.
constexpr int kSheetElements = 4;

/// Gathers the layers of one sky.
class Builder {
 public:
  Builder(const Air& air, double condensation) : air_(air), base_(air.surfaceMeters + condensation) {}

  void add(Part part, Genus genus, int count, double cover, double base, double top, float spacing = 0) {
    if (cover <= 0) return;
    CodedLayer coded{part, layerOf(air_, genus, cover, base, top)};
    coded.layer.cloudCount = count;
    coded.layer.spacingMeters = spacing;
    layers_.push_back(coded);
  }

  void heaps(int count, double coverOfOne, double depth, float spacing) {
    add(Part::Heaps, Genus::Cumulus, count, count * coverOfOne, base_, base_ + depth, spacing);
  }
  void congestus(int count) {
    add(Part::Congestus, Genus::Cumulus, count, count * 2 * kHeapCover, base_, base_ + 4000);
  }
  void storm() { add(Part::Storm, Genus::Cumulonimbus, 1, 0.3, base_, stormTopMeters(air_, base_)); }
  void rolls(int count, double cover, double lift) {
    add(Part::Rolls, Genus::Stratocumulus, count, cover, base_ + lift, base_ + lift + 450);
  }
  void rainDeck(double cover) {
    const double top = std::clamp(heightOfMeters(air_, -20), base_ + 2000, base_ + 6000);
    add(Part::RainDeck, Genus::Nimbostratus, kSheetElements, cover, base_, top);
  }
  /// Above the heaps and decks, not above towers: those grow through.
  void veil(int count, double cover) {
    const double lowest = air_.surfaceMeters + kMiddleEtageMeters,
                 highest = air_.surfaceMeters + highEtageMeters(air_.latitudeDegrees) - 1000;
    const double base = std::max(std::clamp(heightOfMeters(air_, -10), lowest, highest), base_ + 2200);
    add(Part::Veil, Genus::Altostratus, count, cover, base, base + 1200);
  }
  void filaments(int count, double cover) {
    const double base = highBase();
    add(Part::Filaments, Genus::Cirrus, count, cover, base, base + 1000);
  }
  void highVeil(double cover) {
    const double base = highBase();
    add(Part::HighVeil, Genus::Cirrostratus, kSheetElements, cover, base - 1200, base - 200);
  }
  void fog() { add(Part::Fog, Genus::Fog, 0, 1, air_.surfaceMeters, air_.surfaceMeters + 200); }

  std::vector<CodedLayer> upwards() {
    std::stable_sort(layers_.begin(), layers_.end(), [](const CodedLayer& a, const CodedLayer& b) {
      return a.layer.baseMeters < b.layer.baseMeters;
    });
    return std::move(layers_);
  }

 private:
  double highBase() const {
    const double lowest = air_.surfaceMeters + highEtageMeters(air_.latitudeDegrees),
                 highest = std::max(lowest, tropopauseMeters(air_.latitudeDegrees) - 1500);
    return std::max(std::clamp(heightOfMeters(air_, -40), lowest, highest), base_ + 4500);
  }

  const Air& air_;
  double base_;
  std::vector<CodedLayer> layers_;
};

}  // namespace

std::optional<Symbol> symbolFrom(std::string_view text) {
  if (text.size() != 4 || (text[0] != 'd' && text[0] != 'n')) return std::nullopt;
  const auto digit = [&](std::size_t at, int most) { return text[at] >= '0' && text[at] <= '0' + most; };
  if (!digit(1, 6) || !digit(2, 4) || !digit(3, 2)) return std::nullopt;
  return Symbol{text[0] == 'n', text[1] - '0', text[2] - '0', text[3] - '0'};
}

std::vector<CodedLayer> layersOf(const Symbol& symbol, const Air& air, double condensationMetersAboveGround) {
  Builder sky(air, condensationMetersAboveGround);
  int cloudiness = symbol.cloudiness;
  if (symbol.precipitation > 0 && (kLowClouds[static_cast<std::size_t>(cloudiness)] == 0 && cloudiness != 6))
    cloudiness = 2;
  const bool overcast = cloudiness == 4;
  const bool steady = symbol.precipitation == 3 || (symbol.precipitation == 1 && overcast);
  const bool thunder = symbol.precipitation == 4, showers = symbol.precipitation > 0 && !steady;
  const int count = kLowClouds[static_cast<std::size_t>(cloudiness)];
  if (cloudiness == 6) sky.fog();
  if (cloudiness == 5) {
    sky.highVeil(0.9);
    sky.filaments(2, 0.3);
  }
  if (count == 0) return sky.upwards();
  if (steady) {
    sky.rainDeck(kCover[static_cast<std::size_t>(cloudiness)]);
    return sky.upwards();
  }
  const int storms = thunder ? 1 : 0, towers = showers ? std::max(1, std::min(count, 100) / 10) : 0;
  const int others = count - storms - towers;
  if (thunder) sky.storm();
  sky.congestus(towers);
  switch (cloudiness) {
    case 1:
      sky.heaps(others, kHeapCover, 1100, kHeapSpacingMeters);
      break;
    case 2:
      sky.heaps(others, kHeapCover, 1500, kHeapSpacingMeters);
      sky.filaments(1, 0.12);
      break;
    case 3: {
      const int rolls = 2 * others / 5;
      sky.heaps(others - rolls, 0.6 * kHeapCover, 1500, 0);
      sky.rolls(rolls, 0.55, 500);
      sky.veil(1, 0.2);
      sky.filaments(2, 0.25);
      break;
    }
    default:
      sky.rolls(others, 1, 0);
      sky.veil(2, 0.5);
      sky.filaments(2, 0.25);
  }
  return sky.upwards();
}

double usualHumidity(const Symbol& symbol) {
  if (symbol.cloudiness == 6) return 1;
  double humidity = symbol.cloudiness == 3 ? 0.7 : (symbol.cloudiness == 4 ? 0.8 : 0.6);
  if (symbol.precipitation > 0) humidity = 0.9;
  return std::min(0.95, humidity + (symbol.night ? 0.1 : 0.0));
}

}  // namespace cloudgen::input
