// SPDX-License-Identifier: Apache-2.0
// drawn_scenarios [--valid N] [--hostile N] [--seed S|new] [--threads T]: runs N cases, starting with the
// seed S. With `new`, S is random.
// drawn_scenarios --show valid|hostile S: prints the text of one case.
// The results are printed as Markdown. The exit code is 1 if a case violates a law.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string_view>
#include <thread>

#include "tests/fuzz/campaign.hpp"

namespace {

using namespace sixstep::testing;

std::uint64_t number(const char* text) { return std::strtoull(text, nullptr, 10); }

/// A random seed that is short to type and far from the seeds of the standard tests.
std::uint64_t new_seed() {
  std::random_device device;
  return 1'000'000'000ull + (std::uint64_t{device()} << 8);
}

int usage() {
  fmt::print(stderr,
             "usage: drawn_scenarios [--valid N] [--hostile N] [--seed S|new] [--threads T] | --show "
             "valid|hostile S\n");
  return 2;
}

int show(std::string_view what, std::uint64_t seed) {
  const std::string text = what == "hostile" ? hostile_text(seed) : drawn_text(seed);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return 0;
}

bool holds(const Campaign& campaign) {
  if (campaign.count == 0) return true;
  fmt::print(stderr, "{}: {} from seed {}\n", campaign.name, campaign.count, campaign.first_seed);
  const CampaignResult result = carry_out(campaign);
  fmt::print("### {}\n\n{}\n", campaign.name, as_markdown(campaign, result));
  if (std::getenv("SIXSTEP_REFUSED"))
    for (const auto& [where, count] : result.refused_at)
      fmt::print(stderr, "{:>8} {}\n", count, where.substr(0, 100));
  for (const CampaignResult::Broken& b : result.broken)
    fmt::print(stderr, "BROKEN {} seed {}: {} ({:.3g})\n  {}\n", campaign.name, b.seed, b.law, b.part,
               b.words.substr(0, 600));
  return result.broken.empty();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "--show") == 0) return show(argv[2], number(argv[3]));
  Campaign valid{"valid", examine_drawn}, hostile{"hostile", examine_hostile};
  std::uint64_t seed = 1;
  unsigned threads = std::thread::hardware_concurrency();
  for (int n = 1; n < argc; n += 2) {
    if (n + 1 == argc) return usage();
    const std::string_view word = argv[n];
    if (word == "--valid")
      valid.count = number(argv[n + 1]);
    else if (word == "--hostile")
      hostile.count = number(argv[n + 1]);
    else if (word == "--seed")
      seed = std::strcmp(argv[n + 1], "new") == 0 ? new_seed() : number(argv[n + 1]);
    else if (word == "--threads")
      threads = static_cast<unsigned>(number(argv[n + 1]));
    else
      return usage();
  }
  valid.first_seed = hostile.first_seed = seed;
  valid.threads = hostile.threads = threads;
  const bool valid_holds = holds(valid), hostile_holds = holds(hostile);
  return valid_holds && hostile_holds ? 0 : 1;
}
