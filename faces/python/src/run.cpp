// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/run.hpp"

#include <optional>

#include "faces/python/src/outcome.hpp"
#include "faces/python/src/problems.hpp"
#include "faces/python/src/scenario.hpp"
#include "faces/python/src/watch.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace python {

namespace py = pybind11;

namespace {

Outcome run(const HeldScenario& held, bool books, bool events, const py::object& progress) {
  const std::vector<study::Column> columns = taken(study::record_columns(held.scenario));
  const std::shared_ptr<Rows> rows = rows_of(columns.size());
  const std::shared_ptr<Rows> every = events ? rows_of(study::all_columns().size()) : nullptr;
  Watch watch(progress);
  study::Listeners listeners;
  listeners.on_record = [&rows](study::Row row) { rows->add(row); };
  if (every) listeners.on_event = [&every](study::Row row) { every->add(row); };
  listeners.keep_going = [&watch](double t_s) { return watch.keep_going(t_s); };
  listeners.keep_books = books;
  const Designing designing(held.controller.get());
  std::optional<base::Result<study::Outcome>> made;
  {
    const py::gil_scoped_release free;
    made.emplace(study::run(held.scenario, listeners));
  }
  std::optional<py::error_already_set> raised;
  if (held.controller) raised = held.controller->take_error();
  if (!*made && raised) throw std::move(*raised);
  Outcome out = outcome_of(held.scenario, taken(std::move(*made)));
  out.columns = columns;
  out.rows = rows;
  if (every) out.event_columns = study::all_columns();
  out.events = every;
  out.stopped_by = raised ? py::object(raised->value()) : watch.stopped_by();
  return out;
}

}  // namespace

void declare_run(py::module_& module) {
  module.def("run", &run, py::arg("scenario"), py::arg("books"), py::arg("events"), py::arg("progress"));
}

}  // namespace python
