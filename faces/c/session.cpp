// SPDX-License-Identifier: Apache-2.0
#include "faces/c/session.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "files/scenario_on_disk.hpp"
#include "sixstep/base/written.hpp"
#include "text/results/json_summary.hpp"
#include "text/scenario/scenario_file.hpp"
#include "text/scenario/scenario_text.hpp"

namespace c_face {

namespace {

/// Resolves file names as the command line does, and the name "caller" to the caller's controller.
text::Resolve resolve_with(const std::string& data_folder, bool legs) {
  return [on_disk = files::on_disk(data_folder), legs](const text::Naming& naming) {
    if (naming.kind == text::Naming::Kind::controller && naming.name == caller_name)
      return base::Result<text::NamedText>(
          text::NamedText{.name = caller_name, .text = {}, .controller = caller_controller(legs)});
    return on_disk(naming);
  };
}

/// Replaces the scenario's controller by the caller, for a driven pair or three legs. The keys of the board
/// still apply.
void hand_over(study::Scenario& s, sixstep_chip chip) {
  if (chip != SIXSTEP_CHIP_PAIR && chip != SIXSTEP_CHIP_LEGS) return;
  s.control.drive = study::FirmwareKind::own;
  s.control.own = {
      .controller = caller_name, .number = {}, .loaded = caller_controller(chip == SIXSTEP_CHIP_LEGS)};
}

constexpr char change_head[] = "\n[[at]]\ntime_s = ";

/// A change is appended to the scenario's text and read with it. The lines of its problems are counted from
/// the change's first line.
base::Problems in_change(base::Problems found, const Source& source) {
  const auto own = std::count(source.toml.begin(), source.toml.end(), '\n') + 1, lines = own + 2;
  for (base::Problem& p : found) {
    const std::string before = source.name + ":";
    long line = 0;
    if (!p.where.starts_with(before)) continue;
    const char *const from = p.where.data() + before.size(), *const last = p.where.data() + p.where.size();
    const auto [end, wrong] = std::from_chars(from, last, line);
    if (wrong != std::errc{} || line <= own) continue;
    if (line <= lines)
      p.where = "toml";  // the problem is about all lines
    else
      p.where = "toml:" + std::to_string(line - lines) + std::string(end, last);
  }
  return found;
}

}  // namespace

Session::Session(const Session& other)
    : source_(other.source_),
      run_(other.run_),
      ahead_(other.ahead_),
      exchange_(other.exchange_),
      registers_(other.registers_),
      conversions_(other.conversions_),
      commands_(other.commands_),
      applies_(other.applies_),
      outcome_(other.outcome_),
      digest_(other.digest_) {}

sixstep_status Session::refused(base::Problems found) {
  problems = std::move(found);
  for (base::Problem& p : problems)  // a C program passes settings in sixstep_options
    if (constexpr std::string_view option = "--set "; p.where.starts_with(option))
      p.where.replace(0, option.size(), "options.settings: ");
  return SIXSTEP_REFUSED;
}

sixstep_status Session::misuse(const char* function, const char* limit, const char* cure) {
  problems = {{function, "", limit, cure}};
  return SIXSTEP_MISUSE;
}

sixstep_status Session::usable(const char* function) {
  problems.clear();
  if (!run_)
    return misuse(function, "needs an open session",
                  "correct the problems that the opening reported, and open the session again");
  if (outcome_)
    return misuse(function, "needs a running session, and this session is finished", "open another session");
  return SIXSTEP_OK;
}

base::Result<study::Scenario> Session::read(const std::string& more) const {
  text::ReadOptions options{.overrides = {},
                            .resolve = resolve_with(source_.data_folder, source_.chip == SIXSTEP_CHIP_LEGS)};
  for (const auto& [key, value] : source_.settings) options.overrides.push_back({key, value});
  base::Result<study::Scenario> scenario =
      text::read_scenario_text(source_.name, source_.toml + more, options);
  if (scenario) hand_over(*scenario, source_.chip);
  return scenario;
}

sixstep_status Session::open(Source source) {
  problems.clear();
  source_ = std::move(source);
  const base::Result<study::Scenario> scenario = read("");
  if (!scenario) return refused(scenario.problems());
  const bool gates = source_.chip == SIXSTEP_CHIP_GATES;
  const Exchanging here(exchange_);
  base::Result<study::Session> run =
      study::Session::open(*scenario, {}, gates ? caller_chip() : rig::ChipPort{});
  if (!run) return refused(run.problems());
  run_.emplace(std::move(*run));
  registers_ = rig::Registers(run_->board().sensors);
  note_what_applies();
  if (gates) (void)look_ahead(0);
  return SIXSTEP_OK;
}

void Session::note_what_applies() {
  for (std::size_t c = 0; c < applies_.size(); ++c)
    applies_[c] = study::applies(static_cast<study::ColumnId>(c), run_->scenario());
}

/// Copies run_ to ahead_ and advances the copy to the instant. run_ stays at the last change of the gates.
bool Session::look_ahead(std::int64_t at_ps) {
  exchange_.stop_ps = Exchange::never_ps;
  ahead_ = run_;
  return ahead_->advance(static_cast<double>(at_ps) / sim::ticks_per_second);
}

std::int64_t Session::now_ps() const { return sim::to_instant(time_s()).ticks; }
double Session::time_s() const {
  return run_ ? seen().present().t_s : std::numeric_limits<double>::quiet_NaN();
}
double Session::tick_after_s(double at_s) const {
  constexpr double far_s = 1e6;  // an instant of 1e6 s in ps fits into 64 bits
  if (!run_ || !(std::abs(at_s) < far_s)) return std::numeric_limits<double>::quiet_NaN();
  return run_->tick_after_s(at_s);
}
double Session::value(int index) const { return seen().present().signals[static_cast<std::size_t>(index)]; }

/// Status after an advance. If a fault ended the run early, its problem is read from a closed copy of the
/// run.
sixstep_status Session::reached(bool goes_on) {
  if (goes_on) return SIXSTEP_OK;
  if (seen().now_s() >= seen().scenario().duration_s * (1 - 1e-9)) return SIXSTEP_OVER;
  study::Session copy = seen();
  if (const base::Result<study::Outcome> outcome = copy.close(false); outcome && outcome->fault)
    problems = {*outcome->fault};
  return SIXSTEP_OVER;
}

sixstep_status Session::advance(double to_s) {
  if (const sixstep_status status = usable("sixstep_advance"); status != SIXSTEP_OK) return status;
  if (std::isnan(to_s))
    return refused({{"to_s", "nan", "must be a finite time in seconds", "give a number"}});
  const Exchanging here(exchange_);
  // The instant is limited. Beyond the run's end nothing changes, and a larger number could exceed the range
  // of an instant.
  const double end_s = 2 * seen().scenario().duration_s;
  return reached(seen().advance(to_s < end_s ? (to_s < 0 ? 0.0 : to_s) : end_s));
}

sixstep_status Session::advance_to_tick() {
  if (const sixstep_status status = usable("sixstep_advance_to_tick"); status != SIXSTEP_OK) return status;
  const Exchanging here(exchange_);
  return reached(seen().advance_to_tick());
}

/// Advances along a grid of 1/16 period, which does not depend on the caller's steps. If side() changes
/// within a step, bisection locates the change to 1 ps. Each trial starts from a copy of run_, advanced to
/// the lower instant.
template <class Side>
sixstep_status Session::advance_to_edge(const char* function, double to_s, const Side& side) {
  if (const sixstep_status status = usable(function); status != SIXSTEP_OK) return status;
  if (!ahead_)
    return misuse(function, "needs a session whose gates the caller sets",
                  "open the session with SIXSTEP_CHIP_GATES");
  if (std::isnan(to_s)) return advance(to_s);
  const auto seconds = [](std::int64_t ps) { return static_cast<double>(ps) / sim::ticks_per_second; };
  const auto before = side(ahead_->present().signals);
  const Exchanging here(exchange_);
  const study::Scenario& s = ahead_->scenario();
  const std::int64_t end = sim::to_instant(std::clamp(to_s, 0.0, 2 * s.duration_s)).ticks,
                     step = std::max<std::int64_t>(1, sim::to_instant(s.pwm.period_s).ticks / 16);
  while (now_ps() < end) {
    std::int64_t low = now_ps(), high = std::min(end, (low / step + 1) * step);
    if (!ahead_->advance(seconds(high))) return SIXSTEP_OVER;
    if (side(ahead_->present().signals) == before) continue;
    study::Session at_low = *run_;
    (void)at_low.advance(seconds(low));
    while (high - low > 1) {
      const std::int64_t middle = low + (high - low) / 2;
      study::Session tried = at_low;
      const bool changed = !tried.advance(seconds(middle)) || side(tried.present().signals) != before;
      (changed ? high : low) = middle;
    }
    *ahead_ = at_low;
    return reached(ahead_->advance(seconds(high)));
  }
  return SIXSTEP_OK;
}

sixstep_status Session::advance_to_hall_edge(double to_s) {
  if (const sixstep_status status = usable("sixstep_advance_to_hall_edge"); status != SIXSTEP_OK)
    return status;
  if (std::isnan(to_s)) return advance(to_s);
  if (!ahead_) {  // every event of the run is located, also a change of the pins
    const Exchanging here(exchange_);
    return reached(run_->advance_to_hall_edge(std::clamp(to_s, 0.0, 2 * run_->scenario().duration_s)));
  }
  return advance_to_edge("sixstep_advance_to_hall_edge", to_s, [](const study::FullRow& row) {
    return row[static_cast<std::size_t>(study::ColumnId::hall)];
  });
}

sixstep_status Session::advance_to_crossing(int leg, double level_V, double to_s) {
  if (const sixstep_status status = usable("sixstep_advance_to_crossing"); status != SIXSTEP_OK)
    return status;
  if (leg < 0 || leg > 2)
    return refused({{"leg", std::to_string(leg), "must be 0, 1 or 2", "give the index of leg a, b or c"}});
  if (!std::isfinite(level_V))
    return refused({{"level_V", base::written(level_V), "must be a voltage", "give a number"}});
  return advance_to_edge("sixstep_advance_to_crossing", to_s, [=](const study::FullRow& row) {
    using enum study::ColumnId;
    const double u[] = {row[static_cast<std::size_t>(u_a)], row[static_cast<std::size_t>(u_b)],
                        row[static_cast<std::size_t>(u_c)]};
    return u[leg] - (u[0] + u[1] + u[2]) / 3 > level_V;
  });
}

sixstep_status Session::change(std::string_view toml, double* at_s) {
  if (const sixstep_status status = usable("sixstep_change"); status != SIXSTEP_OK) return status;
  const base::Result<study::Scenario> with =
      read(change_head + base::written(time_s()) + "\n" + std::string(toml) + "\n");
  if (!with) return refused(in_change(with.problems(), source_));
  if (with->at.empty())
    return refused(
        {{"toml", std::string(toml), "has no change", "give at least one key that [[at]] may change"}});
  const std::int64_t now = now_ps();
  Session tried(*this);  // a refused change leaves this session as it is
  if (tried.ahead_)      // run_ must reach this instant too
    if (const sixstep_status status = tried.set_gates(exchange_.gates); status != SIXSTEP_OK) return status;
  const Exchanging here(tried.exchange_);
  const base::Result<double> at = tried.run_->change(with->at.back());
  if (!at) return refused(at.problems());
  if (at_s != nullptr) *at_s = *at;
  run_ = std::move(tried.run_);
  exchange_ = tried.exchange_;
  commands_ = std::move(tried.commands_);
  note_what_applies();
  if (ahead_) (void)look_ahead(now);
  return SIXSTEP_OK;
}

sixstep_status Session::finish() {
  if (const sixstep_status status = usable("sixstep_finish"); status != SIXSTEP_OK) return status;
  const Exchanging here(exchange_);
  if (ahead_) {
    exchange_.stop_ps = Exchange::never_ps;
    run_ = std::move(ahead_);
    ahead_.reset();
  }
  const base::Result<study::Outcome> outcome = run_->close(source_.chip == SIXSTEP_CHIP_OF_SCENARIO);
  if (!outcome) return refused(outcome.problems());
  outcome_ = text::json_summary(run_->scenario(), *outcome);
  digest_ = outcome->digest;
  return SIXSTEP_OK;
}

sixstep_status Session::replay(const Commands& commands, std::uint64_t conversions, double to_s) {
  conversions_ = conversions;
  for (const Command& c : commands.in_order) {
    const sixstep_status reached = advance(static_cast<double>(c.at_ps) / sim::ticks_per_second);
    if (reached != SIXSTEP_OK) return reached;
    const sixstep_status set = c.answer == 0 ? set_gates(c.gates) : command(commands.answers[c.answer - 1]);
    if (set != SIXSTEP_OK) return set;
  }
  return advance(to_s);
}

}  // namespace c_face
