// SPDX-License-Identifier: Apache-2.0
// After the unpacking by the page's script, packed rows are equal to the original rows. One zlib stream
// contains planes of differences.
#include "report/packed_rows.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>

namespace SIXSTEP_TEST_FILE {

using report::packed_rows;
using report::PackedRows;

std::string planes_of(const PackedRows& packed) {
  std::string planes(packed.rows * (4 + 2 * packed.columns.size()), '\0');
  uLongf size = planes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.bytes.data()), packed.bytes.size()),
            Z_OK);
  EXPECT_EQ(size, planes.size());
  return planes;
}

/// Reads the differences from the planes. There is one plane for each byte of a difference, starting with the
/// plane `first`.
template <class Count>
std::vector<Count> differences_of(const std::string& planes, std::size_t rows, std::size_t first) {
  std::vector<Count> out(rows);
  for (std::size_t n = 0; n < rows; ++n)
    for (std::size_t plane = 0; plane < sizeof(Count); ++plane) {
      const auto byte = static_cast<unsigned char>(planes[(first + plane) * rows + n]);
      out[n] = static_cast<Count>(out[n] + (Count{byte} << (8 * plane)));
    }
  return out;
}

struct Rows {
  std::vector<double> time, wave, noise;
};
/// The data exceed the window of zlib, so zlib changes its compression method between planes.
Rows some_rows() {
  Rows out;
  std::uint32_t random = 1;
  for (int n = 0; n < 40000; ++n) {
    random = random * 1664525u + 1013904223u;
    out.time.push_back(1.5 + n * 1e-6 + (random >> 12) * 1e-13);
    out.wave.push_back(n % 97 == 0 ? NAN : std::sin(n * 1e-3));
    out.noise.push_back((n / 7 % 40) * 1.0 + (random >> 28) * 1e-3);
  }
  return out;
}

void expect_back(const PackedRows& packed, const Rows& given) {
  const std::string planes = planes_of(packed);
  const auto gaps = differences_of<std::uint32_t>(planes, packed.rows, 0);
  double ticks = 0.0;  // the sum exceeds 32 bits
  for (std::size_t n = 0; n < packed.rows; ++n) {
    ticks += gaps[n];
    ASSERT_NEAR(packed.start_s + packed.tick_s * ticks, given.time[n], 0.51 * packed.tick_s) << n;
  }
  for (const std::size_t column : {0u, 1u}) {
    const auto& [low, step] = packed.columns[column];
    const auto steps = differences_of<std::uint16_t>(planes, packed.rows, 4 + 2 * column);
    std::uint16_t count = 0;
    const std::vector<double>& values = column == 0 ? given.wave : given.noise;
    for (std::size_t n = 0; n < packed.rows; ++n) {
      count = static_cast<std::uint16_t>(count + steps[n]);
      if (std::isnan(values[n]))
        ASSERT_EQ(count, 65535) << n;
      else
        ASSERT_NEAR(low + step * count, values[n], 0.5001 * step) << column << " " << n;
    }
  }
}

TEST(PackedRows, ComeBackWithinHalfAStep) {
  const Rows rows = some_rows();
  const auto packed = packed_rows(rows.time, {&rows.wave, &rows.noise}, 1'000'000);
  ASSERT_TRUE(packed);
  expect_back(*packed, rows);
}

/// Rows that are too large after quick compression are compressed thoroughly. If they are still too large,
/// they are omitted.
TEST(PackedRows, AreLeftOutOnlyWhereNoWayIsSmallEnough) {
  const Rows rows = some_rows();
  const auto quick = packed_rows(rows.time, {&rows.wave, &rows.noise}, 1'000'000);
  ASSERT_TRUE(quick);
  const auto thorough = packed_rows(rows.time, {&rows.wave, &rows.noise}, quick->bytes.size() - 1);
  ASSERT_TRUE(thorough);
  EXPECT_LT(thorough->bytes.size(), quick->bytes.size());
  expect_back(*thorough, rows);
  EXPECT_FALSE(packed_rows(rows.time, {&rows.wave, &rows.noise}, thorough->bytes.size() - 1));
}

}  // namespace SIXSTEP_TEST_FILE
