// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/commands.hpp"

#include <algorithm>

#include "sixstep/control/drive.hpp"
#include "sixstep/control/own/own_pair.hpp"

namespace python {

namespace {

using sixstep::control::DriveConfig;
using sixstep::control::DriveState;

/// A thread-local variable, because the interface's design function has no argument for the exchange.
thread_local Exchange* opening = nullptr;

struct Opened {
  Exchange* exchange;
  std::uint8_t chopping;
  DriveConfig<double> loop;  ///< configuration of the current loop
};

const Opened& of(const void* config) { return *static_cast<const Opened*>(config); }

const char* design(const sixstep_given* given, const sixstep_real*, void* config) {
  if (opening == nullptr) return "is the command of an environment";
  auto& opened = *static_cast<Opened*>(config);
  opened.exchange = opening;
  opened.chopping = given->chopping;
  opened.exchange->current_A = given->current_limit_A > 0 ? given->current_limit_A : given->full_current_A;
  return nullptr;
}

const char* design_current(const sixstep_given* given, const sixstep_real* values, void* config) {
  if (given->current_d1 == 0.0) return "has no current loop in this mode";
  if (const char* problem = design(given, values, config)) return problem;
  DriveConfig<double>& loop = static_cast<Opened*>(config)->loop;
  loop.mode = sixstep::control::Mode::current;
  loop.chopping = static_cast<sixstep::control::Chopping>(given->chopping);
  loop.nominal_bus_V = given->bus_V;
  loop.current = {given->current_d1, given->current_d0, given->bus_V};
  loop.current_at_full_torque_A = given->full_current_A;
  loop.current_limit_A = static_cast<Opened*>(config)->exchange->current_A;
  return nullptr;
}

void note(Exchange& e, const sixstep_measured& measured, double setpoint) {
  e.seen = measured;
  e.setpoint = setpoint;
}

void step_pair(const void* config, void*, const sixstep_measured* measured, sixstep_real setpoint,
               sixstep_answer* answer) {
  const Opened& opened = of(config);
  note(*opened.exchange, *measured, setpoint);
  answer->chopping = opened.chopping;
  sixstep::control::command_pair(opened.exchange->action[0], measured->hall, *answer);
}

void at_hall_edge(const void* config, void*, uint8_t code, sixstep_answer* answer) {
  sixstep::control::command_pair(of(config).exchange->action[0], code, *answer);
}

void step_legs(const void* config, void*, const sixstep_measured* measured, sixstep_real setpoint,
               sixstep_answer* answer) {
  Exchange& e = *of(config).exchange;
  note(e, *measured, setpoint);
  answer->enabled = 1;
  for (std::size_t k = 0; k < 3; ++k)
    answer->leg[k] = {.state = SIXSTEP_LEG_PWM, .switches = SIXSTEP_PWM_COMPLEMENTARY, .duty = e.action[k]};
}

void step_current(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint,
                  sixstep_answer* answer) {
  const Opened& opened = of(config);
  note(*opened.exchange, *measured, setpoint);
  const double asked =
      std::clamp(opened.exchange->action[0], -opened.exchange->current_A, opened.exchange->current_A);
  auto& drive = *static_cast<DriveState<double>*>(state);
  sixstep::control::Telemetry<double> told{};
  sixstep::control::step(opened.loop, drive,
                         sixstep::control::Measurement<double>{.i_a_A = measured->current_A[0],
                                                               .i_b_A = measured->current_A[1],
                                                               .i_c_A = measured->current_A[2],
                                                               .speed_rad_s = measured->speed_rad_s,
                                                               .position_deg = measured->position_deg,
                                                               .bus_V = measured->bus_V,
                                                               .hall = measured->hall},
                         {asked}, told);
  answer->current_reference_A = told.current_reference_A;
  sixstep::control::answer_pair(drive.command, *answer);
}

void current_at_hall_edge(const void* config, void* state, uint8_t code, sixstep_answer* answer) {
  auto& drive = *static_cast<DriveState<double>*>(state);
  sixstep::control::answer_pair(sixstep::control::on_hall(of(config).loop, drive, code), *answer);
}

constexpr sixstep_controller commanded(uint32_t answers, decltype(sixstep_controller::design) designed,
                                       decltype(sixstep_controller::step) step,
                                       decltype(sixstep_controller::hall) hall) {
  return {.interface = SIXSTEP_OWN_INTERFACE,
          .answers = answers,
          .name = "environment",
          .sentence = "is commanded from outside",
          .config_bytes = sizeof(Opened),
          .state_bytes = sizeof(DriveState<double>),
          .parameters = 0,
          .parameter = nullptr,
          .design = designed,
          .start = nullptr,
          .step = step,
          .hall = hall};
}
constexpr sixstep_controller duty = commanded(SIXSTEP_ANSWERS_PAIR, design, step_pair, at_hall_edge);
constexpr sixstep_controller legs = commanded(SIXSTEP_ANSWERS_LEGS, design, step_legs, nullptr);
constexpr sixstep_controller current =
    commanded(SIXSTEP_ANSWERS_PAIR, design_current, step_current, current_at_hall_edge);

}  // namespace

std::optional<Action> action_of(std::string_view word) {
  if (word == "duty") return Action::duty;
  if (word == "legs") return Action::legs;
  if (word == "current") return Action::current;
  return std::nullopt;
}

const sixstep_controller& controller_of(Action action) {
  return action == Action::duty ? duty : action == Action::legs ? legs : current;
}

Opening::Opening(Exchange& exchange) { opening = &exchange; }
Opening::~Opening() { opening = nullptr; }

}  // namespace python
