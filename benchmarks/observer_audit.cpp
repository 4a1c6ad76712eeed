// SPDX-License-Identifier: Apache-2.0
// Measures a run without an observer, and a run with the observers of every run. They are in a separate file,
// because other code in the file would change which functions the compiler inlines. The run without an
// observer is the reference of all other figures.
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
