// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "check/rules/scene_checker.hpp"
#include "check/vrml/vrml_tokens.hpp"

namespace cloudgen::check {

/// Reads ClassicVRML or VRML97 by their grammar and tells the scene checker what it means.
class VrmlReader {
 public:
  VrmlReader(ByteSource& source, FindingList& findings, const std::filesystem::path& folder,
             const base::Progress& progress)
      : source_(source),
        tokens_(source),
        findings_(findings),
        checker_(findings, folder),
        progress_(progress) {}

  void read();

 private:
  Token expect(TokenKind kind, std::string_view what);
  bool isNext(std::string_view word) { return tokens_.peek().is(word); }

  void readHeader();
  void readStatement();
  bool readDeclaration();
  void readComponent();
  void readRoute();
  void readImport();
  void readNode(std::string_view container, int depth);
  void readBody(int depth);
  void skipBody();
  void readField(int depth);
  void readNodes(const FieldKind& field, int depth);
  void readFieldValue(const FieldKind& field, Position where, int depth);
  std::string readValue(const FieldKind& field);
  std::string readImage();

  void readPrototype(bool isExternal);
  bool startsInterface();
  FieldKind readInterface();
  void readDefault(const FieldKind& field, int depth);

  ByteSource& source_;
  VrmlTokens tokens_;
  FindingList& findings_;
  SceneChecker checker_;
  const base::Progress& progress_;
  std::uint64_t reported_ = 0;
  int version_ = 40, bodies_ = 0;
};

/// Thrown and caught by the reader: after a wrong form nothing can be told any more.
struct VrmlFormError {
  Position where;
  std::string rule, message, hint;
};

}  // namespace cloudgen::check
