// SPDX-License-Identifier: Apache-2.0
// Runs an exported current or duty loop on an ATmega2560 at 16 MHz. tools/firmware_image.sh makes an image of
// this program, and `sixstep run SCENARIO --on avr` simulates the image with the motor.
// - The control interrupt occurs once a period, after the conversion.
// - The Hall interrupt commutates the bridge. It may interrupt the control interrupt.
// - The interrupt at TOP puts a new sign into effect. It may interrupt the control interrupt too.
// - The main loop logs to the serial line and feeds the watchdog.
// - A fault turns the gates off. The main loop then prints the reason of the fault once a second.
#include "faces/firmware/example/avr/set_up.hpp"
#include "faces/firmware/example/log.hpp"

namespace firmware {

DriveState<Scalar> state;
std::int16_t offset_eighths[3] = {};  // measured by calibrate()
std::uint16_t offset_sum = 0;         // in counts
Setpoint<Scalar> setpoint;
Telemetry<Scalar> telemetry;  // written by the drive, read for the log
std::uint8_t sums_too_far = 0;

/// Which of the two other legs' currents is being converted; they are converted in every second period.
enum class Legs : std::uint8_t { none, second, third } legs = Legs::none;
std::uint8_t third_leg = 0;
std::uint16_t second_counts = 0;

/// The values of a control tick that the log prints.
struct Row {
  std::uint16_t clock;
  std::uint8_t heart, hall;
  Scalar current, reference, duty;
};
LogSlot<Row> log;
std::uint16_t row_clock = 0;      // at the beginning of the control interrupt
volatile std::uint8_t heart = 0;  // counts control interrupts

/// Sets all three compare registers, so that the incoming leg has its pulse immediately after a commutation.
void set_on_time(std::uint16_t counts) {
  word(atmega2560::OCR1AL) = counts;
  word(atmega2560::OCR1BL) = counts;
  word(atmega2560::OCR1CL) = counts;
}

void note_row(std::uint8_t pins, Scalar current, Scalar reference, Scalar duty) {
  if (log.waiting() == nullptr) log.take({row_clock, heart, by_pins.code[pins], current, reference, duty});
}

/// Stops the drive because a current is outside of its bounds.
void stop_by_current(std::uint16_t counts) {
  stop(is_at_end(counts) ? Reason::current_sensor : Reason::over_current);
}

/// Measures the transducers' offsets. The bridge has been off since the reset, so the current is 0 A. The sum
/// of eight samples is the mean in eighths of a count.
void calibrate() {
  static std::uint8_t samples = 0;
  for (std::uint8_t leg = 0; leg < 3; ++leg) {
    convert(leg);
    const std::uint16_t counts = conversion();
    if (is_at_end(counts)) return stop(Reason::current_sensor);
    offset_eighths[leg] = static_cast<std::int16_t>(offset_eighths[leg] + counts);
  }
  if (++samples < 8) return;
  for (const std::int16_t offset : offset_eighths)
    if (!is_within(static_cast<std::uint16_t>(offset) / 8, offset_tolerance))
      return stop(Reason::calibration);
  offset_sum = static_cast<std::uint16_t>(offset_eighths[0] + offset_eighths[1] + offset_eighths[2]) / 8;
  phase = Phase::waits;
}

/// Waits until the setpoint is 0, so that the motor does not start at power-up at any position of the
/// potentiometer.
void wait_for_zero() {
  convert(potentiometer_channel);
  const std::uint16_t counts = conversion();
  if (is_at_end(counts)) return stop(Reason::setpoint_wire);
  if (is_within(counts, zero_counts)) phase = Phase::drives;
}

/// A period in which the drive does not run. If a gate is on by an error, it is turned off within one period.
__attribute__((noinline)) void stand_by(std::uint16_t counts) {
  if (phase == Phase::stands) turn_off();
  const std::uint8_t pins = hall_pins();
  note_row(pins, value_of(currents, 8 * middle, counts), Scalar{}, Scalar{});
  if (phase == Phase::calibrates)
    calibrate();
  else if (phase == Phase::waits)
    wait_for_zero();
  convert_at_bottom(pins_seen);
}

/// The Hall code for which the loop computes. Without extras, a drive uses the code only to choose the pair,
/// and the gates already drive the right pair. The loop therefore computes in one fixed sector, whose legs
/// are compile-time constants. This saves 100 cycles for the conversion between motor and phase currents.
constexpr std::uint8_t code_of_loop = 0b101;

void control(std::uint8_t pins, std::uint16_t counts) {
  std::uint8_t code = by_pins.code[pins];
  if (sector_of_hall(code) == no_sector) return stop(Reason::hall);
  if constexpr (!drive.extras.on) code = code_of_loop;
  Measurement<Scalar> m{.hall = code};
  set_phase_currents(m, positive_pair(sector_of_hall(code)),
                     value_of(currents, offset_eighths[by_pins.source[pins]], counts));
  step(drive, state, m, setpoint, telemetry);
}

/// Sets the answer for the next TOP, when the timer loads the on-time. Enables the interrupt at TOP if the
/// sign changes, or if the third leg's conversion must start there.
void answer(bool legs_are_next) {
  set_on_time(counts_of(state.command.duty));
  wanted = state.reversed ? Way::negative : Way::positive;
  byte(atmega2560::TIMSK1) = legs_are_next || wanted != shown ? atmega2560::ICIE1 : std::uint8_t{0};
}

/// Checks all three currents of this period. Their sum is checked only if the pair did not change between the
/// samples.
void check_legs(bool commutated, std::uint16_t first, std::uint16_t third) {
  if (!is_within(second_counts, over_current_counts)) return stop_by_current(second_counts);
  if (!is_within(third, over_current_counts)) return stop_by_current(third);
  if (commutated) return;
  const auto sum = static_cast<std::uint16_t>(first + second_counts + third - offset_sum + middle);
  sums_too_far = is_within(sum, sum_counts) ? 0 : static_cast<std::uint8_t>(sums_too_far + 1);
  if (sums_too_far >= strange_sums) stop(Reason::current_sensor);
}

void take_setpoint(std::uint16_t counts) {
  if (is_at_end(counts)) return stop(Reason::setpoint_wire);
  setpoint.value = value_of(potentiometer, 8 * potentiometer.offset_counts, counts);
}

void put(char c) {
  while ((byte(atmega2560::UCSR0A) & atmega2560::UDRE0) == 0) continue;
  byte(atmega2560::UDR0) = static_cast<std::uint8_t>(c);
}

/// A signal in thousandths of its unit; the value 1.0 of the format is `scale` thousandths.
template <std::int32_t scale>
std::int32_t thousandths(Scalar x) {
  return static_cast<std::int32_t>(x.raw) * scale >> Scalar::fraction_bits;
}

constexpr auto full_mA = static_cast<std::int32_t>(units.current_A * 1000);
constexpr std::int32_t full_setpoint = drive.mode == Mode::duty ? 1000 : full_mA;
static_assert(full_mA < 65536, "the current times a signal of 16 bits must fit into 32 bits");

/// Number of periods without a control interrupt between two rows: the elapsed time in periods, rounded,
/// minus the number of control interrupts.
std::uint8_t missed(std::uint16_t half_us, std::uint8_t came) {
  constexpr std::uint16_t period_half_us = pwm_counts / 4;
  std::uint16_t periods = 0;
  if constexpr (pwm_counts % 4 == 0) {  // avoids a 32-bit division, which takes as long as all other work for
                                        // a row
    for (; half_us > period_half_us; half_us = static_cast<std::uint16_t>(half_us - period_half_us))
      ++periods;
    if (half_us > period_half_us / 2) ++periods;
  } else {
    constexpr auto half = static_cast<std::uint32_t>(pwm_counts);  // cycles in half a period
    periods = static_cast<std::uint16_t>((std::uint32_t{half_us} * 8 + half) / (half + half));
  }
  return static_cast<std::uint8_t>(periods - came);
}

void send(const Row& row) {
  static Instant now;
  static std::uint16_t clock = conversion_half_us;  // the time of a row is the instant of its sample
  static std::uint8_t seen = 0;
  static bool begun = false;
  const auto passed = static_cast<std::uint16_t>(row.clock - clock);
  clock = static_cast<std::uint16_t>(row.clock & ~1u);
  now.pass(passed / 2);
  put_instant(put, now);
  put(',');
  put_number(put, thousandths<full_mA>(row.current));
  put(',');
  put_number(put, thousandths<full_setpoint>(row.reference));
  put(',');
  put_number(put, thousandths<1000>(row.duty), 3);
  put(',');
  put_number(put, row.hall);
  put(',');
  put_number(put, begun ? missed(passed, static_cast<std::uint8_t>(row.heart - seen)) : 0);
  put('\n');
  seen = row.heart;
  begun = true;
}

/// Feeds the watchdog while control interrupts occur. Also feeds it while the drive is stopped, so that the
/// program continues to print the reason.
void feed_watchdog() {
  static std::uint8_t seen = 0;
  if (heart == seen && phase != Phase::stands) return;
  seen = heart;
  asm volatile("wdr");
}

/// Prints the phase when the drive stops or begins to wait, and then once a second.
void tell_phase() {
  constexpr std::uint8_t second = 31;  // overflows of timer 3, each 33 ms
  static Phase told = Phase::calibrates;
  static std::uint8_t turns = 0;
  const Phase now = phase;
  if ((byte(atmega2560::TIFR3) & atmega2560::TOV3) != 0) {
    byte(atmega2560::TIFR3) = atmega2560::TOV3;
    ++turns;
  }
  if (now == told && turns < second) return;
  told = now;
  turns = 0;
  if (now == Phase::stands) put_fault(put, reason);
  if (now == Phase::waits) put_text(put, "# waits for the potentiometer's middle\n");
}

}  // namespace firmware

