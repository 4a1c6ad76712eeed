// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/run_rig.hpp"

namespace sixstep::study {

base::Problems run_sensed_on_general(const Scenario& scenario, Compiled compiled, Observers& w,
                                     Outcome& out) {
  return detail::run_chosen<rig::SensedDrive, detail::OnGeneralPlant>(scenario, std::move(compiled), w, out);
}

}  // namespace sixstep::study
