// SPDX-License-Identifier: Apache-2.0
// Fuzzes the root finder with arbitrary coefficients. The returned root is within the length and is a zero,
// apart from rounding. The polynomial is not negative before it.
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "sixstep/series/first_root.hpp"

namespace {

using namespace sixstep::series;

long double value_of(const Coefficients<double>& c, int degree, long double s) {
  long double v = 0;
  for (int j = degree; j >= 0; --j) v = v * s + c[j];
  return v;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const int degree = 1 + data[0] % max_degree;
  const double length = (1 + data[1]) / 256.0;
  Coefficients<double> c{};
  std::memcpy(c.data(), data + 2, std::min(size - 2, sizeof(double) * static_cast<std::size_t>(degree + 1)));
  double sum = 0;
  for (int j = 0; j <= degree; ++j) {
    if (!(std::fabs(c[j]) < 1e100)) return 0;  // coefficients of guards, and their products, are finite
    if (std::fabs(c[j]) < 1e-100) c[j] = 0;
    sum += std::fabs(c[j]);
  }
  constexpr double eps = 0x1p-52;
  const double noise = 64 * eps * sum;
  // Each coefficient may contribute the noise once to a value that counts as zero. The rounding of the
  // Bernstein form and of an evaluation adds at most 4 (degree + 1) eps of the sum.
  const double error = (degree + 1) * (noise + 4 * eps * sum);
  const auto root = first_root(c, degree, length, noise);
  const bool found = root != sixstep::series::no_root<double>;
  if (found && !(root >= 0 && root <= length)) std::abort();
  const double end = found ? root : length;
  if (found && root > 0 && std::fabs(static_cast<double>(value_of(c, degree, end))) > error) std::abort();
  if (root == 0 && value_of(c, degree, 0) > error) std::abort();
  if (root == 0) return 0;
  for (int k = 0; k <= 64; ++k)
    if (static_cast<double>(value_of(c, degree, end * k / 64.0L)) < -error) std::abort();
  return 0;
}
