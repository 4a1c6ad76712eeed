// SPDX-License-Identifier: Apache-2.0
#include "report/sankey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "report/figures.hpp"
#include "report/html.hpp"

namespace report {
namespace {

using sixstep::study::EnergyBook;

// Sizes of the drawing in pixels. A label has two lines, and labels must not overlap. The space above the
// drawing is for the nodes' names.
constexpr double sankey_width = 940, full = 130, label_height = 36, sankey_gap = 10, sankey_margin = 20,
                 sankey_bar = 10;
constexpr double source_x = 190, first_x = 340, second_x = 560, sink_x = 750;
constexpr double text_height = 18;
constexpr double thinnest = 1.0;  // every flow remains visible
constexpr double least = 1e-4;    // fraction of the largest flow; smaller flows are only in the table below
                                  // the drawing

/// Energy that enters or leaves a node.
struct Flow {
  const char* name;
  const char* style;  ///< style class: "passed", "heat", "kept"
  double joule;
  double y = 0.0;  ///< middle of the flow in the outer column
};

/// A node: bridge and windings, or rotor and shaft. The sum of the incoming flows is equal to the sum of the
/// outgoing flows.
struct Node {
  const char* name;
  std::vector<Flow> in, out;
  double y = 0.0;
};

/// Adds a term of a balance whose sum is zero. A positive term is a source, a negative term a sink; each has
/// its own name.
void add(Node& node, double joule, const char* giving, const char* given_style, const char* taking,
         const char* taken_style) {
  if (joule > 0.0) node.in.push_back({giving, given_style, joule});
  if (joule < 0.0) node.out.push_back({taking, taken_style, -joule});
}

double sum(const std::vector<Flow>& flows) {
  double total = 0.0;
  for (const Flow& flow : flows) total += flow.joule;
  return total;
}

/// The drawing from left to right: the first node passes the energy `between` to the second.
struct Drawing {
  Node first, second;
  double between = 0.0;
  double pixels = 0.0;  ///< pixels per joule
  double height = 0.0;
  double wide(double joule) const { return std::max(joule * pixels, thinnest); }
};

Node electrical(const EnergyBook& b) {
  Node node{"bridge and windings", {}, {}};
  add(node, b.supplied, "Supplied by the bus", "passed", "Fed back to the bus", "passed");
  add(node, -b.magnetic, "From the magnetic field", "kept", "Into the magnetic field", "kept");
  add(node, -b.copper, "", "", "Copper", "heat");
  add(node, -b.devices, "", "", "Switches and diodes", "heat");
  return node;
}

Node mechanical(const EnergyBook& b) {
  Node node{"rotor and shaft", {}, {}};
  add(node, -b.load, "Driven by the load", "passed", "Load", "passed");
  add(node, -b.kinetic, "From kinetic energy", "kept", "Into kinetic energy", "kept");
  add(node, -(b.friction - b.iron), "", "", b.iron != 0.0 ? "Bearing friction" : "Friction", "heat");
  add(node, -b.iron, "", "", "Iron drag", "heat");
  return node;
}

/// Places the flows one below the other from `top` on, each with space for its label. Returns the top of the
/// next flow.
double place(std::vector<Flow>& flows, const Drawing& d, double top) {
  for (Flow& flow : flows) {
    const double room = std::max(d.wide(flow.joule), label_height);
    flow.y = top + room / 2;
    top += room + sankey_gap;
  }
  return top;
}

/// Sources are on the left, sinks on the right. The flows of the second node are above the flows of the first
/// node, so that no bands cross.
void arrange(Drawing& d) {
  d.second.y = sankey_margin;
  d.first.y = place(d.second.in, d, sankey_margin);
  if (!d.second.in.empty())
    d.first.y += text_height;  // the node's name is below the bands of the second
                               // node's sources
  const double left = place(d.first.in, d, d.first.y);
  // The first node's outgoing bands pass below the second node's bar.
  const double below = std::max(place(d.second.out, d, sankey_margin),
                                sankey_margin + d.wide(sum(d.second.in) + d.between) + sankey_gap);
  const double right = place(d.first.out, d, below);
  d.height = std::max(left, right) - sankey_gap + sankey_margin;
}

std::string band(const Flow& flow, double x0, double y0, double x1, double y1, double wide) {
  const double middle = (x0 + x1) / 2;
  return fmt::format(
      "<path class=\"{}\" stroke-width=\"{:.2f}\" d=\"M{:.1f} {:.2f}C{:.1f} {:.2f} {:.1f} {:.2f} {:.1f} "
      "{:.2f}\"/>\n",
      flow.style, wide, x0, y0, middle, y0, middle, y1, x1, y1);
}

std::string label(const Flow& flow, double x, const char* anchor, const Scale& scale) {
  return fmt::format(
      "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"{2}\">{3}</text><text class=\"value\" x=\"{0:.1f}\" "
      "y=\"{4:.1f}\" text-anchor=\"{2}\">{5}</text>\n",
      x, flow.y - 4, anchor, flow.name, flow.y + 13, plain(flow.joule * scale.factor, 4) + " " + scale.unit);
}

/// The bands and the bar of one node. Energy also passes from the first node to the second: `outgoing` leaves
/// the first node above its sinks, `incoming` enters the second node below its sources.
std::string bands(const Node& node, const Drawing& d, double x, double outgoing, double incoming,
                  const Scale& scale) {
  std::string html;
  double y = node.y;
  for (const Flow& flow : node.in) {
    const double wide = d.wide(flow.joule);
    html += band(flow, source_x, flow.y, x, y + wide / 2, wide) + label(flow, source_x - 8, "end", scale);
    y += wide;
  }
  double end = incoming > 0.0 ? y + d.wide(incoming) : y;
  y = node.y + (outgoing > 0.0 ? d.wide(outgoing) : 0.0);
  for (const Flow& flow : node.out) {
    const double wide = d.wide(flow.joule);
    html += band(flow, x + sankey_bar, y + wide / 2, sink_x, flow.y, wide) +
            label(flow, sink_x + 8, "start", scale);
    y += wide;
  }
  end = std::max(end, y);
  if (end > node.y)
    html += fmt::format(
        "<rect x=\"{0:.1f}\" y=\"{1:.2f}\" width=\"{2}\" height=\"{3:.2f}\"/><text class=\"value\" "
        "x=\"{4:.1f}\" y=\"{5:.2f}\" text-anchor=\"{6}\">{7}</text>\n",
        x, node.y, sankey_bar, end - node.y, x < second_x ? x + sankey_bar : x, node.y - 6,
        x < second_x ? "end" : "start", node.name);
  return html;
}

std::string across(const Drawing& d, const Scale& scale) {
  if (d.between == 0.0) return "";
  const double wide = d.wide(d.between);
  double y = d.second.y;
  for (const Flow& flow : d.second.in) y += d.wide(flow.joule);
  const Flow flow{"", "passed", d.between};
  const double left = d.first.y + wide / 2, right = y + wide / 2;
  // The label is on the band. If the band is too thin, the label is above it, or below it if the band rises
  // to the right.
  const bool thin = wide < text_height, climbs = thin && left - right > text_height;
  const double x = (first_x + sankey_bar + second_x) / 2, middle = (left + right) / 2;
  const double base = !thin ? middle + 4 : climbs ? middle + wide / 2 + text_height : middle - wide / 2 - 5;
  return band(flow, first_x + sankey_bar, left, second_x, right, wide) +
         fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">across the air gap {} {}</text>\n",
                     x, base, climbs ? "start" : "middle", plain(d.between * scale.factor, 4), scale.unit);
}

/// The content of the drawing in words, for screen readers.
std::string spoken(const Drawing& d, const Scale& scale) {
  const auto list = [&](const std::vector<Flow>& one, const std::vector<Flow>& other) {
    std::string text;
    for (const auto* flows : {&one, &other})
      for (const Flow& flow : *flows)
        text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", flow.name,
                            plain(flow.joule * scale.factor, 4), scale.unit);
    return text;
  };
  return fmt::format("Energy of the run, from left to right. Sources: {}. Sinks: {}.",
                     list(d.second.in, d.first.in), list(d.second.out, d.first.out));
}

