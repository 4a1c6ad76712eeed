// SPDX-License-Identifier: Apache-2.0
// Tests the files of many makers' instruments, with any separators, units, preamble and encoding. Each file
// must give the right back-EMF constant.
#include "tests/text/emf_by_formula.hpp"

namespace text {
namespace SIXSTEP_TEST_FILE {

using namespace emf_by_formula;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(RecordedFormats, TheRightNumberIs37Comma83) {
  EXPECT_NEAR(right_mV_s, 37.83, 0.005);
  EXPECT_NEAR(peak_V, 3.9613, 5e-5);
}

TEST(RecordedFormats, UnitsInEverySpelling) {
  for (const char* head :
       {"time [s],u_ab [V],u_bc [V]\n", "Time (s),CH1 (V),CH2 (V)\n", "Time(s),CH1V,CH2V\n",
        "in s,C1 in V,C2 in V\n", "\"in s\",\"CH1 in V\",\"CH2 in V\"\n", "Time / s,Vab / V,Vbc / V\n",
        "time,u_ab.v,u_bc.v\n", "x-axis,1,2\nsecond,Volt,Volt\n", "[s],[V],[V]\n", "t_s,u_ab_V,u_bc_V\n",
        "seconds,CH1 Volts,CH2 Volts\n"})
    expect_right(plain(head));
  for (const char* head :
       {"time [ms],CH1 mV,CH2 mV\n", "Time (mS),CH1_mVolt,CH2_mVolt\n", "ms,CH1 in mV,CH2 in mV\n",
        "milliseconds,CH1 millivolts,CH2 millivolts\n", "t_ms;u_ab, mV;u_bc, mV\n"}) {
    const char* const format = std::string(head).find(';') == std::string::npos ? "{:.3f},{:.2f},{:.2f}\n"
                                                                                : "{:.3f};{:.2f};{:.2f}\n";
    expect_right(plain(head, format, 1e3, 1e3));
  }
  for (const char* head : {"microseconds,CH1,CH2\n", "Time (us),CH1,CH2\n", "Time (\xc2\xb5s),CH1,CH2\n",
                           "Time (\xb5s),CH1,CH2\n", "usec,CH1,CH2\n", "time uS,CH1,CH2\n"})
    expect_right(plain(head, "{:.0f},{:.5f},{:.5f}\n", 1e6));
}

/// Bytes that are not UTF-8 are read as CP1252, in which 0xB5 is the micro sign.
TEST(RecordedFormats, EveryEncoding) {
  const std::string text =
      plain("Time (\xc2\xb5s),u_ab (mV),u_bc (mV)\n", "{:.0f},{:.2f},{:.2f}\n", 1e6, 1e3);
  const std::string latin = replaced(text, "\xc2\xb5", "\xb5");
  std::string little = "\xff\xfe", big = "\xfe\xff";
  for (const char c : latin) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& bytes : {text, latin, "\xef\xbb\xbf" + text, little, big,
                                   replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r")}) {
    const Seen found = seen(bytes);
    ASSERT_EQ(found.problem, "");
    EXPECT_EQ(found.rows, static_cast<std::size_t>(rows));
    EXPECT_NEAR(found.seconds, 0.0499, 1e-12);
    EXPECT_NEAR(found.line_peak_mV_s, 37.83, 0.005);
  }
}

TEST(RecordedFormats, OscilloscopesWithPreambles) {
  const std::string rigol_dho = "Time(s),CH1(V),CH2(V)\n";
  const std::string tek_mso =
      "Model,MSO24\nWaveform Type,ANALOG\nHorizontal Units,s\nSample Interval,1.0E-04\nRecord Length,500\nVertical "
      "Units,V,V\n,\nLabels,,\nTIME,CH1,CH2\n";
  const std::string siglent =
      "Record Length,Analog:500\nSample Interval,Analog:0.000100\nVertical Units,V,V\nHorizontal "
      "Units,s\nModel Number,SDS1104X-E\nSource,CH1,CH2\nSecond,Volt,Volt\n";
  const std::string lecroy =
      "LECROYWS3024,1234,Waveform\nSegments,1,SegmentSize,500\nSegment,TrigTime,TimeSinceSegment1\n#1,27-Nov-2026 "
      "10:00:00,0\nTime,Ampl,Ampl\n";
  const std::string digilent =
      "#Digilent WaveForms Oscilloscope Acquisition\n#Device Name: Discovery2\n#Sample rate: 10000Hz\n#Samples: "
      "500\n\nTime (s),Channel 1 (V),Channel 2 (V)\n";
  for (const std::string& head : {rigol_dho, tek_mso, siglent, lecroy, digilent}) expect_right(plain(head));
  expect_right(plain("x-axis,1,2\nsecond,Volt,Volt\n", "{:+.6E},{:+.5E},{:+.5E}\n"));  // Keysight
  expect_right(
      plain("Time,Channel A,Channel B\n(ms),(V),(V)\n\n", "{:.8f},{:.5f},{:.5f}\n", 1e3));  // PicoScope
  expect_right(with_commas(plain("Zeit;Kanal A;Kanal B\n(ms);(V);(V)\n\n", "{:.8f};{:.5f};{:.5f}\n", 1e3)));
  expect_right(plain("time\tV(a,b)\tV(b,c)\n", "{:.15e}\t{:.6e}\t{:.6e}\n"));               // LTspice
  expect_right(plain("\"Time / s\",\"Vm1:Measured voltage\",\"Vm2:Measured voltage\"\n"));  // PLECS
  expect_right(plain("", "   {:.7e}   {:.7e}   {:.7e}\n"));  // MATLAB, save -ascii
  expect_right(plain("Time [s],Channel 0,Channel 1\n"));     // Saleae
}

/// The first line contains the names, the second line contains start and increment. The first column is only
/// a count.
TEST(RecordedFormats, RigolDs1000z) {
  for (const char* units :
       {"Sequence,VOLT,VOLT,-2.500000e-02,1.000000e-04,\n", "Sequence,Volt,Volt,-0.025,0.0001\n"}) {
    const std::string file = table(
        "X,CH1,CH2,Start,Increment,\n" + std::string(units),
        [](int n, double, double a, double b) { return fmt::format("{},{:.2e},{:.2e},\r\n", n, a, b); });
    expect_right(file, 1e-2);
    EXPECT_THAT(seen(file, between_lines).channels, ElementsAre("CH1", "CH2"));
    expect_right(
        file, 1e-2,
        {.hall = {}, .voltages = {"CH1", "CH2"}, .between = analysis::EmfBetween::lines, .interval_s = {}});
  }
  expect_right(table("X,CH1,Start,Increment,\nSequence,mV,0,1e-4\n",
                     [](int n, double, double a, double) { return fmt::format("{},{:.2f},\n", n, 1e3 * a); }),
               1e-5, between_lines, 1);
}

TEST(RecordedFormats, RigolMso5000) {
  const std::string file =
      table("CH1V,CH2V,t0 =-2.500000e-02, tInc = 1.000000e-04,\n",
            [](int, double, double a, double b) { return fmt::format("{:.5e},{:.5e},,\n", a, b); });
  expect_right(file);
  EXPECT_THAT(
      seen(file, between_lines).notes,
      ElementsAre("has no column of time; the rows are 0.0001 s apart, as the file says: \"tInc = 0.0001\""));
  expect_right(file, 1e-5,
               {.hall = {}, .voltages = {}, .between = analysis::EmfBetween::lines, .interval_s = dt});
}

/// The first rows contain keys and values.
TEST(RecordedFormats, TektronixTds) {
  const std::vector<std::string> keys = {
      "Record Length,5.000000e+02", "Sample Interval,1.000000e-04", "Trigger Point,2.500000000000e+02",
      "Trigger Time,0.0",           "Horizontal Offset,0.0",        "Source,CH1",
      "Vertical Units,V",           "Vertical Scale,1.0e+00",       "Horizontal Units,s",
      "Firmware Version,FV:v24.26"};
  const auto file = [&](double interval, const char* unit) {
    return table("", [&](int n, double t, double a, double) {
      const auto k = static_cast<std::size_t>(n);
      std::string key = k < keys.size() ? keys[k] : ",";
      if (k == 1) key = fmt::format("Sample Interval,{:e}", interval);
      if (k == 6) key = fmt::format("Vertical Units,{}", unit);
      return fmt::format("{},,{:.12f},{:9.5f},\n", key, t - 0.025, a);
    });
  };
  expect_right(file(1e-4, "V"), 1e-5, between_lines, 1);
  EXPECT_THAT(seen(file(1e-4, "V"), between_lines).channels, ElementsAre("CH1"));
  EXPECT_THAT(seen(file(1e-7, "V"), between_lines).problem, HasSubstr("contradicts itself"));
  EXPECT_THAT(seen(file(1e-4, "dBV"), between_lines).problem, HasSubstr("has the heading CH1 in \"dBV\""));
}

TEST(RecordedFormats, LabViewWithAndWithoutItsColumnOfX) {
  const std::string head =
      "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nX_Columns\tOne\n***End_of_Header***\t\n\t\n"
      "Channels\t2\t\nSamples\t500\t500\nDate\t2026/11/27\t2026/11/27\nX_Dimension\tTime\tTime\nX0\t0.0\t0.0\nDelta_X\t1E-4\t1E-4\n"
      "***End_of_Header***\t\t\nX_Value\tVoltage_0\tVoltage_1\tComment\n";
  const std::string file = plain(head, "{:.6f}\t{:.6f}\t{:.6f}\n");
  expect_right(file);
  expect_right(with_commas(replaced(file, "Decimal_Separator\t.", "Decimal_Separator\t,")));
  expect_right(
      table(head, [](int, double, double a, double b) { return fmt::format("\t{:.6f}\t{:.6f}\n", a, b); }));
  // A remark in one row becomes a separate column. This column is not used.
  const Seen remarked =
      seen(replaced(file, "0.000300\t", "0.000300\t").replace(file.find("\n0.000300"), 1, "\twobbles\n"),
           between_lines);
  EXPECT_EQ(remarked.problem, "");
  EXPECT_THAT(remarked.notes, ElementsAre("not used: Comment (holds no numbers)"));
}

TEST(RecordedFormats, ATimeForEachChannel) {
  const auto file = [](double late_s) {
    return table("Time [s],CH1 [V],Time [s],CH2 [V]\n", [=](int, double t, double a, double b) {
      return fmt::format("{:.6f},{:.5f},{:.6f},{:.5f}\n", t, a, t + late_s, b);
    });
  };
  expect_right(file(0.0));
  EXPECT_THAT(seen(file(2e-5), between_lines).problem,
              HasSubstr("two times: Time and Time (column 3) differ in line 2"));
}

/// A simulator writes both sides of an event at one instant. The later row is used. A note states the number
/// of omitted rows.
TEST(RecordedFormats, AnInstantTwice) {
  const std::string file = table("\"time\",\"vab.v\",\"vbc.v\"\n", [](int n, double t, double a, double b) {
    const std::string row = fmt::format("{:.6f},{:.6f},{:.6f}\n", t, a, b);
    return n == 100 || n == 300 ? fmt::format("{:.6f},0.5,0.5\n", t) + row : row;
  });
  expect_right(file, 1e-6);
  EXPECT_THAT(seen(file, between_lines).notes,
              ElementsAre("2 rows left out: the next row has the same time (first in line 102)"));
  EXPECT_THAT(seen(plain("time [s],u_ab,u_bc\n", "{:.3f},{:.5f},{:.5f}\n")).problem,
              HasSubstr("does not rise"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace text
