// SPDX-License-Identifier: Apache-2.0
// The run without an observer and with those that every run has. In a file of their own: what else a file holds moves what the compiler
// inlines of the engine, and with it the one figure that the others are compared with.
#include "benchmarks/observers.hpp"
#include "sixstep/plant/audit.hpp"
#include "sixstep/study/measure/digest.hpp"

namespace benchmarks {

namespace {

struct Audited {
  sixstep::plant::Audit<double> audit;
  template <class Rig>
  void segment(const Rig& rig, double s) {
    audit.segment(rig.plant(), s);
  }
};

}  // namespace

void add_bare_and_audited(const Case& c) {
  add(c, "none", [](const Prepared&) { return sixstep::sim::NoObserver{}; });
  add(c, "digest", [](const Prepared&) { return sixstep::study::Digest{}; });
  add(c, "energy audit and laws", [](const Prepared&) { return Audited{}; });
}

}  // namespace benchmarks
