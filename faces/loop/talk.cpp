// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/talk.hpp"

#include <poll.h>

#include <cerrno>

namespace loop {

namespace {

/// Time limits of an answer and of the start. A program that exceeds its limit counts as hanging. An emulator
/// on a busy machine starts within start_limit_ms.
constexpr int answer_limit_ms = 5000, start_limit_ms = 30000;

/// Descriptor numbers of the pipes in the started program.
constexpr int calls_there = 3, answers_there = 4;

}  // namespace

base::Result<Talk> Talk::begin(std::vector<std::string> emulator, const std::string& image, void* greeting,
                               std::size_t bytes) {
  // Only the child has the other ends, so that each process detects the end of the other process.
  Pipe calls = made_pipe(), answers = made_pipe();
  if (!calls.read || !answers.read)
    return base::Problem{emulator.front(), "", "cannot be started: this program has too many open files",
                         "run fewer experiments at a time"};
  const std::string program = emulator.front();
  emulator.push_back(image);
  base::Result<Child> child =
      Child::start({.words = std::move(emulator),
                    .given = {{calls.read.number(), calls_there}, {answers.write.number(), answers_there}},
                    .temporary = {}});
  if (!child) return child.problems();
  calls.read.close();
  answers.write.close();
  Talk made(std::move(*child), std::move(calls.write), std::move(answers.read));
  const rig::CoreTrouble trouble = made.hear(greeting, bytes, start_limit_ms);
  if (trouble != rig::CoreTrouble::none) return no_greeting(program, trouble);
  return made;
}

rig::CoreTrouble Talk::say(const void* from, std::size_t bytes) {
  for (const char* next = static_cast<const char*>(from); bytes > 0;) {
    const ssize_t sent = ::write(to_.number(), next, bytes);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return rig::CoreTrouble::gone;
    next += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
  return rig::CoreTrouble::none;
}

rig::CoreTrouble Talk::hear(void* to, std::size_t bytes, int limit_ms) {
  char* into = static_cast<char*>(to);
  while (bytes > 0) {
    pollfd ready{from_.number(), POLLIN, 0};
    const int events = ::poll(&ready, 1, limit_ms);
    if (events == 0) return rig::CoreTrouble::silent;
    if (events < 0 && errno == EINTR) continue;
    const ssize_t came = ::read(from_.number(), into, bytes);
    if (came < 0 && errno == EINTR) continue;
    if (came <= 0) return rig::CoreTrouble::gone;
    into += came;
    bytes -= static_cast<std::size_t>(came);
  }
  return rig::CoreTrouble::none;
}

rig::CoreTrouble Talk::ask(const void* call, std::size_t call_bytes, void* answer, std::size_t answer_bytes) {
  const rig::CoreTrouble trouble = say(call, call_bytes);
  return trouble != rig::CoreTrouble::none ? trouble : hear(answer, answer_bytes, answer_limit_ms);
}

base::Problem no_greeting(const std::string& program, rig::CoreTrouble trouble) {
  const bool silent = trouble == rig::CoreTrouble::silent;
  return {program, "", silent ? "did not start the program within 30 s" : "ended before the program ran",
          "start this program by hand and read its output; tools/packages.txt names its package"};
}

}  // namespace loop
