// SPDX-License-Identifier: Apache-2.0
// Figures by which controllers are compared. The [[compare]] list of the course's scenarios measures gauges,
// in this order. A figure of the table is a sum of gauges, in some cases minus another gauge. Examples: the
// bridge's loss is conduction plus switching; the dip at a commutation is mean torque minus least torque.
#pragma once
#include <array>
#include <iterator>
#include <string_view>

#include "sixstep/study/scenario/measure.hpp"

namespace sixstep::analysis {

/// Part of the course in which a gauge is measured.
enum class CoursePart : std::uint8_t { start, high, load_step, brake, slow };

struct ContestGauge {
  std::string_view label;  ///< name in the scenario's [[compare]]
  study::MetricKind metric;
  study::Signal signal;
  CoursePart part;
};

/// Indices of contest_gauges.
enum class Gauge : std::uint8_t {
  start_settles,
  start_overshoot,
  start_peak,
  mean_torque,
  least_torque,
  ripple_rms,
  ripple_peak,
  distortion,
  copper,
  conduction,
  switching,
  turn_ons,
  load_error,
  load_settles,
  brake_peak,
  slow_ripple,
  slow_swing,
  none
};

using study::MetricKind;
using study::Signal;

inline constexpr ContestGauge contest_gauges[] = {
    {"settling of the start", MetricKind::settling_time, Signal::speed, CoursePart::start},
    {"overshoot of the start", MetricKind::overshoot, Signal::speed, CoursePart::start},
    {"peak current of the start", MetricKind::maximum, Signal::current_magnitude, CoursePart::start},
    {"mean torque", MetricKind::mean, Signal::torque, CoursePart::high},
    {"least torque", MetricKind::minimum, Signal::torque, CoursePart::high},
    {"torque ripple, rms", MetricKind::ripple_rms, Signal::torque, CoursePart::high},
    {"torque ripple, peak to peak", MetricKind::peak_to_peak, Signal::torque, CoursePart::high},
    {"distortion of a phase's current", MetricKind::thd, Signal::phase_a, CoursePart::high},
    {"copper loss", MetricKind::mean, Signal::copper_loss, CoursePart::high},
    {"conduction loss", MetricKind::mean, Signal::device_loss, CoursePart::high},
    {"switching loss", MetricKind::switching_loss, Signal::current, CoursePart::high},
    {"turn-ons of a switch", MetricKind::switching_frequency, Signal::gate_T1, CoursePart::high},
    {"largest error after the load step", MetricKind::largest_error, Signal::speed, CoursePart::load_step},
    {"settling of the load step", MetricKind::settling_time, Signal::speed, CoursePart::load_step},
    {"peak current of the deceleration", MetricKind::maximum, Signal::current_magnitude, CoursePart::brake},
    {"torque ripple at the low speed, rms", MetricKind::ripple_rms, Signal::torque, CoursePart::slow},
    {"swing of the low speed", MetricKind::peak_to_peak, Signal::speed, CoursePart::slow},
};

/// Group of the table in which a figure is shown: transients or steady state.
enum class ContestGroup : std::uint8_t { moving, steady };

struct ContestFigure {
  std::string_view name;    ///< heading of the column
  std::string_view phrase;  ///< name within a sentence
  std::string_view unit;
  ContestGroup group;
  std::array<Gauge, 3> sum;
  Gauge less = Gauge::none;
};

/// The compared figures. A smaller value is better for all of them.
inline constexpr ContestFigure contest_figures[] = {
    {"settles",
     "settling after the start",
     "s",
     ContestGroup::moving,
     {Gauge::start_settles, Gauge::none, Gauge::none}},
    {"overshoot",
     "overshoot of the start",
     "rad/s",
     ContestGroup::moving,
     {Gauge::start_overshoot, Gauge::none, Gauge::none}},
    {"peak",
     "peak current of the start",
     "A",
     ContestGroup::moving,
     {Gauge::start_peak, Gauge::none, Gauge::none}},
    {"load error",
     "error after the load step",
     "rad/s",
     ContestGroup::moving,
     {Gauge::load_error, Gauge::none, Gauge::none}},
    {"load settles",
     "settling after the load step",
     "s",
     ContestGroup::moving,
     {Gauge::load_settles, Gauge::none, Gauge::none}},
    {"brake peak",
     "peak current of the deceleration",
     "A",
     ContestGroup::moving,
     {Gauge::brake_peak, Gauge::none, Gauge::none}},
    {"slow swing",
     "swing of the low speed",
     "rad/s",
     ContestGroup::moving,
     {Gauge::slow_swing, Gauge::none, Gauge::none}},
    {"ripple rms",
     "rms torque ripple",
     "N m",
     ContestGroup::steady,
     {Gauge::ripple_rms, Gauge::none, Gauge::none}},
    {"ripple p-p",
     "peak-to-peak torque ripple",
     "N m",
     ContestGroup::steady,
     {Gauge::ripple_peak, Gauge::none, Gauge::none}},
    {"dip",
     "dip of the torque below its mean",
     "N m",
     ContestGroup::steady,
     {Gauge::mean_torque, Gauge::none, Gauge::none},
     Gauge::least_torque},
    {"THD",
     "distortion of the phase current",
     "1",
     ContestGroup::steady,
     {Gauge::distortion, Gauge::none, Gauge::none}},
    {"copper", "copper loss", "W", ContestGroup::steady, {Gauge::copper, Gauge::none, Gauge::none}},
    {"bridge", "bridge loss", "W", ContestGroup::steady, {Gauge::conduction, Gauge::switching, Gauge::none}},
    {"losses", "total loss", "W", ContestGroup::steady, {Gauge::copper, Gauge::conduction, Gauge::switching}},
    {"turn-ons",
     "turn-ons of a switch",
     "Hz",
     ContestGroup::steady,
     {Gauge::turn_ons, Gauge::none, Gauge::none}},
    {"slow ripple",
     "rms torque ripple at the low speed",
     "N m",
     ContestGroup::steady,
     {Gauge::slow_ripple, Gauge::none, Gauge::none}},
};

/// Indices in contest_figures, for rules and pictures.
inline constexpr std::size_t peak_figure = 2, ripple_figure = 7, loss_figure = 13;
static_assert(contest_figures[peak_figure].name == "peak" &&
              contest_figures[ripple_figure].name == "ripple rms" &&
              contest_figures[loss_figure].name == "losses");

/// GaugeValues has one value per gauge, ContestValues one per figure.
using GaugeValues = std::array<double, std::size(contest_gauges)>;
using ContestValues = std::array<double, std::size(contest_figures)>;

/// The figures of a run's gauges; NaN: a gauge has no value; infinite: the run never settles.
ContestValues contest_values_of(const GaugeValues& gauges);

}  // namespace sixstep::analysis