/// Interrupt at the end of the conversion that BOTTOM started.
extern "C" __attribute__((signal, used)) void INTERRUPT_ADC() {
  using namespace firmware;
  const std::uint16_t counts = converted();
  control_interrupt_came();
  row_clock = log_clock();
  heart = static_cast<std::uint8_t>(heart + 1);
  if (phase != Phase::drives) return stand_by(counts);
  const std::uint8_t pins = hall_pins();
  const bool looks_at_legs = (heart & 1) != 0;
  convert(looks_at_legs ? by_pins.second[pins] : potentiometer_channel);
  legs = looks_at_legs ? Legs::second : Legs::none;
  third_leg = by_pins.third[pins];
  if (is_within(counts, over_current_counts)) {
    asm volatile("sei" ::: "memory");
    control(pins, counts);
    asm volatile("cli" ::: "memory");
    if (phase == Phase::stands) turn_off();
  } else {
    stop_by_current(counts);
  }
  const std::uint16_t last = conversion();
  const bool has_legs = legs == Legs::third;  // false if the TOP interrupt did not occur in time
  legs = Legs::none;
  const std::uint8_t last_pins = pins_seen;
  convert_at_bottom(last_pins);  // as early as possible: a BOTTOM before this call would start no conversion,
                                 // and a period would have no control interrupt
  if (phase != Phase::drives) return;
  note_row(pins, telemetry.motor_current_A, setpoint.value, telemetry.duty);
  answer(!looks_at_legs);
  if (!looks_at_legs)
    take_setpoint(last);
  else if (has_legs)
    check_legs(pins != last_pins, counts, last);
}

