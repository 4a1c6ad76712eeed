// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/chip.hpp"

namespace loop {

base::Result<std::unique_ptr<Chip>> Chip::start(const Core& core, const std::string& image) {
  std::unique_ptr<Chip> made(new Chip);  // constructed first, because it pins this thread to a processor
                                         // before the process starts
  base::Result<Talk> talk = Talk::begin(core.emulator, image, &made->greeting_, sizeof made->greeting_);
  if (!talk) return talk.problems();
  if (!made->understood())
    return base::Problem{core.emulator.front(), "", "was built from another version than this program",
                         "build both programs from the same sources"};
  made->talk_.emplace(std::move(*talk));
  return made;
}

bool Chip::understood() const {
  constexpr rig::ChipGreeting meant{};
  return greeting_.word == meant.word && greeting_.run_bytes == meant.run_bytes &&
         greeting_.answer_bytes == meant.answer_bytes && greeting_.times_bytes == meant.times_bytes &&
         greeting_.clock_Hz > 0;
}

rig::ChipPort Chip::port() {
  return {this,
          [](void* chip, const rig::ChipRun& run, rig::ChipAnswer& answer) {
            return static_cast<Chip*>(chip)->talk_->ask(&run, sizeof run, &answer, sizeof answer);
          },
          greeting_.clock_Hz};
}

rig::ChipTimes Chip::times() {
  const rig::ChipRun asked{.asks_for_times = 1};
  rig::ChipTimes told;
  return talk_->ask(&asked, sizeof asked, &told, sizeof told) == rig::CoreTrouble::none ? told
                                                                                        : rig::ChipTimes{};
}

}  // namespace loop
