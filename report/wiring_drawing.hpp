// SPDX-License-Identifier: Apache-2.0
// Draws the elements of the wiring pictures: polylines with only the visible points, and a mark and a colour
// for each behaviour.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/analysis/wiring/wiring_study.hpp"

namespace report {

/// A drawing with its size in pixels, without the surrounding <svg>.
struct Panel {
  double width = 0.0, height = 0.0;
  std::string svg;
};

struct Place {
  double x = 0.0, y = 0.0;
};

/// A path "M..l.." in tenths of a pixel, for a group that is scaled by 0.1. Points within 0.3 pixels of a
/// straight line are omitted.
std::string line_through(const std::vector<Place>& points);

/// The style class of a behaviour: "forward", "rough", "hums", "backward", "unclear".
std::string_view style_of(sixstep::analysis::WiringDoes does);

/// An arrow in the direction of motion, or a wave for humming, in a box of 12 pixels.
std::string mark_of(sixstep::analysis::WiringDoes does, double x, double y);

/// Lines of text of at most `width` characters, `leading` pixels apart. The first baseline is at y.
std::string wrapped(std::string_view text, std::size_t width, double x, double y, double leading,
                    std::string_view style = "");
/// The number of lines that wrapped() writes.
std::size_t lines_of(std::string_view text, std::size_t width);

/// The ratio as text: "×17" for 17 times the phase current of straight wires.
std::string times_text(double ratio);

/// The style rules of these drawings, in the colours of the page.
std::string_view wiring_style();

}  // namespace report
