// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bench/emf/emf_doubts.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/plausible.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How far rows lie from the straight line between their neighbours, at the middle of all that do not stand at an extreme.
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
                     base::three_digits(*longest) + " s, and " + channel + " shows no steady period",
            .cure = "cut out a part without a gap, of a period and a half and more"};
  }
  if (!regular)
    return {.where = channel,
            .value = "",
            .limit = "is noise, or changes its speed all the time: its half waves are of all lengths",
            .cure = "look at where the probe hung; turn the motor steadily while it is recorded"};
  return {
      .where = channel,
      .limit = "passes its mean " + std::to_string(passed) + " times; a period is to be seen once and a half",
      .cure = "record for longer, or turn the motor faster"};
}

base::Problems check_noise(const EmfRecord& record, const HarmonicFit& fit) {
  for (std::size_t c = 0; c < fit.channels.size(); ++c) {
    const ChannelFit& channel = fit.channels[c];
    double squares = 0.0;
    for (const Harmonic& h : channel.harmonics) squares += 0.5 * (h.a_V * h.a_V + h.b_V * h.b_V);
    const double rms = std::sqrt(squares);
    if (channel.residual_rms_V < rms) continue;
    return {{.where = record.channels[c].name,
             .value = "",
             .limit = "is noise: " + base::three_digits(rms) + " V rms of it repeat with " +
                      base::three_digits(fit.phase.rate[0] / base::turn_rad) + " Hz, and " +
                      base::three_digits(channel.residual_rms_V) + " V rms do not",
             .cure = "look at where the probe hung; turn the motor steadily while it is recorded"}};
  }
  return {};
}

base::Problems check_clipped(const EmfRecord& record, const EmfResult& result) {
  constexpr double part_of_period = 0.03, steps = 2.0;
  for (std::size_t c = 0; c < result.channels.size(); ++c) {
    const EmfChannelResult& channel = result.channels[c];
    const std::vector<double>& u = record.channels[c].u_V;
    if (!(channel.clipped > part_of_period)) continue;
    if (!(bend_of_flanks(record.t_s, u) > steps * channel.step_V)) continue;
    const auto [low, high] = std::minmax_element(u.begin(), u.end());
    return {{.where = channel.name,
             .value = "",
             .limit = "is clipped: it stands at " + base::six_digits(*high) + " or " +
                      base::six_digits(*low) + " V for " + base::three_digits(100.0 * channel.clipped) +
                      " % of a period",
             .cure = "record it again in a greater range of the channel"}};
  }
  return {};
}

base::Problems check_plausible(const EmfResult& result) {
  const base::Plausible likely = base::plausible("mV s");
  const double pairs = std::max(result.pole_pairs, 1), mV_s = 1e3 * pairs * result.constants.line_peak.value;
  if (mV_s >= likely.least && mV_s <= likely.most) return {};
  return {{.where = "voltage",
           .value = "",
           .limit = "over speed is " + base::three_digits(mV_s) + " mV s/rad, line peak at " +
                    base::three_digits(result.frequency_Hz.value) + " Hz, and no motor has less than " +
                    base::three_digits(likely.least) + " or more than " + base::three_digits(likely.most),
           .cure = "look at the units of time and voltage"}};
}

}  // namespace sixstep::analysis
