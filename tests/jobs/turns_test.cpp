#include "jobs/schedule/turns.h"

#include <gmock/gmock.h>

#include <map>
#include <string>
#include <vector>

#include "testing/about.h"

namespace contact {
namespace {

// Runs that never end and yield as soon as they are asked to, on some workers.
class Endless : public testing::Test {
 protected:
  void Add(const std::string& tenant, const std::string& owner, int jobs = 1) {
    for (int i = 0; i < jobs; ++i) {
      const std::uint64_t number = ++jobs_;
      const std::string name = owner + std::to_string(number);
      owner_[name] = owner;
      turns_.Add({{tenant, owner}, name, 0, number, false});
    }
  }

  // Lets time pass up to `end`, with a look at the runs every 50 ms.
  void Pass(double end) {
    for (; now_ < end; now_ += 0.05) {
      if (const auto yields = turns_.ToYield(false, now_)) {
        turns_.Park(*yields, now_);
        std::erase(computing_, *yields);
        ++yielded_;
      }
      while (const auto next = turns_.Take(false, now_)) {
        if (!next->parked) began_.emplace(owner_[next->name], now_);
        computing_.push_back(next->name);
      }
      ASSERT_LE(computing_.size(), 2U);
      for (const std::string& name : computing_) used_[owner_[name]] += 0.05;
    }
  }

  Turns turns_{2, 0};
  std::map<std::string, double> used_;
  // When the first run of an owner began.
  std::map<std::string, double> began_;
  int yielded_ = 0;

 private:
  std::uint64_t jobs_ = 0;
  double now_ = 0;
  std::map<std::string, std::string> owner_;
  std::vector<std::string> computing_;
};

TEST_F(Endless, OwnerAloneKeepsItsWorkers) {
  Add("t", "a", 100);
  Pass(60);
  EXPECT_EQ(yielded_, 0);
}

TEST_F(Endless, OneWhoComesLaterBeginsWithinASecond) {
  Add("t", "flood", 10'000);
  Pass(100);
  Add("t", "late");
  Pass(110);
  EXPECT_LE(began_["late"], 101);
  EXPECT_THAT(used_["late"], About(9.9));
}

TEST_F(Endless, OwnersGetTheSameTime) {
  Add("t", "flood", 1000);
  Add("t", "b", 2);
  Add("t", "c", 2);
  Pass(60);
  for (const char* owner : {"flood", "b", "c"}) EXPECT_THAT(used_[owner], About(40)) << owner;
  EXPECT_LE(yielded_, 240) << "a turn lasts half a second";
}

TEST_F(Endless, TenantsGetTheSameTime) {
  Add("many", "a", 2);
  Add("many", "b", 2);
  Add("many", "c", 2);
  Add("one", "d", 2);
  Pass(60);
  EXPECT_THAT(used_["d"], About(60));
  EXPECT_THAT(used_["a"], About(20));
}

TEST(Turns, RunThatIsToEndGoesOnThoughNoWorkerIsFree) {
  Turns turns(1, 0);
  turns.Add({{"t", "a"}, "first", 0, 1, false});
  EXPECT_EQ(turns.Take(false, 0)->name, "first");
  turns.Add({{"t", "b"}, "second", 0, 2, false});
  EXPECT_EQ(turns.ToYield(false, 1), "first");
  turns.Park("first", 1);
  EXPECT_EQ(turns.waiting(), 1);
  EXPECT_EQ(turns.Take(false, 1)->name, "second");
  turns.Unpark("first", 1);
  EXPECT_FALSE(turns.parked("first"));
  EXPECT_TRUE(turns.End("first", 2));
  EXPECT_FALSE(turns.End("first", 2));
  EXPECT_FALSE(turns.Borrow()) << "the second computes";
  EXPECT_TRUE(turns.End("second", 2));
  EXPECT_TRUE(turns.Borrow());
}

TEST(Turns, RunThatCannotYieldDoesNotStandInForTheOthers) {
  Turns turns(2, 0);
  turns.Add({{"t", "a"}, "one", 0, 1, false});
  turns.Add({{"t", "a"}, "other", 0, 2, false});
  turns.Take(false, 0);
  turns.Take(false, 0);
  turns.Add({{"t", "b"}, "waits", 0, 3, false});
  const auto first = turns.ToYield(false, 1);  // It is in a long episode.
  const auto second = turns.ToYield(false, 2);
  ASSERT_TRUE(first && second);
  EXPECT_NE(*first, *second);
  turns.Park(*second, 2);
  EXPECT_EQ(turns.Take(false, 2)->name, "waits");
}

TEST(Turns, RemovedJobDoesNotWait) {
  Turns turns(1, 0);
  const Turns::Job job{{"t", "a"}, "job", 0, 1, false};
  turns.Add(job);
  EXPECT_TRUE(turns.Remove(job));
  EXPECT_FALSE(turns.Remove(job));
  EXPECT_EQ(turns.waiting(), 0);
  EXPECT_FALSE(turns.Take(false, 0));
}

}  // namespace
}  // namespace contact
