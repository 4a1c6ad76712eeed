// SPDX-License-Identifier: Apache-2.0
// A user's controller for the program, in double. It calls the same controller compiled in float, so that the
// loop runs in the arithmetic of the chip. The file that SIXSTEP_OWN_TAPE names receives the inputs and
// answers of the float controller (tape.hpp). The tape is memory outside the controller's state, so only one
// run at a time can use it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>

#include "sixstep/control/own/own_controller.h"
#include "tests/target/own/tape.hpp"

// Includes the same header a second time, with float as the number type.
#undef SIXSTEP_CONTROL_OWN_OWN_CONTROLLER_H
#undef SIXSTEP_REAL
#undef SIXSTEP_OWN_INTERFACE
#define SIXSTEP_REAL float
#define sixstep_own_controller own_controller_in_float
namespace chip {
#include "sixstep/control/own/own_controller.h"
}
#undef sixstep_own_controller

namespace {

using target::Call, target::Digest;
constexpr std::uint32_t most_values = 64;

/// In memory, this struct precedes the configuration or the state of the controller. Both have the alignment
/// that the program requires.
struct alignas(16) Designed {
  chip::sixstep_given given;
  std::uint32_t count;
  float values[most_values];
};
struct alignas(16) Answered {
  chip::sixstep_answer answer;
};

const chip::sixstep_controller& own() { return *chip::own_controller_in_float(); }
template <class Front>
const void* behind(const void* front) {
  return static_cast<const Front*>(front) + 1;
}
template <class Front>
void* behind(void* front) {
  return static_cast<Front*>(front) + 1;
}

class Tape {
 public:
  /// If the configuration has changed, this function writes it first. A timeline may change it.
  void begin(Call call, const void* config) {
    const auto& now = *static_cast<const Designed*>(config);
    if (std::memcmp(&now, &last_, sizeof now) != 0) {
      std::memcpy(&last_, &now, sizeof now);
      byte(static_cast<std::uint8_t>(Call::design));
      target::bytes_of_given(now.given, [this](std::uint8_t x) { byte(x); });
      target::numbers_of_given(now.given, [this](float x) { number(x); });
      byte(static_cast<std::uint8_t>(now.count));
      for (std::uint32_t n = 0; n < now.count; ++n) number(now.values[n]);
    }
    byte(static_cast<std::uint8_t>(call));
  }
  void byte(std::uint8_t x) {
    if (file_ != nullptr) std::fputc(x, file_);
  }
  void word(std::uint32_t x) {
    for (int n = 0; n < 4; ++n) byte(static_cast<std::uint8_t>(x >> (8 * n)));
  }
  void number(float x) { word(__builtin_bit_cast(std::uint32_t, x)); }
  void answered(const chip::sixstep_answer& answer) {
    target::mix_answer(digest_, answer);
    word(digest_.value());
  }

 private:
  static std::FILE* open() {
    const char* const path = std::getenv("SIXSTEP_OWN_TAPE");
    return path ? std::fopen(path, "wb") : nullptr;
  }
  std::FILE* const file_ = open();  ///< closed at the end of the program
  Designed last_{};
  Digest digest_;
} tape;

template <class From, class To, class Each>
void in_other_numbers(const From& from, To& to, Each each) {
  double all[32];
  double* p = all;
  each(from, [&p](auto x) { *p++ = x; });
  p = all;
  each(to, [&p](auto& x) { x = static_cast<std::remove_reference_t<decltype(x)>>(*p++); });
}

sixstep_answer in_double(const chip::sixstep_answer& is) {
  sixstep_answer a{.enabled = is.enabled,
                   .fault = is.fault,
                   .source = is.source,
                   .sink = is.sink,
                   .chopping = is.chopping,
                   .chopped = is.chopped,
                   .duty = is.duty,
                   .overlap = is.overlap,
                   .leg = {},
                   .current_reference_A = is.current_reference_A,
                   .speed_reference_rad_s = is.speed_reference_rad_s};
  for (int k = 0; k < 3; ++k) a.leg[k] = {is.leg[k].state, is.leg[k].switches, is.leg[k].duty};
  return a;
}

const char* design(const sixstep_given* given, const double* values, void* config) {
  auto& is = *new (config) Designed{};
  in_other_numbers(*given, is.given, [](auto& g, auto take) {
    target::bytes_of_given(g, take);
    target::numbers_of_given(g, take);
  });
  is.count = own().parameters;
  for (std::uint32_t n = 0; n < is.count && n < most_values; ++n)
    is.values[n] = static_cast<float>(values[n]);
  return own().design(&is.given, is.values, behind<Designed>(config));
}

void start(const void* config, void* state) {
  new (state) Answered{};
  tape.begin(Call::start, config);
  if (own().start != nullptr) own().start(behind<Designed>(config), behind<Answered>(state));
}

void step(const void* config, void* state, const sixstep_measured* measured, double setpoint,
          sixstep_answer* answer) {
  chip::sixstep_measured seen{};
  seen.hall = measured->hall;
  in_other_numbers(*measured, seen, [](auto& m, auto take) { target::numbers_of_measured(m, take); });
  const float wanted = static_cast<float>(setpoint);
  tape.begin(Call::step, config);
  tape.byte(seen.hall);
  target::numbers_of_measured(seen, [](float x) { tape.number(x); });
  tape.number(wanted);
  chip::sixstep_answer& own_answer = static_cast<Answered*>(state)->answer;
  own().step(behind<Designed>(config), behind<Answered>(state), &seen, wanted, &own_answer);
  tape.answered(own_answer);
  *answer = in_double(own_answer);
}

void hall(const void* config, void* state, std::uint8_t code, sixstep_answer* answer) {
  tape.begin(Call::hall, config);
  tape.byte(code);
  chip::sixstep_answer& own_answer = static_cast<Answered*>(state)->answer;
  own().hall(behind<Designed>(config), behind<Answered>(state), code, &own_answer);
  tape.answered(own_answer);
  *answer = in_double(own_answer);
}

const sixstep_controller* described() {
  static sixstep_parameter parameter[most_values];
  static sixstep_controller is{
      .interface = SIXSTEP_OWN_INTERFACE,
      .answers = own().answers,
      .name = own().name,
      .sentence = own().sentence,
      .config_bytes = own().config_bytes + static_cast<std::uint32_t>(sizeof(Designed)),
      .state_bytes = own().state_bytes + static_cast<std::uint32_t>(sizeof(Answered)),
      .parameters = own().parameters,
      .parameter = parameter,
      .design = design,
      .start = start,
      .step = step,
      .hall = own().hall ? hall : nullptr};
  for (std::uint32_t n = 0; n < is.parameters && n < most_values; ++n) {
    const chip::sixstep_parameter& p = own().parameter[n];
    parameter[n] = {p.name, p.unit, p.meaning, p.preset, p.least, p.most};
  }
  return &is;
}

}  // namespace

extern "C" const sixstep_controller* sixstep_own_controller(void) { return described(); }
