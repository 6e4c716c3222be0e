// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/vertical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "input/netcdf/units.hpp"

namespace cloudgen::input::netcdf {
namespace {

using model::Vertical;
using model::VerticalKind;
using Warnings = std::vector<field::Warning>;

constexpr std::size_t kMostLevels = 10000;
constexpr double kStandardPa = 100000;

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// "a: hyam b: hybm ps: aps" by term.
std::map<std::string, std::string> termsOf(const Variable& variable) {
  std::map<std::string, std::string> terms;
  std::istringstream words(variable.text("formula_terms"));
  for (std::string term, name; words >> term >> name;) {
    if (term.empty() || term.back() != ':') break;
    term.pop_back();
    terms[lowerCase(term)] = name;
  }
  return terms;
}

class Reading {
 public:
  Reading(const File& file, std::size_t count, Warnings& warnings)
      : file_(file), count_(count), warnings_(warnings) {}

  Levels of(const Variable* coordinate) {
    if (!coordinate) return numbered({});
    const std::vector<double> values = file_.values(*coordinate);
    const std::string standard = lowerCase(coordinate->text("standard_name"));
    if (standard.starts_with("atmosphere_") || coordinate->attributes.contains("formula_terms"))
      if (auto levels = parametric(*coordinate, standard, values)) return *levels;
    if (auto levels = physical(*coordinate, standard, values)) return *levels;
    return numbered(values);
  }

 private:
  static Levels inOrder(VerticalKind kind, const std::vector<double>& values, const Conversion& toSi = {}) {
    Levels levels;
    for (const double value : values)
      levels.levels.push_back({kind, value * toSi.factor + toSi.offset, 0, 0});
    return levels;
  }

  std::optional<Levels> physical(const Variable& coordinate, const std::string& standard,
                                 const std::vector<double>& values) {
    const std::string name = lowerCase(coordinate.name), unit = coordinate.text("units");
    if (std::any_of(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }))
      return std::nullopt;
    if (const auto toPa = conversion(unit, "Pa")) return inOrder(VerticalKind::Pressure, values, *toPa);
    if (const auto toMeters = conversion(unit, "m")) {
      if (lowerCase(coordinate.text("positive")) == "down") return std::nullopt;
      const bool ground = standard == "height" || name.find("ground") != std::string::npos ||
                          (standard.empty() && (name == "height" || name == "height_2m"));
      return inOrder(ground ? VerticalKind::HeightAboveGround : VerticalKind::HeightAboveSea, values,
                     *toMeters);
    }
    const bool numbers = isCounted(values) || name.find("model") != std::string::npos ||
                         name.find("hybrid") != std::string::npos || standard == "model_level_number";
    if (standard == "atmosphere_sigma_coordinate" || name == "sigma")
      return inOrder(VerticalKind::Sigma, values);
    const bool pressureByName = standard == "air_pressure" || name == "isobaricinhpa" || name == "plev" ||
                                name == "pressure_level" || name == "pressure" || name == "isobaric";
    const double greatest = *std::max_element(values.begin(), values.end());
    const bool likely =
        greatest > 150 && greatest <= 1100 && *std::min_element(values.begin(), values.end()) >= 0.001;
    if (!pressureByName && (numbers || !likely)) return std::nullopt;
    const double factor = greatest > 2000 ? 1 : 100;
    warnings_.push_back(
        {"level_unit_assumed", fmt::format("{} has no unit of pressure or height: taken as {}",
                                           coordinate.name, factor == 1 ? "Pa" : "hPa")});
    return inOrder(VerticalKind::Pressure, values, {factor, 0});
  }

  /// 1, 2, 3, ... or 90, 89, 88, ...: steps of one.
  static bool isCounted(const std::vector<double>& values) {
    for (std::size_t i = 1; i < values.size(); ++i)
      if (std::abs(std::abs(values[i] - values[i - 1]) - 1) > 1e-6) return false;
    return values.size() > 1;
  }

  std::optional<Levels> parametric(const Variable& coordinate, const std::string& standard,
                                   const std::vector<double>& values) {
    const auto terms = termsOf(coordinate);
    if (terms.contains("orog") || standard.starts_with("atmosphere_hybrid_height")) {
      Levels levels = numbered(values);
      levels.heightA = term(terms, "a", "m");
      levels.heightB = term(terms, "b", "1");
      if (levels.heightA.empty()) return std::nullopt;
      if (levels.heightB.empty()) levels.heightB.assign(count_, 0);
      levels.orography = nameOf(terms, "orog");
      return levels;
    }
    if (terms.contains("sigma") || standard == "atmosphere_sigma_coordinate") {
      const std::vector<double> top = term(terms, "ptop", "Pa");
      std::vector<double> sigma = term(terms, "sigma", "1");
      if (sigma.empty()) sigma = values;
      std::vector<double> a;
      for (const double level : sigma) a.push_back(top.empty() ? 0 : top.front() * (1 - level));
      return hybrid(values, a, sigma, nameOf(terms, "ps"));
    }
    if (standard == "atmosphere_ln_pressure_coordinate") {
      const std::vector<double> p0 = term(terms, "p0", "Pa");
      Levels levels = inOrder(VerticalKind::Pressure, values);
      for (Vertical& level : levels.levels)
        level.value = (p0.empty() ? kStandardPa : p0.front()) * std::exp(-level.value);
      return levels;
    }
    std::vector<double> a = term(terms, "ap", "Pa"), b = term(terms, "b", "1");
    if (a.empty()) {
      const std::vector<double> p0 = term(terms, "p0", "Pa");
      // Some write "a" in pascals and give no p0 (the terms of ECHAM and the IFS through cdo).
      if (const Variable* inPascals = file_.find(nameOf(terms, "a"));
          inPascals && p0.empty() && conversion(inPascals->text("units"), "Pa"))
        a = term(terms, "a", "Pa");
      else
        for (const double value : term(terms, "a", "1"))
          a.push_back(value * (p0.empty() ? kStandardPa : p0.front()));
    }
    return hybrid(values, a, b, nameOf(terms, "ps"));
  }

