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

#include "faces/python/src/crew.hpp"
#include "faces/python/src/problems.hpp"
#include "faces/python/src/scenario.hpp"
#include "sixstep/control/own/own_pair.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "sixstep/study/session/session.hpp"

namespace python {

namespace py = pybind11;

namespace {

/// What a board observes at a control tick, and the setpoint of the scenario's reference.
constexpr std::array observed = {"i_a_A",        "i_b_A",           "i_c_A",      "speed_rad_s",
                                 "position_deg", "bus_V",           "magnet_cos", "magnet_sin",
                                 "hall",         "motor_current_A", "setpoint"};

/// The command of one drive for its next tick, and what it saw at its last one.
struct Exchange {
  std::array<double, 3> action{};
  sixstep_measured seen{};
  double setpoint = 0.0;
  uint8_t chopping = SIXSTEP_SOFT;
};

/// The interface's design function has no argument for it: the drive whose session this thread opens.
thread_local Exchange* opening = nullptr;

struct Opened {
  Exchange* exchange;
};

Exchange& of(const void* config) { return *static_cast<const Opened*>(config)->exchange; }

const char* design(const sixstep_given* given, const sixstep_real*, void* config) {
  if (opening == nullptr) return "is the command of an environment";
  opening->chopping = given->chopping;
  static_cast<Opened*>(config)->exchange = opening;
  return nullptr;
}

void note(Exchange& e, const sixstep_measured& measured, double setpoint) {
  e.seen = measured;
  e.setpoint = setpoint;
}

void step_pair(const void* config, void*, const sixstep_measured* measured, sixstep_real setpoint,
               sixstep_answer* answer) {
  Exchange& e = of(config);
  note(e, *measured, setpoint);
  answer->chopping = e.chopping;
  control::command_pair(e.action[0], measured->hall, *answer);
}

void at_hall_edge(const void* config, void*, uint8_t code, sixstep_answer* answer) {
  control::command_pair(of(config).action[0], code, *answer);
}

void step_legs(const void* config, void*, const sixstep_measured* measured, sixstep_real setpoint,
               sixstep_answer* answer) {
  Exchange& e = of(config);
  note(e, *measured, setpoint);
  answer->enabled = 1;
  for (std::size_t k = 0; k < 3; ++k)
    answer->leg[k] = {.state = SIXSTEP_LEG_PWM, .switches = SIXSTEP_PWM_COMPLEMENTARY, .duty = e.action[k]};
}

constexpr sixstep_controller commanded(uint32_t answers, decltype(sixstep_controller::step) step,
                                       decltype(sixstep_controller::hall) hall) {
  return {.interface = SIXSTEP_OWN_INTERFACE,
          .answers = answers,
          .name = "environment",
          .sentence = "is commanded from outside",
          .config_bytes = sizeof(Opened),
          .state_bytes = 8,
          .parameters = 0,
          .parameter = nullptr,
          .design = design,
          .start = nullptr,
          .step = step,
          .hall = hall};
}
constexpr sixstep_controller pairs = commanded(SIXSTEP_ANSWERS_PAIR, step_pair, at_hall_edge);
constexpr sixstep_controller legs = commanded(SIXSTEP_ANSWERS_LEGS, step_legs, nullptr);

struct Drive {
  std::unique_ptr<Exchange> exchange = std::make_unique<Exchange>();
  std::optional<study::Session> session;
  std::uint64_t periods = 0;  ///< since its reset
  bool over = true;
};

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

class Environment {
 public:
  Environment(const HeldScenario& held, std::size_t drives, bool of_legs, std::size_t workers)
      : scenario_(held.scenario),
        actions_(of_legs ? 3 : 1),
        drives_(drives),
        crew_(std::max<std::size_t>(1, workers)) {
    scenario_.control.drive = study::FirmwareKind::own;
    scenario_.control.own = {.controller = "environment", .number = {}, .loaded = of_legs ? &legs : &pairs};
  }

  /// Starts drive n anew as drive `numbers[n]` of the scenario's [spread] with this seed; none: as it is written.
  void reset(const std::vector<std::size_t>& which, std::uint64_t seed,
             const std::vector<std::optional<std::uint64_t>>& numbers) {
    for (std::size_t k = 0; k < which.size(); ++k) {
      Drive& drive = drives_.at(which[k]);
      *drive.exchange = {};
      opening = drive.exchange.get();
      base::Result<study::Session> opened = study::Session::open(
          numbers.at(k) ? study::varied(scenario_, seed, *numbers[k]) : scenario_, {.keep_books = false});
      opening = nullptr;
      drive.session.emplace(taken(std::move(opened)));
      drive.periods = 0;
      drive.over = false;
      advance(drive, 1);
    }
  }

  /// Each drive goes on by so many control periods under its action. True in `over`: its run has ended.
  void step(const Numbers& actions, std::uint64_t periods) {
    if (actions.ndim() != 2 || static_cast<std::size_t>(actions.shape(0)) != drives_.size() ||
        static_cast<std::size_t>(actions.shape(1)) != actions_)
      throw py::value_error("actions need the shape (" + std::to_string(drives_.size()) + ", " +
                            std::to_string(actions_) + ")");
    if (!crew_.has_threads())
      throw py::value_error("the environment was made in another process; make one in each process");
    for (const Drive& drive : drives_)
      if (!drive.session) throw py::value_error("reset() comes before the first step()");
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
                                                       motor_current_A(m),
                                                       drive.exchange->setpoint};
      to = std::copy(row.begin(), row.end(), to);
    }
    return out;
  }
  py::array_t<bool> over() const {
    return each([](const Drive& drive) { return drive.over; });
  }
  /// A fault ended the run before its time.
  py::array_t<bool> failed() const {
    return each([this](const Drive& drive) {
      return drive.over && drive.session && drive.session->now_s() < scenario_.duration_s * (1.0 - 1e-9);
    });
  }

 private:
  static constexpr std::uint64_t between_looks = 1000;  ///< periods without a look at Ctrl-C: a millisecond

  template <class Property>
  py::array_t<bool> each(Property&& property) const {
    py::array_t<bool> out(static_cast<py::ssize_t>(drives_.size()));
    for (std::size_t n = 0; n < drives_.size(); ++n)
      out.mutable_at(static_cast<py::ssize_t>(n)) = property(drives_[n]);
    return out;
  }
  /// A tick lies at the start or in the middle of a period: up to three quarters of one, each advance contains one.
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
      .def(py::init<const HeldScenario&, std::size_t, bool, std::size_t>())
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
