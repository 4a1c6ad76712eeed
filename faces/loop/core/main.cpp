// SPDX-License-Identifier: Apache-2.0
// Runs a drive on a core in parallel with the host: waits for a call, executes it, and sends the answer
// (sixstep/rig/core_call.hpp). drive_config.hpp, an exported header, configures the drive.
#include <drive_config.hpp>

#include "faces/firmware/bare/semihosting.hpp"
#include "sixstep/rig/core_call.hpp"
#ifdef SIXSTEP_SENSORLESS_DRIVE
#include "sixstep/rig/sensorless_call.hpp"
#endif

namespace {

using exported::Scalar;
namespace control = sixstep::control;
namespace rig = sixstep::rig;

/// Selects the library's drive for the type of configuration in the header.
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
#elif defined(SIXSTEP_FIELD_DRIVE)
using Call = rig::FieldCall<Scalar>;

control::FieldDriveState<Scalar> state;
control::Telemetry<Scalar> telemetry;

const control::LegCommands<Scalar>& made(const Call& call) {
  const Scalar speed_rad_s = call.measured.speed_rad_s;
  const control::FieldDriveInput<Scalar> input{
      .measured = call.measured,
      .magnet = call.decoded != 0
                    ? control::field_directions(exported::field.advance, call.electrical, speed_rad_s)
                    : call.magnet};
  return control::field_drive_step(exported::field, state, input, call.setpoint, telemetry);
}
#elif defined(SIXSTEP_SENSORLESS_FIELD_DRIVE)
using Call = rig::FieldCall<Scalar>;

control::SensorlessFieldState<Scalar> state;
control::Telemetry<Scalar> telemetry;

const control::LegCommands<Scalar>& made(const Call& call) {
  const control::FieldDriveInput<Scalar> input{.measured = call.measured, .magnet = {}};
  return control::sensorless_field_step(exported::sensorless_field, state, input, call.setpoint, telemetry);
}
#elif defined(SIXSTEP_SENSORLESS_DRIVE)
using Call = rig::SensorlessCall<Scalar>;

control::PulsedDriveState<Scalar> state;
control::Telemetry<Scalar> telemetry;

const control::PulsedDriveState<Scalar>& made(const Call& call) {
  const auto& drive = exported::sensorless.drive;
  const auto pins = static_cast<std::uint8_t>(call.pins);
  if (call.entry == rig::CoreEntry::capture)
    control::sensorless_capture(state.drive.sensorless, pins, call.now);
  else if (call.entry == rig::CoreEntry::hall)
    control::sensorless_drive_hall(drive, state.drive, pins, call.now);
  else if (call.entry == rig::CoreEntry::commutate)
    control::sensorless_drive_commutate(drive, state.drive, call.now);
  else
    control::pulsed_drive_step(exported::sensorless, state, rig::input_of(call), call.setpoint, telemetry);
  return state;
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

using Answer = decltype(rig::answer_of(made(Call{})));

/// Names of the pipes' ends in the emulator's process (faces/loop/emulator.cpp).
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
