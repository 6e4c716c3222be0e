// SPDX-License-Identifier: Apache-2.0
// list_puffs FILE: writes the pack of a made sky that moves, and prints what the runtime draws of it from some places, a line of JSON
// a camera. The page's own test (templates/viewer/test/agreement.test.ts) draws the same.
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include "base/file.hpp"
#include "runtime/selection.hpp"
#include "runtime/timeline.hpp"
#include "support/made_pack.hpp"

namespace {

using namespace cloudgen;
using runtime::Camera;

constexpr float kMarginRadians = 0.1f, kMarginMeters = 300, kErrorPixels = 3, kHysteresis = 0.15f;

/// Clouds drift apart and grow; every fifth one is there at one of two keyframes alone.
void addMotion(pack::RuntimePackT& content) {
  for (const double seconds : {0.0, 3600.0}) {
    auto frame = std::make_unique<pack::KeyframeT>();
    frame->seconds = seconds;
    for (std::uint32_t i = 0; i < content.instances.size(); ++i) {
      if (seconds > 0 && i % 5 == 4) continue;
      const float far = seconds > 0 ? 20 * static_cast<float>(i % 100) : 0;
      frame->clouds.push_back(i);
      frame->motions.emplace_back(pack::Vec3(far, 0, -far), seconds > 0 ? 1.2f : 1.0f, 1.0f);
    }
    content.keyframes.push_back(std::move(frame));
  }
}

void printList(runtime::Selection& selection, const runtime::Timeline& timeline, const runtime::PackView& view,
               const Camera& camera, double seconds) {
  selection.begin({timeline.instances(), view.tiles(), timeline.tileSlackMeters()}, camera,
                  runtime::Frustum(camera, kMarginRadians, kMarginMeters), kMarginMeters,
                  {.errorPixels = kErrorPixels, .hysteresis = kHysteresis});
  while (selection.advance(std::numeric_limits<std::uint64_t>::max())) {
  }
  std::printf("{\"seconds\": %g, \"eye\": [%.9g, %.9g, %.9g], \"forward\": [%.9g, %.9g, %.9g], \"width\": %d, \"height\": %d, "
              "\"fieldRadians\": %.9g, \"marginRadians\": %.9g, \"marginMeters\": %.9g, \"errorPixels\": %.9g, "
              "\"hysteresis\": %.9g, \"puffs\": [",
              seconds, camera.eye.x, camera.eye.y, camera.eye.z, camera.forward.x, camera.forward.y, camera.forward.z,
              camera.widthPixels, camera.heightPixels, camera.verticalFieldRadians, kMarginRadians, kMarginMeters, kErrorPixels,
              kHysteresis);
  const char* separator = "";
  for (const runtime::DrawPuff& puff : selection.puffs()) {
    std::printf("%s[%u, %u]", separator, puff.instance, puff.puff);
    separator = ", ";
  }
  std::puts("]}");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::string bytes = test::packOf(test::wideSky(8, 40, 900, 60'000), addMotion);
  base::writeFile(arguments[1], bytes);
  runtime::PackView view;
  if (!view.open(test::bytesOf(bytes))) return 1;
  runtime::Timeline timeline(view);
  runtime::Selection selection(view, view.instances().size(), view.tiles().size(), 900 * 40);
  for (int i = 0; i < 12; ++i) {
    const float heading = 0.9f * static_cast<float>(i), pitch = -0.3f + 0.05f * static_cast<float>(i % 7);
    Camera camera;
    camera.eye = {4000.0f * static_cast<float>(i), 800.0f + 700.0f * static_cast<float>(i % 5), -5000.0f * static_cast<float>(i)};
    camera.forward = {std::sin(heading) * std::cos(pitch), std::sin(pitch), -std::cos(heading) * std::cos(pitch)};
    camera.farMeters = 2e7f;
    const double seconds = 600.0 * (i % 7);
    timeline.setTime(seconds);
    printList(selection, timeline, view, camera, seconds);
  }
  return 0;
}
