#include "base/histogram.h"

#include <gmock/gmock.h>

#include <numeric>
#include <thread>

namespace contact {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

TEST(HistogramTest, BoundBelongsToTheBucketBelow) {
  Histogram histogram({1, 10});
  for (const double value : {0.5, 1.0, 1.5, 10.0, 11.0, 1e9}) histogram.Count(value);
  const Histogram::Snapshot snapshot = histogram.Get();
  EXPECT_THAT(snapshot.counts, ElementsAre(2, 2, 2));
  EXPECT_EQ(snapshot.sum, 0.5 + 1 + 1.5 + 10 + 11 + 1e9);
}

TEST(HistogramTest, DecadesAreCutAtTwoAndAHalfAndFive) {
  EXPECT_THAT(DecadeBounds(-1, 1), ElementsAre(DoubleEq(0.1), DoubleEq(0.25), DoubleEq(0.5),
                                               DoubleEq(1), DoubleEq(2.5), DoubleEq(5), 10));
}

TEST(HistogramTest, EveryValueOfEveryThreadIsCountedOnce) {
  Histogram histogram(DecadeBounds(0, 3));
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&histogram] {
      for (int value = 1; value <= 2000; ++value) histogram.Count(value);
    });
  }
  for (std::thread& thread : threads) thread.join();
  const Histogram::Snapshot snapshot = histogram.Get();
  ASSERT_EQ(snapshot.counts.size(), snapshot.bounds.size() + 1);
  EXPECT_EQ(std::accumulate(snapshot.counts.begin(), snapshot.counts.end(), std::int64_t{0}), 8000);
  EXPECT_EQ(snapshot.counts.back(), 4 * 1000);  // Above 1000.
  EXPECT_EQ(snapshot.sum, 4 * 2000 * 2001 / 2);
}

}  // namespace
}  // namespace contact
