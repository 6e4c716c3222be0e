// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/model/model_field.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input::model {

/// What the clouds of a model are taken from.
enum class Basis {
  Water,     ///< cloud water on levels
  Humidity,  ///< relative or specific humidity on levels
  Cover      ///< cover on single levels
};

struct ChosenLevel {
  Vertical vertical;
  std::map<field::Quantity, Field> fields;
};

/// The fields of one time, member, grid and kind of level.
struct Choice {
  Basis basis{};
  std::optional<base::UtcTime> run;
  base::UtcTime valid;
  std::vector<base::UtcTime> validTimes;
  std::size_t grid = 0;
  std::vector<ChosenLevel> levels;  ///< from the ground upwards
  std::map<Single, Field> singles;  ///< that clouds or ground are taken from
  std::vector<std::string> unused;  ///< other fields of the choice, one line each
  std::vector<field::Warning> warnings;

  bool has(field::Quantity quantity) const;
  bool has(SingleKind kind, CloudPart part = CloudPart::Total) const;
};

/// Chooses among all fields of the files. Throws InputError where nothing is about clouds, or the wanted time
/// is not there.
Choice choose(const Contents& contents, const OpenOptions& options);

/// "cloud condensate: clwmr on 21 pressure levels, 1000 to 100 hPa": one line a quantity.
std::vector<std::string> fieldLines(const Choice& choice);

/// "low cloud base pressure".
std::string singleName(const Single& single);

/// What is not in the files and how it will be made, one line each.
std::vector<std::string> missingLines(const Choice& choice);

/// The levels that clouds are taken from.
field::LevelList levelList(const Choice& choice);

}  // namespace cloudgen::input::model
