// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "sixstep/study/session/session.hpp"
#include "tests/support/scenarios.hpp"

using namespace sixstep;

int main() {
  auto session = study::Session::open(testing::maxon_scenario(control::Mode::duty, 0.5));
  if (!session) return 2;
  const auto speed = static_cast<std::size_t>(study::ColumnId::speed);

  session->advance(5e-3);  // the bits equal those of one uninterrupted run
  const study::Session saved = *session;
  std::printf("%.4f ms: %.4f rad/s\n", 1e3 * session->present().t_s, session->present().signals[speed]);

  study::At change;  // the keys of [[at]]
  change.control.mode = study::AtMode::current;
  change.control.current.settle_s = 1e-3;
  change.reference = study::Reference{.value = 2.0};
  const auto when = session->change(change);
  if (!when) return 2;
  std::printf("changed at %.4f ms\n", 1e3 * *when);

  session->advance_until(20e-3, [&](const study::Present& p) { return p.signals[speed] > 300.0; });
  std::printf("%.4f ms: %.4f rad/s\n", 1e3 * session->present().t_s, session->present().signals[speed]);

  const auto lived = session->close(), again = study::run(session->scenario());
  std::printf("the same bits again: %s\n", lived && again && lived->digest == again->digest ? "yes" : "no");
  std::printf("saved at %.4f ms\n", 1e3 * saved.present().t_s);
}
