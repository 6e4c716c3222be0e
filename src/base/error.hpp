// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace cloudgen::base {

/// What went wrong, as the process tells it to its caller; the value is the exit code.
enum class Failure { InputData = 1, Usage = 2, NotBuilt = 3, Output = 4, Interrupted = 130 };

/// A failure that a user can act on: where it is (file, message, line), what it is, what to do next.
/// Thrown by library code, mapped to text and exit code once, in cli.
class Error : public std::runtime_error {
 public:
  Error(Failure failure, std::string where, std::string what, std::string hint);

  Failure failure() const { return failure_; }
  const std::string& where() const { return where_; }
  const std::string& problem() const { return problem_; }
  const std::string& hint() const { return hint_; }

 private:
  Failure failure_;
  std::string where_, problem_, hint_;
};

/// Bad input data (exit 1).
struct InputError : Error {
  InputError(std::string where, std::string what, std::string hint)
      : Error(Failure::InputData, std::move(where), std::move(what), std::move(hint)) {}
};

/// The command line asks for something that makes no sense (exit 2).
struct UsageError : Error {
  UsageError(std::string where, std::string what, std::string hint)
      : Error(Failure::Usage, std::move(where), std::move(what), std::move(hint)) {}
};

/// The feature is known but not part of this build (exit 3).
struct NotBuiltError : Error {
  NotBuiltError(std::string where, std::string what, std::string hint)
      : Error(Failure::NotBuilt, std::move(where), std::move(what), std::move(hint)) {}
};

/// The output cannot be written, or does not pass its check (exit 4).
struct OutputError : Error {
  OutputError(std::string where, std::string what, std::string hint)
      : Error(Failure::Output, std::move(where), std::move(what), std::move(hint)) {}
};

/// The user stopped the run (exit 130).
struct InterruptedError : Error {
  InterruptedError() : Error(Failure::Interrupted, "cloudgen", "interrupted", "nothing was written") {}
};

}  // namespace cloudgen::base
