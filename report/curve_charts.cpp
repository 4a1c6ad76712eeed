// SPDX-License-Identifier: Apache-2.0
#include "report/curve_charts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "report/curve_units.hpp"
#include "report/html.hpp"

namespace report {
namespace {

using json = nlohmann::ordered_json;
namespace analysis = sixstep::analysis;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A point of the curve, and the sheet's nominal point if it is at this point.
struct OnCurve {
  const analysis::OperatingPoint* point;
  const analysis::NominalPoint* nominal = nullptr;
};

using Of = std::function<double(const OnCurve&)>;

struct CurveLine {
  const char *label, *style, *meaning;
  Of of;
  /// region: the area between the curve and zero is filled.
  enum class Drawn { line, points, region } drawn = Drawn::line;
};

template <double analysis::OperatingPoint::*member>
Of of(double factor) {
  return [factor](const OnCurve& place) { return factor * (place.point->*member); };
}

class Charts {
 public:
  Charts(const analysis::CurveRequest& request, const analysis::Curve& curve)
      : request_(request), curve_(curve), units_(curve_units(request)) {
    for (const analysis::OperatingPoint& p : curve.points) places_.push_back({&p});
    if (curve.marks.best_efficiency) places_.push_back({&*curve.marks.best_efficiency});
    if (curve.marks.for_ever) places_.push_back({&*curve.marks.for_ever});
    if (curve.marks.nominal) places_.push_back({&*curve.marks.nominal});
    if (curve.nominal && curve.nominal->at_speed)
      places_.push_back({&*curve.nominal->at_speed, &*curve.nominal});
    std::stable_sort(places_.begin(), places_.end(), [](const OnCurve& a, const OnCurve& b) {
      return a.point->speed_rad_s < b.point->speed_rad_s;
    });
    std::vector<double> speeds;
    for (const OnCurve& place : places_) speeds.push_back(place.point->speed_rad_s * units_.per_rad_s);
    out_["axis"] = base64(std::span<const double>(speeds));
    if (units_.motion.linear) out_["speed"] = units_.speed;
    out_["charts"] = json::array();
    corner_Nm_ = corner_Nm();
  }

  void add(const char* id, const char* title, const char* unit, int height,
           const std::vector<CurveLine>& lines) {
    const auto& motion = units_.motion;
    json chart = {
        {"id", motion.words(id)}, {"title", motion.words(title)}, {"unit", unit}, {"height", height}};
    double corner = 0.0;
    for (const CurveLine& line : lines) {
      std::vector<float> values;
      for (const OnCurve& place : places_) {
        const double v = line.of(place);
        values.push_back(static_cast<float>(v));
        if (place.point->shaft_torque_Nm <= corner_Nm_) corner = std::fmax(corner, v);
      }
      chart["curves"].push_back({{"label", motion.words(line.label)},
                                 {"style", line.style},
                                 {"meaning", motion.words(line.meaning)},
                                 {"points", line.drawn == CurveLine::Drawn::points},
                                 {"region", line.drawn == CurveLine::Drawn::region},
                                 {"data", base64(std::span<const float>(values))}});
    }
    if (corner_Nm_ > 0.0) chart["corner"] = corner;
    out_["charts"].push_back(std::move(chart));
  }

  void torque() {
    std::vector<CurveLine> lines = regions();
    const double per_Nm = units_.per_Nm;
    lines.insert(lines.end(),
                 {{"shaft", "main", "mean torque on the shaft",
                   of<&analysis::OperatingPoint::shaft_torque_Nm>(per_Nm)},
                  {"ideal", "reference", "torque on the straight line without commutation time and friction",
                   [this, per_Nm](const OnCurve& p) {
                     return per_Nm * analysis::ideal_torque_Nm(request_.bench, p.point->speed_rad_s);
                   }}});
    if (curve_.thermal) {
      const auto limit = limits();
      lines.push_back({"winding, continuous", "c", "torque that the winding withstands continuously",
                       [limit, per_Nm](const OnCurve& p) { return per_Nm * limit(p).continuous_Nm; }});
      lines.push_back({"60 s", "a", "torque that the winding withstands for 60 s from ambient temperature",
                       [limit, per_Nm](const OnCurve& p) { return per_Nm * limit(p).short_Nm[1]; }});
      lines.push_back({"10 s", "b", "torque that the winding withstands for 10 s from ambient temperature",
                       [limit, per_Nm](const OnCurve& p) { return per_Nm * limit(p).short_Nm[0]; }});
    }
    if (curve_.nominal && curve_.nominal->torque_Nm)
      lines.push_back(
          {"nominal point", "b", "as printed",
           [per_Nm](const OnCurve& p) { return p.nominal ? per_Nm * *p.nominal->torque_Nm : none; },
           CurveLine::Drawn::points});
    add("torque", "Torque", units_.torque, 320, lines);
    if (corner_Nm_ > 0.0) out_["charts"].back()["corner"] = per_Nm * corner_Nm_;
  }

