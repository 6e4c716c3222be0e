// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input/model/model_field.hpp"

namespace cloudgen::test {

/// Model output made by hand, as a reader would list it: constant fields on a 4 x 3 grid.
struct MadeContents {
  MadeContents() {
    contents.files = {"/somewhere/made.grib2"};
    contents.format = "made";
    contents.model = "made model";
    contents.grids.push_back([] {
      field::Grid grid;
      grid.columns = 4, grid.rows = 3;
      grid.firstX = 10, grid.firstY = 45, grid.stepX = grid.stepY = 1;
      return grid;
    });
  }

  using Meaning = std::variant<field::Quantity, input::model::Single>;

  static std::function<std::vector<float>(std::span<const std::uint32_t>)> constant(float value) {
    return [value](std::span<const std::uint32_t> cells) { return std::vector<float>(cells.size(), value); };
  }

  /// A field on a level of any kind.
  input::model::Field& level(field::Quantity quantity, input::model::Vertical vertical, float value,
                             std::string name = "x") {
    input::model::Field field;
    field.meaning = quantity;
    field.name = std::move(name);
    field.where = "made";
    field.vertical = vertical;
    field.valid = time;
    field.read = constant(value);
    contents.fields.push_back(std::move(field));
    return contents.fields.back();
  }
  input::model::Field& isobaric(field::Quantity quantity, double hectopascals, float value,
                                std::string name = "x") {
    return level(quantity, {input::model::VerticalKind::Pressure, hectopascals * 100}, value,
                 std::move(name));
  }
  input::model::Field& single(input::model::SingleKind kind, float value,
                              input::model::CloudPart part = input::model::CloudPart::Total) {
    level(field::Quantity::Temperature, {}, value).meaning = input::model::Single{kind, part};
    return contents.fields.back();
  }

  input::model::Contents contents;
  base::UtcTime time = base::utcFromCivil(2026, 6, 21, 12);
};

}  // namespace cloudgen::test
