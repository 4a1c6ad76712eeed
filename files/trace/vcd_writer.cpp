// SPDX-License-Identifier: Apache-2.0
#include "files/trace/vcd_writer.hpp"

#include <fmt/format.h>

#include "text/escape/escape.hpp"

namespace files {
namespace {

constexpr std::size_t block = 1 << 16;

/// The identifier of a signal: one printable character from '!' on. There are 94 such characters.
char identifier(std::size_t signal) { return static_cast<char>('!' + signal); }

const char* type_of(const study::LogicSignal& s) {
  if (s.kind == study::LogicKind::event) return "event";
  return s.bits == 1 ? "wire" : "integer";
}

std::string header(std::span<const study::LogicSignal> signals, const TraceOrigin& origin) {
  const std::vector<std::string> lines = origin_lines(origin);
  std::string text = fmt::format("$version {} $end\n", text::vcd_text(lines[0]));
  text += fmt::format("$comment\n  {}\n  {}\n$end\n", text::vcd_text(lines[1]), text::vcd_text(lines[2]));
  text += "$timescale 1 ps $end\n$scope module board $end\n";
  const std::string* group = nullptr;
  for (std::size_t n = 0; n < signals.size(); ++n) {
    const study::LogicSignal& s = signals[n];
    if (!group || *group != s.group) {
      if (group) text += "$upscope $end\n";
      group = &s.group;
      text += fmt::format("$scope module {} $end\n", *group);
    }
    text += fmt::format("$var {} {} {} {} $end\n", type_of(s), s.bits, identifier(n), s.name);
  }
  if (group) text += "$upscope $end\n";
  return text + "$upscope $end\n$enddefinitions $end\n";
}

}  // namespace

base::Result<VcdWriter> VcdWriter::create(const Destination& to, std::span<const study::LogicSignal> signals,
                                          const TraceOrigin& origin) {
  base::Result<AtomicFile> file = AtomicFile::create(to);
  if (!file) return file.problems();
  VcdWriter writer(std::move(*file), signals);
  writer.pending_ = header(signals, origin);
  return writer;
}

void VcdWriter::value(std::size_t signal, std::uint32_t v) {
  const study::LogicSignal& s = signals_[signal];
  if (s.kind == study::LogicKind::event)
    pending_ += '1';
  else if (v == study::logic_unknown)
    pending_ += s.bits == 1 ? "x" : "bx ";
  else if (s.bits == 1)
    pending_ += v != 0 ? '1' : '0';
  else
    fmt::format_to(std::back_inserter(pending_), "b{:b} ", v);
  pending_ += identifier(signal);
  pending_ += '\n';
}

void VcdWriter::first_row(std::span<const std::uint32_t> row) {
  fmt::format_to(std::back_inserter(pending_), "#{}\n$dumpvars\n", last_ps_);
  for (std::size_t n = 0; n < row.size(); ++n)
    if (signals_[n].kind == study::LogicKind::level) value(n, row[n]);
  pending_ += "$end\n";
  for (std::size_t n = 0; n < row.size(); ++n)
    if (signals_[n].kind == study::LogicKind::event && row[n] != 0) value(n, row[n]);
}

void VcdWriter::change(std::int64_t ps, std::span<const std::uint32_t> row) {
  if (last_.empty()) {
    last_ps_ = ps;
    first_row(row);
  } else {
    if (ps != last_ps_) fmt::format_to(std::back_inserter(pending_), "#{}\n", ps);
    last_ps_ = ps;
    for (std::size_t n = 0; n < row.size(); ++n)
      if (row[n] != last_[n]) value(n, row[n]);
  }
  last_.assign(row.begin(), row.end());
  if (pending_.size() >= block) flush();
}

void VcdWriter::flush() {
  file_.write(pending_);
  pending_.clear();
}

base::Problems VcdWriter::commit() {
  flush();
  return file_.commit();
}

base::Problems VcdWriter::commit_partial() {
  flush();
  return file_.commit_partial();
}

}  // namespace files
