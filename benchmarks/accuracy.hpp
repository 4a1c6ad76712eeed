// SPDX-License-Identifier: Apache-2.0
// Compares a solver with the float128 trajectories of tests/reference.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace benchmarks {

/// Largest errors of phase currents and speed, relative to the largest current and speed.
struct Errors {
  double current = 0.0, speed = 0.0;
};

/// `at(t_s)` advances the solver to each row's time, in order, and returns i_a, i_b, i_c and speed. Rows
/// after `until_s` are not compared. NaN if the file cannot be read.
template <class At>
Errors errors_against(const std::string& file_name, At&& at,
                      double until_s = std::numeric_limits<double>::infinity()) {
  std::ifstream file(file_name);
  std::string line;
  std::getline(file, line);
  Errors error, largest;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    double t_s = 0.0;
    std::array<double, 4> exact{};
    cells >> t_s >> exact[0] >> exact[1] >> exact[2] >> exact[3];
    if (t_s > until_s) break;
    const std::array<double, 4> found = at(t_s);
    for (std::size_t k = 0; k < 3; ++k) {
      error.current = std::max(error.current, std::abs(found[k] - exact[k]));
      largest.current = std::max(largest.current, std::abs(exact[k]));
    }
    error.speed = std::max(error.speed, std::abs(found[3] - exact[3]));
    largest.speed = std::max(largest.speed, std::abs(exact[3]));
  }
  return {error.current / largest.current, error.speed / largest.speed};
}

/// The errors of a fixed-step solver. If `reverse_s` is above zero, the sign of its reference is reversed
/// every `reverse_s`.
template <class Solver>
Errors fixed_step_errors(Solver& motor, double step_s, double reference, double reverse_s,
                         const std::string& file_name, double until_s) {
  const long stretch = reverse_s > 0 ? std::lround(reverse_s / step_s) : std::numeric_limits<long>::max();
  long done = 0;
  return errors_against(
      file_name,
      [&](double t_s) {
        for (const long until = std::lround(t_s / step_s); done < until; ++done) {
          motor.set_reference(done / stretch % 2 == 0 ? reference : -reference);
          motor.step();
        }
        return std::array{motor.current(0), motor.current(1), motor.current(2), motor.speed()};
      },
      until_s);
}

}  // namespace benchmarks
