// SPDX-License-Identifier: Apache-2.0
// Both entries of the drive on an ATmega2560 (16 MHz), in Q15. One shunt in the DC link on ADC0, the bus on
// ADC1, upper gates on OC1A..OC1C (timer 1), lower gates on PA0..PA2, Hall pins on PK0..PK2, timer 3 counts 2
// MHz for their edges.
#include "faces/firmware/example/avr/bridge.hpp"
#include "faces/firmware/example/avr/drive_config.hpp"
#include "faces/firmware/example/avr/registers.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::Scalar, exported::units;

static_assert(exported::drive.chopping == Chopping::soft, "these pins chop the upper gates alone");
constexpr std::uint32_t pwm_counts =
    static_cast<std::uint32_t>(exported::pwm_period_ps / 62'500);  // of 1/16 MHz

constexpr ProtectedConfig<Scalar> make_config() {
  ProtectedConfig<Scalar> c;
  c.drive = exported::drive;
  c.setpoint_limit = units.rad_per_s(600);
  c.sensing = CurrentSensing::one_shunt;
  // 5 V over 10 bits, 0.1 V/A, 0 A in the middle: 25 A both ways
  c.current_adc[0] = {
      .per_eighth = units.amperes_per_count(5.0 / 1024 / 0.1), .offset_counts = 512, .offset_tolerance = 15};
  c.bus_adc = {.per_eighth = units.volts_per_count(5.0 / 1024 * 11)};  // divider 10 to 1
  c.shunt = {.least_duty = units.plain(0.1), .commutation_samples = 4, .fade = units.plain(0.835)};
  c.speed = units.hall_speed(exported::pole_pairs, 2e6, 200'000, 6);
  c.faults = {.over_current_A = units.amperes(24),
              .over_voltage_V = units.volts(30),
              .under_voltage_V = units.volts(10),
              .over_speed_rad_s = units.rad_per_s(800),
              .stall_current_A = units.amperes(15),
              .stall_ticks = 3000,
              .voltage_ticks = 3};
  c.brake_current_A = units.amperes(5);
  c.short_below_rad_s = units.rad_per_s(100);
  c.standing_rad_s = units.rad_per_s(5);
  return c;
}
constexpr ProtectedConfig<Scalar> config = make_config();

ProtectedState<Scalar> state;
ProtectedTelemetry<Scalar> telemetry;  // for a display; the drive never reads it
Request request;                       // from the main loop, with interrupts off
Setpoint<Scalar> setpoint;
BoardInput in;

/// Timer 3 has 16 bits: widened at every look, of which there is one per PWM period.
std::uint32_t now() {
  in.now += static_cast<std::uint16_t>(TCNT3() - static_cast<std::uint16_t>(in.now));
  return in.now;
}

std::uint8_t hall_pins() {  // PK0 is H1, the highest bit
  const std::uint8_t pins = PINK();
  return static_cast<std::uint8_t>((pins & 1) << 2 | (pins & 2) | (pins & 4) >> 2);
}

void apply(const BridgeCommand<Scalar>& command) {
  const auto counts =
      static_cast<std::uint16_t>(static_cast<std::uint32_t>(command.duty.raw) * pwm_counts >> 15);
  const Pins to = pins(command, counts > 0);
  TCCR1A() = upper_gates_off.TCCR1A;
  PORTA() = to.PORTA;
  const auto last = static_cast<std::uint16_t>(counts - (counts > 0));  // the on-time's last count
  OCR1A() = last;
  OCR1B() = last;
  OCR1C() = last;
  TCCR1A() = to.TCCR1A;
}

}  // namespace firmware

/// Timer 1's overflow starts the conversion of the shunt; the bus follows, then the control tick.
extern "C" __attribute__((signal, used)) void INTERRUPT_ADC() {
  using namespace firmware;
  if ((ADMUX() & 1) == 0) {
    in.current_counts[0] = ADC();
    ADMUX() = avcc | 1;
    ADCSRA() = static_cast<std::uint8_t>(ADCSRA() | adc_start);
    return;
  }
  in.bus_counts = ADC();
  ADMUX() = avcc;
  TIFR1() = timer1_overflow;  // the next overflow triggers again
  in.hall_pins = hall_pins();
  now();
  apply(protected_step(config, state, in, request, setpoint, telemetry));
}

extern "C" __attribute__((signal, used)) void INTERRUPT_PCINT2() {
  using namespace firmware;
  apply(protected_on_hall(config, state, hall_pins(), now()));
}
