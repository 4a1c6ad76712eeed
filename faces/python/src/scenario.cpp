// SPDX-License-Identifier: Apache-2.0
#include "faces/python/src/scenario.hpp"

#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "faces/python/src/problems.hpp"
#include "files/scenario_on_disk.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/scenario/spread.hpp"
#include "text/keys/key_catalog.hpp"
#include "text/motor/motor_library.hpp"
#include "text/scenario/scenario_file.hpp"
#include "text/scenario/scenario_text.hpp"

namespace python {

namespace py = pybind11;

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Resolves file names as the command line does. If a controller is given, every controller's name refers to
/// it.
text::Resolve resolve_with(const std::string& data_dir, const std::shared_ptr<Controller>& controller) {
  return [on_disk = files::on_disk(data_dir), controller](const text::Naming& naming) {
    if (controller && naming.kind == text::Naming::Kind::controller)
      return base::Result<text::NamedText>(
          text::NamedText{.name = naming.name, .text = {}, .controller = controller->functions()});
    return on_disk(naming);
  };
}

HeldScenario read(const std::string& name, std::string source, const Settings& settings,
                  const std::string& data_dir, std::shared_ptr<Controller> controller) {
  text::ReadOptions options{.overrides = {}, .resolve = resolve_with(data_dir, controller)};
  for (const auto& [key, value] : settings) options.overrides.push_back({key, value});
  study::Scenario scenario = taken(text::read_scenario_text(name, std::move(source), options));
  return {std::move(scenario), std::move(controller)};
}

/// A tuple for each key: the key, its value as TOML, and whether omitting the key gives the same value.
std::vector<std::tuple<std::string, std::string, bool>> values(const HeldScenario& held) {
  std::vector<std::tuple<std::string, std::string, bool>> out;
  for (text::WrittenValue& value : text::scenario_values(held.scenario))
    out.emplace_back(std::move(value.path), std::move(value.text), value.usual);
  return out;
}

py::dict entry(const text::KeyEntry& key) {
  py::dict out;
  out["path"] = key.path;
  out["meaning"] = std::string(key.about.meaning);
  out["unit"] = std::string(key.about.unit);
  out["frame"] = std::string(key.about.frame);
  out["default"] = key.default_value;
  out["choices"] = key.choices;
  out["table"] = key.type == text::KeyType::table || key.type == text::KeyType::list;
  out["required"] = key.about.required;
  out["help"] = text::help_text(key);
  return out;
}

py::list entries(const std::vector<text::KeyEntry>& keys) {
  py::list out;
  for (const text::KeyEntry& key : keys) out.append(entry(key));
  return out;
}

/// A tuple for each column that a run of the scenario records: name, unit, frame, meaning.
std::vector<std::tuple<std::string, std::string, std::string, std::string>> columns(
    const HeldScenario& held) {
  std::vector<std::tuple<std::string, std::string, std::string, std::string>> out;
  for (const study::Column& c : taken(study::record_columns(held.scenario)))
    out.emplace_back(c.name, c.unit, c.frame, c.meaning);
  return out;
}

}  // namespace

void declare_scenario(py::module_& module) {
  py::class_<HeldScenario>(module, "Scenario", "A checked scenario.")
      .def_property_readonly("duration_s", [](const HeldScenario& held) { return held.scenario.duration_s; })
      .def_property_readonly("period_s", [](const HeldScenario& held) { return held.scenario.pwm.period_s; })
      .def_property_readonly("motor", [](const HeldScenario& held) { return held.scenario.motor; })
      .def("values", &values)
      .def("columns", &columns)
      .def("text", [](const HeldScenario& held) { return text::scenario_text(held.scenario); })
      .def("drive", [](const HeldScenario& held, std::uint64_t seed, std::uint64_t number) {
        return HeldScenario{study::varied(held.scenario, seed, number), held.controller};
      });
  module.def("read", &read, py::arg("name"), py::arg("source"), py::arg("settings"), py::arg("data_dir"),
             py::arg("controller") = nullptr);
  module.def("scenario_keys", [] { return entries(text::scenario_keys()); });
  module.def("motor_keys", [] { return entries(text::sheet_keys()); });
  module.def("motors", &text::built_in_motors);
}

}  // namespace python
