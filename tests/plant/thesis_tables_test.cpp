// SPDX-License-Identifier: Apache-2.0
// All 54 rows of the thesis's tables 4 and 5 follow from the circuit law (model.md 2), except one misprint.
// The test finds this misprint.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "sixstep/plant/circuit.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::plant;

/// Coefficients of the four voltages U_s, e_a, e_b, e_c.
using Terms = std::array<double, 4>;

struct TableRow {
  int table = 0, sector = 0;
  std::array<char, 3> sign{};  // signs of i_a, i_b, i_c: + - 0, or * where the row states none
  Terms ab{}, bc{};            // u_ab - e_ab and u_bc - e_bc
  std::string text;
};

std::vector<TableRow> printed_rows() {
  std::ifstream file(SIXSTEP_SOURCE_DIR "/tests/reference/thesis-tables.csv");
  std::vector<TableRow> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    TableRow row{.text = line};
    std::stringstream cells(line);
    std::string cell;
    const auto next = [&] { return std::getline(cells, cell, ',') ? cell : std::string("0"); };
    row.table = std::stoi(next());
    row.sector = std::stoi(next());
    for (char& sign : row.sign) sign = next()[0];
    for (double& term : row.ab) term = std::stod(next());
    for (double& term : row.bc) term = std::stod(next());
    rows.push_back(row);
  }
  return rows;
}

/// The driven pair of each sector (model.md 3): source and sink. The numbers 0, 1, 2 are the legs a, b, c.
struct DrivenPair {
  std::size_t source, sink;
};
constexpr std::array<DrivenPair, 6> pairs{{{0, 1}, {0, 2}, {1, 2}, {1, 0}, {2, 0}, {2, 1}}};

Connection free_leg(char sign) { return connection_of(false, false, sign == '+' ? 1 : sign == '-' ? -1 : 0); }

/// In table 4, both driven switches conduct. In table 5, only the lower switch of the sink conducts, and the
/// two other legs are free.
Legs legs_of(const TableRow& row) {
  const DrivenPair pair = pairs[static_cast<std::size_t>(row.sector)];
  Legs legs{};
  for (std::size_t k = 0; k < 3; ++k) legs[k] = free_leg(row.sign[k]);
  legs[pair.sink] = Connection::low_switch;
  if (row.table == 4) legs[pair.source] = Connection::high_switch;
  return legs;
}

struct Derived {
  Terms ab{}, bc{};
};

/// For ideal devices, the law is linear in (U_s, e_a, e_b, e_c). Its coefficients are therefore its values at
/// the unit vectors.
Derived derived(const Legs& legs) {
  Derived d;
  for (std::size_t n = 0; n < 4; ++n) {
    const double U_s = n == 0 ? 1.0 : 0.0;
    PerLeg<double> e{};
    if (n > 0) e[n - 1] = 1.0;
    const PerLeg<double> u = pole_voltages(legs, pole_table<double>({}), U_s, PerLeg<double>{}, e);
    d.ab[n] = (u[0] - u[1]) - (e[0] - e[1]);
    d.bc[n] = (u[1] - u[2]) - (e[1] - e[2]);
  }
  return d;
}

TEST(ThesisTables, FollowFromTheCircuitLawButForOneMisprint) {
  const std::vector<TableRow> rows = printed_rows();
  ASSERT_EQ(rows.size(), 54u);
  std::vector<std::string> misprints;
  for (const TableRow& row : rows) {
    const Derived law = derived(legs_of(row));
    if (law.ab != row.ab || law.bc != row.bc) misprints.push_back(row.text);
  }
  ASSERT_EQ(misprints.size(), 1u);
  // The misprint (model.md 13) is in table 5, 240-300 degrees, i_b < 0, i_c = 0. The table states (-U_s - e_a
  // + e_b)/2; the correct value is (U_s + e_a - e_b)/2.
  EXPECT_EQ(misprints[0], "5,4,*,-,0,-1,-1,1,0,-0.5,-0.5,0.5,0");
  const Derived right = derived({Connection::low_switch, Connection::high_diode, Connection::floating});
  EXPECT_EQ(right.ab, (Terms{-1, -1, 1, 0}));
  EXPECT_EQ(right.bc, (Terms{0.5, 0.5, -0.5, 0}));
}

TEST(ThesisTables, EveryRowNamesItsFreeLegsAndNoOther) {
  for (const TableRow& row : printed_rows()) {
    const DrivenPair pair = pairs[static_cast<std::size_t>(row.sector)];
    for (std::size_t k = 0; k < 3; ++k) {
      const bool free = k != pair.sink && (row.table == 5 || k != pair.source);
      EXPECT_EQ(row.sign[k] != '*', free) << row.text;
    }
  }
}

}  // namespace SIXSTEP_TEST_FILE
