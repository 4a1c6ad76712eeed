// SPDX-License-Identifier: Apache-2.0
#include "batch/letters.hpp"

#include <utility>

#include "batch/byte_format.hpp"

namespace batch::letters {
namespace {

// Each struct is taken apart into all of its members: a new one stops the compiler here.

void write(ByteWriter& w, const analysis::Axis& axis) {
  const auto& [key, values, from, to, points, spacing, strays] = axis;
  w.text(key);
  w.texts(values);
  w.number(from);
  w.number(to);
  w.whole(points);
  w.whole(static_cast<std::uint64_t>(spacing));
  w.whole(strays);
}

analysis::Axis read_axis(ByteReader& r) {
  analysis::Axis axis;
  axis.key = r.text();
  axis.values = r.texts();
  axis.from = r.number();
  axis.to = r.number();
  axis.points = r.whole();
  axis.spacing = r.choice<analysis::Spacing>(2);
  axis.strays = r.yes();
  return axis;
}

void write(ByteWriter& w, const analysis::Plan& plan) {
  const auto& [axes, sampling, points, drives, seed] = plan;
  w.list(axes, [&](const analysis::Axis& axis) { write(w, axis); });
  w.whole(static_cast<std::uint64_t>(sampling));
  w.whole(points);
  w.whole(drives);
  w.whole(seed);
}

analysis::Plan read_plan(ByteReader& r) {
  analysis::Plan plan;
  plan.axes = r.list<analysis::Axis>([&] { return read_axis(r); });
  plan.sampling = r.choice<analysis::Sampling>(5);
  plan.points = r.whole();
  plan.drives = r.whole();
  plan.seed = r.whole();
  return plan;
}

void write(ByteWriter& w, const std::optional<double>& bound) {
  w.whole(bound.has_value());
  w.number(bound.value_or(0.0));
}

std::optional<double> read_bound(ByteReader& r) {
  const bool there = r.yes();
  const double x = r.number();
  return there ? std::optional(x) : std::nullopt;
}

void write(ByteWriter& w, const analysis::PlanColumns& columns) {
  const auto& [keys, strayed, figures] = columns;
  w.texts(keys);
  w.texts(strayed);
  w.list(figures, [&](const analysis::FigureColumn& figure) {
    const auto& [name, unit, required, min, max] = figure;
    w.text(name);
    w.text(unit);
    w.whole(required);
    write(w, min);
    write(w, max);
  });
}

analysis::PlanColumns read_columns(ByteReader& r) {
  analysis::PlanColumns columns;
  columns.keys = r.texts();
  columns.strayed = r.texts();
  columns.figures = r.list<analysis::FigureColumn>([&] {
    analysis::FigureColumn figure;
    figure.name = r.text();
    figure.unit = r.text();
    figure.required = r.yes();
    figure.min = read_bound(r);
    figure.max = read_bound(r);
    return figure;
  });
  return columns;
}

void write(ByteWriter& w, const analysis::RunRecord& record) {
  const auto& [number, point, strayed, end, problem, figures, digest] = record;
  static_cast<void>(point);
  w.whole(number);
  w.numbers(strayed);
  w.whole(static_cast<std::uint64_t>(end));
  w.text(problem);
  w.numbers(figures);
  w.whole(digest);
}

analysis::RunRecord read_record(ByteReader& r) {
  analysis::RunRecord record;
  record.number = r.whole();
  record.strayed = r.numbers();
  record.end = r.choice<analysis::RunEnd>(3);
  record.problem = r.text();
  record.figures = r.numbers();
  record.digest = r.whole();
  return record;
}

void write(ByteWriter& w, const std::vector<std::uint64_t>& numbers) {
  w.list(numbers, [&](std::uint64_t n) { w.whole(n); });
}

std::vector<std::uint64_t> read_wholes(ByteReader& r) {
  return r.list<std::uint64_t>([&] { return r.whole(); });
}

void write(ByteWriter& w, const Begin& begin) {
  write(w, begin.plan);
  write(w, begin.columns);
  w.whole(begin.jobs);
  w.text(begin.made_of);
}
void write(ByteWriter& w, const Runs& runs) { write(w, runs.numbers); }
void write(ByteWriter& w, const Answer& answer) {
  w.whole(answer.to);
  w.text(answer.bytes);
}
void write(ByteWriter&, const End&) {}
void write(ByteWriter& w, const Dismissed& dismissed) { w.whole(dismissed.exit); }
void write(ByteWriter& w, const Rows& rows) {
  w.list(rows.rows, [&](const analysis::RunRecord& record) { write(w, record); });
}
void write(ByteWriter& w, const Hungry& hungry) {
  w.whole(hungry.idle);
  w.whole(hungry.ahead);
}
void write(ByteWriter& w, const Question& question) {
  w.whole(question.number);
  w.text(question.bytes);
}
void write(ByteWriter& w, const Gone& gone) { write(w, gone.unmade); }

// The members of a braced list are read in its order.

void read_into(ByteReader& r, Begin& begin) { begin = {read_plan(r), read_columns(r), r.whole(), r.text()}; }
void read_into(ByteReader& r, Runs& runs) { runs.numbers = read_wholes(r); }
void read_into(ByteReader& r, Answer& answer) { answer = {r.whole(), r.text()}; }
void read_into(ByteReader&, End&) {}
void read_into(ByteReader& r, Dismissed& dismissed) { dismissed.exit = r.whole(); }
void read_into(ByteReader& r, Rows& rows) {
  rows.rows = r.list<analysis::RunRecord>([&] { return read_record(r); });
}
void read_into(ByteReader& r, Hungry& hungry) { hungry = {r.whole(), r.whole()}; }
void read_into(ByteReader& r, Question& question) { question = {r.whole(), r.text()}; }
void read_into(ByteReader& r, Gone& gone) { gone.unmade = read_wholes(r); }

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
