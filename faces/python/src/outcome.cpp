// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/outcome.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "text/results/json_summary.hpp"

namespace python {

namespace py = pybind11;

namespace {

using Described = std::vector<std::tuple<std::string, std::string, std::string, std::string>>;

Described described(const std::vector<study::Column>& columns) {
  Described out;
  for (const study::Column& c : columns) out.emplace_back(c.name, c.unit, c.frame, c.meaning);
  return out;
}

/// A read-only view of a column. The rows exist as long as a view of them.
py::array_t<double> view(const std::shared_ptr<Rows>& rows, std::size_t column) {
  if (!rows || column >= rows->columns.size()) throw py::index_error("no such column");
  const std::vector<double>& values = rows->columns[column];
  py::array_t<double> out(static_cast<py::ssize_t>(values.size()), values.data(), py::cast(rows));
  py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

}  // namespace

std::shared_ptr<Rows> rows_of(std::size_t columns) {
  auto rows = std::make_shared<Rows>();
  rows->columns.resize(columns);
  return rows;
}

Outcome outcome_of(const study::Scenario& scenario, const study::Outcome& outcome) {
  return {.summary = text::json_summary(scenario, outcome),
          .digest = outcome.digest,
          .passed = outcome.passed(),
          .complete = !study::cut_short(scenario, outcome),
          .simulated_s = outcome.simulated_s,
          .columns = {},
          .event_columns = {},
          .rows = nullptr,
          .events = nullptr,
          .stopped_by = py::none()};
}

void declare_outcome(py::module_& module) {
  const py::class_<Rows, std::shared_ptr<Rows>> rows(module, "Rows");
  py::class_<Outcome>(module, "Outcome")
      .def_readonly("summary", &Outcome::summary)
      .def_readonly("digest", &Outcome::digest)
      .def_readonly("passed", &Outcome::passed)
      .def_readonly("complete", &Outcome::complete)
      .def_readonly("simulated_s", &Outcome::simulated_s)
      .def_readonly("stopped_by", &Outcome::stopped_by)
      .def_property_readonly("columns", [](const Outcome& o) { return described(o.columns); })
      .def_property_readonly("event_columns", [](const Outcome& o) { return described(o.event_columns); })
      .def("column", [](const Outcome& o, std::size_t n) { return view(o.rows, n); })
      .def("event_column", [](const Outcome& o, std::size_t n) { return view(o.events, n); });
}

}  // namespace python
