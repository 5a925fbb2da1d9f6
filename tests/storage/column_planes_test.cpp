#include "storage/column_planes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace contact {
namespace {

using Words = std::vector<std::uint64_t>;

std::string Bytes(const Words& words) {
  std::string bytes(8 * words.size(), '\0');
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

// Every pattern of bits is the value of some double.
Words AnyBits(std::size_t count) {
  std::mt19937_64 random(count);
  Words words(count);
  for (std::uint64_t& word : words) word = random();
  return words;
}

TEST(ColumnPlanes, JoinInvertsSplitForEveryCountAndNumberOfColumns) {
  for (std::size_t columns = 1; columns <= 3; ++columns) {
    for (std::size_t count = 0; count <= 40; ++count) {
      const std::size_t stride = columns * count;
      std::string planes(8 * stride, '\x55');
      std::vector<std::string> written;
      for (std::size_t i = 0; i < columns; ++i) {
        written.push_back(Bytes(AnyBits(count + 1)).substr(8));
        SplitColumn(written.back(), stride, planes.data() + i * count);
      }
      for (std::size_t i = 0; i < columns; ++i) {
        std::string read(8 * count, '\xaa');
        JoinColumn(planes.data() + i * count, stride, count, read.data());
        EXPECT_EQ(read, written[i]) << count << " values of column " << i;
      }
    }
  }
}

TEST(ColumnPlanes, PlaneHoldsOneByteOfEverySecondDifference) {
  for (const std::size_t count : {1U, 7U, 8U, 9U, 16U, 100U}) {
    const Words words = AnyBits(count);
    std::string planes(8 * count, '\0');
    SplitColumn(Bytes(words), count, planes.data());
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t last = i > 0 ? words[i - 1] : 0;
      const std::uint64_t last_but_one = i > 1 ? words[i - 2] : 0;
      const std::uint64_t second = words[i] - 2 * last + last_but_one;
      for (std::size_t plane = 0; plane < 8; ++plane) {
        EXPECT_EQ(static_cast<unsigned char>(planes[plane * count + i]),
                  static_cast<unsigned char>(second >> (8 * plane)))
            << "byte " << plane << " of value " << i << " of " << count;
      }
    }
  }
}

TEST(ColumnPlanes, EvenlySpacedPatternsLeaveOnlyTheFirstTwoValues) {
  Words words;
  for (std::uint64_t i = 0; i < 50; ++i) words.push_back(0x3ff0'0000'0000'0000 + 12'345 * i);
  std::string planes(8 * words.size(), '\x55');
  SplitColumn(Bytes(words), words.size(), planes.data());
  for (std::size_t plane = 0; plane < 8; ++plane) {
    EXPECT_EQ(planes.substr(plane * words.size() + 2, words.size() - 2),
              std::string(words.size() - 2, '\0'));
  }
}

TEST(ColumnPlanes, ColumnsWriteTheirOwnPlacesOnly) {
  constexpr std::size_t kCount = 5;
  constexpr std::size_t kStride = 12;
  std::string planes(8 * kStride, '\x55');
  SplitColumn(Bytes(Words(kCount, 0)), kStride, planes.data());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    EXPECT_EQ(planes[i], i % kStride < kCount ? '\0' : '\x55') << i;
  }
}

}  // namespace
}  // namespace contact
