// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/emulator.hpp"

namespace loop {

base::Result<std::unique_ptr<Emulator>> Emulator::start(const Core& core, const std::string& image) {
  std::unique_ptr<Emulator> made(new Emulator);  // constructed first, because it pins this thread to a
                                                 // processor before the process starts
  base::Result<Talk> talk = Talk::begin(core.emulator, image, &made->greeting_, sizeof made->greeting_);
  if (!talk) return talk.problems();
  if (made->greeting_.word != rig::CoreGreeting{}.word)
    return no_greeting(core.emulator.front(), rig::CoreTrouble::gone);
  made->talk_.emplace(std::move(*talk));
  return made;
}

rig::CorePort Emulator::port() {
  return {this,
          [](void* core, const void* call, std::size_t call_bytes, void* answer, std::size_t answer_bytes) {
            return static_cast<Emulator*>(core)->ask(call, call_bytes, answer, answer_bytes);
          }};
}

rig::CoreTrouble Emulator::ask(const void* call, std::size_t call_bytes, void* answer,
                               std::size_t answer_bytes) {
  if (call_bytes != greeting_.call_bytes || answer_bytes != greeting_.answer_bytes)
    return rig::CoreTrouble::differs;
  ++calls_;
  return talk_->ask(call, call_bytes, answer, answer_bytes);
}

}  // namespace loop
