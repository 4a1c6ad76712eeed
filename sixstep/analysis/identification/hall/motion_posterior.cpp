// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/motion_posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {
namespace {

/// Logarithms of three unknowns: the deviation of the angle from uniform motion within a sector, in degrees;
/// the jitter in degrees; and the scale of the voltages' variance.
using Place = std::array<double, 3>;

struct Bounds {
  double low, high;
};
// bounds of the three numbers: 1e-6 .. 100, 1e-3 .. 30, 0.01 .. 1e4
constexpr Bounds bounds[] = {{-13.8, 4.6}, {-6.9, 3.4}, {-4.6, 9.2}};

constexpr double none = -std::numeric_limits<double>::infinity();

class Likelihood {
 public:
  Likelihood(std::span<const Sighting> sightings, std::size_t effects, double sector_s, Smoothness smoothness,
             const KeepGoing& keep_going)
      : sightings_(sightings), effects_(effects), smoothness_(smoothness), keep_going_(keep_going) {
    // Over a sector of the time T, noise of the n-th derivative causes this variance of the angle:
    // T^(2n-1)/((2n-1) (n-1)!^2).
    const double T2 = sector_s * sector_s;
    stray2_ = smoothness == Smoothness::second ? T2 * sector_s / 3.0 : T2 * T2 * sector_s / 20.0;
  }

  MotionNoise noise_at(const Place& p) const {
    const double stray = base::exp(p[0]);
    return {smoothness_, stray * stray / stray2_, base::exp(p[1]), base::exp(p[2])};
  }
  Place place_of(const MotionNoise& n) const {
    return {0.5 * base::log(n.intensity * stray2_), base::log(n.jitter_deg), base::log(n.voltage_scale)};
  }
  /// The fit with the noise p. Also empty after keep_going has ended the work: no noise then has a
  /// likelihood, and every search ends.
  std::optional<MotionFit> fit_at(const Place& p) const {
    if (keep_going_ && !keep_going_()) return {};
    return fit_motion(sightings_, effects_, noise_at(p));
  }
  double at(const Place& p) const {
    const std::optional<MotionFit> fit = fit_at(p);
    return fit && std::isfinite(fit->log_likelihood) ? fit->log_likelihood : none;
  }
  std::size_t axes() const {
    return std::any_of(sightings_.begin(), sightings_.end(), [](const Sighting& s) { return !s.is_edge; })
               ? 3
               : 2;
  }

 private:
  std::span<const Sighting> sightings_;
  std::size_t effects_;
  Smoothness smoothness_;
  const KeepGoing& keep_going_;
  double stray2_ = 0.0;
};

struct Top {
  Place place{};
  double height = none;
};

/// Climbs along each axis in turn. The step is halved if no step increases the likelihood.
Top climbed(const Likelihood& likelihood, Top top, double first_step) {
  const std::size_t axes = likelihood.axes();
  for (double step = first_step; step > 0.04; step *= 0.5)
    for (bool up = true; up;) {
      up = false;
      for (std::size_t axis = 0; axis < axes; ++axis)
        for (const double way : {step, -step}) {
          Place next = top.place;
          next[axis] = std::clamp(next[axis] + way, bounds[axis].low, bounds[axis].high);
          if (next[axis] == top.place[axis]) continue;
          const double there = likelihood.at(next);
          if (!(there > top.height)) continue;
          top = {next, there};
          up = true;
          break;
        }
    }
  return top;
}

Top highest(const Likelihood& likelihood) {
  Top top;
  for (const double stray : {-7.0, -4.0, -2.0, 0.0, 2.0})
    for (const double jitter : {-4.0, -2.0, -0.5, 1.0}) {
      const Place place{stray, jitter, 0.0};
      const double there = likelihood.at(place);
      if (there > top.height) top = {place, there};
    }
  return top.height > none ? climbed(likelihood, top, 1.0) : top;
}

/// Distance along an axis at which the log likelihood has decreased by `enough`, at most the distance to the
/// bound.
double reach(const Likelihood& likelihood, const Top& top, std::size_t axis, double way, double enough) {
  const auto lost = [&](double step) {
    Place p = top.place;
    p[axis] += step;
    return top.height - likelihood.at(p) > enough;
  };
  const double most = (way > 0 ? bounds[axis].high : bounds[axis].low) - top.place[axis];
  double inside = 0.0, outside = way;
  while (!lost(outside)) {
    inside = outside;
    outside *= 2.0;
    if (std::fabs(outside) > std::fabs(most)) return most;
  }
  for (int n = 0; n < 3; ++n) {
    const double middle = 0.5 * (inside + outside);
    (lost(middle) ? outside : inside) = middle;
  }
  return outside;
}

}  // namespace

