// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/session/session.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "faces/python/src/outcome.hpp"
#include "faces/python/src/problems.hpp"
#include "faces/python/src/scenario.hpp"
#include "faces/python/src/session.hpp"
#include "faces/python/src/watch.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "text/scenario/scenario_text.hpp"

namespace python {

namespace py = pybind11;

namespace {

/// Allows one call at a time. A session advances without the GIL; meanwhile another thread may call the same
/// session.
class Busy {
 public:
  explicit Busy(std::atomic<bool>& busy) : busy_(busy) {
    if (busy_.exchange(true))
      throw py::value_error(
          "the session is in use, by another thread or by its own controller; give each thread a copy()");
  }
  ~Busy() { busy_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::atomic<bool>& busy_;
};

/// The rows into which this thread's call records. They are not in the listener: a copied session copies its
/// listener, but must record into its own rows.
thread_local Rows* recording = nullptr;

class Recording {
 public:
  explicit Recording(Rows& rows) { recording = &rows; }
  ~Recording() { recording = nullptr; }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
};

class Session {
 public:
  explicit Session(const HeldScenario& held)
      : controller_(held.controller),
        columns_(taken(study::record_columns(held.scenario))),
        rows_(rows_of(columns_.size())),
        part_s_(1000 * held.scenario.pwm.period_s) {
    const Designing designing(controller_.get());
    const Recording into(*rows_);
    study::Listeners listeners;
    listeners.on_record = [](study::Row row) {
      if (recording) recording->add(row);
    };
    session_.emplace(taken(study::Session::open(held.scenario, listeners)));
  }

  /// The copy contains the rows so far.
  std::unique_ptr<Session> copied() {
    if (controller_)
      throw py::value_error(
          "a session with a controller in Python cannot be copied: the copy would share the controller's state");
    const Busy busy(busy_);
    return std::unique_ptr<Session>(new Session(open(), columns_, *rows_, part_s_));
  }

  bool advance(double to_s) {
    const Busy busy(busy_);
    study::Session& session = open();
    Watch watch{py::none()};
    bool goes_on = true;
    {
      const py::gil_scoped_release free;
      const Recording into(*rows_);
      // Advances in parts, with a check for Ctrl-C after each part. The parts do not change a bit.
      while (goes_on && session.now_s() + part_s_ < to_s && watch.keep_going(session.now_s()))
        goes_on = session.skip(session.now_s() + part_s_);
      // After Ctrl-C, reads the values at the reached instant.
      if (goes_on) goes_on = session.advance(watch.stopped_by_nothing() ? to_s : session.now_s());
    }
    std::optional<py::error_already_set> raised;
    if (controller_) raised = controller_->take_error();
    if (raised) {
      session_.reset();  // the state of the Python controller does not allow the run to continue
      throw std::move(*raised);
    }
    if (!watch.stopped_by_nothing()) watch.raise();
    return goes_on;
  }

  double change(const HeldScenario& with) {
    const Busy busy(busy_);
    if (with.scenario.at.empty()) throw py::value_error("the text has no change");
    const Designing designing(controller_.get());
    return taken(open().change(with.scenario.at.back()));
  }

  Outcome close() {
    const Busy busy(busy_);
    study::Session& session = open();
    const Designing designing(controller_.get());
    const Recording into(*rows_);
    study::Outcome outcome = taken(session.close());
    Outcome out = outcome_of(session.scenario(), outcome);
    out.columns = columns_;
    out.rows = rows_;
    session_.reset();
    return out;
  }

  py::array_t<double> signals() {
    study::Session& session = open();
    study::FullRow row = session.present().signals;
    for (std::size_t c = 0; c < row.size(); ++c)
      if (!study::applies(static_cast<study::ColumnId>(c), session.scenario()))
        row[c] = std::numeric_limits<double>::quiet_NaN();
    return py::array_t<double>(static_cast<py::ssize_t>(row.size()), row.data());
  }
  double present_s() { return open().present().t_s; }
  double now_s() { return open().now_s(); }
  bool over() { return !session_ || session_->over(); }
  std::string text() { return text::scenario_text(open().scenario()); }

 private:
  Session(const study::Session& other, const std::vector<study::Column>& columns, const Rows& rows,
          double part_s)
      : columns_(columns), rows_(std::make_shared<Rows>(rows)), part_s_(part_s), session_(other) {}

  study::Session& open() {
    if (!session_) throw py::value_error("the session is closed");
    return *session_;
  }

  std::shared_ptr<Controller> controller_;
  std::vector<study::Column> columns_;
  std::shared_ptr<Rows> rows_;
  double part_s_;  ///< simulated time between two checks for Ctrl-C
  std::optional<study::Session> session_;
  std::atomic<bool> busy_ = false;
};

}  // namespace

void declare_session(py::module_& module) {
  py::class_<Session>(module, "Session")
      .def(py::init<const HeldScenario&>())
      .def("advance", &Session::advance)
      .def("change", &Session::change)
      .def("close", &Session::close)
      .def("copy", &Session::copied)
      .def("signals", &Session::signals)
      .def("text", &Session::text)
      .def_property_readonly("present_s", &Session::present_s)
      .def_property_readonly("now_s", &Session::now_s)
      .def_property_readonly("over", &Session::over);
  std::vector<std::tuple<std::string, std::string, std::string, std::string>> signals;
  for (const study::Column& c : study::all_columns())
    signals.emplace_back(c.name, c.unit, c.frame, c.meaning);
  module.attr("signals") = signals;
}

}  // namespace python
