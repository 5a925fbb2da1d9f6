#include "base/histogram.h"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace contact
