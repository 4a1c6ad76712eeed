// SPDX-License-Identifier: Apache-2.0
// Member functions of rig.hpp that update inputs between two samples: ports of the shaft's sensor, analogue
// front end, and terminals that a firmware samples.
#pragma once
#include "sixstep/rig/rig.hpp"

namespace sixstep::rig {

/// Initial state of the front end: settled, with the bridge off and without current.
template <class Real, class Firmware, class Plant>
auto Rig<Real, Firmware, Plant>::front_end_before(const FrontEndConfig& config) const
    -> std::conditional_t<has_front_end, FrontEnd, NoFrontEnd> {
  if constexpr (has_front_end) {
    plant::PerLeg<double> terminal_V{};
    if constexpr (looks_at_terminals) {
      const plant::PerLeg<Real> u = wires_.at_legs(plant::terminal_voltages(plant_));
      for (std::size_t k = 0; k < 3; ++k) terminal_V[k] = static_cast<double>(u[k]);
    }
    return FrontEnd(config, static_cast<double>(plant_.state().bus), terminal_V);
  } else {
    return {};
  }
}

template <class Real, class Firmware, class Plant>
bool Rig<Real, Firmware, Plant>::listens() const {
  bool any = false;
  if constexpr (requires { firmware_.follows_shaft(); }) any = firmware_.follows_shaft();
  if constexpr (has_front_end) any = any || front_end_.follows();
  return any;
}

/// Updates the inputs that follow plant and shaft between two samples: ports of the shaft's sensor,
/// amplifiers and dividers.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::show_segment(Real s, const sim::Instant& to) {
  if constexpr (requires { firmware_.follows_shaft(); })
    if (firmware_.follows_shaft()) firmware_.follow(shaft_motion(s, to));
  if constexpr (has_front_end)
    if (front_end_.follows()) show_signals(s, to);
}

/// Motion of the shaft on which the sensor is mounted: the motor's shaft, or the load's shaft after gear and
/// elastic shaft.
template <class Real, class Firmware, class Plant>
ShaftMotion<Real> Rig<Real, Firmware, Plant>::shaft_motion(Real s, const sim::Instant& to) const {
  ShaftMotion<Real> motion{plant_.expansion(), plant_.state().sector, sensor_pole_pairs(), s, now_, to,
                           next_sample()};
  if constexpr (has_load_side)
    if (board_.sensors.shaft.on_load)
      motion.load = {&plant_.series().load_w, plant_.constants().elastic ? &plant_.series().twist : nullptr,
                     plant_.constants().inv_gear};
  return motion;
}

/// Advances amplifiers and dividers over the segment.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::show_signals(Real s, const sim::Instant& to) {
  if constexpr (has_front_end) {
    const FrontEndSegment<Real> of = segment(s, to);
    front_end_.follow(of);
    if constexpr (looks_at_terminals)
      if (sees_terminals() && front_end_.follows_terminals())
        front_end_.follow_terminals(of, plant::terminal_series(plant_, s));
  }
}

/// Passes the terminal voltages to the firmware: filtered by the dividers' capacitors, or unfiltered if there
/// are none.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::show_terminals() {
  if constexpr (looks_at_terminals) {
    if (front_end_.reading().voltages) return firmware_.look_at_terminals(front_end_.reading().terminal_V);
    firmware_.look_at_terminals(wires_.at_legs(plant::terminal_voltages(plant_)));
  }
}

template <class Real, class Firmware, class Plant>
auto Rig<Real, Firmware, Plant>::crossings_before(const FrontEndConfig& config) const
    -> std::conditional_t<has_crossings, Crossings, NoCrossings> {
  if constexpr (has_crossings) {
    if (sees_terminals()) return Crossings(config, front_end_.reading());
    return Crossings({}, front_end_.reading());
  } else {
    return {};
  }
}

template <class Real, class Firmware, class Plant>
template <class Visit>
void Rig<Real, Firmware, Plant>::crossing_guards(Visit&& visit) const {
  if constexpr (has_crossings)
    crossings_.guards(segment(Real(1), now_), plant::terminal_series(plant_, Real(1)), front_end_.reading(),
                      plant_.constants().volt_scale,
                      [&](std::size_t leg, const series::Coefficients<Real>& g, int degree, Real noise) {
                        visit(crossing + static_cast<int>(leg), g, degree, noise);
                      });
}

/// Changes a comparator's line. The timer captures the edge like a Hall edge.
template <class Real, class Firmware, class Plant>
void Rig<Real, Firmware, Plant>::pass_crossing(int leg) {
  if constexpr (has_crossings) {
    crossings_.turn_over(static_cast<std::size_t>(leg));
    firmware_.captured_crossing(crossings_.lines(), now_);
    moved_ = true;
  }
}

}  // namespace sixstep::rig
