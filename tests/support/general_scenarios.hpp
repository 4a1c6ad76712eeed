// SPDX-License-Identifier: Apache-2.0
// Changes after which only the general kernel can simulate a scenario of the reference motor.
#pragma once
#include <functional>

#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

inline void behind(study::Scenario& s, double resistance_ohm) {
  s.supply.resistance_ohm = resistance_ohm;
  s.supply.capacitance_F = 1e-3;
}

inline void give_thermal_lines(study::Scenario& s) {
  s.sheet.thermal_resistance_housing_ambient_K_W = base::Quantity{4.25, "", ""};
  s.sheet.thermal_resistance_winding_housing_K_W = base::Quantity{4.5, "", ""};
  s.sheet.thermal_time_constant_winding_s = base::Quantity{17.7, "", ""};
  s.sheet.thermal_time_constant_motor_s = base::Quantity{212, "", ""};
  s.sheet.max_winding_temperature_degC = base::Quantity{125, "", ""};
}

/// A change after which only the general kernel can simulate a scenario.
struct AsksForGeneral {
  const char* what;
  std::function<void(study::Scenario&)> make;
};
inline const AsksForGeneral asks_for_general[] = {
    {"gear", [](study::Scenario& s) { s.load.gear = 2; }},
    {"elastic shaft",
     [](study::Scenario& s) {
       s.load.stiffness_Nm_rad = 2;
       s.load.inertia_kg_m2 = 1e-5;
     }},
    {"fan", [](study::Scenario& s) { s.load.fan_Nm_s2 = 1e-8; }},
    {"weight", [](study::Scenario& s) { s.load.gravity_Nm = 0.01; }},
    {"IGBT", [](study::Scenario& s) { s.bridge.device = study::Device::igbt; }},
    {"bus inductance",
     [](study::Scenario& s) {
       s.supply.resistance_ohm = 0.1;
       s.supply.capacitance_F = 1e-3;
       s.supply.inductance_H = 1e-6;
     }},
    {"brake chopper",
     [](study::Scenario& s) {
       s.supply.resistance_ohm = 0.1;
       s.supply.capacitance_F = 1e-3;
       s.supply.brake_resistance_ohm = 2;
       s.supply.brake_on_V = 30;
       s.supply.brake_off_V = 28;
     }},
    {"delta", [](study::Scenario& s) { s.sheet.connection = design::WindingConnection::delta; }},
    {"harmonics",
     [](study::Scenario& s) {
       s.sheet.back_emf = design::BackEmfShape::sine;
       s.sheet.harmonic_orders = {3, 5};
       s.sheet.harmonic_sizes = {0.1, 0.05};
     }},
    {"phases that stray",
     [](study::Scenario& s) {
       s.sheet.phase_resistance_deviation = {0.05, -0.05, 0};
     }},
    {"cogging",
     [](study::Scenario& s) {
       s.sheet.cogging_orders = {48};
       s.sheet.cogging_mNm = {5};
     }},
    {"saliency",
     [](study::Scenario& s) {
       s.sheet.inductance_mH.reset();
       s.sheet.d_axis_inductance_mH = base::Quantity{0.24, "phase", ""};
       s.sheet.q_axis_inductance_mH = base::Quantity{0.34, "phase", ""};
     }},
    {"saturation",
     [](study::Scenario& s) {
       s.sheet.saturation_current_A = base::Quantity{100, "phase", ""};
     }},
    {"load ramp",
     [](study::Scenario& s) {
       s.load.between = study::Between::lines;
       s.load.times_s = {0, 0.01, 0.03};
       s.load.torques_Nm = {0, 0.05, 0.01};
     }},
    {"torque over speed",
     [](study::Scenario& s) {
       s.load.at_speeds_rad_s = {-100, 0, 100};
       s.load.at_speeds_Nm = {-0.02, 0, 0.1};
     }},
    {"gear with losses",
     [](study::Scenario& s) {
       s.load.gear = 3;
       s.load.gear_efficiency = 0.8;
       s.load.torque_Nm = 0.1;
     }},
    {"dynamometer",
     [](study::Scenario& s) {
       s.load.dynamometer_times_s = {0, 0.01};
       s.load.dynamometer_rad_s = {10, 80};
     }},
    {"battery",
     [](study::Scenario& s) {
       behind(s, 0.05);
       s.supply.source = study::SourceKind::battery;
       s.supply.battery_charges = {0, 0.5, 1};
       s.supply.battery_voltages_V = {18, 24, 26};
       s.supply.battery_capacity_Ah = 1e-4;
       s.supply.battery_charge = 0.51;
     }},
    {"single-phase mains",
     [](study::Scenario& s) {
       behind(s, 0.05);
       s.supply.source = study::SourceKind::single_phase;
       s.supply.mains_rms_V = 18;
     }},
    {"three-phase mains",
     [](study::Scenario& s) {
       behind(s, 0.05);
       s.supply.source = study::SourceKind::three_phase;
       s.supply.mains_rms_V = 18;
       s.supply.inductance_H = 5e-6;
     }},
    {"capacitor with a resistance",
     [](study::Scenario& s) {
       behind(s, 0.05);
       s.supply.capacitor_resistance_ohm = 0.02;
       s.supply.sinks = false;
     }},
    {"source with a limit",
     [](study::Scenario& s) {
       behind(s, 0.05);
       s.supply.sinks = false;
       s.supply.sink_limit_A = 2;
     }},
    {"warm motor",
     [](study::Scenario& s) {
       give_thermal_lines(s);
       s.heat.motor = true;
       s.heat.winding_degC = 90;
     }},
    {"warm switches",
     [](study::Scenario& s) {
       s.heat.devices = true;
       s.bridge.on_resistance_ohm = 0.01;
       s.bridge.on_resistance_percent_K = 0.6;
       s.bridge.junction_K_W = 20;
       s.bridge.gate_current_A = 0.5;
       s.bridge.gate_source_charge_C = 6e-9;
       s.bridge.gate_drain_charge_C = 10e-9;
     }},
    {"switch that opens",
     [](study::Scenario& s) {
       study::At at;
       at.time_s = 0.01;
       at.bridge.open_switch = study::Switch::T3;
       s.at.push_back(at);
     }},
    {"broken wire",
     [](study::Scenario& s) {
       study::At at;
       at.time_s = 0.01;
       at.motor.broken_wire = study::Wire::b;
       s.at.push_back(at);
     }},
    {"crossed wires",
     [](study::Scenario& s) {
       s.bridge.phases = rig::WireOrder::bca;
       s.sensors.hall_lines = rig::WireOrder::bca;
     }},
};

}  // namespace sixstep::testing
