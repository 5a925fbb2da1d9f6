#include "storage/checksum.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>

namespace contact {
namespace {

// A message of some length, with zeros in it.
std::string Stored() {
  std::string bytes = "what is stored";
  for (int i = 0; i < 50; ++i) bytes.push_back(static_cast<char>(i % 7));
  return bytes;
}

TEST(Checksum, EveryFlippedBitIsSeen) {
  const std::string bytes = Stored();
  const std::int64_t good = Checksum(bytes, 7);
  EXPECT_EQ(Checksum(bytes, 7), good);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string bad = bytes;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(Checksum(bad, 7), good) << bit;
  }
}

TEST(Checksum, EveryPlaceGivesAnother) {
  const std::string bytes = Stored();
  std::set<std::int64_t> sums;
  for (std::uint64_t bit = 0; bit < 64; ++bit)
    sums.insert(Checksum(bytes, std::uint64_t{1} << bit));
  for (std::uint64_t place = 3; place < 1000; place += 2) sums.insert(Checksum(bytes, place));
  EXPECT_EQ(sums.size(), 64U + 499U);
  EXPECT_GE(*sums.begin(), 0);
  EXPECT_LE(*sums.rbegin(), std::int64_t{UINT32_MAX});
}

TEST(Checksum, EventIsBoundToItsSequenceAndItsCoding) {
  const std::string bytes = Stored();
  const CodedEvent plain{Coding::kPlain, bytes};
  const CodedEvent frames{Coding::kFrames, bytes};
  EXPECT_EQ(Checksum(plain, 3), Checksum(bytes, 3));
  EXPECT_NE(Checksum(plain, 3), Checksum(plain, 4));
  EXPECT_NE(Checksum(plain, 3), Checksum(frames, 3));
}

TEST(Checksum, BytesAreBoundToTheirJob) {
  const CodedEvent event{Coding::kPlain, Stored()};
  const std::int64_t crc32 = Checksum(event, 3, "jobs/a");
  EXPECT_TRUE(Passes(crc32, event, 3, "jobs/a"));
  EXPECT_FALSE(Passes(crc32, event, 3, "jobs/b"));
  EXPECT_FALSE(Passes(crc32, event, 4, "jobs/a"));
  EXPECT_FALSE(Passes(Checksum(Stored(), 0, "jobs/a"), Stored(), "jobs/b"));
}

TEST(Checksum, OnesWithoutAJobArePassedForAny) {
  EXPECT_TRUE(Passes(Checksum(Stored()), Stored(), "jobs/a"));
}

}  // namespace
}  // namespace contact
