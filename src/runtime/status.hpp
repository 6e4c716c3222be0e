// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cloudgen::runtime {

/// Success, or what went wrong: nothing of the runtime throws.
struct [[nodiscard]] Status {
  const char* problem = nullptr;  ///< of static storage; null for success

  explicit operator bool() const noexcept { return problem == nullptr; }
};

}  // namespace cloudgen::runtime
