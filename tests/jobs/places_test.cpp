#include "jobs/quota/places.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

namespace contact {
namespace {

const Principal kUser{"ada", "acme", {Role::kSubmit}, "token"};
const Principal kAdmin{"root", "acme", {Role::kAdmin}, "token"};

TEST(Places, AreGivenUpToTheirNumber) {
  for (const int count : {0, 1, 3}) {
    const Places places(count);
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
  const auto take = [copy = places] { return copy.Take(); };
  const auto place = take();
  EXPECT_FALSE(places.Take());
}

TEST(Places, PlaceMayOutliveThem) {
  std::optional<Places> places(1);
  const auto place = places->Take();
  places.reset();
  EXPECT_TRUE(place);
}

TEST(Places, SomeAreForAdmins) {
  const Places places(4, 1);
  EXPECT_EQ(places.open(kUser), 3);
  std::vector<Places::Place> taken;
  for (int i = 0; i < 3; ++i) taken.push_back(places.Take(kUser));
  EXPECT_FALSE(places.Take(kUser));
  const auto kept = places.Take(kAdmin);
  EXPECT_TRUE(kept);
  EXPECT_FALSE(places.Take(kAdmin)) << "there are no more";
}

TEST(Places, AtMostHalfAreForAdmins) {
  EXPECT_EQ(OpenTo(kUser, 1, 10), 1);
  EXPECT_EQ(OpenTo(kUser, 2, 10), 1);
  EXPECT_EQ(OpenTo(kUser, 100, 10), 90);
  EXPECT_EQ(OpenTo(kAdmin, 2, 10), 2);
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
