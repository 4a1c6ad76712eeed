// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/campaign.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <thread>

namespace sixstep::testing {
namespace {

/// CPU time of a thread, in s, after which a case counts as hung. It does not depend on the load of the
/// machine. No valid case needs this time.
constexpr double hung_s = 60.0;
constexpr std::size_t most_broken = 200;

struct Worker {
  std::atomic<std::uint64_t> seed{0};
  std::atomic<double> since_s{0.0};  ///< CPU time of the worker's thread, s, at the start of the case
  std::atomic<bool> done{false};
  std::thread thread;
  CampaignResult result;
};

thread_local std::uint64_t seed_at_hand = 0;
const char* campaign_at_hand = "";

/// Prints the seed. Only async-signal-safe calls are allowed in this function.
[[maybe_unused]] void on_crash(int signal) {
  char text[64];
  char* at = text + sizeof text;
  *--at = '\n';
  for (std::uint64_t n = seed_at_hand; n != 0; n /= 10) *--at = static_cast<char>('0' + n % 10);
  const auto say = [](const char* what, std::size_t size) { (void)!::write(STDERR_FILENO, what, size); };
  say(campaign_at_hand, std::char_traits<char>::length(campaign_at_hand));
  static constexpr char words[] = ": crashed at seed ";
  say(words, sizeof words - 1);
  say(at, static_cast<std::size_t>(text + sizeof text - at));
  ::_exit(128 + signal);
}

#if defined(__SANITIZE_ADDRESS__)
void catch_crashes() {}  // the sanitizer prints more than this handler
#else
/// The handler has a separate stack, because an overflowed stack has no space for the handler.
void catch_crashes() {
  static thread_local std::unique_ptr<char[]> stack(new char[1 << 16]);
  const stack_t own{.ss_sp = stack.get(), .ss_flags = 0, .ss_size = 1 << 16};
  sigaltstack(&own, nullptr);
  struct sigaction action {};
  action.sa_handler = on_crash;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) sigaction(signal, &action, nullptr);
}
#endif

double seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void work(const Campaign& c, std::atomic<std::uint64_t>& next, Worker& own) {
  catch_crashes();
  for (std::uint64_t n = next++; n < c.count; n = next++) {
    seed_at_hand = c.first_seed + n;
    own.since_s = seconds(CLOCK_THREAD_CPUTIME_ID);
    own.seed = seed_at_hand;
    own.result.take(seed_at_hand, c.examine(seed_at_hand));
  }
  own.done = true;
}

/// Watches the workers for a case that takes too long. The caller joins the workers only afterwards, so the
/// clock of each thread exists until then.
void watch(const Campaign& c, std::vector<Worker>& workers) {
  for (bool busy = true; busy;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    busy = false;
    for (Worker& w : workers) {
      if (w.done) continue;
      busy = true;
      clockid_t clock{};
      if (pthread_getcpuclockid(w.thread.native_handle(), &clock) != 0) continue;
      if (w.seed == 0 || seconds(clock) - w.since_s < hung_s) continue;
      fmt::print(stderr, "{}: hangs at seed {}\n", c.name, w.seed.load());
      std::_Exit(1);
    }
  }
}

}  // namespace

void CampaignResult::take(std::uint64_t seed, const Examined& e) {
  Kind& kind = kinds[e.kind];
  ++(e.accepted ? accepted : refused);
  ++(e.accepted ? kind.accepted : kind.refused);
  ++(e.accepted ? ended[e.ended] : refused_at[e.refused_at]);
  for (const LawUsed& used : e.laws) {
    Worst& worst = laws[used.law];
    if (!(used.part <= worst.part)) worst = {used.part, seed};
    if (used.broken() && broken.size() < most_broken) broken.push_back({used.law, seed, used.part, e.words});
  }
}

void CampaignResult::add(const CampaignResult& other) {
  accepted += other.accepted;
  refused += other.refused;
  for (const auto& [name, kind] : other.kinds) {
    kinds[name].accepted += kind.accepted;
    kinds[name].refused += kind.refused;
  }
  for (const auto& [name, count] : other.ended) ended[name] += count;
  for (const auto& [name, count] : other.refused_at) refused_at[name] += count;
  for (const auto& [name, worst] : other.laws)
    if (!(worst.part <= laws[name].part)) laws[name] = worst;
  broken.insert(broken.end(), other.broken.begin(), other.broken.end());
}

CampaignResult carry_out(const Campaign& c) {
  campaign_at_hand = c.name;
  std::vector<Worker> workers(std::max(1u, c.threads));
  std::atomic<std::uint64_t> next{0};
  for (Worker& own : workers) own.thread = std::thread([&c, &next, &own] { work(c, next, own); });
  watch(c, workers);
  for (Worker& own : workers) own.thread.join();
  CampaignResult all;
  for (const Worker& worker : workers) all.add(worker.result);
  std::sort(all.broken.begin(), all.broken.end(),
            [](const auto& a, const auto& b) { return a.seed < b.seed; });
  return all;
}

std::string as_markdown(const Campaign& c, const CampaignResult& t) {
  std::string out = fmt::format(
      "{} {} scenarios, seeds {} to {}: {} accepted, {} refused with words, {} laws broken.\n\n", c.count,
      c.name, c.first_seed, c.first_seed + c.count - 1, t.accepted, t.refused, t.broken.size());
  out += "| what was drawn | accepted | refused |\n|---|---|---|\n";
  for (const auto& [name, kind] : t.kinds)
    out += fmt::format("| {} | {} | {} |\n", name, kind.accepted, kind.refused);
  out += "\n| law | most of what is allowed that was used | by seed |\n|---|---|---|\n";
  for (const auto& [name, worst] : t.laws)
    out += fmt::format("| {} | {:.2g} | {} |\n", name, worst.part,
                       worst.part > 0 ? std::to_string(worst.seed) : "");
  out += "\nAccepted runs ended:";
  for (const auto& [how, count] : t.ended) out += fmt::format(" {} {};", count, how);
  out.back() = '.';
  return out + "\n";
}

}  // namespace sixstep::testing
