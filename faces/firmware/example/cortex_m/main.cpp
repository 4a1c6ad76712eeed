// SPDX-License-Identifier: Apache-2.0
// Runs an exported product drive in float on an STM32F303 (Cortex-M4F, 72 MHz). tools/firmware_image.sh makes
// an image of this program.
// - The control interrupt occurs once a period, after four conversions.
// - The Hall interrupt commutates the bridge.
// - The interrupt at the period's end puts a waiting command into effect.
// - The main loop reads commands from the serial line, logs to the line, and feeds the watchdog.
#include "faces/firmware/example/commands.hpp"
#include "faces/firmware/example/cortex_m/standing.hpp"

namespace firmware {

[[gnu::section(".noinit")]] KeptReason kept_reason;
ProtectedState<Scalar> state;
ProtectedTelemetry<Scalar> telemetry;  // written by the drive, read for the log and the faults
Setpoint<Scalar> setpoint;

/// Typed commands, written by the main loop with interrupts off. `stop` and `clear` stay set until a control
/// tick has read them, whatever is typed later.
struct Asked {
  bool run, stop, clear;
};
Asked asked;
bool wants_to_run = false;      // whether a run is requested at this tick
std::uint32_t charge_left = 0;  // number of periods until the bootstrap capacitors are charged

/// The values of a control tick that the log prints.
struct Row {
  Instant t;
  Scalar speed, speed_reference, current, duty, bus;
  std::uint8_t hall, activity;
  std::uint16_t faults;
  std::uint32_t missed;
};
LogSlot<Row> log;
Ring<64> received;
volatile std::uint8_t heart = 0;  // counts control interrupts
volatile bool listening = false;  // whether control interrupts are enabled

/// Measures time with the free-running counter. A period without a control interrupt counts as time and as
/// missed. A period whose answer came after the period's end also counts as missed.
struct LogClock {
  Instant t;
  std::uint32_t rest = 0;  // counts beyond the last microsecond
  std::uint32_t missed = 0;

