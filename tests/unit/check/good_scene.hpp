// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/validation.hpp"
#include "check/xsd/xml_parser.hpp"

namespace cloudgen::check::test {

/// A small scene with every node of the profile and nothing wrong in it. It wants cloud.png and tiles/0.x3d
/// beside it.
std::string goodScene();

/// The scene with the first `from` replaced by `to`; fails the test if `from` is not there.
std::string edited(std::string scene, std::string_view from, std::string_view to);

/// The line, from 1, on which `piece` first stands.
std::uint64_t lineOf(std::string_view scene, std::string_view piece);

std::filesystem::path profileSchemaFile();
std::filesystem::path officialSchemaFile();
/// Compiled once.
const XmlSchema& profileSchema();
const XmlSchema& officialSchema();

/// A new folder with cloud.png and tiles/0.x3d; gone with the object.
class SceneFolder {
 public:
  SceneFolder();
  ~SceneFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Scenes that are valid: the good one and legal variations of it, each with what is special about it.
std::vector<std::pair<std::string, std::string>> goodScenes();

/// Every finding as text, one a line.
std::string texts(const ValidationResult& result);

}  // namespace cloudgen::check::test
