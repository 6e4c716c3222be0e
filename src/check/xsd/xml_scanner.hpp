// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/validation.hpp"

namespace cloudgen::check {

/// What a scene may ask of the parser, whose own limits are off.
struct XmlLimits {
  std::uint64_t attributeBytes = 8 << 20;
  std::uint64_t textBytes = 1 << 20;  ///< a comment, instruction, DOCTYPE or run of text
  std::uint64_t nameBytes = 1000;
  int depth = 200;
  int attributes = 64;  ///< of one element
};

/// Where a start tag stands, and its attributes in their order.
struct TagPosition {
  struct Attribute {
    std::string name;
    Position where;
  };
  Position where;
  std::vector<Attribute> attributes;
};

/// Why a document is not handed to the parser at all.
struct Refusal {
  Position where;
  std::string_view rule;
  std::string message, hint;
};

/// Walks over the bytes before the XML parser sees them: enforces the limits, refuses what X3D never needs
/// (an internal DTD subset, encodings other than ASCII's heirs), and notes where each start tag stands.
/// It is no judge of well-formedness.
class XmlScanner {
 public:
  explicit XmlScanner(XmlLimits limits = {}) : limits_(limits) {}

  /// Nothing, or why the document is refused; after that no more chunks may be given.
  std::optional<Refusal> scan(std::string_view chunk);

  /// The first start tag that is complete and not yet taken; false if there is none. What `tag` held is used
  /// again.
  bool take(TagPosition& tag);

 private:
  enum class State {
    Text,
    Open,
    Name,
    InTag,
    AttributeName,
    AfterName,
    Value,
    EndTag,
    Instruction,
    Bang,
    Doctype,
    DoctypeQuote,
    Comment,
    CData
  };

  void step(char character);
  void stepInTag(char character);
  void stepBang(char character);
  void startMarkup(State state);
  void finishTag();
  void checkEncoding();
  void refuse(std::string_view rule, std::string message, std::string hint);
  bool tailIs(std::string_view end) const { return tail_.ends_with(end); }
  void remember(char character);

  XmlLimits limits_;
  State state_ = State::Text;
  Position here() const { return {line_, offset_ - lineStart_ + 1}; }
  void pass(std::string_view run);

  std::uint64_t offset_ = 0, line_ = 1, lineStart_ = 0;
  Position markup_;
  TagPosition tag_;
  std::deque<TagPosition> tags_;
  std::vector<TagPosition> spare_;  ///< taken, whose memory is used again
  std::string name_, tail_, instruction_;
  std::uint64_t run_ = 0;  ///< bytes of the current text, comment, value or name
  int depth_ = 0;
  char quote_ = 0;
  bool slash_ = false, first_ = true;
  std::optional<Refusal> refusal_;
};

}  // namespace cloudgen::check