  void tick(std::uint32_t elapsed) {
    constexpr std::uint32_t counts = clock_Hz / 1'000'000;
    rest += elapsed;
    t.pass(rest / counts);
    rest %= counts;
    const std::uint32_t periods = (elapsed + pwm_counts / 2) / pwm_counts;
    if (periods > 1) missed += periods - 1;
  }
};
LogClock log_clock;

/// The request for this tick. Until the bootstrap capacitors are charged, a request to run is delayed.
Request request_now() {
  const bool clear = asked.clear;
  wants_to_run = asked.run && !asked.stop;
  asked.stop = asked.clear = false;
  if (!wants_to_run)
    charge_left = upper_gates_by_bootstrap ? charge_periods : 0;
  else if (charge_left > 0)
    --charge_left;
  return {.run = wants_to_run && charge_left == 0, .clear = clear};
}

/// Whether the bootstrap capacitors must be charged: a run is requested, and the drive does not run yet.
bool charges() {
  const Activity now = state.activity.activity;
  return upper_gates_by_bootstrap && wants_to_run && (now == Activity::off || now == Activity::calibrate);
}

void put(char c) {
  while ((usart2().ISR & bit::TXE) == 0) watch_converter(listening);
  usart2().TDR = static_cast<std::uint8_t>(c);
}

std::int32_t thousandths(Scalar x) { return static_cast<std::int32_t>(x * 1000.0f); }

void send(const Row& row) {
  put_instant(put, row.t);
  const std::int32_t numbers[] = {thousandths(row.speed),
                                  thousandths(row.speed_reference),
                                  thousandths(row.current),
                                  thousandths(row.duty),
                                  thousandths(row.bus),
                                  row.hall,
                                  row.activity,
                                  row.faults,
                                  static_cast<std::int32_t>(row.missed)};
  constexpr unsigned columns = 9, decimals[columns] = {3, 3, 0, 3, 3, 0, 0, 0, 0};
  for (unsigned n = 0; n < columns; ++n) {
    put(',');
    put_number(put, numbers[n], decimals[n]);
  }
  put('\n');
}

/// Feeds the watchdog while control interrupts occur. Also feeds it while the board waits for a reset with
/// the gates disabled.
void feed_watchdog() {
  static std::uint8_t seen = 0;
  const bool stands = needs_reset && !gates_may_work();
  if (heart == seen && !stands) return;
  seen = heart;
  iwdg().KR = bit::reload;
}

/// Prints a fault when it happens, and about once a second while it lasts.
void tell_fault() {
  static Reason told = Reason::none;
  static std::uint32_t told_at = 0;
  const Reason of_board = board_fault;
  // false after a typed c, until the next tick reads it
  const bool stands = telemetry.activity == Activity::fault && !asked.clear;
  const Reason why = of_board != Reason::none ? of_board
                     : stands                 ? reason_of(telemetry.first_fault)
                                              : Reason::none;
  const std::uint32_t now = tim2().CNT;
  const bool again = now - told_at >= counts_a_us * 1'000'000;
  if (why == Reason::none || (why == told && !again)) {
    told = why;
    return;
  }
  if (why != told) kept_reason.keep(why);
  told = why;
  told_at = now;
  put_fault(put, why);
}

constexpr const char* unit = config.drive.mode == Mode::speed      ? "rad/s"
                             : config.drive.mode == Mode::current  ? "A"
                             : config.drive.mode == Mode::position ? "deg"
                                                                   : "of the bus";

/// Limits the typed setpoint, and prints the limited setpoint.
void take_setpoint(std::int32_t typed) {
  constexpr Scalar limit = config.setpoint_limit;
  constexpr auto most = static_cast<std::int32_t>(limit < 2e6f ? limit * 1000.0f : 2e9f);
  const std::int32_t obeyed = typed > most ? most : typed < -most ? -most : typed;
  setpoint.value = static_cast<Scalar>(obeyed) / 1000.0f;
  put_setpoint(put, obeyed, unit);
}

void run() {
  put_text(put, "# run\n");
  const InterruptsOff hold;
  asked.run = true;
}

/// Stops the drive first and prints afterwards, because printing takes time.
void stop() {
  {
    const InterruptsOff hold;
    asked.run = false;
    asked.stop = true;
  }
  put_text(put, "# stop\n");
}

void clear() {
  put_text(put, "# clear\n");
  const InterruptsOff hold;
  clear_board_fault();
  asked = {.run = false, .stop = true, .clear = true};
}

void obey(const Command& command) {
  switch (command.kind) {
    case Command::Kind::none:
      break;
    case Command::Kind::run:
      run();
      break;
    case Command::Kind::stop:
      stop();
      break;
    case Command::Kind::clear:
      clear();
      break;
    case Command::Kind::setpoint:
      take_setpoint(command.thousandths);
      break;
    case Command::Kind::spoiled:
      put_text(put, "# not understood: nothing but s counts before the next Enter\n");
      break;
    case Command::Kind::dropped:
      put_text(put, "# setpoint dropped: no number, or a character was lost\n");
      break;
  }
}

/// Marks the rest of the line as invalid.
void miss(Commands& commands) {
  commands.lost();
  put_text(put, "# a character was lost: nothing but s counts before the next Enter\n");
}

[[gnu::noinline]] void listen() {
  static Commands commands;
  for (;;) {
    const auto item = received.take();
    if (item.kind == decltype(received)::Kind::none) return;
    if (item.kind == decltype(received)::Kind::gap)
      miss(commands);
    else
      obey(commands.take(item.character));
  }
}

/// The kept reason; `watchdog` if the watchdog caused the reset and no reason was kept.
Reason reason_before_reset() {
  const bool bit_me = (rcc().CSR & bit::IWDGRSTF) != 0;
  rcc().CSR = rcc().CSR | bit::RMVF;
  const Reason kept = kept_reason.kept();
  kept_reason.forget();
  return !bit_me ? Reason::none : kept != Reason::none ? kept : Reason::watchdog;
}

void set_up() {
  set_up_watchdog();  // first, before code that may hang
  const bool ready = set_up_clock();
  iwdg().KR = bit::reload;
  switch_parts_on();
  set_up_pins();
  set_up_hall_timer();
  if (ready) {
    set_up_serial_line(clock_Hz / 2);
    set_up_bridge_timer();
  } else {
    fall_back_to_own_clock();
    counts_a_us = own_clock_Hz / 1'000'000;
    set_up_serial_line(own_clock_Hz);
    stand_until_reset(Reason::clock);
  }
  listen_to_serial_line();
  if (!ready) return;
  if (!set_up_converter()) return stand_until_reset(Reason::converter);
  last_tick = tim2().CNT;
  listen_to_interrupts();
  listening = true;
}

}  // namespace firmware

