// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "input/model/model_field.hpp"
#include "input/open_options.hpp"

namespace cloudgen::input::model {

/// A source from the fields of a model: the wanted valid time (nearest none: InputError names those there
/// are), one ensemble member, one grid, one kind of level, from the ground upwards whatever the file's
/// numbering. Prefers cloud water on levels; else relative or specific humidity on levels (cloud is derived
/// downstream); else cover (low, middle, high, convective, total), told as layers. Converts what is in per
/// cent, turns winds to true north, adds the pressure of hybrid and sigma levels from the surface pressure.
/// Warns of every trap it meets, with numbers. Throws InputError where there is nothing about clouds.
std::unique_ptr<field::Source> makeSource(Contents contents, const OpenOptions& options);

}  // namespace cloudgen::input::model
