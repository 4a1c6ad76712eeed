// SPDX-License-Identifier: Apache-2.0
// Integrates the sheet's two-body thermal model (design/sheet/thermal.hpp) along a run's copper loss, also in a run
// that simulates no temperatures.
#pragma once
#include <optional>

#include "sixstep/design/sheet/thermal_ranges.hpp"
#include "sixstep/study/measure/end_watch.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Winding and housing at a run's start. Only a run with temperatures gives them; else they are at ambient.
design::Temperatures start_temperatures(const Heat& heat);

class WindingWatch {
 public:
  /// The winding's way through the run by one set of thermal values.
  struct Course {
    design::ThermalModel model{};
    design::Temperatures now{};
    double highest_degC = 0.0, highest_s = 0.0;
    std::optional<double> passed_s{};  ///< when the winding first reached its limit

    void go(const design::Heating& heating, double from_s, double to_s);
    void to(const design::Temperatures& next, double from_s, double to_s);
  };

  WindingWatch() = default;
  /// `friction`: the motor's own, which warms the housing; the load's warms the load.
  WindingWatch(const Scenario& scenario, const design::Friction& friction);

  /// Called from time to time and at the end. `simulated`: temperatures of a run that simulates them.
  void look(double t_s, double copper_J, double speed_rad_s, const design::Temperatures* simulated);
  /// The same courses up to the last look; look() leaves a short time out until it counts.
  WindingWatch finished() const;

  /// By the sheet's values, or as simulated, and by the worse ends of their ranges. Empty without thermal values, and
  /// before a look with books. `worse` equals `values` if no range has a worse end.
  std::optional<Course> values{}, worse{};
  bool has_worse_ends = false;
  EndWatch end{};

 private:
  void go(const design::Temperatures* simulated);

  bool simulates_ = false;
  double ambient_degC_ = 25.0, B_Nm_s_ = 0.0, coulomb_Nm_ = 0.0;
  EndWatch::Mark begin_{}, last_{};  ///< of the time that the courses have not counted yet
};

}  // namespace sixstep::study
