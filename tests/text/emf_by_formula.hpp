// SPDX-License-Identifier: Apache-2.0
// A recording of one motor in the format of any instrument. The motor has 7 pole pairs and a flux linkage of
// 3.12 mWb, and turns at 1000 rpm. Formulas give all voltages. Each file must therefore give sqrt(3) 7 3.12 =
// 37.83 mV s/rad between two terminals.
#pragma once
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "sixstep/analysis/identification/emf/emf.hpp"
#include "text/recording/bench_recordings.hpp"

namespace text::emf_by_formula {

inline constexpr int rows = 500;
inline constexpr double dt = 1e-4, flux_mWb = 3.12, pairs = 7.0;
inline constexpr double w = pairs * 1000.0 * std::numbers::pi / 30.0;  // electrical
inline const double right_mV_s = std::sqrt(3.0) * pairs * flux_mWb,
                    peak_V = std::sqrt(3.0) * 1e-3 * flux_mWb * w;

inline double u_ab(double t) { return peak_V * std::cos(w * t + 0.3); }
inline double u_bc(double t) { return peak_V * std::cos(w * t + 0.3 - 2.0 * std::numbers::pi / 3.0); }

/// A file with the heading `head`. The function `row` writes a row for each sample from the time and the two
/// voltages.
inline std::string table(const std::string& head,
                         const std::function<std::string(int n, double t, double a, double b)>& row) {
  std::string out = head;
  for (int n = 0; n < rows; ++n) out += row(n, dt * n, u_ab(dt * n), u_bc(dt * n));
  return out;
}
inline std::string plain(const std::string& head, const std::string& format = "{:.6f},{:.5f},{:.5f}\n",
                         double per_s = 1.0, double per_V = 1.0) {
  return table(head, [&](int, double t, double a, double b) {
    return fmt::format(fmt::runtime(format), t * per_s, a * per_V, b * per_V);
  });
}
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}
inline std::string with_commas(const std::string& text) { return replaced(text, ".", ","); }

struct Seen {
  std::string problem;
  Notes notes;
  std::size_t rows = 0;
  double seconds = 0.0;
  std::vector<std::string> channels;
  double line_peak_mV_s = 0.0;
  bool backward = false;
};
inline Seen seen(const std::string& bytes, const BenchColumns& columns = {}) {
  Seen out;
  const auto recording = read_recording("r.csv", bytes);
  if (!recording) return out.problem = to_string(recording.problems()[0]), out;
  const auto record = emf_record_of(*recording, columns, out.notes);
  if (!record) return out.problem = to_string(record.problems()[0]), out;
  const auto found = analysis::measure_emf({*record, 7, {}});
  if (!found) return out.problem = to_string(found.problems()[0]), out;
  out.rows = found->rows;
  out.seconds = found->seconds;
  out.backward = found->backward;
  for (const auto& c : found->channels) out.channels.push_back(c.name);
  out.line_peak_mV_s = 1e3 * pairs * found->constants.line_peak.value;
  return out;
}
inline const BenchColumns between_lines{
    .hall = {}, .voltages = {}, .between = analysis::EmfBetween::lines, .interval_s = {}};

/// The fit of an amplitude over the rows has the standard deviation step/sqrt(12) sqrt(2/rows). The tolerance
/// is six standard deviations.
inline void expect_right(const std::string& bytes, double step_V = 1e-5,
                         const BenchColumns& columns = between_lines, std::size_t channels = 2) {
  const Seen found = seen(bytes, columns);
  ASSERT_EQ(found.problem, "") << bytes.substr(0, 300);
  EXPECT_THAT(found.channels, ::testing::SizeIs(channels));
  const double deviation = std::max(step_V, 1e-6) / std::sqrt(12.0) * std::sqrt(2.0 / rows) / peak_V;
  EXPECT_NEAR(found.line_peak_mV_s / right_mV_s, 1.0, 6.0 * deviation) << bytes.substr(0, 300);
  EXPECT_NEAR(found.seconds, dt * (rows - 1), 1e-9);
}

}  // namespace text::emf_by_formula
