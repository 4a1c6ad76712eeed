// SPDX-License-Identifier: Apache-2.0
#include "faces/c/caller.hpp"

namespace c_face {

namespace {

thread_local Exchange* present = nullptr;

const char* design(const sixstep_given*, const sixstep_real*, void*) { return nullptr; }

void step(const void*, void*, const sixstep_measured* measured, sixstep_real setpoint,
          sixstep_answer* answer) {
  if (present == nullptr) return;
  present->measured = *measured;
  present->setpoint = setpoint;
  *answer = present->answer;
}

constexpr sixstep_controller controller(std::uint32_t answers) {
  return {.interface = SIXSTEP_OWN_INTERFACE,
          .answers = answers,
          .name = "caller",
          .sentence = "is the program that uses the library",
          .config_bytes = 0,
          .state_bytes = 0,
          .parameters = 0,
          .parameter = nullptr,
          .design = design,
          .start = nullptr,
          .step = step,
          .hall = nullptr};
}

/// Gates change only where the chip stops. If the caller's gates differ from the gates in effect, the chip
/// stops at once; else it stops at the next requested instant.
rig::CoreTrouble run_chip(void*, const rig::ChipRun&, rig::ChipAnswer& answer) {
  if (present == nullptr) return rig::CoreTrouble::gone;
  if (answer.gates == present->gates) answer.cycle = static_cast<std::uint64_t>(present->stop_ps);
  answer.gates = present->gates;
  answer.event = rig::ChipEvent::gates;
  return rig::CoreTrouble::none;
}

}  // namespace

Exchanging::Exchanging(Exchange& exchange) : before_(present) { present = &exchange; }
Exchanging::~Exchanging() { present = before_; }

const sixstep_controller* caller_controller(bool legs) {
  static constexpr sixstep_controller pair = controller(SIXSTEP_ANSWERS_PAIR),
                                      three_legs = controller(SIXSTEP_ANSWERS_LEGS);
  return legs ? &three_legs : &pair;
}

rig::ChipPort caller_chip() {
  return {.chip = nullptr, .run = run_chip, .clock_Hz = 1'000'000'000'000, .converts = false};
}

}  // namespace c_face
