#include "base/executor.h"

#include <gmock/gmock.h>
#include <pthread.h>

#include <array>
#include <future>
#include <numeric>
#include <string>
#include <vector>

namespace contact {
namespace {

TEST(ExecutorTest, TasksRunOneAfterAnotherInTheOrderPosted) {
  std::vector<int> order;  // Only the executor's thread writes it.
  Executor executor;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(executor.Post([&order, i] { order.push_back(i); }));
  executor.Stop();
  std::vector<int> expected(1000);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

TEST(ExecutorTest, StopRunsWhatWasPostedAndRefusesWhatComesAfter) {
  Executor executor;
  std::promise<void> go;
  int ran = 0;
  executor.Post([&] { go.get_future().wait(); });
  for (int i = 0; i < 3; ++i) executor.Post([&ran] { ++ran; });
  std::thread stopper([&] { executor.Stop(); });
  go.set_value();
  stopper.join();
  EXPECT_EQ(ran, 3);
  EXPECT_FALSE(executor.Post([&ran] { ++ran; }));
  executor.Stop();
  EXPECT_EQ(ran, 3);
}

TEST(ExecutorTest, DestructionStops) {
  bool ran = false;
  {
    Executor().Post([&ran] { ran = true; });
  }
  EXPECT_TRUE(ran);
}

TEST(ExecutorTest, PostDoesNotWaitForTheTask) {
  std::promise<void> go;
  bool ran = false;
  Executor executor;
  executor.Post([&] {
    go.get_future().wait();
    ran = true;
  });
  go.set_value();  // Reached though the task had not run.
  executor.Stop();
  EXPECT_TRUE(ran);
}

TEST(ExecutorTest, TasksOfManyThreadsAllRun) {
  int ran = 0;
  Executor executor;
  std::vector<std::thread> posters;
  for (int i = 0; i < 4; ++i) {
    posters.emplace_back([&] {
      for (int j = 0; j < 500; ++j) executor.Post([&ran] { ++ran; });
    });
  }
  for (std::thread& poster : posters) poster.join();
  executor.Stop();
  EXPECT_EQ(ran, 2000);
}

TEST(ExecutorTest, ThreadHasItsName) {
  std::array<char, 16> name{};
  Executor executor("fifteen-letters");
  executor.Post([&] { pthread_getname_np(pthread_self(), name.data(), name.size()); });
  executor.Stop();
  EXPECT_STREQ(name.data(), "fifteen-letters");
}

}  // namespace
}  // namespace contact
