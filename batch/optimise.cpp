// SPDX-License-Identifier: Apache-2.0
#include "batch/optimise.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "batch/for_each.hpp"
#include "batch/nlopt_calls.hpp"
#include "batch/plan_runs.hpp"
#include "sixstep/analysis/plan/sobol_sequence.hpp"
#include "sixstep/base/written.hpp"

namespace batch {
namespace {

using analysis::FigureColumn;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Distance for a point that could not run, or for a figure without a value. It exceeds every measurable
/// distance.
constexpr double hopeless = 1e3;
constexpr double close = 1e-3;  ///< precision of the search, relative to a limit's magnitude and to a range

/// Distance by which a figure exceeds its limits, relative to the limit's magnitude; negative within the
/// limits.
double beyond(const FigureColumn& f, double x) {
  if (!(x - x == 0.0)) return hopeless;
  double miss = -hopeless;
  const auto size = [&f](double limit) { return f.size(limit) == 0.0 ? 1.0 : f.size(limit); };
  if (f.max) miss = std::max(miss, (x - *f.max) / size(*f.max));
  if (f.min) miss = std::max(miss, (*f.min - x) / size(*f.min));
  return miss;
}

struct Evaluated {
  std::vector<std::string> point;
  std::vector<double> at, figures;  ///< coordinates of the point, 0 to 1; figures of its worst drive
  double cost = none;  ///< the figure to be minimised, relative to its magnitude at the first point with a
                       ///< value
  std::vector<double> misses;  ///< one value of beyond() for each requirement
  double worst() const {
    return misses.empty() ? -hopeless : *std::max_element(misses.begin(), misses.end());
  }
  bool holds() const { return cost == cost && worst() <= 0.0; }
};

/// Orders feasible points before infeasible ones, then by lower cost or smaller miss.
bool better(const Evaluated& a, const Evaluated& b) {
  if (a.holds() != b.holds()) return a.holds();
  if (!a.holds()) return a.worst() < b.worst();
  return a.cost < b.cost;
}

double number_of(const std::string& text) {
  double x = none;
  std::from_chars(text.data(), text.data() + text.size(), x);
  return x;
}

class Search {
 public:
  explicit Search(const Optimisation& work) : w_(work) {
    for (std::size_t n = 0; n < w_.columns->figures.size(); ++n)
      if (w_.columns->figures[n].required) required_.push_back(n);
  }

  std::optional<analysis::Optimum> run() {
    const std::size_t keys = w_.plan.axes.size();
    const std::size_t spread = std::min(w_.evaluations / 2 + 1, 10 * keys);
    for (std::size_t n = 0; n < spread && !ended(); ++n) {
      std::vector<double> u(keys);
      for (std::size_t k = 0; k < keys; ++k)
        u[k] = n == 0 ? 0.5 : analysis::sobol(k, static_cast<std::uint32_t>(n), w_.plan.seed);
      evaluate(u);
    }
    if (const Evaluated* start = best(); start && !ended()) refine(start->at);
    return told();
  }

 private:
  bool ended() const { return w_.stop.stop_requested() || tried_.size() >= w_.evaluations; }

  const Evaluated* best() const {
    const auto found = std::min_element(tried_.begin(), tried_.end(),
                                        [](const auto& a, const auto& b) { return better(*a, *b); });
    return found == tried_.end() || (*found)->cost != (*found)->cost ? nullptr : found->get();
  }

  /// The row of a drive at a point. Empty if the search was stopped.
  std::optional<analysis::RunRecord> row(const std::vector<std::string>& point, std::size_t number,
                                         std::size_t drive) const {
    if (w_.known)
      if (std::optional<analysis::RunRecord> before = w_.known(number);
          before && before->fits(w_.columns) && (*before)->point == point)
        return before;
    std::optional<analysis::RunRecord> made =
        row_of_run(w_.columns, number, point, w_.scenario(point, drive), w_.stop);
    if (made && w_.take) w_.take(analysis::RunRecord(*made));
    return made;
  }

  /// Evaluates the drives of a point. The value of each figure is the value of the worst drive. For a
  /// required figure, the worst drive is closest to the limit or farthest beyond it. For the minimised
  /// figure, the worst drive has the largest value.
  const Evaluated& evaluate(const std::vector<double>& u) {
    auto e = std::make_unique<Evaluated>();
    e->at = u;
    for (std::size_t k = 0; k < u.size(); ++k) e->point.push_back(analysis::on_axis(w_.plan.axes[k], u[k]));
    for (const auto& other : tried_)
      if (other->point == e->point) return *other;
    const std::size_t drives = std::max<std::size_t>(w_.plan.drives, 1), first = tried_.size() * drives;
    std::vector<std::optional<analysis::RunRecord>> rows(drives);
    for_each(drives, w_.jobs, [&](std::size_t d) { rows[d] = row(e->point, first + d, d); });
    judge(*e, rows);
    if (!w_.stop.stop_requested()) {
      tried_.push_back(std::move(e));
      if (w_.progress) w_.progress(tried_.size());
      return *tried_.back();
    }
    cut_ = std::move(e);
    return *cut_;
  }

