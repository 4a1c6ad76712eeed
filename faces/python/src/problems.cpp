// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/problems.hpp"

#include <string>

namespace python {

namespace py = pybind11;

namespace {

/// The text for Python. Bytes of a file that are not UTF-8 become replacement characters.
py::str text_of(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

}  // namespace

void declare_problems(py::module_& module) {
  module.attr("ScenarioError") = py::module_::import("sixstep._errors").attr("ScenarioError");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Refused& refused) {
      const py::module_ errors = py::module_::import("sixstep._errors");
      py::list problems;
      for (const base::Problem& p : refused.problems)
        problems.append(
            errors.attr("Problem")(text_of(p.where), text_of(p.value), text_of(p.limit), text_of(p.cure)));
      PyErr_SetObject(errors.attr("ScenarioError").ptr(), errors.attr("ScenarioError")(problems).ptr());
    }
  });
}

}  // namespace python
