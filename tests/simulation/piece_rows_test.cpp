#include "simulation/model/piece_rows.h"

#include <gtest/gtest.h>

#include <random>

#include "simulation/model/scenario.h"

namespace contact {
namespace {

// Tables of some bodies with gaps and without, and loads that last for ever between them.
std::vector<Load> Tables(std::mt19937& random) {
  std::uniform_int_distribution<int> few(0, 3), many(1, 40);
  std::vector<Load> loads;
  for (int table = 0; table < 5; ++table) {
    if (few(random) == 0) loads.push_back({.body = few(random), .constant = 1});
    double time = few(random);
    const int body = few(random);
    for (int i = many(random); i > 0; --i) {
      const double begin = time + (few(random) == 0 ? 0.5 : 0);
      time = begin + 0.25 * (1 + few(random));
      loads.push_back({.body = body, .begin = begin, .end = time, .constant = time});
    }
  }
  return loads;
}

TEST(PieceRows, FindWhatALookAtAllPiecesFinds) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    const std::vector<Load> loads = Tables(random);
    const PieceRows<Load> rows(loads);
    EXPECT_LE(rows.rows().size(), 10U) << "a table is a row";
    for (double t = 0; t < 30; t += 0.125) {
      std::vector<const Load*> all, found;
      for (const Load& load : loads) {
        if (load.begin <= t && t < load.end) all.push_back(&load);
      }
      for (const auto& row : rows.rows()) {
        if (const Load* load = PieceRows<Load>::At(row, t)) found.push_back(load);
      }
      ASSERT_EQ(all, found) << t;
    }
  }
}

TEST(PieceRows, OfNothingAreNone) {
  const std::vector<Drive> none;
  EXPECT_TRUE(PieceRows(none).rows().empty());
}

}  // namespace
}  // namespace contact
