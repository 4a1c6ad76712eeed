// SPDX-License-Identifier: Apache-2.0
// Random logs of a motor turned by hand or by a drill, with their true values. The code shares with the
// tested code only the conventions of docs/reference/notation.md. The models of motion, probes, wires and
// noise are independent of the tested code: a torque moves the shaft, while identification assumes a smooth
// motion.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "tests/analysis/identification/normal.hpp"

namespace sixstep::testing {

enum class Turning { hand, strokes, drill, coast, to_and_fro };

/// The true values of a log.
struct HallTruth {
  std::uint64_t seed = 0;
  Turning turning = Turning::hand;
  double row_s = 1e-4;
  double offset_deg = 0.0, hysteresis_deg = 0.0, jitter_deg = 0.1, delay_s = 0.0;
  std::array<double, 6> own_deg{};  ///< angle error of each edge; the sum is 0
  int pole_pairs = 1;
  std::array<double, 8> scattered_deg{};  ///< additional angle error of all edges of each pole pair
  std::array<int, 3> probe_at_pin{0, 1, 2};
  int inverted = 0;  ///< each set bit inverts a line of the code
  bool spaced_60 = false;
  bool backward = false;       ///< the hand turns the shaft in the negative direction
  double turns = 20.0;         ///< electrical turns
  double usual_turns_s = 5.0;  ///< electrical turns per second
  double glitches_s = 0.0;     ///< number per second of single rows with one wrong line
  double bursts_s = 0.0;       ///< number per second of intervals in which a loose contact makes one line
                               ///< wrong in every other row
  int burst_rows = 0;          ///< number of rows of the longest burst
  analysis::RecordedVoltages voltages = analysis::RecordedVoltages::none;
  int channels = 3;
  double flux_Vs = 5e-3;                ///< peak flux linkage of a phase's fundamental
  std::array<double, 3> harmonics{};    ///< 5th, 7th, 11th harmonic, relative to the fundamental
  double noise_V = 0.01, step_V = 0.0;  ///< noise_V: standard deviation of white noise; step_V: step of the
                                        ///< converter
  std::array<double, 3> channel_offset_V{};
};

/// The code of probes 1, 2, 3 (bits 2, 1, 0) in a sector. For probes 120 degrees apart, the codes are from
/// docs/reference/notation.md; for 60 degrees, they are from hall.hpp.
inline int probe_code(int sector, bool spaced_60) {
  constexpr int apart_120[] = {0b100, 0b110, 0b010, 0b011, 0b001, 0b101};
  constexpr int apart_60[] = {0b110, 0b111, 0b011, 0b001, 0b000, 0b100};
  const int n = ((sector % 6) + 6) % 6;
  return spaced_60 ? apart_60[n] : apart_120[n];
}

inline int pin_code(const HallTruth& t, int sector) {
  const int probes = probe_code(sector, t.spaced_60);
  int pins = 0;
  for (int pin = 0; pin < 3; ++pin)
    if ((probes >> (2 - t.probe_at_pin[static_cast<std::size_t>(pin)]) & 1) != 0) pins |= 1 << (2 - pin);
  return pins ^ t.inverted;
}

/// Speed of a shaft with torque and friction, in electrical turns per second.
class Shaft {
 public:
  Shaft(const HallTruth& t, Draw& draw)
      : t_(t), draw_(draw), speed_(t.turning == Turning::coast ? 2.0 * t.usual_turns_s : 0.0) {
    wobble_ = draw.between(0.0, 0.05);
    phase_ = draw.between(0.0, 6.28);
    mechanical_ = 1.0 / (2 + draw.one_of(7));
    if (t.turning == Turning::drill) speed_ = t.usual_turns_s;
    if (t.turning == Turning::hand) speed_ = t.usual_turns_s * draw.between(0.2, 1.0);
  }
  double speed() const { return speed_; }

