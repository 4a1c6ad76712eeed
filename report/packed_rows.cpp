// SPDX-License-Identifier: Apache-2.0
#include "report/packed_rows.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace report {
namespace {

constexpr double highest_count = 65533.0;  // with one to spare for a zero that is a whole count
constexpr std::uint16_t no_number = 65535;

/// Bytes of equal weight side by side: the high ones of small differences are zeros, which compress to
/// nothing.
template <class Count>
void append_planes(std::string& bytes, const std::vector<Count>& counts) {
  for (std::size_t plane = 0; plane < sizeof(Count); ++plane) {
    Count before = 0;
    for (const Count count : counts) {
      bytes += static_cast<char>(static_cast<Count>(count - before) >> (8 * plane) & 0xffu);
      before = count;
    }
  }
}

void append_times(std::string& bytes, const std::vector<double>& time, PackedRows& out) {
  double gap = 0.0;
  for (std::size_t n = 1; n < time.size(); ++n) gap = std::max(gap, time[n] - time[n - 1]);
  constexpr double picosecond = 1e-12, most = 4e9;  // below 2^32, with room for a rounding
  out.start_s = time.front();
  out.tick_s = std::max(picosecond, gap / most);
  // The differences fit into 32 bits, so the counts may wrap.
  std::vector<std::uint32_t> counts;
  counts.reserve(time.size());
  for (const double t : time)
    counts.push_back(static_cast<std::uint32_t>(
        static_cast<std::uint64_t>(std::llround((t - out.start_s) / out.tick_s)) & 0xffffffffu));
  append_planes(bytes, counts);
}

void append_column(std::string& bytes, const std::vector<double>& values, PackedRows& out) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  PackedRows::Column column{low <= high ? low : 0.0, low < high ? (high - low) / highest_count : 0.0};
  // Zero stays zero: a current that has gone out must not come back as a rounding.
  if (low < 0.0 && high > 0.0) column.low = -column.step * std::ceil(-low / column.step);
  std::vector<std::uint16_t> counts;
  counts.reserve(values.size());
  for (const double v : values) {
    const double count = column.step > 0.0 ? (v - column.low) / column.step : 0.0;
    counts.push_back(std::isfinite(v) ? static_cast<std::uint16_t>(std::lround(count)) : no_number);
  }
  append_planes(bytes, counts);
  out.columns.push_back(column);
}

}  // namespace

std::optional<PackedRows> packed_rows(const std::vector<double>& time,
                                      const std::vector<const std::vector<double>*>& columns,
                                      std::size_t most_bytes) {
  // Not even a tenth of a byte a value: no use to begin.
  if (time.size() < 2 || time.size() * columns.size() / 10 > most_bytes) return std::nullopt;
  PackedRows out{.rows = time.size()};
  std::string bytes;
  bytes.reserve(time.size() * (4 + 2 * columns.size()));
  append_times(bytes, time, out);
  for (const auto* column : columns) append_column(bytes, *column, out);
  uLongf size = compressBound(bytes.size());
  out.bytes.resize(size);
  const int done = compress2(reinterpret_cast<Bytef*>(out.bytes.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  if (done != Z_OK || size > most_bytes) return std::nullopt;
  out.bytes.resize(size);
  return out;
}

}  // namespace report