  void currents() {
    using P = analysis::OperatingPoint;
    std::vector<CurveLine> lines = {
        {"winding", "main", "mean of half the sum of the phase currents' magnitudes",
         of<&P::winding_current_A>(1)},
        {"peak", "b", "greatest phase current", of<&P::phase_peak_A>(1)},
        {"rms", "a", "rms of a phase current", of<&P::phase_rms_A>(1)},
        {"supply", "c", "mean current from the supply", of<&P::bus_current_A>(1)}};
    if (curve_.nominal && curve_.nominal->current_A)
      lines.push_back({"nominal point", "b", "as printed",
                       [](const OnCurve& p) { return p.nominal ? *p.nominal->current_A : none; },
                       CurveLine::Drawn::points});
    add("current", "Current", "A", 220, lines);
  }

  std::string text() const { return out_.dump(); }

 private:
  std::function<analysis::ThermalLimits(const OnCurve&)> limits() const {
    return [this](const OnCurve& p) {
      return analysis::thermal_limits(*curve_.thermal, request_, p.point->speed_rad_s);
    };
  }

  /// Operating regions within the limits of bus and winding: continuous, and for ten seconds.
  std::vector<CurveLine> regions() const {
    if (!curve_.thermal) return {};
    const auto below = [per_Nm = units_.per_Nm](double allowed_Nm, const OnCurve& p) {
      if (std::isnan(allowed_Nm)) return 0.0;
      return per_Nm * std::fmax(0.0, std::fmin(allowed_Nm, p.point->shaft_torque_Nm));
    };
    const auto limit = limits();
    return {{"short-time", "b", "operation that bus and winding allow for 10 s from ambient temperature",
             [=](const OnCurve& p) { return below(limit(p).short_Nm[0], p); }, CurveLine::Drawn::region},
            {"continuous", "c", "operation that bus and winding allow continuously",
             [=](const OnCurve& p) { return below(limit(p).continuous_Nm, p); }, CurveLine::Drawn::region}};
  }

  /// The highest torque of the axis: the end of the motor's usual range. The stall torque may be ten times
  /// larger, and the usual range would then be too small to read. 0 if the range is unknown.
  double corner_Nm() const {
    constexpr double room = 1.1, of_nominal = 3.0, worth_it = 0.7;
    double corner = 0.0;
    if (curve_.thermal)
      corner = room * analysis::thermal_limits(*curve_.thermal, request_, 0.0).short_Nm[0];
    else if (curve_.nominal && curve_.nominal->torque_Nm)
      corner = of_nominal * *curve_.nominal->torque_Nm;
    return corner < worth_it * curve_.points.front().shaft_torque_Nm ? corner : 0.0;
  }

  const analysis::CurveRequest& request_;
  const analysis::Curve& curve_;
  CurveUnits units_;
  std::vector<OnCurve> places_;
  json out_;
  double corner_Nm_ = 0.0;
};

}  // namespace

std::string curve_charts(const analysis::CurveRequest& request, const analysis::Curve& curve) {
  using P = analysis::OperatingPoint;
  Charts charts(request, curve);
  charts.torque();
  charts.currents();
  charts.add("efficiency", "Efficiency", "%", 180,
             {{"efficiency", "main", "shaft power divided by supply power",
               [](const OnCurve& p) { return 100 * p.point->efficiency.value_or(0.0); }}});
  std::vector<CurveLine> power = {{"in", "main", "power from the supply", of<&P::supplied_W>(1)},
                                  {"out", "c", "power delivered by the shaft", of<&P::shaft_W>(1)},
                                  {"copper", "b", "loss in the winding", of<&P::copper_W>(1)},
                                  {"friction", "a", "loss by friction", of<&P::friction_W>(1)}};
  const auto& devices = request.bench.devices;
  if (devices.R_on_ohm > 0 || devices.V_f_V > 0 || devices.r_d_ohm > 0)
    power.push_back({"devices", "reference", "loss in switches and diodes", of<&P::devices_W>(1)});
  charts.add("power", "Power", "W", 220, power);
  const CurveUnits u = curve_units(request);
  charts.add("ripple", "Torque ripple", u.torque, 180,
             {{"peak to peak", "main", "electromagnetic torque", of<&P::ripple_Nm>(u.per_Nm)},
              {"rms", "a", "about the mean", of<&P::ripple_rms_Nm>(u.per_Nm)}});
  return charts.text();
}

}  // namespace report
