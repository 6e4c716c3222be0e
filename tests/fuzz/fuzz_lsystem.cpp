// SPDX-License-Identifier: Apache-2.0
// Whatever the text is: it is a grammar that grows within bounds, or an InputError.
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "shape/grammar.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cloudgen;
  try {
    const auto grammar =
        shape::grammarFromJson(std::string(reinterpret_cast<const char*>(data), size), "fuzz.lsystem.json");
    const auto balls = shape::grow(grammar, 3, 1);
    if (balls.size() > 20'000) __builtin_trap();
    for (const auto& ball : balls)
      if (!std::isfinite(ball.center.x + ball.center.y + ball.center.z) || !(ball.radius > 0))
        __builtin_trap();
  } catch (const base::InputError&) {
  }
  return 0;
}
