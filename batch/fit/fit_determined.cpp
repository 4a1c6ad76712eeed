// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit_determined.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace batch {

namespace {

using Index = Eigen::Index;

/// Standard deviation of u from which on a value counts as undetermined. The start alone has 1.
constexpr double widest = 0.5;

/// Growth of the variance without the start from which on the value is rather the start's than the recordings'.
constexpr double most_by_start = 2.0;

/// A derivative below this has no effect: it moves the model by less than a thousandth of the noise of all cells together.
constexpr double no_effect = 1e-3;

/// Correlation from which on two parameters count as having the same effect.
constexpr double same_effect = 0.8;

struct Hint {
  std::string_view key, recording;
};
constexpr Hint hints[] = {
    {"motor_override.resistance_ohm",
     "the current of a locked rotor at a steady duty, for at least five times L/R: the end value is U d/R"},
    {"motor_override.inductance_mH",
     "the rise of the current of a locked rotor after a voltage step, with at least five rows within L/R"},
    {"motor_override.torque_constant_mNm_A",
     "the voltage of the open terminals of a turned rotor, or speed and current at two duties without load"},
    {"motor_override.back_emf_mV_s",
     "the voltage of the open terminals of a turned rotor, or speed and current at two duties without load"},
    {"motor_override.inertia_gcm2",
     "speed and current of an acceleration without load, or a load of known inertia"},
    {"motor_override.viscous_friction_Nm_s",
     "the speed of a rotor that coasts from its highest speed to standstill"},
    {"motor_override.coulomb_friction_mNm",
     "the speed of a rotor that coasts from its highest speed to standstill"}};

}  // namespace

bool is_alike(const FitCovariance& covariance, std::size_t k, std::size_t other) {
  const auto at = static_cast<Index>(k), n = static_cast<Index>(other);
  const double both = std::sqrt(covariance.covariance(at, at) * covariance.covariance(n, n));
  return std::fabs(covariance.covariance(at, n)) > same_effect * both;
}

bool is_without_effect(const FitProblem& problem, const Eigen::MatrixXd& derivatives, std::size_t k) {
  return derivatives.col(static_cast<Index>(k)).head(static_cast<Index>(problem.cells())).norm() < no_effect;
}

bool is_determined(const FitCovariance& covariance, std::size_t k) {
  const auto at = static_cast<Index>(k);
  return std::sqrt(covariance.covariance(at, at)) < widest &&
         covariance.growth_without_start[at] < most_by_start;
}

std::string why_undetermined(const FitProblem& problem, const Eigen::MatrixXd& derivatives,
                             const FitCovariance& covariance, std::size_t k) {
  const auto at = static_cast<Index>(k);
  if (is_without_effect(problem, derivatives, k)) return "no recorded column depends on it";
  std::string others;
  for (Index n = 0; n < covariance.covariance.cols(); ++n) {
    if (n == at || !is_alike(covariance, k, static_cast<std::size_t>(n))) continue;
    others += (others.empty() ? "" : ", ") + problem.parameters()[static_cast<std::size_t>(n)].key;
  }
  if (others.empty()) return "a change of it moves the recorded columns by less than their noise";
  return "a change of it has the same effect on the recorded columns as one of " + others +
         "; the others hold for this value";
}

std::string recording_for(const FitParameter& parameter) {
  const auto* const found =
      std::find_if(std::begin(hints), std::end(hints), [&](const Hint& h) { return h.key == parameter.key; });
  return found == std::end(hints) ? std::string() : std::string(found->recording);
}

}  // namespace batch
