// SPDX-License-Identifier: Apache-2.0
// A value, or the reasons why there is no value. std::expected requires C++23.
#pragma once
#include <utility>
#include <variant>

#include "sixstep/base/problem.hpp"

namespace sixstep::base {

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Problem problem) : content_(std::in_place_index<1>, Problems{std::move(problem)}) {}
  Result(Problems problems) : content_(std::in_place_index<1>, std::move(problems)) {}

  explicit operator bool() const { return content_.index() == 0; }

  /// Requires that operator bool is true; otherwise the call dereferences null.
  T& operator*() { return *std::get_if<0>(&content_); }
  const T& operator*() const { return *std::get_if<0>(&content_); }
  T* operator->() { return std::get_if<0>(&content_); }
  const T* operator->() const { return std::get_if<0>(&content_); }

  /// Requires that operator bool is false; otherwise the call dereferences null.
  const Problems& problems() const { return *std::get_if<1>(&content_); }

 private:
  std::variant<T, Problems> content_;
};

}  // namespace sixstep::base
