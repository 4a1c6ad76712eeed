// SPDX-License-Identifier: Apache-2.0
// Makes a controller (own_controller.h) from a C++ class: the class's static functions provide the function
// pointers of the C interface. The class has
//
//   struct Config; struct State;                              both trivially copyable, all zero before design and start
//   static constexpr sixstep_parameter parameters[];          optional
//   static const char* design(const sixstep_given&, const sixstep_real* values, Config&);
//   static void start(const Config&, State&);                 optional: without it State begins as State{}
//   static void step(const Config&, State&, const sixstep_measured&, sixstep_real setpoint, sixstep_answer&);
//   static void hall(const Config&, State&, std::uint8_t code, sixstep_answer&);   optional (own_controller.h)
//
// This line defines the shared object's symbol:
//
//   SIXSTEP_OWN_CONTROLLER(Class, SIXSTEP_ANSWERS_PAIR, "name", "it ...")
#pragma once
#include <cstdint>

#include "sixstep/control/own/own_controller.h"

namespace sixstep::control {

template <class Class>
struct OwnFunctions {
  using Config = typename Class::Config;
  using State = typename Class::State;
  static_assert(__is_trivially_copyable(Config) && __is_trivially_copyable(State),
                "the program copies config and state as bytes");

  static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) {
    auto& own = *static_cast<Config*>(config);
    own = Config{};
    return Class::design(*given, values, own);
  }
  static void start(const void* config, void* state) {
    auto& own = *static_cast<State*>(state);
    own = State{};
    if constexpr (requires { Class::start(*static_cast<const Config*>(config), own); })
      Class::start(*static_cast<const Config*>(config), own);
  }
  static void step(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint,
                   sixstep_answer* answer) {
    Class::step(*static_cast<const Config*>(config), *static_cast<State*>(state), *measured, setpoint,
                *answer);
  }
  static void hall(const void* config, void* state, std::uint8_t code, sixstep_answer* answer) {
    if constexpr (has_hall)
      Class::hall(*static_cast<const Config*>(config), *static_cast<State*>(state), code, *answer);
  }
  static constexpr bool has_hall = requires(const Config& config, State& state, sixstep_answer& answer) {
    Class::hall(config, state, std::uint8_t{}, answer);
  };
  static constexpr const sixstep_parameter* first_parameter() {
    if constexpr (requires { Class::parameters; }) return Class::parameters;
    return nullptr;
  }
  static constexpr std::uint32_t parameter_count() {
    if constexpr (requires { Class::parameters; })
      return sizeof(Class::parameters) / sizeof(sixstep_parameter);
    return 0;
  }
};

/// The sixstep_controller of the C++ class.
template <class Class>
constexpr sixstep_controller own_controller(std::uint32_t answers, const char* name, const char* sentence) {
  using F = OwnFunctions<Class>;
  return {.interface = SIXSTEP_OWN_INTERFACE,
          .answers = answers,
          .name = name,
          .sentence = sentence,
          .config_bytes = sizeof(typename Class::Config),
          .state_bytes = sizeof(typename Class::State),
          .parameters = F::parameter_count(),
          .parameter = F::first_parameter(),
          .design = F::design,
          .start = F::start,
          .step = F::step,
          .hall = F::has_hall ? F::hall : nullptr};
}

}  // namespace sixstep::control

#define SIXSTEP_OWN_CONTROLLER(Class, answers, name, sentence)            \
  extern "C" const sixstep_controller* sixstep_own_controller(void) {     \
    static constexpr sixstep_controller own =                             \
        sixstep::control::own_controller<Class>(answers, name, sentence); \
    return &own;                                                          \
  }
