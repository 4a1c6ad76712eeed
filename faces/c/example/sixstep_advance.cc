// SPDX-License-Identifier: Apache-2.0
// For GNU Octave: [values, outcome] = sixstep_advance(scenario, t, names) has the named signals at the instants t, a
// row for each instant, and the outcome as JSON.
//   mkoctfile sixstep_advance.cc $(pkg-config --cflags --libs sixstep)
#include <octave/oct.h>
#include <sixstep.h>

#include <memory>
#include <string>
#include <vector>

DEFUN_DLD(sixstep_advance, args, , "[values, outcome] = sixstep_advance (scenario, t, names)") {
  if (args.length() != 3) error("sixstep_advance: needs a scenario, instants and names of signals");
  const std::string path = args(0).string_value();
  const NDArray t = args(1).array_value();
  const string_vector names = args(2).string_vector_value();

  sixstep_session* opened = nullptr;
  const sixstep_status status = sixstep_open_file(path.c_str(), nullptr, &opened);
  const std::unique_ptr<sixstep_session, decltype(&sixstep_free)> drive(opened, sixstep_free);
  sixstep_problem problem;
  if (status != SIXSTEP_OK && sixstep_problem_at(opened, 0, &problem) == SIXSTEP_OK)
    error("%s %s", problem.place, problem.limit);

  std::vector<int> signals;
  for (octave_idx_type n = 0; n < names.numel(); ++n) {
    signals.push_back(sixstep_signal_index(names(n).c_str()));
    if (signals.back() < 0) error("sixstep_advance: %s is no signal", names(n).c_str());
  }
  Matrix values(t.numel(), names.numel());
  for (octave_idx_type k = 0; k < t.numel(); ++k) {
    sixstep_advance(opened, t(k));
    for (octave_idx_type n = 0; n < names.numel(); ++n) values(k, n) = sixstep_value(opened, signals[n]);
  }
  sixstep_finish(opened);
  const char* outcome = sixstep_outcome(opened);
  return ovl(values, outcome == nullptr ? "" : outcome);
}
