// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bode/bode_study.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/bode/designed_loop.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/rig/magnet_angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/scenario/changes.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/session/session.hpp"

namespace sixstep::analysis {
namespace {

using control::Mode;
using study::ColumnId;

constexpr ColumnId phase_currents[] = {ColumnId::i_a, ColumnId::i_b, ColumnId::i_c};

/// The multisine's lines lie between 1/30 of the crossover and 30 times the crossover. The highest line is at
/// most 0.8 of half the sampling rate.
constexpr double below_crossover = 30.0, above_crossover = 30.0, of_half_the_rate = 0.8;
/// Number of samples in a period of the multisine: least, greatest and default.
constexpr double fewest_samples = 64, most_samples = 262144, usual_samples = 4096;

/// The scenario with the settings that are valid after all of its events.
study::Scenario as_at_the_end(const study::Scenario& s) {
  const std::vector<const study::At*> events = study::in_order(s);
  return study::settled(s, events.empty() ? nullptr : events.back());
}

/// Returns a problem if the reference is still not constant after the run's end. A reference that becomes
/// constant exactly at the run's end is allowed: the drive's remaining error decays in the multisine's first
/// period, as after a step.
base::Problems still_moving(const study::Scenario& run) {
  constexpr double rounding = 1e-12;
  const std::optional<double> rests_s = study::reference_rests_from_s(run);
  if (!rests_s)
    return {{"reference", "", "is never constant, but a loop is measured around a constant value",
             "set reference.shape = \"constant\""}};
  if (!(*rests_s > run.duration_s * (1 + rounding))) return {};
  return {{"reference", "",
           "moves until " + base::written(*rests_s) +
               " s, and the measurement begins where the run ends, at " + base::written(run.duration_s) +
               " s",
           "set duration_s = " + base::written(*rests_s) + ", or set reference.shape = \"constant\""}};
}

/// `run` is the scenario as written, `s` is the same scenario with the settings at the run's end.
base::Problems not_measurable(const study::Scenario& run, const study::Scenario& s) {
  base::Problems problems;
  if (s.control.mode == Mode::off || s.control.mode == Mode::duty)
    problems.push_back({"control.mode", s.control.mode == Mode::off ? "off" : "duty",
                        "has no loop to measure",
                        "set control.mode = \"current\", \"speed\" or \"position\""});
  if (s.control.slew)
    problems.push_back(
        {"control.slew", "",
         "limits how fast the setpoint changes, so that the response of the loop cannot be measured",
         "remove this key for this measurement"});
  if (s.control.position.profile.on && s.control.mode == Mode::position)
    problems.push_back({"control.position.profile", "",
                        "shapes the setpoint, so that the response of the loop cannot be measured",
                        "remove this key for this measurement"});
  if (problems.empty()) append(problems, still_moving(run));
  return problems;
}

/// The current i_q in A, across the magnet's axis.
double i_q_of(const study::FullRow& row, double pole_pairs) {
  const auto at = [&](ColumnId id) { return row[static_cast<std::size_t>(id)]; };
  const double a = at(ColumnId::i_a), b = at(ColumnId::i_b), c = at(ColumnId::i_c);
  const base::SinCos magnet = base::sin_cos(at(ColumnId::angle) * pole_pairs - rig::magnet_behind_rad);
  return -(2 * a - b - c) / 3 * magnet.sin + (b - c) / base::root_3 * magnet.cos;
}

bool carries_no_current(const study::FullRow& row) {
  constexpr double nothing_A = 1e-6;
  return std::all_of(std::begin(phase_currents), std::end(phase_currents), [&row](ColumnId id) {
    return std::fabs(row[static_cast<std::size_t>(id)]) < nothing_A;
  });
}

/// The controlled quantity, in the mode's unit.
double controlled(const study::FullRow& row, const BodeStudy& b) {
  const auto at = [&](ColumnId id) { return row[static_cast<std::size_t>(id)]; };
  if (b.mode == Mode::speed) return at(ColumnId::speed);
  if (b.mode == Mode::position) return at(ColumnId::angle) * 180.0 / base::pi;
  const bool field = b.scenario.control.drive == study::FirmwareKind::field;
  return field ? i_q_of(row, b.pole_pairs) : at(ColumnId::i_m);
}

/// Chooses the multisine's period and lines. The lines lie around the loop's crossover if the crossover is
/// known.
Multisine multisine_for(const std::optional<design::LoopFigures>& figures, double period_s,
                        std::size_t lines) {
  Multisine signal;
  double N = usual_samples, last = of_half_the_rate / 2 * N;
  if (figures && figures->crossover_rad_s) {
    N = std::clamp(std::ceil(2 * base::pi * below_crossover / (*figures->crossover_rad_s * period_s)),
                   fewest_samples, most_samples);
    const double crossover_line = *figures->crossover_rad_s * period_s * N / (2 * base::pi);
    last = std::fmin(of_half_the_rate / 2 * N, above_crossover * crossover_line);
  }
  signal.samples = static_cast<std::size_t>(N);
  signal.lines = odd_lines(static_cast<std::size_t>(last), lines);
  return signal;
}

/// The event that adds the multisine to the reference after the end of the run. Its values change in the
/// middle between two samples, so that no sample coincides with a change.
study::At multisine_event(const BodeStudy& b, std::size_t periods) {
  study::Reference r;
  r.shape = study::Shape::csv;
  r.interpolation = study::Interpolation::hold;
  const std::vector<double> one = samples_of(b.signal);
  for (std::size_t n = 0; n < (1 + periods) * one.size(); ++n) {
    r.times_s.push_back(static_cast<double>(n) * b.period_s);
    r.values.push_back(b.stands_at + one[n % one.size()]);
  }
  study::At at;
  at.time_s = b.begin_s - b.period_s / 2;
  at.reference = std::move(r);
  return at;
}

/// The scenario, extended by the multisine, without requirements and comparisons.
study::Scenario with_multisine(const study::Scenario& s, const BodeStudy& b, std::size_t periods) {
  study::Scenario out = s;
  out.require.clear();
  out.compare.clear();
  out.at.push_back(multisine_event(b, periods));
  out.duration_s = b.begin_s + static_cast<double>((1 + periods) * b.signal.samples) * b.period_s;
  return out;
}

base::Result<study::Session> at_the_end(const study::Scenario& s, const BodeStudy& b,
                                        const BodeOrder& order) {
  base::Result<study::Session> session = study::Session::open(
      s,
      {.on_record = {}, .on_event = {}, .on_logic = {}, .keep_going = order.keep_going, .keep_books = false});
  if (session && !session->advance(b.begin_s))
    return base::Problem{"duration_s", "", "is not reached: the run ended earlier or was interrupted",
                         "find the cause with a run without this measurement"};
  return session;
}

/// The controlled quantity at each sample of the evaluated periods.
base::Result<std::vector<double>> outputs_of(study::Session& session, BodeStudy& b, std::size_t periods) {
  const std::size_t N = b.signal.samples;
  std::vector<double> output;
  output.reserve(periods * N);
  std::size_t without = 0;
  for (std::size_t n = N; n < (1 + periods) * N; ++n) {
    const double t_s = b.begin_s + static_cast<double>(n) * b.period_s;
    const bool goes_on = session.advance(t_s);
    if (!goes_on && n + 1 < (1 + periods) * N)
      return base::Problem{"reference", "", "with the added multisine ended the run early",
                           "give a smaller amplitude"};
    output.push_back(controlled(session.present().signals, b));
    if (carries_no_current(session.present().signals)) ++without;
  }
  b.without_current =
      static_cast<double>(without) / static_cast<double>(std::max<std::size_t>(1, output.size()));
  return output;
}

/// Returns a problem if the controlled value drifts. A linear drift adds the same error to each period, so
/// that the periods do not differ. At line n of the multisine, a drift of x times the amplitude per period
/// changes the response by about x/n of the line's amplitude.
base::Problems still_on_its_way(const BodeStudy& b, const std::vector<double>& output, double duration_s) {
  constexpr double most_way = 0.05;
  const std::size_t N = b.signal.samples, periods = output.size() / N;
  std::vector<double> means(periods, 0.0);
  for (std::size_t n = 0; n < periods * N; ++n) means[n / N] += output[n] / static_cast<double>(N);
  bool rises = periods > 2, falls = periods > 2;
  for (std::size_t p = 1; p < periods; ++p) {
    rises = rises && means[p] > means[p - 1];
    falls = falls && means[p] < means[p - 1];
  }
  if (!rises && !falls) return {};
  const double way = (means.back() - means.front()) / static_cast<double>(periods - 1);
  if (!(std::fabs(way) > most_way * b.amplitude)) return {};
  const std::string unit = " " + std::string(study::reference_unit(b.mode));
  return {
      {"duration_s", base::written(duration_s),
       "ends while the drive still moves towards " + base::six_digits(b.stands_at) + unit +
           ": during the measurement the controlled value went from " + base::three_digits(means.front()) +
           " to " + base::three_digits(means.back()) + unit + ", by " + base::three_digits(std::fabs(way)) +
           " in each period of a multisine of +-" + base::three_digits(b.amplitude) + unit,
       "lengthen duration_s until the controlled value is constant, or set a final reference that the drive can reach"}};
}

double amplitude_of(const BodeOrder& order, double stands_at) {
  return order.amplitude.value_or(std::fabs(stands_at) / 20);
}

/// Sets the operating point and the multisine, and computes the linear loop at this point. No simulation
/// runs.
base::Problems prepare(BodeStudy& b, const study::Scenario& s, const BodeOrder& order) {
  const std::vector<study::Stretch> waveform = study::reference_waveform(s);
  const study::Scenario& last = b.at_end;
  b.mode = last.control.mode;
  b.period_s = s.pwm.period_s;
  b.begin_s = std::ceil(s.duration_s / b.period_s * (1 - 1e-12)) * b.period_s;
  // the multisine begins with a sample
  if (s.pwm.sample == study::SampleAt::middle) b.begin_s += b.period_s / 2;
  b.stands_at = waveform.back().at(s.duration_s);
  b.amplitude = amplitude_of(order, b.stands_at);
  if (!(b.amplitude > 0.0))
    return {
        {"reference", "",
         "is zero at the end of the run, so the default amplitude, a twentieth of the reference, is also zero",
         "give an amplitude, or set a final reference other than zero"}};
  const base::Result<study::Compiled> compiled = study::compile(last);
  if (!compiled) return compiled.problems();
  b.pole_pairs = compiled->motor.machine.pole_pairs;
  const double speed = b.mode == Mode::speed ? b.stands_at : 0.0;
  const DesignedLoop designed = designed_loop(last, *compiled, speed);
  b.designed = designed.loop;
  b.not_linear = designed.not_linear;
  b.lag = designed.lag;
  if (b.designed)
    b.figures = b.lag ? design::sensed_figures({.loop = *b.designed, .lag = *b.lag}, b.period_s)
                      : design::loop_figures(*b.designed, b.period_s);
  b.signal = multisine_for(b.figures, b.period_s, order.lines);
  b.signal.amplitude = b.amplitude;
  return {};
}

/// Shifts each measured phase by whole turns until it is nearest to the designed phase, which is exact and
/// continuous over the lines. A wrong phase at one line can then not shift later lines by a turn.
void lay_beside_the_designed(BodeStudy& b) {
  if (!b.designed) return;
  std::vector<double> angles;
  for (const LoopPoint& p : b.points) angles.push_back(b.designed_at(p.w_rad_s)->angle_rad());
  b.designed_phase_rad = unwrapped(angles);
  for (std::size_t k = 0; k < b.points.size(); ++k)
    b.points[k].phase_rad = next_to(b.points[k].phase_rad, b.designed_phase_rad[k]);
}

}  // namespace

std::optional<design::Complex> BodeStudy::designed_at(double w_rad_s) const {
  if (!designed) return std::nullopt;
  const design::Complex L = designed->at(w_rad_s * period_s);
  return lag ? L * lag->at(w_rad_s) : L;
}

base::Result<BodeStudy> study_bode(const study::Scenario& scenario, const BodeOrder& order) {
  if (const base::Problems problems = study::check(scenario); !problems.empty()) return problems;
  BodeStudy b;
  b.at_end = as_at_the_end(scenario);
  if (const base::Problems problems = not_measurable(scenario, b.at_end); !problems.empty()) return problems;
  if (const base::Problems problems = prepare(b, scenario, order); !problems.empty()) return problems;
  b.scenario = with_multisine(scenario, b, order.periods);
  base::Result<study::Session> session = at_the_end(b.scenario, b, order);
  if (!session) return session.problems();
  const base::Result<std::vector<double>> output = outputs_of(*session, b, order.periods);
  if (!output) return output.problems();
  if (const base::Problems problems = still_on_its_way(b, *output, scenario.duration_s); !problems.empty())
    return problems;
  const Answer answer = answer_to(b.signal, *output);
  b.points = loop_points(b.signal, answer, b.period_s, b.lag);
  lay_beside_the_designed(b);
  b.beside = answer.beside;
  b.measured = margins_of(b.points);
  return b;
}

}  // namespace sixstep::analysis
