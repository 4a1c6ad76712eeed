// SPDX-License-Identifier: Apache-2.0
// The table of units is compared with the definitions: 1 lb = 0.45359237 kg, 1 in = 25.4 mm, the standard
// weight of 1 kg is 9.80665 N (BIPM, NIST SP 811), and a turn is 2 pi. A separate computation with forty
// decimal digits gave the expected values.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "text/keys/units.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

struct Row {
  const char *written, *wanted;
  double value;
};

constexpr Row defined[] = {
    // trade units of torque: an ounce, a pound or a kilogram as a weight
    {"1 oz-in", "N m", 7.06155181422604375e-3},
    {"1 ozf in", "N m", 7.06155181422604375e-3},
    {"1 lb-in", "N m", 0.1129848290276167},
    {"1 in-lb", "mNm", 112.9848290276167},
    {"1 lb-ft", "N m", 1.3558179483314004},
    {"1 ft-lbs", "N m", 1.3558179483314004},
    {"1 kgf cm", "mNm", 98.0665},
    {"1 kg-cm", "mNm", 98.0665},
    {"1 g cm", "mNm", 0.0980665},
    {"1 kgf", "N", 9.80665},
    {"1 lbf", "N", 4.4482216152605},
    {"1 ozf", "N", 0.27801385095378125},
    // inertia: by mass, and by weight with s2
    {"1 oz-in-s2", "g cm2", 70615.5181422604375},
    {"1 oz-in-sec^2", "kg m2", 7.06155181422604375e-3},
    {"1 lb-in-s2", "kg m2", 0.1129848290276167},
    {"1 kgf cm s2", "kg m2", 0.0980665},
    {"1 gf-cm-s²", "g cm2", 980.665},
    {"1 oz-in2", "g cm2", 182.89978339325},
    {"1 oz-in^2", "g cm2", 182.89978339325},
    {"1 lb-in2", "g cm2", 2926.396534292},
    {"1 lb·ft²", "kg m2", 0.0421401100938048},
    {"1 N m/(rad/s2)", "kg m2", 1.0},
    // constants
    {"1 oz-in/A", "mNm/A", 7.06155181422604375},
    {"1 kg cm/A", "Nm/A", 0.0980665},
    {"1 rpm/oz-in", "rpm/mNm", 0.14161193266123495},
    {"1 oz-in/krpm", "N m s", 6.74328526280169754e-5},
    {"1 mNm/min-1", "N m s", 9.54929658551372015e-3},
    {"1 V/krpm", "mV s", 9.54929658551372015},
    {"1 mV/rpm", "V/krpm", 1.0},
    {"1 mV/min-1", "V/krpm", 1.0},
    {"1 mV/min⁻¹", "V/krpm", 1.0},
    {"1 mV/(1/min)", "V/krpm", 1.0},
    {"1 V/1000rpm", "V/krpm", 1.0},
    {"1 V/1000 rpm", "V/krpm", 1.0},
    {"1 V/1000min-1", "V/krpm", 1.0},
    {"1 V/(1000 rpm)", "V/krpm", 1.0},
    {"1 V/1000 1/min", "V/krpm", 1.0},
    {"1 V/kRPM", "V/krpm", 1.0},
    {"1 V/rad/s", "mV s", 1000.0},
    {"1 V s/rad", "mV s", 1000.0},
    {"1 min-1/V", "rpm/V", 1.0},
    {"1 1/min/V", "rpm/V", 1.0},
    {"1 rad/s/V", "rpm/V", 9.54929658551372015},
    {"1900 KV", "rpm/V", 1900.0},
    // angle
    {"1 rpm", "rad/s", 0.104719755119659775},
    {"1 min-1", "rad/s", 0.104719755119659775},
    {"1 min^-1", "rad/s", 0.104719755119659775},
    {"1 min^(-1)", "rad/s", 0.104719755119659775},
    {"1 min⁻¹", "rad/s", 0.104719755119659775},
    {"1 min−1", "rad/s", 0.104719755119659775},
    {"1 1/min", "rad/s", 0.104719755119659775},
    {"1 rev/min", "rad/s", 0.104719755119659775},
    {"1 U/min", "rad/s", 0.104719755119659775},
    {"1 RPM", "rad/s", 0.104719755119659775},
    {"1 rps", "rad/s", 6.28318530717958648},
    {"1 rev/s", "rad/s", 6.28318530717958648},
    {"1 turn/s", "rad/s", 6.28318530717958648},
    {"1 turns/s", "rpm", 60.0},
    {"1 rev/sec", "rpm", 60.0},
    {"1 deg/s", "rad/s", 0.0174532925199432958},
    {"1 °/s", "rad/s", 0.0174532925199432958},
    {"1 rev", "deg", 360.0},
    {"1 rev/s2", "rad/s2", 6.28318530717958648},
    {"1 rpm/s", "rad/s2", 0.104719755119659775},
    // spellings with special characters
    {"1 µH", "mH", 1e-3},   // the micro sign
    {"1 μH", "mH", 1e-3},   // the letter mu
    {"1 mΩ", "ohm", 1e-3},  // the letter omega
    {"1 mΩ", "ohm", 1e-3},  // the ohm sign
    {"1 Ohms", "ohm", 1.0},
    {"1 N·m", "mNm", 1000.0},
    {"1 N⋅m", "mNm", 1000.0},
    {"1 N*m", "mNm", 1000.0},
    {"1 N-m", "mNm", 1000.0},
    {"1 N.m", "mNm", 1000.0},
    {"1 mN·m", "mNm", 1.0},
    {"1 cNm", "mNm", 10.0},
    {"1 N mm", "mNm", 1.0},
    {"1 kg·m²", "g cm2", 1e7},
    {"1 kg-m^2", "g cm2", 1e7},
    {"1 kg.m2", "g cm2", 1e7},
    {"1 mNm·s", "N m s", 1e-3},
    {"1 lb - in", "N m", 0.1129848290276167},
    {"0.38 ×10⁻⁴ kg·m²", "g cm2", 380.0},
    {"0.38 10^-4 kg m2", "g cm2", 380.0},
    {"0.38 x10-4 kgm2", "g cm2", 380.0},
    {"1 Kg-cm2", "g cm2", 1000.0},
    {"1 °C/W", "K/W", 1.0},
    {"1 degC/W", "K/W", 1.0},
    {"1 ℃/W", "K/W", 1.0},
    {"155 °C", "degC", 155.0},
    {"24 VDC", "V", 24.0},
    {"24 Volts", "V", 24.0},
    {"1 oz. in.", "N m", 7.06155181422604375e-3},
    {"1 lb.-in.", "N m", 0.1129848290276167},
    {"1 Vs", "mWb", 1000.0},
    {"1 mV/Hz", "mWb", 0.159154943091895336},  // per electrical turn, for any number of pole pairs
};

