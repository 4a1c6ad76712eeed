// SPDX-License-Identifier: Apache-2.0
// Lists which shapes of a reference read which of its keys. No other file lists them. A key that only another
// shape reads is refused, because its author expected an effect. tests/study/reference_keys_test.cpp tests
// every key with every shape.
#pragma once
#include <initializer_list>
#include <string>

#include "sixstep/study/scenario/choices.hpp"
#include "sixstep/study/scenario/reference.hpp"

namespace sixstep::study {

struct ShapeKey {
  const char* key;
  unsigned read_by;                 ///< one bit per Shape
  bool (*given)(const Reference&);  ///< true: the key's value differs from the default
};

constexpr unsigned shapes(std::initializer_list<Shape> list) {
  unsigned bits = 0;
  for (const Shape shape : list) bits |= 1u << static_cast<unsigned>(shape);
  return bits;
}

namespace by_shape {
inline constexpr unsigned constant = shapes({Shape::constant}), lists = shapes({Shape::steps, Shape::csv}),
                          square = shapes({Shape::square}), ways = shapes({Shape::ramp, Shape::trapezoid}),
                          ramp = shapes({Shape::ramp}), trapezoid = shapes({Shape::trapezoid}),
                          sine = shapes({Shape::sine}), csv = shapes({Shape::csv});
}  // namespace by_shape

/// All keys of a reference except shape and unit, which every shape has.
inline constexpr ShapeKey shape_keys[] = {
    {"value", by_shape::constant, [](const Reference& r) { return r.value != 0; }},
    {"times_s", by_shape::lists, [](const Reference& r) { return !r.times_s.empty(); }},
    {"values", by_shape::lists, [](const Reference& r) { return !r.values.empty(); }},
    {"high", by_shape::square, [](const Reference& r) { return r.high != 0; }},
    {"low", by_shape::square, [](const Reference& r) { return r.low != 0; }},
    {"period_s", by_shape::square, [](const Reference& r) { return r.period_s != Reference{}.period_s; }},
    {"begin_s", by_shape::ways, [](const Reference& r) { return r.begin_s != 0; }},
    {"start", by_shape::ways, [](const Reference& r) { return r.start.has_value(); }},
    {"end", by_shape::ways, [](const Reference& r) { return r.end != 0; }},
    {"end_s", by_shape::ramp, [](const Reference& r) { return r.end_s.has_value(); }},
    {"slope", by_shape::ways, [](const Reference& r) { return r.slope.has_value(); }},
    {"acceleration", by_shape::trapezoid, [](const Reference& r) { return r.acceleration.has_value(); }},
    {"offset", by_shape::sine, [](const Reference& r) { return r.offset != 0; }},
    {"amplitude", by_shape::sine, [](const Reference& r) { return r.amplitude != 0; }},
    {"frequency_Hz", by_shape::sine, [](const Reference& r) { return r.frequency_Hz != 0; }},
    {"phase_deg", by_shape::sine, [](const Reference& r) { return r.phase_deg != 0; }},
    {"file", by_shape::csv, [](const Reference& r) { return !r.file.empty(); }},
    {"column", by_shape::csv, [](const Reference& r) { return r.column.has_value(); }},
    {"interpolation", by_shape::csv,
     [](const Reference& r) { return r.interpolation != Interpolation::linear; }},
};

constexpr bool reads(Shape shape, const ShapeKey& key) { return (key.read_by & shapes({shape})) != 0; }

/// The shapes that read a key, quoted as in a file: "ramp" or "trapezoid".
inline std::string readers_of(const ShapeKey& key) {
  std::string words;
  for (const auto& choice : shape_choices)
    if (reads(choice.value, key)) {
      if (!words.empty()) words += " or ";
      words += '"';
      words += choice.word;
      words += '"';
    }
  return words;
}

}  // namespace sixstep::study
