// SPDX-License-Identifier: Apache-2.0
// Runs simavr's core, stops it at the cycles of events, and replaces some of its registers.
#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <set>

#include "faces/loop/avr/chip.hpp"

extern "C" {
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>
}

namespace board {

namespace {

using namespace atmega2560;

// Numbers of cycles from data sheet 2549, 7.8: from the request to the first instruction of the vector, for
// waking up, and for the return. simavr counts only the cycles of the return.
constexpr std::uint64_t interrupt_response = 5, wake_up = 5, interrupt_return = 5;

/// Whether simavr has logged an invalid instruction or address. simavr reports such an error only in its log
/// and continues.
bool told_of_error = false;

void listen(avr_t*, int level, const char*, va_list) {
  if (level == LOG_ERROR) told_of_error = true;
}

/// Whether the file is an ELF file for AVR. This check is needed because simavr reads any file and hangs on
/// some files.
bool is_for_avr(const char* elf) {
  constexpr unsigned char machine_AVR[2] = {83, 0};
  unsigned char head[20]{};
  std::FILE* file = std::fopen(elf, "rb");
  if (file == nullptr) return false;
  const bool whole = std::fread(head, 1, sizeof head, file) == sizeof head;
  std::fclose(file);
  return whole && std::equal(machine_AVR, machine_AVR + 2, head + 18);
}

}  // namespace

bool Chip::load(const char* elf) {
  if (!is_for_avr(elf)) return false;
  avr_global_logger_set(listen);
  elf_firmware_t firmware{};
  if (elf_read_firmware(elf, &firmware) != 0 || firmware.flashsize == 0) return false;
  avr_ = avr_make_mcu_by_name("atmega2560");
  if (avr_ == nullptr) return false;
  avr_init(avr_);
  avr_->log = 0;
  firmware.frequency = clock_Hz;
  if (firmware.flashbase + firmware.flashsize > avr_->flashend) return false;
  avr_load_firmware(avr_, &firmware);
  take_over();
  register_pin_change();
  follow_interrupts();
  follow_serial_line();
  told_of_error = false;
  return true;
}

avr_int_vector_t* Chip::vector(unsigned number) const {
  for (int n = 0; n < avr_->interrupts.vector_count; ++n)
    if (avr_->interrupts.vector[n]->vector == number) return avr_->interrupts.vector[n];
  return nullptr;
}

/// Replaces simavr's timer 1 and converter. Writes no longer reach simavr's own models of them.
void Chip::take_over() {
  const auto mine = [&](Address at, bool reads) {
    auto& io = avr_->io[AVR_DATA_TO_IO(at)];
    io.w.param = io.r.param = this;
    io.w.c = [](avr_t*, avr_io_addr_t to, std::uint8_t value, void* chip) {
      Chip& c = *static_cast<Chip*>(chip);
      c.write_ = {to, value};
      c.has_write_ = true;
      c.stop_core();
    };
    io.r.c = nullptr;
    if (reads)
      io.r.c = [](avr_t*, avr_io_addr_t from, void* chip) { return static_cast<Chip*>(chip)->read(from); };
  };
  for (const Address at : {TIFR1, TIMSK1, PCIFR, PCICR, ADCSRA, ADCSRB, ADMUX}) mine(at, false);
  for (const Address at : {ADCL, ADCH, TCCR1A, TCCR1B}) mine(at, true);
  for (Address at = TCNT1L; at <= OCR1CH; ++at) mine(at, true);
  std::set<char> of_gates;
  for (const Pin& pin : pins_.upper) of_gates.insert(pin.port);
  for (const Pin& pin : pins_.lower) of_gates.insert(pin.port);
  for (const char port : of_gates)
    for (const Address at : {Pin{port, 0}.PIN(), Pin{port, 0}.DDR(), Pin{port, 0}.PORT()}) take_over_port(at);
  // If simavr starts one of its timers during a run (for the watchdog or the serial line), simavr continues
  // until that timer is due. With this setting it returns at once: only run_core() computes the right end.
  avr_->run_cycle_limit = 1;
  // simavr advances its cycle counter by its own estimate of the idle time. This function subtracts the
  // estimate, because sleep_core() computes the right time.
  avr_->sleep = [](avr_t* avr, avr_cycle_count_t cycles) { avr->cycle -= cycles + 1; };
  // The watchdog calls this function to reset the chip.
  avr_->reset = [](avr_t* avr) {
    Chip& c = *static_cast<Chip*>(avr->io[AVR_DATA_TO_IO(ADMUX)].w.param);
    c.was_reset_ = true;
    c.stop_core();
  };
  overflow_ = vector(vector_TIMER1_OVF);
  capture_ = vector(vector_TIMER1_CAPT);
  converted_ = vector(vector_ADC);
  hall_irqs_ = avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('K'), IOPORT_IRQ_PIN0);
}

void Chip::register_pin_change() {
  pin_change_.vector = vector_PCINT2;
  pin_change_.enable = {.reg = PCICR, .bit = PCIE2_bit, .mask = 1};
  pin_change_.raised = {.reg = PCIFR, .bit = PCIE2_bit, .mask = 1};
  avr_register_vector(avr_, &pin_change_);
}

