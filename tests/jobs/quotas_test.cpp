#include "jobs/quota/quotas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>
#include <vector>

#include "testing/fake_sources.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using Q = v1::Quota;

const JobOwner kOwnerAda{"ada", "acme"};
const JobOwner kOwnerBob{"bob", "acme"};
const JobOwner kOtherAda{"ada", "umbra"};

std::int64_t Used(const Quotas& quotas, const JobOwner& whose, v1::Quota::Resource resource) {
  const auto all = quotas.Of(whose);
  const auto found = std::ranges::find(all, resource, &v1::Quota::resource);
  return found == all.end() ? quotas.used(whose, resource) : found->used();
}

TEST(Quotas, OwnerHasUpToItsLimitAndOthersHaveTheirs) {
  FakeClock clock;
  Quotas quotas({.unfinished_jobs = 2}, clock);
  std::vector<Quotas::Place> places;
  for (const JobOwner& whose : {kOwnerAda, kOwnerBob, kOtherAda}) {
    for (const bool free : {true, true, false}) {
      auto place = quotas.Take(whose, Q::UNFINISHED_JOBS);
      EXPECT_EQ(place.ok(), free) << whose.owner << " of " << whose.tenant;
      if (place.ok()) places.push_back(place.value());
    }
    EXPECT_EQ(Used(quotas, whose, Q::UNFINISHED_JOBS), 2) << "a refusal takes nothing";
  }
}

TEST(Quotas, PlaceComesBackWithItsLastCopy) {
  FakeClock clock;
  std::optional<Quotas> quotas(std::in_place, OwnerLimits{.streams = 1}, clock);
  Quotas::Place place = quotas->Take(kOwnerAda, Q::STREAMS).value();
  Quotas::Place copy = place;
  place = nullptr;
  EXPECT_FALSE(quotas->Take(kOwnerAda, Q::STREAMS).ok());
  copy = nullptr;
  place = quotas->Take(kOwnerAda, Q::STREAMS).value();
  quotas.reset();
  place = nullptr;  // It may outlive them.
}

TEST(Quotas, RefusalSaysWhatIsUsedOfWhatAndWhenToComeAgain) {
  FakeClock clock;
  Quotas quotas({.cells = 10}, clock);
  const auto place = quotas.Take(kOwnerAda, Q::CELLS, 7);
  const Error later = quotas.Take(kOwnerAda, Q::CELLS, 4).error();
  EXPECT_EQ(later.code, absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(later.reason, "QUOTA_EXCEEDED");
  EXPECT_EQ(later.message,
            "ada has 7 cells of sweeps that wait or run, asks for 4 more and may have 10; wait for "
            "the end of sweeps, or make them smaller");
  EXPECT_THAT(later.metadata, testing::UnorderedElementsAre(testing::Pair("principal", "ada"),
                                                            testing::Pair("resource", "CELLS"),
                                                            testing::Pair("limit", "10"),
                                                            testing::Pair("used", "7")));
  EXPECT_GT(later.retry_after, 0ms);
  EXPECT_EQ(quotas.Take(kOwnerAda, Q::CELLS, 11).error().retry_after, 0ms) << "no waiting helps";
  EXPECT_TRUE(quotas.Take(kOwnerAda, Q::CELLS, 3).ok());
}

TEST(Quotas, ZeroIsAnyNumberAndIsCounted) {
  FakeClock clock;
  Quotas quotas({}, clock);
  const auto place = quotas.Take(kOwnerAda, Q::CALLS, 1'000'000);
  EXPECT_EQ(Used(quotas, kOwnerAda, Q::CALLS), 1'000'000);
  for (int i = 0; i < 10'000; ++i) EXPECT_FALSE(quotas.TakeCreateCall(kOwnerAda));
}

TEST(Quotas, JobsOfAnEarlierStartCountPastTheLimit) {
  FakeClock clock;
  Quotas quotas({.unfinished_jobs = 1}, clock);
  Quotas::Place first = quotas.Keep(kOwnerAda, Q::UNFINISHED_JOBS);
  Quotas::Place second = quotas.Keep(kOwnerAda, Q::UNFINISHED_JOBS);
  EXPECT_EQ(Used(quotas, kOwnerAda, Q::UNFINISHED_JOBS), 2);
  first = nullptr;
  EXPECT_FALSE(quotas.Take(kOwnerAda, Q::UNFINISHED_JOBS).ok());
  second = nullptr;
  EXPECT_TRUE(quotas.Take(kOwnerAda, Q::UNFINISHED_JOBS).ok());
}

TEST(Quotas, CallsOfAConnectionShareItsPlace) {
  FakeClock clock;
  Quotas quotas({.connections = 1}, clock);
  Quotas::Place first = quotas.TakeConnection(kOwnerAda, "ipv4:1.2.3.4:5").value();
  Quotas::Place second = quotas.TakeConnection(kOwnerAda, "ipv4:1.2.3.4:5").value();
  EXPECT_FALSE(quotas.TakeConnection(kOwnerAda, "ipv4:1.2.3.4:6").ok());
  EXPECT_TRUE(quotas.TakeConnection(kOwnerBob, "ipv4:1.2.3.4:5").ok()) << "a proxy's, of both";
  first = nullptr;
  EXPECT_FALSE(quotas.TakeConnection(kOwnerAda, "ipv4:1.2.3.4:6").ok());
  second = nullptr;
  EXPECT_TRUE(quotas.TakeConnection(kOwnerAda, "ipv4:1.2.3.4:6").ok());
}

TEST(Quotas, CreateCallsArePacedByTheClock) {
  FakeClock clock;
  Quotas quotas({.creates_per_second = 4, .create_burst = 2}, clock);
  EXPECT_FALSE(quotas.TakeCreateCall(kOwnerAda));
  EXPECT_FALSE(quotas.TakeCreateCall(kOwnerAda));
  const auto third = quotas.TakeCreateCall(kOwnerAda);
  ASSERT_TRUE(third);
  EXPECT_EQ(third->retry_after, 250ms);
  EXPECT_FALSE(quotas.TakeCreateCall(kOwnerBob));
  clock.Advance(250ms);
  EXPECT_FALSE(quotas.TakeCreateCall(kOwnerAda));
  EXPECT_EQ(Used(quotas, kOwnerAda, Q::CREATE_CALLS), 2);
  clock.Advance(1h);
  EXPECT_EQ(Used(quotas, kOwnerAda, Q::CREATE_CALLS), 0);
}

TEST(Quotas, ThreadsNeverHaveMoreThanTheLimit) {
  FakeClock clock;
  Quotas quotas({.cells = 5, .connections = 2}, clock);
  std::atomic<int> held = 0, most = 0;
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&, thread] {
      for (int i = 0; i < 10'000; ++i) {
        const auto connection = quotas.TakeConnection(kOwnerAda, std::to_string((i + thread) % 3));
        const auto place = quotas.Take(kOwnerAda, Q::CELLS, 2);
        if (!place.ok()) continue;
        const int now = held += 2;
        for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        held -= 2;
      }
    });
  }
  threads.clear();
  EXPECT_GE(most, 2);
  EXPECT_LE(most, 4);
  EXPECT_EQ(Used(quotas, kOwnerAda, Q::CELLS), 0);
  EXPECT_EQ(Used(quotas, kOwnerAda, Q::CONNECTIONS), 0);
}

}  // namespace
}  // namespace contact
