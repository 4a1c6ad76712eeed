// SPDX-License-Identifier: Apache-2.0
// Both entries of the drive on an STM32F303 (Cortex-M4F, 72 MHz), in float. Three phase currents and the bus
// by the injected group of ADC1, six gates by TIM1 with its dead time, Hall pins on PA0..PA2 captured by TIM2
// through its XOR.
#include "faces/firmware/example/cortex_m/bridge.hpp"
#include "faces/firmware/example/cortex_m/drive_config.hpp"
#include "faces/firmware/example/cortex_m/registers.hpp"
#include "sixstep/control/protected_drive.hpp"

namespace firmware {

using namespace sixstep::control;
using exported::Scalar;

constexpr std::uint32_t clock_MHz = 72;
constexpr auto pwm_counts = static_cast<std::uint32_t>(exported::pwm_period_ps * clock_MHz / 1'000'000);

// Gains, converters, capture and thresholds, as the scenario simulated them.
constexpr const ProtectedConfig<Scalar>& config = exported::product;
static_assert(!(Scalar{} < config.drive.extras.commutation.overlap_bus_V),
              "the leg in no pair has no pulse of its own here");
static_assert(exported::command_delayed,
              "the compare registers are preloaded: a command counts from the next period on");

ProtectedState<Scalar> state;
ProtectedTelemetry<Scalar> telemetry;  // for a display; the drive never reads it
Request request;                       // from the main loop, with interrupts off
Setpoint<Scalar> setpoint;

void apply(const BridgeCommand<Scalar>& command) {
  const GateOutputs out = outputs(command);
  const auto compare = static_cast<std::uint32_t>(command.duty * static_cast<float>(pwm_counts));
  for (int n = 0; n < 3; ++n) tim1().CCR[n] = compare;
  tim1().CCMR1 = out.CCMR1;
  tim1().CCMR2 = out.CCMR2;
  tim1().CCER = out.CCER;
}

std::uint8_t hall_pins() {  // PA0 is H1, the highest bit
  const std::uint32_t pins = gpio_a().IDR;
  return static_cast<std::uint8_t>((pins & 1) << 2 | (pins & 2) | (pins & 4) >> 2);
}

}  // namespace firmware

/// Once per PWM period: TIM1 triggers the injected group, its end calls here. The same priority as below.
extern "C" void ADC1_2_IRQHandler() {
  using namespace firmware;
  adc1().ISR = adc_jeos;
  BoardInput in;
  for (int n = 0; n < 3; ++n) in.current_counts[n] = static_cast<std::uint16_t>(adc1().JDR[n]);
  in.bus_counts = static_cast<std::uint16_t>(adc1().JDR[3]);
  in.hall_pins = hall_pins();
  in.now = tim2().CNT;
  apply(protected_step(config, state, in, request, setpoint, telemetry));
}

extern "C" void TIM2_IRQHandler() {
  using namespace firmware;
  tim2().SR = ~timer_cc1if;
  apply(protected_on_hall(config, state, hall_pins(), tim2().CCR[0]));
}
