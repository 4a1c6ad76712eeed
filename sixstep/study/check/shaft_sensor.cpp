// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/shaft_sensor.hpp"

#include <cmath>
#include <string>

#include "sixstep/base/written.hpp"
#include "sixstep/study/compile/shaft_sensor.hpp"
#include "sixstep/study/scenario/sensors_description.hpp"

namespace sixstep::study {

namespace {

constexpr int least_converter_bits = 10;
constexpr double most_clocks = 1e9;
constexpr double most_missed = 1e5;

void check_resolver(const Scenario& s, const std::optional<design::MotorModel>& motor, base::Problems& out) {
  const Resolver& r = s.sensors.resolver;
  const auto wrong = [&out](const char* key, const std::string& value, const std::string& limit,
                            const std::string& cure) {
    out.push_back({std::string("sensors.resolver.") + key, value, limit, cure});
  };
  const bool sampled = r.reading == rig::ResolverReading::sampled,
             commutates = s.sensors.shaft == SensorShaft::motor;
  const std::optional<int>& believed = s.believed.pole_pairs;
  if (believed && commutates && *believed % r.pole_pairs != 0)
    out.push_back({"believed.pole_pairs", std::to_string(*believed),
                   "is not a multiple of the resolver's " + std::to_string(r.pole_pairs) +
                       ": the drive could not convert its angle to the motor's electrical angle",
                   "set believed.pole_pairs to a multiple, or change sensors.resolver.pole_pairs"});
  if (motor && !believed && commutates && std::fmod(motor->machine.pole_pairs, r.pole_pairs) != 0)
    wrong("pole_pairs", std::to_string(r.pole_pairs),
          "does not divide the motor's " + base::written(motor->machine.pole_pairs) +
              " pole pairs, so one angle of the resolver belongs to several electrical angles of the motor",
          "give 1, or a divisor of the motor's pole pairs");
  const double step_s = tracking_period_s(s);
  if (sampled && std::fabs(2 * step_s * r.excitation_Hz - 1) > 1e-9)
    wrong(
        "excitation_Hz", base::written(r.excitation_Hz),
        "has a half period of " + base::written(0.5 / r.excitation_Hz) +
            " s, which is not a whole number of control periods: the samples would miss the excitation's peaks",
        "take " + base::written(0.5 / step_s) + " Hz, or change pwm.period_s");
  if (!(r.bandwidth_Hz * step_s < 0.5))
    wrong("bandwidth_Hz", base::written(r.bandwidth_Hz),
          std::string("must be below half the rate of ") + (sampled ? "the peaks, " : "the chip's clock, ") +
              base::written(0.5 / step_s) + " Hz",
          sampled ? "lower this value, or raise excitation_Hz" : "lower this value, or raise converter_Hz");
  if (sampled) return;
  if (r.calibrated)
    wrong("calibrated", "true",
          "applies to the drive's own decoder, and a converter chip reads this resolver",
          "set reading = \"sampled\", or remove this key");
  if (r.bits < least_converter_bits)
    wrong("bits", std::to_string(r.bits), "is fewer bits than any converter chip has",
          "use 10, 12, 14 or 16");
  if (r.latency_s >= s.pwm.period_s)
    wrong("latency_s", base::written(r.latency_s),
          "must be below pwm.period_s = " + base::written(s.pwm.period_s),
          "lower this value, or lengthen pwm.period_s");
  if (s.duration_s * r.converter_Hz > most_clocks)
    wrong("converter_Hz", base::written(r.converter_Hz),
          "causes more than 1e9 steps of the converter chip in duration_s = " + base::written(s.duration_s),
          "lower one of the two values");
}

/// Refuses sensors.hall_angle if the drive does not compute speed and position from captured Hall edges.
void check_hall_angle(const Scenario& s, base::Problems& out) {
  if (s.sensors.hall_angle == rig::HallAngleFrom::sectors) return;
  std::string word(1, '"');  // not a literal, because GCC 12 warns of a literal in front of +
  word += base::word(hall_angle_choices, s.sensors.hall_angle);
  word += '"';
  if (s.sensors.rotor != RotorSensing::hall)
    out.push_back({"sensors.hall_angle", word,
                   "applies to Hall probes only, and sensors.rotor is not \"hall\"",
                   "set rotor = \"hall\", or remove this key"});
  else if (s.control.drive == FirmwareKind::product)
    out.push_back({"sensors.hall_angle", word,
                   "does not apply to the product drive, which commutates by sectors",
                   "set hall_angle = \"sectors\", or control.drive = \"lean\""});
}

/// Refuses events of a sensor that is absent.
void check_shaft_events(const Scenario& s, base::Problems& out) {
  for (std::size_t n = 0; n < s.at.size(); ++n) {
    const AtSensors& at = s.at[n].sensors;
    const std::string where = "at[" + std::to_string(n) + "].sensors.";
    const auto of = [&](const char* key, RotorSensing sensor, const char* name) {
      if (s.sensors.rotor != sensor)
        out.push_back({where + key, "",
                       std::string("applies to ") + name + " only, and sensors.rotor selects another sensor",
                       "set sensors.rotor = \"" + std::string(base::word(rotor_sensing_choices, sensor)) +
                           "\", or remove this key"});
    };
    if (at.missed_edges) of("missed_edges", RotorSensing::encoder, "an encoder");
    if (at.encoder_line) of("encoder_line", RotorSensing::encoder, "an encoder");
    if (at.false_index) of("false_index", RotorSensing::encoder, "an encoder");
    if (at.broken_winding != Winding::none) of("broken_winding", RotorSensing::resolver, "a resolver");
    if (at.excitation) of("excitation", RotorSensing::resolver, "a resolver");
    if (!at.bad_track) continue;
    of("bad_track", RotorSensing::absolute, "an absolute encoder");
    if (at.bad_track->track > s.sensors.absolute.bits)
      out.push_back({where + "bad_track.track", std::to_string(at.bad_track->track),
                     "is more than sensors.absolute.bits = " + std::to_string(s.sensors.absolute.bits),
                     "name a track from 1 to sensors.absolute.bits"});
  }
}

/// Checks the scale along a linear motor, or the lines per turn.
void check_lines(const Scenario& s, base::Problems& out) {
  const Encoder& e = s.sensors.encoder;
  const bool linear = s.sheet.kind == design::MotorKind::linear;
  if (!linear && e.pitch_mm)
    out.push_back({"sensors.encoder.pitch_mm", base::written(*e.pitch_mm),
                   "applies to linear motors only, and this motor is rotary",
                   "give sensors.encoder.lines instead"});
  if (!linear) return;
  if (e.lines != Encoder::usual_lines)
    out.push_back({"sensors.encoder.lines", std::to_string(e.lines),
                   "applies to rotary motors only, and this motor is linear",
                   "give sensors.encoder.pitch_mm instead"});
  if (!e.pitch_mm)
    out.push_back({"sensors.encoder.pitch_mm", "", "is missing: this motor is linear",
                   "give sensors.encoder.pitch_mm, the length of one line of the scale"});
  if (!e.pitch_mm || !s.sheet.pole_pitch_mm) return;
  const double lines = lines_to_period(s), whole = std::floor(lines + 0.5);
  if (whole >= 1 && whole <= 1e6 && std::fabs(lines - whole) <= 1e-9 * whole) return;
  const double nearest = std::fmin(std::fmax(whole, 1.0), 1e6);
  out.push_back(
      {"sensors.encoder.pitch_mm", base::written(*e.pitch_mm),
       "fits " + base::rounded(lines, 6) +
           " times into two pole pitches; two pole pitches must be a whole number of lines, at most 1000000",
       "set sensors.encoder.pitch_mm to " + base::written(2 * s.sheet.pole_pitch_mm->value / nearest)});
}

void check_encoder(const Scenario& s, base::Problems& out) {
  check_lines(s, out);
  if (s.sensors.encoder.missed_Hz * s.duration_s > most_missed)
    out.push_back({"sensors.encoder.missed_Hz", base::written(s.sensors.encoder.missed_Hz),
                   "causes more than 100000 missed edges in duration_s = " + base::written(s.duration_s),
                   "lower one of the two values"});
}

/// For a linear motor: refuses an absolute encoder, a resolver, and an encoder at the load, because they need
/// a turning shaft.
void check_linear(const Scenario& s, const std::string& word, base::Problems& out) {
  if (s.sheet.kind != design::MotorKind::linear) return;
  if (s.sensors.rotor != RotorSensing::encoder)
    out.push_back({"sensors.rotor", word, "needs a turning shaft, and this motor is linear",
                   "set rotor = \"encoder\" with sensors.encoder.pitch_mm, \"hall\" or \"ideal\""});
  else if (s.sensors.shaft == SensorShaft::load)
    out.push_back({"sensors.shaft", "\"load\"", "applies to rotary motors only, and this motor is linear",
                   "set shaft = \"motor\""});
}

}  // namespace

void check_shaft_sensor(const Scenario& s, const std::optional<design::MotorModel>& motor,
                        base::Problems& out) {
  const RotorSensing rotor = s.sensors.rotor;
  check_hall_angle(s, out);
  check_shaft_events(s, out);
  const bool on_load = s.sensors.shaft == SensorShaft::load;
  if (rotor == RotorSensing::ideal || rotor == RotorSensing::hall) {
    if (on_load)
      out.push_back({"sensors.shaft", "\"load\"",
                     "applies to an encoder or a resolver only, and sensors.rotor is neither",
                     "set rotor = \"encoder\", \"absolute\" or \"resolver\", or shaft = \"motor\""});
    return;
  }
  const std::string word(base::word(rotor_sensing_choices, rotor));
  if (on_load && mounting_offset_deg(s.sensors) != 0.0)
    out.push_back({"sensors." + word + ".offset_deg", base::written(mounting_offset_deg(s.sensors)),
                   "is an electrical angle of the motor, and this sensor is on the load's shaft, where the "
                   "Hall probes commutate",
                   "remove this key, or set sensors.shaft = \"motor\""});
  check_linear(s, word, out);
  const bool pair_moves = s.control.drive != FirmwareKind::field && !answers_legs(s.control.own);
  if (!on_load && pair_moves && s.pwm.commutation != CommutationAt::sample)
    out.push_back({"pwm.commutation", "\"hall-edge\"",
                   "waits for an interrupt that sensors.rotor = \"" + word + "\" does not give",
                   "set commutation = \"sample\""});
  if (rotor == RotorSensing::encoder) check_encoder(s, out);
  const double latency_s = s.sensors.absolute.latency_s;
  if (rotor == RotorSensing::absolute && latency_s >= s.pwm.period_s)
    out.push_back({"sensors.absolute.latency_s", base::written(latency_s),
                   "must be below pwm.period_s = " + base::written(s.pwm.period_s),
                   "lower this value, or lengthen pwm.period_s"});
  if (rotor == RotorSensing::resolver) check_resolver(s, motor, out);
}

}  // namespace sixstep::study
