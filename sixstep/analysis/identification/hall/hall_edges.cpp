// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/hall/hall_edges.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sixstep/analysis/identification/hall/rotor_path.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/hall.hpp"

namespace sixstep::analysis {
namespace {

std::string line_name(std::size_t line) { return "hall" + std::to_string(line + 1); }
std::string times(std::size_t count) { return count == 1 ? "once" : std::to_string(count) + " times"; }

using Codes = std::vector<std::uint8_t>;

/// The sequence of codes without repeated changes between the same two codes: a loose contact or a bouncing
/// edge counts once.
Codes happenings(const std::vector<Stay>& stays) {
  Codes out;
  for (std::size_t n = 0; n < stays.size(); ++n) {
    if (n >= 2 && stays[n].code == stays[n - 2].code) continue;
    if (n >= 2 && out.back() != stays[n - 1].code) out.push_back(stays[n - 1].code);
    out.push_back(stays[n].code);
  }
  return out;
}

std::array<std::size_t, 3> changes_of(const Codes& codes) {
  std::array<std::size_t, 3> out{};
  for (std::size_t n = 1; n < codes.size(); ++n)
    for (unsigned line = 0; line < 3; ++line)
      if (((codes[n] ^ codes[n - 1]) >> (2U - line) & 1U) != 0) ++out[line];
  return out;
}

/// A Problem for each line that never or hardly ever changes. The counts of good lines differ by at most one,
/// because of the incomplete turns at the log's ends. A probe without magnet has a lower count.
base::Problems dead_lines(const std::vector<Stay>& stays, const Codes& codes) {
  Codes seen;
  for (const Stay& s : stays) seen.push_back(s.code);
  const std::array<std::size_t, 3> all = changes_of(seen), changes = changes_of(codes);
  const std::size_t most_of_all = *std::max_element(all.begin(), all.end()),
                    most = *std::max_element(changes.begin(), changes.end());
  base::Problems problems;
  for (std::size_t line = 0; line < 3; ++line) {
    const bool never = all[line] == 0 && most_of_all >= 4, rarely = most >= 4 && 4 * changes[line] < most;
    if (!never && !rarely) continue;
    const bool high = (codes.front() >> (2U - line) & 1U) != 0;
    problems.push_back(
        {.where = line_name(line),
         .value = never ? (high ? "1" : "0") : "",
         .limit = never ? "in every row, while another line changes " + times(most_of_all)
                        : "changes " + times(changes[line]) + ", another line " + times(most),
         .cure = "check this line's wire, pull-up and probe, or name another column for this line"});
  }
  return problems;
}

/// A Problem if two lines always change in the same rows, as if they were one line.
base::Problems bridged_lines(const Codes& codes) {
  const std::array<std::size_t, 3> changes = changes_of(codes);
  for (unsigned a = 0; a < 3; ++a)
    for (unsigned b = a + 1; b < 3; ++b) {
      std::size_t together = 0;
      for (std::size_t n = 1; n < codes.size(); ++n) {
        const unsigned changed = static_cast<unsigned>(codes[n] ^ codes[n - 1]);
        if ((changed >> (2U - a) & changed >> (2U - b) & 1U) != 0) ++together;
      }
      if (together < 4 || 20 * together < 19 * std::max(changes[a], changes[b])) continue;
      return {{.where = line_name(a) + " and " + line_name(b),
               .limit = "change together, " + times(together),
               .cure = "name two different columns, or check for a short circuit between the wires"}};
    }
  return {};
}

/// Finds the pair of codes that never occurs: the mask and its complement. Every code is a glitch with the
/// same unknown probability. The prior of this probability has a mean of some per cent; it is a beta
/// distribution with parameters 1/2 and 19/2.
void find_mask(const Codes& codes, HallEdges& out) {
  constexpr std::uint8_t masks[] = {0b000, 0b100, 0b010, 0b001};
  double logs[4], best = 0.0;
  for (std::size_t m = 0; m < 4; ++m) {
    std::size_t impossible = 0;
    for (const std::uint8_t shown : codes) {
      const unsigned code = static_cast<unsigned>(shown ^ masks[m]);
      if (code == 0b000 || code == 0b111) ++impossible;
    }
    // log of the beta function, by its recurrence from (1/2, 19/2) on: products of the rising factors
    logs[m] = 0.0;
    for (std::size_t n = 0; n < impossible; ++n) logs[m] += base::log(0.5 + static_cast<double>(n));
    for (std::size_t n = 0; n < codes.size() - impossible; ++n)
      logs[m] += base::log(9.5 + static_cast<double>(n));
    if (m == 0 || logs[m] > best) {
      best = logs[m];
      out.mask = masks[m];
    }
  }
  double sum = 0.0;
  for (const double log : logs) sum += base::exp(log - best);
  out.mask_probability = 1.0 / sum;
}

/// Follows the path from one stay to the next, without the stays that show no sector.
class EdgeList {
 public:
  EdgeList(const std::vector<Stay>& stays, const RotorPath& way, HallEdges& out)
      : stays_(stays), way_(way.at_stays), sector_s_(way.sector_s), out_(out) {}

  void make() {
    std::size_t last = stays_.size();
    for (std::size_t n = 0; n < stays_.size(); ++n) {
      if (way_[n].glitch) {
        ++out_.glitches;
        continue;
      }
      if (last == stays_.size())
        sector_ = way_[n].sector;
      else
        go_on(last, n);
      last = n;
    }
  }