  void pass(double dt, double angle_turns) {
    time_ += dt;
    const double usual = t_.usual_turns_s;
    double wanted = usual;
    double rate = 4.0;
    switch (t_.turning) {
      case Turning::hand:  // a hand that changes its target speed at random instants
        if (time_ > next_) {
          wish_ = draw_.between(0.1, 1.8) * usual;
          next_ = time_ + draw_.decades(0.1, 1.0);
        }
        wanted = wish_;
        rate = 8.0;
        break;
      case Turning::strokes:  // fingers push, then the rotor coasts
        if (time_ > next_) {
          pushing_ = !pushing_;
          wish_ = draw_.between(0.8, 2.5) * usual;
          next_ = time_ + (pushing_ ? draw_.between(0.1, 0.4) : draw_.between(0.1, 0.6));
        }
        wanted = pushing_ ? wish_ : 0.0;
        rate = pushing_ ? 12.0 : 1.5;
        break;
      case Turning::drill:
        wanted = usual * (1.0 + wobble_ * std::sin(6.2832 * angle_turns * mechanical_ + phase_));
        rate = 40.0;
        break;
      case Turning::coast:
        wanted = 0.0;
        rate = 0.4 * usual / t_.turns * 4.0;
        break;
      case Turning::to_and_fro:
        if (time_ > next_) {
          wish_ = draw_.between(0.4, 1.6) * usual * (wish_ > 0 ? -1.0 : 1.0);
          next_ = time_ + draw_.between(0.3, 1.2);
        }
        wanted = wish_;
        rate = 6.0;
        break;
    }
    // The torque follows its demand with a lag, so it changes smoothly.
    force_ += dt * 25.0 * (rate * (wanted - speed_) - force_);
    speed_ += dt * force_;
  }

 private:
  const HallTruth& t_;
  Draw& draw_;
  double speed_ = 0.0, force_ = 0.0, time_ = 0.0, next_ = 0.0, wish_ = 1.0, wobble_ = 0.0, phase_ = 0.0,
         mechanical_ = 1.0;
  bool pushing_ = false;
};

/// Switching of the probes. Each edge has an angle error, half the hysteresis, and a jitter that is drawn
/// anew at each switching. The line changes after a delay.
class Probes {
 public:
  Probes(const HallTruth& t, Draw& draw, double angle_deg) : t_(t), draw_(draw) {
    sector_ = static_cast<int>(std::floor((angle_deg - t.offset_deg) / 60.0));
    while (angle_deg >= place(sector_ + 1)) ++sector_;
    while (angle_deg < place(sector_)) --sector_;
    draw_again();
  }
  int sector() const { return sector_; }
  /// Times at which the sector changes while the rotor moves from one angle to the next.
  void move(double from_s, double from_deg, double to_s, double to_deg,
            std::vector<std::pair<double, int>>& changes) {
    for (;;) {
      const double up = place(sector_ + 1) + 0.5 * t_.hysteresis_deg + up_;
      const double down = place(sector_) - 0.5 * t_.hysteresis_deg + down_;
      double at = 0.0;
      int moved = 1;
      if (to_deg >= up) {
        at = up;
        ++sector_;
      } else if (to_deg < down) {
        at = down;
        moved = -1;
        --sector_;
      } else {
        return;
      }
      const double part =
          to_deg == from_deg ? 1.0 : std::min(1.0, std::max(0.0, (at - from_deg) / (to_deg - from_deg)));
      changes.emplace_back(from_s + part * (to_s - from_s) + t_.delay_s, sector_);
      draw_again();
      // After a probe has switched, it switches back only after the rotor has reversed.
      if (moved > 0)
        down_ = std::min(down_, at - 1e-9 - (place(sector_) - 0.5 * t_.hysteresis_deg));
      else
        up_ = std::max(up_, at + 1e-9 - (place(sector_ + 1) + 0.5 * t_.hysteresis_deg));
    }
  }

