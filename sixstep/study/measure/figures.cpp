// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/figures.hpp"

#include <algorithm>

#include "sixstep/base/written.hpp"
#include "sixstep/study/scenario/switching_law.hpp"

namespace sixstep::study {

namespace {

/// A window per reference step inside the measure's own window. Without `start` the step goes from the
/// preceding level to the new level. For a square wave, reach_time takes its fraction of the new level,
/// counted from 0, not of the distance between both levels: this is the stricter definition of "98 %".
Gauges step_gauges(const Measure& m, const std::vector<Level>& levels, Window window, bool square) {
  Gauges gauges;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    const double from = levels[n].at_s, to = n + 1 < levels.size() ? levels[n + 1].at_s : window.to_s;
    const double before = n == 0 ? 0.0 : levels[n - 1].value;
    if (from < window.from_s || !(from < window.to_s) || levels[n].value == before) continue;
    const bool whole = square && m.metric == MetricKind::reach_time;
    gauges.emplace_back(m, Window{from, std::min(to, window.to_s)}, levels[n].value,
                        m.start.value_or(whole ? 0.0 : before));
  }
  return gauges;
}

/// A window for each level of the reference within the measure's own window: the level's tail, or the whole
/// level if the measure gives from_s.
Gauges level_gauges(const Measure& m, const std::vector<Level>& levels, Window window) {
  const double tail = m.tail.value_or(m.from_s ? 1.0 : default_tail);
  Gauges gauges;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    const double from = std::max(levels[n].at_s, window.from_s);
    const double to = n + 1 < levels.size() ? std::min(levels[n + 1].at_s, window.to_s) : window.to_s;
    if (from < to) gauges.emplace_back(m, Window{to - tail * (to - from), to}, levels[n].value, std::nullopt);
  }
  return gauges;
}

Gauges gauges_for(const Measure& m, const Scenario& scenario, const std::vector<Level>& levels) {
  const Window window{m.from_s.value_or(0.0), m.to_s.value_or(scenario.duration_s)};
  const bool square = scenario.reference.shape == Shape::square;
  if (is_of_a_step(m.metric) && !m.level) return step_gauges(m, levels, window, square);
  if (is_of_a_level(m.metric) && !m.level) return level_gauges(m, levels, window);
  return {Gauge(m, window, m.level.value_or(0.0), m.start)};
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The worst value of all steps; for a signed error the value with the largest magnitude. NaN, which meets no
/// requirement, if the run ended before the window.
double value_of(const Gauges& gauges, const Measure& m) {
  const auto size = [&](double v) { return m.metric == MetricKind::steady_error ? std::fabs(v) : v; };
  double worst = nothing;
  for (const Gauge& gauge : gauges) {
    const std::optional<double> v = gauge.value();
    if (!v || *v != *v) return nothing;
    if (&gauge == &gauges.front() || size(*v) > size(worst)) worst = *v;
  }
  return worst;
}
double value_of(const auto& taken, const Measure&) { return taken.value(); }

/// True if a figure of samples is also computed from the whole signal, because all samples lie at the same
/// phase of the PWM ripple. False for figures that are times, because the ripple can leave the band.
bool looks_beside_samples(const Measure& m) {
  return m.sampled && fact_of(m.metric).of == TakenOf::signal && !is_time(m.metric);
}

bool meets(const Requirement& r, double v) {
  return v == v && (!r.min || v >= *r.min) && (!r.max || v <= *r.max);
}

/// True if the figure of the whole signal differs from the figure of its samples by more than half the
/// required range, or only one of the two meets the requirement.
bool tells_apart(const Requirement& r, double samples, double whole) {
  if (whole != whole) return false;
  if (r.min && r.max && std::fabs(whole - samples) > (*r.max - *r.min) / 2) return true;
  return meets(r, samples) != meets(r, whole);
}

/// True if the figure averages the ripple out. Its value from samples at the ripple's mean then equals its
/// value from the whole signal.
bool levels_the_ripple(MetricKind metric) {
  return metric == MetricKind::mean || metric == MetricKind::rms || metric == MetricKind::steady_error;
}

/// True if pwm.sample = "middle" is possible. It is not possible for
/// - comparators, which need no sample,
/// - the deadbeat law, which needs a sample at the period's start,
/// - sensorless, field-oriented and user's drives, which have their own sample instant.
bool may_sample_in_the_middle(const Control& c) {
  return (c.drive == FirmwareKind::lean || c.drive == FirmwareKind::product) &&
         c.current.type == CurrentLoopType::pi;
}

/// The current equals its mean in the middle of a centred pulse, except that a dead time delays the pulse. A
/// maximum, an overshoot or a ripple includes the ripple at any sample instant.
std::string cure_of_samples(const Scenario& s, const Measure& m) {
  std::string whole = "set sampled = false to judge the whole signal";
  if (!levels_the_ripple(m.metric)) return whole + ", with the ripple between the samples included";
  const bool is_so = s.pwm.sample == SampleAt::middle && s.pwm.alignment == Alignment::centre;
  if (is_so || unit_of(m.signal) != "A" || !may_sample_in_the_middle(s.control)) return whole;
  return "set pwm.alignment = \"centre\" and pwm.sample = \"middle\" to sample near the mean, or " + whole;
}

std::string sample_note(const Scenario& s, const Measure& m, double samples, double whole,
                        const base::LinearUnit& unit) {
  const auto told = [&unit](double x) {
    return base::rounded(x * unit.factor, 4) + " " + std::string(unit.linear);
  };
  return figure_name(s, m) + " is " + told(samples) + " at the controller's samples, but " + told(whole) +
         " over the whole signal. The difference is larger than the requirement allows: all samples lie at the "
         "same phase of the PWM ripple; " +
         cure_of_samples(s, m);
}

Taken taken_by(const Measure& m, const Scenario& scenario, const std::vector<Level>& levels) {
  const Window all{m.from_s.value_or(0.0), m.to_s.value_or(std::numeric_limits<double>::infinity())};
  const EnergyGauge energies(all, {scenario.load.viscous_Nm_s, scenario.load.coulomb_Nm},
                             switching_law(scenario.bridge));
  switch (fact_of(m.metric).of) {
    case TakenOf::signal:
      break;
    case TakenOf::fundamental:
      return Distortion{{{all.from_s, std::min(all.to_s, scenario.duration_s)}, m.signal, m.frequency_Hz}};
    case TakenOf::power:
      return Energy{energies, m.signal};
    case TakenOf::energies:
      return Efficiency{energies};
    case TakenOf::band:
      if (m.metric == MetricKind::band_excess) return BandExcess{HysteresisGauge(all)};
      return BandDeficit{HysteresisGauge(all)};
    case TakenOf::switching:
      return SwitchingGauge(all, m.signal);
    case TakenOf::transitions:
      return SwitchingLossGauge(all, switching_law(scenario.bridge));
    case TakenOf::commutations:
      return CommutationError{CommutationGauge(all), m.metric == MetricKind::commutation_error_rms};
  }
  return gauges_for(m, scenario, levels);
}

}  // namespace

