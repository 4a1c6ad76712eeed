// SPDX-License-Identifier: Apache-2.0
#include "text/results/core_text.hpp"

#include <fmt/format.h>

namespace text {

namespace {

std::string times(std::uint64_t n) { return n == 1 ? "once" : fmt::format("{} times", n); }

double mean(const sixstep::rig::InterruptTimes& t) {
  return t.count > 0 ? static_cast<double>(t.sum) / static_cast<double>(t.count) : 0.0;
}

std::string taken(const sixstep::rig::InterruptTimes& t, double clock_Hz) {
  return t.count == 0 ? "never"
                      : fmt::format("{}, {} in the mean, {} at worst", times(t.count),
                                    cycles_text(mean(t), clock_Hz), cycles_text(t.most, clock_Hz));
}

std::vector<std::string> chip_texts(const study::ChipReport& c) {
  std::vector<std::string> out;
  out.push_back(fmt::format("on the {} at {:g} MHz: its control interrupt {}, of a period's {}", c.chip,
                            c.clock_Hz / 1e6, taken(c.times.control, c.clock_Hz),
                            cycles_text(c.period_s * c.clock_Hz, c.clock_Hz)));
  out.push_back(fmt::format("its Hall interrupt {}; edges at its pins at most {:.2g} us late",
                            taken(c.times.hall, c.clock_Hz), c.latest_edge_s * 1e6));
  if (c.overran())
    out.push_back(fmt::format(
        "OVERRUN: {} of {} periods went by without a control interrupt: it takes longer than they do",
        c.times.periods - c.times.conversions, c.times.periods));
  return out;
}

}  // namespace

std::string cycles_text(double cycles, double clock_Hz) {
  return fmt::format("{:.3g} us", cycles / clock_Hz * 1e6);
}

std::vector<std::string> core_texts(const study::Outcome& outcome) {
  if (outcome.chip) return chip_texts(*outcome.chip);
  if (!outcome.core) return {};
  return {fmt::format("on the {}: {}{}", outcome.core->core,
                      outcome.core->calls == 1 ? "1 call" : fmt::format("{} calls", outcome.core->calls),
                      outcome.fault ? "" : ", each answered as by the host, to the bit")};
}

}  // namespace text
