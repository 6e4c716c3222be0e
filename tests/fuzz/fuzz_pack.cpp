// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are: the runtime refuses them or flies through them, and the validator ends. What the validator
// passes, the runtime opens.
#include <runtime_pack_generated.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/error.hpp"
#include "check/fidelity/written_scene.hpp"
#include "check/pack/validate_pack.hpp"
#include "runtime/runtime.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cloudgen;
  const std::vector<std::uint8_t> bytes(data, data + size);  // at an address that suits FlatBuffers
  runtime::Runtime runtime;
  const bool opened = static_cast<bool>(runtime.open(std::span(bytes)));
  const bool valid =
      check::validatePack(std::string_view(reinterpret_cast<const char*>(bytes.data()), size), "fuzz").valid();
  if (valid && !opened) std::abort();
  if (!opened) return 0;
  runtime::Camera camera;
  camera.eye = {10'000, 1500, 15'000};
  for (int frame = 0; frame < 4; ++frame) {
    camera.eye.z -= 60;
    runtime.setSun({30.0f * static_cast<float>(frame), 10.0f * static_cast<float>(frame)});
    runtime.setTime(frame);
    for (const runtime::DrawPuff& puff : runtime.update(camera).puffs)
      if (puff.instance >= runtime.pack().instances().size() || puff.puff >= runtime.pack().puffs().size()) std::abort();
  }
  if (runtime.startEndless({})) runtime.update(camera);
  return 0;
}
