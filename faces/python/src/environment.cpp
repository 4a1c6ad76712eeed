// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/environment.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "faces/python/src/commands.hpp"
#include "faces/python/src/crew.hpp"
#include "faces/python/src/problems.hpp"
#include "faces/python/src/scenario.hpp"
#include "sixstep/control/own/own_pair.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "sixstep/study/session/session.hpp"

namespace python {

namespace py = pybind11;

namespace {

/// Names of the observed quantities: the board's measurements at a control tick, and the setpoint of the
/// scenario.
constexpr std::array observed = {"i_a_A",        "i_b_A",           "i_c_A",      "speed_rad_s",
                                 "position_deg", "bus_V",           "magnet_cos", "magnet_sin",
                                 "hall",         "motor_current_A", "setpoint"};

struct Drive {
  std::unique_ptr<Exchange> exchange = std::make_unique<Exchange>();
  std::optional<study::Session> session;
  std::uint64_t periods = 0;  ///< number of periods since the drive's reset
  bool over = true;
};

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

class Environment {
 public:
  Environment(const HeldScenario& held, std::size_t drives, Action action, std::size_t workers)
      : scenario_(held.scenario),
        actions_(columns_of(action)),
        drives_(drives),
        crew_(std::max<std::size_t>(1, workers)) {
    scenario_.control.drive = study::FirmwareKind::own;
    scenario_.control.own = {.controller = "environment", .number = {}, .loaded = &controller_of(action)};
  }

  /// Bound of a current setpoint, A.
  double most_current_A() const {
    Exchange tried;
    (void)opened(scenario_, tried);
    return tried.current_A;
  }

  /// Restarts drive which[k] as drive numbers[k] of the scenario's [spread] with this seed. If numbers[k] is
  /// empty, the drive has the scenario's values.
  void reset(const std::vector<std::size_t>& which, std::uint64_t seed,
             const std::vector<std::optional<std::uint64_t>>& numbers) {
    for (std::size_t k = 0; k < which.size(); ++k) {
      Drive& drive = drives_.at(which[k]);
      *drive.exchange = {};
      drive.session.emplace(
          opened(numbers.at(k) ? study::varied(scenario_, seed, *numbers[k]) : scenario_, *drive.exchange));
      drive.periods = 0;
      drive.over = false;
      advance(drive, 1);
    }
  }

  /// Advances each drive by `periods` control periods under its action. `over` is set for a drive whose run
  /// has ended.
  void step(const Numbers& actions, std::uint64_t periods) {
    if (actions.ndim() != 2 || static_cast<std::size_t>(actions.shape(0)) != drives_.size() ||
        static_cast<std::size_t>(actions.shape(1)) != actions_)
      throw py::value_error("actions need the shape (" + std::to_string(drives_.size()) + ", " +
                            std::to_string(actions_) + ")");
    if (!crew_.has_threads())
      throw py::value_error(
          "the environment was made in another process; make an environment in each process");
    for (const Drive& drive : drives_)
      if (!drive.session) throw py::value_error("call reset() before the first step()");
    for (std::size_t n = 0; n < drives_.size(); ++n)
      for (std::size_t k = 0; k < actions_; ++k) drives_[n].exchange->action[k] = actions.at(n, k);
    for (; periods > 0; periods -= std::min(periods, between_looks)) {
      {
        const py::gil_scoped_release free;
        crew_.each(drives_.size(),
                   [&](std::size_t n) { advance(drives_[n], std::min(periods, between_looks)); });
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
  }

  Numbers observations() const {
    Numbers out({drives_.size(), observed.size()});
    double* to = out.mutable_data();
    for (const Drive& drive : drives_) {
      const sixstep_measured& m = drive.exchange->seen;
      const std::array<double, observed.size()> row = {m.current_A[0],
                                                       m.current_A[1],
                                                       m.current_A[2],
                                                       m.speed_rad_s,
                                                       m.position_deg,
                                                       m.bus_V,
                                                       m.magnet_cos,
                                                       m.magnet_sin,
                                                       static_cast<double>(m.hall),
                                                       control::pair_current(m),
                                                       drive.exchange->setpoint};
      to = std::copy(row.begin(), row.end(), to);
    }
    return out;
  }
  py::array_t<bool> over() const {
    return each([](const Drive& drive) { return drive.over; });
  }
  /// For each drive, whether a fault ended the run before its time.
  py::array_t<bool> failed() const {
    return each([this](const Drive& drive) {
      return drive.over && drive.session && drive.session->now_s() < scenario_.duration_s * (1.0 - 1e-9);
    });
  }

 private:
  static constexpr std::uint64_t between_looks =
      1000;  ///< number of periods between two checks for Ctrl-C; they take about a millisecond of computing

  static study::Session opened(const study::Scenario& scenario, Exchange& exchange) {
    const Opening commanded(exchange);
    return taken(study::Session::open(scenario, {.keep_books = false}));
  }

  template <class Property>
  py::array_t<bool> each(Property&& property) const {
    py::array_t<bool> out(static_cast<py::ssize_t>(drives_.size()));
    for (std::size_t n = 0; n < drives_.size(); ++n)
      out.mutable_at(static_cast<py::ssize_t>(n)) = property(drives_[n]);
    return out;
  }
  /// Advances to three quarters of the last period. The period's tick, at its start or in its middle, is then
  /// over.
  void advance(Drive& drive, std::uint64_t periods) const {
    if (drive.over) return;
    drive.periods += periods;
    const double to_s = (static_cast<double>(drive.periods) - 0.25) * scenario_.pwm.period_s;
    drive.over = !drive.session->skip(to_s);
  }

  study::Scenario scenario_;
  std::size_t actions_;
  std::vector<Drive> drives_;
  Crew crew_;
};

}  // namespace

void declare_environment(py::module_& module) {
  py::class_<Environment>(module, "Environment")
      .def(py::init(
          [](const HeldScenario& held, std::size_t drives, const std::string& action, std::size_t workers) {
            const std::optional<Action> known = action_of(action);
            if (!known)
              throw py::value_error("action = \"" + action + "\" must be \"duty\", \"legs\" or \"current\"");
            return std::make_unique<Environment>(held, drives, *known, workers);
          }))
      .def_property_readonly("most_current_A", &Environment::most_current_A)
      .def("reset", &Environment::reset)
      .def("step", &Environment::step)
      .def("observations", &Environment::observations)
      .def("over", &Environment::over)
      .def("failed", &Environment::failed);
  py::tuple names(observed.size());
  for (std::size_t n = 0; n < observed.size(); ++n) names[n] = observed[n];
  module.attr("observed") = names;
}

}  // namespace python
