// SPDX-License-Identifier: Apache-2.0
#include "text/results/bode_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/describe.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/escape/json_text.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

using analysis::BodeStudy;
using analysis::LoopPoint;
using Json = nlohmann::ordered_json;

constexpr double degrees_per_rad = 180 / sixstep::base::pi;

/// Level and phase of a spectral line without a response.
constexpr double no_level = std::numeric_limits<double>::quiet_NaN();
double dB(double gain) { return gain > 0.0 ? 20 * std::log10(gain) : no_level; }
double degrees(const LoopPoint& p) { return p.gain > 0.0 ? p.phase_rad * degrees_per_rad : no_level; }

const char* setpoint_unit(const BodeStudy& s) {
  return s.mode == sixstep::control::Mode::current ? "A"
         : s.mode == sixstep::control::Mode::speed ? "rad/s"
                                                   : "deg";
}

/// The designed loop gain L at the frequency of a point.
struct Designed {
  double gain_dB = 0.0, phase_deg = 0.0;
};
std::optional<Designed> designed_at(const BodeStudy& s, const LoopPoint& p) {
  const auto L = s.designed_at(p.w_rad_s);
  if (!L) return std::nullopt;
  const auto k = static_cast<std::size_t>(&p - s.points.data());
  return Designed{dB(L->size()), s.designed_phase_rad[k] * degrees_per_rad};
}

/// Deviations in gain and phase above which two loops differ. Only points whose gain is at most
/// near_crossover_dB away from 1 are compared, because the margins depend on them.
constexpr double far_dB = 1.5, far_deg = 8.0, near_crossover_dB = 20.0;

/// Fraction of samples without current that commutation alone can cause; a larger fraction has another
/// reason.
constexpr double least_without_current = 0.01;

/// The first applicable reason why measured and designed loop differ.
std::string why_beside(const BodeStudy& s) {
  const study::Scenario& end = s.at_end;
  const bool hall =
      end.sensors.rotor == study::RotorSensing::hall && end.control.drive != study::FirmwareKind::sensorless;
  if (hall && s.mode == sixstep::control::Mode::position)
    return fmt::format(
        "Hall probes resolve the position only in steps of {}, and near standstill their edges are too rare to measure a speed. Set sensors.rotor = \"ideal\" to see the loop without probes, or use an encoder with pwm.commutation = \"sample\"",
        quantity_text(60 / s.pole_pairs, "deg", 3));
  const bool one_way = end.pwm.chopping != sixstep::control::Chopping::complementary &&
                       !end.control.smooth_chopping.on && end.control.drive != study::FirmwareKind::field;
  if (one_way && s.without_current > least_without_current)
    return fmt::format(
        "with this chopping the current cannot reverse, and the current is zero at {:.2g} % of the samples. So rising and falling steps have different responses; set pwm.chopping = \"complementary\", with which the current can reverse",
        100 * s.without_current);
  return "the response is not linear, because of commutation, dead time, discontinuous current or a limit";
}

/// Compares measured and designed loop. A coherence near 1 shows that the responses repeat, but not that the
/// loop is linear.
std::string beside_the_designed(const BodeStudy& s) {
  double most_dB = 0.0, deg = 0.0, Hz = 0.0;
  for (const LoopPoint& p : s.points) {
    const auto d = designed_at(s, p);
    if (!d || p.coherence < analysis::little_coherence || std::fabs(dB(p.gain)) > near_crossover_dB) continue;
    const double off_dB = dB(p.gain) - d->gain_dB, off_deg = p.phase_rad * degrees_per_rad - d->phase_deg;
    if (std::fabs(off_dB) < far_dB && std::fabs(off_deg) < far_deg) continue;
    if (Hz > 0.0 && std::fabs(off_dB) <= std::fabs(most_dB)) continue;
    most_dB = off_dB;
    deg = off_deg;
    Hz = p.w_rad_s / sixstep::base::turn_rad;
  }
  if (Hz == 0.0) return "";
  return fmt::format("at {:.3g} Hz the loop differs by {:+.2g} dB and {:+.2g} deg from the designed loop: {}",
                     Hz, most_dB, deg, why_beside(s));
}

