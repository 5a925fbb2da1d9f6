#include "jobs/read/decimation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <string_view>

#include "wire/column_bytes.h"

namespace contact {
namespace {

using testing::Each;
using testing::ElementsAre;

using Row = std::vector<double>;

// What is kept of rows that come so many at a time.
std::vector<Row> Decimate(const std::vector<Row>& rows, std::size_t max_rows,
                          std::size_t at_a_time = 256) {
  const std::size_t columns = rows.front().size();
  std::vector<double> flat;
  for (const Row& row : rows) flat.insert(flat.end(), row.begin(), row.end());
  std::vector<std::string> bytes;
  for (std::size_t i = 0; i < columns; ++i) bytes.push_back(ColumnBytes(flat, columns, i));
  const std::vector<std::string_view> table(bytes.begin(), bytes.end());
  MinMaxDecimator decimator(columns, max_rows);
  for (std::size_t first = 0; first < rows.size(); first += at_a_time) {
    decimator.Add(table, first, std::min(at_a_time, rows.size() - first));
  }
  const std::vector<double> values = decimator.Rows();
  std::vector<Row> kept;
  for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(columns)) {
    kept.emplace_back(at, at + static_cast<std::ptrdiff_t>(columns));
  }
  return kept;
}

// The same the plain way: of each stretch the first rows with an extreme, and both ends of all.
std::vector<Row> Extremes(const std::vector<Row>& rows, std::size_t width, std::size_t* closed) {
  std::vector<Row> kept;
  for (std::size_t begin = 0; begin < rows.size(); begin += width) {
    *closed = kept.size();
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto end = first + static_cast<std::ptrdiff_t>(std::min(width, rows.size() - begin));
    std::set<std::ptrdiff_t> keep;
    for (std::size_t column = 1; column < first->size(); ++column) {
      const auto value = [column](const Row& row) { return row[column]; };
      keep.insert(std::ranges::min_element(first, end, {}, value) - rows.begin());
      keep.insert(std::ranges::max_element(first, end, {}, value) - rows.begin());
    }
    if (begin == 0) keep.insert(0);
    if (end == rows.end()) keep.insert(end - rows.begin() - 1);
    for (const auto row : keep) kept.push_back(rows[static_cast<std::size_t>(row)]);
  }
  return kept;
}

// With the narrowest stretches, of a power of two rows, that leave room for one more.
std::vector<Row> DecimatePlainly(const std::vector<Row>& rows, std::size_t max_rows) {
  const std::size_t most = 2 * (rows.front().size() - 1);
  for (std::size_t width = 1;; width *= 2) {
    std::size_t closed = 0;
    std::vector<Row> kept = Extremes(rows, width, &closed);
    if (closed + std::min(most, width) <= max_rows - 2) return kept;
  }
}

// Time and two channels of noise.
std::vector<Row> Noise(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Row> rows;
  for (int i = 0; i < count; ++i) {
    rows.push_back({static_cast<double>(i), value(random), value(random)});
  }
  return rows;
}

double Largest(const std::vector<Row>& rows, std::size_t column, double from, double to) {
  double largest = -HUGE_VAL;
  for (const Row& row : rows) {
    if (row[0] >= from && row[0] <= to) largest = std::max(largest, row[column]);
  }
  return largest;
}

TEST(Decimation, KeepsEverythingThatFits) {
  const std::vector<Row> rows = Noise(98);
  EXPECT_EQ(Decimate(rows, 100), rows);
}

TEST(Decimation, NeverReturnsMoreThanAskedForNorFarLess) {
  for (const int count : {1, 2, 7, 100, 101, 1000, 4097, 20'000}) {
    for (const std::size_t most : {6U, 7U, 100U, 1001U}) {
      const std::size_t kept = Decimate(Noise(count), most).size();
      EXPECT_LE(kept, most) << count;
      if (most >= 100 && static_cast<std::size_t>(count) > most) {
        EXPECT_GE(kept, most / 3) << count;
      }
    }
  }
}

// Rows come as chunks have them, and a time range begins anywhere in a chunk.
TEST(Decimation, EqualsThePlainWayHoweverManyRowsComeAtATime) {
  for (const std::size_t count : {1U, 5U, 63U, 300U, 4097U, 20'000U}) {
    std::vector<Row> rows = Noise(static_cast<int>(count));
    for (Row& row : rows) row.push_back(std::floor(3 * row[1]));  // Many rows share an extreme.
    for (Row& row : rows) row.push_back(std::sin(0.01 * row[0]));
    for (const std::size_t most : {10U, 100U, 1001U}) {
      const std::vector<Row> expected = DecimatePlainly(rows, most);
      for (const std::size_t at_a_time : {1U, 3U, 100U, 256U, 20'000U}) {
        EXPECT_EQ(Decimate(rows, most, at_a_time), expected) << count << " " << at_a_time;
      }
    }
  }
}

TEST(Decimation, KeepsThePeaksOfEveryChannelWhereverTheyStand) {
  for (int peak = 0; peak < 5000; peak += 37) {
    std::vector<Row> rows = Noise(5000);
    const auto at = static_cast<std::size_t>(peak);
    rows[at][1] = 1000;
    rows[4999 - at][2] = -1000;
    const std::vector<Row> kept = Decimate(rows, 50);
    EXPECT_THAT(kept, testing::Contains(rows[at]));
    EXPECT_THAT(kept, testing::Contains(rows[4999 - at]));
  }
}

TEST(Decimation, KeepsTheEnvelope) {
  const std::vector<Row> rows = Noise(10'000);
  const std::vector<Row> kept = Decimate(rows, 400);
  constexpr double kStretch = 128;  // 79 stretches of 4 rows fit, 157 of 64 do not.
  for (double from = 0; from < 10'000; from += 50) {
    EXPECT_GE(Largest(kept, 1, from - kStretch, from + 50 + kStretch),
              Largest(rows, 1, from, from + 50));
  }
}

TEST(Decimation, KeepsRowsWholeInOrderWithFirstAndLast) {
  const std::vector<Row> rows = Noise(3000);
  const std::vector<Row> kept = Decimate(rows, 20);
  EXPECT_EQ(kept.front(), rows.front());
  EXPECT_EQ(kept.back(), rows.back());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i], rows[static_cast<std::size_t>(kept[i][0])]);
    if (i > 0) {
      EXPECT_LT(kept[i - 1][0], kept[i][0]);
    }
  }
}

TEST(Decimation, ConstantChannelsNeedFewRows) {
  std::vector<Row> rows;
  for (int i = 0; i < 1000; ++i) rows.push_back({static_cast<double>(i), 1});
  const std::vector<Row> kept = Decimate(rows, 10);
  EXPECT_LE(kept.size(), 10U);
  EXPECT_EQ(kept.front()[0], 0);
  EXPECT_EQ(kept.back()[0], 999);
}

TEST(Decimation, TimeAloneKeepsItsEnds) {
  EXPECT_THAT(Decimate({{1}, {2}, {3}, {4}}, 2), ElementsAre(Row{1}, Row{4}));
  MinMaxDecimator nothing(3, 10);
  EXPECT_TRUE(nothing.Rows().empty());
}

}  // namespace
}  // namespace contact
