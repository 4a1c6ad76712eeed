// SPDX-License-Identifier: Apache-2.0
// The Hall probes (model.md 10): they convert the rotor's angle to the code of the Hall lines. With the
// general kernel they can have mounting errors, a spacing of 60 degrees, delays and glitches. With the lean
// kernel the code follows the rotor's sectors exactly, without computing time.
#pragma once
#include <array>
#include <optional>

#include "sixstep/plant/hall.hpp"
#include "sixstep/plant/hall_probes.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::plant::general {
template <class Real>
class Plant;
}  // namespace sixstep::plant::general

namespace sixstep::rig {

/// Mounting of a motor's probes.
struct ProbeGiven {
  plant::HallPlacement placement{};
  bool spaced_60 = false;
  std::int64_t delay_ticks = 0;  ///< delay from an edge's angle to the change of its line, ps
};

/// Probes whose edges are exactly the edges of the sectors.
template <class Real>
class SectorProbes {
 public:
  SectorProbes() = default;
  SectorProbes(const ProbeGiven&, const plant::State<Real>&) {}
  static constexpr bool mounted() { return false; }
  /// Code of the rotor's sector, H1 H2 H3 as bits 2, 1, 0.
  static constexpr std::uint8_t code(int sector) { return plant::hall_code(sector); }
  static constexpr std::int64_t sector(std::int64_t own) { return own; }
};

template <class Real>
class MountedProbes {
 public:
  /// Makes probes that are mounted() if, because of placement or delay, their edges differ from the edges of
  /// the sectors.
  MountedProbes(const ProbeGiven& given, const plant::State<Real>& at)
      : delay_ticks_(given.delay_ticks), spaced_60_(given.spaced_60) {
    if (given.placement.as_sectors() && given.delay_ticks == 0) return;
    probes_.emplace(given.placement, at);
    shown_ = probes_->shown();
  }

  /// True if the probes' edges are not the edges of the sectors.
  bool mounted() const { return probes_.has_value(); }
  /// Code of the lines while the rotor is in `sector`, 0 to 5.
  std::uint8_t code(int sector) const {
    const int shown = mounted() ? static_cast<int>((shown_ % 6 + 6) % 6) : sector;
    const std::uint8_t code = spaced_60_ ? plant::hall_code_60(shown) : plant::hall_code(shown);
    return code ^ glitch_;
  }
  /// Sector that the probes show while the rotor is in sector `own`, both counted over all turns.
  std::int64_t sector(std::int64_t own) const { return mounted() ? shown_ : own; }

  template <class Visit>
  void guards(const plant::Expansion<Real>& y, std::int64_t sector, Visit&& visit) const {
    if (mounted()) probes_->guards(y, sector, visit);
  }
  /// Call it when the rotor has passed an edge of the probes. The line changes now, or after the delay.
  void pass(plant::ProbeEdge which, const sim::Instant& now) {
    probes_->pass(which);
    if (delay_ticks_ == 0 || count_ == late_.size()) {
      shown_ = probes_->shown();
      return;
    }
    late_[(first_ + count_++) % late_.size()] = {{now.ticks + delay_ticks_, now.offset}, probes_->shown()};
  }
  /// Instant at which the next delayed edge changes the lines.
  sim::Instant next() const { return count_ == 0 ? sim::Instant::never() : late_[first_].at; }
  /// Changes the lines if a delayed edge is due; returns false if no edge is due.
  bool show(const sim::Instant& now) {
    if (count_ == 0 || now < late_[first_].at) return false;
    shown_ = late_[first_].sector;
    first_ = (first_ + 1) % late_.size();
    --count_;
    return true;
  }
  /// Begins or ends a glitch: inverts the lines in `lines`, a mask of a code's bits.
  void glitch(std::uint8_t lines) { glitch_ ^= lines; }

 private:
  struct Late {
    sim::Instant at;
    std::int64_t sector = 0;
  };

  std::optional<plant::HallProbes<Real>> probes_;
  std::array<Late, 64> late_{};  ///< ring buffer; larger than the number of edges within any delay
  std::size_t first_ = 0, count_ = 0;
  std::int64_t shown_ = 0, delay_ticks_ = 0;
  bool spaced_60_ = false;
  std::uint8_t glitch_ = 0;
};

/// Type of a rig's probes, by its plant.
template <class Plant>
struct ProbesFor {
  using type = SectorProbes<typename Plant::Real>;
};
template <class Real>
struct ProbesFor<plant::general::Plant<Real>> {
  using type = MountedProbes<Real>;
};

}  // namespace sixstep::rig
