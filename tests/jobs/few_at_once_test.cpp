#include "jobs/read/few_at_once.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace contact {
namespace {

// Tasks that were called, with the places that they have not given back.
class FewAtOnceTest : public testing::Test {
 protected:
  void Run(int task) {
    few_.Run([this, task](FewAtOnce::Place place) {
      called_.push_back(task);
      places_.push_back(std::move(place));
    });
  }

  std::vector<int> called_;
  std::vector<FewAtOnce::Place> places_;
  FewAtOnce few_{2};
};

TEST_F(FewAtOnceTest, TasksBeginInTheirOrderAsPlacesComeFree) {
  for (int task = 1; task <= 4; ++task) Run(task);
  EXPECT_EQ(called_, (std::vector{1, 2}));
  places_[1] = nullptr;
  EXPECT_EQ(called_, (std::vector{1, 2, 3}));
  places_[0] = nullptr;
  EXPECT_EQ(called_, (std::vector{1, 2, 3, 4}));
}

TEST_F(FewAtOnceTest, TaskThatGivesItsPlaceBackAtOnceLetsTheNextBegin) {
  int called = 0;
  for (int task = 0; task < 10; ++task) few_.Run([&called](const FewAtOnce::Place&) { ++called; });
  EXPECT_EQ(called, 10);
}

TEST_F(FewAtOnceTest, WaitingTasksThatGiveTheirPlacesBackAtOnceAllBegin) {
  Run(1);
  Run(2);
  int called = 0;
  // So many would not fit on the stack within one another.
  for (int task = 0; task < 1'000'000; ++task) {
    few_.Run([&called](const FewAtOnce::Place&) { ++called; });
  }
  EXPECT_EQ(called, 0);
  places_[0] = nullptr;
  EXPECT_EQ(called, 1'000'000);
}

TEST_F(FewAtOnceTest, PlaceMayOutliveIt) {
  FewAtOnce::Place place;
  {
    FewAtOnce few(1);
    few.Run([&place](FewAtOnce::Place own) { place = std::move(own); });
  }
  place = nullptr;
}

TEST(FewAtOnceOfThreads, NoMoreThanAFewAreUnderWayAndAllAre) {
  constexpr int kTasks = 2000;
  FewAtOnce few(2);
  std::atomic<int> under_way = 0, most = 0, ended = 0;
  std::mutex mutex;
  std::vector<std::thread> ends;
  const auto task = [&](const FewAtOnce::Place& place) {
    const int now = ++under_way;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    const std::lock_guard lock(mutex);
    ends.emplace_back([&, place = FewAtOnce::Place(place)]() mutable {
      --under_way;
      place = nullptr;
      ++ended;
    });
  };
  {
    std::vector<std::jthread> callers;
    for (int caller = 0; caller < 4; ++caller) {
      callers.emplace_back([&] {
        for (int i = 0; i < kTasks / 4; ++i) few.Run(task);
      });
    }
  }
  while (ended < kTasks) std::this_thread::yield();
  for (std::thread& end : ends) end.join();
  EXPECT_LE(most, 2);
}

}  // namespace
}  // namespace contact
