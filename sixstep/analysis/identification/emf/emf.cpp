// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/emf.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/analysis/identification/built_machines.hpp"
#include "sixstep/analysis/identification/distributions.hpp"
#include "sixstep/analysis/identification/emf/emf_doubts.hpp"
#include "sixstep/analysis/identification/emf/emf_shape.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/shape_factors.hpp"

namespace sixstep::analysis {
namespace {

double size_of(const Harmonic& h) { return std::sqrt(h.a_V * h.a_V + h.b_V * h.b_V); }
/// The angle with a cos x + b sin x = size cos(x + angle).
double angle_of(const Harmonic& h) { return base::atan2(-h.b_V, h.a_V); }

/// The channel's harmonics relative to the fundamental, with the fundamental's peak at angle 0.
ShapeHarmonics seen_by(const ChannelFit& channel) {
  ShapeHarmonics out;
  out.resize(channel.harmonics.size());
  const double size = size_of(channel.harmonics[0]), angle = angle_of(channel.harmonics[0]);
  for (std::size_t n = 0; n < out.size(); ++n) {
    const base::SinCos back = base::sin_cos(-static_cast<double>(n + 1) * angle);
    const double re = channel.harmonics[n].a_V / size, im = -channel.harmonics[n].b_V / size;
    out.re[n] = re * back.cos - im * back.sin;
    out.im[n] = re * back.sin + im * back.cos;
  }
  return out;
}

/// Lag of the channel behind the first channel, in [0, 360).
double lag_deg(const HarmonicFit& fit, std::size_t channel) {
  const double lag = (angle_of(fit.channels[0].harmonics[0]) - angle_of(fit.channels[channel].harmonics[0])) /
                     base::rad_per_deg;
  return lag - 360.0 * std::floor(lag / 360.0);
}

/// Finds the order in which the channels follow each other. Returns a Problem if they are not three phases.
base::Problems direction(const EmfRequest& request, const HarmonicFit& fit, EmfResult& out) {
  constexpr double near_deg = 10.0;
  out.all_phases = fit.channels.size() > 1;
  for (std::size_t c = 1; c < fit.channels.size(); ++c) {
    const double lag = lag_deg(fit, c), forward = 120.0 * static_cast<double>(c), backward = 360.0 - forward;
    const bool is_forward = std::fabs(lag - forward) < near_deg,
               is_backward = std::fabs(lag - backward) < near_deg;
    if (c == 1) out.backward = is_backward;
    if ((is_forward && !out.backward) || (is_backward && out.backward)) continue;
    return {
        {.where = request.record.channels[c].name,
         .value = base::rounded(lag, 4) + " deg behind " + request.record.channels[0].name,
         .limit = "is neither 120 nor 240 deg, the lags of three phases",
         .cure =
             "name voltages of the same kind in the order of the phases; at 60 or 300 deg, reverse the leads of one probe"}};
  }
  return {};
}

/// The largest number of successive rows at the greatest or the least value, as a fraction of the period.
double clipped_part(const std::vector<double>& u, double rows_per_period) {
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  std::size_t longest = 0, run = 0;
  for (std::size_t n = 0; n < u.size(); ++n) {
    const bool extreme = u[n] == *low || u[n] == *high;
    run = !extreme ? 0 : n > 0 && u[n] == u[n - 1] ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  return static_cast<double>(longest) / rows_per_period;
}

void take_channels(const EmfRequest& request, const HarmonicFit& fit, EmfResult& out) {
  const double rows_per_period = static_cast<double>(out.rows) / fit.periods;
  for (std::size_t c = 0; c < fit.channels.size(); ++c) {
    const ChannelFit& of_c = fit.channels[c];
    const Harmonic &first = of_c.harmonics[0], &reference = fit.channels[0].harmonics[0];
    const double student = student_95(first.degrees_of_freedom);
    const double here = first.deviation_V / size_of(first),
                 there = reference.deviation_V / size_of(reference);
    const double lag_width =
        c == 0 ? 0.0 : student * std::sqrt(here * here + there * there) / base::rad_per_deg;
    const std::vector<double>& u = request.record.channels[c].u_V;
    out.channels.push_back({request.record.channels[c].name, of_c.offset_V,
                            around(size_of(first), student * first.deviation_V),
                            around(c == 0 ? 0.0 : lag_deg(fit, c), lag_width), of_c.residual_rms_V,
                            of_c.step_V, clipped_part(u, rows_per_period)});
  }
}

/// True if a harmonic of this order is equal in all phases: it then cancels between two phases.
bool is_common(int order, const EmfResult& result) {
  return order % 3 == 0 && result.between == EmfBetween::lines;
}

/// The phase's shape as the mean over the channels, with the deviation of each harmonic.
struct MeanShape {
  ShapeHarmonics phase;
  std::vector<double> deviation;  ///< standard deviations of the coordinates of each harmonic
  std::vector<double> degrees_of_freedom;
};
MeanShape mean_shape(const HarmonicFit& fit, const EmfResult& so_far) {
  const std::size_t harmonics = fit.channels[0].harmonics.size();
  const auto channels = static_cast<double>(fit.channels.size());
  MeanShape out;
  out.phase.resize(harmonics);
  out.phase.re[0] = 0.0;
  out.deviation.resize(harmonics);
  for (const ChannelFit& c : fit.channels) {
    ShapeHarmonics seen = seen_by(c);
    if (so_far.backward) seen = seen_backward(std::move(seen));
    const ShapeHarmonics phase = so_far.between == EmfBetween::lines ? phase_of_line(seen) : seen;
    for (std::size_t n = 0; n < harmonics; ++n) {
      const ShapeHarmonics& from = is_common(static_cast<int>(n) + 1, so_far) ? seen : phase;
      out.phase.re[n] += from.re[n] / channels;
      out.phase.im[n] += from.im[n] / channels;
      const double part = c.harmonics[n].deviation_V / size_of(c.harmonics[0]) / channels;
      out.deviation[n] += part * part;
    }
  }
  for (double& d : out.deviation) d = std::sqrt(d);
  for (const Harmonic& h : fit.channels[0].harmonics)
    out.degrees_of_freedom.push_back(h.degrees_of_freedom * channels);
  return out;
}

/// Adds all harmonics to the result. The shape keeps only the harmonics above the noise.
void take_harmonics(MeanShape& mean, EmfResult& out) {
  constexpr double one_in_twenty = 0.05;
  const double noise =
      std::sqrt(-2.0 * base::log(one_in_twenty / static_cast<double>(mean.phase.size() - 1)));
  for (std::size_t n = 1; n < mean.phase.size(); ++n) {
    const int order = static_cast<int>(n) + 1;
    double &re = mean.phase.re[n], &im = mean.phase.im[n];
    const double length = std::sqrt(re * re + im * im), deviation = mean.deviation[n];
    EmfHarmonic h;
    h.order = order;
    h.part = length_95(length, deviation, mean.degrees_of_freedom[n]);
    h.floor = noise * deviation * student_95(mean.degrees_of_freedom[n]) / student_95(1e9);
    h.stands_out = length > h.floor;
    h.in_phase = re;
    h.across = -im;
    out.harmonics.push_back(h);
    if (!h.stands_out || is_common(order, out)) re = im = 0.0;
  }
}

/// Uncertainty of a constant that is the fundamental times a figure of the shape. The uncertainties of the
/// shape's harmonics and of the fundamental add.
struct Doubt {
  double fundamental = 0.0;  ///< relative standard deviation
  double shape = 0.0;        ///< absolute standard deviation of a value of the shape
  double student = 0.0;
  Interval of(double size, double figure, double shape_part) const {
    const double relative =
        std::sqrt(fundamental * fundamental + shape_part * shape_part * shape * shape / (figure * figure));
    return around(size * figure, size * figure * student * relative);
  }
};

void take_constants(const HarmonicFit& fit, const MeanShape& mean, EmfResult& out) {
  const double root3 = std::sqrt(3.0), w = fit.phase.rate[0],
               channels = static_cast<double>(fit.channels.size());
  double size = 0.0, square = 0.0, shape2 = 0.0;
  for (const ChannelFit& c : fit.channels) {
    size += size_of(c.harmonics[0]) / w / channels;
    square += c.harmonics[0].deviation_V * c.harmonics[0].deviation_V / (w * w * channels * channels);
    const double stepped = c.step_at_peak_V / size_of(c.harmonics[0]) / channels;
    shape2 += stepped * stepped;
  }
  Doubt doubt{std::sqrt(square / (size * size) + fit.speed_deviation * fit.speed_deviation / (w * w)), 0.0,
              student_95(fit.degrees_of_freedom * channels)};
  for (std::size_t n = 1; n < mean.phase.size(); ++n)
    if (mean.phase.re[n] != 0.0 || mean.phase.im[n] != 0.0) shape2 += mean.deviation[n] * mean.deviation[n];
  doubt.shape = std::sqrt(shape2);
  const double phase = out.between == EmfBetween::lines ? size / root3 : size, line = phase * root3;
  const ShapeHarmonics between = line_of_phase(mean.phase);
  EmfConstants& k = out.constants;
  // Harmonics that are small compared with the fundamental hardly change an rms value.
  const auto peak = [&doubt](double fundamental, const ShapeHarmonics& shape) {
    const WavePeak wave = wave_peak(shape);
    Interval out_of = doubt.of(fundamental, wave.peak.value, 1.0);
    out_of.low -= fundamental * wave.below;
    out_of.high += fundamental * wave.above;
    return out_of;
  };
  k.line_peak = peak(line, between);
  k.line_rms = doubt.of(line, between.rms(), 0.0);
  k.line_fundamental = doubt.of(line, 1.0, 0.0);
  k.phase_peak = peak(phase, mean.phase);
  k.phase_rms = doubt.of(phase, mean.phase.rms(), 0.0);
  k.phase_fundamental = doubt.of(phase, 1.0, 0.0);
  const ShapeHarmonics& probed = out.between == EmfBetween::lines ? between : mean.phase;
  const ShapePeak top = wave_peak(probed).peak;
  out.crest = top.value / probed.rms();
  out.flat_deg = top.flat_deg;
}

struct ShapeTable {
  std::vector<double> angle_deg, shape;
  double sector_mean() const { return design::table_factors(angle_deg, shape).sector_mean; }
};

ShapeTable table_of(const ShapeHarmonics& phase, double peak, int per_degree, int step) {
  ShapeTable out;
  for (int n = 0; n < 360 * per_degree; n += step) {
    const double deg = static_cast<double>(n) / per_degree;
    out.angle_deg.push_back(deg);
    out.shape.push_back(phase.at((deg - 60) * base::rad_per_deg) / peak);
  }
  return out;
}

void take_table(const ShapeHarmonics& phase, EmfResult& out) {
  const double peak = peak_of(phase).value;
  ShapeTable table = table_of(phase, peak, 1, 2);
  out.angle_deg = std::move(table.angle_deg);
  out.shape = std::move(table.shape);
  // The table of the shape has straight lines between two degrees, which reduce the mean of a round shape by
  // 1e-4. The error is proportional to the square of the step. Tables with two steps therefore allow its
  // elimination (Richardson).
  const double told = wave_peak(phase).peak.value;
  out.shape_sector_mean =
      (4 * table_of(phase, told, 2, 1).sector_mean() - table_of(phase, told, 1, 1).sector_mean()) / 3;
}

/// Computes the pole pairs, which must be a whole number, from the shaft's speed that the user measured.
base::Problems find_pole_pairs(const EmfRequest& request, const HarmonicFit& fit, EmfResult& out) {
  constexpr double rpm = 30.0 / base::pi, whole = 0.1;
  out.pole_pairs = request.pole_pairs.value_or(0);
  if (!request.speed_rad_s) return {};
  const double pairs = fit.phase.rate[0] / *request.speed_rad_s, nearest = std::floor(pairs + 0.5);
  const double wanted = request.pole_pairs ? *request.pole_pairs : nearest;
  const double relative = std::fabs(pairs / std::max(wanted, 1.0) - 1.0);
  const bool fits =
      request.pole_pairs ? relative < whole / 2.0 : nearest >= 1.0 && std::fabs(pairs - nearest) < whole;
  if (fits) {
    out.pole_pairs = static_cast<int>(wanted);
    return {};
  }
  return {
      {.where = "speed",
       .value = base::rounded(*request.speed_rad_s * rpm, 5) + " rpm",
       .limit = "with " + base::rounded(fit.phase.rate[0] / base::turn_rad, 5) + " Hz makes " +
                base::rounded(pairs, 4) + " pole pairs" +
                (request.pole_pairs ? ", not " + std::to_string(*request.pole_pairs) : ", no whole number"),
       .cure = request.pole_pairs ? "leave out the speed or the pole pairs: the value that is less certain"
                                  : "give the pole pairs instead of the speed"}};
}

}  // namespace

base::Result<EmfResult> measure_emf(const EmfRequest& request) {
  if (base::Problems wrong = check(request.record); !wrong.empty()) return wrong;
  const base::Result<EmfPhase> rough = rough_phase(request.record);
  if (!rough) return rough.problems();
  const base::Result<HarmonicFit> fit = fit_harmonics(request.record, *rough);
  if (!fit) return fit.problems();
  if (base::Problems noise = check_noise(request.record, *fit); !noise.empty()) return noise;
  if (fit->periods < least_periods)
    return base::Problem{.where = "time",
                         .limit = "contains " + base::rounded(fit->periods, 3) + " periods of the voltage; " +
                                  base::rounded(least_periods, 2) + " are needed",
                         .cure = "record for longer, or turn the motor faster"};
  EmfResult out;
  out.between = request.record.between;
  out.rows = request.record.t_s.size();
  out.seconds = request.record.t_s.back() - request.record.t_s.front();
  out.periods = fit->periods;
  out.frequency_Hz =
      scaled(around(fit->phase.rate[0], student_95(fit->degrees_of_freedom) * fit->speed_deviation),
             1.0 / base::turn_rad);
  out.change_Hz_s = fit->phase.rate[1] / base::turn_rad;
  base::Problems problems = direction(request, *fit, out);
  if (problems.empty()) problems = find_pole_pairs(request, *fit, out);
  if (problems.empty()) problems = check_built_speed(out.frequency_Hz.value, out.pole_pairs);
  if (!problems.empty()) return problems;
  take_channels(request, *fit, out);
  if (base::Problems clipped = check_clipped(request.record, out); !clipped.empty()) return clipped;
  if (base::Problems apart = check_alike(out); !apart.empty()) return apart;
  MeanShape mean = mean_shape(*fit, out);
  take_harmonics(mean, out);
  take_constants(*fit, mean, out);
  allow_for_clipping(out);
  allow_for_unlike_channels(out);
  problems = check_built_constant(out.constants.line_peak.value, out.frequency_Hz.value, out.pole_pairs);
  if (!problems.empty()) return problems;
  take_table(mean.phase, out);
  out.fit = *fit;
  return out;
}

}  // namespace sixstep::analysis
