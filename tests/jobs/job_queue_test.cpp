#include "jobs/schedule/job_queue.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "testing/about.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::Le;

const Share kLocalShare{"local", "local"};

std::vector<std::string> PopAll(JobQueue& queue) {
  std::vector<std::string> names;
  while (const auto name = queue.Pop(false, 0)) names.push_back(*name);
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
    for (const Job& job : jobs) queue.Push(kLocalShare, job.name, job.priority, job.number, false);
    EXPECT_EQ(queue.size(), 5U);
    EXPECT_THAT(PopAll(queue), ElementsAre("c", "e", "b", "d", "a"));
    EXPECT_EQ(queue.size(), 0U);
  } while (std::ranges::next_permutation(jobs, before).found);
}

TEST(JobQueue, CarefulPopPassesOverLastAttemptsAndLeavesThemWaiting) {
  JobQueue queue;
  queue.Push(kLocalShare, "last", 9, 1, true);
  queue.Push(kLocalShare, "other", 0, 2, false);
  EXPECT_EQ(queue.Pop(true, 0), "other");
  EXPECT_EQ(queue.Pop(true, 0), std::nullopt);
  EXPECT_EQ(queue.Pop(false, 0), "last");
}

TEST(JobQueue, RemovedJobIsNotPopped) {
  JobQueue queue;
  queue.Push(kLocalShare, "a", 0, 1, false);
  queue.Push(kLocalShare, "b", 0, 2, false);
  EXPECT_TRUE(queue.Remove(kLocalShare, 0, 1));
  EXPECT_FALSE(queue.Remove(kLocalShare, 0, 1)) << "it does not wait any more";
  EXPECT_FALSE(queue.Remove(kLocalShare, 1, 2)) << "none with this priority";
  EXPECT_FALSE(queue.Remove({"local", "other"}, 0, 2)) << "another's";
  EXPECT_THAT(PopAll(queue), ElementsAre("b"));
}

TEST(JobQueue, OwnerRunsNoMoreThanTheMost) {
  JobQueue queue(1);
  queue.Push(kLocalShare, "a", 0, 1, false);
  queue.Push(kLocalShare, "b", 0, 2, false);
  EXPECT_EQ(queue.Pop(false, 0), "a");
  EXPECT_EQ(queue.Pop(false, 0), std::nullopt);
  queue.Ended(kLocalShare, 1);
  EXPECT_EQ(queue.Pop(false, 1), "b");
}

// Workers that run the jobs of a queue for some time.
class Shares : public testing::Test {
 protected:
  // So many jobs, each of so many seconds.
  void Add(const Share& share, int jobs, double duration) {
    for (int i = 0; i < jobs; ++i) {
      std::string name = std::to_string(++jobs_);
      duration_[name] = duration;
      share_[name] = share;
      queue_.Push(share, std::move(name), 0, jobs_, false);
    }
  }

  // Lets `workers` work from where they are to `end`. `ended` is told whose job has ended.
  void Work(int workers, double end, const std::function<void(const Share&)>& ended = {}) {
    for (;;) {
      while (static_cast<int>(until_.size()) < workers) {
        const auto name = queue_.Pop(false, now_);
        if (!name) break;
        until_.emplace(now_ + duration_[*name], *name);
        began_[*name] = now_;
      }
      if (until_.empty() || until_.begin()->first > end) break;
      const auto next = until_.extract(until_.begin());
      now_ = next.key();
      const Share& share = share_[next.mapped()];
      used_[share.owner] += duration_[next.mapped()];
      queue_.Ended(share, now_);
      if (ended) ended(share);
    }
    for (const auto& [at, name] : until_) used_[share_[name].owner] += end - began_[name];
    now_ = end;
  }

  JobQueue queue_;
  // Worker time by owner.
  std::map<std::string, double> used_;

 private:
  std::uint64_t jobs_ = 0;
  double now_ = 0;
  std::map<std::string, double> duration_, began_;
  std::map<std::string, Share> share_;
  // The jobs that run, by when they end.
  std::multimap<double, std::string> until_;
};

TEST_F(Shares, OwnersGetTheSameTimeHoweverManyJobsTheyHaveAndHoweverLong) {
  Add({"t", "flood"}, 10'000, 0.01);
  Add({"t", "short"}, 6000, 0.02);
  Add({"t", "long"}, 50, 1);
  Work(2, 60);
  EXPECT_THAT(used_["flood"], About(40));
  EXPECT_THAT(used_["short"], About(40));
  EXPECT_THAT(used_["long"], About(40));
}

TEST_F(Shares, TenantsGetTheSameTimeHoweverManyOwnersTheyHave) {
  for (const char* owner : {"a", "b", "c"}) Add({"many", owner}, 1000, 0.1);
  Add({"one", "d"}, 1000, 0.1);
  Work(2, 60);
  EXPECT_THAT(used_["d"], About(60));
  EXPECT_THAT(used_["a"], About(20));
  EXPECT_THAT(used_["b"], About(20));
}

TEST_F(Shares, OneWhoComesLaterIsNextButHasSavedNothing) {
  Add({"t", "early"}, 10'000, 0.1);
  Work(1, 300);
  used_.clear();
  Add({"t", "late"}, 1, 0.1);
  EXPECT_EQ(queue_.Pop(false, 300), "10001") << "before thousands that came earlier";
  queue_.Ended({"t", "late"}, 300.1);
  Add({"t", "late"}, 1000, 0.1);
  Work(1, 360);
  EXPECT_THAT(used_["early"], About(30));
  EXPECT_THAT(used_["late"], About(30));
}

TEST_F(Shares, OneWhoComesBackAfterEachJobGainsNothing) {
  Add({"t", "steady"}, 1000, 0.1);
  Add({"t", "again"}, 1, 2);
  Work(1, 60, [this](const Share& share) {
    if (share.owner == "again") Add(share, 1, 2);
  });
  EXPECT_THAT(used_["again"], Le(32));
}

}  // namespace
}  // namespace contact
