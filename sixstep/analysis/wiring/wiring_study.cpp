// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/wiring/wiring_study.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sixstep/analysis/curve/no_load.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/hash.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/keep_going.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::analysis {
namespace {

/// Least number of electrical turns of a running motor since its start. A motor that hums swings within half
/// a turn about its rest angle, and starts at most half a turn from it.
constexpr double whole_way = 1.0;
/// Least number of electrical turns of a running motor in the measured time, in which an ideal motor makes
/// six. A motor slowed by friction still counts as running.
constexpr double still_going = 1.0 / 3;

using Columns = std::vector<std::vector<double>>;

struct Recorded {
  study::Outcome outcome;
  Columns columns;  ///< columns of the scenario, in the rotary motor's units
};

base::Result<Recorded> recorded(const study::Scenario& s, const std::function<bool()>& keep_going) {
  const base::Result<std::vector<study::Column>> columns = study::record_columns(s);
  if (!columns) return columns.problems();
  Recorded r{.outcome = {}, .columns = Columns(columns->size())};
  const auto record = [&](study::Row row) {
    for (std::size_t n = 0; n < row.size(); ++n) r.columns[n].push_back(row[n] / (*columns)[n].per_turning);
  };
  base::Result<study::Outcome> outcome = study::run(s, {.on_record = record,
                                                        .on_event = {},
                                                        .on_logic = {},
                                                        .keep_going = study::listening(keep_going),
                                                        .keep_books = false});
  if (!outcome) return outcome.problems();
  if (study::cut_short(s, *outcome)) return base::Problem{"wiring", "", "was interrupted", "start it again"};
  if (outcome->fault) return *outcome->fault;
  r.outcome = std::move(*outcome);
  return r;
}

/// Half the sum of the phase currents' magnitudes; `first` is the column of phase a.
double winding_A(const Columns& c, std::size_t first, std::size_t row) {
  return (std::fabs(c[first][row]) + std::fabs(c[first + 1][row]) + std::fabs(c[first + 2][row])) / 2;
}

/// Frequency of swings over the whole run, from the changes of direction, two per period; 0 if there are too
/// few changes.
double swings_Hz(const std::vector<double>& t_s, const std::vector<double>& speed) {
  double first = 0.0, last = 0.0;
  int changes = 0;
  for (std::size_t n = 1; n < t_s.size(); ++n) {
    if ((speed[n] < 0) == (speed[n - 1] < 0)) continue;
    last = t_s[n];
    if (changes++ == 0) first = last;
  }
  return changes < 3 ? 0.0 : (changes - 1) / 2.0 / (last - first);
}

/// Evaluates the columns of a free run: t, angle, speed, currents.
void look_at_rows(const WiringBench& b, const Columns& c, FreeRun& run) {
  const double per_rad = b.motor.machine.pole_pairs / electrical_turn_rad;
  const auto first = static_cast<std::size_t>(
      std::lower_bound(c[0].begin(), c[0].end(), b.watched_from_s - b.row_s / 2) - c[0].begin());
  for (std::size_t n = 0; n < c[0].size(); ++n) {
    run.turned.push_back(static_cast<float>((c[1][n] - c[1][0]) * per_rad));
    run.current_A.push_back(static_cast<float>(winding_A(c, 3, n)));
  }
  const auto [low, high] = std::minmax_element(c[1].begin() + static_cast<std::ptrdiff_t>(first), c[1].end());
  run.way_turns = (c[1].back() - c[1].front()) * per_rad;
  run.turns = (c[1].back() - c[1][first]) * per_rad;
  run.swing_deg = (*high - *low) * per_rad * 360;
  double sum = 0.0;
  for (std::size_t n = first; n < c[0].size(); ++n) sum += c[1][n] * per_rad;
  const double mean = sum / static_cast<double>(c[0].size() - first);
  run.rest_deg = 360 * (mean - std::floor(mean));
  run.swing_Hz = swings_Hz(c[0], c[2]);
}

FreeRun look_at(const WiringBench& b, const Recorded& r) {
  const auto figure = [&](std::size_t n) { return r.outcome.comparisons[n].measured; };
  FreeRun run{
      .speed_rad_s = figure(0),
      .phase_rms_A = std::sqrt((figure(1) * figure(1) + figure(2) * figure(2) + figure(3) * figure(3)) / 3),
      .peak_A = figure(4),
      .supply_A = figure(5)};
  look_at_rows(b, r.columns, run);
  return run;
}

/// Evaluates the columns of a turned run: t, torque, currents.
void look_at_turned(const Columns& c, WiringMeasured& m) {
  double sum = 0.0;
  for (std::size_t n = turned_rows / 6; n < turned_rows / 6 + turned_rows;
       ++n) {  // the initial current decays in the first sector, which is skipped
    const double per_A = c[1][n] / winding_A(c, 2, n);
    sum += per_A;
    m.torque_over_turn.push_back(static_cast<float>(per_A));
  }
  m.torque_Nm_A = sum / turned_rows;
}

/// Mean over the first or the second half of all sectors.
double half_mean(const std::vector<float>& torque, bool second) {
  constexpr std::size_t sector = turned_rows / 6;
  double sum = 0.0;
  for (std::size_t n = 0; n < torque.size(); ++n)
    if ((n % sector >= sector / 2) == second) sum += torque[n];
  return 2 * sum / static_cast<double>(torque.size());
}

Symptom mean_of(const std::vector<const WiringCase*>& cases) {
  Symptom sum{.ways = cases.size()};
  for (const WiringCase* c : cases) {
    sum.part += c->measured.part;
    for (const FreeRun& run : c->measured.runs) {
      constexpr double share = 1.0 / starts;
      sum.speed_rad_s += share * run.speed_rad_s;
      sum.phase_rms_A += share * run.phase_rms_A;
      sum.supply_A += share * run.supply_A;
      sum.swing_deg += share * run.swing_deg;
      sum.swing_Hz += share * run.swing_Hz;
      sum.peak_A = std::max(sum.peak_A, run.peak_A);
    }
  }
  for (double Symptom::*mean : {&Symptom::part, &Symptom::speed_rad_s, &Symptom::phase_rms_A,
                                &Symptom::supply_A, &Symptom::swing_deg, &Symptom::swing_Hz})
    sum.*mean /= static_cast<double>(std::max<std::size_t>(sum.ways, 1));
  return sum;
}

Symptom shown_by(const std::vector<const WiringCase*>& alike, const std::optional<OperatingPoint>& settled) {
  Symptom s = mean_of(alike);
  if (alike.empty() || !settled) return s;
  const WiringDoes does = alike.front()->measured.does;
  if (does != WiringDoes::forward && does != WiringDoes::backward) return s;
  s.speed_rad_s = (does == WiringDoes::forward ? 1 : -1) * settled->speed_rad_s;
  s.phase_rms_A = settled->phase_rms_A;
  s.peak_A = settled->phase_peak_A;
  s.supply_A = settled->bus_current_A;
  return s;
}

/// The runs of one wiring: six free runs, then one slow turn.
struct Runs {
  std::array<std::optional<base::Result<Recorded>>, starts + 1> of;
};

base::Result<WiringMeasured> measured(const WiringBench& b, const Runs& runs) {
  WiringMeasured m;
  base::Hash digest;
  for (const auto& run : runs.of) {
    if (!*run) return run->problems();
    digest.word((*run)->outcome.digest);
  }
  for (std::size_t n = 0; n < starts; ++n) m.runs[n] = look_at(b, **runs.of[n]);
  look_at_turned((*runs.of[starts])->columns, m);
  m.digest = digest.value();
  return m;
}

}  // namespace

