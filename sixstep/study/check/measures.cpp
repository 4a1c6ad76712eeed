// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/measures.hpp"

#include "sixstep/base/written.hpp"
#include "sixstep/study/check/recordings.hpp"
#include "sixstep/study/measure/harmonic_gauge.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/measure_choices.hpp"
#include "sixstep/study/scenario/reference_waveform.hpp"
#include "sixstep/study/scenario/switching_law.hpp"

namespace sixstep::study {

namespace {

using control::Mode;

std::string quoted(std::string_view word) {
  std::string text(1, '"');
  text += word;
  text += '"';
  return text;
}
std::string quoted(MetricKind kind) { return quoted(base::word(metric_choices, kind)); }
std::string quoted(Signal signal) { return quoted(fact_of(signal).word); }

/// One measure, its place in the file, and the list for its problems.
struct Asked {
  const Measure& m;
  const std::string& where;
  const Scenario& s;
  base::Problems& out;

  double from_s() const { return m.from_s.value_or(0.0); }
  double to_s() const { return m.to_s.value_or(s.duration_s); }
  void refuse(const char* key, std::string value, std::string limit, std::string cure) const {
    out.push_back({where + "." + key, std::move(value), std::move(limit), std::move(cure)});
  }
};

void check_window(const Asked& a) {
  if (!a.m.to_s && !(a.from_s() < a.s.duration_s))
    return a.refuse("from_s", base::written(a.from_s()),
                    "is not before the end of the run (duration_s = " + base::written(a.s.duration_s) + ")",
                    "lower from_s, or lengthen duration_s");
  if (!(a.from_s() < a.to_s()))
    a.refuse("to_s", base::written(a.to_s()), "must be after from_s = " + base::written(a.from_s()),
             "give a from_s that is smaller than to_s");
  if (a.to_s() > a.s.duration_s)
    a.refuse("to_s", base::written(a.to_s()),
             "is after the end of the run (duration_s = " + base::written(a.s.duration_s) + ")",
             "lower to_s, or lengthen duration_s");
}

/// Requires event comparators, because only event comparators keep the current in a band.
void check_band(const Asked& a) {
  const CurrentLoop& loop = a.s.control.current;
  const bool closed = a.s.control.mode != Mode::off && a.s.control.mode != Mode::duty;
  const bool armed =
      closed && loop.type == CurrentLoopType::hysteresis && loop.comparator == Comparator::event;
  if (fact_of(a.m.metric).of == TakenOf::band && !armed)
    a.refuse("metric", quoted(a.m.metric), "needs a hysteresis with event comparators",
             "set control.current.type = \"hysteresis\" and comparator = \"event\", or measure max and min");
}

/// Checks that the metric can be measured of the signal. If the file names no signal, the signal is the motor
/// current.
void check_signal(const Asked& a) {
  const Signal signal = a.m.signal;
  const bool given = signal != Signal::current;
  switch (fact_of(a.m.metric).of) {
    case TakenOf::signal:
    case TakenOf::fundamental:
      return;
    case TakenOf::transitions:
      if (!switching_law(a.s.bridge).any())
        a.refuse(
            "metric", quoted(a.m.metric), "needs the switches' energies, which [bridge] does not have",
            "give bridge.turn_on_J, turn_off_J and recovery_J, or gate_current_A and the gate's charges");
      [[fallthrough]];
    case TakenOf::commutations:
    case TakenOf::band:
    case TakenOf::energies:
      if (given)
        a.refuse("signal", quoted(signal), "has no effect: " + quoted(a.m.metric) + " has no signal",
                 "remove signal");
      return;
    case TakenOf::switching:
      if (given && !is_gate(signal))
        a.refuse("signal", quoted(signal), "does not switch",
                 "name a switch, \"gate_T1\" to \"gate_T6\", or remove signal to count the chopped switches");
      return;
    case TakenOf::power:
      if (!is_power(signal))
        a.refuse("signal", quoted(signal), "is not a power, so energy_J cannot be computed",
                 "name a power or a loss, as signal = \"supply_power_W\" or \"copper_loss_W\"");
      return;
  }
}

/// Requires a field-oriented drive for signals that only this drive has.
void check_drive(const Asked& a) {
  if (!is_of_field(a.m.signal)) return;
  if (a.s.control.drive != FirmwareKind::field)
    a.refuse("signal", quoted(a.m.signal), "applies to the field-oriented drive only",
             "set control.drive = \"field-oriented\", or name another signal");
}

/// Refuses figures of the reference, or of the error against it, in a mode without this reference.
void check_mode(const Asked& a) {
  const Mode mode = a.s.control.mode;
  const bool position = comes_into(a.s, Mode::position), speed = position || comes_into(a.s, Mode::speed);
  const bool current = speed || comes_into(a.s, Mode::current);
  const Signal signal = a.m.signal;
  const bool missing =
      (is_of_field(signal) && !current) ||
      ((signal == Signal::current_reference || signal == Signal::current_error) && !current) ||
      ((signal == Signal::speed_reference || signal == Signal::speed_error) && !speed) ||
      ((signal == Signal::position_reference || signal == Signal::position_error) && !position);
  if (missing)
    a.refuse("signal", quoted(signal),
             "does not exist in control.mode = " + quoted(base::word(mode_choices, mode)),
             "name a signal of this mode, or change control.mode");
}

bool is_controlled(Signal signal, const Control& control) {
  const Mode mode = control.mode;
  const bool across = control.drive == FirmwareKind::field && signal == Signal::quadrature_current;
  return (mode == Mode::current && (signal == Signal::current || across)) ||
         (mode == Mode::speed && signal == Signal::speed) ||
         (mode == Mode::position && signal == Signal::position);
}

void check_level(const Asked& a) {
  const bool wanted = fact_of(a.m.metric).over != TakenOver::window;
  if (wanted && !a.m.level && !is_controlled(a.m.signal, a.s.control))
    a.refuse("level", "", "is missing, and the reference belongs to another signal",
             "give level, the value that the signal must reach, in the signal's unit");
  const Measure usual;
  const auto looks_not = [&a](const char* key, double value) {
    a.refuse(key, base::written(value), "has no effect: " + quoted(a.m.metric) + " does not use this key",
             "remove this key");
  };
  if (a.m.level && !wanted) looks_not("level", *a.m.level);
  if (a.m.start && !is_of_a_step(a.m.metric)) looks_not("start", *a.m.start);
  if (a.m.fraction != usual.fraction && a.m.metric != MetricKind::reach_time)
    looks_not("fraction", a.m.fraction);
  if (a.m.band != usual.band && a.m.metric != MetricKind::settling_time) looks_not("band", a.m.band);
  if (a.m.tail && !is_of_a_level(a.m.metric))
    a.refuse("tail", base::written(*a.m.tail),
             "has no effect: " + quoted(a.m.metric) + " does not use this key",
             "remove this key, or set from_s and to_s");
  if (a.m.tail && is_of_a_level(a.m.metric) && a.m.level)
    a.refuse("tail", base::written(*a.m.tail),
             "applies to the levels of the reference only, and level is given",
             "remove this key, and set from_s and to_s");
}

/// Requires a reference with constant levels, because the levels define the steps. A moving reference has no
/// levels.
void check_levels_of_reference(const Asked& a) {
  const bool takes_levels = fact_of(a.m.metric).over != TakenOver::window;
  if (takes_levels && !a.m.level && is_controlled(a.m.signal, a.s.control) &&
      reference_moves(a.s, a.from_s(), a.to_s()))
    a.refuse(
        "metric", quoted(a.m.metric),
        "needs constant levels of the reference, and the reference moves in this window",
        "give level, start and from_s, or set from_s and to_s to a constant part of the reference; or use the metrics max and min of the error, for example of signal = \"speed_error_rad_s\"");
  if (takes_levels && !a.m.level && changes_mode(a.s))
    a.refuse("level", "",
             "is missing: the mode changes during the run, so that the reference changes its quantity",
             "give level, the value that the signal must reach, and from_s and to_s");
}

void check_sampled(const Asked& a) {
  if (!a.m.sampled) return;
  if (fact_of(a.m.metric).of != TakenOf::signal)
    a.refuse("sampled", "true", "would falsify " + quoted(a.m.metric) + ", which needs the whole curve",
             "remove this key: the whole curve is evaluated");
  else if (!is_known_at_samples(a.m.signal))
    a.refuse("sampled", "true",
             "is not valid for " + quoted(a.m.signal) + ", which jumps where the samples are taken",
             "remove this key: the whole curve is evaluated");
}

void check_fundamental(const Asked& a) {
  const std::optional<double>& frequency_Hz = a.m.frequency_Hz;
  if (fact_of(a.m.metric).of != TakenOf::fundamental) {
    if (frequency_Hz)
      a.refuse("frequency_Hz", base::written(*frequency_Hz),
               "has no effect: " + quoted(a.m.metric) + " does not use this key", "remove this key");
    return;
  }
  if (frequency_Hz && whole_periods({a.from_s(), a.to_s()}, *frequency_Hz) < 1.0)
    a.refuse("frequency_Hz", base::written(*frequency_Hz),
             "has no whole period in the window of " + base::written(a.to_s() - a.from_s()) + " s",
             "lengthen the window from_s to to_s, or give a higher frequency_Hz");
  if (!frequency_Hz && !alternates(a.m.signal))
    a.refuse(
        "frequency_Hz", "",
        "is missing: " + quoted(a.m.signal) + " does not alternate with the rotor's rotation",
        "give the fundamental as frequency_Hz, or choose the signal of a phase: \"i_a\", \"u_ab_V\" or \"e_a_V\"");
  else if (!frequency_Hz && a.s.load.locked)
    a.refuse("frequency_Hz", "", "is missing: a locked rotor has no electrical frequency",
             "give the fundamental as frequency_Hz, or set load.locked = false");
}

void check_measure(const Measure& m, const std::string& where, const Scenario& s, bool sound_references,
                   base::Problems& out) {
  const Asked asked{m, where, s, out};
  check_band(asked);
  check_window(asked);
  check_signal(asked);
  check_drive(asked);
  check_mode(asked);
  check_level(asked);
  if (sound_references) check_levels_of_reference(asked);
  check_sampled(asked);
  check_fundamental(asked);
}

std::string table_at(std::size_t n) { return std::string("compare[").append(std::to_string(n)).append("]"); }

/// The place of the n-th comparison with a value; those with recordings stand between.
std::string place_of(const Scenario& s, std::size_t n) {
  for (const LaidOver& laid : s.recordings()) n += laid.place <= n ? 1 : 0;
  return table_at(n);
}

}  // namespace

void check_measures(const Scenario& s, bool sound_references, base::Problems& out) {
  for (std::size_t n = 0; n < s.require.size(); ++n) {
    const std::string where = "require[" + std::to_string(n) + "]";
    check_measure(s.require[n].measure, where, s, sound_references, out);
    if (!s.require[n].min && !s.require[n].max)
      out.push_back({where, "", "requires nothing", "give min, max or both keys"});
    if (s.require[n].min && s.require[n].max && *s.require[n].min > *s.require[n].max)
      out.push_back({where + ".min", base::written(*s.require[n].min),
                     "lies above max = " + base::written(*s.require[n].max), "swap them"});
  }
  for (std::size_t n = 0; n < s.compare.size(); ++n)
    check_measure(s.compare[n].measure, place_of(s, n), s, sound_references, out);
  for (const LaidOver& laid : s.recordings()) {
    const std::string where = table_at(laid.place);
    const std::size_t before = out.size();
    check_window({laid.measure, where, s, out});
    check_mode({laid.measure, where, s, out});
    check_drive({laid.measure, where, s, out});
    if (out.size() == before) check_recording(laid, where, s, out);
  }
}

}  // namespace sixstep::study
