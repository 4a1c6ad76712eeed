// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/spec_words.hpp"

#include <algorithm>
#include <utility>

namespace cli {
namespace {

struct Word {
  std::string_view member, option;
};
constexpr Word member_words[] = {{"bandwidth_rad_s", "--bandwidth"},
                                 {"capture_Hz", "--capture"},
                                 {"chopping", "--chopping"},
                                 {"current_settle_s", "--current-settle"},
                                 {"damping", "--damping"},
                                 {"delay_periods", "--delay"},
                                 {"edges", "--edges"},
                                 {"force_limit_N", "--force-limit"},
                                 {"load_inertia_kg_m2", "--load-inertia"},
                                 {"load_mass_kg", "--load-mass"},
                                 {"lowest_speed_m_s", "--lowest-speed"},
                                 {"lowest_speed_rad_s", "--lowest-speed"},
                                 {"method", "--method"},
                                 {"mode", "--mode"},
                                 {"period_s", "--period"},
                                 {"rotor", "--rotor"},
                                 {"settle_s", "--settle"},
                                 {"step", "--step"},
                                 {"torque_limit_Nm", "--torque-limit"},
                                 {"voltage_V", "--voltage"}};

const Word* word_of(std::string_view member) {
  const auto* found = std::find_if(std::begin(member_words), std::end(member_words),
                                   [&](const Word& w) { return w.member == member; });
  return found == std::end(member_words) ? nullptr : found;
}

bool in_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '"';
}

constexpr std::string_view is = " = ";

}  // namespace

std::string in_options(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto length =
        static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), in_name) - text.begin());
    const std::string_view name = text.substr(0, length), rest = text.substr(length);
    const Word* word = word_of(name);
    const bool choice = word && rest.substr(0, is.size()) == is;
    // Names such as "mode" and "step" are also ordinary words. They are replaced only before " = ".
    out += word && (choice || name.find('_') != name.npos) ? word->option : name;
    text = rest;
    if (choice) {
      out += ' ';
      text.remove_prefix(is.size());
    } else if (!text.empty()) {
      out += text.front();
      text.remove_prefix(1);
    }
  }
  return out;
}

base::Problems in_options(base::Problems problems) {
  for (base::Problem& p : problems) {
    if (const Word* word = word_of(p.where)) p.where = word->option;
    p.limit = in_options(p.limit);
    p.cure = in_options(p.cure);
  }
  return problems;
}

void put_in_options(analysis::DesignStudy& study) {
  for (std::vector<sixstep::design::Warning>* warnings : {&study.warnings, &study.design.warnings})
    for (sixstep::design::Warning& w : *warnings) {
      w.what = in_options(w.what);
      w.cure = in_options(w.cure);
    }
}

}  // namespace cli
