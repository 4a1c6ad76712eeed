// SPDX-License-Identifier: Apache-2.0
// Models an ATmega2560 at 16 MHz: core, ports and interrupts of simavr, with this project's timer 1 and
// converter. A gate is on if its pin is an output and high; PB5..PB7 also depend on timer 1.
//
// Only code that links with simavr (GPL-3) may include this file.
#pragma once
#include <cstdint>
#include <cstdio>
#include <deque>

#include "faces/loop/avr/converter.hpp"
#include "faces/loop/avr/pins.hpp"
#include "faces/loop/avr/stopwatch.hpp"
#include "faces/loop/avr/timer1.hpp"
#include "sixstep/rig/chip_port.hpp"

extern "C" {
#include <simavr/sim_avr.h>
#include <simavr/sim_interrupts.h>
}

namespace board {

class Chip {
 public:
  static constexpr std::uint32_t clock_Hz = 16'000'000;

  /// If `serial` is null, the output of USART0 is lost.
  explicit Chip(const Pins& pins, std::FILE* serial) : pins_(pins), serial_(serial) {}
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;

  /// Loads the firmware; call it only once. Returns false if the file cannot be read.
  bool load(const char* elf);

  sixstep::rig::ChipAnswer run(const sixstep::rig::ChipRun& with);
  sixstep::rig::ChipTimes times() const;

 private:
  struct PortRegister {
    Chip* chip = nullptr;
    avr_io_write_t write = nullptr;  ///< simavr's own function for writes to the register
    void* of_write = nullptr;
  };
  struct Write {
    atmega2560::Address to = 0;
    std::uint8_t value = 0;
  };

  // Functions for the core, in chip_core.cpp:
  void take_over();
  void register_pin_change();
  void take_over_port(atmega2560::Address at);
  void follow_interrupts();
  void follow_serial_line();
  avr_int_vector_t* vector(unsigned number) const;
  bool flag(atmega2560::Address at, std::uint8_t bit) const { return (avr_->data[at] & bit) != 0; }
  void stop_core();
  void set_pins(std::uint32_t hall_pins, std::uint64_t since);
  void begin_anew();
  void advance(std::uint64_t until);
  void run_core(std::uint64_t target);
  void sleep_core(std::uint64_t target);
  void entered(unsigned number);
  void left(unsigned number);

  // Functions for timer and converter, in chip.cpp:
  void settle();
  void pass_timer();
  void pass_converter();
  std::uint32_t sampled(int input);
  void trigger(std::uint64_t at);
  void apply(Write write, std::uint64_t at);
  void write_flags(Write write);
  void write_adcsra(std::uint8_t value, std::uint64_t at);
  void write_adcsrb(std::uint8_t value, std::uint64_t at);
  std::uint8_t read(atmega2560::Address from);
  std::uint16_t result() const;
  bool is_on(const Pin& pin) const;
  std::uint32_t gates() const;
  void look_at_gates(std::uint64_t at);

  avr_t* avr_ = nullptr;
  avr_int_vector_t *overflow_ = nullptr, *capture_ = nullptr, *converted_ = nullptr;
  avr_int_vector_t pin_change_{};  ///< simavr 1.6 does not have this interrupt for port K
  avr_irq_t* hall_irqs_ = nullptr;
  std::deque<PortRegister> ports_;  ///< registers that set gates; a deque, so that their addresses stay valid
  Pins pins_;
  std::FILE* serial_;

  bool stop_ =
      false;  ///< true: a register was written or an interrupt was entered; the core must stop before the next instruction
  bool has_write_ = false;
  Write write_{};  ///< write that the last instruction made
  bool ended_ = false, slept_ = false;
  bool was_reset_ = false;      ///< true: the watchdog reset the chip
  std::uint64_t response_ = 0;  ///< cycles of entering interrupts that the core has not counted yet

  Timer1 timer_;
  Converter converter_;
  std::uint8_t channel_ = 0;  ///< channel of the conversion in progress
  bool timer_started_it_ = false, timer_samples_ = false;
  std::uint16_t held_ = 0, result_ = 0;
  bool result_locked_ = false;  ///< true between the reads of ADCL and ADCH

  std::uint32_t gates_ = 0, told_gates_ = 0;
  std::deque<sixstep::rig::ChipAnswer> told_;  ///< answers to the plant in the order of their cycles
  bool asked_for_count_ = false;               ///< true: the last answer was a sample
  std::uint64_t reached_ = 0;                  ///< cycle of the last answer

  Stopwatch control_{32}, hall_{32};  // longer for Hall interrupts, which may wait for a control interrupt
  std::uint64_t periods_ = 0, conversions_ = 0;
};

}  // namespace board
