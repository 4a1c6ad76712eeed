// SPDX-License-Identifier: Apache-2.0
#include "report/packed_rows.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace report {
namespace {

constexpr double highest_count = 65533.0;  // one count fewer than possible: add_column() shifts the range by
                                           // up to one count, so that zero is a whole count
constexpr std::uint16_t no_number = 65535;

/// zlib's settings. The three lower bytes of the times hardly repeat, so only the frequencies of their values
/// are used (count_times). A page that is too large with `quick` may fit with `thorough`, which takes three
/// times as long.
struct Effort {
  int level;
  bool count_times;
};
constexpr Effort quick{4, true}, thorough{6, false};
constexpr std::size_t time_planes = sizeof(std::uint32_t), noisy_time_planes = 3;

/// A zlib stream to which planes are added one after the other.
class Deflated {
 public:
  Deflated(std::size_t rows, std::size_t columns, const Effort& effort, std::size_t most_bytes)
      : effort_(effort), most_(most_bytes) {
    constexpr std::size_t to_change =
        64;  // most additional bytes if a plane's settings differ from those of the previous plane
    planes_ = time_planes + 2 * columns;
    const std::size_t room = compressBound(planes_ * rows) + planes_ * to_change;
    bytes_ = std::make_unique_for_overwrite<Bytef[]>(room);
    sound_ = deflateInit(&stream_, effort.level) == Z_OK;
    stream_.next_out = bytes_.get();
    stream_.avail_out = static_cast<uInt>(room);
    sound_ = sound_ && stream_.avail_out == room;
  }
  ~Deflated() { deflateEnd(&stream_); }
  Deflated(const Deflated&) = delete;
  Deflated& operator=(const Deflated&) = delete;

  void add(std::span<const std::uint8_t> plane) {
    const bool counting = effort_.count_times && done_ < noisy_time_planes;
    if (counting != counting_)
      sound_ =
          sound_ && deflateParams(&stream_, effort_.level, counting ? Z_RLE : Z_DEFAULT_STRATEGY) == Z_OK;
    counting_ = counting;
    const bool last = ++done_ == planes_;
    stream_.next_in = const_cast<Bytef*>(plane.data());
    stream_.avail_in = static_cast<uInt>(plane.size());
    sound_ = sound_ && deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH) == (last ? Z_STREAM_END : Z_OK) &&
             stream_.total_out <= most_;
  }
  bool sound() const { return sound_; }
  std::string bytes() const { return {reinterpret_cast<const char*>(bytes_.get()), stream_.total_out}; }

 private:
  z_stream stream_{};
  std::unique_ptr<Bytef[]> bytes_;
  Effort effort_;
  std::size_t most_, planes_ = 0, done_ = 0;
  bool sound_ = true, counting_ = false;
};

/// Adds planes, each with the bytes of one significance. The high bytes of small differences are zeros and
/// compress to almost nothing.
template <class Count>
void add_planes(Deflated& out, const std::vector<Count>& counts) {
  const std::size_t rows = counts.size();
  std::vector<std::uint8_t> planes(rows * sizeof(Count));
  Count before = 0;
  for (std::size_t n = 0; n < rows; ++n) {
    const auto apart = static_cast<Count>(counts[n] - before);
    before = counts[n];
    for (std::size_t plane = 0; plane < sizeof(Count); ++plane)
      planes[plane * rows + n] = static_cast<std::uint8_t>(apart >> (8 * plane) & 0xffu);
  }
  for (std::size_t plane = 0; plane < sizeof(Count); ++plane)
    out.add(std::span(planes).subspan(plane * rows, rows));
}

void add_times(Deflated& bytes, const std::vector<double>& time, PackedRows& out) {
  double gap = 0.0;
  for (std::size_t n = 1; n < time.size(); ++n) gap = std::max(gap, time[n] - time[n - 1]);
  constexpr double picosecond = 1e-12, most = 4e9;  // below 2^32, with a margin for rounding
  out.start_s = time.front();
  out.tick_s = std::max(picosecond, gap / most);
  // The counts may wrap: their differences fit into 32 bits.
  std::vector<std::uint32_t> counts;
  counts.reserve(time.size());
  for (const double t : time)
    counts.push_back(static_cast<std::uint32_t>(
        static_cast<std::uint64_t>(std::llround((t - out.start_s) / out.tick_s)) & 0xffffffffu));
  add_planes(bytes, counts);
}

bool finite(double v) { return v - v == 0.0; }

/// Rounds half up, like std::lround() for numbers that are not negative.
std::uint16_t nearest(double count) {
  const auto whole = static_cast<std::uint16_t>(count);
  return static_cast<std::uint16_t>(whole + (count - whole >= 0.5 ? 1 : 0));
}

void add_column(Deflated& bytes, const std::vector<double>& values, PackedRows& out) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : values)
    if (finite(v)) low = std::min(low, v), high = std::max(high, v);
  PackedRows::Column column{low <= high ? low : 0.0, low < high ? (high - low) / highest_count : 0.0};
  // Zero remains exactly zero: the current of a blocking phase must not become a rounding error.
  if (low < 0.0 && high > 0.0) column.low = -column.step * std::ceil(-low / column.step);
  std::vector<std::uint16_t> counts(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double count = column.step > 0.0 ? (values[n] - column.low) / column.step : 0.0;
    counts[n] = finite(values[n]) ? nearest(count) : no_number;
  }
  add_planes(bytes, counts);
  out.columns.push_back(column);
}

std::optional<PackedRows> packed_with(const Effort& effort, const std::vector<double>& time,
                                      const std::vector<const std::vector<double>*>& columns,
                                      std::size_t most_bytes) {
  PackedRows out{.rows = time.size()};
  Deflated bytes(time.size(), columns.size(), effort, most_bytes);
  add_times(bytes, time, out);
  for (std::size_t n = 0; n < columns.size() && bytes.sound(); ++n) add_column(bytes, *columns[n], out);
  if (!bytes.sound()) return std::nullopt;
  out.bytes = bytes.bytes();
  return out;
}

}  // namespace

std::optional<PackedRows> packed_rows(const std::vector<double>& time,
                                      const std::vector<const std::vector<double>*>& columns,
                                      std::size_t most_bytes) {
  // Too large even if compression reduced each value to a tenth of a byte.
  if (time.size() < 2 || time.size() * columns.size() / 10 > most_bytes) return std::nullopt;
  auto packed = packed_with(quick, time, columns, most_bytes);
  return packed ? packed : packed_with(thorough, time, columns, most_bytes);
}

}  // namespace report
