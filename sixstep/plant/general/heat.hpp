// SPDX-License-Identifier: Apache-2.0
// Temperatures of copper, magnets and channels (model.md 8). Losses are summed over thermal steps. At the end
// of each step the temperatures of two bodies, winding and housing, are computed exactly from the step's mean
// powers. R, K_e and R_on are then set for the new temperatures.
#pragma once
#include <cmath>

#include "sixstep/plant/device_losses.hpp"
#include "sixstep/plant/two_bodies.hpp"
#include "sixstep/series/polynomial.hpp"

namespace sixstep::plant::general {

struct HeatGiven {
  bool motor = false, devices = false;  ///< true: the temperatures of motor or switches are simulated
  double step_s = 1e-3;
  // The motor: resistances K/W, time constants s, temperatures degC.
  double winding_housing_K_W = 0.0, housing_ambient_K_W = 0.0, winding_s = 0.0, motor_s = 0.0;
  double ambient_degC = 25.0, winding_degC = 25.0, housing_degC = 25.0;
  double copper_per_K = 0.0, magnet_per_K = 0.0, given_at_degC = 25.0;  ///< temperature at which R, K_e and
                                                                        ///< R_on are given
  double own_coulomb_Nm = 0.0,
         own_B_Nm_s = 0.0;  ///< the motor's part of the friction, which heats the housing
  // The devices.
  bool igbt = false;
  SwitchingLaw switching{};
  double sink_degC = 25.0, junction_K_W = 0.0, on_per_K = 0.0;
};

/// Losses in a part of a run.
struct StretchLosses {
  double dt_s = 0.0, copper_J = 0.0;
  double square = 0.0, travel = 0.0;  ///< integral of the squared speed, rad^2/s; rotation, rad
};

class Heat {
 public:
  explicit Heat(const HeatGiven& given = {})
      : given_(given), losses_(given.switching), winding_(given.winding_degC), housing_(given.housing_degC) {
    for (auto& leg : junction_) leg = {given.sink_degC, given.sink_degC};
  }

  bool on() const { return given_.motor || given_.devices; }
  const HeatGiven& given() const { return given_; }
  DeviceLosses& losses() { return losses_; }
  void add(const StretchLosses& of) {
    elapsed_.add(of.dt_s);
    copper_.add(of.copper_J);
    friction_.add(friction_J(of));
  }
  /// True at the end of a thermal step. Instants are whole ps, but the sum of durations, s, has a rounding
  /// error, for which 1e-9 s is a margin.
  bool due() const { return on() && elapsed_.value > given_.step_s - 1e-9; }
  void take_step();

  double on_R() const { return 1 + given_.copper_per_K * (winding_ - given_.given_at_degC); }
  double on_K_e() const {
    return std::fmax(least_on_K_e, 1 + given_.magnet_per_K * (housing_ - given_.given_at_degC));
  }
  double on_R_on(std::size_t leg, bool upper) const {
    return 1 + given_.on_per_K * (junction_[leg][upper ? 0 : 1] - given_.given_at_degC);
  }
  /// Temperatures of winding and housing, degC, computed from the mean powers since the last thermal step.
  /// These powers include the additional losses `more`. At the end of a step the temperatures equal the
  /// step's result.
  BodyTemperatures bodies_degC(const StretchLosses& more = {}) const;
  /// Hottest junction at the last thermal step, degC. A junction has no heat capacity.
  double hottest_junction_degC() const {
    double hottest = junction_[0][0];
    for (const auto& leg : junction_)
      for (const double T : leg) hottest = T > hottest ? T : hottest;
    return hottest;
  }

 private:
  double friction_J(const StretchLosses& of) const {
    return given_.own_B_Nm_s * of.square + given_.own_coulomb_Nm * std::fabs(of.travel);
  }

  HeatGiven given_;
  DeviceLosses losses_;
  double winding_ = 25.0, housing_ = 25.0;
  std::array<std::array<double, 2>, 3> junction_{};  ///< upper and lower switch of each leg, degC
  series::CompensatedSum<double> elapsed_, copper_, friction_;
};

inline BodyTemperatures Heat::bodies_degC(const StretchLosses& more) const {
  const double t = elapsed_.value + more.dt_s;
  if (!given_.motor || !(t > 0)) return {winding_, housing_};
  const double copper_W = (copper_.value + more.copper_J) / t,
               friction_W = (friction_.value + friction_J(more)) / t;
  const double per_C_w = given_.winding_housing_K_W / given_.winding_s,
               per_C_h = given_.housing_ambient_K_W / given_.motor_s;
  const double across = 1 / given_.winding_housing_K_W, out = 1 / given_.housing_ambient_K_W;
  const TwoBodies bodies{-across * per_C_w,         across * per_C_w,   across * per_C_h,
                         -(across + out) * per_C_h, copper_W * per_C_w, friction_W * per_C_h};
  const BodyTemperatures end =
      after(bodies, {winding_ - given_.ambient_degC, housing_ - given_.ambient_degC}, t);
  return {given_.ambient_degC + end.winding, given_.ambient_degC + end.housing};
}

inline void Heat::take_step() {
  const double t = elapsed_.value;
  const BodyTemperatures end = bodies_degC();
  winding_ = end.winding;
  housing_ = end.housing;
  if (given_.devices) {
    const DeviceEnergies& lost = losses_.energies();
    for (std::size_t k = 0; k < 3; ++k) {
      junction_[k][0] = given_.sink_degC + given_.junction_K_W * lost[k].upper.in_crystal(given_.igbt) / t;
      junction_[k][1] = given_.sink_degC + given_.junction_K_W * lost[k].lower.in_crystal(given_.igbt) / t;
    }
  }
  losses_.clear();
  elapsed_ = copper_ = friction_ = {};
}

}  // namespace sixstep::plant::general
