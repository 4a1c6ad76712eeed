// SPDX-License-Identifier: Apache-2.0
// timeline_of() sorts reference, load steps, broken lines, requests and [[at]] events into the one timeline
// of a run.
#pragma once
#include "sixstep/rig/timeline.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Requires that check() found nothing.
rig::Timeline timeline_of(const Scenario& scenario);

/// True if a Hall line breaks anywhere in the run.
bool breaks_a_hall_line(const Scenario& scenario);
/// True if a wire of the motor breaks or a switch fails during the run.
bool breaks_wire_or_switch(const Scenario& scenario);
/// True if any wire between board and motor or probes is crossed, or a Hall line is inverted, at the start or
/// later.
bool crosses_wires(const Scenario& scenario);
/// True if a Hall line reads its probe inverted at any time.
bool inverts_a_hall_line(const Scenario& scenario);
/// True if the Hall code can differ from the code of the back-EMF's sector, because a key of [sensors]
/// displaces or delays the Hall edges or adds glitches.
bool displaces_probes(const Scenario& scenario);

/// Highest voltage of the source during the run.
double highest_supply_V(const Scenario& scenario);

}  // namespace sixstep::study
