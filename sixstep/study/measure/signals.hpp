// SPDX-License-Identifier: Apache-2.0
// A signal over one segment as a polynomial, which the figures of merit integrate and search.
#pragma once
#include <vector>

#include "sixstep/plant/view.hpp"
#include "sixstep/rig/field_telemetry.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/series/extremes.hpp"
#include "sixstep/study/measure/modulator_view.hpp"
#include "sixstep/study/scenario/signal_choices.hpp"

namespace sixstep::study {

using Series = series::Coefficients<double>;

/// The data of a segment that figures read. It has one type for all firmwares, so that the figures are
/// compiled once.
struct SegmentView {
  plant::View plant;
  ModulatorView modulator;
  double t_s = 0.0;  ///< beginning of the segment
  double current_reference_A = 0.0, speed_reference_rad_s = 0.0, position_reference_deg = 0.0, setpoint = 0.0;
  rig::FieldTelemetry field{};  ///< values of a field-oriented drive
  plant::Gates gates{};         ///< gates of the board's legs
  int board_sector = 0;         ///< the rotor's sector according to the board
  int probe_sector = 0;         ///< sector of the motor's Hall code
  bool ticked = false;          ///< true: a control sample is at the segment's beginning
};
template <class Rig>
SegmentView segment_view(const Rig& rig) {
  return {.plant = plant::View(rig.plant()),
          .modulator = ModulatorView(rig.modulator()),
          .t_s = rig.now().seconds(),
          .current_reference_A = rig.current_reference_A(),
          .speed_reference_rad_s = rig.speed_reference_rad_s(),
          .position_reference_deg = rig.position_reference_deg(),
          .setpoint = rig.setpoint(),
          .field = rig::field_held(rig.firmware()),
          .gates = rig.leg_gates(),
          .board_sector = rig.board_sector(),
          .probe_sector = rig.probe_sector(),
          .ticked = rig.ticked()};
}

/// Motor current i_m = (i_p - i_n)/2 of the positive pair of a sector (model.md 3), as weights of i_a, i_b,
/// i_c.
inline plant::PerLeg<double> motor_current_weights(int sector) {
  const control::Pair pair = control::positive_pair(static_cast<std::uint8_t>(sector));
  plant::PerLeg<double> w{};
  w[static_cast<std::size_t>(pair.source)] = 0.5;
  w[static_cast<std::size_t>(pair.sink)] = -0.5;
  return w;
}

/// The duty in effect, negative if its source leg differs from the source leg of the positive pair of the
/// board's sector. With armed comparators it is the state of the upper switch, with three legs the largest
/// difference of two duties.
double signed_duty(const ModulatorView& modulator, int sector);

/// is_cut(): whether a signal is not one polynomial of degree max_degree or less over the whole segment.
/// cuts_of(): the points of [from, to] between which the signal is such a polynomial, both ends included.
bool is_cut(const SegmentView& g, Signal signal);
std::vector<double> cuts_of(const SegmentView& g, Signal signal, double from, double to);

/// A signal over [from, to] of the segment, without a cut inside, as a polynomial of its own fraction s in
/// [0, 1].
struct Piece {
  Series c{};
  int degree = 0;
};
Piece piece_of(const SegmentView& g, Signal signal, double from, double to);

/// Calls visit(piece, from, to) for the parts of [from, to] in order. Most signals have one part; nothing is
/// allocated.
template <class Visit>
void for_each_piece(const SegmentView& g, Signal signal, double from, double to, Visit&& visit) {
  if (!is_cut(g, signal)) return visit(piece_of(g, signal, from, to), from, to);
  const std::vector<double> cuts = cuts_of(g, signal, from, to);
  for (std::size_t n = 0; n + 1 < cuts.size(); ++n)
    visit(piece_of(g, signal, cuts[n], cuts[n + 1]), cuts[n], cuts[n + 1]);
}

/// A signal's value at the segment's beginning.
double signal_now(const SegmentView& g, Signal signal);

/// Bounds of a signal over the whole segment, from the expansion's own bounds. They are wider than the curve,
/// by more than rounding. Infinite if no bound is available.
series::Extremes<double> signal_bounds(const SegmentView& g, Signal signal);

}  // namespace sixstep::study
