// SPDX-License-Identifier: Apache-2.0
// Converts problems of the library to Python exceptions.
#pragma once
#include <pybind11/pybind11.h>

#include <utility>

#include "faces/python/src/rooms.hpp"
#include "sixstep/base/problem.hpp"
#include "sixstep/base/result.hpp"

namespace python {

/// Thrown only by this binding. In Python it becomes a sixstep.ScenarioError with all problems in
/// `.problems`.
struct Refused {
  base::Problems problems;
};

/// Returns the value; throws Refused if there is none.
template <class T>
T taken(base::Result<T> result) {
  if (!result) throw Refused{result.problems()};
  return std::move(*result);
}

void declare_problems(pybind11::module_& module);

}  // namespace python
