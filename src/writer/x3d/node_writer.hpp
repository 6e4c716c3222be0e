// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "writer/x3d/text_file.hpp"

namespace cloudgen::writer {

enum class Encoding { Xml, Classic, Vrml97 };

/// What stands before the nodes: names and contents, in order. VRML97 keeps them as comments.
using HeadEntries = std::vector<std::pair<std::string, std::string>>;

/// Takes the nodes of a scene in document order and writes them straight to a file, in one of three
/// encodings. A node's fields come before its child nodes. `field` is the name of the parent's field that the
/// node stands in, as X3D calls it ("children", "geometry", "value"); it does not matter for nodes at the
/// root.
class NodeWriter {
 public:
  explicit NodeWriter(const std::filesystem::path& file) : file_(file) {}
  virtual ~NodeWriter() = default;
  NodeWriter(const NodeWriter&) = delete;
  NodeWriter& operator=(const NodeWriter&) = delete;

  virtual Encoding encoding() const = 0;
  /// `component`: one of X3D that the scene needs beside its profile; none of VRML97.
  virtual void start(const HeadEntries& head, std::string_view component = {}) = 0;
  virtual void open(std::string_view type, std::string_view field = "children",
                    std::string_view def = {}) = 0;
  virtual void close() = 0;
  virtual void use(std::string_view type, std::string_view field, std::string_view def) = 0;
  /// At the root, after the nodes that it joins.
  virtual void route(std::string_view fromNode, std::string_view fromField, std::string_view toNode,
                     std::string_view toField) = 0;
  /// Ends the document and the file. Throws OutputError.
  virtual void finish() = 0;

  virtual void boolean(std::string_view name, bool value) = 0;
  virtual void string(std::string_view name, std::string_view value) = 0;
  virtual void strings(std::string_view name, std::span<const std::string> values) = 0;
  /// One value of 1 to 4 numbers.
  void number(std::string_view name, double value, int decimals);
  void vector(std::string_view name, const glm::vec3& value, int decimals);
  /// Degrees of latitude and longitude, and metres.
  void place(std::string_view name, const glm::dvec3& value);
  void rotation(std::string_view name, const glm::vec4& value);
  /// Many values; `group` numbers each.
  void numbers(std::string_view name, std::span<const float> values, int group, int decimals);
  void integer(std::string_view name, std::int64_t value);
  void integers(std::string_view name, std::span<const std::int32_t> values);

 protected:
  virtual void openField(std::string_view name, bool many) = 0;
  virtual void closeField(bool many) = 0;
  std::string& text() { return file_.text(); }

  TextFile file_;
};

/// A writer of the encoding. Throws OutputError if the file cannot be made.
std::unique_ptr<NodeWriter> nodeWriter(Encoding encoding, const std::filesystem::path& file);

/// The text without control characters and without bytes that are not UTF-8 (they become '?').
std::string cleanText(std::string_view text);

}  // namespace cloudgen::writer