 private:
  double place(int n) const {
    const int edges = 6 * t_.pole_pairs, on_shaft = ((n % edges) + edges) % edges;
    return 60.0 * n + t_.offset_deg + t_.own_deg[static_cast<std::size_t>(on_shaft % 6)] +
           t_.scattered_deg[static_cast<std::size_t>(on_shaft / 6)];
  }
  void draw_again() {
    up_ = t_.jitter_deg * normal(draw_);
    down_ = t_.jitter_deg * normal(draw_);
  }
  const HallTruth& t_;
  Draw& draw_;
  int sector_ = 0;
  double up_ = 0.0, down_ = 0.0;
};

/// A contact that is loose at random times. While it is loose, one line is wrong in every other row.
class LooseContact {
 public:
  explicit LooseContact(const HallTruth& t) : t_(t), draw_(t.seed ^ 0x9e3779b9u) {}
  int wrong_bits() {
    if (t_.bursts_s == 0.0) return 0;
    if (left_ == 0 && draw_.chance(t_.bursts_s * t_.row_s)) {
      left_ = 2 + draw_.one_of(t_.burst_rows);
      line_ = draw_.one_of(3);
    }
    if (left_ == 0) return 0;
    --left_;
    return draw_.chance(0.5) ? 1 << line_ : 0;
  }

 private:
  const HallTruth& t_;
  Draw draw_;
  int left_ = 0, line_ = 0;
};

/// Phase voltages at the electrical angle theta, rad, and the electrical speed w, rad/s.
inline std::array<double, 3> phase_emf(const HallTruth& t, double theta, double w) {
  std::array<double, 3> e{};
  constexpr int orders[] = {5, 7, 11};
  for (int k = 0; k < 3; ++k) {
    const double x = theta - std::numbers::pi / 3 - 2 * std::numbers::pi / 3 * k;
    double f = std::cos(x);
    for (std::size_t n = 0; n < 3; ++n) f += t.harmonics[n] * std::cos(orders[n] * x);
    e[static_cast<std::size_t>(k)] = t.flux_Vs * w * f;
  }
  return e;
}

struct DrawnLog {
  HallTruth truth;
  analysis::HallLog log;
  double forward_turns = 0.0, backward_turns = 0.0;
};

inline DrawnLog drawn_log(const HallTruth& truth) {
  DrawnLog out{truth, {}, 0.0, 0.0};
  const HallTruth& t = truth;
  Draw draw(t.seed ^ 0x5bd1e995u);
  Shaft shaft(t, draw);
  const double step_s = std::min(t.row_s, 0.002 / t.usual_turns_s);
  double deg = draw.between(0.0, 360.0), time = 0.0, next_row = 0.0, passed = 0.0;
  const double way = t.backward ? -1.0 : 1.0;
  Probes probes(t, draw, deg);
  LooseContact contact(t);
  int shown = probes.sector();
  std::vector<std::pair<double, int>> changes;
  std::size_t done = 0;
  out.log.voltages = t.voltages;
  const double start_s = draw.between(0.0, 1.0) * 100.0;  // clocks do not start at 0
  for (std::size_t n = 0; passed < t.turns && n < 40'000'000; ++n) {
    const double before = deg, w = way * shaft.speed();
    deg += 360.0 * w * step_s;
    passed += std::fabs(w) * step_s;
    shaft.pass(step_s, passed);
    if (shaft.speed() < 0.02 * t.usual_turns_s && t.turning == Turning::coast) break;
    probes.move(time, before, time + step_s, deg, changes);
    time += step_s;
    while (next_row <= time) {
      while (done < changes.size() && changes[done].first <= next_row) shown = changes[done++].second;
      int code = pin_code(t, shown);
      if (draw.chance(t.glitches_s * t.row_s)) code ^= 1 << draw.one_of(3);
      code ^= contact.wrong_bits();
      out.log.t_s.push_back(start_s + next_row);
      out.log.codes.push_back(static_cast<std::uint8_t>(code));
      if (t.voltages != analysis::RecordedVoltages::none) {
        const double part = (next_row - (time - step_s)) / step_s;
        const double theta = (before + part * (deg - before)) * std::numbers::pi / 180.0;
        const std::array<double, 3> e = phase_emf(t, theta, 2 * std::numbers::pi * w);
        const double common = t.voltages == analysis::RecordedVoltages::terminals ? normal(draw) * 0.2 : 0.0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(t.channels); ++k) {
          double u = t.voltages == analysis::RecordedVoltages::lines ? e[k] - e[(k + 1) % 3] : e[k] + common;
          u += t.channel_offset_V[k] + t.noise_V * normal(draw);
          if (t.step_V > 0) u = t.step_V * std::round(u / t.step_V);
          out.log.u_V[k].push_back(u);
        }
      }
      next_row += t.row_s;
    }
    if (changes.size() > 1000 && done == changes.size()) {
      changes.clear();
      done = 0;
    }
    (w > 0 ? out.forward_turns : out.backward_turns) += std::fabs(w) * step_s;
  }
  return out;
}

