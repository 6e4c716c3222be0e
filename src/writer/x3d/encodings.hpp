// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "writer/x3d/node_writer.hpp"

namespace cloudgen::writer {

/// X3D 4.0 in XML (ISO/IEC 19776-1).
class XmlWriter : public NodeWriter {
 public:
  using NodeWriter::NodeWriter;
  Encoding encoding() const override { return Encoding::Xml; }
  void start(const HeadEntries& head, std::string_view component) override;
  void open(std::string_view type, std::string_view field, std::string_view def) override;
  void close() override;
  void use(std::string_view type, std::string_view field, std::string_view def) override;
  void route(std::string_view fromNode, std::string_view fromField, std::string_view toNode,
             std::string_view toField) override;
  void finish() override;
  void boolean(std::string_view name, bool value) override;
  void string(std::string_view name, std::string_view value) override;
  void strings(std::string_view name, std::span<const std::string> values) override;

 private:
  void openField(std::string_view name, bool many) override;
  void closeField(bool many) override;
  void beginTag(std::string_view type, std::string_view field);

  std::vector<std::string> types_;
  bool inTag_ = false;
};

/// ClassicVRML (ISO/IEC 19776-2) and VRML97 (ISO/IEC 14772-1), which share their syntax.
class VrmlWriter : public NodeWriter {
 public:
  VrmlWriter(const std::filesystem::path& file, Encoding encoding) : NodeWriter(file), encoding_(encoding) {}
  Encoding encoding() const override { return encoding_; }
  void start(const HeadEntries& head, std::string_view component) override;
  void open(std::string_view type, std::string_view field, std::string_view def) override;
  void close() override;
  void use(std::string_view type, std::string_view field, std::string_view def) override;
  void route(std::string_view fromNode, std::string_view fromField, std::string_view toNode,
             std::string_view toField) override;
  void finish() override;
  void boolean(std::string_view name, bool value) override;
  void string(std::string_view name, std::string_view value) override;
  void strings(std::string_view name, std::span<const std::string> values) override;

 private:
  void openField(std::string_view name, bool many) override;
  void closeField(bool many) override;
  void beginChild(std::string_view field);

  Encoding encoding_;
  std::vector<std::string> lists_;  ///< of every open node: its list of child nodes that is open
};

}  // namespace cloudgen::writer
