// SPDX-License-Identifier: Apache-2.0
// Whatever the expression: it is compiled or refused within bounds, and its shortest text fits. The rest of
// the bytes, after a line end, is a value.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "check/xsd/pattern.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(text.find('\n'), size);
  const auto pattern = cloudgen::check::Pattern::compiled(text.substr(0, end));
  if (!pattern) return 0;
  if (!pattern->accepts(pattern->shortest())) std::abort();
  pattern->accepts(text.substr(end));
  return 0;
}
