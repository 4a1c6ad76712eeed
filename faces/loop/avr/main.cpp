// SPDX-License-Identifier: Apache-2.0
// The drive of an exported header as the whole program of an ATmega2560 (16 MHz), as `board.cpp` runs it: a current or duty loop,
// built on the example of faces/firmware/example/avr. Three current transducers on ADC0..ADC2, of which each period's sample is that
// of the leg that feeds the driven pair; a potentiometer on ADC3 as the setpoint, 0 in its middle; Hall pins on PK0..PK2.
//
// To be compiled with -DADC_AMPERES_PER_COUNT and -DSETPOINT_PER_COUNT (amperes, or duty).
#include <drive_config.hpp>

#include "faces/firmware/example/avr/bridge.hpp"
#include "faces/firmware/example/avr/registers.hpp"
#include "faces/loop/avr/addresses.hpp"
#include "sixstep/control/adc.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/one_shunt.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::drive, exported::Scalar, exported::units;

static_assert((drive.mode == Mode::current || drive.mode == Mode::duty) && drive.chopping == Chopping::soft &&
                  drive.extras.pwm.pattern == PwmPattern::upper,
              "what these pins and loops are for");
static_assert(!(Scalar{} < drive.extras.commutation.overlap_bus_V),
              "the leg in no pair has no pulse of its own here");
static_assert(exported::pwm_centre_aligned,
              "timer 1 counts up and down; its compare registers are taken at the top");
// Up and down again, of 1/16 MHz.
constexpr std::uint64_t pwm_counts = exported::pwm_period_ps / 62'500 / 2;
static_assert(pwm_counts >= 3 && pwm_counts < 65536, "timer 1 has 16 bits");

constexpr AdcConfig<Scalar> currents{.per_eighth = units.amperes_per_count(ADC_AMPERES_PER_COUNT),
                                     .offset_counts = 512,
                                     .offset_tolerance = 15,
                                     .log2_samples = 3};
constexpr Units<Scalar> plain{};
constexpr AdcConfig<Scalar> potentiometer{
    .per_eighth = (drive.mode == Mode::duty ? plain : units).amperes_per_count(SETPOINT_PER_COUNT),
    .offset_counts = 512};
constexpr std::uint8_t potentiometer_channel = 3;
static_assert(sizeof(Scalar) == 2, "eighths of counts as signals of 16 bits");

/// By the Hall pins as port K has them: looked up in a few cycles, worked out in dozens.
struct ByPins {
  std::uint8_t code[8], source[8];
};
constexpr ByPins by_pins = [] {
  ByPins by{};
  for (unsigned pins = 0; pins < 8; ++pins) {  // PK0 is H1, the highest bit
    const auto code = static_cast<std::uint8_t>((pins & 1) << 2 | (pins & 2) | (pins & 4) >> 2);
    by.code[pins] = code;
    by.source[pins] = static_cast<std::uint8_t>(positive_pair(sector_of_hall(code)).source);
  }
  return by;
}();

DriveState<Scalar> state;
AdcState calibration;
std::int16_t offset_eighths = -1;  // of all three transducers, measured at the first; below 0 not yet
std::uint16_t on_counts = 0;       // half the on-time
Setpoint<Scalar> setpoint;
Telemetry<Scalar> telemetry;  // the drive never reads it
bool fault = false;           // stays

inline volatile std::uint8_t& byte(atmega2560::Address address) { return at<std::uint8_t>(address); }
inline volatile std::uint16_t& word(atmega2560::Address address) { return at<std::uint16_t>(address); }

std::uint8_t hall_pins() { return PINK() & 7; }

/// As adc_value(): of 10 bits nothing saturates, and 32-bit differences would cost a hundred cycles.
Scalar value_of(const AdcConfig<Scalar>& config, std::int16_t offset, std::uint16_t counts) {
  const auto eighths = static_cast<std::int16_t>(static_cast<std::int16_t>(counts * 8) - offset);
  return ScalarTraits<Scalar>::product(Scalar::from_raw(eighths), config.per_eighth);
}

void look_at_channel(std::uint8_t channel) {
  byte(atmega2560::ADMUX) = static_cast<std::uint8_t>(atmega2560::REFS0 | channel);
}

/// The transducer of the leg that feeds the positive pair: it carries the motor current, whatever its sign.
void look_at_source(std::uint8_t pins) { look_at_channel(by_pins.source[pins]); }

constexpr std::uint8_t converter_on = atmega2560::ADEN | atmega2560::ADPS2;  // 16 MHz / 16

void convert_potentiometer() {
  using namespace atmega2560;
  look_at_channel(potentiometer_channel);
  byte(ADCSRA) = converter_on | ADSC;
}

std::uint16_t potentiometer_counts() {
  while ((byte(atmega2560::ADCSRA) & atmega2560::ADSC) != 0) continue;
  return ADC();
}

/// The next BOTTOM, in the middle of the on-time, starts a conversion. The flag is cleared last: one set before the converter
/// listens would stand for ever, and only its edge counts.
void convert_at_bottom() {
  using namespace atmega2560;
  byte(ADCSRA) = converter_on | ADATE | ADIE | ADIF;
  TIFR1() = TOV1;
}

constexpr std::uint16_t counts_of(Scalar duty) {
  using Wide = std::uint32_t;
  return static_cast<std::uint16_t>(static_cast<Wide>(duty.raw) * static_cast<Wide>(pwm_counts) >>
                                    Scalar::fraction_bits);
}

/// All three compare registers, so that a leg that comes in mid-period has its pulse at once.
void set_on_time(std::uint16_t counts) {
  OCR1A() = counts;
  OCR1B() = counts;
  OCR1C() = counts;
  on_counts = counts;
}

/// An upper gate that stays is let alone, it may be amid its pulse; one that goes is off before a lower one comes.
void apply(const BridgeCommand<Scalar>& command) {
  const Pins to = pins(command, on_counts > 0);
  DDRB() = DDRB() & to.DDRB;
  PORTA() = to.PORTA;
  DDRB() = to.DDRB;
}

void turn_off_for_good() {
  fault = true;
  DDRB() = 0;
  PORTA() = 0;
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
}

void set_up_timer() {
  using namespace atmega2560;
  word(ICR1L) = static_cast<std::uint16_t>(pwm_counts);
  byte(TCCR1A) = COM1A1 | COM1B1 | COM1C1 | WGM11;
  byte(TCCR1B) = WGM13 | CS10;
}

void set_up() {
  using namespace atmega2560;
  byte(DDRA) = 7;
  set_up_timer();
  byte(PCMSK2) = 7;
  byte(PCICR) = PCIE2;
  byte(ADCSRB) = ADTS_timer1_overflow;
  look_at_channel(0);
  convert_at_bottom();
  byte(SMCR) = SE;  // idle: timer and converter run on
}

}  // namespace firmware

/// The end of the conversion that BOTTOM started.
extern "C" __attribute__((signal, used)) void INTERRUPT_ADC() {
  using namespace firmware;
  const std::uint16_t counts = ADC();
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

/// Freestanding, clang would give it a C++ name.
extern "C" int main() {
  firmware::set_up();
  asm volatile("sei");
  for (;;) asm volatile("sleep");
}
