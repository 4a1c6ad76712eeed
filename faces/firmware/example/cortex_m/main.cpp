// SPDX-License-Identifier: Apache-2.0
// The whole program of an STM32F303 (Cortex-M4F, 72 MHz) around an exported product drive in float: what tools/firmware_image.sh makes an
// image of. The control interrupt comes once a period, behind four conversions; the Hall interrupt moves the bridge; the main loop takes
// commands from the serial line, logs to it, and keeps the watchdog from biting.
#include "faces/firmware/example/commands.hpp"
#include "faces/firmware/example/cortex_m/bridge.hpp"
#include "faces/firmware/example/cortex_m/set_up.hpp"
#include "faces/firmware/example/log.hpp"

namespace firmware {

ProtectedState<Scalar> state;
ProtectedTelemetry<Scalar> telemetry;  // the drive never reads it
Request request;                       // this one and the next by the main loop, with interrupts off
Setpoint<Scalar> setpoint;

/// What the log has of a control tick.
struct Row {
  std::uint32_t tick;
  Scalar speed, speed_reference, current, duty, bus;
  std::uint8_t hall, activity;
  std::uint16_t faults;
};
LogSlot<Row> log;
std::uint32_t ticks = 0;
volatile std::uint8_t heart = 0;  // beats with each control interrupt

/// All channels at once, by the commutation event; the on-time counts from the next period on.
void apply(const BridgeCommand<Scalar>& command) {
  const GateOutputs out = outputs(command);
  const auto compare = static_cast<std::uint32_t>(command.duty * static_cast<float>(pwm_counts));
  for (int n = 0; n < 3; ++n) tim1().CCR[n] = compare;
  tim1().CCMR1 = out.CCMR1;
  tim1().CCMR2 = out.CCMR2;
  tim1().CCER = out.CCER;
  tim1().EGR = bit::COMG;
}

void put(char c) {
  while ((usart2().ISR & bit::TXE) == 0) continue;
  usart2().TDR = static_cast<std::uint8_t>(c);
}

std::int32_t thousandths(Scalar x) { return static_cast<std::int32_t>(x * 1000.0f); }

constexpr auto period_ns = static_cast<std::uint32_t>(exported::pwm_period_ps / 1000);

void send(const Row& row) {
  const std::int32_t numbers[] = {
      static_cast<std::int32_t>(static_cast<std::uint64_t>(row.tick) * period_ns / 1000),
      thousandths(row.speed),
      thousandths(row.speed_reference),
      thousandths(row.current),
      thousandths(row.duty),
      thousandths(row.bus),
      row.hall,
      row.activity,
      row.faults};
  constexpr unsigned columns = 9, decimals[columns] = {0, 3, 3, 0, 3, 3, 0, 0, 0};
  for (unsigned n = 0; n < columns; ++n) {
    put_number(put, numbers[n], decimals[n]);
    put(n + 1 < columns ? ',' : '\n');
  }
}

/// As long as control interrupts come.
void feed_watchdog() {
  static std::uint8_t seen = 0;
  if (heart == seen) return;
  seen = heart;
  iwdg().KR = bit::reload;
}

void obey(const Command& command) {
  asm volatile("cpsid i" ::: "memory");
  switch (command.kind) {
    case Command::Kind::none:
    case Command::Kind::dropped:
      break;
    case Command::Kind::run:
      request = {.run = true};
      break;
    case Command::Kind::stop:
      request = {};
      break;
    case Command::Kind::clear:
      request = {.run = false, .clear = true};
      break;
    case Command::Kind::setpoint:
      setpoint.value = static_cast<Scalar>(command.number);
      break;
  }
  asm volatile("cpsie i" ::: "memory");
}

void listen() {
  static Commands commands;
  if ((usart2().ISR & bit::RXNE) != 0) obey(commands.take(static_cast<char>(usart2().RDR)));
}

}  // namespace firmware

/// Once per PWM period: TIM1 triggers the injected group, its end calls here. The same priority as below.
extern "C" void ADC1_2_IRQHandler() {
  using namespace firmware;
  adc1().ISR = bit::JEOS;
  BoardInput in;
  for (int n = 0; n < 3; ++n) in.current_counts[n] = static_cast<std::uint16_t>(adc1().JDR[n]);
  in.bus_counts = static_cast<std::uint16_t>(adc1().JDR[3]);
  in.hall_pins = hall_pins();
  in.now = tim2().CNT;
  apply(protected_step(config, state, in, request, setpoint, telemetry));
  heart = static_cast<std::uint8_t>(heart + 1);
  ++ticks;
  log.take({ticks, telemetry.measured.speed_rad_s, telemetry.drive.speed_reference_rad_s,
            telemetry.drive.motor_current_A, telemetry.drive.duty, telemetry.measured.bus_V, in.hall_pins,
            static_cast<std::uint8_t>(telemetry.activity), telemetry.faults});
}

extern "C" void TIM2_IRQHandler() {
  using namespace firmware;
  tim2().SR = ~bit::CC1IF;
  apply(protected_on_hall(config, state, hall_pins(), tim2().CCR[0]));
}

/// The bridge stays off until somebody says r, after the watchdog's reset as after any other.
int main() {
  using namespace firmware;
  const bool bit_me = (rcc().CSR & bit::IWDGRSTF) != 0;
  rcc().CSR = rcc().CSR | bit::RMVF;
  set_up_watchdog();  // before what may hang
  const bool ready = set_up_clock();
  switch_parts_on();
  set_up_pins();
  set_up_serial_line();
  set_up_hall_timer();
  set_up_bridge_timer();
  if (ready && set_up_converter()) listen_to_interrupts();
  put_text(put, bit_me ? "# the watchdog bit\n" : "# sixstep on an STM32F303\n");
  put_text(put, "t [us],speed [rad/s],speed_ref [rad/s],i_m [mA],duty,bus [V],hall,activity,faults\n");
  for (;;) {
    feed_watchdog();
    listen();
    if (const Row* row = log.waiting()) {
      send(*row);
      log.next();
    }
  }
}