void drop_small(std::vector<Flow>& flows, double smallest) {
  std::erase_if(flows, [&](const Flow& flow) { return !(flow.joule >= smallest); });
}

}  // namespace

std::string energy_sankey(const EnergyBook& b) {
  const bool braking = b.air_gap < 0.0;
  Drawing d{braking ? mechanical(b) : electrical(b), braking ? electrical(b) : mechanical(b),
            std::abs(b.air_gap)};
  const double largest = std::max(sum(d.first.in), sum(d.second.in) + d.between);
  if (!(largest > 0.0) || !std::isfinite(largest)) return "";
  d.pixels = full / largest;
  const double missing = std::max(std::abs(sum(d.first.in) - sum(d.first.out) - d.between),
                                  std::abs(sum(d.second.in) + d.between - sum(d.second.out)));
  if (!(missing * d.pixels < 0.5)) return "";
  for (auto* flows : {&d.first.in, &d.first.out, &d.second.in, &d.second.out})
    drop_small(*flows, least * largest);
  if (d.between < least * largest) d.between = 0.0;
  arrange(d);
  const Scale scale = scale_for(largest, "J");
  std::string html =
      fmt::format("<figure class=\"sankey\"><svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
                  sankey_width, d.height, escaped(spoken(d, scale)));
  html +=
      bands(d.first, d, first_x, d.between, 0.0, scale) + bands(d.second, d, second_x, 0.0, d.between, scale);
  return html + across(d, scale) + "</svg></figure>\n";
}

}  // namespace report
