// SPDX-License-Identifier: Apache-2.0
// A file appears completely or not at all, and the numbers in it are read back exactly.
#include <gmock/gmock.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "files/atomic_file.hpp"
#include "files/text_file.hpp"
#include "files/trace/csv_writer.hpp"
#include "files/trace/mat_writer.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace files {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;

/// The first line of a file that the program may overwrite without --force.
constexpr const char* ours = "# sixstep 0.1.0\n";

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / "sixstep-files" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(Files, NothingUnderTheNameBeforeCommit) {
  base::Result<AtomicFile> file = AtomicFile::create(at("a.txt"));
  ASSERT_TRUE(file);
  file->write("whole");
  EXPECT_FALSE(fs::exists(at("a.txt")));
  EXPECT_TRUE(file->commit().empty());
  EXPECT_EQ(*read_text(at("a.txt")), "whole");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, WithoutCommitNothingIsLeftAndTheOldFileStays) {
  std::ofstream(at("a.txt")) << ours;
  {
    base::Result<AtomicFile> file = AtomicFile::create(at("a.txt"));
    ASSERT_TRUE(file);
    file->write("half");
  }
  EXPECT_EQ(*read_text(at("a.txt")), ours);
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, AnInterruptedWorkLeavesAPartialFile) {
  base::Result<AtomicFile> file = AtomicFile::create(at("a.csv"));
  ASSERT_TRUE(file);
  file->write("some");
  EXPECT_TRUE(file->commit_partial().empty());
  EXPECT_EQ(*read_text(at("a.partial.csv")), "some");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, ALinkKeepsItsPlace) {
  std::ofstream(at("real.txt")) << ours;
  fs::create_symlink("real.txt", at("link.txt"));
  base::Result<AtomicFile> file = AtomicFile::create(at("link.txt"));
  ASSERT_TRUE(file);
  file->write("new");
  EXPECT_TRUE(file->commit().empty());
  EXPECT_TRUE(fs::is_symlink(at("link.txt")));
  EXPECT_EQ(*read_text(at("real.txt")), "new");
}

TEST_F(Files, UnwritableOutputIsToldWhenCreated) {
  const base::Result<AtomicFile> missing = AtomicFile::create("no/such/folder/a.csv");
  ASSERT_FALSE(missing);
  EXPECT_EQ(to_string(missing.problems().at(0)),
            "no/such/folder/a.csv: cannot be written: No such file or directory; check that the folder "
            "exists and can be written, and that the disk has free space");
  const base::Result<AtomicFile> folder = AtomicFile::create(folder_.string());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.problems().at(0).limit, "cannot be written: Is a directory");
}

TEST_F(Files, ADashIsNoFilesName) {
  const base::Result<AtomicFile> made = AtomicFile::create("-");
  ASSERT_FALSE(made);
  EXPECT_NE(to_string(made.problems().front()).find("means standard output"), std::string::npos);
  EXPECT_FALSE(fs::exists("-"));
}

TEST_F(Files, AFullDiskIsToldByCommit) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  base::Result<AtomicFile> file = AtomicFile::create("/dev/full");
  ASSERT_TRUE(file);
  file->write("text");
  const base::Problems problems = file->commit();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].limit, "cannot be written: No space left on device");
}

TEST_F(Files, CsvStartsWithItsColumnsAndNumbersComeBackBitForBit) {
  const std::vector<study::Column> columns{{"t_s", "s", "", ""}, {"x", "", "", ""}};
  base::Result<CsvWriter> csv =
      CsvWriter::create(at("a.csv"), columns, std::vector<std::string>{"from here"});
  ASSERT_TRUE(csv);
  constexpr unsigned seed = 20260;
  std::mt19937_64 random(seed);
  std::vector<double> numbers{0.0, -0.0, 0.1, 1.0 / 3.0, 5e-324, std::numeric_limits<double>::max()};
  while (numbers.size() < 20000) {
    const double x = std::bit_cast<double>(random());
    if (x - x == 0.0) numbers.push_back(x);
  }
  for (std::size_t n = 0; n < numbers.size(); n += 2) csv->row(std::span(numbers).subspan(n, 2));
  ASSERT_TRUE(csv->commit().empty());
  std::istringstream text(*read_text(at("a.csv")));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "# from here");
  std::getline(text, line);
  EXPECT_EQ(line, "t_s,x");
  for (std::size_t n = 0; n < numbers.size(); n += 2) {
    ASSERT_TRUE(std::getline(text, line));
    char* rest = nullptr;
    const double first = std::strtod(line.c_str(), &rest), second = std::strtod(rest + 1, nullptr);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(first), std::bit_cast<std::uint64_t>(numbers[n]))
        << seed << " " << n;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(second), std::bit_cast<std::uint64_t>(numbers[n + 1]))
        << seed << " " << n;
  }
  EXPECT_FALSE(std::getline(text, line));
}

TEST_F(Files, AColumnTooLongForMat5EndsTheTraceAndNamesTheCure) {
  const std::vector<study::Column> columns{{"t_s", "s", "", ""}, {"x", "", "", ""}};
  constexpr std::size_t most = 2 * ColumnSpool::block_rows + 1;  // a third block would exceed the limit
  base::Result<MatWriter> mat = MatWriter::create(at("a.mat"), columns, MatVersion::v5, {}, most);
  ASSERT_TRUE(mat);
  std::size_t rows = 0;
  for (; !mat->failed(); ++rows) mat->row(std::vector<double>{double(rows), 1.0});
  EXPECT_EQ(rows, 2 * ColumnSpool::block_rows + 1) << "the row that is refused tells it";
  EXPECT_EQ(
      to_string(mat->commit(0).at(0)),
      at("a.mat") +
          ": has 4096 rows, but a column of MAT 5 has at most 2 GiB; use --mat73, or record fewer rows; the finished part is in " +
          at("a.partial.mat"));
  EXPECT_GT(fs::file_size(at("a.partial.mat")), 2 * 4096 * sizeof(double));
  EXPECT_EQ(entries(), 1U);
}

TEST(AppendNumber, WritesNoDigitThatIsNotNeeded) {
  const auto written = [](double x) {
    std::string text;
    append_number(text, x);
    return text;
  };
  EXPECT_EQ(written(0.1), "0.1");
  EXPECT_EQ(written(24.0), "24");
  EXPECT_EQ(written(-0.0), "-0");
  EXPECT_EQ(written(3e-5), "3e-05");
  EXPECT_EQ(written(1e300), "1e+300");
  EXPECT_EQ(written(-1.0 / 3.0), "-0.3333333333333333");
  EXPECT_EQ(written(0.1 + 0.2), "0.30000000000000004") << "17 digits where it takes them";
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace files
