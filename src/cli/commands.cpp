// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "base/error.hpp"
#include "cli/command.hpp"

namespace cloudgen::cli {
namespace {

/// A command of the contract that a later version brings: it takes any arguments and says so (exit 3).
std::function<int()> notBuilt(CLI::App& options) {
  options.allow_extras();
  options.prefix_command();
  return [name = options.get_name()]() -> int {
    throw base::NotBuiltError(name, "is not part of this build",
                              "see `cloudgen --version --json` for what is");
  };
}

}  // namespace

std::function<int()> setupMerge(CLI::App& options, const Terminal&) { return notBuilt(options); }

std::span<const Command> commands() {
  static const std::vector<Command> kCommands{
      {"build", "make a 3D sky from model output", setupBuild},
      {"inspect", "what is in the input, what would be used, what is missing", setupInspect},
      {"validate", "check scenes against the schema and the rules of the standard", setupValidate},
      {"verify", "compare a written scene with its model, column by column", setupVerify},
      {"preview", "a picture of a written scene", setupPreview},
      {"film", "frames or a film of a sky that moves", setupFilm},
      {"textures", "make the sprite set", setupTextures},
      {"types", "the cloud types and their recipes", setupTypes},
      {"formats", "the output formats", setupFormats},
      {"explain", "why a cloud is there: its model cell, the values, the rule", setupExplain},
      {"merge", "join shards into one scene (not built yet)", setupMerge},
  };
  return kCommands;
}

}  // namespace cloudgen::cli
