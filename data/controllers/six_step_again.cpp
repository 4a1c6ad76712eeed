// SPDX-License-Identifier: Apache-2.0
// The built-in six-step drive (sixstep/control/drive.hpp), loaded as a user's controller. Its outputs are
// equal to the outputs of the built-in drive to the last bit. A user can start from this file to replace one
// block.
#include "sixstep/control/drive.hpp"
#include "sixstep/control/own/own_controller.hpp"
#include "sixstep/control/own/own_pair.hpp"

namespace {

using namespace sixstep::control;

struct SixStepAgain {
  using Config = DriveConfig<sixstep_real>;
  using State = DriveState<sixstep_real>;

  static const char* design(const sixstep_given& given, const sixstep_real*, Config& config) {
    constexpr Mode modes[] = {Mode::off, Mode::duty, Mode::current, Mode::speed, Mode::position};
    config.mode = modes[given.mode];
    config.chopping = static_cast<Chopping>(given.chopping);
    config.nominal_bus_V = given.bus_V;
    config.current = {given.current_d1, given.current_d0, given.bus_V};
    config.speed = {given.speed_d1, given.speed_d0, 1.0};
    if (given.current_limit_A < given.full_current_A)
      config.speed.limit = given.current_limit_A / given.full_current_A;
    config.current_at_full_torque_A = given.full_current_A;
    config.current_limit_A = given.current_limit_A;
    config.position_gain = given.position_gain_rad_s_per_deg;
    config.speed_limit_rad_s = given.speed_limit_rad_s;
    return nullptr;
  }

  static void step(const Config& config, State& state, const sixstep_measured& seen, sixstep_real setpoint,
                   sixstep_answer& answer) {
    Telemetry<sixstep_real> telemetry{};
    sixstep::control::step(config, state,
                           Measurement<sixstep_real>{.i_a_A = seen.current_A[0],
                                                     .i_b_A = seen.current_A[1],
                                                     .i_c_A = seen.current_A[2],
                                                     .speed_rad_s = seen.speed_rad_s,
                                                     .position_deg = seen.position_deg,
                                                     .bus_V = seen.bus_V,
                                                     .hall = seen.hall},
                           {setpoint}, telemetry);
    answer.current_reference_A = telemetry.current_reference_A;
    answer.speed_reference_rad_s = telemetry.speed_reference_rad_s;
    answer_pair(state.command, answer);
  }

  static void hall(const Config& config, State& state, std::uint8_t code, sixstep_answer& answer) {
    answer_pair(on_hall(config, state, code), answer);
  }
};

}  // namespace

SIXSTEP_OWN_CONTROLLER(SixStepAgain, SIXSTEP_ANSWERS_PAIR, "six-step, again",
                       "is the library's drive, built as a user's own controller")
