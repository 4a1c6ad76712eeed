// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/thesis/thesis_figures.hpp"

#include <cmath>

namespace sixstep::design {
namespace {

struct Printed {
  std::string_view loop, symbol;
  double value;
};

constexpr Printed printed[] = {
    {"current", "a0", -0.9474},  {"current", "b0", 0.0511}, {"current", "Re z", 0.8588},
    {"current", "Im z", 0.0575}, {"current", "d1", 4.5},    {"current", "d0", -4.04},
    {"current", "K", 4.5},       {"current", "K_i", 0.46},  {"speed", "a0", -0.99998},
    {"speed", "b0", 1.733},      {"speed", "Re z", 0.9851}, {"speed", "Im z", 0.0066},
    {"speed", "d1", 0.017225},   {"speed", "d0", -0.01707}, {"speed", "K", 0.017225},
    {"speed", "K_i", 0.000155},
};

/// True if x equals the printed number within half of the thesis's last digit.
bool same(double x, double as_printed, double half_digit) { return std::fabs(x - as_printed) <= half_digit; }

}  // namespace

std::optional<double> thesis_figure(std::string_view loop, const PolePlacement& p, std::string_view symbol) {
  const bool speed = loop == "speed";
  const bool its_wish = p.period_s == 30e-6 && p.damping == usual_damping &&
                        p.settle_s == (speed ? usual_speed_settle_s : usual_current_settle_s);
  const bool its_plant = speed ? same(p.plant.a0, -0.99998, 0.5e-5) && same(p.plant.b0, 1.733, 0.5e-3)
                               : same(p.plant.a0, -0.9474, 0.5e-4) && same(p.plant.b0, 0.0511, 0.5e-4);
  if (!its_wish || !its_plant) return std::nullopt;
  for (const Printed& row : printed)
    if (row.loop == loop && row.symbol == symbol) return row.value;
  return std::nullopt;
}

}  // namespace sixstep::design