std::string gain_margin(const std::optional<double>& gain) {
  return gain && std::isfinite(dB(*gain)) ? fmt::format("{:.1f} dB", dB(*gain)) : "-";
}

Json times(const std::optional<double>& x, double factor) { return x ? finite(*x * factor) : Json(nullptr); }

Json margins_json(const std::optional<double>& crossover, const std::optional<double>& phase,
                  const std::optional<double>& gain, const std::optional<double>& delay,
                  const std::optional<double>& bandwidth) {
  return {{"crossover_Hz", times(crossover, 1 / sixstep::base::turn_rad)},
          {"phase_margin_deg", times(phase, degrees_per_rad)},
          {"gain_margin", or_null(gain)},
          {"delay_margin_s", or_null(delay)},
          {"bandwidth_Hz", times(bandwidth, 1 / sixstep::base::turn_rad)}};
}

}  // namespace

std::vector<BodeMargin> bode_margins(const BodeStudy& s) {
  const analysis::ReadMargins& m = s.measured;
  const design::LoopFigures f = s.figures.value_or(design::LoopFigures{});
  const auto row = [](const char* name, const std::optional<double>& is, const std::optional<double>& was,
                      double factor, const char* unit) {
    const auto in_unit = [&](const std::optional<double>& x) {
      return x ? quantity_text(*x * factor, unit, 4) : "-";
    };
    return BodeMargin{name, in_unit(is), in_unit(was)};
  };
  return {row("crossover", m.crossover_rad_s, f.crossover_rad_s, 1 / sixstep::base::turn_rad, "Hz"),
          row("phase margin", m.phase_rad, f.phase_rad, degrees_per_rad, "deg"),
          {"gain margin", gain_margin(m.gain), gain_margin(f.gain)},
          row("delay margin", m.delay_s, f.delay_s, 1.0, "s"),
          row("bandwidth, closed", m.bandwidth_rad_s, f.bandwidth_rad_s, 1 / sixstep::base::turn_rad, "Hz")};
}

std::string bode_place(const BodeStudy& s) {
  return fmt::format("{} around {}, +-{}", sixstep::base::word(study::mode_choices, s.mode),
                     quantity_text(s.stands_at, setpoint_unit(s)),
                     quantity_text(s.amplitude, setpoint_unit(s)));
}

std::vector<std::string> bode_notes(const BodeStudy& s) {
  std::vector<std::string> notes;
  if (!s.not_linear.empty())
    notes.push_back("no linear loop can be compared with the measurement: " + s.not_linear);
  const auto few = std::count_if(s.points.begin(), s.points.end(),
                                 [](const LoopPoint& p) { return p.coherence < analysis::little_coherence; });
  const bool sensorless = s.at_end.control.drive == study::FirmwareKind::sensorless;
  if (!analysis::answered(s.points))
    notes.push_back(fmt::format(
        "NOTHING WAS MEASURED: no line reaches a coherence of {:g}, because commutation, ripple or noise exceeds the response. Give a larger --amplitude, or set load.locked = true, which avoids commutations. If the drive stopped, a run without --bode shows the reason",
        analysis::little_coherence));
  else if (few > 0)
    notes.push_back(fmt::format(
        "{} of {} lines have a coherence below {:g}, because commutation, ripple or noise exceeds their response; give a larger --amplitude",
        few, s.points.size(), analysis::little_coherence));
  if (s.lag)
    notes.push_back(fmt::format(
        "the loop includes the delay of {}: at this speed the measured speed is {} late{}",
        sensorless ? "the back-EMF's zero crossings" : "the sensor", quantity_text(s.lag->delay_s(), "s", 3),
        sensorless ? "" : "; set sensors.rotor = \"ideal\" to see the loop without this delay"));
  if (std::string told = beside_the_designed(s); !told.empty()) notes.push_back(std::move(told));
  if (std::isfinite(s.beside))
    notes.push_back(
        fmt::format("{:.2g} % of the response's rms is at frequencies that the multisine does not contain",
                    100 * s.beside));
  return notes;
}

