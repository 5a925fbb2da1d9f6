#include "wire/column_bytes.h"

#include <gmock/gmock.h>

namespace contact {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ColumnBytes, ColumnsOfATableHaveItsValues) {
  const std::vector<double> rows = {0.1, 1, -0.0, 2, 1e300, 3};
  EXPECT_THAT(Doubles(ColumnBytes(rows, 2, 0)), ElementsAre(0.1, -0.0, 1e300));
  EXPECT_THAT(Doubles(ColumnBytes(rows, 2, 1)), ElementsAre(1, 2, 3));
  EXPECT_THAT(ColumnBytes({}, 2, 1), IsEmpty());
}

TEST(ColumnBytes, BytesAreThoseOfLittleEndianDoubles) {
  const std::vector<double> rows = {1, -2};
  EXPECT_EQ(ColumnBytes(rows, 1, 0), std::string("\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\xc0", 16));
}

TEST(ColumnBytes, EachValueHasItsPlace) {
  const std::string bytes = ColumnBytes(std::vector<double>{0.1, 7}, 1, 0);
  EXPECT_EQ(DoubleAt(bytes, 0), 0.1);
  EXPECT_EQ(DoubleAt(bytes, 1), 7);
}

TEST(ColumnBytes, BytesPastTheLastWholeValueAreIgnored) {
  const std::string bytes = ColumnBytes(std::vector<double>{0.1, 7}, 1, 0);
  EXPECT_THAT(Doubles(bytes.substr(0, 15)), ElementsAre(0.1));
  EXPECT_THAT(Doubles(""), IsEmpty());
}

TEST(ColumnBytes, ChunksAreJoined) {
  const std::string bytes = ColumnBytes(std::vector<double>{1}, 1, 0);
  std::vector<double> values = {0};
  AppendDoubles(bytes, &values);
  AppendDoubles("", &values);
  AppendDoubles(bytes, &values);
  EXPECT_THAT(values, ElementsAre(0, 1, 1));
}

}  // namespace
}  // namespace contact
