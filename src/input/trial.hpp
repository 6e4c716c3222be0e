// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace cloudgen::input {

/// Runs the work in a child process that says nothing, and throws InputError naming `name` if the child does
/// not come through: a library such as HDF5 or OpenVDB crashes on some damaged files, or asks for gigabytes,
/// and must not take this process along. What the work throws is ignored.
void tryInChild(const std::string& name, const std::string& library, const std::function<void()>& work);

}  // namespace cloudgen::input