std::string bode_text(std::string_view name, const BodeStudy& s) {
  std::string text = fmt::format("{}: {}\n", visible(std::string(name)), bode_place(s));
  const bool both = s.designed.has_value();
  text += fmt::format("  {:>10}  {:>9}  {:>8}  {:>9}{}\n", "Hz", "|L|, dB", "phase", "coherence",
                      both ? fmt::format("  {:>12}  {:>8}", "designed, dB", "phase") : "");
  for (const LoopPoint& p : s.points) {
    text += fmt::format("  {:>10.5g}  {:>9}  {:>8}  {:>9}", p.w_rad_s / sixstep::base::turn_rad,
                        fixed_text(dB(p.gain), 2), fixed_text(degrees(p), 1), fixed_text(p.coherence, 4));
    if (const auto d = designed_at(s, p))
      text += fmt::format("  {:>12}  {:>8}", fixed_text(d->gain_dB, 2), fixed_text(d->phase_deg, 1));
    text += "\n";
  }
  text += fmt::format("  {:<20}{:>14}{}\n", "", "measured", both ? fmt::format("{:>14}", "designed") : "");
  for (const BodeMargin& m : bode_margins(s))
    text +=
        fmt::format("  {:<20}{:>14}{}\n", m.name, m.measured, both ? fmt::format("{:>14}", m.designed) : "");
  for (const std::string& note : bode_notes(s)) text += "  " + note + "\n";
  return text;
}

std::string bode_csv(const BodeStudy& s) {
  std::string text = "frequency_Hz,gain_dB,phase_deg,coherence,closed_gain_dB,scatter";
  text += s.designed ? ",designed_gain_dB,designed_phase_deg\n" : "\n";
  for (const LoopPoint& p : s.points) {
    std::vector<double> cells{p.w_rad_s / sixstep::base::turn_rad,
                              dB(p.gain),
                              degrees(p),
                              p.coherence,
                              dB(p.closed.size()),
                              p.scatter};
    const auto d = designed_at(s, p);
    if (d) cells.insert(cells.end(), {d->gain_dB, d->phase_deg});
    for (std::size_t n = 0; n < cells.size(); ++n) text += (n > 0 ? "," : "") + csv_cell(cells[n]);
    if (s.designed && !d) text += ",,";
    text += "\n";
  }
  return text;
}

std::string bode_json(std::string_view name, const BodeStudy& s) {
  Json json = {{"sixstep", SIXSTEP_VERSION},
               {"scenario", name},
               {"mode", sixstep::base::word(study::mode_choices, s.mode)},
               {"stands_at", s.stands_at},
               {"amplitude", s.amplitude},
               {"unit", setpoint_unit(s)},
               {"samples", s.signal.samples},
               {"sample_s", s.period_s},
               {"beside", finite(s.beside)},
               {"answered", analysis::answered(s.points)}};
  const analysis::ReadMargins& m = s.measured;
  json["measured"] = margins_json(m.crossover_rad_s, m.phase_rad, m.gain, m.delay_s, m.bandwidth_rad_s);
  if (s.figures)
    json["designed"] = margins_json(s.figures->crossover_rad_s, s.figures->phase_rad, s.figures->gain,
                                    s.figures->delay_s, s.figures->bandwidth_rad_s);
  if (!s.not_linear.empty()) json["not_linear"] = s.not_linear;
  for (const LoopPoint& p : s.points) {
    Json point = {{"frequency_Hz", p.w_rad_s / sixstep::base::turn_rad},
                  {"gain_dB", finite(dB(p.gain))},
                  {"phase_deg", finite(degrees(p))},
                  {"coherence", finite(p.coherence)},
                  {"scatter", finite(p.scatter)},
                  {"closed_re", finite(p.closed.re)},
                  {"closed_im", finite(p.closed.im)}};
    if (const auto d = designed_at(s, p)) {
      point["designed_gain_dB"] = finite(d->gain_dB);
      point["designed_phase_deg"] = finite(d->phase_deg);
    }
    json["points"].push_back(std::move(point));
  }
  return json_text(json) + "\n";
}

}  // namespace text
