// SPDX-License-Identifier: Apache-2.0
// The program of a core that runs a drive beside the host: it waits for a call, makes it, and sends the answer back
// (sixstep/rig/core_call.hpp). The drive is that of drive_config.hpp, as an exported header has it.
#include <drive_config.hpp>

#include "faces/firmware/bare/semihosting.hpp"
#include "sixstep/rig/core_call.hpp"

namespace {

using exported::Scalar;
namespace control = sixstep::control;
namespace rig = sixstep::rig;

/// The lean drive, or the product drive, by the name that the header gives its configuration.
#ifdef SIXSTEP_PRODUCT_DRIVE
using Call = rig::ProductCall<Scalar>;

control::ProtectedState<Scalar> state;
control::ProtectedTelemetry<Scalar> telemetry;

control::BridgeCommand<Scalar> made(const Call& call) {
  const control::BoardInput in = rig::input_of(call);
  switch (call.entry) {
    case rig::CoreEntry::start:
      state.position.sectors = static_cast<std::int32_t>(call.now);
      return {};
    case rig::CoreEntry::hall:
      return control::protected_on_hall(exported::product, state, in.hall_pins, in.now);
    case rig::CoreEntry::tick:
      break;
  }
  const control::Request request{.run = call.run != 0, .clear = call.clear != 0};
  return control::protected_step(exported::product, state, in, request, call.setpoint, telemetry);
}
#else
using Call = rig::LeanCall<Scalar>;

control::DriveState<Scalar> state;
control::Telemetry<Scalar> telemetry;

control::BridgeCommand<Scalar> made(const Call& call) {
  if (call.entry == rig::CoreEntry::hall)
    return control::on_hall(exported::drive, state, static_cast<std::uint8_t>(call.pins));
  control::step(exported::drive, state, call.measured, call.setpoint, telemetry);
  return state.command;
}
#endif

using Answer = rig::CoreAnswer<Scalar>;

/// The two ends of pipes that the emulator was given (faces/loop/emulator.cpp).
constexpr char calls_name[] = "/dev/fd/3", answers_name[] = "/dev/fd/4";

}  // namespace

namespace target {

void run() {
  const Word calls = open_file(calls_name, sizeof calls_name - 1, FileMode::read);
  const Word answers = open_file(answers_name, sizeof answers_name - 1, FileMode::write);
  if (calls == 0 || answers == 0) exit_with(2);
  const rig::CoreGreeting greeting{.call_bytes = sizeof(Call), .answer_bytes = sizeof(Answer)};
  if (!write_file(answers, &greeting, sizeof greeting)) return;
  static Call call;
  static Answer answer;
  while (read_file(calls, &call, sizeof call) == sizeof call) {
    answer = rig::answer_of(made(call));
    if (!write_file(answers, &answer, sizeof answer)) return;
  }
}

}  // namespace target