std::optional<MotionNoise> likeliest_noise(std::span<const Sighting> sightings, std::size_t effects,
                                           double sector_s, const KeepGoing& keep_going) {
  const Likelihood second(sightings, effects, sector_s, Smoothness::second, keep_going),
      third(sightings, effects, sector_s, Smoothness::third, keep_going);
  const Top by_second = highest(second), by_third = highest(third);
  if (!(std::max(by_second.height, by_third.height) > none)) return {};
  return by_second.height > by_third.height ? second.noise_at(by_second.place)
                                            : third.noise_at(by_third.place);
}

MotionNoise likelier_noise(std::span<const Sighting> sightings, std::size_t effects, double sector_s,
                           const MotionNoise& likely, const KeepGoing& keep_going) {
  const Likelihood likelihood(sightings, effects, sector_s, likely.smoothness, keep_going);
  const Place place = likelihood.place_of(likely);
  return likelihood.noise_at(climbed(likelihood, {place, likelihood.at(place)}, 0.5).place);
}

std::optional<MotionPosterior> MotionPosterior::of(std::span<const Sighting> sightings, std::size_t effects,
                                                   double sector_s, const MotionNoise& likeliest,
                                                   const KeepGoing& keep_going) {
  constexpr int points = 9;
  constexpr double enough = 5.0;  // exp(-5) of the maximum: the region beyond contains less than 0.2 %
  const Likelihood likelihood(sightings, effects, sector_s, likeliest.smoothness, keep_going);
  const Place place = likelihood.place_of(likeliest);
  const Top top{place, likelihood.at(place)};
  double low[2], high[2];
  for (std::size_t axis = 0; axis < 2; ++axis) {
    low[axis] = place[axis] + reach(likelihood, top, axis, -0.25, enough);
    high[axis] = place[axis] + reach(likelihood, top, axis, 0.25, enough);
  }
  double known = 0.0, edges = 0.0;
  for (const Sighting& s : sightings)
    if (s.is_edge && !s.left_out) known += s.known_deg2, edges += 1.0;
  known /= std::max(edges, 1.0);
  MotionPosterior out;
  double best = none;
  for (int n = 0; n < points; ++n)
    for (int m = 0; m < points; ++m) {
      const Place p{low[0] + (high[0] - low[0]) * n / (points - 1),
                    low[1] + (high[1] - low[1]) * m / (points - 1), place[2]};
      std::optional<MotionFit> fit = likelihood.fit_at(p);
      if (!fit || !std::isfinite(fit->log_likelihood)) continue;
      const MotionNoise noise = likelihood.noise_at(p);
      // Jeffreys's prior, over the logarithm of the deviation, of a variance that is added to the known
      // variance.
      const double jitter2 = noise.jitter_deg * noise.jitter_deg;
      const double log_weight = fit->log_likelihood + base::log(jitter2 / (jitter2 + known));
      best = std::max(best, log_weight);
      out.all_.push_back({log_weight, noise, std::move(*fit)});
    }
  if (out.all_.empty()) return {};
  double sum = 0.0;
  for (Possible& p : out.all_) sum += p.weight = base::exp(p.weight - best);
  for (Possible& p : out.all_) p.weight /= sum;
  out.jitter_step_ = (high[1] - low[1]) / (points - 1);
  constexpr double told_apart = 1.92;  // difference of log likelihoods that distinguishes two models: half of
                                       // chi square's 95 %
  out.maybe_none_ = top.height - likelihood.at({place[0], bounds[1].low, place[2]}) < told_apart;
  return out;
}

std::vector<Component> MotionPosterior::mixture(std::span<const double> weights) const {
  std::vector<Component> out;
  for (const Possible& p : all_) {
    double mean = 0.0;
    for (std::size_t n = 0; n < weights.size(); ++n) mean += weights[n] * p.fit.effects[n];
    out.push_back({p.weight, mean, std::sqrt(std::max(0.0, p.fit.covariance.square(weights)))});
  }
  return out;
}

Interval MotionPosterior::effects(std::span<const double> weights) const {
  return mixture_95(mixture(weights));
}

double MotionPosterior::probability(std::span<const double> weights, double low, double high) const {
  double sum = 0.0;
  for (const Component& c : mixture(weights))
    sum += c.weight * (c.deviation > 0.0 ? normal_cdf((high - c.mean) / c.deviation) -
                                               normal_cdf((low - c.mean) / c.deviation)
                                         : static_cast<double>(low <= c.mean && c.mean <= high));
  return sum;
}

Interval MotionPosterior::jitter_deg() const {
  // Each point represents a part of the axis. A normal distribution over this part hides the steps.
  std::vector<Component> mixture;
  for (const Possible& p : all_)
    mixture.push_back({p.weight, base::log(p.noise.jitter_deg), 0.29 * jitter_step_});
  const Interval logarithm = mixture_95(mixture);
  return {base::exp(logarithm.value), maybe_none_ ? 0.0 : base::exp(logarithm.low),
          base::exp(logarithm.high)};
}

}  // namespace sixstep::analysis