TEST(UnitTable, ConvertsByTheDefinitions) {
  for (const Row& row : defined) {
    const base::Result<double> x = in_unit(row.written, row.wanted);
    ASSERT_TRUE(x) << row.written << " in " << row.wanted << ": " << to_string(x.problems()[0]);
    EXPECT_NEAR(*x, row.value, 1e-15 * std::fabs(row.value)) << row.written << " in " << row.wanted;
  }
}

/// Hertz and erpm count electrical turns. The pole pairs convert them to turns of the shaft.
TEST(UnitTable, ElectricalTurnsConvertByThePolePairs) {
  constexpr Row with_two_pairs[] = {
      {"4.5 mV/Hz", "V/krpm", 0.15},  // 1000 rpm is 33.3 Hz
      {"0.0045 V/kHz", "V/krpm", 0.15e-3},
      {"4.5 mV/Hz", "mV s", 1.43239448782705802},  // 4.5 divided by pi
      {"222.222222222222222 Hz/V", "rpm/V", 6666.66666666666667},
      {"6000 erpm", "rad/s", 314.159265358979324},
      {"6000 eRPM", "rpm", 3000.0},
      {"6 kerpm", "rpm", 3000.0},
      {"5 mWb", "mV s", 10.0},
  };
  for (const Row& row : with_two_pairs) {
    const base::Result<double> x = in_unit(row.written, {row.wanted, "", 2});
    ASSERT_TRUE(x) << row.written << " in " << row.wanted << ": " << to_string(x.problems()[0]);
    EXPECT_NEAR(*x, row.value, 1e-15 * row.value) << row.written << " in " << row.wanted;
    const base::Result<double> without = in_unit(row.written, row.wanted);
    ASSERT_FALSE(without) << row.written;
    EXPECT_THAT(to_string(without.problems()[0]), ::testing::HasSubstr("the pole pairs are not given"));
  }
}

std::string refused(const std::string& written, const Wanted& wanted) {
  const base::Result<double> x = in_unit(written, wanted);
  return x ? "accepted" : to_string(x.problems()[0]);
}

TEST(UnitTable, HertzOfAShaftAreNobodysTurns) {
  for (const std::optional<int> pairs : {std::optional<int>(), std::optional(2)}) {
    EXPECT_THAT(refused("10 Hz", {"rad/s", "", pairs}), ::testing::HasSubstr("which may count turns"));
    EXPECT_THAT(refused("1 mNm/Hz", {"N m s", "", pairs}), ::testing::HasSubstr("which may count turns"));
  }
  EXPECT_THAT(refused("6.28 1/s", "rad/s"), ::testing::HasSubstr("cannot be converted to rad/s"));
  EXPECT_THAT(refused("20 rad/s", "Hz"), ::testing::HasSubstr("cannot be converted to Hz"));
}

