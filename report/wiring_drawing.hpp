// SPDX-License-Identifier: Apache-2.0
// What the pictures of a motor's wirings are drawn with: lines that carry no more points than one sees, the marks and colours of
// what a wiring does.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/wiring/wiring_study.hpp"

namespace report {

/// A drawing in its own pixels, without the <svg> around it.
struct Panel {
  double width = 0.0, height = 0.0;
  std::string svg;
};

struct Place {
  double x = 0.0, y = 0.0;
};

/// "M..l.." in tenths of a pixel, for a group scaled by 0.1: what lies within 0.3 pixels of a straight line is left out.
std::string line_through(const std::vector<Place>& points);

/// The style's class of a wiring: "forward", "rough", "hums", "backward", "unclear".
std::string_view style_of(sixstep::analysis::WiringDoes does);

/// An arrow to where it runs, a wave for what hums, in a box of 12 pixels.
std::string mark_of(sixstep::analysis::WiringDoes does, double x, double y);

/// Lines of text of at most `width` characters, `leading` pixels apart, from the first one's baseline on.
std::string wrapped(std::string_view text, std::size_t width, double x, double y, double leading,
                    std::string_view style = "");
/// How many lines that makes.
std::size_t lines_of(std::string_view text, std::size_t width);

/// "×17": the phase current compared with that of straight wires.
std::string times_text(double ratio);

/// The rules of all these drawings, in the colours of the page around them.
std::string_view wiring_style();

}  // namespace report
