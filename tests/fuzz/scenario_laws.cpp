// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/scenario_laws.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "files/scenario_on_disk.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "tests/fuzz/draw.hpp"
#include "tests/fuzz/drawn_scenario.hpp"
#include "tests/fuzz/hostile_text.hpp"
#include "tests/support/scenario_walk.hpp"
#include "text/scenario/scenario_text.hpp"

namespace sixstep::testing {
namespace {

using namespace study;
using base::written;

#if defined(__SANITIZE_ADDRESS__)
constexpr double longest_case_s = 60.0;
#else
constexpr double longest_case_s = 6.0;
#endif
/// The run of a hostile text is stopped after this number of callbacks.
constexpr std::int64_t hostile_looks = 8;

/// The path of a file in the scenarios' folder. The files that a text names are in this folder.
std::string beside_scenarios(const char* name) {
  return std::string(SIXSTEP_SOURCE_DIR) + "/data/scenarios/" + name;
}

double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

constexpr double yes_no(bool holds) { return holds ? 0.0 : 2.0; }

/// Checks every row of a run: the values before and after each jump, and the recorded rows.
struct Rows {
  bool finite = true, rising = true;
  double last_s = 0.0;
  void take(Row row, control::Mode mode) {
    for (std::size_t n = 0; n < row.size(); ++n)
      finite = finite && (std::isfinite(row[n]) || !applies(static_cast<ColumnId>(n), mode));
    rising = rising && row[0] >= last_s;
    last_s = row[0];
  }
};

/// The results of one case from which its laws are computed.
struct Evidence {
  const Examined& examined;
  const base::Problems& problems;  ///< problems of reading or running; empty after a complete run
  const Outcome* outcome = nullptr;
  const Outcome* watched = nullptr;
  const Rows* rows = nullptr;
  const Walk* walk = nullptr;
  bool read_back_equal = true;
  bool breaks_a_hall_line = false;
  bool clamps = false;
  bool shorts = false;
  bool strayed_compiles = true;
  double seconds = 0.0;
};

bool told_well(const base::Problems& problems) {
  for (const base::Problem& p : problems)
    if (p.where.empty() || p.limit.empty() || p.cure.empty()) return false;
  return true;
}
bool no_defect(const base::Problems& problems) {
  for (const base::Problem& p : problems)
    if (to_string(p).find("defect of sixstep") != std::string::npos) return false;
  return true;
}

/// Returns whether the value is a valid figure. A time that was never reached is infinite; it exceeds any
/// lower limit.
bool is_figure(const Verdict& v) { return std::isfinite(v.measured) || (v.unit == "s" && v.measured > 0); }

bool sound_figures(const Outcome& outcome) {
  for (const Verdict& v : outcome.verdicts)
    if (v.ok && !is_figure(v)) return false;
  return std::isfinite(outcome.simulated_s);
}

bool says(const Outcome& outcome, const char* words) {
  return outcome.fault && outcome.fault->limit.find(words) != std::string::npos;
}

struct Law {
  const char* name;
  double (*used)(const Evidence&);
};

/// Laws of every case, whether it is random or hostile.
constexpr Law always[] = {
    {"bounded time", [](const Evidence& e) { return e.seconds / longest_case_s; }},
    {"what is refused has a place, a rule and a cure",
     [](const Evidence& e) { return yes_no(e.outcome || (!e.problems.empty() && told_well(e.problems))); }},
    {"no defect is met", [](const Evidence& e) { return yes_no(no_defect(e.problems)); }},
    {"every row is finite", [](const Evidence& e) { return yes_no(!e.rows || e.rows->finite); }},
    {"time goes on", [](const Evidence& e) { return yes_no(!e.rows || e.rows->rising); }},
    {"what holds is a number",
     [](const Evidence& e) { return yes_no(!e.outcome || sound_figures(*e.outcome)); }},
    {"no switch shorts the bus",
     [](const Evidence& e) { return yes_no(!e.outcome || e.shorts || !says(*e.outcome, "shoot-through")); }},
};

/// Laws of an accepted random case. Such a case has an outcome, an outcome with observers, and a run segment
/// by segment.
constexpr Law of_a_run[] = {
    {"it reads back as it was written", [](const Evidence& e) { return yes_no(e.read_back_equal); }},
    {"it ends, and not by crawling",
     [](const Evidence& e) {
       return yes_no(e.walk->stop == sim::Stop::end || e.walk->stop == sim::Stop::fault);
     }},
    {"watching changes no bit",
     [](const Evidence& e) {
       return yes_no(e.outcome->digest == e.watched->digest && e.outcome->digest == e.walk->digest);
     }},
    {"a snapshot goes on to the same end",
     [](const Evidence& e) { return double(e.walk->resumed_otherwise) * 2; }},
    {"only a clamp stops a shaft at once",
     [](const Evidence& e) { return yes_no(e.clamps || e.walk->laws.stops() == 0); }},
    {"a drive of its series compiles", [](const Evidence& e) { return yes_no(e.strayed_compiles); }},
    {"the state is finite", [](const Evidence& e) { return yes_no(e.walk->finite); }},
    {"no Hall line is blamed that is whole",
     [](const Evidence& e) { return yes_no(e.breaks_a_hall_line || !says(*e.outcome, "does not follow")); }},
};

/// Relative tolerance of the energy balance: a tenth of the default. The laws of the plant are checked within
/// each segment (tests/support/laws.hpp).
constexpr double energy_tolerance = 1e-12;

void ask(const Evidence& e, Examined& out) {
  for (const Law& law : always) out.laws.push_back({law.name, law.used(e)});
  if (!e.walk) return;
  for (const Law& law : of_a_run) out.laws.push_back({law.name, law.used(e)});
  if (e.walk->segments == 0) return;  // a fault at the start leaves no segment to check
  for (const auto& used : e.walk->laws.used(energy_tolerance)) out.laws.push_back({used.law, used.part});
}

void keep_words(const base::Problems& problems, Examined& out) {
  for (const base::Problem& p : problems) out.words += to_string(p) + "\n";
}

std::string kind_of(const Scenario& s) {
  const bool sensed = s.sensors.currents != rig::CurrentMeasurement::ideal ||
                      s.sensors.bus != BusSensing::ideal || s.sensors.rotor != RotorSensing::ideal;
  const std::string firmware = s.control.drive == FirmwareKind::product      ? "product"
                               : s.control.drive == FirmwareKind::sensorless ? "sensorless"
                               : s.control.drive == FirmwareKind::field      ? "field-oriented"
                               : sensed                                      ? "sensed"
                                                                             : "lean";
  return firmware + ", " + std::string(base::word(arithmetic_choices, s.control.arithmetic));
}

/// Returns the key "control.arithmetic" of the text "drawn.toml:3:1: control.arithmetic".
std::string key_of(const base::Problems& problems) {
  if (problems.empty()) return "";
  const std::string& where = problems[0].where;
  const std::size_t colon = where.rfind(": ");
  return colon == std::string::npos ? where : where.substr(colon + 2);
}

bool strayed_compiles(const Scenario& s) {
  for (const std::uint64_t drive : {0, 1, 2})
    if (!s.spread.empty() && !compile(varied(s, 1, drive))) return false;
  return true;
}

bool clamps(const Scenario& s) {
  return std::any_of(s.at.begin(), s.at.end(), [](const At& at) { return at.load.locked.has_value(); });
}

bool shorts(const Scenario& s) {
  return std::any_of(s.at.begin(), s.at.end(),
                     [](const At& at) { return at.bridge.shorted_switch != Switch::none; });
}

bool breaks_hall(const Scenario& s) {
  bool breaks = s.sensors.hall_break.at_s.has_value() || s.sensors.hall_glitches_Hz > 0;
  for (const At& at : s.at) breaks = breaks || at.sensors.hall_break.has_value();
  return breaks;
}

void keep_strange_figures(const Outcome& outcome, Examined& out) {
  for (const Verdict& v : outcome.verdicts)
    if (v.ok && !is_figure(v)) out.words += v.figure + " = " + written(v.measured) + "\n";
}

std::string end_of(const Outcome& o) {
  return o.trip ? "tripped" : o.fault ? "stopped by a fault" : "to its end";
}

void refuse(const base::Problems& problems, double began_s, Examined& out) {
  out.refused_at = key_of(problems);
  keep_words(problems, out);
  ask({.examined = out, .problems = problems, .seconds = cpu_s() - began_s}, out);
}

Listeners all_ears(Rows& rows, control::Mode mode) {
  return {.on_record = [](Row) {},
          .on_event = [&rows, mode](Row row) { rows.take(row, mode); },
          .on_logic = [](std::int64_t, std::span<const std::uint32_t>) {}};
}

}  // namespace

std::string drawn_text(std::uint64_t seed) { return drawn_scenario(seed).text; }
std::string hostile_text(std::uint64_t seed) { return broken_text(seed).text; }

/// Returns whether the read scenario is equal to the random scenario; of the sheet, only the random values
/// are compared. The text that is written from it must also give the same scenario.
bool reads_back(const Scenario& read, const Scenario& drawn) {
  Scenario plain = read;
  plain.sheet = drawn.sheet;
  plain.motor_sheet = drawn.motor_sheet;
  const design::Sheet &a = read.sheet, &b = drawn.sheet;
  const bool same_sheet = a.resistance_ohm->value == b.resistance_ohm->value &&
                          a.cogging_mNm == b.cogging_mNm && a.harmonic_sizes == b.harmonic_sizes &&
                          a.phase_resistance_deviation == b.phase_resistance_deviation;
  const std::string written = text::scenario_text(read);
  const auto again = files::read_scenario_text(beside_scenarios("drawn.toml"), written);
  return same_sheet && text::scenario_text(plain) == text::scenario_text(drawn) && again &&
         text::scenario_text(*again) == written &&
         again->sheet.resistance_ohm->value == read.sheet.resistance_ohm->value;
}

Examined examine_drawn(std::uint64_t seed) {
  const double began_s = cpu_s();
  const DrawnScenario drawn = drawn_scenario(seed);
  Examined out;
  out.kind = kind_of(drawn.scenario);
  const auto scenario = files::read_scenario_text(beside_scenarios("drawn.toml"), drawn.text);
  if (!scenario) {
    refuse(scenario.problems(), began_s, out);
    return out;
  }
  const auto outcome = run(*scenario);
  const auto compiled = compile(*scenario);
  if (!outcome || !compiled) {
    refuse(outcome ? compiled.problems() : outcome.problems(), began_s, out);
    return out;
  }
  out.accepted = true;
  out.ended = end_of(*outcome);
  Rows rows;
  const auto watched = run(*scenario, all_ears(rows, scenario->control.mode));
  const Walk walked = walk(*scenario, *compiled,
                           {.snapshot_every = 1 + static_cast<std::int64_t>(seed % 60), .most_snapshots = 2});
  const base::Problems& problems = watched ? base::Problems{} : watched.problems();
  keep_words(problems, out);
  keep_strange_figures(*outcome, out);
  ask({.examined = out,
       .problems = problems,
       .outcome = &*outcome,
       .watched = watched ? &*watched : &*outcome,
       .rows = &rows,
       .walk = &walked,
       .read_back_equal = reads_back(*scenario, drawn.scenario),
       .breaks_a_hall_line = breaks_hall(*scenario),
       .clamps = clamps(*scenario),
       .shorts = shorts(*scenario),
       .strayed_compiles = strayed_compiles(*scenario),
       .seconds = cpu_s() - began_s},
      out);
  return out;
}

Examined examine_hostile(std::uint64_t seed) {
  const double began_s = cpu_s();
  const BrokenText broken = broken_text(seed);
  Examined out;
  out.kind = broken.kind;
  const auto scenario = files::read_scenario_text(beside_scenarios("hostile.toml"), broken.text);
  if (!scenario) {
    refuse(scenario.problems(), began_s, out);
    return out;
  }
  Rows rows;
  std::int64_t looks = 0;
  Listeners ears = all_ears(rows, scenario->control.mode);
  ears.on_record = nullptr;  // recording a grid of nanoseconds over hours would take hours
  ears.keep_going = [&looks](double) { return ++looks < hostile_looks; };
  const auto outcome = run(*scenario, ears);
  if (!outcome) {
    refuse(outcome.problems(), began_s, out);
    return out;
  }
  out.accepted = true;
  out.ended = cut_short(*scenario, *outcome) ? "cut" : end_of(*outcome);
  keep_strange_figures(*outcome, out);
  ask({.examined = out,
       .problems = {},
       .outcome = &*outcome,
       .rows = &rows,
       .shorts = shorts(*scenario),
       .seconds = cpu_s() - began_s},
      out);
  return out;
}

}  // namespace sixstep::testing
