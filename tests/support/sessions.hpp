// SPDX-License-Identifier: Apache-2.0
// Runs and sessions that must succeed. The functions return their results, or the test fails.
#pragma once
#include <gtest/gtest.h>

#include "sixstep/study/run/run.hpp"
#include "sixstep/study/session/session.hpp"

namespace sixstep::testing {

inline study::Outcome outcome(const study::Scenario& s, const study::Listeners& listeners = {}) {
  const auto out = study::run(s, listeners);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? *out : study::Outcome{};
}

inline study::Session opened(const study::Scenario& s, const study::Listeners& listeners = {}) {
  auto session = study::Session::open(s, listeners);
  EXPECT_TRUE(session) << to_string(session.problems()[0]);
  return *session;
}

inline study::Outcome closed(study::Session& session) {
  const auto out = session.close();
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? *out : study::Outcome{};
}

/// Advances the session to the end of the scenario.
inline study::Outcome run_out(study::Session& session) {
  session.advance(1e6);
  return closed(session);
}

/// Runs a session in slices of irregular lengths. After each slice, the values are read, and a copy of the
/// session continues the run.
inline study::Outcome sliced(const study::Scenario& s, const study::Listeners& listeners = {}) {
  study::Session session = opened(s, listeners);
  double t_s = 0.0;
  for (int n = 0; session.advance(t_s); ++n) {
    t_s += s.pwm.period_s * (n % 3 == 0 ? 0.37 : n % 3 == 1 ? 5.0 : 1.0 / 3);
    EXPECT_GE(session.now_s(), session.present().t_s);
    if (n % 7 == 0) session = study::Session(session);
  }
  return closed(session);
}

}  // namespace sixstep::testing