TEST(UnitTable, MinutesAreNoRevolutionsPerMinute) {
  for (const char* unit : {"mV min", "mV*min", "V min"})
    for (const char* wanted : {"V/krpm", "mV s", "mWb"})
      EXPECT_THAT(refused(std::string("4 ") + unit, wanted),
                  ::testing::HasSubstr("this unit contains minutes as a factor"))
          << unit << " in " << wanted;
  EXPECT_THAT(refused("4 mNm min", "N m s"), ::testing::HasSubstr("this unit contains minutes as a factor"));
  EXPECT_EQ(*in_unit("2 min", "s"), 120.0);
}

TEST(UnitTable, RmsAndPeakBelongToTheFrame) {
  constexpr const char* torque = "terminal|peak|rms";
  EXPECT_EQ(*in_unit("0.55 Nm/Arms", {"Nm/A", torque}), 0.55);
  EXPECT_EQ(*in_unit("0.55 Nm/A rms", {"Nm/A", torque}), 0.55);
  EXPECT_EQ(*in_unit("0.55 Nm/A(rms)", {"Nm/A", torque}), 0.55);
  EXPECT_EQ(*in_unit("0.55 Nm/A_RMS", {"Nm/A", torque}), 0.55);
  EXPECT_EQ(*in_unit("0.55 Nm/Aeff", {"Nm/A", torque}), 0.55);
  EXPECT_EQ(*in_unit("0.55 Nm/Apk", {"Nm/A", torque}), 0.55);
  EXPECT_NEAR(*in_unit("20 oz-in/Arms", {"Nm/A", torque}), 0.141231036284520875, 1e-16);
  EXPECT_EQ(*in_unit("40 Vrms/krpm", {"V/krpm", "line-peak|line-rms"}), 40.0);
  EXPECT_EQ(*in_unit("40 V(rms)/1000rpm", {"V/krpm", "line-peak|line-rms"}), 40.0);
  EXPECT_NEAR(*in_unit("1 Vrms/(rad/s)", {"V/krpm", "line-rms"}), 104.719755119659775, 1e-13);
  EXPECT_EQ(measure_in("Nm/Arms"), "rms");
  EXPECT_EQ(measure_in("Vpk/krpm"), "peak");
  EXPECT_EQ(measure_in("V/krpm"), "");
  EXPECT_THAT(frames_with("line-peak|line-rms|phase-peak|phase-rms", "rms"),
              ::testing::ElementsAre("line-rms", "phase-rms"));
  EXPECT_EQ(
      refused("230 Vrms", "V"),
      "has the unit Vrms, and this key takes no rms value; write the value in V; the peak of a sine is sqrt 2 times its rms value");
  EXPECT_THAT(refused("5 Apk", {"A", "terminal|rms"}), ::testing::HasSubstr("no peak value"));
  EXPECT_THAT(refused("5 oz-in/Arms", "Nm/A"), ::testing::HasSubstr("no rms value"));
}

