// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/error.hpp"
#include "cli/command.hpp"
#include "image/sprite_bake.hpp"

namespace cloudgen::cli {

std::function<int()> setupTextures(CLI::App& options, const Terminal& terminal) {
  const auto folder = std::make_shared<std::string>();
  const auto plain = std::make_shared<bool>(false);
  options.add_option("-o,--output", *folder, "the folder to write the sprite set into (made if absent)")
      ->required();
  options.add_flag("--no-maps", *plain, "without the maps of normals");
  return [folder, plain, &terminal] {
    std::error_code error;
    std::filesystem::create_directories(*folder, error);
    if (error)
      throw base::OutputError(*folder, "cannot be made (" + error.message() + ")", "choose another -o");
    image::writeSpriteSet(*folder, !*plain, terminal.progress());
    terminal.say(fmt::format("wrote {} sprite atlases with light maps{} and manifest.json to {}", base::kGenusCount,
                             *plain ? "" : " and normals", *folder));
    return 0;
  };
}

}  // namespace cloudgen::cli
