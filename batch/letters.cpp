// SPDX-License-Identifier: Apache-2.0
#include "batch/letters.hpp"

#include <concepts>
#include <tuple>
#include <type_traits>
#include <utility>

#include "batch/byte_format.hpp"
#include "sixstep/analysis/plan/plan_description.hpp"

namespace batch::letters {
namespace {

template <class T, class Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

// Lists the members of each struct in the order of their bytes, for writing and reading. Structs of other
// folders are unpacked completely, so that a new member causes a compiler error here.

auto members(Is<analysis::Axis> auto& axis) {
  auto& [key, values, from, to, points, spacing, strays] = axis;
  return std::tie(key, values, from, to, points, spacing, strays);
}
auto members(Is<analysis::Plan> auto& plan) {
  auto& [axes, sampling, points, drives, seed] = plan;
  return std::tie(axes, sampling, points, drives, seed);
}
auto members(Is<analysis::InputColumn> auto& column) {
  auto& [key, unit] = column;
  return std::tie(key, unit);
}
auto members(Is<analysis::FigureColumn> auto& figure) {
  auto& [name, unit, required, min, max, zero] = figure;
  return std::tie(name, unit, required, min, max, zero);
}
auto members(Is<analysis::PlanColumns> auto& columns) {
  auto& [keys, strayed, figures] = columns;
  return std::tie(keys, strayed, figures);
}
auto members(Is<analysis::RunValues> auto& record) {
  auto& [number, point, strayed, end, problem, remarks, figures, digest] = record;
  static_cast<void>(point);
  return std::tie(number, strayed, end, problem, remarks, figures, digest);
}
auto members(Is<Begin> auto& x) { return std::tie(x.plan, x.columns, x.jobs, x.made_of); }
auto members(Is<Runs> auto& x) { return std::tie(x.numbers); }
auto members(Is<Answer> auto& x) { return std::tie(x.to, x.bytes); }
auto members(Is<End> auto&) { return std::tie(); }
auto members(Is<Dismissed> auto& x) { return std::tie(x.exit); }
auto members(Is<Rows> auto& x) { return std::tie(x.rows); }
auto members(Is<Hungry> auto& x) { return std::tie(x.idle, x.ahead); }
auto members(Is<Question> auto& x) { return std::tie(x.number, x.bytes); }
auto members(Is<Gone> auto& x) { return std::tie(x.unmade); }

constexpr std::size_t count_of(analysis::Spacing) { return std::size(analysis::spacing_choices); }
constexpr std::size_t count_of(analysis::Sampling) { return std::size(analysis::sampling_choices); }
constexpr std::size_t count_of(analysis::RunEnd) { return std::size(analysis::run_ends); }

void write(ByteWriter& w, double x) { w.number(x); }
void write(ByteWriter& w, const std::string& x) { w.text(x); }
void write(ByteWriter& w, const std::optional<double>& x) {
  w.whole(x.has_value());
  w.number(x.value_or(0.0));
}
template <class Whole>
requires std::is_enum_v<Whole> || std::unsigned_integral<Whole>
void write(ByteWriter& w, Whole x) { w.whole(static_cast<std::uint64_t>(x)); }
template <class Entry>
void write(ByteWriter& w, const std::vector<Entry>& list);
template <class Struct>
requires requires(const Struct& x) { members(x); }
void write(ByteWriter& w, const Struct& x) {
  std::apply([&](const auto&... member) { (write(w, member), ...); }, members(x));
}
template <class Entry>
void write(ByteWriter& w, const std::vector<Entry>& list) {
  w.list(list, [&](const Entry& entry) { write(w, entry); });
}

void read_into(ByteReader& r, double& x) { x = r.number(); }
void read_into(ByteReader& r, std::string& x) { x = r.text(); }
void read_into(ByteReader& r, bool& x) { x = r.yes(); }
void read_into(ByteReader& r, std::optional<double>& x) {
  const bool there = r.yes();
  const double bound = r.number();
  if (there) x = bound;
}
template <std::unsigned_integral Whole>
void read_into(ByteReader& r, Whole& x) {
  x = static_cast<Whole>(r.whole());
}
template <class Enum>
requires std::is_enum_v<Enum>
void read_into(ByteReader& r, Enum& x) { x = r.choice<Enum>(count_of(x)); }
template <class Entry>
void read_into(ByteReader& r, std::vector<Entry>& list);
template <class Struct>
requires requires(Struct& x) { members(x); }
void read_into(ByteReader& r, Struct& x) {
  std::apply([&](auto&... member) { (read_into(r, member), ...); }, members(x));
}
template <class Entry>
void read_into(ByteReader& r, std::vector<Entry>& list) {
  list = r.list<Entry>([&] {
    Entry entry{};
    read_into(r, entry);
    return entry;
  });
}

template <std::size_t... Kind>
std::optional<Letter> read_kind(std::uint64_t kind, ByteReader& r, std::index_sequence<Kind...>) {
  std::optional<Letter> letter;
  const auto try_one = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
    if (kind != N) return;
    std::variant_alternative_t<N, Letter> content{};
    read_into(r, content);
    letter = std::move(content);
  };
  (try_one(std::integral_constant<std::size_t, Kind>{}), ...);
  return letter;
}

}  // namespace

std::string bytes_of(const Letter& letter) {
  ByteWriter w;
  w.whole(letter.index());
  std::visit([&](const auto& content) { write(w, content); }, letter);
  return std::move(w).bytes();
}

std::optional<Letter> read(std::string_view bytes) {
  ByteReader r(bytes);
  const std::uint64_t kind = r.whole();
  std::optional<Letter> letter = read_kind(kind, r, std::make_index_sequence<std::variant_size_v<Letter>>{});
  if (!r.whole_read()) return {};
  return letter;
}

}  // namespace batch::letters