/// Passes writes to a port to simavr, and notes that gates may have changed.
void Chip::take_over_port(Address at) {
  auto& w = avr_->io[AVR_DATA_TO_IO(at)].w;
  PortRegister& port = ports_.emplace_back(PortRegister{this, w.c, w.param});
  w.param = &port;
  w.c = [](avr_t* avr, avr_io_addr_t to, std::uint8_t value, void* param) {
    const PortRegister& p = *static_cast<PortRegister*>(param);
    p.write(avr, to, value, p.of_write);
    p.chip->stop_core();
  };
}

void Chip::follow_interrupts() {
  const auto notify = [](avr_irq_t* irq, std::uint32_t runs, void* chip) {
    Chip& c = *static_cast<Chip*>(chip);
    const unsigned number = irq->irq >> 8;
    runs != 0 ? c.entered(number) : c.left(number);
  };
  for (int n = 0; n < avr_->interrupts.vector_count; ++n)
    avr_irq_register_notify(avr_->interrupts.vector[n]->irq + AVR_INT_IRQ_RUNNING, notify, this);
}

/// Replaces simavr's handling of the serial line, which prints lines and sleeps when a program polls the
/// line.
void Chip::follow_serial_line() {
  std::uint32_t flags = 0;
  avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  if (serial_ == nullptr) return;
  const auto take = [](avr_irq_t*, std::uint32_t byte, void* file) {
    std::fputc(static_cast<int>(byte & 0xff), static_cast<std::FILE*>(file));
  };
  avr_irq_register_notify(avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), take, serial_);
}

void Chip::entered(unsigned number) {
  response_ += interrupt_response + (slept_ ? wake_up : 0);
  slept_ = false;
  stop_core();
  if (number == vector_ADC) control_.entered();
  if (number == vector_PCINT2) hall_.entered();
}

/// Called during the return instruction of an interrupt.
void Chip::left(unsigned number) {
  const std::uint64_t at = avr_->cycle + interrupt_return;
  if (number == vector_ADC) control_.left(at);
  if (number == vector_PCINT2) hall_.left(at);
}

/// Stops the core after this instruction; otherwise simavr would use up its number of cycles.
void Chip::stop_core() {
  stop_ = true;
  avr_->run_cycle_count = 0;
}

void Chip::set_pins(std::uint32_t hall_pins, std::uint64_t since) {
  const std::uint8_t before = avr_->data[PINK];
  for (unsigned line = 0; line < 3; ++line)
    avr_raise_irq(hall_irqs_ + pins_.hall[line].bit, hall_pins >> (2 - line) & 1);
  if (((avr_->data[PINK] ^ before) & avr_->data[PCMSK2]) == 0 || pin_change_.pending != 0) return;
  avr_raise_interrupt(avr_, &pin_change_);
  hall_.asked(since);
}

/// Resets the chip. simavr has cleared the registers, also of the ports, but not the levels at the pins. The
/// RAM is unchanged.
void Chip::begin_anew() {
  was_reset_ = has_write_ = timer_started_it_ = result_locked_ = slept_ = false;
  timer_ = {};
  converter_ = {};
  response_ = 0;
  for (const Pin& pin : pins_.hall) {
    avr_irq_t* irq = hall_irqs_ + pin.bit;
    const std::uint32_t level = irq->value;
    avr_raise_irq(irq, level == 0);
    avr_raise_irq(irq, level);
  }
}

void Chip::advance(std::uint64_t until) {
  const std::uint64_t target = std::min({until, timer_.next(), converter_.next()});
  stop_ = false;
  while (avr_->cycle < target && !stop_ && avr_->interrupt_state <= 0 && !ended_)
    avr_->state == cpu_Sleeping ? sleep_core(target) : run_core(target);
  if (was_reset_) begin_anew();
  settle();
  while (avr_->interrupt_state > 0 && avr_->sreg[S_I] != 0) avr_service_interrupts(avr_);
  if (response_ == 0) return;
  avr_->cycle += response_;
  response_ = 0;
  settle();
}

void Chip::run_core(std::uint64_t target) {
  const auto* timer = avr_->cycle_timers.timer;
  const bool waits = timer != nullptr && timer->when > avr_->cycle;
  avr_->run_cycle_count = (waits ? std::min<avr_cycle_count_t>(timer->when, target) : target) - avr_->cycle;
  avr_run(avr_);
  ended_ =
      avr_->state == cpu_Crashed || avr_->state == cpu_Done || avr_->pc >= avr_->codeend || told_of_error;
}

/// Sleeps until an interrupt may occur, from this class or from another peripheral of simavr.
void Chip::sleep_core(std::uint64_t target) {
  slept_ = true;
  const auto* timer = avr_->cycle_timers.timer;
  if (timer == nullptr || timer->when > target) {
    avr_->cycle = target;
    return;
  }
  avr_->cycle = std::max(avr_->cycle, timer->when);
  avr_run(avr_);
  stop_ = true;
}

}  // namespace board
