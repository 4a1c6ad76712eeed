// SPDX-License-Identifier: Apache-2.0
// Both entries of the lean drive on an ATmega2560 (16 MHz), a current loop in Q15. One shunt in the DC link
// on ADC0, upper gates on OC1A..OC1C (timer 1), lower gates on PA0..PA2, Hall pins on PK0..PK2. The protected
// drive takes five times as long here (docs/firmware.md): what it would watch is the two lines that set `fault`.
#include "faces/firmware/example/avr/bridge.hpp"
#include "faces/firmware/example/avr/drive_config.hpp"
#include "faces/firmware/example/avr/registers.hpp"
#include "sixstep/control/adc.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/one_shunt.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::drive, exported::Scalar, exported::units;

static_assert(drive.mode == Mode::current && drive.chopping == Chopping::soft &&
                  drive.extras.pwm.pattern == PwmPattern::upper,
              "what these pins and loops are for");
static_assert(!(Scalar{} < drive.extras.commutation.overlap_bus_V),
              "the leg in no pair has no pulse of its own here");
static_assert(exported::pwm_centre_aligned && exported::command_delayed,
              "timer 1 counts up and down, and its compare registers are taken at the top");
// Up and down again, of 1/16 MHz.
constexpr auto pwm_counts = static_cast<std::uint32_t>(exported::pwm_period_ps / 62'500 / 2);

// 5 V over 10 bits, 0.1 V/A, 0 A in the middle: 25 A both ways
constexpr AdcConfig<Scalar> adc{
    .per_eighth = units.amperes_per_count(5.0 / 1024 / 0.1), .offset_counts = 512, .offset_tolerance = 15};
constexpr OneShuntConfig<Scalar> shunt{
    // settled 15 us after the edge, half an on-time before the sample
    .least_duty = units.plain(0.1),  // 2 times 15 of 300 us; fade = exp(-T R/L)
    .commutation_samples = 2,
    .fade = units.plain(0.583)};
constexpr Scalar over_current = units.amperes(24);

DriveState<Scalar> state;
AdcState adc_state;
OneShuntState<Scalar> shunt_state;
Telemetry<Scalar> telemetry;      // for a display; the drive never reads it
std::uint8_t carried = 0;         // code whose pair carried the last sample
bool run = false, fault = false;  // from and for the main loop, with interrupts off; a fault stays
Setpoint<Scalar> setpoint;        // A

std::uint8_t hall_pins() {  // PK0 is H1, the highest bit
  const std::uint8_t pins = PINK();
  return static_cast<std::uint8_t>((pins & 1) << 2 | (pins & 2) | (pins & 4) >> 2);
}

/// An upper gate that stays is let alone, it may be amid its pulse; one that goes is off before a lower one comes.
void apply(const BridgeCommand<Scalar>& command) {
  const auto counts =
      static_cast<std::uint16_t>(static_cast<std::uint32_t>(command.duty.raw) * pwm_counts >> 15);
  const Pins to = pins(command, counts > 0);
  DDRB() = DDRB() & to.DDRB;
  PORTA() = to.PORTA;
  OCR1A() = counts;
  OCR1B() = counts;
  OCR1C() = counts;
  DDRB() = to.DDRB;
}

void turn_off() {
  state = DriveState<Scalar>{};
  apply(state.command);
}

/// The shunt's counts as phase currents of the pair that `code` drives.
Measurement<Scalar> measured(std::uint8_t code, std::uint16_t counts) {
  Measurement<Scalar> m{.hall = code};
  const std::uint8_t sector = sector_of_hall(code);
  if (sector == no_sector) return m;
  if (code != carried) one_shunt_commutation(shunt, shunt_state);
  carried = code;
  const Scalar duty = state.command.enabled ? state.command.duty : Scalar{};
  const Scalar now = adc_value(adc, adc_state, counts);
  set_phase_currents(m, positive_pair(sector), one_shunt_step(shunt, shunt_state, state.reversed, duty, now));
  return m;
}

}  // namespace firmware

/// Timer 1's overflow, its bottom in the middle of the on-time, starts the conversion; its end calls here.
extern "C" __attribute__((signal, used)) void INTERRUPT_ADC() {
  using namespace firmware;
  TIFR1() = timer1_overflow;  // the next overflow triggers again
  const std::uint16_t counts = ADC();
  if (adc_state.offset_eighths < 0) {  // the bridge is off since the reset: 0 A
    if (adc_calibrate(adc, adc_state, counts) == Calibration::failed) fault = true;
    return;
  }
  const Measurement<Scalar> m = measured(hall_pins(), counts);
  if (magnitude(shunt_state.driven_A) > over_current || sector_of_hall(m.hall) == no_sector) fault = true;
  if (!run || fault) return turn_off();
  apply(step(drive, state, m, setpoint, telemetry));
}

extern "C" __attribute__((signal, used)) void INTERRUPT_PCINT2() {
  using namespace firmware;
  if (!run || fault || !state.command.enabled) return;
  apply(on_hall(drive, state, hall_pins()));
}
