// SPDX-License-Identifier: Apache-2.0
// The values of several motors in one register, as a scalar type for the plant's templates: the vector
// extension of GCC and clang, with a scalar's conversions. Used only in the benchmarks; the library has pairs
// (series/nodes.hpp).
#pragma once
#include <cstddef>
#include <type_traits>

namespace benchmarks {

typedef double TwoDoubles __attribute__((vector_size(16)));
typedef double FourDoubles __attribute__((vector_size(32)));
typedef double EightDoubles __attribute__((vector_size(64)));

template <int width>
struct Lanes {
  using Vector =
      std::conditional_t<width == 2, TwoDoubles, std::conditional_t<width == 4, FourDoubles, EightDoubles>>;
  static_assert(sizeof(Vector) == width * sizeof(double));
  Vector v;

  Lanes() = default;
  template <class Number>
  requires std::is_arithmetic_v<Number>
  constexpr Lanes(Number x) : v(Vector{} + static_cast<double>(x)) {}

  double operator[](std::size_t lane) const { return v[lane]; }
  void set(std::size_t lane, double x) { v[lane] = x; }

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return raw(a.v + b.v); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return raw(a.v - b.v); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return raw(a.v * b.v); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return raw(a.v / b.v); }
  friend Lanes operator-(const Lanes& a) { return raw(-a.v); }
  Lanes& operator+=(const Lanes& b) {
    v += b.v;
    return *this;
  }

 private:
  static Lanes raw(const Vector& v) {
    Lanes out;
    out.v = v;
    return out;
  }
};

inline double lane(double x, std::size_t) { return x; }
template <int width>
double lane(const Lanes<width>& x, std::size_t n) {
  return x[n];
}
inline void set_lane(double& x, std::size_t, double value) { x = value; }
template <int width>
void set_lane(Lanes<width>& x, std::size_t n, double value) {
  x.set(n, value);
}

}  // namespace benchmarks
