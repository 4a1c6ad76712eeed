// SPDX-License-Identifier: Apache-2.0
// Reads the winding's loss of a run in twenty parts, from which a remark concludes what the drive would keep up after the
// run.
#pragma once
#include <array>
#include <optional>

namespace sixstep::study {

class EndWatch {
 public:
  /// The winding's loss up to an instant of the run, and the speed then.
  struct Mark {
    double t_s = 0.0;
    double copper_J = 0.0;  ///< as lost
    double cold_J = 0.0;    ///< the same currents' loss at the temperature of the sheet's resistance
    double speed_rad_s = 0.0;
  };
  /// Shortest run with such a prediction. Shorter runs usually test a step of the current, not a steady
  /// state.
  static constexpr double least_s = 0.05;

  EndWatch() = default;
  explicit EndWatch(double duration_s) : duration_s_(duration_s) {}

  /// Called from time to time and at the end.
  void look(const Mark& now);

  /// The loss that the run keeps up at its end: the mean since `since_s`.
  struct Kept {
    double copper_W = 0.0, cold_W = 0.0, since_s = 0.0;
    double speed_rad_s = 0.0;        ///< at the end
    bool steady = false;             ///< each part's loss differs from the mean by a tenth at most
    std::optional<double> rad_s2{};  ///< acceleration, if the speed changes evenly over the last two fifths
  };
  /// A steady loss counts from its beginning. Of another loss the lowest mean counts, over the last half, fifth or tenth.
  /// Empty if the run is too short to tell, or ended early.
  std::optional<Kept> kept() const;
  /// A steady loss that began in the last fifth, lasts a twentieth of the run at least, and `brief_s`. `rad_s2`: over
  /// this time.
  std::optional<Kept> kept_briefly() const;
  static constexpr double brief_s = 0.019;  ///< 20 ms less the way to the next look

 private:
  static constexpr int parts = 20;
  static constexpr int fine_parts = 8;  ///< of the last tenth
  const Mark& at(int part) const { return marks_[static_cast<std::size_t>(part)]; }
  bool is_whole(const Mark& begin, const Mark& end) const;
  bool steady_from(int part) const;
  std::optional<double> acceleration() const;
  /// The loss since `begin`, if two of the fine parts since then are whole, and each whole one within a tenth of its mean.
  std::optional<Kept> steady_since(const Mark& begin, int fine) const;

  double duration_s_ = 0.0;
  std::array<Mark, parts + 1> marks_{};  ///< the start, and the first look at or after each twentieth
  std::array<Mark, fine_parts> fine_{};  ///< the first look at or after each eightieth from nine tenths on
  int filled_ = 1, fine_filled_ = 0;
  Mark last_{};
};

}  // namespace sixstep::study
