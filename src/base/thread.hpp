// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace cloudgen::base {

/// Limits the worker threads of every parallelFor of the process while it lives; 0 means all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Calls body(i) once for every i in [0, count), in any order, on several threads. The body must not
/// depend on the order: each i writes its own slot. An exception of a body is thrown again here.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace cloudgen::base
