// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/emf/emf_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

/// Height in V that an invisible clipping may have cut off. If all rows of a top lie within one step of the
/// converter, the height is up to this step. Noise increases it.
double hidden_V(const EmfChannelResult& channel) { return 2.0 * (channel.step_V + channel.residual_rms_V); }

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Distance of a row from the straight line between its neighbours, as the median of all rows that are not at
/// an extreme.
double bend_of_flanks(const std::vector<double>& t, const std::vector<double>& u) {
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  std::vector<double> bends;
  for (std::size_t n = 1; n + 1 < u.size(); ++n) {
    if (u[n] == *low || u[n] == *high || u[n - 1] == u[n] || u[n] == u[n + 1]) continue;
    const double part = (t[n] - t[n - 1]) / (t[n + 1] - t[n - 1]);
    bends.push_back(std::fabs(u[n] - u[n - 1] - part * (u[n + 1] - u[n - 1])));
  }
  return middle_of(std::move(bends));
}

/// A clipped top: successive rows at the extreme, of half width h. `near` and `far` are the voltage's mean
/// distances from the extreme: from h to 2 h and from 2 h to 3 h from the top's middle, on both sides.
struct Top {
  std::size_t from = 0, to = 0;
  double near = 0.0, far = 0.0;
};

/// The windows assume rows at equal intervals. Tops at the recording's ends are ignored.
std::optional<Top> measured_top(const std::vector<double>& u, std::size_t from, std::size_t to) {
  const std::size_t rows = to - from + 1, half = rows / 2;
  if (half == 0 || from < rows || to + rows >= u.size()) return {};
  Top top{from, to};
  for (std::size_t n = 0; n < half; ++n) {
    top.near += std::fabs(u[from] - u[from - 1 - n]) + std::fabs(u[from] - u[to + 1 + n]);
    top.far += std::fabs(u[from] - u[from - 1 - half - n]) + std::fabs(u[from] - u[to + 1 + half + n]);
  }
  top.near /= 2.0 * static_cast<double>(half);
  top.far /= 2.0 * static_cast<double>(half);
  return top;
}

/// The last row of a top that begins at `from`. Near the top's ends, a few rows differ by noise from the
/// extreme.
std::size_t end_of_top(const std::vector<double>& u, std::size_t from) {
  std::size_t end = from;
  for (std::size_t n = from + 1; n < u.size() && n - end <= std::max<std::size_t>(2, (end - from) / 4); ++n)
    if (u[n] == u[from]) end = n;
  return end;
}

/// True if all rows in the inner part of a top equal the extreme. A flat top without clipping has noise
/// there.
bool stands_still(const std::vector<double>& u, std::size_t from, std::size_t to) {
  const std::size_t edge = (to - from + 1) / 5;
  return std::all_of(u.begin() + static_cast<std::ptrdiff_t>(from + edge),
                     u.begin() + static_cast<std::ptrdiff_t>(to + 1 - edge),
                     [&](double x) { return x == u[from]; });
}

/// The constant tops at one extreme that are at least half as long as the longest top.
std::vector<Top> tops_at(const std::vector<double>& u, double extreme) {
  constexpr std::size_t fewest_rows = 8;
  std::vector<Top> all;
  std::size_t longest = 0;
  for (std::size_t n = 0; n < u.size(); ++n) {
    if (u[n] != extreme) continue;
    const std::size_t end = end_of_top(u, n), rows = end - n + 1;
    longest = std::max(longest, rows);
    if (rows >= fewest_rows && stands_still(u, n, end))
      if (const std::optional<Top> top = measured_top(u, n, end)) all.push_back(*top);
    n = end;
  }
  std::erase_if(all, [&](const Top& top) { return 2 * (top.to - top.from + 1) < longest; });
  return all;
}

/// Height V, in V, that clipping has cut off. The flanks beside the top are fitted by the parabola u = V - b
/// x^2: b h^2 = V, and `near` is 4/3 V. Returns 0 if the flanks are no parabola. The criterion is far/near:
/// - a parabola has 4, and a sine that has lost a fifth 3.4;
/// - straight flanks have 3 and less;
/// - a top that is flat without clipping and round at its ends has more than 4.
double lost_beyond(const std::vector<double>& u, double extreme, double periods) {
  constexpr double straight = 3.2, round = 4.6, near_of_lost = 4.0 / 3.0, most_periods = 0.6;
  std::vector<double> lost, bent;
  const std::vector<Top> tops = tops_at(u, extreme);
  // Clipping appears in every period. Hum moves a flat top within one step of the converter only in some
  // periods. Fewer flat tops per period than `most_periods` are therefore not caused by clipping.
  if (static_cast<double>(tops.size()) + 1.0 < most_periods * periods) return 0.0;
  for (const Top& top : tops) {
    lost.push_back(top.near / near_of_lost);
    bent.push_back(top.near > 0.0 ? top.far / top.near : 0.0);
  }
  const double ratio = middle_of(std::move(bent));
  return ratio > straight && ratio < round ? middle_of(std::move(lost)) : 0.0;
}

}  // namespace

