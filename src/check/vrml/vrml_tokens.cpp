// SPDX-License-Identifier: Apache-2.0
#include "check/vrml/vrml_tokens.hpp"

namespace cloudgen::check {
namespace {

bool isBlank(char c) { return c == ' ' || c == ',' || c == '\n' || c == '\t' || c == '\r'; }
bool endsWord(char c) {
  return isBlank(c) || c == '{' || c == '}' || c == '[' || c == ']' || c == '"' || c == '#';
}

}  // namespace

void VrmlTokens::advance(std::size_t count) {
  for (const char c : text_.substr(at_, count)) {
    ++here_.column;
    if (c == '\n') ++here_.line, here_.column = 1;
  }
  at_ += count;
}

void VrmlTokens::skipBlanks() {
  while (at_ < text_.size()) {
    if (text_[at_] == '#')
      advance(std::min(text_.find('\n', at_), text_.size()) - at_);
    else if (isBlank(text_[at_]))
      advance(1);
    else
      return;
  }
}

Token VrmlTokens::read() {
  skipBlanks();
  Token token{TokenKind::End, {}, here_};
  if (at_ >= text_.size()) return token;
  std::size_t length = 1;
  switch (text_[at_]) {
    case '{':
      token.kind = TokenKind::Open;
      break;
    case '}':
      token.kind = TokenKind::Close;
      break;
    case '[':
      token.kind = TokenKind::OpenList;
      break;
    case ']':
      token.kind = TokenKind::CloseList;
      break;
    case '"':
      token.kind = TokenKind::String;
      while (at_ + length < text_.size() && text_[at_ + length] != '"')
        length += text_[at_ + length] == '\\' ? 2 : 1;
      broken_ |= at_ + length >= text_.size();
      length = std::min(length + 1, text_.size() - at_);
      break;
    default:
      token.kind = TokenKind::Word;
      while (at_ + length < text_.size() && !endsWord(text_[at_ + length])) ++length;
  }
  token.text = text_.substr(at_, length);
  advance(length);
  return token;
}

const Token& VrmlTokens::peek() {
  if (!peeked_) next_ = read();
  peeked_ = true;
  return next_;
}

Token VrmlTokens::take() {
  const Token token = peek();
  peeked_ = false;
  return token;
}

}  // namespace cloudgen::check
