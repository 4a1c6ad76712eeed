// SPDX-License-Identifier: Apache-2.0
// Lists the runs of a plan: the varied keys of one scenario, their values, and the points that combine them.
// Run n depends only on the plan and n: it is the same in any order and on any machine.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

/// Spacing of an axis's numbers between its ends.
enum class Spacing : std::uint8_t { linear, logarithmic };

/// A key and its values: a list, or numbers from one end of a range to the other.
struct Axis {
  std::string key;                  ///< as in the scenario, "pwm.period_s"
  std::vector<std::string> values;  ///< as a file writes them, "\"soft\"" or 0.5; empty: a range
  double from = 0.0, to = 0.0;      ///< range in the key's unit; a grid contains both ends
  std::size_t points = 0;           ///< number of values of a range on a grid, two or more
  Spacing spacing = Spacing::linear;
  /// True: only the simulated drive has this value. Its controller is designed for the nominal value, as with
  /// [[spread]] (study::strayed_to).
  bool strays = false;
  bool operator==(const Axis&) const = default;
};

enum class Sampling : std::uint8_t {
  grid,  ///< every value of each axis with every value of the others; the last axis changes fastest
  latin_hypercube,  ///< each axis has as many parts as there are points, and each part has one point
  sobol,            ///< a sequence that fills the space evenly at any length
  monte_carlo,      ///< random points
  /// For Sobol indices: base points in blocks of k + 2 runs for k axes. A block contains the points A and B,
  /// and for each axis the point A with this axis's coordinate of B.
  saltelli
};

/// The varied keys and the number of runs. `points`: number of points, except for a grid. `drives`: number of
/// drives of the [[spread]] series at each point; 0: the drive as written.
struct Plan {
  std::vector<Axis> axes;
  Sampling sampling = Sampling::grid;
  std::size_t points = 0;  ///< saltelli: number of base points, each with axes + 2 runs
  std::size_t drives = 0;
  std::uint64_t seed = 1;
  bool operator==(const Plan&) const = default;
};

/// Problems: no axes, the same key twice, a range whose end is not finite, a logarithmic range through 0,
/// more than 10^9 runs. `where` is "vary[0].from", "points" and similar.
base::Problems check(const Plan& plan);

/// Number of points; each point is run once per drive. The plan must have passed check().
std::size_t points_of(const Plan& plan);
std::size_t runs_of(const Plan& plan);

/// Values that run n sets, one per axis, as a file writes them.
std::vector<std::string> point_of_run(const Plan& plan, std::size_t run);
/// Index of run n's drive; empty if the plan has no drives.
std::optional<std::size_t> drive_of_run(const Plan& plan, std::size_t run);

/// A value without the quotes that a file writes around a word.
std::string_view bare(std::string_view value);

/// The value of an axis at u, from 0 at its beginning to 1 at its end, as a file writes it.
std::string on_axis(const Axis& axis, double u);

/// Position of point n on each axis, 0 to 1; the listed values divide an axis into equal parts.
std::vector<double> coordinates(const Plan& plan, std::size_t point);

}  // namespace sixstep::analysis