/// Interrupt once per PWM period, at the end of the injected conversions that TIM1 triggers. It has the same
/// priority as the Hall interrupt.
extern "C" void ADC1_2_IRQHandler() {
  using namespace firmware;
  adc1().ISR = bit::JEOS;
  tim1().SR = ~bit::CC4IF;  // clears the flag that was set when TIM1 triggered these conversions
  BoardInput in;
  for (int n = 0; n < 3; ++n) in.current_counts[n] = static_cast<std::uint16_t>(adc1().JDR[n]);
  in.bus_counts = static_cast<std::uint16_t>(adc1().JDR[3]);
  in.hall_pins = hall_pins();
  in.now = tim2().CNT;
  log_clock.tick(in.now - last_tick);
  last_tick = in.now;
  watch_sensors(state, in);
  if (board_fault != Reason::none)
    state.events.other = static_cast<std::uint16_t>(state.events.other | fault_board);
  const BridgeCommand<Scalar>& command =
      protected_step(config, state, in, request_now(), setpoint, telemetry);
  if (!at_next_period(command, state.drive.reversed, charges())) ++log_clock.missed;
  if (strange_sums > 0 && (telemetry.first_fault & fault_over_current) != 0) trip(Reason::current_sensor);
  heart = static_cast<std::uint8_t>(heart + 1);
  const bool taken =
      log.take({log_clock.t, telemetry.measured.speed_rad_s, telemetry.drive.speed_reference_rad_s,
                telemetry.drive.motor_current_A, telemetry.drive.duty, telemetry.measured.bus_V, in.hall_pins,
                static_cast<std::uint8_t>(telemetry.activity), telemetry.faults, log_clock.missed});
  if (taken) log_clock.missed = 0;
}

extern "C" void TIM2_IRQHandler() {
  using namespace firmware;
  tim2().SR = ~bit::CC1IF;
  const BridgeCommand<Scalar>& command = protected_on_hall(config, state, hall_pins(), tim2().CCR[0]);
  at_once(command, state.drive.reversed);
}

extern "C" void TIM1_CC_IRQHandler() { firmware::at_period_end(); }

extern "C" void USART2_IRQHandler() {
  using namespace firmware;
  const std::uint32_t status = usart2().ISR;
  if ((status & bit::RXNE) != 0) {
    const char c = static_cast<char>(usart2().RDR);
    const bool disturbed = (status & (bit::FE | bit::NF)) != 0;
    if (disturbed) received.lose();
    // A disturbed s also stops the drive: an unnecessary stop is better than a lost one.
    if (!disturbed || c == 's') received.put(c);
  }
  if ((status & bit::ORE) != 0) received.lose();  // the lost character came after the character that was read
  usart2().ICR = status & (bit::FE | bit::NF | bit::ORE);
}

/// After every kind of reset, the bridge is off until r is typed.
int main() {
  using namespace firmware;
  const Reason before = reason_before_reset();
  set_up();
  if (!needs_reset && before != Reason::none) board_fault = before;
  put_text(put, "# sixstep on an STM32F303\n");
  put_text(put, "t [us],speed [rad/s],speed_ref [rad/s],i_m [mA],duty,bus [V],hall,activity,faults,missed\n");
  for (;;) {
    feed_watchdog();
    watch_converter(listening);
    listen();
    tell_fault();
    if (const Row* row = log.waiting()) {
      send(*row);
      log.next();
    }
  }
}