base::Problem no_period(const std::vector<double>& t_s, const std::string& channel, std::size_t passed,
                        bool regular) {
  constexpr double much_longer = 10.0;
  std::vector<double> steps;
  for (std::size_t n = 1; n < t_s.size(); ++n) steps.push_back(t_s[n] - t_s[n - 1]);
  const auto longest = std::max_element(steps.begin(), steps.end());
  if (longest != steps.end() && *longest > much_longer * middle_of(steps)) {
    const auto row = static_cast<std::size_t>(longest - steps.begin());
    return {.where = "time",
            .value = base::six_digits(t_s[row]) + " s",
            .limit = "in row " + std::to_string(row + 1) + " is followed by a gap of " +
                     base::three_digits(*longest) + " s, and " + channel + " has no steady period",
            .cure = "use a part of the recording without a gap, at least one and a half periods long"};
  }
  if (!regular)
    return {
        .where = channel,
        .value = "",
        .limit =
            "has half waves of very different lengths: the signal is noise, or the motor's speed changes all the time",
        .cure = "check the probe's connection, and turn the motor at a constant speed during the recording"};
  return {.where = channel,
          .limit = "crosses its mean only " + std::to_string(passed) + (passed == 1 ? " time" : " times") +
                   "; one and a half periods are needed",
          .cure = "record for longer, or turn the motor faster"};
}

base::Problems check_noise(const EmfRecord& record, const HarmonicFit& fit) {
  for (std::size_t c = 0; c < fit.channels.size(); ++c) {
    const ChannelFit& channel = fit.channels[c];
    double squares = 0.0;
    for (const Harmonic& h : channel.harmonics) squares += 0.5 * (h.a_V * h.a_V + h.b_V * h.b_V);
    const double rms = std::sqrt(squares);
    if (channel.residual_rms_V < rms) continue;
    return {
        {.where = record.channels[c].name,
         .value = "",
         .limit = "is noise: " + base::three_digits(rms) + " V rms repeat at " +
                  base::three_digits(fit.phase.rate[0] / base::turn_rad) + " Hz, and " +
                  base::three_digits(channel.residual_rms_V) + " V rms do not repeat",
         .cure =
             "check the probe's connection, and turn the motor at a constant speed during the recording"}};
  }
  return {};
}

bool may_be_clipped(const EmfChannelResult& channel) {
  constexpr double much = 0.03, dithered = 0.3;
  return channel.clipped > much && channel.residual_rms_V > dithered * channel.step_V;
}

/// Clipping cuts V off both extremes of a sine of peak A: each extreme is constant for a fraction q of the
/// period. This reduces the sine's fundamental and rms by 8/3 q V/A, and its peak by V/A.
void allow_for_clipping(EmfResult& result) {
  double peak = 0.0, fundamental = 0.0;
  for (const EmfChannelResult& channel : result.channels) {
    if (!may_be_clipped(channel)) continue;
    const double part = hidden_V(channel) / channel.peak_V.value;
    peak = std::max(peak, part);
    fundamental = std::max(fundamental, 8.0 / 3.0 * channel.clipped * part);
  }
  EmfConstants& k = result.constants;
  for (Interval* of_peak : {&k.line_peak, &k.phase_peak}) of_peak->high += peak * of_peak->value;
  for (Interval* other : {&k.line_rms, &k.line_fundamental, &k.phase_rms, &k.phase_fundamental})
    other->high += fundamental * other->value;
}

base::Problems check_clipped(const EmfRecord& record, const EmfResult& result) {
  constexpr double part_of_period = 0.03, steps = 2.0;
  for (std::size_t c = 0; c < result.channels.size(); ++c) {
    const EmfChannelResult& channel = result.channels[c];
    const std::vector<double>& u = record.channels[c].u_V;
    const auto [low, high] = std::minmax_element(u.begin(), u.end());
    const bool lost = std::max(lost_beyond(u, *low, result.periods), lost_beyond(u, *high, result.periods)) >
                      hidden_V(channel);
    const bool bent =
        channel.clipped > part_of_period && bend_of_flanks(record.t_s, u) > steps * channel.step_V;
    if (!lost && !bent) continue;
    return {{.where = channel.name,
             .value = "",
             .limit = "is clipped: the voltage stays at " + base::six_digits(*high) + " or " +
                      base::six_digits(*low) + " V for " + base::three_digits(100.0 * channel.clipped) +
                      " % of a period",
             .cure = "record the voltage again in a larger range of the channel"}};
  }
  return {};
}

double unlike(const EmfResult& result) {
  const auto [least, greatest] =
      std::minmax_element(result.channels.begin(), result.channels.end(),
                          [](const auto& a, const auto& b) { return a.peak_V.value < b.peak_V.value; });
  if (result.channels.empty()) return 0.0;
  return (greatest->peak_V.value - least->peak_V.value) / (greatest->peak_V.value + least->peak_V.value);
}

/// Phases of one motor differ by a few per cent. The divider of a probe causes a factor of ten, a wrong unit
/// a factor of a thousand.
base::Problems check_alike(const EmfResult& result) {
  constexpr double most = 0.05;
  if (!(unlike(result) > most)) return {};
  std::string each;
  for (const EmfChannelResult& channel : result.channels)
    each += (each.empty() ? "" : ", ") + channel.name + " " + base::three_digits(channel.peak_V.value) + " V";
  return {{.where = "voltage",
           .value = each,
           .limit = "have fundamentals that differ too much for the phases of one motor",
           .cure = "check the dividers of the probes and the units of the columns"}};
}

/// Widens the constants' bounds so that they reach from channel to channel, because it is unknown which
/// channel is right.
void allow_for_unlike_channels(EmfResult& result) {
  constexpr double usual = 0.01;
  const double half = unlike(result), part = half * (1.0 + half);  // the mean of squares is above the square
                                                                   // of the mean
  if (!(half > usual)) return;
  EmfConstants& k = result.constants;
  for (Interval* i :
       {&k.line_peak, &k.line_rms, &k.line_fundamental, &k.phase_peak, &k.phase_rms, &k.phase_fundamental}) {
    i->low -= part * i->value;
    i->high += part * i->value;
  }
}

}  // namespace sixstep::analysis