  void judge(Evaluated& e, const std::vector<std::optional<analysis::RunRecord>>& rows) {
    e.figures.assign(w_.columns->figures.size(), none);
    e.misses.assign(required_.size(), -hopeless);
    double cost = -std::numeric_limits<double>::infinity();
    for (const std::optional<analysis::RunRecord>& r : rows) {
      const bool whole = r && (*r)->end == analysis::RunEnd::whole;
      const auto figure = [&](std::size_t n) { return whole ? (*r)->figures[n] : none; };
      for (std::size_t n = 0; n < required_.size(); ++n) {
        const double miss =
            whole ? beyond(w_.columns->figures[required_[n]], figure(required_[n])) : hopeless;
        if (miss >= e.misses[n] && whole) e.figures[required_[n]] = figure(required_[n]);
        e.misses[n] = std::max(e.misses[n], miss);
      }
      const double x = figure(w_.figure);
      cost = x - x == 0.0 && cost == cost ? std::max(cost, x) : none;
      for (std::size_t n = 0; n < e.figures.size(); ++n)
        if (!w_.columns->figures[n].required && whole && !(e.figures[n] >= figure(n)))
          e.figures[n] = figure(n);
    }
    if (cost != cost) return;
    e.figures[w_.figure] = cost;
    if (size_ == 0.0) size_ = cost == 0.0 ? 1.0 : std::fabs(cost);
    e.cost = cost / size_;
  }

  struct Wanted {
    Search* search;
    std::size_t requirement;
  };
  static double cost_of(unsigned n, const double* u, double*, void* data) {
    const Evaluated& e = static_cast<Search*>(data)->at(n, u);
    return e.cost == e.cost ? e.cost : hopeless;
  }
  static double miss_of(unsigned n, const double* u, double*, void* data) {
    const auto& wanted = *static_cast<Wanted*>(data);
    return wanted.search->at(n, u).misses[wanted.requirement];
  }
  const Evaluated& at(unsigned n, const double* u) {
    if (ended()) nlopt_calls()->force_stop(optimiser_.get());
    if (ended()) return *tried_.back();
    std::vector<double> place(u, u + n);
    for (double& x : place) x = std::clamp(x, 0.0, 1.0);
    return evaluate(place);
  }

  void refine(std::vector<double> u) {
    const auto keys = static_cast<unsigned>(u.size());
    optimiser_.reset(nlopt_calls()->create(NLOPT_LN_COBYLA, keys));
    nlopt_opt o = optimiser_.get();
    std::vector<double> low(keys, 0.0), high(keys, 1.0), step(keys, 0.1);
    nlopt_calls()->set_lower_bounds(o, low.data());
    nlopt_calls()->set_upper_bounds(o, high.data());
    nlopt_calls()->set_initial_step(o, step.data());
    nlopt_calls()->set_min_objective(o, cost_of, this);
    std::vector<Wanted> wanted;
    for (std::size_t n = 0; n < required_.size(); ++n) wanted.push_back({this, n});
    for (Wanted& w : wanted) nlopt_calls()->add_inequality_constraint(o, miss_of, &w, 0.0);
    nlopt_calls()->set_xtol_rel(o, 0.0);
    const std::vector<double> tolerance(keys, 1e-4);
    nlopt_calls()->set_xtol_abs(o, tolerance.data());
    nlopt_calls()->set_maxeval(o, static_cast<int>(4 * w_.evaluations));
    double least = 0.0;
    // `how` does not select the result: the best of all tried points is the result.
    const nlopt_result how = nlopt_calls()->optimize(o, u.data(), &least);
    converged_ = !ended() && (how == NLOPT_XTOL_REACHED || how == NLOPT_FTOL_REACHED || how == NLOPT_SUCCESS);
  }

  std::optional<analysis::Optimum> told() const {
    const Evaluated* e = best();
    if (!e) return {};
    analysis::Optimum best{.point = e->point,
                           .values = {},
                           .figures = e->figures,
                           .holds = e->holds(),
                           .converged = converged_,
                           .limits = {},
                           .evaluations = tried_.size()};
    for (const std::string& text : e->point) best.values.push_back(number_of(text));
    for (std::size_t n = 0; n < tried_.size(); ++n)
      if (tried_[n].get() == e) best.at = n;
    for (std::size_t n = 0; n < required_.size(); ++n) {
      const FigureColumn& f = w_.columns->figures[required_[n]];
      if (e->misses[n] < -10 * close) continue;
      const double x = e->figures[required_[n]];
      best.limits.push_back({f.name, f.max && (!f.min || *f.max - x < x - *f.min), false});
    }
    for (std::size_t k = 0; k < e->at.size(); ++k)
      if (e->at[k] < close || e->at[k] > 1.0 - close)
        best.limits.push_back({w_.plan.axes[k].key, e->at[k] > 0.5, true});
    return best;
  }

  struct Destroy {
    void operator()(nlopt_opt_s* o) const { nlopt_calls()->destroy(o); }
  };
  const Optimisation& w_;
  std::vector<std::size_t> required_;
  std::vector<std::unique_ptr<Evaluated>> tried_;
  std::unique_ptr<Evaluated> cut_;
  std::unique_ptr<nlopt_opt_s, Destroy> optimiser_;
  double size_ = 0.0;
  bool converged_ = false;
};

}  // namespace

base::Problems missing_optimiser() {
  if (nlopt_calls()) return {};
  return {{"optimise", "", "needs NLopt, and libnlopt.so.0 cannot be loaded",
           "install the library: apt install libnlopt0"}};
}

std::optional<analysis::Optimum> optimise(const Optimisation& work) { return Search(work).run(); }

}  // namespace batch
