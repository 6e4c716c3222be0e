// SPDX-License-Identifier: Apache-2.0
// write_small_pack FILE: the pack of the small scene of the tests, as tests/fuzz/seeds/pack keeps it.
#include "base/file.hpp"
#include "support/pack_scene.hpp"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  cloudgen::base::writeFile(arguments[1], cloudgen::test::packOf(cloudgen::test::packScene()));
  return 0;
}
