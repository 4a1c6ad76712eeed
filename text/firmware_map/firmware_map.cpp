// SPDX-License-Identifier: Apache-2.0
#include "text/firmware_map/firmware_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "text/toml/table_reader.hpp"

namespace text {
namespace {

constexpr int most_input = 7;

/// The keys of a map as written in the file.
struct MapFile {
  std::string chip, elf;
  std::vector<std::string> hall{"PK0", "PK1", "PK2"}, upper{"PB5", "PB6", "PB7"}, lower{"PA0", "PA1", "PA2"};
  std::vector<double> currents{0, 1, 2};
  int potentiometer = 3;
  double setpoint_range = 1.0;
};

void describe(base::Visitor& v, MapFile& w) {
  v.value("chip", w.chip, {.meaning = "the chip, \"atmega2560\"", .required = true});
  v.value("elf", w.elf, {.meaning = "ELF file of the program, as the linker wrote it", .required = true});
  v.value("hall", w.hall, {.meaning = "pins of the Hall lines H1 H2 H3, of port K"});
  v.value("upper", w.upper, {.meaning = "pins of the upper gates of legs a, b, c"});
  v.value("lower", w.lower, {.meaning = "pins of the lower gates of legs a, b, c"});
  v.value("currents", w.currents, {.meaning = "the converter's inputs at the transducers of legs a, b, c"});
  v.value("potentiometer", w.potentiometer,
          {.meaning = "the converter's input at the potentiometer", .range = base::from(0)});
  v.value(
      "setpoint_range", w.setpoint_range,
      {.meaning =
           "setpoint at the potentiometer's upper end, in the mode's unit; at the lower end minus this value, in the middle 0",
       .range = base::above(0),
       .required = true});
}

/// Whether the text names a pin: P, a port from A to L except I, and a bit from 0 to 7.
bool is_pin(const std::string& pin) {
  return pin.size() == 3 && pin[0] == 'P' && pin[1] >= 'A' && pin[1] <= 'L' && pin[1] != 'I' &&
         pin[2] >= '0' && pin[2] <= '7';
}

void refuse(Complaints& c, const char* key, const std::string& limit, const std::string& cure) {
  c.later({.where = key, .value = "", .limit = limit, .cure = cure});
}

void check_pins(const MapFile& w, Complaints& c) {
  std::set<std::string> taken;
  for (const auto& [key, pins] : {std::pair{"hall", &w.hall}, {"upper", &w.upper}, {"lower", &w.lower}}) {
    if (pins->size() != 3 || !std::all_of(pins->begin(), pins->end(), is_pin))
      refuse(c, key, "is not three pins",
             "name the pins as the data sheet does: [\"PK0\", \"PK1\", \"PK2\"]");
    for (const std::string& pin : *pins)
      if (!taken.insert(pin).second)
        refuse(c, key, fmt::format("names {} a second time", pin), "name a different pin for each line");
  }
  if (std::any_of(w.hall.begin(), w.hall.end(),
                  [](const std::string& pin) { return pin.rfind("PK", 0) != 0; }))
    refuse(c, "hall", "must be pins of port K, the only port whose pin-change interrupt is simulated",
           "name three of the pins PK0 to PK7");
}

void check_inputs(const MapFile& w, Complaints& c) {
  std::set<double> inputs(w.currents.begin(), w.currents.end());
  inputs.insert(w.potentiometer);
  const auto is_input = [](double n) { return n >= 0 && n <= most_input && n == static_cast<int>(n); };
  if (w.currents.size() != 3 || inputs.size() != 4 || !std::all_of(inputs.begin(), inputs.end(), is_input))
    refuse(c, "currents", "must be three inputs of the converter that differ from the potentiometer's input",
           "name four different inputs, each 0 to 7");
}

}  // namespace

base::Result<FirmwareMap> read_firmware_map(const std::string& name, std::string text) {
  const base::Result<Document> document = Document::parse(name, std::move(text));
  if (!document) return document.problems();
  Complaints complaints(*document);
  MapFile w;
  read_root(*document, w, complaints);
  if (complaints.empty()) {
    if (w.chip != "atmega2560") refuse(complaints, "chip", "has no emulator", "write chip = \"atmega2560\"");
    check_pins(w, complaints);
    check_inputs(w, complaints);
  }
  if (!complaints.empty()) return complaints.in_order();
  FirmwareMap map{w.elf, w.hall, w.upper, w.lower, {}, w.potentiometer, w.setpoint_range};
  for (const double input : w.currents) map.currents.push_back(static_cast<int>(input));
  return map;
}

}  // namespace text
