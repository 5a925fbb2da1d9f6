#include "storage/column_planes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

namespace contact {
namespace {

static_assert(std::endian::native == std::endian::little, "values are stored as they are");

constexpr std::size_t kWord = sizeof(std::uint64_t);

// Values that are rearranged together, since their bytes are a square of 8 by 8.
constexpr std::size_t kBlock = 8;
using Block = std::array<std::uint64_t, kBlock>;

std::uint64_t Load(const char* from) {
  std::uint64_t value = 0;
  std::memcpy(&value, from, sizeof value);
  return value;
}

using Row = unsigned char __attribute__((vector_size(16)));

Row MergeLow(Row a, Row b) {
  return __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
}

Row MergeHigh(Row a, Row b) {
  return __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15,
                                 31);
}

// Byte j of value i becomes byte i of value j; its own inverse. Merging the halves of the block
// moves byte i to 2 i (mod 63), so merging three times swaps the two halves of the six bits of i.
inline void Turn(Block& block) {
  std::array<Row, 4> rows;
  std::memcpy(&rows, &block, sizeof block);
  for (int i = 0; i < 3; ++i) {
    rows = {MergeLow(rows[0], rows[2]), MergeHigh(rows[0], rows[2]), MergeLow(rows[1], rows[3]),
            MergeHigh(rows[1], rows[3])};
  }
  std::memcpy(&block, &rows, sizeof block);
}

// Second differences of a sequence, one after the other, and the sequence from them.
class Differences {
 public:
  std::uint64_t Of(std::uint64_t value) {
    const std::uint64_t difference = value - value_;
    value_ = value;
    return difference - std::exchange(difference_, difference);
  }
  std::uint64_t Sum(std::uint64_t second) {
    difference_ += second;
    return value_ += difference_;
  }

 private:
  std::uint64_t value_ = 0;
  std::uint64_t difference_ = 0;
};

}  // namespace

void SplitColumn(std::string_view column, std::size_t stride, char* planes) {
  Differences differences;
  const std::size_t count = column.size() / kWord;
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t some = std::min(kBlock, count - i);
    Block block{};
    for (std::size_t j = 0; j < some; ++j) {
      block[j] = differences.Of(Load(column.data() + (i + j) * kWord));
    }
    Turn(block);
    for (std::size_t plane = 0; plane < kWord; ++plane) {
      std::memcpy(planes + plane * stride + i, &block[plane], some);
    }
  }
}

void JoinColumn(const char* planes, std::size_t stride, std::size_t count, char* column) {
  Differences differences;
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t some = std::min(kBlock, count - i);
    Block block{};
    for (std::size_t plane = 0; plane < kWord; ++plane) {
      const char* const from = planes + plane * stride + i;
      if (some == kBlock) {
        block[plane] = Load(from);
      } else {
        std::memcpy(&block[plane], from, some);
      }
    }
    Turn(block);
    for (std::size_t j = 0; j < some; ++j) {
      const std::uint64_t value = differences.Sum(block[j]);
      std::memcpy(column + (i + j) * kWord, &value, sizeof value);
    }
  }
}

}  // namespace contact
