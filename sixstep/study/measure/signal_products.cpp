// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/measure/signal_products.hpp"

#include <algorithm>

namespace sixstep::study {

using plant::PerLeg;

Series weighted_current(const PerLeg<double>& w, const plant::Expansion<double>& y) {
  Series c{};
  for (int j = 0; j <= y.degree; ++j) c[j] = w[0] * y.i[0][j] + w[1] * y.i[1][j] + w[2] * y.i[2][j];
  return c;
}

PerLeg<double> bus_current_weights(const plant::View& plant) {
  PerLeg<double> w{};
  for (int k = 0; k < 3; ++k) w[k] = plant::is_high(plant.legs()[k]) ? 1.0 : 0.0;
  return w;
}

namespace {

/// The segment's own series over [from, to], with zeros after their degree.
struct Span {
  const SegmentView& g;
  double from, to;

  Series of(const Series& c) const {
    const int degree = g.plant.expansion().degree;
    Series out{};
    std::copy_n(c.begin(), degree + 1, out.begin());
    return from == 0.0 && to == 1.0 ? out : series::restricted(out, degree, from, to);
  }
  int degree() const { return std::min(2 * g.plant.expansion().degree, series::max_degree); }
  Series product(const Series& a, const Series& b) const {
    Series out{};
    for (int n = 0; n <= degree(); ++n) out[n] = series::product_term(a, b, n);
    return out;
  }
};

void add(Series& sum, double weight, const Series& c) {
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weight * c[j];
}

/// w phi0 and w phi1: every back-EMF is a weighted sum of these two (plant/back_emf.hpp).
struct SpeedShapes {
  Series w0, w1;
};
SpeedShapes speed_shapes(const Span& part) {
  const auto& y = part.g.plant.expansion();
  const Series w = part.of(y.w);
  if (part.g.plant.lean->constants().sine)
    return {part.product(w, part.of(y.phi0)), part.product(w, part.of(y.phi1))};
  return {w, part.product(w, part.of(y.x))};
}

const plant::EmfPiece<double>& emf_piece(const plant::Plant<double>& plant) {
  return plant.constants().emf[static_cast<std::size_t>(plant.mode().sector)].piece[plant.mode().piece];
}

Series emf_series(const Span& part, int k) {
  if (part.g.plant.general) return part.of(part.g.plant.general->series().emf[k]);
  const SpeedShapes shapes = speed_shapes(part);
  const plant::EmfPiece<double>& p = emf_piece(*part.g.plant.lean);
  Series e{};
  add(e, p.alpha[k], shapes.w0);
  add(e, p.beta[k], shapes.w1);
  return e;
}

/// Adds the star point's voltage if no leg is connected: u_n = (U_s - e_high - e_low)/2, with the bus voltage
/// U_s and the highest and the lowest back-EMF (plant/circuit.hpp). Other legs become the highest or the
/// lowest only at edges of sectors and pieces, because the shapes are symmetric about their tops and cross at
/// these edges. If the rotor turns backwards, the highest and the lowest leg are exchanged, which does not
/// change the sum of both back-EMFs.
void add_floating_star(const Span& part, const SpeedShapes& shapes, Series& u) {
  const plant::Plant<double>& plant = *part.g.plant.lean;
  const plant::EmfPiece<double>& p = emf_piece(plant);
  const double x = (p.from + p.to) / 2;
  const base::SinCos turn = plant.constants().sine ? base::sin_cos(x) : base::SinCos{x, 1.0};
  const auto shape = [&](int k) { return p.alpha[k] * turn.cos + p.beta[k] * turn.sin; };
  int high = 0, low = 0;
  for (int k = 1; k < 3; ++k) {
    if (shape(k) > shape(high)) high = k;
    if (shape(k) < shape(low)) low = k;
  }
  add(u, 0.5, part.of(plant.expansion().bus));
  add(u, -(p.alpha[high] + p.alpha[low]) / 2, shapes.w0);
  add(u, -(p.beta[high] + p.beta[low]) / 2, shapes.w1);
}

/// Like add_floating_star(), for the general kernel. If no leg is connected, its pole voltages are the
/// back-EMFs e_k. The highest and the lowest leg are determined in the middle of the part.
void add_general_floating_star(const Span& part, Series& u) {
  const auto& emf = part.g.plant.general->series().emf;
  const int degree = part.g.plant.expansion().degree;
  PerLeg<double> middle;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = series::evaluate(emf[k], degree, (part.from + part.to) / 2);
  const auto [high, low] = plant::general::star_ends(middle, part.g.plant.general->dead());
  add(u, 0.5, part.of(part.g.plant.expansion().bus));
  add(u, -0.5, part.of(emf[high]));
  add(u, -0.5, part.of(emf[low]));
}

/// Terminal voltage u_n + e_k of a floating leg: star point plus back-EMF (model.md 2).
Series floating_series(const Span& part, int k) {
  const bool free = plant::connected_count(part.g.plant.legs()) == 0;
  Series u{};
  if (part.g.plant.general) {
    u = part.of(part.g.plant.general->series().pole[k]);
    if (free) add_general_floating_star(part, u);
    return u;
  }
  const plant::Plant<double>& plant = *part.g.plant.lean;
  const auto& y = plant.expansion();
  const plant::Mode& mode = plant.mode();
  const plant::Constants<double>& c = plant.constants();
  const plant::PoleLaw<double> law = plant::pole_law(c.emf[mode.sector].piece[mode.piece],
                                                     c.legs[legs_index(mode.legs)], static_cast<unsigned>(k));
  const SpeedShapes shapes = speed_shapes(part);
  add(u, law.w0, shapes.w0);
  add(u, law.w1, shapes.w1);
  if (law.bus != 0) add(u, law.bus, part.of(y.bus));
  if (law.i != 0) add(u, law.i, part.of(y.i[law.leg]));
  u[0] += law.offset;
  if (free) add_floating_star(part, shapes, u);
  return u;
}

/// Terminal voltage u_k, including the voltage across the leg's conducting device (model.md 2).
Series pole_series(const Span& part, int k) {
  const plant::View& plant = part.g.plant;
  if (plant::is_floating(plant.legs()[k])) return floating_series(part, k);
  const auto& terms = plant.terms(k);
  Series u{};
  add(u, terms.bus_share, part.of(plant.expansion().bus));
  add(u, -terms.r_ohm, part.of(plant.expansion().i[k]));
  u[0] += terms.offset_V;
  return u;
}

Series line_series(const Span& part, int from_leg, int to_leg) {
  Series u = pole_series(part, from_leg);
  add(u, -1.0, pole_series(part, to_leg));
  return u;
}

/// The power that the devices dissipate: sum over the legs k of r_k i_k^2 - offset_k i_k, with a device's
/// resistance r_k and voltage -offset_k (plant/circuit.hpp).
Series device_loss(const Span& part) {
  Series loss{};
  for (int k = 0; k < 3; ++k) {
    const auto& terms = part.g.plant.terms(k);
    const Series i = part.of(part.g.plant.expansion().i[k]);
    if (terms.r_ohm != 0) add(loss, terms.r_ohm, part.product(i, i));
    add(loss, -terms.offset_V, i);
  }
  return loss;
}

Series copper_loss(const Span& part) {
  const plant::View& plant = part.g.plant;
  Series loss{};
  for (int k = 0; k < 3; ++k) {
    const Series i = part.of(plant.expansion().i[k]);
    add(loss, plant.lean ? plant.lean->constants().R : plant.general->constants().R[k], part.product(i, i));
  }
  if (plant.general && plant.general->constants().has_loop) {
    const Series loop = part.of(plant.general->series().loop);
    add(loss, plant.general->constants().loop_R / 3, part.product(loop, loop));
  }
  return loss;
}

/// Friction loss B w^2 + T_c |w| (viscous friction B, dry friction T_c, speed w) and the loss in an elastic
/// shaft: all torques against the motion except the load's.
Series friction_loss(const Span& part) {
  const plant::View& plant = part.g.plant;
  const Series w = part.of(plant.expansion().w);
  Series loss{};
  if (plant.lean) {
    const auto [load, dry, per_speed] = plant::torques(plant.lean->constants(), plant.motion());
    add(loss, per_speed, part.product(w, w));
    add(loss, dry, w);
    return loss;
  }
  const auto& c = plant.general->constants();
  add(loss, c.B, part.product(w, w));
  add(loss, plant::against(plant.motion(), c.coulomb), w);
  if (!c.elastic) return loss;
  const Series load_w = part.of(plant.general->series().load_w);
  Series slip = load_w;
  for (std::size_t n = 0; n < slip.size(); ++n) slip[n] = c.inv_gear * w[n] - load_w[n];
  add(loss, c.load_B, part.product(load_w, load_w));
  add(loss, c.damping, part.product(slip, slip));
  return loss;
}

/// Power at the load's side of gear and coupling.
Series load_power(const Span& part) {
  const plant::View& plant = part.g.plant;
  if (plant.general)
    return part.product(part.of(plant.general->series().load), part.of(plant.general->series().load_w));
  const auto [load, dry, per_speed] = plant::torques(plant.lean->constants(), plant.motion());
  Series power{};
  add(power, load, part.of(plant.expansion().w));
  return power;
}

Series supply_power(const Span& part) {
  const auto& y = part.g.plant.expansion();
  return part.product(part.of(y.bus), part.of(weighted_current(bus_current_weights(part.g.plant), y)));
}

/// The bridge's input power minus its devices' losses.
Series motor_power(const Span& part) {
  Series p = supply_power(part);
  add(p, -1.0, device_loss(part));
  return p;
}

Series mechanical_power(const Span& part) {
  return part.product(part.of(part.g.plant.expansion().torque), part.of(part.g.plant.expansion().w));
}

template <int k>
Series pole(const Span& part) {
  return pole_series(part, k);
}
template <int k>
Series line(const Span& part) {
  return line_series(part, k, (k + 1) % 3);
}
template <int k>
Series emf(const Span& part) {
  return emf_series(part, k);
}

struct ProductSignal {
  Signal signal;
  Series (*series)(const Span&);
};
constexpr ProductSignal product_signals[] = {
    {Signal::pole_a, pole<0>},
    {Signal::pole_b, pole<1>},
    {Signal::pole_c, pole<2>},
    {Signal::line_ab, line<0>},
    {Signal::line_bc, line<1>},
    {Signal::line_ca, line<2>},
    {Signal::emf_a, emf<0>},
    {Signal::emf_b, emf<1>},
    {Signal::emf_c, emf<2>},
    {Signal::supply_power, supply_power},
    {Signal::motor_power, motor_power},
    {Signal::mechanical_power, mechanical_power},
    {Signal::copper_loss, copper_loss},
    {Signal::device_loss, device_loss},
    {Signal::friction_loss, friction_loss},
    {Signal::load_power, load_power},
};

constexpr const ProductSignal* product_signal(Signal signal) {
  for (const ProductSignal& row : product_signals)
    if (row.signal == signal) return &row;
  return nullptr;
}

static_assert([] {
  for (const SignalFact& fact : signal_facts)
    if ((product_signal(fact.signal) != nullptr) != is_product(fact.signal)) return false;
  return true;
}());

}  // namespace

Piece product_piece(const SegmentView& g, Signal signal, double from, double to) {
  const Span part{g, from, to};
  const ProductSignal* row = product_signal(signal);
  return {row ? row->series(part) : Series{}, part.degree()};
}

}  // namespace sixstep::study
