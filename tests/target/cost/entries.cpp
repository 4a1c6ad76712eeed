// SPDX-License-Identifier: Apache-2.0
#include "tests/target/cost/entries.hpp"

namespace target {

const Answer* answer;
namespace {

Setpoint<Scalar> setpoint;
#if TARGET_PRODUCT
ProtectedState<Scalar> state;
ProtectedTelemetry<Scalar> telemetry;
BoardInput input;
Request request;

inline void tick() {
  answer = &protected_step(exported::product, state, input, request, setpoint, telemetry);
}
inline void hall() { answer = &protected_on_hall(exported::product, state, input.hall_pins, input.now); }
#elif TARGET_FIELD
FieldDriveState<Scalar> state;
Telemetry<Scalar> telemetry;
FieldDriveInput<Scalar> input;
BinaryAngle electrical;  ///< the decoder's angle

inline void tick() {
  input.magnet = field_directions(exported::field.advance, electrical, input.measured.speed_rad_s);
  answer = &field_drive_step(exported::field, state, input, setpoint, telemetry);
}
inline void hall() {}
#else
DriveState<Scalar> state;
Telemetry<Scalar> telemetry;
Measurement<Scalar> measured;

inline void tick() { answer = &step(exported::drive, state, measured, setpoint, telemetry); }
inline void hall() { answer = &on_hall(exported::drive, state, measured.hall); }
#endif

}  // namespace

void give(const Record& record) {
#if TARGET_PRODUCT
  if (record.kind != 0) {
    input.hall_pins = record.input.hall_pins;
    input.now = record.input.now;
    return;
  }
  input = record.input;
  request = record.request;
#elif TARGET_FIELD
  input.measured = record.measured;
  electrical = record.electrical;
#else
  measured.hall = record.measured.hall;
  if (record.kind != 0) return;
  measured = record.measured;
#endif
  setpoint = record.setpoint;
}

}  // namespace target

extern "C" {
__attribute__((noinline, used)) void entry_tick() { target::tick(); }
__attribute__((noinline, used)) void entry_hall() { target::hall(); }

#if defined __AVR__ && !defined TARGET_NO_INTERRUPTS
// The same entries as interrupts, which save the registers that they use. INT0 is vector 1 of the ATmega2560,
// and INT1 is vector 2.
void __vector_1() __attribute__((signal, used));
void __vector_2() __attribute__((signal, used));
void __vector_1() { target::tick(); }
void __vector_2() { target::hall(); }
#endif
}
