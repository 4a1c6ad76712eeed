// SPDX-License-Identifier: Apache-2.0
// Tests the effect of an output on an existing file: owner, permissions, links, names and pipes.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "files/atomic_file.hpp"
#include "files/own_file.hpp"
#include "files/text_file.hpp"

namespace files {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* ours = "# sixstep 0.1.0\nold\n";

class ReplacedFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / "sixstep-replaced" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string with(const std::string& name, const std::string& text) const {
    std::ofstream(at(name)) << text;
    return at(name);
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  /// Writes the file. Returns an empty text after success, else the message.
  static std::string told_writing(const Destination& to, const std::string& text) {
    base::Result<AtomicFile> file = AtomicFile::create(to);
    if (!file) return to_string(file.problems().at(0));
    file->write(text);
    const base::Problems problems = file->commit();
    return problems.empty() ? "" : to_string(problems[0]);
  }
  static mode_t mode(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
  }
  fs::path folder_;
};

TEST_F(ReplacedFiles, WhatSixstepHasNotWrittenIsRefusedUnlessForced) {
  for (const char* foreign :
       {"x", "#include \"sixstep/control/drive.hpp\"\n", "# sixstep notes\n", "{\"sixstep\": 1}",
        "# Made by hand\n", "#:schema sixstep-scenario.schema.json\n", "<!doctype html>\n<p>"}) {
    const std::string path = with("a.csv", foreign);
    EXPECT_EQ(
        told_writing(path, "new"),
        path +
            ": was not written by sixstep, or was changed after sixstep wrote it; name another file, or add --force to "
            "replace it");
    EXPECT_EQ(*read_text(path), foreign);
    EXPECT_EQ(entries(), 1U);
    EXPECT_EQ(told_writing({path, true}, "new"), "");
    EXPECT_EQ(*read_text(path), "new");
  }
}

TEST_F(ReplacedFiles, OursAndEmptyOnesAreReplaced) {
  for (const char* own : {ours, "", "// clang-format off\n// Made by sixstep 0.1.0. Change the scenario"}) {
    const std::string path = with("a.csv", own);
    EXPECT_EQ(told_writing(path, "new"), "") << own;
    EXPECT_EQ(*read_text(path), "new");
  }
}

TEST_F(ReplacedFiles, ATextThatTheUserWentOnWithIsTheUsers) {
  const std::string text = with_own_mark("sixstep design x", "duration_s = 1\n");
  EXPECT_THAT(text, ::testing::MatchesRegex(
                        "# Made by sixstep [0-9.]+, digest [0-9a-f]+: sixstep design x\nduration_s = 1\n"));
  EXPECT_FALSE(is_foreign(with("a.toml", text)));
  EXPECT_TRUE(is_foreign(with("a.toml", text + "# mine\n")));
  EXPECT_TRUE(is_foreign(with("a.toml", text.substr(0, text.size() - 3) + "2\n")));
  EXPECT_TRUE(is_foreign(with("a.toml", "# Made by sixstep 0.1.0")));
}

TEST_F(ReplacedFiles, TheNameOfAPartialFileIsGuardedToo) {
  with("a.partial.csv", "precious");
  EXPECT_THAT(told_writing(at("a.csv"), "new"), HasSubstr("a.partial.csv: was not written by sixstep"));
}

TEST_F(ReplacedFiles, PermissionsStayAsTheyWere) {
  const mode_t before = ::umask(022);
  for (const mode_t wanted : {0600U, 0640U, 0666U, 0755U}) {
    const std::string path = with("a.csv", ours);
    ASSERT_EQ(::chmod(path.c_str(), wanted), 0);
    {
      base::Result<AtomicFile> file = AtomicFile::create(path);
      ASSERT_TRUE(file);
      EXPECT_EQ(mode(file->temporary()), wanted) << "while it is written, too";
      EXPECT_TRUE(file->commit().empty());
    }
    EXPECT_EQ(mode(path), wanted);
    fs::remove(path);
  }
  EXPECT_EQ(told_writing(at("new.csv"), "x"), "");
  EXPECT_EQ(mode(at("new.csv")), 0644U) << "a new one has what the umask leaves";
  ::umask(before);
}

TEST_F(ReplacedFiles, WhatAKilledProgramLeftIsInNobodysWay) {
  {
    base::Result<AtomicFile> first = AtomicFile::create(at("a.csv")),
                             second = AtomicFile::create(at("a.csv"));
    ASSERT_TRUE(first && second);
    EXPECT_NE(first->temporary(), second->temporary()) << "nor do two at once share a name";
  }
  // In a container, every program has the same process number. The temporary file of a killed program may
  // therefore have the name that the next program chooses.
  for (int count = 0; count < 64; ++count)
    with(".a.csv.tmp" + std::to_string(::getpid()) + "-" + std::to_string(count), "");
  EXPECT_EQ(told_writing(at("a.csv"), ours), "");
  const ::pid_t child = ::fork();
  if (child == 0) {
    const base::Result<AtomicFile> file = AtomicFile::create(at("a.csv"));
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(entries(), 64U + 1 + 1) << "it has left its temporary file";
  EXPECT_EQ(told_writing(at("a.csv"), "new"), "");
  EXPECT_EQ(*read_text(at("a.csv")), "new");
}

TEST_F(ReplacedFiles, ALinkThatLeadsNowhereMakesTheFileItNames) {
  fs::create_directory(at("deep"));
  fs::create_symlink("deep/real.csv", at("link.csv"));
  EXPECT_EQ(told_writing(at("link.csv"), "new"), "");
  EXPECT_TRUE(fs::is_symlink(at("link.csv")));
  EXPECT_EQ(*read_text(at("deep/real.csv")), "new");
  fs::create_symlink("absent/real.csv", at("astray.csv"));
  EXPECT_THAT(told_writing(at("astray.csv"), "new"),
              HasSubstr("astray.csv: cannot be written: No such file"));
  EXPECT_TRUE(fs::is_symlink(at("astray.csv")));
  fs::create_symlink("round.csv", at("round.csv"));
  EXPECT_THAT(told_writing(at("round.csv"), "new"),
              HasSubstr("name the file itself, not a link that points to itself"));
}

TEST_F(ReplacedFiles, OtherNamesOfAFileKeepTheOldOne) {
  with("a.csv", ours);
  fs::create_hard_link(at("a.csv"), at("backup.csv"));
  EXPECT_EQ(told_writing(at("a.csv"), "new"), "");
  EXPECT_EQ(*read_text(at("a.csv")), "new");
  EXPECT_EQ(*read_text(at("backup.csv")), ours);
}

TEST_F(ReplacedFiles, ANameMayBeAsLongAsLeavesRoomForItsPartial) {
  constexpr std::size_t longest = 255, partial = 8;
  const std::string extension = ".csv";
  const auto named = [&](std::size_t size) {
    return at(std::string(size - extension.size(), 'n') + extension);
  };
  EXPECT_EQ(told_writing(named(longest - partial), "new"), "");
  base::Result<AtomicFile> cut_short = AtomicFile::create({named(longest - partial), true});
  ASSERT_TRUE(cut_short);
  EXPECT_TRUE(cut_short->commit_partial().empty());
  for (const std::size_t size : {longest - partial + 1, longest, longest + 1})
    EXPECT_THAT(
        told_writing(named(size), "new"),
        HasSubstr(
            "cannot be written: File name too long; choose a shorter name: an interrupted run adds .partial to it"));
  EXPECT_EQ(entries(), 2U);
}

extern "C" void take_note(int) {}

TEST_F(ReplacedFiles, WhoWaitsForAPipesOtherEndHearsASignal) {
  struct sigaction ask {
  }, before{};
  ask.sa_handler = take_note;  // without SA_RESTART, as in the program
  ::sigaction(SIGUSR1, &ask, &before);
  const std::string pipe = at("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const ::pthread_t here = ::pthread_self();
  const auto signalled = [&](const auto& work) {
    // The signal is repeated, because it may arrive before the call blocks.
    const std::jthread caller([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        ::pthread_kill(here, SIGUSR1);
      }
    });
    work();
  };
  signalled(
      [&] { EXPECT_THAT(told_writing(pipe, "x"), HasSubstr("Interrupted system call")) << "no reader"; });
  signalled([&] {
    EXPECT_THAT(to_string(read_text(pipe).problems().at(0)), HasSubstr("Interrupted")) << "no writer";
  });
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  base::Result<AtomicFile> file = AtomicFile::create(pipe);
  ASSERT_TRUE(file);
  // The text exceeds the pipe's capacity. Without a reader, the write therefore blocks.
  signalled([&] { file->write(std::string(1 << 20, 'x')); });
  EXPECT_TRUE(file->failed());
  EXPECT_TRUE(file->commit().empty()) << "whoever asked to end needs no complaint";
  ::close(reader);
  ::sigaction(SIGUSR1, &before, nullptr);
}

TEST_F(ReplacedFiles, ASlowReaderGetsAllOfIt) {
  const std::string pipe = at("pipe"), text(1 << 20, 'x');
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::jthread reader([&] {
    std::ifstream in(pipe, std::ios::binary);
    for (char block[4096]; in.read(block, sizeof block) || in.gcount() > 0;) {
      got.append(block, static_cast<std::size_t>(in.gcount()));
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  });
  EXPECT_EQ(told_writing(pipe, text), "");
  reader.join();
  EXPECT_EQ(got, text);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace files
