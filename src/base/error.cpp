// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"

#include <fmt/format.h>

namespace cloudgen::base {

Error::Error(Failure failure, std::string where, std::string what, std::string hint)
    : std::runtime_error(fmt::format("{}: {}; {}", where, what, hint)),
      failure_(failure),
      where_(std::move(where)),
      problem_(std::move(what)),
      hint_(std::move(hint)) {}

}  // namespace cloudgen::base