/// A random log with the faults of a bench: any wires and probes may be wrong, and rows are dense or sparse.
inline HallTruth drawn_truth(std::uint64_t seed, bool with_voltages) {
  Draw draw(seed);
  HallTruth t;
  t.seed = seed;
  t.turning = static_cast<Turning>(draw.one_of(5));
  t.turns = draw.decades(6.0, 80.0);
  t.usual_turns_s = draw.decades(1.0, 40.0);
  t.row_s = 1.0 / (t.usual_turns_s * 6.0 * draw.decades(12.0, 300.0));
  t.offset_deg = draw.chance(0.7) ? draw.between(-10.0, 10.0) : draw.between(-29.0, 29.0);
  double mean = 0.0;
  const double misplaced = draw.decades(0.3, 5.0);
  for (double& own : t.own_deg) mean += own = misplaced * normal(draw);
  for (double& own : t.own_deg) own = std::fmax(-12.0, std::fmin(12.0, own - mean / 6.0));
  mean = 0.0;
  for (const double own : t.own_deg) mean += own;
  for (double& own : t.own_deg) own -= mean / 6.0;
  t.jitter_deg = draw.decades(0.05, 1.5);
  t.hysteresis_deg = draw.chance(0.5) ? draw.between(0.0, 6.0) : 0.0;
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const int order = draw.one_of(6);
  for (std::size_t k = 0; k < 3; ++k) t.probe_at_pin[k] = orders[order][k];
  t.inverted = draw.chance(0.5) ? 0 : draw.one_of(8);
  t.spaced_60 = draw.chance(0.2);
  t.backward = draw.chance(0.4);
  t.glitches_s = draw.chance(0.5) ? 0.0 : draw.decades(0.02, 2.0) * t.usual_turns_s;
  if (with_voltages) {
    t.voltages = draw.chance(0.6) ? analysis::RecordedVoltages::lines : analysis::RecordedVoltages::terminals;
    t.channels = t.voltages == analysis::RecordedVoltages::lines && draw.chance(0.3) ? 2 : 3;
    t.flux_Vs = draw.decades(1e-3, 3e-2);
    if (draw.chance(0.5)) t.harmonics = {0.04, -0.0204, -0.00826};  // a trapezoid of 120 degrees
    if (draw.chance(0.3)) t.harmonics = {draw.between(-0.1, 0.1), draw.between(-0.05, 0.05), 0.0};
    t.delay_s = draw.chance(0.5) ? draw.decades(1e-6, 1e-4) : 0.0;
    const double usual_V = t.flux_Vs * 6.28 * t.usual_turns_s;
    t.noise_V = usual_V * draw.decades(0.003, 0.3);
    t.step_V = draw.chance(0.5) ? usual_V * draw.decades(0.002, 0.1) : 0.0;
    for (double& offset : t.channel_offset_V) offset = usual_V * 0.2 * normal(draw);
  }
  return t;
}

}  // namespace sixstep::testing
