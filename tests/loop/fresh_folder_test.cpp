// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/fresh_folder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

namespace loop {
namespace SIXSTEP_TEST_FILE {

namespace fs = std::filesystem;

TEST(FreshFolder, IsGoneWithAllThatIsInItAndNoTwoAreOne) {
  std::string path;
  {
    const auto folder = FreshFolder::make(), other = FreshFolder::make();
    ASSERT_TRUE(folder && other);
    EXPECT_NE(folder->path(), other->path());
    path = folder->path();
    fs::create_directory(path + "/in it");
    std::ofstream(path + "/in it/file") << "text";
    EXPECT_TRUE(fs::exists(path + "/in it/file"));
  }
  EXPECT_FALSE(fs::exists(path));
}

/// The folder is removed even if the program is killed and no destructor runs.
TEST(FreshFolder, IsGoneTooWhereItsProgramIsKilled) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t program = ::fork();
  if (program == 0) {
    const auto folder = FreshFolder::make();
    std::ofstream(folder->path() + "/file") << "text";
    if (::write(ends[1], folder->path().data(), folder->path().size()) < 0) ::_exit(1);
    for (;;) ::pause();
  }
  char path[4096] = {};
  ASSERT_GT(::read(ends[0], path, sizeof path - 1), 0);
  EXPECT_TRUE(fs::exists(std::string(path) + "/file"));
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (fs::exists(path) && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(fs::exists(path));
}

TEST(Child, TellsItsStatusAndIsEndedWithWhoHoldsIt) {
  auto well = Child::start({.words = {"sh", "-c", "exit 7"}, .given = {}, .temporary = {}});
  ASSERT_TRUE(well);
  EXPECT_EQ(well->ended_within(std::chrono::seconds(20)), 7);
  pid_t id = 0;
  Pipe told = made_pipe();
  {
    auto child = Child::start({.words = {"sh", "-c", "echo $$; exec sleep 1000"},
                               .given = {{told.write.number(), 1}},
                               .temporary = {}});
    ASSERT_TRUE(child);
    char text[32] = {};
    ASSERT_GT(::read(told.read.number(), text, sizeof text - 1), 0);
    id = std::atoi(text);
    EXPECT_EQ(child->ended_within(std::chrono::milliseconds(20)), std::nullopt);
    EXPECT_EQ(::kill(id, 0), 0);
  }
  EXPECT_NE(::kill(id, 0), 0);
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace loop
