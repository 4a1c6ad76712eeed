// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/bode/multisine.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {

using design::Complex;

namespace {

/// exp(j 2 pi n/N) for n = 0 .. N - 1. A line's phase at a sample is always one of these values.
std::vector<Complex> roots_of_one(std::size_t count) {
  std::vector<Complex> roots(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double turn = 2 * base::pi * static_cast<double>(n) / static_cast<double>(count);
    roots[n] = {base::cos(turn), base::sin(turn)};
  }
  return roots;
}

/// Amplitude and phase of a line: 2/N sum y[n] exp(-j 2 pi line n/N), with N samples y[n].
Complex at_line(const std::vector<Complex>& roots, const double* y, std::size_t line) {
  Complex sum{};
  for (std::size_t n = 0, turn = 0; n < roots.size(); ++n, turn = (turn + line) % roots.size())
    sum = sum + Complex{y[n] * roots[turn].re, -y[n] * roots[turn].im};
  const double scale = 2.0 / static_cast<double>(roots.size());
  return {sum.re * scale, sum.im * scale};
}

LineAnswer line_answer(const std::vector<Complex>& periods, Complex input) {
  Complex sum{};
  double squares = 0.0;
  for (const Complex& y : periods) {
    sum = sum + y;
    squares += y.square();
  }
  const double count = static_cast<double>(periods.size());
  const Complex mean{sum.re / count, sum.im / count};
  LineAnswer out{.gain = mean / input};
  out.coherence = squares > 0.0 ? count * mean.square() / squares : 0.0;
  const double stray = std::fmax(0.0, squares - count * mean.square());
  if (periods.size() > 1 && mean.square() > 0.0)
    out.scatter = std::sqrt(stray / (count * (count - 1.0)) / mean.square());
  return out;
}

/// Mean square of y about its mean.
double power_of(const double* y, std::size_t count) {
  double mean = 0.0, sum = 0.0;
  for (std::size_t n = 0; n < count; ++n) mean += y[n];
  mean /= static_cast<double>(count);
  for (std::size_t n = 0; n < count; ++n) sum += (y[n] - mean) * (y[n] - mean);
  return sum / static_cast<double>(count);
}

}  // namespace

std::vector<std::size_t> odd_lines(std::size_t last, std::size_t count) {
  std::vector<std::size_t> lines;
  const double top = static_cast<double>(std::max<std::size_t>(last, 1));
  for (std::size_t n = 0; n < count; ++n) {
    const double part = count > 1 ? static_cast<double>(n) / static_cast<double>(count - 1) : 0.0;
    std::size_t line = static_cast<std::size_t>(base::exp(base::log(top) * part) / 2) * 2 + 1;
    if (!lines.empty() && line <= lines.back()) line = lines.back() + 2;
    if (line > last) break;
    lines.push_back(line);
  }
  return lines;
}

std::vector<double> samples_of(const Multisine& signal) {
  const std::vector<Complex> roots = roots_of_one(signal.samples);
  std::vector<double> r(signal.samples, 0.0);
  const double count = static_cast<double>(signal.lines.size());
  for (std::size_t k = 0; k < signal.lines.size(); ++k) {
    const double place = static_cast<double>(k), phase = -base::pi * place * (place - 1.0) / count;
    const Complex begin{base::cos(phase), base::sin(phase)};
    for (std::size_t n = 0, turn = 0; n < r.size(); ++n, turn = (turn + signal.lines[k]) % r.size())
      r[n] += (begin * roots[turn]).re;
  }
  double peak = 0.0;
  for (const double x : r) peak = std::fmax(peak, std::fabs(x));
  if (peak > 0.0)
    for (double& x : r) x *= signal.amplitude / peak;
  return r;
}

Answer answer_to(const Multisine& signal, const std::vector<double>& output) {
  Answer answer;
  const std::size_t N = signal.samples, periods = N > 0 ? output.size() / N : 0;
  if (periods == 0) return answer;
  const std::vector<Complex> roots = roots_of_one(N);
  const std::vector<double> input = samples_of(signal);
  double at_lines = 0.0;
  for (const std::size_t line : signal.lines) {
    std::vector<Complex> y(periods);
    for (std::size_t p = 0; p < periods; ++p) {
      y[p] = at_line(roots, output.data() + p * N, line);
      at_lines += y[p].square() / 2 / static_cast<double>(periods);
    }
    answer.lines.push_back(line_answer(y, at_line(roots, input.data(), line)));
  }
  const double all = power_of(output.data(), periods * N);
  answer.beside = all > 0.0 ? std::sqrt(std::fmax(0.0, 1.0 - at_lines / all)) : 0.0;
  return answer;
}

}  // namespace sixstep::analysis
