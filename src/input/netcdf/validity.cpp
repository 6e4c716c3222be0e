// SPDX-License-Identifier: Apache-2.0
#include "input/netcdf/validity.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "input/netcdf/times.hpp"
#include "input/netcdf/units.hpp"

namespace cloudgen::input::netcdf {
namespace {

constexpr std::size_t kMostTimes = 1 << 22;

bool has(const Variable& variable, const std::optional<std::size_t>& dimension) {
  return dimension && std::find(variable.dimensions.begin(), variable.dimensions.end(), *dimension) !=
                          variable.dimensions.end();
}

}  // namespace

Validity::Validity(const File& file, const Axes& axes, const Placed& placed,
                   std::vector<field::Warning>& warnings)
    : file_(file), axes_(axes), warnings_(warnings) {
  if (placed.time) time_ = placed.variable->dimensions[*placed.time];
  if (placed.step) step_ = placed.variable->dimensions[*placed.step];
  named_ = " " + placed.variable->text("coordinates") + " ";
  const Variable *valid = find(Kind::Time), *reference = find(Kind::Reference), *period = find(Kind::Period);
  if (valid) valid_ = read(*valid, true);
  if (reference) reference_ = read(*reference, true);
  if (period) period_ = read(*period, false);
  // A time that does not run with the steps is where they start from.
  if (valid && !reference && period && step_ && !has(*valid, step_)) {
    reference_ = std::move(valid_);
    valid_.reset();
  }
}

/// True if the variable needs no other dimensions than time and step.
bool Validity::covers(const Variable& variable) const {
  return std::all_of(variable.dimensions.begin(), variable.dimensions.end(), [&](std::size_t dimension) {
    return dimension == time_ || dimension == step_ || file_.dimensions()[dimension].length == 1;
  });
}

/// The one with most of the dimensions; then the one that the variable names, then the dimension's own.
const Variable* Validity::find(Kind kind) const {
  const Variable* best = nullptr;
  int bestScore = -1;
  for (const Variable& variable : file_.variables()) {
    if (variable.dimensions.size() > 2 || axes_.kind(variable) != kind || !covers(variable)) continue;
    if (file_.size(variable) == 0 || file_.size(variable) > kMostTimes) continue;
    const bool own = time_ && variable.name == file_.dimensions()[*time_].name;
    const int score = 8 * (has(variable, time_) + has(variable, step_)) +
                      4 * (variable.text("standard_name") == "time") +
                      2 * (named_.find(" " + variable.name + " ") != std::string::npos) + own;
    // What lies along neither says nothing where the variable has a time of several moments.
    const bool several = time_ && file_.dimensions()[*time_].length > 1;
    if (kind == Kind::Time && several && !has(variable, time_)) continue;
    if (score > bestScore) best = &variable, bestScore = score;
  }
  return best;
}

Validity::Series Validity::read(const Variable& variable, bool moment) {
  Series series;
  if (moment) {
    for (const auto& time : moments(file_, variable, warnings_))
      series.seconds.push_back(time ? std::optional(static_cast<double>(time->seconds)) : std::nullopt);
  } else {
    const auto toSeconds = conversion(variable.text("units"), "s");
    for (const double value : file_.values(variable)) {
      const double seconds = value * (toSeconds ? toSeconds->factor : 3600);
      series.seconds.push_back(std::abs(seconds) < 1e11 ? std::optional(seconds) : std::nullopt);
    }
  }
  std::size_t stride = 1;
  for (std::size_t i = variable.dimensions.size(); i-- > 0;) {
    if (variable.dimensions[i] == time_) series.timeStride = stride;
    if (variable.dimensions[i] == step_) series.stepStride = stride;
    stride *= file_.dimensions()[variable.dimensions[i]].length;
  }
  return series;
}

std::optional<double> Validity::Series::at(std::size_t time, std::size_t step) const {
  const std::size_t place = time * timeStride + step * stepStride;
  return place < seconds.size() ? seconds[place] : std::nullopt;
}

Validity::Moment Validity::at(std::size_t time, std::size_t step) const {
  const auto valueOf = [&](const std::optional<Series>& series) {
    return series ? series->at(time, step) : std::nullopt;
  };
  const auto utc = [](double seconds) { return base::UtcTime{std::llround(seconds)}; };
  const auto valid = valueOf(valid_), reference = valueOf(reference_), period = valueOf(period_);
  Moment moment;
  if (valid)
    moment.valid = utc(*valid);
  else if (!valid_ && reference)
    moment.valid = utc(*reference + period.value_or(0));
  if (reference)
    moment.run = utc(*reference);
  else if (valid && period)
    moment.run = utc(*valid - *period);
  moment.lost = !moment.valid && (valid_ || reference_);
  return moment;
}

}  // namespace cloudgen::input::netcdf