  static std::string nameOf(const std::map<std::string, std::string>& terms, const std::string& term) {
    const auto found = terms.find(term);
    return found == terms.end() ? std::string() : found->second;
  }

  /// The numbers of a term: one a level, or a single one; empty if it is not there.
  std::vector<double> term(const std::map<std::string, std::string>& terms, const std::string& name,
                           const char* unit) const {
    const Variable* variable = file_.find(nameOf(terms, name));
    return variable ? numbersOf(*variable, unit) : std::vector<double>{};
  }

  std::vector<double> numbersOf(const Variable& variable, const char* unit) const {
    if (!variable.isNumeric() || file_.size(variable) > kMostLevels) return {};
    std::vector<double> numbers = file_.values(variable);
    if (numbers.size() != 1 && numbers.size() != count_) return {};
    const auto found = conversion(variable.text("units"), unit);
    for (double& number : numbers) {
      number *= found ? found->factor : 1;
      if (!std::isfinite(number)) return {};
    }
    return numbers;
  }

  std::optional<Levels> hybrid(const std::vector<double>& values, const std::vector<double>& a,
                               const std::vector<double>& b, const std::string& surfacePressure) const {
    if (a.size() != count_ || b.size() != count_) return std::nullopt;
    Levels levels = numbered(values);
    for (std::size_t i = 0; i < count_; ++i)
      levels.levels[i] = {VerticalKind::Hybrid, levels.levels[i].value, a[i], b[i]};
    levels.surfacePressure = surfacePressure;
    return levels;
  }

  /// By the numbers of the file where they are whole; else counted.
  Levels numbered(const std::vector<double>& values) const {
    Levels levels;
    bool whole = values.size() == count_;
    for (const double value : values) whole = whole && std::abs(value - std::round(value)) < 1e-6;
    for (std::size_t i = 1; i < values.size(); ++i) whole = whole && values[i] != values[i - 1];
    for (std::size_t i = 0; i < count_; ++i)
      levels.levels.push_back(
          {VerticalKind::ModelLevel, whole ? values[i] : static_cast<double>(i + 1), 0, 0});
    // Coefficients by the names that cdo gives them, though no formula names them.
    const Variable *a = file_.find("hyam"), *b = file_.find("hybm");
    if (!a || !b) return levels;
    const std::vector<double> as = numbersOf(*a, "Pa"), bs = numbersOf(*b, "1");
    if (as.size() == count_ && bs.size() == count_)
      for (std::size_t i = 0; i < count_; ++i)
        levels.levels[i] = {VerticalKind::Hybrid, levels.levels[i].value, as[i], bs[i]};
    return levels;
  }

  const File& file_;
  std::size_t count_;
  Warnings& warnings_;
};

}  // namespace

Levels levelsAlong(const File& file, const Axes& axes, std::size_t dimension, Warnings& warnings) {
  const std::size_t count = file.dimensions()[dimension].length;
  if (count > kMostLevels)
    throw base::InputError(fmt::format("{}, dimension {}", file.name(), file.dimensions()[dimension].name),
                           fmt::format("is said to have {} levels", count), "fetch the file again");
  if (count == 0) return {};
  Reading reading(file, count, warnings);
  Levels levels = reading.of(axes.along(dimension, {Kind::Vertical}));
  if (levels.levels.front().kind != VerticalKind::ModelLevel || !levels.heightA.empty()) return levels;
  // Numbers say little: another variable along the dimension may tell pressure or height.
  for (const Variable& variable : file.variables()) {
    if (variable.dimensions.size() != 1 || variable.dimensions.front() != dimension) continue;
    if (axes.kind(variable) != Kind::Vertical || variable.name == file.dimensions()[dimension].name) continue;
    Levels other = reading.of(&variable);
    if (other.levels.front().kind != VerticalKind::ModelLevel || !other.heightA.empty()) return other;
  }
  return levels;
}

Levels scalarLevel(const File& file, const Variable& variable, Warnings& warnings) {
  std::istringstream words(variable.text("coordinates"));
  for (std::string name; words >> name;) {
    const Variable* coordinate = file.find(name);
    if (!coordinate || kindOf(*coordinate) != Kind::Vertical || file.size(*coordinate) != 1) continue;
    Levels levels = Reading(file, 1, warnings).of(coordinate);
    const Vertical& level = levels.levels.front();
    // Two or ten metres above the ground are no model level.
    constexpr double kInstrumentMeters = 50;
    if (level.kind == VerticalKind::ModelLevel) continue;
    if (level.kind == VerticalKind::HeightAboveGround && level.value < kInstrumentMeters) continue;
    return levels;
  }
  return {};
}

}  // namespace cloudgen::input::netcdf
