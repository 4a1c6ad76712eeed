// SPDX-License-Identifier: Apache-2.0
#include "text/keys/sheet_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "text/keys/key_advice.hpp"

namespace text {
namespace {

/// A row: words in lower case without separators and units, with spaces between them; the key that they mean;
/// and a hint for the writer.
struct SheetWords {
  std::string_view words, key, more = "";
};

constexpr std::string_view terminal = "with frame = \"terminal\"", phase = "with frame = \"phase\"",
                           which = "with the frame that it means";

// Words that mean a key. The table is needed because a comparison of letters does not find them: "rth1"
// resembles no key.
constexpr SheetWords sheet_words[] = {
    {"numberofpolepairs polepairnumber polepaircount noofpolepairs motorpolepairs pp p", "pole_pairs"},
    {"numberofpoles polenumber polecount noofpoles motorpoles magnetpoles magnets simotorpoles", "poles"},
    {"configuration windingconfiguration statorconfiguration slotpolecombination", "winding",
     "as \"12N14P\", teeth and poles"},
    {"ratedvoltage voltage operatingvoltage supplyvoltage un", "nominal_voltage_V"},
    {"terminalresistance terminalresistancephasephase terminalresistancephasetophase resistancephasephase "
     "linetolineresistance resistancelinetoline phasetophaseresistance resistancephasetophase rll rtt ra",
     "resistance_ohm", terminal},
    {"phaseresistance resistanceperphase resistancephase statorresistance rs rphase focmotorr",
     "resistance_ohm", phase},
    {"r windingresistance internalresistance motorresistance coilresistance", "resistance_ohm", which},
    {"terminalinductance terminalinductancephasephase terminalinductancephasetophase inductancephasephase "
     "linetolineinductance inductancelinetoline phasetophaseinductance inductancephasetophase lll ltt",
     "inductance_mH", terminal},
    {"phaseinductance inductanceperphase inductancephase statorinductance ls lphase focmotorl",
     "inductance_mH", phase},
    {"l windinginductance motorinductance coilinductance", "inductance_mH", which},
    {"ld", "d_axis_inductance_mH"},
    {"lq", "q_axis_inductance_mH"},
    {"torqueconstant kt km kphi torquesensitivity", "torque_constant_mNm_A"},
    {"backemfconstant bemfconstant emfconstant voltageconstant backemf ke kb kbemf",
     "back_emf_constant_V_krpm",
     "with its frame: \"six-step\" if the value is the torque constant divided by 9.549"},
    {"focmotorfluxlinkage fluxlinkage psi psif lambda magnetflux pmflux", "flux_linkage_mWb"},
    {"kv kvrating kvvalue motorkv rpmpervolt kn velocityconstant", "speed_constant_rpm_V",
     "with frame = \"line-peak\" if it is measured on the turning motor, \"six-step\" if it is rpm per mean volt of a six-step drive"},
    {"rotorinertia momentofinertia massmomentofinertia inertiaofrotor motorinertia j jm jr", "inertia_gcm2"},
    {"staticfriction frictiontorquestatic staticfrictiontorque frictiontorque dryfriction c0",
     "coulomb_friction_mNm"},
    {"dynamicfriction frictiontorquedynamic dynamicfrictiontorque viscousdamping dampingconstant damping cv",
     "viscous_friction_Nm_s", "as \"4.3e-4 mNm/rpm\" where the sheet has mNm/rpm or mNm/min-1"},
    {"noloadrpm idlespeed n0", "no_load_speed_rpm"},
    {"idlecurrent noloadcurrenttyp i0", "no_load_current_mA"},
    {"idlecurrentvoltage idlevoltage noloadvoltage", "no_load_voltage_V"},
    {"ratedspeed nn", "nominal_speed_rpm"},
    {"ratedtorque maxcontinuoustorque continuoustorque maximumcontinuoustorque maxcontinuousstalltorque mn",
     "nominal_torque_mNm"},
    {"ratedcurrent maxcontinuouscurrent continuouscurrent maximumcontinuouscurrent thermalcurrent in",
     "nominal_current_A",
     "with frame = \"terminal\" for direct current through two terminals, \"rms\" for a sine"},
    {"startingtorque peakstalltorque lockedrotortorque mh mst", "stall_torque_mNm"},
    {"startingcurrent lockedrotorcurrent ist ia", "stall_current_A"},
    {"efficiency efficiencymax maximumefficiency etamax eta", "max_efficiency_percent"},
    {"slopeofnmcurve speedregulation speedtorqueslope dndm", "speed_torque_gradient_rpm_mNm"},
    {"mechanicaltimeconst taum tm", "mechanical_time_constant_ms"},
    {"electricaltimeconst electricaltimeconstant taue te", "electrical_time_constant_ms"},
    {"speedupto maxpermissiblespeed maximumspeed maxspeed nmax maxcontinuousspeed", "max_speed_rpm"},
    {"rth1 thermalresistance1 thermalresistancerth1 thermalresistancerotorbody thermalresistancecoilhousing rth1rotorbody",
     "thermal_resistance_winding_housing_K_W"},
    {"rth2 thermalresistance2 thermalresistancerth2 thermalresistancebodyambient thermalresistancehousingair rth2bodyambient",
     "thermal_resistance_housing_ambient_K_W"},
    {"tauw1 tw1 thermaltimeconstant1 thermaltimeconstantrotor thermaltimeconstantcoil tauth1",
     "thermal_time_constant_winding_s"},
    {"tauw2 tw2 thermaltimeconstant2 thermaltimeconstantstator thermaltimeconstanthousing tauth2",
     "thermal_time_constant_motor_s"},
    {"operatingtemperaturemax maxoperatingtemperature maxcoiltemperature maxpermissiblewindingtemperature "
     "windingtemperaturemax maximumwindingtemperature",
     "max_winding_temperature_degC", "(limit of the winding)"},
};

/// Words that have no key in a motor's file, with the reason or the right place. Each text continues the
/// sentence "is not a key here; ..".
constexpr SheetWords elsewhere[] = {
    {"gearratio gear gearreduction reductionratio sigearratio", "",
     "a gear belongs to the load: write load.gear in the scenario, motor turns per turn of the load"},
    {"currentconstant ki", "", "remove the line: the value is 1 divided by the torque constant"},
    {"motorconstant", "", "remove the line: the value is K_t/sqrt R, from torque constant and resistance"},
    {"motorregulation", "", "write speed_torque_gradient_rpm_mNm: R/k^2 of 1e3/(Nm s) is 9.549 rpm/mNm"},
    {"angularacceleration alphamax", "",
     "remove the line: the value is the stall torque divided by the inertia"},
    {"peaktorque maxtorque maximumtorque", "",
     "remove the line, or write stall_torque_mNm if the value is the torque of the held rotor at nominal voltage"},
    {"peakcurrent maxcurrent maximumcurrent lcurrentmax currentlim currentlimit", "",
     "write control.limits.current_A in the scenario, because this limit belongs to the drive; for a design without a "
     "scenario give a torque limit, K_t times this current"},
    {"ratedpower nominalpower maxpower power outputpower", "",
     "remove the line: the value is nominal_torque_mNm times nominal_speed_rpm"},
    {"weight motorweight mass shaftdiameter statordiameter length diameter phases numberofphases insulationclass",
     "", "remove the line: the model does not use this value"},
    {"focmotorldlqdiff", "", "write d_axis_inductance_mH = L - diff/2 and q_axis_inductance_mH = L + diff/2"},
};

std::string bare_letters(std::string_view key) {
  std::string letters;
  for (const char c : key)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const std::size_t cut = std::min(words.find(' '), words.size());
    if (words.substr(0, cut) == word) return true;
    words.remove_prefix(std::min(cut + 1, words.size()));
  }
  return false;
}

template <class Rows>
const SheetWords* find_words(const Rows& rows, std::string_view key) {
  // The search first uses all letters, because the "_V" of "C_V" is no unit. It then uses the word without
  // the apparent unit.
  for (const std::string& word : {bare_letters(key), bare_letters(without_unit(key))})
    for (const SheetWords& row : rows)
      if (!word.empty() && has_word(row.words, word)) return &row;
  return nullptr;
}

/// The spelling of `key` that has the unit of `written`.
std::string spelled_like(std::string_view key, std::string_view written, std::span<const std::string> known) {
  const std::string_view unit = unit_suffix(written);
  std::string found(key);
  for (const std::string& candidate : known)
    if (!unit.empty() && without_unit(candidate) == without_unit(key) && unit_suffix(candidate) == unit)
      found = candidate;
  return found;
}

}  // namespace

std::optional<std::string> by_meaning(std::string_view key, std::span<const std::string> known) {
  const auto is_known = [&](std::string_view word) {
    return std::find(known.begin(), known.end(), word) != known.end();
  };
  if (!is_known("resistance_ohm")) return {};  // `known` are not the keys of a motor
  if (const SheetWords* row = find_words(elsewhere, key)) return std::string(row->more);
  const SheetWords* row = find_words(sheet_words, key);
  if (!row || !is_known(row->key)) return {};
  const std::string word = spelled_like(row->key, key, known);
  return fmt::format("write {}{}{}", word, row->more.empty() ? "" : " " + std::string(row->more),
                     conversion_text(unit_suffix(key), unit_suffix(word)));
}

}  // namespace text
