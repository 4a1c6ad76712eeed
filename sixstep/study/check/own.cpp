// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/check/own.hpp"

#include <algorithm>
#include <string_view>

#include "sixstep/base/written.hpp"
#include "sixstep/study/check/field.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace sixstep::study {

namespace {

static_assert(sizeof(sixstep_real) == sizeof(double), "SIXSTEP_REAL is for programs on a chip");
constexpr std::uint32_t most_bytes = 65536, most_numbers = 64;
/// Interface number of a controller that was compiled for a chip.
constexpr std::uint32_t in_float = SIXSTEP_OWN_INTERFACE + 256;

bool is_name(const char* text) {
  if (text == nullptr || *text == 0) return false;
  const std::string_view all = text;
  return std::all_of(all.begin(), all.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

std::string names_of(const sixstep_controller& is) {
  std::string names;
  for (std::uint32_t n = 0; n < is.parameters; ++n)
    names += (n == 0 ? "" : ", ") + std::string(is.parameter[n].name);
  return names;
}

const sixstep_parameter* parameter(const sixstep_controller& is, const std::string& name) {
  for (std::uint32_t n = 0; n < is.parameters; ++n)
    if (name == is.parameter[n].name) return &is.parameter[n];
  return nullptr;
}

void check_own_numbers(const Own& own, base::Problems& out) {
  for (std::size_t n = 0; n < own.number.size(); ++n) {
    const OwnNumber& given = own.number[n];
    const std::string where = "control.own.number[" + std::to_string(n) + "]";
    const sixstep_parameter* is = parameter(*own.loaded, given.name);
    if (is == nullptr) {
      const std::string names = names_of(*own.loaded);
      out.push_back(
          {where + ".name", '"' + given.name + '"', "is not the name of a number of the controller",
           names.empty() ? "remove this key: the controller has no numbers" : "use one of: " + names});
    } else if (!(given.value >= is->least && given.value <= is->most)) {
      out.push_back(
          {where + ".value", base::written(given.value),
           "must be in " + base::six_digits(is->least) + ".." + base::six_digits(is->most) + " " + is->unit,
           "give a value in this range"});
    }
    const auto same = [&](const OwnNumber& other) { return other.name == given.name; };
    if (std::any_of(own.number.begin(), own.number.begin() + static_cast<std::ptrdiff_t>(n), same))
      out.push_back(
          {where + ".name", '"' + given.name + '"', "is given twice", "remove one of the two entries"});
  }
}

/// Refuses keys of the library's own loops.
void check_around(const Scenario& s, base::Problems& out) {
  const Control& c = s.control;
  const auto refuse = [&out](bool given, const char* key, const char* limit, const char* cure) {
    if (given) out.push_back({key, "", limit, cure});
  };
  const char* const its_own = "applies to the built-in loops, and a user's controller runs none of them";
  refuse(c.mode == control::Mode::off, "control.mode", "= \"off\" runs no controller",
         "set mode = \"duty\", \"current\", \"speed\" or \"position\"");
  if (c.arithmetic != Arithmetic::float64)
    out.push_back({"control.arithmetic", std::string(base::word(arithmetic_choices, c.arithmetic)),
                   "applies to the built-in controllers: a user's controller has its own number types",
                   "remove this key"});
  refuse(c.current.type != CurrentLoopType::pi, "control.current.type", its_own, "remove this key");
  refuse(c.current.feedback != CurrentFeedback::mean, "control.current.feedback", its_own, "remove this key");
  refuse(c.current.commutation != CurrentCommutation::plain, "control.current.commutation", its_own,
         "remove this key");
  refuse(c.current.back_emf_feed_forward, "control.current.back_emf_feed_forward", its_own,
         "remove this key");
  refuse(c.current.measured_bus_from_V.has_value(), "control.current.measured_bus_from_V", its_own,
         "remove this key");
  refuse(c.speed.law != SpeedLaw::pi, "control.speed.law", its_own, "remove this key");
  refuse(c.limits.current_A || c.limits.torque_Nm || c.limits.speed_rad_s, "control.limits", its_own,
         "remove this key");
  refuse(c.regeneration.limit_V.has_value(), "control.regeneration", its_own, "remove this key");
  refuse(c.smooth_chopping.on, "control.smooth_chopping", its_own, "remove this key");
  refuse(c.slew.has_value(), "control.slew", its_own, "remove this key");
  refuse(c.position.profile.on, "control.position.profile", its_own, "remove this key");
  refuse(s.pwm.pattern != control::PwmPattern::upper, "pwm.pattern", its_own, "remove this key");
}

}  // namespace

base::Problems check_controller(const sixstep_controller& is) {
  base::Problems out;
  const auto refuse = [&out](bool wrong, const char* where, const std::string& value, const char* limit) {
    if (wrong)
      out.push_back(
          {where, value, limit, "correct this member as sixstep/control/own/own_controller.h describes it"});
  };
  if (is.interface == in_float)
    return {{"interface", std::to_string(is.interface),
             "is compiled for float, and this program needs double",
             "compile the controller without -DSIXSTEP_REAL=float"}};
  refuse(is.interface != SIXSTEP_OWN_INTERFACE, "interface", std::to_string(is.interface),
         ("is not " + std::to_string(SIXSTEP_OWN_INTERFACE) +
          ", the interface of this program: compile the controller with this program's own_controller.h")
             .c_str());
  if (!out.empty()) return out;
  refuse(is.answers != SIXSTEP_ANSWERS_PAIR && is.answers != SIXSTEP_ANSWERS_LEGS, "answers",
         std::to_string(is.answers), "must be SIXSTEP_ANSWERS_PAIR or SIXSTEP_ANSWERS_LEGS");
  refuse(is.name == nullptr || *is.name == 0, "name", "", "must be a text that is not empty");
  refuse(is.sentence == nullptr, "sentence", "", "must be a text: a sentence about the controller");
  refuse(is.config_bytes > most_bytes, "config_bytes", std::to_string(is.config_bytes),
         "must be 65536 at most");
  refuse(is.state_bytes > most_bytes, "state_bytes", std::to_string(is.state_bytes), "must be 65536 at most");
  refuse(is.parameters > most_numbers, "parameters", std::to_string(is.parameters), "must be 64 at most");
  refuse(is.design == nullptr, "design", "", "must be a function");
  refuse(is.step == nullptr, "step", "", "must be a function");
  if (is.parameters > most_numbers) return out;
  refuse(is.parameters > 0 && is.parameter == nullptr, "parameter", "", "must be an array of `parameters`");
  for (std::uint32_t n = 0; n < is.parameters && is.parameter != nullptr; ++n) {
    const sixstep_parameter& p = is.parameter[n];
    const std::string where = "parameter[" + std::to_string(n) + "]";
    refuse(!is_name(p.name), (where + ".name").c_str(), p.name ? p.name : "",
           "must be letters, digits and '_'");
    refuse(p.unit == nullptr || p.meaning == nullptr, (where + ".meaning").c_str(), "",
           "and unit must be texts; write \"\" for none");
    refuse(!(p.preset >= p.least && p.preset <= p.most), (where + ".preset").c_str(), base::written(p.preset),
           "must be in least..most");
  }
  return out;
}

void check_own(const Scenario& s, base::Problems& out) {
  const Own& own = s.control.own;
  if (s.control.drive != FirmwareKind::own) {
    if (own != Own{})
      out.push_back({"control.own", "", "applies to a user's controller only",
                     "set control.drive = \"own\", or remove this key"});
    return;
  }
  if (own.controller.empty())
    out.push_back({"control.own.controller", "", "is missing",
                   "set control.own.controller to the shared object of the controller"});
  else if (own.loaded == nullptr)
    out.push_back({"control.own.controller", '"' + own.controller + '"', "is not loaded",
                   "write the scenario to a file, and open this file"});
  else
    check_own_numbers(own, out);
  check_around(s, out);
  if (answers_legs(own)) check_pair_figures(s, out);
}

}  // namespace sixstep::study
