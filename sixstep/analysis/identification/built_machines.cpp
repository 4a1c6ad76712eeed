// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/built_machines.hpp"

#include <algorithm>
#include <string>

#include "sixstep/base/written.hpp"

namespace sixstep::analysis {
namespace {

std::string with_pairs(int pole_pairs) {
  return pole_pairs == 0
             ? ""
             : " with " + std::to_string(pole_pairs) + (pole_pairs == 1 ? " pole pair" : " pole pairs");
}

}  // namespace

base::Problems check_built_speed(double electrical_Hz, int pole_pairs) {
  const double rpm = 60.0 * electrical_Hz / std::max(pole_pairs, 1);
  const std::string pairs = with_pairs(pole_pairs);
  if (pole_pairs == 0 && electrical_Hz > most_built_Hz)
    return {{.where = "time",
             .limit = "gives the voltage a frequency of " + base::six_digits(electrical_Hz) +
                      " Hz, and no brushless machine is built for more than " +
                      base::six_digits(most_built_Hz) + " Hz",
             .cure = "check the unit of time and the time from row to row"}};
  if (pole_pairs > 0 && rpm > built_shaft_rpm.high)
    return {
        {.where = "time",
         .limit = "gives the shaft " + base::six_digits(rpm) + " rpm" + pairs +
                  ", and no brushless machine is built for more than " +
                  base::six_digits(built_shaft_rpm.high) + " rpm",
         .cure =
             "check the unit of time, the time from row to row, and whether the motor has more pole pairs"}};
  if (rpm < built_shaft_rpm.low)
    return {{.where = "time",
             .limit = "gives the shaft " + base::three_digits(rpm) + " rpm" + pairs +
                      (pole_pairs == 0 ? " at the most" : "") + ", and a motor that turns below " +
                      base::written(built_shaft_rpm.low) + " rpm has too little back-EMF to measure",
             .cure = std::string("check the unit of time and the time from row to row") +
                     (pole_pairs > 1 ? ", and whether the motor has fewer pole pairs" : "")}};
  return {};
}

base::Problems check_built_constant(double line_peak_V_s, double electrical_Hz, int pole_pairs) {
  const double mV_s = 1e3 * std::max(pole_pairs, 1) * line_peak_V_s;
  if (built_line_mV_s.holds(mV_s)) return {};
  const bool low = mV_s < built_line_mV_s.low;
  const std::string pairs = pole_pairs < 2 ? ""
                            : low          ? ", or the motor has more pole pairs"
                                           : ", or the motor has fewer pole pairs";
  return {{.where = "voltage",
           .limit = "divided by the speed is " + base::three_digits(mV_s) + " mV s/rad, line peak at " +
                    base::three_digits(electrical_Hz) + " Hz" + with_pairs(pole_pairs) +
                    ", and no brushless machine is built with " +
                    (low ? "less than " + base::written(built_line_mV_s.low)
                         : "more than " + base::six_digits(built_line_mV_s.high)) +
                    " mV s/rad",
           .cure = std::string("correct the units of time and voltage or the probe's factor: ") +
                   (low ? "the voltage is too small, or the time is too short"
                        : "the voltage is too great, or the time is too long") +
                   pairs}};
}

}  // namespace sixstep::analysis
