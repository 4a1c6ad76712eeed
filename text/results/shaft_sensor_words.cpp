// SPDX-License-Identifier: Apache-2.0
#include "text/results/shaft_sensor_words.hpp"

#include <fmt/format.h>

namespace text {
namespace {

using Given = std::string (*)(double, std::string_view);

/// Text about the offset between the sensor's zero and the rotor's zero.
std::string mounting(double offset_deg, Given given) {
  return offset_deg == 0.0 ? "" : ", mounted with an offset of " + given(offset_deg, "deg") + " (electrical)";
}

std::string encoder(const study::Sensors& s, bool page, Given given) {
  const study::Encoder& e = s.encoder;
  std::string text = "encoder of ";
  text += page && e.pitch_mm ? "pitch " + given(*e.pitch_mm, "mm") : fmt::format("{} lines", e.lines);
  if (!page) return text + ", edges captured at " + given(s.capture_Hz, "Hz");
  if (!e.referenced) text += ", its index not passed yet";
  if (e.missed_Hz > 0) text += fmt::format(", {} edges missed each second", e.missed_Hz);
  return text + mounting(e.offset_deg, given);
}

std::string absolute(const study::AbsoluteEncoder& e, Given given) {
  return fmt::format("absolute encoder of {} bits, {} late, speed over {} samples", e.bits,
                     given(e.latency_s, "s"), e.speed_samples) +
         mounting(e.offset_deg, given);
}

std::string resolver(const study::Resolver& r, bool page, Given given) {
  const std::string within = "followed within " + given(r.bandwidth_Hz, "Hz");
  std::string text = fmt::format("resolver of {} pole pairs", r.pole_pairs);
  if (!page) return text + ", " + within;
  if (r.reading == sixstep::rig::ResolverReading::tracking)
    return text +
           fmt::format(", {} by a converter chip of {} bits at {}, {} late", within, r.bits,
                       given(r.converter_Hz, "Hz"), given(r.latency_s, "s")) +
           mounting(r.offset_deg, given);
  text += fmt::format(" at {}, {}, {} bits", given(r.excitation_Hz, "Hz"), within, r.bits);
  return text + (r.calibrated ? ", differences between its windings compensated" : "") +
         mounting(r.offset_deg, given);
}

}  // namespace

std::string shaft_sensor_words(const study::Sensors& s, SensorWordsOf reader, Given given) {
  const bool page = reader == SensorWordsOf::page;
  switch (s.rotor) {
    case study::RotorSensing::ideal:
    case study::RotorSensing::hall:
      break;
    case study::RotorSensing::encoder:
      return encoder(s, page, given);
    case study::RotorSensing::absolute:
      return absolute(s.absolute, given);
    case study::RotorSensing::resolver:
      return resolver(s.resolver, page, given);
  }
  return {};
}

}  // namespace text
