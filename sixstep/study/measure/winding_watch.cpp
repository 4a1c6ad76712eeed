// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/winding_watch.hpp"

#include <cmath>

namespace sixstep::study {

design::Temperatures start_temperatures(const Heat& h) {
  if (!h.motor) return {h.ambient_degC, h.ambient_degC};
  return {h.winding_degC.value_or(h.ambient_degC), h.housing_degC.value_or(h.ambient_degC)};
}

void WindingWatch::Course::to(const design::Temperatures& next, double from_s, double to_s) {
  const double before = now.winding_degC, limit = model.max_winding_degC;
  if (!passed_s && next.winding_degC >= limit)
    passed_s =
        before < limit ? from_s + (to_s - from_s) * (limit - before) / (next.winding_degC - before) : from_s;
  now = next;
  if (!(now.winding_degC > highest_degC)) return;
  highest_degC = now.winding_degC;
  highest_s = to_s;
}

void WindingWatch::Course::go(const design::Heating& heating, double from_s, double to_s) {
  to(design::temperatures_after(model, heating, now, to_s - from_s), from_s, to_s);
}

WindingWatch::WindingWatch(const Scenario& s, const design::Friction& friction)
    : end(s.duration_s),
      simulates_(s.heat.motor),
      ambient_degC_(s.heat.ambient_degC),
      B_Nm_s_(friction.B_Nm_s),
      coulomb_Nm_(friction.coulomb_Nm) {
  const base::Result<design::ThermalModel> model = design::thermal_model(s.sheet);
  if (!model) return;
  const design::Temperatures start = start_temperatures(s.heat);
  values = Course{.model = *model, .now = start, .highest_degC = start.winding_degC};
  worse = values;
  if (const std::optional<design::WorseEnds> ends = design::at_worse_ends(s.sheet)) {
    has_worse_ends = true;
    worse->model = ends->model;
  }
}

void WindingWatch::look(double t_s, double copper_J, double speed_rad_s,
                        const design::Temperatures* simulated) {
  if (!simulates_) simulated = nullptr;
  const double cold_J = last_.cold_J + (copper_J - last_.copper_J) / (simulated ? on_R(*simulated) : 1.0);
  last_ = {t_s, copper_J, cold_J, speed_rad_s};
  end.look(last_);
  if (!worse) return;
  // A loss within a step counts as its mean: the winding's temperature is then wrong by a part of what the loss warms it.
  constexpr double counts_K = 0.2, counts_of_tau = 0.02;
  const design::ThermalModel& m = worse->model;
  const double warms_K = (last_.cold_J - begin_.cold_J) * m.winding_housing_K_W / m.winding_s;
  if (simulated || warms_K > counts_K || t_s - begin_.t_s > counts_of_tau * m.winding_s) go(simulated);
}

void WindingWatch::go(const design::Temperatures* simulated) {
  const double from_s = begin_.t_s, to_s = last_.t_s, w = std::fabs(last_.speed_rad_s);
  if (!worse || !(to_s > from_s)) return;
  const design::Heating heating{.copper_W = (last_.cold_J - begin_.cold_J) / (to_s - from_s),
                                .housing_W = (B_Nm_s_ * w + coulomb_Nm_) * w,
                                .ambient_degC = ambient_degC_};
  simulated ? values->to(*simulated, from_s, to_s) : values->go(heating, from_s, to_s);
  worse->go(heating, from_s, to_s);
  begin_ = last_;
}

WindingWatch WindingWatch::finished() const {
  WindingWatch all = *this;
  all.go(nullptr);
  return all;
}

}  // namespace sixstep::study
