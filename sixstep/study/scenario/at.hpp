// SPDX-License-Identifier: Apache-2.0
// Changes at an instant of the run, as a scenario states them; values that are not given stay as they were.
// at_description.hpp describes each key.
#pragma once
#include "sixstep/study/scenario/control.hpp"
#include "sixstep/study/scenario/reference.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

struct AtSupply {
  std::optional<double> voltage_V;
  std::optional<bool> sinks;
};

struct AtLoad {
  std::optional<double> torque_Nm;
  std::optional<bool> locked;
};

/// Level of a Hall line's pin: stuck low, stuck high, or the level of its probe.
enum class PinLevel : std::uint8_t { low, high, probe };

struct AtHallBreak {
  int line = 1;
  PinLevel level = PinLevel::low;
};

/// rig::WireOrder; with `same` the order does not change.
enum class AtOrder : std::uint8_t { same, abc, bca, cab, acb, cba, bac };
/// The values of study::HallLines, each one higher, because 0 is `same`: the inverted lines stay as they
/// were.
enum class AtHallLines : std::uint8_t {
  same,
  none,
  line_3,
  line_2,
  lines_23,
  line_1,
  lines_13,
  lines_12,
  all
};

/// Level of an encoder's line or track: stuck low, stuck high, or `whole`: no longer stuck.
enum class EncoderLevel : std::uint8_t { low, high, whole };

/// The level of an absolute encoder's track from the event on. Track 1 is the finest.
struct AtTrack {
  int track = 1;
  EncoderLevel level = EncoderLevel::low;
};

/// A line of an incremental encoder; rig::ShaftPorts numbers the lines in the same way.
enum class EncoderLine : std::uint8_t { A = 1, B = 2, Z = 3 };
struct AtEncoderLine {
  EncoderLine line = EncoderLine::A;
  EncoderLevel level = EncoderLevel::low;
};

/// A resolver's winding whose line breaks, in addition to earlier breaks; `whole` repairs both windings.
enum class Winding : std::uint8_t { none, cosine, sine, whole };

/// A wire or a divider, named by its terminal.
enum class Wire : std::uint8_t { none, a, b, c };

struct AtSensors {
  std::optional<AtHallBreak> hall_break;
  AtOrder hall_lines = AtOrder::same;
  AtHallLines hall_inverted = AtHallLines::same;
  std::optional<double> current_offset_A, current_gain_error;
  std::optional<int> missed_edges;
  std::optional<AtTrack> bad_track;
  std::optional<AtEncoderLine> encoder_line;
  std::optional<bool> false_index;
  Winding broken_winding = Winding::none;
  std::optional<double> excitation;
  Wire broken_divider = Wire::none;
};

/// Request to the product drive.
enum class DriveRequest : std::uint8_t { none, off, on, clear };

/// A PI's gains, in any form that CurrentLoop allows. New gains replace all earlier gains, even if the
/// earlier gains have another form.
struct AtGains {
  std::optional<double> settle_s, damping;
  std::optional<double> d1, d0;
  std::optional<double> kp, ki, ki_per_s;
  bool operator==(const AtGains&) const = default;
};

struct AtCurrentLoop : AtGains {
  std::optional<double> band_A, limit_A;
  bool operator==(const AtCurrentLoop&) const = default;
};

struct AtSpeedLoop : AtGains {
  std::optional<double> torque_limit_Nm;
  bool operator==(const AtSpeedLoop&) const = default;
};

struct AtPositionLoop {
  std::optional<double> gain_rad_s_per_deg, speed_limit_rad_s;
  bool operator==(const AtPositionLoop&) const = default;
};

struct AtLimits {
  std::optional<double> current_A, torque_Nm, speed_rad_s;
  bool operator==(const AtLimits&) const = default;
};

/// The values of control::Mode and control::Chopping, each one higher, because 0 is `same`: the setting stays
/// as it was.
enum class AtMode : std::uint8_t { same, off, duty, current, speed, position };
enum class AtChopping : std::uint8_t { same, soft, hard, complementary };

/// The values of study::Commutates, each one higher, because 0 is `same`: the setting stays as it was.
enum class AtCommutates : std::uint8_t { same, back_emf, hall };

struct AtSensorless {
  AtCommutates commutates = AtCommutates::same;
  bool operator==(const AtSensorless&) const = default;
};

struct AtControl {
  AtMode mode = AtMode::same;
  AtCurrentLoop current;
  AtSpeedLoop speed;
  AtPositionLoop position;
  std::optional<double> slew;
  AtLimits limits;
  AtSensorless sensorless;
  bool operator==(const AtControl&) const = default;
};

struct AtPwm {
  AtChopping chopping = AtChopping::same;
  bool operator==(const AtPwm&) const = default;
};

struct AtMotor {
  Wire broken_wire = Wire::none;
};

/// A switch of the bridge: T1/T2 upper and lower of leg a, T3/T4 of b, T5/T6 of c.
enum class Switch : std::uint8_t { none, T1, T2, T3, T4, T5, T6 };

struct AtBridge {
  Switch open_switch = Switch::none, shorted_switch = Switch::none;
  AtOrder phases = AtOrder::same;
  std::optional<double> dead_time_s;
};

struct At {
  double time_s = 0.0;
  std::optional<Reference> reference;
  AtSupply supply;
  AtLoad load;
  AtSensors sensors;
  DriveRequest request = DriveRequest::none;
  AtControl control;
  AtPwm pwm;
  AtBridge bridge;
  AtMotor motor;
};

}  // namespace sixstep::study
