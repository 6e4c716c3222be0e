// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "check/validation.hpp"
#include "check/xsd/byte_source.hpp"

namespace cloudgen::check {

enum class TokenKind { End, Word, String, Open, Close, OpenList, CloseList };

struct Token {
  TokenKind kind = TokenKind::End;
  std::string text;  ///< of a string with its quotation marks
  Position where;

  bool is(std::string_view word) const { return kind == TokenKind::Word && text == word; }
};

/// Cuts ClassicVRML and VRML97 text into tokens as it is read; comments, commas and blanks part them
/// (ISO/IEC 19776-2, 14772-1).
class VrmlTokens {
 public:
  /// Longest word or string; what is longer comes in pieces, and tooLong() is true.
  static constexpr std::size_t kLongest = 1 << 20;

  explicit VrmlTokens(ByteSource& source) : source_(source) { refill(); }

  /// The first line, at most 100 bytes of it, before any token.
  std::string header() const;
  const Token& peek();
  Token take();
  /// Appends the token to a list of values without a token between.
  void takeInto(std::string& values);
  /// True after a string without its end.
  bool brokenString() const { return broken_; }
  bool tooLong() const { return tooLong_; }
  std::uint64_t offset() const { return before_ + at_; }

 private:
  void refill();
  void skipBlanks();
  void read();
  void readString();
  void readWord();

  ByteSource& source_;
  std::string_view chunk_;
  std::size_t at_ = 0;
  std::uint64_t before_ = 0;  ///< bytes of the chunks before
  std::uint64_t line_ = 1, lineStart_ = 0;
  Token next_;
  bool peeked_ = false, broken_ = false, tooLong_ = false;
};

}  // namespace cloudgen::check