/// Interrupt at TOP.
extern "C" __attribute__((signal, used)) void INTERRUPT_TIMER1_CAPT() {
  using namespace firmware;
  if (wanted != shown) {
    shown = wanted;
    show(pins_seen);
  }
  if (legs == Legs::second) {
    if (converts()) return;  // not finished: the next TOP starts the conversion
    second_counts = converted();
    convert(third_leg);
    legs = Legs::third;
  }
  byte(atmega2560::TIMSK1) = 0;
}

extern "C" __attribute__((signal, used)) void INTERRUPT_PCINT2() {
  using namespace firmware;
  const std::uint8_t pins = hall_pins();
  pins_seen = pins;
  if (shown == Way::off) return;
  if (sector_of_hall(by_pins.code[pins]) == no_sector) return stop(Reason::hall);
  look_at_source(pins);
  show(pins);
}

/// Interrupt if no control interrupt has occurred for patience_ps.
extern "C" __attribute__((signal, used)) void INTERRUPT_TIMER0_OVF() {
  firmware::stop(firmware::Reason::converter);
}

/// extern "C", because clang mangles the name main in a freestanding program.
extern "C" int main() {
  using namespace firmware;
  const Reason before = reason_after_reset(set_up_watchdog());
  kept_reason.keep(Reason::none);
  if (before != Reason::none) stop(before);
  set_up();
  asm volatile("sei");
  put_text(put, "# sixstep on an ATmega2560\n");
  put_text(put, drive.mode == Mode::duty ? "t [us],i_m [mA],setpoint,duty,hall,missed\n"
                                         : "t [us],i_m [mA],i_ref [mA],duty,hall,missed\n");
  for (;;) {
    feed_watchdog();
    tell_phase();
    if (const Row* row = log.waiting()) {
      send(*row);
      log.next();
    } else if (phase != Phase::stands) {
      asm volatile("sleep");
    }
  }
}
