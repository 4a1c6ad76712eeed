// SPDX-License-Identifier: Apache-2.0
#include "text/results/core_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace text {

namespace {

std::string times(std::uint64_t n) { return n == 1 ? "once" : fmt::format("{} times", n); }

double mean(const sixstep::rig::InterruptTimes& t) {
  return t.count > 0 ? static_cast<double>(t.sum) / static_cast<double>(t.count) : 0.0;
}

std::string taken(const sixstep::rig::InterruptTimes& t, double clock_Hz) {
  return t.count == 0 ? "never"
                      : fmt::format("{}, {} on average, {} at worst", times(t.count),
                                    cycles_text(mean(t), clock_Hz), cycles_text(t.most, clock_Hz));
}

constexpr std::string_view fault_remark = "# fault: ", waits_remark = "# waits for ";

/// Limits of the quoted faults, because a firmware may send any text.
constexpr std::size_t most_faults = 16, longest_reason = 60;

std::string printable(std::string_view words) {
  std::string out(words.substr(0, longest_reason));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return out;
}

/// The last line that begins with '#', in which the chip's program reports its state.
std::string_view last_remark(std::string_view sent) {
  std::string_view last;
  for (std::size_t at = 0; at < sent.size();) {
    const std::size_t end = std::min(sent.find('\n', at), sent.size());
    if (sent[at] == '#') last = sent.substr(at, end - at);
    at = end + 1;
  }
  return last;
}

std::vector<std::string> chip_texts(const study::ChipReport& c) {
  std::vector<std::string> out;
  out.push_back(fmt::format("on the {} at {:g} MHz: the control interrupt runs {}; a period lasts {}", c.chip,
                            c.clock_Hz / 1e6, taken(c.times.control, c.clock_Hz),
                            cycles_text(c.period_s * c.clock_Hz, c.clock_Hz)));
  out.push_back(fmt::format("the Hall interrupt runs {}; edges at the pins are at most {:.2g} us late",
                            taken(c.times.hall, c.clock_Hz), c.latest_edge_s * 1e6));
  if (c.overran())
    out.push_back(fmt::format(
        "OVERRUN: {} of {} periods had no control interrupt, because the interrupt takes longer than a period",
        c.times.periods - c.times.conversions, c.times.periods));
  if (const std::vector<std::string> why = chip_faults(c); !why.empty())
    out.push_back(fmt::format("FAULT: the chip turned all gates off; reason on its serial line: {}",
                              fmt::join(why, ", then ")));
  if (const std::string_view last = last_remark(c.sent); last.starts_with(waits_remark))
    out.push_back(fmt::format("WAITS: the chip drives only after its setpoint was 0, and waits for {}",
                              printable(last.substr(waits_remark.size()))));
  return out;
}

}  // namespace

std::string cycles_text(double cycles, double clock_Hz) {
  return fmt::format("{:.3g} us", cycles / clock_Hz * 1e6);
}

std::vector<std::string> chip_faults(const study::ChipReport& chip) {
  std::vector<std::string> out;
  const std::string_view sent = chip.sent;
  for (std::size_t at = sent.find(fault_remark); at != sent.npos; at = sent.find(fault_remark, at + 1)) {
    const std::size_t begin = at + fault_remark.size();
    std::string reason = printable(sent.substr(begin, sent.find('\n', begin) - begin));
    if (std::find(out.begin(), out.end(), reason) == out.end()) out.push_back(std::move(reason));
    if (out.size() == most_faults) break;
  }
  return out;
}

std::vector<std::string> core_texts(const study::Outcome& outcome) {
  if (outcome.chip) return chip_texts(*outcome.chip);
  if (!outcome.core) return {};
  return {
      fmt::format("on the {}: {}{}", outcome.core->core,
                  outcome.core->calls == 1 ? "1 call" : fmt::format("{} calls", outcome.core->calls),
                  outcome.fault ? "" : "; in each call, every bit of the answer equals the host's answer")};
}

}  // namespace text