/// The file is one long unit. The reader reads each character only a few times, for any length of the file.
TEST(UnitTable, AnEndlessUnitIsNone) {
  for (const char* part : {"µ", "A ", "10-9 ", "A/", "(", "1 oz-in", "rms", "."}) {
    std::string endless;
    for (int n = 0; n < 20'000; ++n) endless += part;
    EXPECT_FALSE(in_unit("1 " + endless, "V")) << part;
  }
}

/// Units by kind. Units of one kind must be convertible to each other. Units of two kinds must not.
const std::map<std::string, std::vector<std::string>>& kinds() {
  static const std::map<std::string, std::vector<std::string>> all = {
      {"number", {"%"}},
      {"time", {"s", "ms", "us", "min", "h"}},
      {"frequency", {"Hz", "kHz", "MHz"}},
      {"rate", {"1/s", "s-1"}},
      {"angle", {"rad", "deg", "rev", "turn", "mrad"}},
      {"speed", {"rad/s", "rpm", "rps", "rev/s", "turn/s", "1/min", "min-1", "min^-1", "deg/s", "krpm"}},
      {"acceleration", {"rad/s2", "rpm/s", "rev/s2", "deg/s2"}},
      {"length", {"m", "mm", "cm", "in", "ft"}},
      {"mass", {"kg", "g", "lb", "oz"}},
      {"force", {"N", "mN", "lbf", "ozf", "kgf"}},
      {"torque", {"N m", "Nm", "mNm", "Ncm", "oz-in", "lb-in", "lb-ft", "kgf cm", "g cm"}},
      {"energy", {"J", "mJ", "W s", "W h"}},
      {"power", {"W", "kW", "J/s"}},
      {"inertia", {"kg m2", "g cm2", "kgcm2", "oz-in-s2", "oz-in2", "lb-in2", "lb-in-s2", "Nm/(rad/s2)"}},
      {"friction", {"N m s", "mNm/rpm", "Nm/(rad/s)", "oz-in/krpm", "mNm/min-1"}},
      {"stiffness", {"N m/rad", "mNm/deg"}},
      {"voltage", {"V", "mV", "VDC"}},
      {"current", {"A", "mA"}},
      {"charge", {"C", "A h", "mAh"}},
      {"resistance", {"ohm", "mohm", "V/A"}},
      {"inductance", {"H", "mH", "uH"}},
      {"capacity", {"F", "uF"}},
      {"flux density", {"T", "mT"}},
      {"torque constant", {"Nm/A", "mNm/A", "oz-in/A", "kg cm/A", "lb-in/A"}},
      {"back-EMF constant", {"V/krpm", "mV/rpm", "mV/min-1", "V/1000rpm", "V/(rad/s)", "V s/rad"}},
      {"flux linkage", {"mWb", "Wb", "mV/Hz", "V/(erad/s)"}},
      {"speed constant", {"rpm/V", "krpm/V", "min-1/V", "rad/s/V", "KV"}},
      {"gradient", {"rpm/mNm", "rpm/oz-in"}},
      {"thermal resistance", {"K/W", "degC/W"}},
      {"temperature", {"degC"}},
      {"temperature coefficient", {"%/K", "%/degC"}},
      {"gain", {"A/V"}},
      {"linear speed", {"m/s", "mm/s", "ft/min"}},
      {"linear friction", {"N s/m"}},
      {"force constant", {"N/A", "lbf/A"}},
      {"linear back-EMF", {"V s/m"}},
      {"density", {"kg/m3"}},
  };
  return all;
}

TEST(UnitTable, UnitsOfAKindConvertForthAndBack) {
  for (const auto& [kind, units] : kinds())
    for (const std::string& from : units)
      for (const std::string& to : units) {
        const base::Result<double> there = in_unit("7.3 " + from, to);
        ASSERT_TRUE(there) << kind << ": " << from << " in " << to << ": " << to_string(there.problems()[0]);
        const base::Result<Conversion> back = conversion(to, from);
        ASSERT_TRUE(back) << kind << ": " << to << " in " << from;
        EXPECT_NEAR(back->of(*there), 7.3, 7.3 * 2e-15) << kind << ": " << from << " by " << to;
      }
}

TEST(UnitTable, UnitsOfAnotherKindAreRefused) {
  std::size_t tried = 0;
  for (const auto& [kind, wanted] : kinds())
    for (const auto& [other, units] : kinds())
      for (const std::string& from : units) {
        if (kind == other) continue;
        ++tried;
        const std::string& to = wanted.front();
        const base::Result<double> x = in_unit("7.3 " + from, to == "%" ? "" : to);
        EXPECT_FALSE(x) << from << ", " << other << ", taken for " << to << ", " << kind;
      }
  EXPECT_GT(tried, 4'000U);
}

/// The unit of a product of two values is the product of their units. The unit of a quotient is the quotient
/// of the units.
TEST(UnitTable, FactorsAndDimensionsMultiply) {
  std::vector<std::string> all;
  for (const auto& [kind, units] : kinds())
    for (const std::string& unit : units)
      if (unit.find("degC") == std::string::npos) all.push_back(unit);  // degC is a point on a scale
  for (const std::string& a : all)
    for (const std::string& b : all) {
      const std::optional<Unit> x = unit_of(a), y = unit_of(b), product = unit_of("(" + a + ") (" + b + ")"),
                                quotient = unit_of("(" + a + ")/(" + b + ")");
      ASSERT_TRUE(x && y && product && quotient) << a << " and " << b;
      for (std::size_t n = 0; n < x->dimension.size(); ++n) {
        ASSERT_EQ(product->dimension[n], x->dimension[n] + y->dimension[n]) << a << " times " << b;
        ASSERT_EQ(quotient->dimension[n], x->dimension[n] - y->dimension[n]) << a << " by " << b;
      }
      const auto size = [](const Unit& u) { return u.factor * std::pow(10.0, u.ten); };
      EXPECT_NEAR(size(*product) / (size(*x) * size(*y)), 1.0, 2e-15) << a << " times " << b;
      EXPECT_NEAR(size(*quotient) * size(*y) / size(*x), 1.0, 2e-15) << a << " by " << b;
    }
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text
