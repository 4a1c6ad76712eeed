// SPDX-License-Identifier: Apache-2.0
// The results of a run for Python: numbers as a JSON text, recorded columns as arrays that are not copied.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "faces/python/src/rooms.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/run/run.hpp"

namespace python {

/// Recorded rows, column by column. Arrays in Python keep this object alive.
struct Rows {
  std::vector<std::vector<double>> columns;

  void add(study::Row row) {
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].push_back(row[c]);
  }
};

struct Outcome {
  std::string summary;  ///< text::json_summary()
  std::uint64_t digest = 0;
  bool passed = false, complete = false;
  double simulated_s = 0.0;
  std::vector<study::Column> columns, event_columns;
  std::shared_ptr<Rows> rows, events;  ///< `events`: empty unless requested
  pybind11::object stopped_by;         ///< the exception that ended the run early, or None
};

/// Creates empty rows with this number of columns.
std::shared_ptr<Rows> rows_of(std::size_t columns);

Outcome outcome_of(const study::Scenario& scenario, const study::Outcome& outcome);

void declare_outcome(pybind11::module_& module);

}  // namespace python
