// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/rotor_path.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "sixstep/control/commutation.hpp"
#include "sixstep/control/hall.hpp"

namespace sixstep::analysis {
namespace {

// Costs: the logarithm of an event's rarity relative to the usual event. Their exact size has no influence on
// results: a glitch with return costs 3, a rotor that reversed twice costs 16.
constexpr double step_cost = 0.1, turn_cost = 8.0, skip_cost = 6.0, lost_cost = 12.0, glitch_cost = 3.0,
                 glitch_cost_per_sector = 16.0;

constexpr std::size_t states = 12;  // six sectors, two directions

constexpr std::size_t sector_of(std::size_t state) { return state % 6; }
constexpr bool forward(std::size_t state) { return state < 6; }

double move_cost(std::size_t from, std::size_t to) {
  const std::int8_t steps = control::sectors_between(static_cast<std::uint8_t>(sector_of(from)),
                                                     static_cast<std::uint8_t>(sector_of(to)));
  const double turned = forward(from) == forward(to) ? 0.0 : turn_cost;
  if (steps == 0) return from == to ? 0.0 : std::numeric_limits<double>::infinity();
  if (steps == 3) return lost_cost + turned;
  if ((steps > 0) != forward(to)) return std::numeric_limits<double>::infinity();
  return (steps == 1 || steps == -1 ? step_cost : skip_cost) + turned;
}

using Costs = std::array<double, states>;

/// The cheapest path. For each state, the function finds the cheapest path that ends in this state, and the
/// state before it.
std::vector<Whereabouts> cheapest(const std::vector<Stay>& stays, std::uint8_t mask, double sector_s) {
  std::array<Costs, states> moves;
  for (std::size_t to = 0; to < states; ++to)
    for (std::size_t from = 0; from < states; ++from) moves[to][from] = move_cost(from, to);
  Costs costs{};
  std::vector<std::array<std::uint8_t, states>> came_from(stays.size());
  for (std::size_t n = 0; n < stays.size(); ++n) {
    const std::uint8_t shown = control::sector_of_hall(stays[n].code ^ mask);
    const double glitch =
        glitch_cost + (sector_s > 0.0 ? glitch_cost_per_sector * stays[n].duration_s() / sector_s : 1.0);
    Costs next;
    for (std::size_t to = 0; to < states; ++to) {
      std::size_t best = to;
      for (std::size_t from = 0; n > 0 && from < states; ++from)
        if (costs[from] + moves[to][from] < costs[best] + moves[to][best]) best = from;
      came_from[n][to] = static_cast<std::uint8_t>(best);
      next[to] = costs[best] + (n > 0 ? moves[to][best] : 0.0) + (sector_of(to) == shown ? 0.0 : glitch);
    }
    const double least = *std::min_element(next.begin(), next.end());
    for (std::size_t s = 0; s < states; ++s) costs[s] = next[s] - least;
  }
  std::vector<Whereabouts> way(stays.size());
  auto state = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  for (std::size_t n = stays.size(); n-- > 0;) {
    way[n] = {static_cast<std::uint8_t>(sector_of(state)), forward(state),
              control::sector_of_hall(stays[n].code ^ mask) != sector_of(state)};
    state = came_from[n][state];
  }
  return way;
}

/// Median time in a sector of this path, s; of an even count the longer of the two middle times.
double usual_sector_s(const std::vector<Stay>& stays, const std::vector<Whereabouts>& way) {
  std::vector<double> times;
  double from_s = stays.front().came_before_s;
  for (std::size_t n = 1; n < stays.size(); ++n)
    if (way[n].sector != way[n - 1].sector) {
      times.push_back(stays[n].came_before_s - from_s);
      from_s = stays[n].came_before_s;
    }
  if (times.empty()) return 0.0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace

RotorPath likeliest_way(const std::vector<Stay>& stays, std::uint8_t mask) {
  if (stays.empty()) return {};
  RotorPath way{cheapest(stays, mask, 0.0), 0.0};  // the first search ignores the lengths of glitches,
                                                   // because it determines the usual time in a sector
  way.sector_s = usual_sector_s(stays, way.at_stays);
  if (way.sector_s > 0.0) way.at_stays = cheapest(stays, mask, way.sector_s);
  return way;
}

}  // namespace sixstep::analysis
