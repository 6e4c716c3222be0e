// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace cloudgen::check {

/// The files that the words of a command line name: a file is itself; a folder stands for every scene in it
/// and below; anything else is a pattern of * and ? and [abc] within one name and ** for any folders between.
/// Hidden names are found only where they are spelt out, and links to folders are not followed. Every file
/// once, the words in their order, what each finds sorted. Throws InputError where a word finds nothing.
std::vector<std::filesystem::path> sceneFiles(std::span<const std::string> words);

/// True if a name without folders is what a pattern without ** says.
bool matchesName(std::string_view pattern, std::string_view name);

}  // namespace cloudgen::check
