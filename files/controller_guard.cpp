// SPDX-License-Identifier: Apache-2.0
#include "files/controller_guard.hpp"

#include <cxxabi.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cfenv>
#include <cstring>
#include <deque>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

#include "files/controller_arena.hpp"

namespace files {
namespace {

ControllerArena& arena() {
  thread_local ControllerArena mine;
  return mine;
}

/// The program's floating-point mode: rounding to nearest, with subnormal numbers, without traps.
const femode_t& usual_mode() {
  static const femode_t usual = [] {
    femode_t mode;
    std::memset(&mode, 0, sizeof mode);
    ::fegetmode(&mode);
    return mode;
  }();
  return usual;
}

/// A controller in two forms: as loaded (`real`), and as the program calls it (`shown`).
struct Guarded {
  std::string path, name, sentence;
  std::deque<std::string> words;  ///< texts of the controller's parameters; a deque, so that pointers to them
                                  ///< stay valid
  std::vector<sixstep_parameter> parameters;
  sixstep_controller real{}, shown{};
};

constexpr std::size_t most_controllers = 64;
std::array<Guarded, most_controllers> controllers;
std::size_t loaded_controllers = 0;
std::mutex adding;

/// Runs the controller's code on this thread. Reports code that does not return normally.
template <class Work>
void inside(const char* path, ControllerPlace place, const Work& work) {
  const femode_t& usual = usual_mode();
  ControllerThread& thread = controller_thread();
  thread.controller.store(path, std::memory_order_relaxed);
  thread.calls.store(thread.calls.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  thread.place.store(place, std::memory_order_relaxed);
  try {
    work(thread);
  } catch (const abi::__forced_unwind&) {
    end_by_controller(thread, "ended its thread, for example by pthread_exit()");
  } catch (...) {
    end_by_controller(thread, "threw an exception");
  }
  ::fesetmode(&usual);
  thread.place.store(ControllerPlace::outside, std::memory_order_relaxed);
}

void must_be_whole(const ControllerThread& thread, const GuardedRoom& room, const char* what) {
  if (!room.is_whole()) end_by_controller(thread, what);
}
constexpr char beside_state[] = "wrote to memory outside its state",
               beside_config[] = "wrote to memory outside its config",
               beside_answer[] = "wrote to memory outside its answer";

/// The interface has no argument that identifies the controller. Therefore each controller has its own
/// functions, selected by its number N.
template <std::size_t N>
struct Calls {
  static const Guarded& is() { return controllers[N]; }

  static const char* design(const sixstep_given* given, const sixstep_real* values, void* config) {
    thread_local std::string told;
    const char* wrong = nullptr;
    inside(is().path.c_str(), ControllerPlace::design, [&](ControllerThread& thread) {
      thread.period_s.store(given->period_s, std::memory_order_relaxed);
      thread.first_step_s.store(given->sampled_in_middle != 0 ? given->period_s / 2 : 0.0,
                                std::memory_order_relaxed);
      const std::size_t bytes = is().real.config_bytes;
      arena().let_config_change(true);
      std::byte* const own = arena().config.take(bytes);
      std::memcpy(own, config, bytes);
      wrong = is().real.design(given, values, own);
      must_be_whole(thread, arena().config, beside_config);
      if (wrong != nullptr) told = std::string(wrong, ::strnlen(wrong, 1000));
      std::memcpy(config, own, bytes);
    });
    return wrong != nullptr ? told.c_str() : nullptr;
  }

  static void start(const void* config, void* state) {
    controller_thread().steps = 0;
    if (is().real.start == nullptr) return;
    with_bytes(ControllerPlace::start, config, state, nullptr,
               [](const std::byte* c, std::byte* s, sixstep_answer*) { is().real.start(c, s); });
  }

  static void step(const void* config, void* state, const sixstep_measured* measured, sixstep_real setpoint,
                   sixstep_answer* answer) {
    std::atomic<std::uint64_t>& steps = controller_thread().steps;  // only this thread writes it
    steps.store(steps.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    const sixstep_measured seen = *measured;
    with_bytes(ControllerPlace::step, config, state, answer,
               [&](const std::byte* c, std::byte* s, sixstep_answer* a) {
                 is().real.step(c, s, &seen, setpoint, a);
               });
  }

  static void hall(const void* config, void* state, std::uint8_t code, sixstep_answer* answer) {
    with_bytes(ControllerPlace::hall, config, state, answer,
               [&](const std::byte* c, std::byte* s, sixstep_answer* a) { is().real.hall(c, s, code, a); });
  }

  template <class Work>
  static void with_bytes(ControllerPlace place, const void* config, void* state, sixstep_answer* answer,
                         const Work& work) {
    inside(is().path.c_str(), place, [&](const ControllerThread& thread) {
      ControllerArena& here = arena();
      const std::byte* const c = here.set_config(config, is().real.config_bytes);
      const std::size_t bytes = is().real.state_bytes;
      std::byte* const s = here.state.take(bytes);
      std::memcpy(s, state, bytes);
      auto* const a = reinterpret_cast<sixstep_answer*>(here.answer.take(sizeof(sixstep_answer)));
      if (answer != nullptr) *a = *answer;
      work(c, s, a);
      must_be_whole(thread, here.state, beside_state);
      must_be_whole(thread, here.answer, beside_answer);
      std::memcpy(state, s, bytes);
      if (answer != nullptr) *answer = *a;
    });
  }

  static void show(sixstep_controller& as) {
    as.design = design;
    as.start = start;
    as.step = step;
    as.hall = is().real.hall != nullptr ? hall : nullptr;
  }
};

template <std::size_t... N>
void show(std::size_t which, sixstep_controller& as, std::index_sequence<N...>) {
  constexpr void (*all[])(sixstep_controller&) = {Calls<N>::show...};
  all[which](as);
}

/// Copies the controller's texts once, because its pointers may become invalid later.
void take(Guarded& into, const std::string& path, const sixstep_controller& real) {
  into.path = path;
  into.real = into.shown = real;
  into.name = real.name;
  into.sentence = real.sentence;
  into.shown.name = into.name.c_str();
  into.shown.sentence = into.sentence.c_str();
  for (std::uint32_t n = 0; n < real.parameters; ++n) {
    sixstep_parameter& own = into.parameters.emplace_back(real.parameter[n]);
    for (const char** word : {&own.name, &own.unit, &own.meaning})
      if (*word != nullptr) *word = into.words.emplace_back(*word).c_str();
  }
  into.shown.parameter = into.parameters.data();
}

}  // namespace

void in_controller(const std::string& path, const std::function<void()>& work) {
  static std::deque<std::string> paths;  // never removed, because later messages use the names
  const char* stays = nullptr;
  {
    const std::lock_guard lock(adding);
    stays = paths.emplace_back(path).c_str();
  }
  usual_mode();  // saves the floating-point mode before foreign code can change it
  watch_controllers(stays);
  inside(stays, ControllerPlace::loading, [&](const ControllerThread&) { work(); });
}

namespace {

/// Compares member by member, because the padding between members is undefined.
bool is_same(const sixstep_controller& a, const sixstep_controller& b) {
  const auto all = [](const sixstep_controller& c) {
    return std::tie(c.interface, c.answers, c.name, c.sentence, c.config_bytes, c.state_bytes, c.parameters,
                    c.parameter, c.design, c.start, c.step, c.hall);
  };
  return all(a) == all(b);
}

}  // namespace

base::Result<const sixstep_controller*> guarded_controller(const std::string& path,
                                                           const sixstep_controller& real) {
  const std::lock_guard lock(adding);
  for (std::size_t n = 0; n < loaded_controllers; ++n)
    if (controllers[n].path == path && is_same(controllers[n].real, real)) return &controllers[n].shown;
  if (loaded_controllers == most_controllers)
    return base::Problem{
        .where = path,
        .limit = fmt::format("exceeds the {} controllers that a program may load", loaded_controllers),
        .cure = "run the other controllers in another process"};
  take(controllers[loaded_controllers], path, real);
  show(loaded_controllers, controllers[loaded_controllers].shown,
       std::make_index_sequence<most_controllers>());
  return &controllers[loaded_controllers++].shown;
}

}  // namespace files