double Energy::value() const { return gauge.energy(signal).value_or(nothing); }
double Efficiency::value() const { return gauge.efficiency().value_or(nothing); }
double Distortion::value() const { return gauge.thd().value_or(nothing); }

Figures::Figures(const Scenario& scenario, const std::vector<Level>& levels) {
  figures_.reserve(scenario.require.size() + scenario.compare.size());
  for (const Requirement& r : scenario.require)
    figures_.push_back({r.measure, taken_by(r.measure, scenario, levels)});
  for (const Comparison& c : scenario.compare)
    figures_.push_back({c.measure, taken_by(c.measure, scenario, levels)});
  for (const Requirement& r : scenario.require)
    if (looks_beside_samples(r.measure)) {
      Measure whole = r.measure;
      whole.sampled = false;
      figures_.push_back({whole, taken_by(whole, scenario, levels)});
    }
}

namespace {

/// Names the figures whose window begins after the drive's trip, because they describe a motor that coasts.
void note_coasting(const Scenario& s, Outcome& outcome) {
  if (!outcome.trip) return;
  std::string which;
  std::size_t count = 0;
  const auto look = [&](const Measure& m) {
    if (m.from_s.value_or(0.0) < outcome.trip->at_s) return;
    which += (count++ == 0 ? "" : ", ") + figure_name(s, m);
  };
  for (const Requirement& r : s.require) look(r.measure);
  for (const Comparison& c : s.compare) look(c.measure);
  if (count > 0) outcome.notes.push_back("figures measured after the trip, with the drive off: " + which);
}

}  // namespace

double figure_zero(const Scenario& scenario, const Measure& m) {
  // A swing or an error is a difference of two temperatures.
  const bool level = m.metric <= MetricKind::minimum;
  return level && figure_unit(m) == "degC" ? scenario.heat.ambient_degC : 0.0;
}

void Figures::judge(const Scenario& scenario, Outcome& outcome) const {
  std::size_t n = 0;
  const auto next = [&] {
    const Figure& figure = figures_[n++];
    const double v =
        std::visit([&](const auto& gauge) { return value_of(gauge, figure.measure); }, figure.taken_by);
    // A time may be infinite; any other infinite value is invalid.
    return is_time(figure.measure.metric) || v - v == 0.0 ? v : nothing;
  };
  std::vector<double> judged;
  for (const Requirement& r : scenario.require) {
    const double v = next();
    judged.push_back(v);
    const base::LinearUnit unit = unit_in(scenario, figure_unit(r.measure));
    const auto shown = [&](const std::optional<double>& x) {
      return x ? std::optional(*x * unit.factor) : std::nullopt;
    };
    outcome.verdicts.push_back({figure_name(scenario, r.measure), std::string(unit.linear), v * unit.factor,
                                shown(r.min), shown(r.max), meets(r, v), figure_zero(scenario, r.measure)});
  }
  for (const Comparison& c : scenario.compare) {
    const base::LinearUnit unit = unit_in(scenario, figure_unit(c.measure));
    outcome.comparisons.push_back({figure_name(scenario, c.measure), std::string(unit.linear),
                                   next() * unit.factor, c.value * unit.factor, c.source,
                                   figure_zero(scenario, c.measure)});
  }
  for (std::size_t k = 0; k < scenario.require.size(); ++k) {
    const Requirement& r = scenario.require[k];
    if (!looks_beside_samples(r.measure)) continue;
    const double whole = next();
    const base::LinearUnit unit = unit_in(scenario, figure_unit(r.measure));
    if (tells_apart(r, judged[k], whole))
      outcome.notes.push_back(sample_note(scenario, r.measure, judged[k], whole, unit));
  }
  note_coasting(scenario, outcome);
}

}  // namespace sixstep::study
