#include "jobs/schedule/job_queue.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

namespace contact {
namespace {

using testing::ElementsAre;

std::vector<std::string> PopAll(JobQueue& queue) {
  std::vector<std::string> names;
  while (const auto name = queue.Pop(false)) names.push_back(*name);
  return names;
}

TEST(JobQueue, OrderIsThatOfPriorityThenOfComingForEveryOrderOfPushes) {
  struct Job {
    std::string name;
    std::int32_t priority;
    std::uint64_t number;
  };
  std::vector<Job> jobs = {{"a", -1, 1}, {"b", 0, 2}, {"c", 5, 3}, {"d", 0, 4}, {"e", 5, 5}};
  const auto before = [](const Job& a, const Job& b) { return a.number < b.number; };
  do {
    JobQueue queue;
    for (const Job& job : jobs) queue.Push(job.name, job.priority, job.number, false);
    EXPECT_EQ(queue.size(), 5U);
    EXPECT_THAT(PopAll(queue), ElementsAre("c", "e", "b", "d", "a"));
    EXPECT_EQ(queue.size(), 0U);
  } while (std::ranges::next_permutation(jobs, before).found);
}

TEST(JobQueue, CarefulPopPassesOverLastAttemptsAndLeavesThemWaiting) {
  JobQueue queue;
  queue.Push("last", 9, 1, true);
  queue.Push("other", 0, 2, false);
  EXPECT_EQ(queue.Pop(true), "other");
  EXPECT_EQ(queue.Pop(true), std::nullopt);
  EXPECT_EQ(queue.Pop(false), "last");
}

TEST(JobQueue, RemovedJobIsNotPopped) {
  JobQueue queue;
  queue.Push("a", 0, 1, false);
  queue.Push("b", 0, 2, false);
  EXPECT_TRUE(queue.Remove(0, 1));
  EXPECT_FALSE(queue.Remove(0, 1)) << "it does not wait any more";
  EXPECT_FALSE(queue.Remove(1, 2)) << "none with this priority";
  EXPECT_THAT(PopAll(queue), ElementsAre("b"));
}

}  // namespace
}  // namespace contact