WiringDoes seen_in(const WiringMeasured& m, double straight_Nm_A) {
  std::size_t forward = 0, backward = 0;
  for (const FreeRun& run : m.runs) {
    forward += run.way_turns > whole_way && run.turns > still_going ? 1 : 0;
    backward += run.way_turns < -whole_way && run.turns < -still_going ? 1 : 0;
  }
  if (forward + backward == 0) return WiringDoes::hums;
  if (forward != starts && backward != starts) return WiringDoes::unclear;
  double least = std::numeric_limits<double>::infinity();
  for (const float torque : m.torque_over_turn)
    least = std::min(least, forward ? torque : -static_cast<double>(torque));
  if (std::fabs(m.torque_Nm_A) > well_above_part * straight_Nm_A && least > well_above_least * straight_Nm_A)
    return forward ? WiringDoes::forward : WiringDoes::backward;
  // If a pair is driven early, its torque rises over a sector in the rotor's direction; if the pair is driven
  // late, its torque falls.
  const double rise = half_mean(m.torque_over_turn, true) - half_mean(m.torque_over_turn, false);
  if (forward) return rise > 0 ? WiringDoes::forward_early : WiringDoes::forward_late;
  return rise > 0 ? WiringDoes::backward_early : WiringDoes::backward_late;
}

