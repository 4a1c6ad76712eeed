// SPDX-License-Identifier: Apache-2.0
// Which runs are made of one scenario: what differs, over which values, and how points are laid out between them.
// Run n is a function of the plan and n: in any order, on any machine, it is the same.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"

namespace sixstep::analysis {

/// How an axis's numbers lie between its ends.
enum class Spacing : std::uint8_t { linear, logarithmic };

/// A key and the values it takes: listed, or numbers from one end to the other.
struct Axis {
  std::string key;                  ///< as in the scenario, "pwm.period_s"
  std::vector<std::string> values;  ///< as a file writes them, "\"soft\"" or 0.5; empty: a range
  double from = 0.0, to = 0.0;      ///< in the key's unit; both are reached on a grid
  std::size_t points = 0;           ///< of a range on a grid, two or more
  Spacing spacing = Spacing::linear;
  bool strays =
      false;  ///< the drive differs and its controller does not, as with [[spread]] (study::strayed_to)
  bool operator==(const Axis&) const = default;
};

enum class Sampling : std::uint8_t {
  grid,             ///< every value of each axis with every one of the others, the last axis's changing first
  latin_hypercube,  ///< each axis in as many equal parts as there are points, one point in each part
  sobol,            ///< a sequence that fills the space evenly, whatever its length
  monte_carlo,      ///< at random
  saltelli  ///< for Sobol indices: base points in blocks of k + 2, A, B, and A with one column of B at a time
};

/// `points` of everything but a grid, `drives` of the series that [[spread]] describes at each point (0: the drive as
/// written).
struct Plan {
  std::vector<Axis> axes;
  Sampling sampling = Sampling::grid;
  std::size_t points = 0;  ///< saltelli: base points, of which each is axes + 2 runs
  std::size_t drives = 0;
  std::uint64_t seed = 1;
  bool operator==(const Plan&) const = default;
};

/// Of axes: none, or twice the same key; a range without end, or logarithmic through 0; more than 10^9 runs. `where` is
/// "vary[0].from", "points" and the like.
base::Problems check(const Plan& plan);

/// Points of the plan: each is run once per drive. Assumes that check() found nothing.
std::size_t points_of(const Plan& plan);
std::size_t runs_of(const Plan& plan);

/// What run n sets, an entry per axis, as a file writes it.
std::vector<std::string> point_of_run(const Plan& plan, std::size_t run);
/// The drive of run n; empty where the plan has none.
std::optional<std::size_t> drive_of_run(const Plan& plan, std::size_t run);

/// A value without the quotes that a file writes around a word.
std::string_view bare(std::string_view value);

/// The value at u of an axis, 0 its beginning and 1 its end, as a file writes it.
std::string on_axis(const Axis& axis, double u);

/// Where point n lies on each axis, 0 to 1: of a listed value, which part of as many equal ones.
std::vector<double> coordinates(const Plan& plan, std::size_t point);

}  // namespace sixstep::analysis
