// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/unused_keys.hpp"

namespace sixstep::study {
namespace {

class Unused {
 public:
  template <class Value>
  void add(const char* key, const Value& given, const Value& usual, const char* reason) {
    if (given == usual) return;
    text_ += (text_.empty() ? "" : ", ") + std::string(key) + " (" + reason + ")";
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

void of_sensors(const Scenario& s, Unused& out) {
  const Sensors usual, &x = s.sensors;
  const bool no_terminals = s.control.drive != FirmwareKind::sensorless;
  const bool no_bus = x.bus == BusSensing::ideal, no_hall = x.rotor != RotorSensing::hall;
  if (x.currents == rig::CurrentMeasurement::ideal) {
    constexpr char reason[] = "sensors.currents is ideal";
    out.add("sensors.current_offset_A", x.current_offset_A, usual.current_offset_A, reason);
    out.add("sensors.current_noise_A", x.current_noise_A, usual.current_noise_A, reason);
    out.add("sensors.current_gain_error", x.current_gain_error, usual.current_gain_error, reason);
    if (no_bus && no_terminals && x.rotor != RotorSensing::resolver)
      out.add("sensors.adc_bits", x.adc_bits, usual.adc_bits, "nothing is converted");
  }
  if (no_bus && no_terminals) {  // a terminal's channel is as the bus's is
    constexpr char reason[] = "sensors.bus is ideal";
    out.add("sensors.bus_offset_V", x.bus_offset_V, usual.bus_offset_V, reason);
    out.add("sensors.bus_noise_V", x.bus_noise_V, usual.bus_noise_V, reason);
    out.add("sensors.bus_gain_error", x.bus_gain_error, usual.bus_gain_error, reason);
  }
  if (no_hall && no_terminals) {
    constexpr char reason[] = "sensors.rotor is not hall";
    out.add("sensors.speed_edges", x.speed_edges, usual.speed_edges, reason);
    if (x.rotor == RotorSensing::ideal)
      out.add("sensors.capture_Hz", x.capture_Hz, usual.capture_Hz, "sensors.rotor is ideal");
  }
  if (x.rotor != RotorSensing::encoder)
    out.add("sensors.encoder.lines", x.encoder.lines, usual.encoder.lines, "sensors.rotor is not encoder");
  if (!x.hall_break.at_s)
    out.add("sensors.hall_break.line", x.hall_break.line, usual.hall_break.line, "no hall_break.at_s");
}

void of_power(const Scenario& s, Unused& out) {
  if (!s.heat.motor && !s.heat.devices)
    out.add("heat.ambient_degC", s.heat.ambient_degC, Heat{}.ambient_degC, "nothing warms up");
  if (s.supply.source != SourceKind::battery)
    out.add("supply.battery_charge", s.supply.battery_charge, Supply{}.battery_charge, "no battery");
  if (s.supply.source == SourceKind::steady || s.supply.source == SourceKind::battery)
    out.add("supply.mains_Hz", s.supply.mains_Hz, Supply{}.mains_Hz, "no mains");
}

void of_protection(const Scenario& s, Unused& out) {
  const Align usual, &x = s.protection.align;
  if (x.current_A) return;
  constexpr char reason[] = "no protection.align.current_A";
  out.add("protection.align.longest_s", x.longest_s, usual.longest_s, reason);
  out.add("protection.align.settled_s", x.settled_s, usual.settled_s, reason);
  out.add("protection.align.sector", x.sector, usual.sector, reason);
}

void of_control(const Scenario& s, Unused& out) {
  const Control usual, &x = s.control;
  if (x.current.type != CurrentLoopType::hysteresis && s.at.empty()) {
    constexpr char reason[] = "control.current.type is not hysteresis";
    out.add("control.current.band_A", x.current.band_A, usual.current.band_A, reason);
    out.add("control.current.comparator", x.current.comparator, usual.current.comparator, reason);
  }
  if (!x.smooth_chopping.on) {
    constexpr char reason[] = "control.smooth_chopping.on is false";
    out.add("control.smooth_chopping.soft_above_A", x.smooth_chopping.soft_above_A, {}, reason);
    out.add("control.smooth_chopping.complementary_below_A", x.smooth_chopping.complementary_below_A, {},
            reason);
  }
}

}  // namespace

std::string unused_keys(const Scenario& s) {
  Unused out;
  of_sensors(s, out);
  of_power(s, out);
  of_protection(s, out);
  of_control(s, out);
  return out.text();
}

}  // namespace sixstep::study
