// SPDX-License-Identifier: Apache-2.0
// Runs many cases on many threads and collects the results.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/scenario_laws.hpp"

namespace sixstep::testing {

struct Campaign {
  const char* name = "";
  Examined (*examine)(std::uint64_t seed) = nullptr;
  std::uint64_t first_seed = 1, count = 0;
  unsigned threads = 1;
};

struct CampaignResult {
  struct Kind {
    std::uint64_t accepted = 0, refused = 0;
  };
  struct Worst {
    double part = 0.0;
    std::uint64_t seed = 0;
  };
  struct Broken {
    std::string law;
    std::uint64_t seed = 0;
    double part = 0.0;
    std::string words;
  };
  std::uint64_t accepted = 0, refused = 0;
  std::map<std::string, Kind> kinds;
  std::map<std::string, std::uint64_t> ended, refused_at;
  std::map<std::string, Worst> laws;
  std::vector<Broken> broken;

  void take(std::uint64_t seed, const Examined& examined);
  void add(const CampaignResult& other);
};

/// Runs the cases. After a crash, or if a case takes minutes, the program prints the seed and ends.
CampaignResult carry_out(const Campaign& campaign);

/// The results as Markdown tables: the counts, the kinds, and the fraction of each law's tolerance that was
/// used.
std::string as_markdown(const Campaign& campaign, const CampaignResult& result);

}  // namespace sixstep::testing
