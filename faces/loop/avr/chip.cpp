// SPDX-License-Identifier: Apache-2.0
// Computes the events at an ATmega2560's pins, and the effects of writes by the firmware.
#include "faces/loop/avr/chip.hpp"

namespace board {

namespace rig = sixstep::rig;
using namespace atmega2560;

rig::ChipAnswer Chip::run(const rig::ChipRun& with) {
  if (asked_for_count_) held_ = with.counts[pins_.what_hangs_at(channel_)] & 0x3ff;
  asked_for_count_ = false;
  set_pins(with.hall_pins, reached_);
  while (told_.empty() && !ended_ && avr_->cycle < with.until) advance(with.until);
  rig::ChipAnswer answer{.cycle = with.until};
  if (!told_.empty() && told_.front().cycle <= with.until) {
    answer = told_.front();
    told_.pop_front();
    told_gates_ = answer.gates;
    asked_for_count_ = answer.event == rig::ChipEvent::sample;
  } else if (ended_ && told_.empty()) {
    answer.event = rig::ChipEvent::ended;
    if (avr_->cycle < answer.cycle) answer.cycle = avr_->cycle;
  }
  answer.gates = told_gates_;
  reached_ = answer.cycle;
  return answer;
}

rig::ChipTimes Chip::times() const {
  return {
      .control = control_.times(), .hall = hall_.times(), .periods = periods_, .conversions = conversions_};
}

/// Executes all events up to the end of the last instruction, in the order of their cycles. Then executes the
/// write of this instruction.
void Chip::settle() {
  const std::uint64_t now = avr_->cycle;
  for (;;) {
    const bool timer_first = timer_.next() <= converter_.next();
    if ((timer_first ? timer_.next() : converter_.next()) > now) break;
    timer_first ? pass_timer() : pass_converter();
  }
  if (has_write_) apply(write_, now);
  has_write_ = false;
  look_at_gates(now);
}

void Chip::pass_timer() {
  const std::uint64_t at = timer_.next();
  const Timer1::Event event = timer_.pass();
  if (event == Timer1::Event::top) avr_raise_interrupt(avr_, capture_);
  if (event == Timer1::Event::bottom) {
    ++periods_;
    const bool rises = !flag(TIFR1, TOV1);
    avr_raise_interrupt(avr_, overflow_);
    if (rises && (avr_->data[ADCSRB] & ADTS_bits) == ADTS_timer1_overflow) trigger(at);
  }
  look_at_gates(at);
}

void Chip::trigger(std::uint64_t at) {
  if (!flag(ADCSRA, ADATE) || !converter_.trigger(at)) return;
  avr_->data[ADCSRA] |= ADSC;
  timer_started_it_ = true;
  ++conversions_;
}

void Chip::pass_converter() {
  const std::uint64_t at = converter_.next();
  switch (converter_.pass()) {
    case Converter::Event::starts:
      channel_ = static_cast<std::uint8_t>((avr_->data[ADMUX] & MUX_bits) | (avr_->data[ADCSRB] & MUX5) << 2);
      break;
    case Converter::Event::holds:
      held_ = 0;
      if (const int input = pins_.what_hangs_at(channel_); input >= 0)
        told_.push_back(
            {.cycle = at, .event = rig::ChipEvent::sample, .gates = gates_, .channel = sampled(input)});
      break;
    case Converter::Event::done:
      if (!result_locked_) result_ = held_;
      avr_->data[ADCSRA] &= static_cast<std::uint8_t>(~ADSC);
      if (timer_started_it_) control_.asked(at);
      timer_started_it_ = false;
      avr_raise_interrupt(avr_, converted_);
      break;
  }
}

/// If the timer starts a firmware's control samples, the firmware may also convert a current between them.
/// Such a conversion is not a control sample (rig/chip_port.hpp).
std::uint32_t Chip::sampled(int input) {
  constexpr int currents = 3, between_control_samples = 4;
  if (timer_started_it_ && input < currents) timer_samples_ = true;
  const bool between = input < currents && timer_samples_ && !timer_started_it_;
  return static_cast<std::uint32_t>(between ? input + between_control_samples : input);
}

void Chip::apply(Write write, std::uint64_t at) {
  switch (write.to) {
    case TIFR1:
    case TIMSK1:
    case PCIFR:
    case PCICR:
      write_flags(write);
      break;
    case ADCSRA:
      write_adcsra(write.value, at);
      break;
    case ADCSRB:
      write_adcsrb(write.value, at);
      break;
    case ADMUX:
      avr_->data[ADMUX] = write.value;
      break;
    case ADCL:
    case ADCH:
      break;
    default:
      timer_.write(write.to, write.value, at);
  }
}

/// Writing 1 clears a flag. A set flag requests its interrupt as soon as the interrupt is enabled.
void Chip::write_flags(Write write) {
  const struct {
    Address flags, mask;
    std::uint8_t bit;
    avr_int_vector_t* vector;
  } all[] = {
      {TIFR1, TIMSK1, TOV1, overflow_}, {TIFR1, TIMSK1, ICF1, capture_}, {PCIFR, PCICR, PCIE2, &pin_change_}};
  for (const auto& one : all)
    if (write.to == one.flags && (write.value & one.bit) != 0) avr_clear_interrupt(avr_, one.vector);
  if (write.to == TIFR1 || write.to == PCIFR) return;
  avr_->data[write.to] = write.value;
  for (const auto& one : all)
    if (write.to == one.mask && flag(one.flags, one.bit)) avr_raise_interrupt(avr_, one.vector);
}

/// Writing 1 to ADIF clears it. Writing 1 to ADSC starts a conversion; ADSC reads as 1 during the conversion.
void Chip::write_adcsra(std::uint8_t value, std::uint64_t at) {
  if ((value & ADIF) != 0) avr_clear_interrupt(avr_, converted_);
  converter_.set((value & ADEN) != 0, value & 7, at);
  if ((value & ADSC) != 0) converter_.start(at);
  if (!converter_.busy()) timer_started_it_ = false;
  const auto kept = static_cast<std::uint8_t>(value & ~(ADSC | ADIF));
  const auto shown = static_cast<std::uint8_t>((avr_->data[ADCSRA] & ADIF) | (converter_.busy() ? ADSC : 0));
  avr_->data[ADCSRA] = kept | shown;
  if ((shown & ADIF) != 0) avr_raise_interrupt(avr_, converted_);
}

/// If the flag of a newly selected trigger is set, the selection counts as an edge (data sheet, 26.4).
void Chip::write_adcsrb(std::uint8_t value, std::uint64_t at) {
  const bool before = (avr_->data[ADCSRB] & ADTS_bits) == ADTS_timer1_overflow;
  avr_->data[ADCSRB] = value;
  if (!before && (value & ADTS_bits) == ADTS_timer1_overflow && flag(TIFR1, TOV1)) trigger(at);
}

std::uint16_t Chip::result() const {
  return static_cast<std::uint16_t>(flag(ADMUX, ADLAR) ? result_ << 6 : result_);
}

/// An instruction reads a register in its second cycle.
std::uint8_t Chip::read(Address from) {
  if (from != ADCL && from != ADCH) return timer_.read(from, avr_->cycle + 1);
  result_locked_ = from == ADCL;
  return static_cast<std::uint8_t>(from == ADCL ? result() : result() >> 8);
}

/// Whether the pin is an output and high. If the timer drives the pin, the level is the timer's, else the
/// port's.
bool Chip::is_on(const Pin& pin) const {
  if (!flag(pin.DDR(), pin.mask())) return false;
  const int channel = pin.port == 'B' ? pin.bit - 5 : -1;
  return channel >= 0 && timer_.connected(channel) ? timer_.level(channel) : flag(pin.PORT(), pin.mask());
}

/// The gates in the order of control/gates.hpp: upper gates are the even bits, lower gates the odd bits.
std::uint32_t Chip::gates() const {
  std::uint32_t on = 0;
  for (int leg = 0; leg < 3; ++leg) {
    if (is_on(pins_.upper[leg])) on |= 1u << (2 * leg);
    if (is_on(pins_.lower[leg])) on |= 2u << (2 * leg);
  }
  return on;
}

void Chip::look_at_gates(std::uint64_t at) {
  const std::uint32_t now = gates();
  if (now == gates_) return;
  gates_ = now;
  told_.push_back({.cycle = at, .event = rig::ChipEvent::gates, .gates = now});
}

}  // namespace board
