// SPDX-License-Identifier: Apache-2.0
// What [[at]] asks for that the run at hand cannot do.
#include "sixstep/base/written.hpp"
#include "sixstep/study/check/reference.hpp"

namespace sixstep::study {

namespace {

using base::written;

bool changes_nothing(const At& at) {
  return !at.reference && !at.supply.voltage_V && !at.supply.sinks && !at.load.torque_Nm && !at.load.locked &&
         !at.sensors.hall_break && at.request == DriveRequest::none;
}

void check_event(const At& at, const std::string& where, const Scenario& s, base::Problems& out) {
  if (!(at.time_s < s.duration_s))
    out.push_back({where + ".time_s", written(at.time_s),
                   "lies behind the end of the run (duration_s = " + written(s.duration_s) + ")",
                   "lengthen duration_s or drop the event"});
  if (changes_nothing(at))
    out.push_back({where + ".time_s", written(at.time_s), "is when nothing changes",
                   "give a reference, a value of supply or load, sensors.hall_break or request"});
  if (at.supply.sinks == false && !(s.supply.capacitance_F > 0))
    out.push_back({where + ".supply.sinks", "false", "needs a bus whose voltage can rise",
                   "give supply.resistance_ohm and supply.capacitance_F"});
  const std::optional<double>& limit_V = s.control.regeneration.limit_V;
  if (at.supply.voltage_V && limit_V && !(*at.supply.voltage_V < *limit_V))
    out.push_back({where + ".supply.voltage_V", written(*at.supply.voltage_V),
                   "must stay below control.regeneration.limit_V = " + written(*limit_V),
                   "the drive could not brake any more"});
  if (at.reference && s.control.mode == control::Mode::off)
    out.push_back({where + ".reference", "", "asks for something that control.mode = \"off\" does not do",
                   "set control.mode"});
  if (at.request != DriveRequest::none && s.control.drive != FirmwareKind::product)
    out.push_back(
        {where + ".request", "", "is heard by the product drive only", "set control.drive = \"product\""});
}

}  // namespace

void check_events(const Scenario& s, base::Problems& out) {
  for (std::size_t n = 0; n < s.at.size(); ++n) check_event(s.at[n], "at[" + std::to_string(n) + "]", s, out);
}

}  // namespace sixstep::study
