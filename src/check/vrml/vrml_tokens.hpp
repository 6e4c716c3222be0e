// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "check/validation.hpp"

namespace cloudgen::check {

enum class TokenKind { End, Word, String, Open, Close, OpenList, CloseList };

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;  ///< of a string with its quotation marks
  Position where;
};

/// Cuts ClassicVRML and VRML97 text into tokens; comments, commas and blanks part them (ISO/IEC 19776-2,
/// 14772-1).
class VrmlTokens {
 public:
  explicit VrmlTokens(std::string_view text) : text_(text) {}

  const Token& peek();
  Token take();
  /// True after a string without its end.
  bool brokenString() const { return broken_; }

 private:
  void skipBlanks();
  Token read();
  void advance(std::size_t count);

  std::string_view text_;
  std::size_t at_ = 0;
  Position here_{1, 1};
  Token next_;
  bool peeked_ = false, broken_ = false;
};

}  // namespace cloudgen::check
