// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "field/source.hpp"
#include "input/point/air.hpp"

namespace cloudgen::input {

/// A Foreca weather symbol: letter d or n and three digits.
struct Symbol {
  bool night = false;
  int cloudiness = 0;  ///< 0 clear, 1 almost clear, 2 half cloudy, 3 broken, 4 overcast, 5 thin high, 6 fog
  int precipitation = 0;  ///< 0 none, 1 slight, 2 showers, 3 precipitation, 4 thunder
  int kind = 0;           ///< 0 rain, 1 sleet, 2 snow
};

/// Nothing if it is no such code.
std::optional<Symbol> symbolFrom(std::string_view text);

/// Side of the sky that a code tells, metres. The thesis's counts fix it: 10, 30, 75 and 200 clouds are to
/// cover about 1, 3 and 7 tenths and all of it, so a cumulus takes a hundredth; 2.25 km of width, usual for
/// cumulus mediocris, then makes 20 km. An observer amid it sees clouds at 1 km down to 6 degrees.
inline constexpr double kSkySideMeters = 20'000;

/// What a layer is in its sky; layers of one part are blended between places.
enum class Part { Fog, Heaps, Congestus, Storm, Rolls, RainDeck, Veil, HighVeil, Filaments };
inline constexpr int kPartCount = 9;

struct CodedLayer {
  Part part{};
  field::StatedLayer layer;
};

/// The layers of a code (LTH thesis; the rest are this project's rules):
/// - low clouds: 10 cumuli (almost clear), 30 (half cloudy), 75 cumuli and stratocumuli (broken), 200
///   stratocumuli, clustered (overcast); the first two keep 2.7 km apart, 1.2 times their width;
/// - above them at most 2 altostrati (at -10 C) and, highest, at most 2 cirri (at -40 C);
/// - 5: cirrostratus with 2 cirri; 6: fog;
/// - thunder: one of the low clouds is a cumulonimbus, another tenth congestus; showers, and slight
///   precipitation under less than overcast: a tenth congestus; precipitation, and slight under overcast:
///   nimbostratus in place of the low clouds;
/// - night: the same clouds.
/// Base: `condensationMetersAboveGround`. Precipitation without a low cloud to fall from takes half cloudy.
std::vector<CodedLayer> layersOf(const Symbol& symbol, const Air& air, double condensationMetersAboveGround);

/// Relative humidity at the surface that a code stands for where the report gives neither dew point nor
/// humidity: 0.6 under at most half cloudy, 0.7 broken, 0.8 overcast, 0.9 with precipitation, 1 in fog; 0.1
/// more at night, at most 0.95. With the temperature it sets the base.
double usualHumidity(const Symbol& symbol);

}  // namespace cloudgen::input
