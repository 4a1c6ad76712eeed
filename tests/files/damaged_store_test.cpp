// SPDX-License-Identifier: Apache-2.0
// Every damage of a store is reported. A damaged store never returns a row that was not written.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>

#include "tests/files/a_store.hpp"

namespace files {
namespace SIXSTEP_TEST_FILE {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t count = 200;

class DamagedStore : public Store {
 protected:
  void SetUp() override {
    Store::SetUp();
    base::Result<PlanStore> store = PlanStore::create(path(), plan(), false);
    for (std::size_t n = 0; n < count; ++n) store->add(row(n));
    ASSERT_EQ(store->finish(), base::Problems{});
  }
  void write(const std::string& bytes) const {
    for (const char* part : {"-wal", "-shm", "-journal"}) std::filesystem::remove(path() + part);
    std::ofstream(path(), std::ios::binary) << bytes;
  }
};

using Random = std::mt19937_64;

/// The damage is one changed bit, twenty bits, forty bytes, a sector of zeros or a missing end.
std::string damaged(std::string bytes, Random& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const auto flip = [&] { bytes[below(bytes.size())] ^= static_cast<char>(1 << below(8)); };
  const std::size_t at = below(bytes.size());
  switch (below(6)) {
    case 0:
    case 1:
      flip();
      break;
    case 2:
      for (int n = 0; n < 20; ++n) flip();
      break;
    case 3:
      for (std::size_t n = at; n < std::min(at + 40, bytes.size()); ++n)
        bytes[n] = static_cast<char>(random());
      break;
    case 4:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  std::min<std::size_t>(512, bytes.size() - at), '\0');
      break;
    default:
      bytes.resize(at);
  }
  return bytes;
}

bool same_row(const analysis::RunRecord& a, const analysis::RunRecord& b) {
  return a->number == b->number && a->end == b->end && a->problem == b->problem && a->remarks == b->remarks &&
         a->digest == b->digest && a->figures == b->figures && a->strayed == b->strayed &&
         a->point[0] == b->point[0] && a->point[1] == analysis::bare(b->point[1]);
}

TEST_F(DamagedStore, IsToldOrHasNoOtherRowThanThoseThatWereWritten) {
  const char* asked = std::getenv("SIXSTEP_DAMAGED");
  const int copies = asked ? std::atoi(asked) : 400;
  const char* given = std::getenv("SIXSTEP_SEED");
  const std::uint64_t seed = given ? std::strtoull(given, nullptr, 10) : std::random_device{}();
  SCOPED_TRACE("SIXSTEP_SEED=" + std::to_string(seed));
  Random random(seed);
  const std::string good = text_of_file();
  int taken = 0, refused = 0;
  for (int n = 0; n < copies; ++n) {
    write(damaged(good, random));
    base::Result<PlanStore> store = PlanStore::resume(path(), plan());
    if (!store) {
      ++refused;
      const base::Problem& p = store.problems().front();
      EXPECT_THAT(p.where, HasSubstr("runs.sqlite"));
      EXPECT_FALSE(p.limit.empty() || p.cure.empty());
      continue;
    }
    ++taken;
    const base::Problems unread = store->each([&](const analysis::RunRecord& r) {
      EXPECT_TRUE(same_row(r, row(r->number))) << "copy " << n << ", run " << r->number;
    });
    EXPECT_EQ(unread, base::Problems{});
    EXPECT_LE(store->rows(), count);
  }
  EXPECT_GT(refused, taken) << "most of the file is rows";
}

TEST_F(DamagedStore, OfEachValueOfARowIsTold) {
  const std::string good = text_of_file();
  for (const char* change :
       {"digest = '0123456789abcdef'", "f0 = f0 * 1.0000000001", "f1 = NULL", "f1 = 1e999", "s0 = s0 + 1e-15",
        "k0 = 4e-5", "k0 = '3e-05'", "k1 = 'hard'", "\"end\" = 'fault'", "\"end\" = 'wholu'",
        "passed = 1 - passed", "problem = 'x'", "remarks = 'x'", "run = 647", "run = -3",
        "run = 1000000000000000", "checksum = checksum + 1"}) {
    write(good);
    tamper(std::string("UPDATE run SET ") + change + " WHERE run = 3");
    EXPECT_THAT(told(), HasSubstr("is damaged: run ")) << change;
  }
  write(good);
  tamper("UPDATE run SET f0 = (SELECT f0 FROM run WHERE run = 8) WHERE run = 3");
  EXPECT_THAT(told(), HasSubstr("run 3 differs from the written row"));
  write(good);
  tamper("DELETE FROM run WHERE run = 3");
  EXPECT_EQ(told(), "") << "a run that is missing is made again";
}

TEST_F(DamagedStore, OfWhatItSaysOfItselfIsTold) {
  const std::string good = text_of_file();
  for (const char* change :
       {"UPDATE about SET value = 'u' WHERE word = 'title'", "DELETE FROM about WHERE word = 'checksum'",
        "UPDATE about SET value = '' WHERE word = 'scenario_text'",
        "UPDATE \"columns\" SET unit = 'mA' WHERE kind = 'figure'", "UPDATE \"columns\" SET kind = 'figure'",
        "DELETE FROM \"columns\" WHERE kind = 'strayed'",
        "UPDATE \"columns\" SET max = 3 WHERE \"column\" = 'f0'", "ALTER TABLE run ADD COLUMN f2 REAL",
        "DROP VIEW runs", "ALTER TABLE run RENAME COLUMN f0 TO f3"}) {
    write(good);
    tamper(change);
    EXPECT_THAT(told(), HasSubstr("is damaged")) << change;
  }
  write(good);
  tamper("CREATE INDEX mine ON run(f0); CREATE VIEW best AS SELECT min(f0) FROM run");
  EXPECT_EQ(told(), "") << "what stands beside is its reader's";
}

TEST_F(DamagedStore, OfAnotherFormatOrVersionSaysSo) {
  const std::string good = text_of_file();
  tamper("PRAGMA user_version = 1");
  EXPECT_THAT(told(), HasSubstr("was written by an older sixstep without checksums"));
  EXPECT_THAT(told(), HasSubstr("(force)"));
  ASSERT_TRUE(PlanStore::create(path(), plan(), true)) << "the cure";
  write(good);
  tamper("PRAGMA user_version = 4");
  EXPECT_THAT(told(), HasSubstr("has the format 4"));
  write(good);
  tamper("UPDATE about SET value = '0.0.9' WHERE word = 'sixstep'");
  EXPECT_THAT(told(), HasSubstr("was begun by sixstep 0.0.9, but this is "));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace files
