// SPDX-License-Identifier: Apache-2.0
// Messages between the processes of a cluster are read back to the last bit. Any other bytes are refused.
#include "batch/letters.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <limits>

#include "batch/byte_format.hpp"

namespace batch::letters {
namespace SIXSTEP_TEST_FILE {

using ::testing::ElementsAre;

template <class L>
L through_bytes(const L& letter) {
  const std::optional<Letter> read_again = read(bytes_of(letter));
  EXPECT_TRUE(read_again);
  EXPECT_TRUE(std::holds_alternative<L>(*read_again));
  return std::get<L>(*read_again);
}

TEST(ByteFormat, IsTheSameOnEveryProcessor) {
  ByteWriter w;
  w.whole(0x0102030405060708);
  w.number(-2.0);  // sign, exponent 1024, fraction 0
  w.text("ab");
  EXPECT_EQ(std::move(w).bytes(), std::string("\x08\x07\x06\x05\x04\x03\x02\x01"
                                              "\0\0\0\0\0\0\0\xC0"
                                              "\x02\0\0\0\0\0\0\0ab",
                                              26));
}

analysis::RunValues row(std::size_t number) {
  analysis::RunValues r;
  r.number = number;
  r.strayed = {0.1, std::bit_cast<double>(0x7FF8'0000'0000'1234)};  // a NaN with a payload
  r.end = analysis::RunEnd::fault;
  r.problem = std::string("t = 1 s\0\n\xFF", 10);
  r.remarks = {"one", std::string("two\0\n", 5)};
  r.figures = {-0.0, std::numeric_limits<double>::infinity(), 5e-324};
  r.digest = 0xFEDC'BA98'7654'3210;
  return r;
}

TEST(Letters, CarryRowsToTheBit) {
  const Rows sent{{row(0), row(999'999'999), {}}}, come = through_bytes(sent);
  ASSERT_EQ(come.rows.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    const analysis::RunValues &a = sent.rows[n], &b = come.rows[n];
    EXPECT_EQ(a.number, b.number);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.problem, b.problem);
    EXPECT_EQ(a.remarks, b.remarks);
    EXPECT_EQ(a.digest, b.digest);
    ASSERT_EQ(a.strayed.size(), b.strayed.size());
    ASSERT_EQ(a.figures.size(), b.figures.size());
    for (std::size_t k = 0; k < a.strayed.size(); ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.strayed[k]), std::bit_cast<std::uint64_t>(b.strayed[k]));
    for (std::size_t k = 0; k < a.figures.size(); ++k)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.figures[k]), std::bit_cast<std::uint64_t>(b.figures[k]));
  }
}

TEST(Letters, CarryPlansWhole) {
  Begin sent;
  sent.plan.axes = {{.key = "supply.voltage_V", .values = {"12", "\"a\""}},
                    {.key = "load.torque_Nm",
                     .from = 1e-3,
                     .to = 2.0,
                     .points = 7,
                     .spacing = analysis::Spacing::logarithmic,
                     .strays = true}};
  sent.plan.sampling = analysis::Sampling::saltelli;
  sent.plan.points = 11;
  sent.plan.drives = 13;
  sent.plan.seed = ~std::uint64_t{0};
  sent.columns.keys = {{"supply.voltage_V", "V"}, {"load.torque_Nm", "N m"}};
  sent.columns.strayed = {{"supply.voltage_V", "V"}};
  sent.columns.figures = {{.name = "current", .unit = "A", .required = true, .max = 3.0},
                          {.name = "speed", .unit = "rad/s", .min = -1.0}};
  sent.jobs = 64;
  sent.made_of = std::string("\0\1", 2);
  const Begin come = through_bytes(sent);
  EXPECT_EQ(come.plan, sent.plan);
  EXPECT_EQ(come.columns, sent.columns);
  EXPECT_EQ(come.jobs, 64u);
  EXPECT_EQ(come.made_of, sent.made_of);
}

TEST(Letters, CarryTheRest) {
  EXPECT_THAT(through_bytes(Runs{{3, 1, 2}}).numbers, ElementsAre(3, 1, 2));
  EXPECT_THAT(through_bytes(Gone{{7}}).unmade, ElementsAre(7));
  EXPECT_EQ(through_bytes(Answer{4, "a"}).to, 4u);
  EXPECT_EQ(through_bytes(Answer{4, "a"}).bytes, "a");
  EXPECT_EQ(through_bytes(Question{5, "q"}).number, 5u);
  EXPECT_EQ(through_bytes(Question{5, "q"}).bytes, "q");
  EXPECT_EQ(through_bytes(Hungry{2, 40}).idle, 2u);
  EXPECT_EQ(through_bytes(Hungry{2, 40}).ahead, 40u);
  EXPECT_EQ(through_bytes(Dismissed{143}).exit, 143u);
  through_bytes(End{});
}

TEST(Letters, ARowTakesEightBytesANumber) {
  const auto length = [](const std::vector<analysis::RunValues>& rows) {
    return bytes_of(Rows{rows}).size();
  };
  analysis::RunValues r = row(1);
  r.problem.clear();
  r.remarks.clear();
  const std::size_t one = length({r, r}) - length({r});
  r.figures.push_back(1.0);
  EXPECT_EQ(length({r, r}) - length({r}), one + 8);
  EXPECT_EQ(one, 7 * 8u + 8 * (2 + 3))
      << "number, end, digest, four lengths; two strayed values, three figures";
}

TEST(Letters, WhatWasCutOrBrokenIsNone) {
  const std::string whole = bytes_of(Rows{{row(1), row(2)}});
  ASSERT_TRUE(read(whole));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(read(std::string_view(whole).substr(0, length))) << length;
  EXPECT_FALSE(read(whole + '\0'));
  std::string unknown = whole;
  unknown[0] = 9;
  EXPECT_FALSE(read(unknown));
  std::string endless = whole;
  endless[15] = '\x7F';  // states 2^62 rows: the reader must not reserve memory for them
  EXPECT_FALSE(read(endless));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace batch::letters
