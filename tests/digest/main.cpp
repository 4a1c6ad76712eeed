// SPDX-License-Identifier: Apache-2.0
// Prints four values for each case: name, digest of the trajectory, digest of the figures, and number of
// segments. The program needs only the library, so any compiler and any target can print its bits.
#include <cstdio>

#include "sixstep/base/hash.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/study/measure/digest.hpp"
#include "sixstep/study/run/run.hpp"
#include "tests/digest/cases.hpp"
#include "tests/digest/sessions.hpp"

namespace {

using namespace sixstep;

/// The digest of the figures that are computed from the trajectory, and of the run's gains.
std::uint64_t figures(const study::Outcome& out) {
  base::Hash hash;
  for (const study::ComparisonResult& c : out.comparisons) hash.number(c.measured);
  for (const study::LoopGains& g : out.gains) {
    hash.number(g.d1);
    hash.number(g.d0);
  }
  const plant::EnergyBook& e = *out.energy;
  for (const double joule : {e.supplied, e.copper, e.devices, e.magnetic, e.air_gap, e.friction, e.load,
                             e.kinetic, e.moved, e.electrical_residual, e.mechanical_residual})
    hash.number(joule);
  for (const study::EventCount& c : out.events) hash.word(static_cast<std::uint64_t>(c.count));
  return hash.value();
}

bool print(const std::string& name, const base::Result<study::Outcome>& out) {
  if (!out) {
    for (const base::Problem& p : out.problems())
      std::fprintf(stderr, "%s: %s\n", name.c_str(), base::to_string(p).c_str());
    return false;
  }
  std::printf("%-24s %s %s %8lld%s\n", name.c_str(), base::written_hex(out->digest).c_str(),
              base::written_hex(figures(*out)).c_str(), static_cast<long long>(out->segments),
              out->fault ? " fault" : "");
  return true;
}

}  // namespace

int main() {
  bool ok = true;
  for (const testing::Case& c : testing::digest_cases()) ok = print(c.name, study::run(c.scenario)) && ok;
  for (const testing::LivedCase& c : testing::lived_cases()) {
    ok = print(c.name, c.outcome) && ok;
    ok = print(c.name + "-again", study::run(c.written)) && ok;
  }
  return ok ? 0 : 1;
}
