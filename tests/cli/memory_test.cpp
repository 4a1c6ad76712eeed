// SPDX-License-Identifier: Apache-2.0
// If rows are written to a file, the program's peak memory does not increase with the simulated time.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace SIXSTEP_TEST_FILE {

constexpr long KiB_per_MiB = 1024, bound_KiB = 2 * KiB_per_MiB;

/// Peak resident memory of a program.
long peak_of_KiB(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = -1;
  rusage usage{};
  EXPECT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_EQ(status, 0) << "of " << words[0];
  return usage.ru_maxrss;
}

/// Peak memory of a run of R3 (soft chopping) with one row per PWM period.
long peak_KiB(const std::string& duration_s, std::vector<std::string> more) {
  std::vector<std::string> words = {SIXSTEP_PROGRAM,
                                    "run",
                                    SIXSTEP_SOURCE_DIR "/data/scenarios/reference/R3.toml",
                                    "--quiet",
                                    "--set",
                                    "duration_s=" + duration_s,
                                    "--set",
                                    "record.grid_s=30e-6"};
  words.insert(words.end(), more.begin(), more.end());
  return peak_of_KiB(std::move(words));
}

class Memory : public ::testing::Test {
 protected:
  void SetUp() override {
    if (SIXSTEP_SANITIZED) GTEST_SKIP() << "a sanitizer keeps freed memory";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  /// The growth of peak memory, in KiB, if the run is ten times as long. The value includes mapped pages of
  /// the program's files, and the kernel maps a varying number of them. A real growth appears in each of
  /// three tries, so the least of three is used.
  long growth_KiB(const std::vector<std::string>& more) {
    long least = growth_in_one_try_KiB(more);
    for (int n = 1; n < 3 && least > bound_KiB; ++n) least = std::min(least, growth_in_one_try_KiB(more));
    return least;
  }

 private:
  // The writer buffers 64 KiB of text. The rest of the bound allows for the granularity of the allocator. In
  // memory, 120'000 rows of seven columns would need 6.5 MiB more, and all columns of each event far more.
  long growth_in_one_try_KiB(const std::vector<std::string>& more) {
    const long once = peak_KiB("0.4", more), tenfold = peak_KiB("4", more);
    std::printf("peak %ld KiB for 0.4 s, %ld KiB for 4 s\n", once, tenfold);
    // After fork, a child starts with the pages of its parent, as a trivial program shows. The program's own
    // memory must be larger than these pages.
    EXPECT_GT(once, peak_of_KiB({"/bin/true"}));
    return tenfold - once;
  }
  static std::filesystem::path made_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "sixstep-memory-XXXXXX").string();
    if (!mkdtemp(name.data())) ADD_FAILURE() << "no folder for the outputs";
    return name;
  }
  std::filesystem::path folder_ = made_folder();
};

TEST_F(Memory, DoesNotGrowWhileRowsOnAGridStreamToAFile) {
  EXPECT_LE(growth_KiB({"--csv", file("grid.csv"), "--json", file("grid.json")}), bound_KiB);
  EXPECT_GT(std::filesystem::file_size(file("grid.csv")), 3u * 1024u * bound_KiB);
}

TEST_F(Memory, DoesNotGrowWhileEveryEventStreamsToAFile) {
  EXPECT_LE(growth_KiB({"--csv", file("events.csv"), "--set", "record.events=true"}), bound_KiB);
  EXPECT_GT(std::filesystem::file_size(file("events.csv")), 20'000'000u);
}

// The columns are buffered on disk in blocks of 2048 rows.
TEST_F(Memory, DoesNotGrowWhileColumnsWaitForTheirMatFiles) {
  EXPECT_LE(growth_KiB({"--mat", file("a.mat"), "--mat73", file("h.mat"), "--set", "record.grid_s=10e-6"}),
            bound_KiB);
  EXPECT_GT(std::filesystem::file_size(file("a.mat")), 3u * 1024u * bound_KiB);
}

TEST_F(Memory, DoesNotGrowWhileLogicSignalsStreamToAFile) {
  EXPECT_LE(growth_KiB({"--vcd", file("a.vcd")}), bound_KiB);
  EXPECT_GT(std::filesystem::file_size(file("a.vcd")), 3u * 1024u * bound_KiB);
}

// A report stores its events, 59 MB per simulated second, up to a limit. The measured memory includes the
// stored events.
TEST_F(Memory, OfAReportHasABound) {
  const std::string report = file("report.html");
  const long some = peak_KiB("0.4", {"--html", report}), most = peak_KiB("20", {"--html", report});
  std::printf("peak %ld KiB for 0.4 s, %ld KiB for 20 s\n", some, most);
  EXPECT_GT(most - some, 50 * KiB_per_MiB);
  EXPECT_LE(most, 256 * KiB_per_MiB);
  EXPECT_LT(std::filesystem::file_size(report), 3'000'000u);
}

}  // namespace SIXSTEP_TEST_FILE
