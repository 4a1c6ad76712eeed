// SPDX-License-Identifier: Apache-2.0
// The whole program of an ATmega2560 at 16 MHz around an exported drive, a current or duty loop: what tools/firmware_image.sh makes an
// image of, and what `sixstep run SCENARIO --on avr` runs in the loop. The control interrupt comes once a period, behind the conversion;
// the Hall interrupt moves the bridge; the main loop logs to the serial line and keeps the watchdog from biting.
#include "faces/firmware/example/avr/bridge.hpp"
#include "faces/firmware/example/avr/set_up.hpp"
#include "faces/firmware/example/log.hpp"

namespace firmware {

DriveState<Scalar> state;
AdcState calibration;
std::int16_t offset_eighths = -1;  // of all three transducers, measured at the first; below 0 not yet
std::uint16_t on_counts = 0;       // half the on-time
Setpoint<Scalar> setpoint;
Telemetry<Scalar> telemetry;  // the drive never reads it
bool fault = false;           // stays

/// What the log has of a control tick.
struct Row {
  std::uint32_t tick;
  Scalar current, reference, duty;
  std::uint8_t hall;
};
LogSlot<Row> log;
std::uint32_t ticks = 0;
volatile std::uint8_t heart = 0;  // beats with each control interrupt

/// All three compare registers, so that a leg that comes in mid-period has its pulse at once.
void set_on_time(std::uint16_t counts) {
  word(atmega2560::OCR1AL) = counts;
  word(atmega2560::OCR1BL) = counts;
  word(atmega2560::OCR1CL) = counts;
  on_counts = counts;
}

/// An upper gate that stays is let alone, it may be amid its pulse; one that goes is off before a lower one comes.
void apply(const BridgeCommand<Scalar>& command) {
  const Pins to = pins(command, on_counts > 0);
  volatile std::uint8_t& out = byte(atmega2560::DDRB);
  out = out & to.DDRB;
  byte(atmega2560::PORTA) = to.PORTA;
  out = to.DDRB;
}

void turn_off_for_good() {
  fault = true;
  byte(atmega2560::DDRB) = 0;
  byte(atmega2560::PORTA) = 0;
}

/// With the bridge off, since the reset: 0 A.
void calibrate(std::uint16_t counts) {
  const Calibration so_far = adc_calibrate(currents, calibration, counts);
  if (so_far == Calibration::failed) turn_off_for_good();
  if (so_far == Calibration::done) offset_eighths = static_cast<std::int16_t>(calibration.offset_eighths);
}

void control(std::uint8_t code, std::uint16_t counts) {
  const std::uint8_t sector = sector_of_hall(code);
  if (sector == no_sector) return turn_off_for_good();
  Measurement<Scalar> m{.hall = code};
  set_phase_currents(m, positive_pair(sector), value_of(currents, offset_eighths, counts));
  step(drive, state, m, setpoint, telemetry);
  log.take({ticks, telemetry.motor_current_A, setpoint.value, telemetry.duty, code});
}

void put(char c) {
  while ((byte(atmega2560::UCSR0A) & atmega2560::UDRE0) == 0) continue;
  byte(atmega2560::UDR0) = static_cast<std::uint8_t>(c);
}

/// A signal in thousandths of its unit, of which 1.0 means `scale`.
template <std::int32_t scale>
std::int32_t thousandths(Scalar x) {
  return static_cast<std::int32_t>(x.raw) * scale >> Scalar::fraction_bits;
}

constexpr auto full_mA = static_cast<std::int32_t>(units.current_A * 1000);
constexpr std::int32_t full_setpoint = drive.mode == Mode::duty ? 1000 : full_mA;
static_assert(full_mA < 65536, "times a signal of 16 bits");
constexpr auto period_ns = static_cast<std::uint32_t>(exported::pwm_period_ps / 1000);

/// Up to 35 minutes, as put_number() takes them.
constexpr std::uint32_t microseconds(std::uint32_t tick) {
  constexpr std::uint32_t whole = period_ns / 1000, rest = period_ns % 1000;
  return tick * whole + (rest == 0 ? 0 : tick * rest / 1000);
}

void send(const Row& row) {
  put_number(put, static_cast<std::int32_t>(microseconds(row.tick)));
  put(',');
  put_number(put, thousandths<full_mA>(row.current));
  put(',');
  put_number(put, thousandths<full_setpoint>(row.reference));
  put(',');
  put_number(put, thousandths<1000>(row.duty), 3);
  put(',');
  put_number(put, row.hall);
  put('\n');
}

/// As long as control interrupts come.
void feed_watchdog() {
  static std::uint8_t seen = 0;
  if (heart == seen) return;
  seen = heart;
  asm volatile("wdr");
}

}  // namespace firmware

/// The end of the conversion that BOTTOM started.
extern "C" __attribute__((signal, used)) void INTERRUPT_ADC() {
  using namespace firmware;
  const std::uint16_t counts = converted();
  heart = static_cast<std::uint8_t>(heart + 1);
  ++ticks;
  if (fault) return;
  if (offset_eighths < 0) {
    calibrate(counts);
    return convert_at_bottom();
  }
  convert_potentiometer();
  control(by_pins.code[hall_pins()], counts);
  const std::uint16_t wanted = potentiometer_counts();
  look_at_source(hall_pins());
  convert_at_bottom();  // as early as may be: a BOTTOM before it is a period without control
  if (fault) return;
  set_on_time(counts_of(state.command.duty));
  apply(state.command);
  setpoint.value = value_of(potentiometer, 8 * potentiometer.offset_counts, wanted);
}

/// Never amid the control interrupt, so that no conversion of the potentiometer runs.
extern "C" __attribute__((signal, used)) void INTERRUPT_PCINT2() {
  using namespace firmware;
  if (fault || !state.command.enabled) return;
  const std::uint8_t pins = hall_pins(), code = by_pins.code[pins];
  if (sector_of_hall(code) == no_sector) return turn_off_for_good();
  look_at_source(pins);
  apply(on_hall(drive, state, code));
}

/// Freestanding, clang would give it a C++ name. After the watchdog's reset the bridge stays off until the supply goes.
extern "C" int main() {
  using namespace firmware;
  fault = set_up_watchdog();
  set_up();
  asm volatile("sei");
  put_text(put, fault ? "# the watchdog bit\n" : "# sixstep on an ATmega2560\n");
  put_text(put, drive.mode == Mode::duty ? "t [us],i_m [mA],setpoint,duty,hall\n"
                                         : "t [us],i_m [mA],i_ref [mA],duty,hall\n");
  for (;;) {
    feed_watchdog();
    if (const Row* row = log.waiting()) {
      send(*row);
      log.next();
    } else {
      asm volatile("sleep");
    }
  }
}
