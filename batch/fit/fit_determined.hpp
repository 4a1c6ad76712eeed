// SPDX-License-Identifier: Apache-2.0
// Finds the free parameters that the recordings do not determine, and the reasons.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "batch/fit/fit_bounds.hpp"

namespace batch {

/// Whether the recordings determine the parameter k: its bounds are less than half as wide as the bounds of
/// the start value.
/// Whether the recordings do not depend on unknown k at all.
bool is_without_effect(const FitProblem& problem, const Eigen::MatrixXd& derivatives, std::size_t k);

/// Whether a change of unknown `other` has nearly the same effect as one of unknown k.
bool is_alike(const FitCovariance& covariance, std::size_t k, std::size_t other);

bool is_determined(const FitCovariance& covariance, std::size_t k);

/// The reason why the recordings do not determine the parameter k: no cell depends on k, or other parameters
/// have the same effect.
std::string why_undetermined(const FitProblem& problem, const Eigen::MatrixXd& derivatives,
                             const FitCovariance& covariance, std::size_t k);

/// A recording that determines the parameter; empty if none is known.
std::string recording_for(const FitParameter& parameter);

}  // namespace batch
