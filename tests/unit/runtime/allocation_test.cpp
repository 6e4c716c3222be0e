// SPDX-License-Identifier: Apache-2.0
// Counts every allocation of this program: a frame makes none.
#include <atomic>
#include <cstdlib>
#include <new>

#include "support/made_pack.hpp"
#include "support/runtime_path.hpp"

// What malloc gave is freed: the compiler cannot know that both are ours.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

namespace {
std::atomic<std::uint64_t> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace cloudgen::runtime {
namespace {

constexpr float kSide = 120'000;

void addKeyframe(pack::RuntimePackT& content) {
  for (const double seconds : {0.0, 600.0}) {
    content.keyframes.push_back(std::make_unique<pack::KeyframeT>());
    content.keyframes.back()->seconds = seconds;
    for (std::size_t i = 0; i < content.instances.size(); ++i)
      content.keyframes.back()->motions.emplace_back(pack::Vec3(static_cast<float>(seconds), 0, 0), 1.0f, 1.0f);
  }
}

TEST(Allocation, AFrameMakesNone) {
  const std::string bytes = test::packOf(test::wideSky(8, 40, 2000, kSide), addKeyframe);
  Runtime runtime;
  ASSERT_TRUE(runtime.open(test::bytesOf(bytes)));
  const std::uint64_t before = allocations;
  std::size_t drawn = 0;
  for (int f = 0; f < 300; ++f) {
    if (f % 10 == 0) runtime.setSun({100.0f + static_cast<float>(f), 0.1f * static_cast<float>(f)});
    if (f % 3 == 0) runtime.setTime(f);
    drawn += runtime.update(test::flightCamera(f, kSide)).puffs.size();
  }
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_GT(drawn, 100'000u);

  ASSERT_TRUE(runtime.startEndless({}));
  EXPECT_GT(allocations, before) << "the counter counts";
  const std::uint64_t beforeEndless = allocations;
  for (int f = 0; f < 300; ++f) runtime.update(test::flightCamera(40 * f, kSide));
  EXPECT_EQ(allocations - beforeEndless, 0u);
}

}  // namespace
}  // namespace cloudgen::runtime
