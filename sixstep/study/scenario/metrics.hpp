// SPDX-License-Identifier: Apache-2.0
// The figures of merit: their words in files and in results, and their meanings.
#pragma once
#include <array>
#include <cstdint>
#include <iterator>
#include <string_view>

#include "sixstep/base/describe.hpp"

namespace sixstep::study {

/// Figures, each exact on the trajectory's polynomials (gauge.hpp and the other gauges).
enum class MetricKind : std::uint8_t {
  final_value,
  mean,
  rms,
  maximum,
  minimum,
  peak_to_peak,
  ripple_rms,
  overshoot,
  reach_time,
  rise_time,
  settling_time,
  steady_error,
  largest_error,
  thd,
  energy,
  efficiency,
  band_excess,
  band_deficit,
  switching_frequency,
  switching_loss,
  commutation_error,
  commutation_error_rms
};

/// The quantity from which a figure is computed.
enum class TakenOf : std::uint8_t {
  signal,
  fundamental,
  power,
  energies,
  band,
  switching,
  transitions,
  commutations
};

/// The intervals of a figure within its window if no level is given: the whole window, each step of the
/// reference, or each level of the reference. The worst interval counts.
enum class TakenOver : std::uint8_t { window, steps, levels };

/// One row per figure. `phrase` precedes the signal's phrase: "mean line voltage a to b". An empty unit means
/// the signal's unit.
struct MetricFact {
  MetricKind kind;
  std::string_view word;
  std::string_view phrase;
  std::string_view unit;
  std::string_view meaning;
  TakenOf of = TakenOf::signal;
  TakenOver over = TakenOver::window;
};

inline constexpr MetricFact metric_facts[] = {
    {MetricKind::final_value, "final", "final", "", "value at the end of the window"},
    {MetricKind::mean, "mean", "mean", "", "mean over the window"},
    {MetricKind::rms, "rms", "rms", "", "root mean square (rms) over the window"},
    {MetricKind::maximum, "max", "maximum of", "", "largest value in the window"},
    {MetricKind::minimum, "min", "minimum of", "", "smallest value in the window"},
    {MetricKind::peak_to_peak, "peak_to_peak", "peak-to-peak", "",
     "largest minus smallest value in the window: the ripple, peak to peak"},
    {MetricKind::ripple_rms, "ripple_rms", "rms ripple of", "", "rms of the signal minus its mean"},
    {MetricKind::overshoot, "overshoot", "overshoot of", "",
     "overshoot of the signal beyond level, in the signal's unit", TakenOf::signal, TakenOver::steps},
    {MetricKind::reach_time, "reach_time_s", "time to reach,", "s",
     "time until the signal first reaches start + fraction (level - start); without level: the longest time over all steps of the reference",
     TakenOf::signal, TakenOver::steps},
    {MetricKind::rise_time, "rise_time_s", "rise time of", "s",
     "time from 10 % to 90 % of the way from start to level; without level: the longest time over all steps of the reference",
     TakenOf::signal, TakenOver::steps},
    {MetricKind::settling_time, "settling_time_s", "settling time of", "s",
     "time of the last exit from level +- band |level - start|, counted from from_s; with sampled: time of the first sample after which all samples lie inside",
     TakenOf::signal, TakenOver::steps},
    {MetricKind::steady_error, "steady_error", "steady error of", "",
     "mean of level - signal; without level: of reference - signal at the end of each of the reference's "
     "levels, the largest by size",
     TakenOf::signal, TakenOver::levels},
    {MetricKind::largest_error, "largest_error", "largest error of", "",
     "largest distance of the signal from level: half width of the band that the signal keeps; without level as for "
     "steady_error",
     TakenOf::signal, TakenOver::levels},
    {MetricKind::thd, "thd", "THD of", "1",
     "total harmonic distortion: rms of everything except mean and fundamental, divided by the rms of the fundamental; measured over whole electrical turns, or whole periods of frequency_Hz",
     TakenOf::fundamental},
    {MetricKind::energy, "energy_J", "energy of", "J", "energy over the window of a power or a loss",
     TakenOf::power},
    {MetricKind::efficiency, "efficiency", "efficiency", "1",
     "energy given to load and inertia divided by energy taken from the bus; while braking the inverse ratio",
     TakenOf::energies},
    {MetricKind::band_excess, "band_excess_A", "excess above the band of", "A",
     "largest excess above the upper limit of the hysteresis band", TakenOf::band},
    {MetricKind::band_deficit, "band_deficit_A", "shortfall below the band of", "A",
     "largest shortfall below the lower limit, except from a sector edge or reference step until the current "
     "is back in the band",
     TakenOf::band},
    {MetricKind::switching_frequency, "switching_frequency_Hz", "switching frequency", "Hz",
     "turn-ons per second in the window: of the chopped switches, or of one switch with signal = \"gate_T1\"",
     TakenOf::switching},
    {MetricKind::switching_loss, "switching_loss_W", "switching loss", "W",
     "mean loss over the window by turn-on, turn-off and reverse recovery, from the bridge's energies",
     TakenOf::transitions},
    {MetricKind::commutation_error, "commutation_error_deg", "commutation error", "deg",
     "largest electrical angle between the change of the pair and the edge of its sector",
     TakenOf::commutations},
    {MetricKind::commutation_error_rms, "commutation_error_rms_deg", "rms commutation error", "deg",
     "rms, over all commutations in the window, of the electrical angle between the change of the pair and the edge of its sector",
     TakenOf::commutations},
};

inline constexpr auto metric_choices = [] {
  std::array<base::Choice<MetricKind>, std::size(metric_facts)> all{};
  std::size_t n = 0;
  for (const MetricFact& fact : metric_facts) all[n++] = {fact.word, fact.kind, fact.meaning};
  return all;
}();

constexpr const MetricFact& fact_of(MetricKind kind) { return metric_facts[static_cast<std::size_t>(kind)]; }

static_assert([] {
  for (std::size_t n = 0; n < std::size(metric_facts); ++n)
    if (static_cast<std::size_t>(metric_facts[n].kind) != n) return false;
  return std::size(metric_facts) == static_cast<std::size_t>(MetricKind::commutation_error_rms) + 1;
}());

/// True if the figure is computed for each step of the reference if no level is given.
constexpr bool is_of_a_step(MetricKind kind) { return fact_of(kind).over == TakenOver::steps; }
constexpr bool is_of_a_level(MetricKind kind) { return fact_of(kind).over == TakenOver::levels; }
/// True if the figure is a time. A time is infinite if its event never occurs.
constexpr bool is_time(MetricKind kind) { return fact_of(kind).unit == "s"; }

}  // namespace sixstep::study
