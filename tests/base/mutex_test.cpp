#include "base/mutex.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>
#include <vector>

namespace contact {
namespace {

bool FreeForOthers(Mutex& mutex) {
  return std::async(std::launch::async,
                    [&mutex]() ABSL_NO_THREAD_SAFETY_ANALYSIS {
                      const bool free = mutex.try_lock();
                      if (free) mutex.unlock();
                      return free;
                    })
      .get();
}

TEST(MutexTest, LockHoldsItForItsScope) {
  Mutex mutex;
  {
    const MutexLock lock(mutex);
    EXPECT_FALSE(FreeForOthers(mutex));
  }
  EXPECT_TRUE(FreeForOthers(mutex));
}

TEST(MutexTest, OneThreadAtATimeHoldsIt) {
  Mutex mutex;
  int count = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int j = 0; j < 5000; ++j) {
        const MutexLock lock(mutex);
        ++count;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(count, 20'000);
}

}  // namespace
}  // namespace contact