 private:
  /// Longest duration of glitches between two stays, as a fraction of the time of a sector. After longer
  /// glitches the path is unknown.
  static constexpr double too_long_part = 0.75;
  void go_on(std::size_t last, std::size_t next) {
    const double unseen_s = stays_[next].came_before_s - stays_[last].left_s;
    if (unseen_s > too_long_part * sector_s_) return lose(next);
    const std::int8_t steps = control::sectors_between(way_[last].sector, way_[next].sector);
    if (steps == 0) return;
    if (steps == 3) {
      out_.skipped += 2;
      return lose(next);  // the path continues in an unknown direction
    }
    sector_ += steps;
    if (steps == 2 || steps == -2)
      ++out_.skipped;
    else
      add({stays_[last + 1].came_after_s, stays_[next].came_before_s}, steps);
  }

  void lose(std::size_t next) {
    begins_ = true;
    sector_ = way_[next].sector;
  }

  struct Between {
    double after_s, before_s;
  };
  void add(Between t, int direction) {
    const std::int64_t boundary = direction > 0 ? sector_ : sector_ + 1;
    out_.edges.push_back(
        {0.5 * (t.after_s + t.before_s), t.before_s - t.after_s, boundary, direction, begins_});
    begins_ = false;
  }

  const std::vector<Stay>& stays_;
  const std::vector<Whereabouts>& way_;
  double sector_s_;
  HallEdges& out_;
  std::int64_t sector_ = 0;
  bool begins_ = true;
};

/// Removes a glitch that looks like a step to the next sector and immediately back. A rotor that reverses
/// stays in one sector for longer. If the step was real, the loss is small, because its short time contains
/// little information.
void drop_short_turns(HallEdges& out) {
  constexpr double short_part = 0.25;
  std::vector<HallEdge> kept;
  bool begins = false;
  for (HallEdge edge : out.edges) {
    edge.begins = edge.begins || begins;
    begins = false;
    const bool back = !kept.empty() && !edge.begins && kept.back().boundary == edge.boundary;
    if (!back || edge.t_s - kept.back().t_s > short_part * out.sector_s) {
      kept.push_back(edge);
      continue;
    }
    begins = kept.back().begins;
    kept.pop_back();
    ++out.glitches;
  }
  out.edges = std::move(kept);
}

void mark_turns(std::vector<HallEdge>& edges) {
  for (std::size_t n = 1; n < edges.size(); ++n)
    if (!edges[n].begins && edges[n].boundary == edges[n - 1].boundary)
      edges[n].at_turn = edges[n - 1].at_turn = true;
}

void count(HallEdges& out) {
  for (const HallEdge& edge : out.edges) {
    ++out.seen[static_cast<std::size_t>((edge.boundary % 6 + 6) % 6)];
    ++(edge.direction > 0 ? out.forward : out.backward);
  }
}

void measure_sectors(const HallLog& log, HallEdges& out) {
  std::vector<double> between;
  for (std::size_t n = 1; n < out.edges.size(); ++n)
    if (!out.edges[n].begins) between.push_back(out.edges[n].t_s - out.edges[n - 1].t_s);
  if (between.empty()) return;
  const auto middle = between.begin() + static_cast<std::ptrdiff_t>(between.size() / 2);
  std::nth_element(between.begin(), middle, between.end());
  out.sector_s = *middle;
  if (rows_are_changes(log)) return;
  const double row_s = (log.t_s.back() - log.t_s.front()) / static_cast<double>(log.t_s.size() - 1);
  out.sector_samples = out.sector_s / row_s;
}

base::Problems too_little(const HallEdges& e) {
  const std::size_t wanted = 6 * static_cast<std::size_t>(least_turns);
  const std::string turns = std::to_string(least_turns) + " electrical turns";
  if (e.skipped * 5 > e.edges.size() && e.skipped > 2)
    return {{.where = "hall1, hall2, hall3",
             .limit = "skip " + std::to_string(e.skipped) + " sectors and pass only " +
                      std::to_string(e.edges.size()) + " edges in order",
             .cure = "turn the shaft more slowly or sample faster, for at least ten rows per sector"}};
  if (e.edges.size() < wanted || *std::min_element(e.seen.begin(), e.seen.end()) < 2)
    return {{.where = "hall1, hall2, hall3",
             .limit = "pass " + std::to_string(e.edges.size()) + " edges; " + std::to_string(wanted) +
                      " are needed, each of the six codes at least twice",
             .cure = "turn the shaft by at least " + turns +
                     " without reversing; one turn of the shaft has an electrical turn for each pole pair"}};
  constexpr double fewest_samples = 2.0;
  if (e.sector_samples > 0.0 && e.sector_samples < fewest_samples)
    return {{.where = "time",
             .limit = "has " + base::rounded(e.sector_samples, 2) + " rows in a sector",
             .cure = "turn the shaft more slowly or sample faster, for at least ten rows per sector"}};
  return {};
}

}  // namespace

base::Result<HallEdges> hall_edges(const HallLog& log) {
  if (base::Problems wrong = check(log); !wrong.empty()) return wrong;
  const std::vector<Stay> raw = stays_of(log);
  if (raw.size() < 2)
    return base::Problem{.where = "hall1, hall2, hall3",
                         .limit = "never change: the rotor was at rest, or no probe is supplied",
                         .cure = "turn the shaft during the recording"};
  const Codes codes = happenings(raw);
  if (base::Problems dead = dead_lines(raw, codes); !dead.empty()) return dead;
  if (base::Problems bridged = bridged_lines(codes); !bridged.empty()) return bridged;
  HallEdges out;
  find_mask(codes, out);
  EdgeList(raw, likeliest_way(raw, out.mask), out).make();
  if (out.edges.size() > most_edges) {
    out.unused = out.edges.size() - most_edges;
    out.edges.resize(most_edges);
  }
  measure_sectors(log, out);
  drop_short_turns(out);
  mark_turns(out.edges);
  count(out);
  if (base::Problems few = too_little(out); !few.empty()) return few;
  return out;
}

}  // namespace sixstep::analysis
