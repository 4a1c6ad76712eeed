// SPDX-License-Identifier: Apache-2.0
// Checks a scenario against the AVR's board, whose timer and converter cannot be configured.
#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/base/describe.hpp"
#include "sixstep/study/run/on_core.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

constexpr int converter_bits = 10;
constexpr double clock_Hz = 16e6;
/// Largest period in counts: timer 1 counts up and down again with 16 bits.
constexpr double most_counts = 65535;
/// Longest dead time, s: the program waits for it within an interrupt.
constexpr double most_dead_time_s = 5e-6;

void need(bool has, base::Problems& out, const char* where, const char* what, const char* cure) {
  if (!has) out.push_back({where, "", what, cure});
}

void need_drive(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  need(c.drive == FirmwareKind::lean, out, "control.drive",
       "is not \"lean\", the only drive that the AVR is fast enough for", "remove this key");
  need(c.mode == control::Mode::duty ||
           (c.mode == control::Mode::current && c.current.type == CurrentLoopType::pi),
       out, "control.mode",
       "is not supported by the AVR's program, which sets a duty or controls a current by a PI",
       "set control.mode = \"current\" or \"duty\"");
  need(c.arithmetic == Arithmetic::q15 || c.arithmetic == Arithmetic::q14, out, "control.arithmetic",
       "is not supported by the AVR's program, whose signals have 16 bits",
       "set control.arithmetic = \"q15\"");
  need(!std::any_of(s.at.begin(), s.at.end(), retunes), out, "at.control",
       "changes settings of the chip that are fixed in its flash", "remove such [[at]] events");
}

void need_timer(const Scenario& s, base::Problems& out) {
  need(s.pwm.alignment == Alignment::centre, out, "pwm.alignment",
       "is not supported by timer 1, which counts up and down", "set pwm.alignment = \"centre\"");
  need(s.pwm.sample == SampleAt::middle, out, "pwm.sample",
       "is not the instant at which timer 1 starts the converter", "set pwm.sample = \"middle\"");
  need(s.pwm.chopping == control::Chopping::soft && s.pwm.pattern == control::PwmPattern::upper, out,
       "pwm.chopping", "is not supported: timer 1 chops the upper switches only",
       "set pwm.chopping = \"soft\" and pwm.pattern = \"upper\"");
  need(s.bridge.dead_time_s > 0.0 && s.bridge.dead_time_s <= most_dead_time_s, out, "bridge.dead_time_s",
       "is not a dead time that the AVR's program can produce",
       "set bridge.dead_time_s above 0 and at most 5e-6");
  const double counts = s.pwm.period_s * clock_Hz / 2;
  const double whole = std::floor(counts + 0.5);
  need(counts >= 2 && counts <= most_counts && counts - whole < 1e-6 && whole - counts < 1e-6, out,
       "pwm.period_s", "is not a multiple of 125 ns, the step of timer 1",
       "set a multiple of 125 ns, at most 8 ms");
}

/// True if an event changes a transducer: other boards simulate this, the AVR's board does not.
bool drifts(const At& at) { return at.sensors.current_offset_A || at.sensors.current_gain_error; }

void need_converter(const Scenario& s, base::Problems& out) {
  need(
      !std::any_of(s.at.begin(), s.at.end(), drifts), out, "at.sensors",
      "changes a transducer's offset or gain during the run, which the AVR's board does not support",
      "give the transducer's offset and gain from the start: sensors.current_offset_A and current_gain_error");
  need(s.sensors.currents == rig::CurrentMeasurement::phases, out, "sensors.currents",
       "is not supported: the AVR's board has a transducer in each phase",
       "set sensors.currents = \"phases\"");
  need(s.sensors.adc_bits == converter_bits, out, "sensors.adc_bits",
       "is not supported: the AVR's converter has 10 bits", "set sensors.adc_bits = 10");
  need(!s.sensors.current_bandwidth_Hz, out, "sensors.current_bandwidth_Hz",
       "is not supported: the amplifiers of the AVR's board have no lag", "remove this key");
}

}  // namespace

base::Problems not_on_an_avr(const Scenario& s) {
  base::Problems out;
  need_drive(s, out);
  need_timer(s, out);
  need_converter(s, out);
  return out;
}

base::Problems not_on_an_avrs_board(const Scenario& s) {
  base::Problems out;
  need_converter(s, out);
  return out;
}

}  // namespace sixstep::study
