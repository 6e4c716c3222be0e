// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "check/gltf/gltf_elements.hpp"
#include "check/validation.hpp"

namespace cloudgen::check {

/// The values of an attribute of a primitive by its name, or null.
using ColumnOf = std::function<const Elements*(const std::string& attribute)>;

/// gltf-finite: no attribute has infinite numbers. Positions are checked elsewhere.
void checkFinite(const Json& attributes, const ColumnOf& columnOf, const std::string& where,
                 FindingList& findings);

/// gltf-splats: a primitive with KHR_gaussian_splatting has what the extension demands: points, kernel and
/// colour space, complete attributes of the right types, opacities from 0 to 1, positive scales, unit
/// rotations.
void checkSplats(const Json& primitive, const ColumnOf& columnOf, const std::string& where,
                 FindingList& findings);

/// gltf-node: a node is placed by a matrix or by translation, rotation and scale of finite numbers.
void checkPlacement(const Json& node, const std::string& where, FindingList& findings);

/// gltf-image: the bytes of an image are what its type says; none are known if they are empty.
void checkImage(const Json& image, std::string_view bytes, FindingList& findings);

}  // namespace cloudgen::check
