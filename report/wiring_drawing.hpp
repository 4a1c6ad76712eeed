// SPDX-License-Identifier: Apache-2.0
// Draws the elements of the wiring pictures: lines with no more points than are visible, and the marks and
// colours of each behaviour.
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

/// "M..l.." in tenths of a pixel, for a group scaled by 0.1; points within 0.3 pixels of a straight line are
/// left out.
std::string line_through(const std::vector<Place>& points);

/// The style class of a behaviour: "forward", "rough", "hums", "backward", "unclear".
std::string_view style_of(sixstep::analysis::WiringDoes does);

/// An arrow in the direction of motion, or a wave for humming, in a box of 12 pixels.
std::string mark_of(sixstep::analysis::WiringDoes does, double x, double y);

/// Lines of text of at most `width` characters, `leading` pixels apart, beginning at the first baseline.
std::string wrapped(std::string_view text, std::size_t width, double x, double y, double leading,
                    std::string_view style = "");
/// The number of lines that wrapped() makes.
std::size_t lines_of(std::string_view text, std::size_t width);

/// "×17": the phase current relative to that with straight wires.
std::string times_text(double ratio);

/// The style rules of these drawings, in the colours of the page.
std::string_view wiring_style();

}  // namespace report