std::size_t WiringStudy::agreeing() const {
  return static_cast<std::size_t>(
      std::count_if(cases.begin(), cases.end(), [](const WiringCase& c) { return c.agrees(); }));
}

const WiringCase& WiringStudy::at(const rig::Wiring& wiring) const {
  return *std::find_if(cases.begin(), cases.end(), [&](const WiringCase& c) { return c.wiring == wiring; });
}

const WiringCase* WiringStudy::example(WiringDoes does) const {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const WiringCase& c) { return c.measured.does == does; });
  return found == cases.end() ? nullptr : &*found;
}

Symptom WiringStudy::symptom(WiringDoes does) const {
  std::vector<const WiringCase*> alike;
  for (const WiringCase& c : cases)
    if (c.measured.does == does) alike.push_back(&c);
  return shown_by(alike, settled);
}

Symptom WiringStudy::symptom(const WiringCase& one) const { return shown_by({&one}, settled); }

Symptom WiringStudy::straight() const { return symptom(cases.front()); }

base::Result<WiringStudy> study_wiring(const WiringOrder& order) {
  base::Result<WiringBench> bench = wiring_bench(order.subject);
  if (!bench) return bench.problems();
  WiringStudy s{.subject = order.subject, .bench = std::move(*bench), .machine = {}, .cases = {}};
  const base::Result<NoLoad> settled = no_load({.motor = s.bench.motor,
                                                .voltage_V = s.bench.voltage_V,
                                                .duty = s.bench.duty,
                                                .pwm_period_s = study::Pwm{}.period_s,
                                                .keep_going = order.keep_going});
  if (settled) s.settled = settled->point;
  // The dynamometer requires the general kernel, like crossed wires. The machine of this run is therefore the
  // machine of all runs with crossed wires.
  const study::Scenario turned = turned_run(s.bench, order.subject, {});
  if (base::Problems found = study::check(turned); !found.empty()) return found;
  const base::Result<study::Compiled> compiled = study::compile(turned);
  if (!compiled) return compiled.problems();
  s.machine = compiled->general->machine;

  const auto wirings = all_wirings();
  std::vector<Runs> runs(wirings.size());
  order.for_each(wirings.size() * (starts + 1), [&](std::size_t n) {
    const std::size_t way = n / (starts + 1), run = n % (starts + 1);
    runs[way].of[run] = recorded(run < starts ? free_run(s.bench, order.subject, wirings[way], start_deg(run))
                                              : turned_run(s.bench, order.subject, wirings[way]),
                                 order.keep_going);
  });
  const PairTorque torque(s.machine, s.bench.current_A);
  for (std::size_t n = 0; n < wirings.size(); ++n) {
    base::Result<WiringMeasured> seen = measured(s.bench, runs[n]);
    if (!seen) return seen.problems();
    s.cases.push_back(
        {wirings[n], wiring_theory(torque, wirings[n]), std::move(*seen), shortest_cures(wirings[n])});
  }
  const double straight = s.cases.front().measured.torque_Nm_A;
  for (WiringCase& c : s.cases) {
    c.measured.part = c.measured.torque_Nm_A / straight;
    c.measured.does = seen_in(c.measured, straight);
  }
  return s;
}

study::Scenario straight_run(const WiringStudy& study) {
  study::Scenario s = free_run(study.bench, study.subject, {}, start_deg(0));
  for (study::Comparison& c : s.compare) c.value = 1;
  const base::Result<study::Outcome> out = study::run(s, {.keep_books = false});
  for (std::size_t n = 0; n < s.compare.size() && out; ++n) {
    // The outcome of a linear motor has another unit. The comparison's value was set to 1; its converted
    // value is therefore the factor.
    s.compare[n].value = out->comparisons[n].measured / out->comparisons[n].value;
    s.compare[n].source = "this run with straight wires";
  }
  return s;
}

}  // namespace sixstep::analysis
