#include "jobs/log/places.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

namespace contact {
namespace {

TEST(Places, AreGivenUpToTheirNumber) {
  for (const int count : {0, 1, 3}) {
    const Places places(count);
    EXPECT_EQ(places.count(), count);
    std::vector<Places::Place> taken;
    for (int i = 0; i < count; ++i) {
      taken.push_back(places.Take());
      EXPECT_TRUE(taken.back());
    }
    EXPECT_FALSE(places.Take());
    EXPECT_FALSE(places.Take()) << "a refusal takes none";
  }
}

TEST(Places, PlaceIsFreeOnceItsLastCopyIsGone) {
  const Places places(1);
  auto place = places.Take();
  auto copy = place;
  place = nullptr;
  EXPECT_FALSE(places.Take());
  copy = nullptr;
  EXPECT_TRUE(places.Take());
}

TEST(Places, CopiesShareThem) {
  const Places places(1);
  const Places copy = places;
  const auto place = copy.Take();
  EXPECT_FALSE(places.Take());
}

TEST(Places, PlaceMayOutliveThem) {
  std::optional<Places> places(1);
  const auto place = places->Take();
  places.reset();
  EXPECT_TRUE(place);
}

TEST(Places, ThreadsNeverHaveMoreThanThereAre) {
  const Places places(2);
  std::atomic<int> held = 0;
  std::atomic<int> most = 0;
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&] {
      for (int i = 0; i < 10'000; ++i) {
        if (const auto place = places.Take()) {
          const int now = ++held;
          for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
          }
          --held;
        }
      }
    });
  }
  threads.clear();
  EXPECT_GE(most, 1);
  EXPECT_LE(most, 2);
}

}  // namespace
}  // namespace contact
