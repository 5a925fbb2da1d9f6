// What several processes of one database see of each other: claims, leases, limits and notes.
#include "storage/shared_store.h"

#include <absl/strings/str_cat.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "storage/every_store.h"
#include "storage/postgres/connection.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class SharedStoreTest : public testing::Test {
 protected:
  // A process with a connection of its own.
  class Process {
   public:
    explicit Process(const PostgresDatabase& database)
        : store_(OpenPostgres(database.address()).value()) {}

    SharedStore& store() { return *store_; }
    template <class T, class Call>
    absl::StatusOr<T> Ask(Call call) {
      Await<absl::StatusOr<T>> result;
      call(*store_, result.callback());
      return result.Get();
    }
    absl::StatusOr<StoredJob> Create(const v1::Job& job, const UnfinishedLimits& limits = {}) {
      return Ask<StoredJob>([&](SharedStore& store, auto done) {
        store.Create({job, "", {}, true, 0, limits}, std::move(done));
      });
    }
    std::vector<HeldJob> Beat(const std::string& worker, std::chrono::milliseconds lease = 1min) {
      return Ask<std::vector<HeldJob>>([&](SharedStore& store, auto done) {
               store.Beat({.name = worker, .host = "h", .lease = lease}, std::move(done));
             })
          .value();
    }
    std::vector<StoredJob> ClaimJobs(const JobClaim& claim) {
      return Ask<std::vector<StoredJob>>(
                 [&](SharedStore& store, auto done) { store.Claim(claim, std::move(done)); })
          .value();
    }
    std::vector<std::string> Claim(const std::string& worker, int most, int most_running = 0) {
      std::vector<std::string> names;
      for (const StoredJob& stored :
           ClaimJobs({.worker = worker, .most = most, .most_running = most_running})) {
        names.push_back(stored.job.name());
      }
      return names;
    }
    absl::Status Move(const StoredJob& stored, v1::Job::State state) {
      v1::Job job = stored.job;
      job.set_state(state);
      return Ask<std::uint64_t>([&](SharedStore& store, auto done) {
               store.Update({.name = job.name(), .epoch = stored.epoch, .job = &job},
                            std::move(done));
             })
          .status();
    }
    std::string Keep(const std::string& name, const std::string& value, bool replace) {
      return Ask<std::string>([&](SharedStore& store, auto done) {
               store.Keep(name, value, replace, std::move(done));
             })
          .value();
    }
    Demand Count() {
      return Ask<Demand>([](SharedStore& store, auto done) { store.Count(std::move(done)); })
          .value();
    }

   private:
    std::unique_ptr<SharedStore> store_;
  };

  static v1::Job Job(const std::string& name, const std::string& owner = "ada", int priority = 0,
                     const std::string& tenant = "acme") {
    v1::Job job = MakeJob("jobs/" + name);
    job.set_state(v1::Job::QUEUED);
    job.set_owner(owner);
    job.set_tenant(tenant);
    job.set_priority(priority);
    return job;
  }

  // Straight to the tables.
  void Use(const std::string& sql) {
    const absl::Status done = connection_->RunScript(sql);
    ASSERT_TRUE(done.ok()) << done;
  }
  std::int64_t Ask(const std::string& sql) { return connection_->Run({sql})->Integer(0, 0); }

  PostgresDatabase database_;
  const std::unique_ptr<postgres::Connection> connection_ =
      postgres::Connection::Open(database_.address()).value();
  Process one_{database_};
  Process two_{database_};
};

TEST_F(SharedStoreTest, JobIsClaimedOnceByPriorityThenAge) {
  for (const auto& [name, priority] : {std::pair("a", 0), {"b", 0}, {"c", 5}}) {
    ASSERT_TRUE(one_.Create(Job(name, "ada", priority)).ok());
  }
  one_.Beat("w1");
  two_.Beat("w2");
  EXPECT_THAT(one_.Claim("w1", 1), ElementsAre("jobs/c"));
  EXPECT_THAT(two_.Claim("w2", 9), ElementsAre("jobs/a", "jobs/b"));
  EXPECT_THAT(one_.Claim("w1", 9), IsEmpty());
  EXPECT_THAT(one_.Beat("w1"), testing::SizeIs(1));
  EXPECT_EQ(one_.Count().running, 3);
}

TEST_F(SharedStoreTest, ClaimedJobComesWithCheckpointAndSmallSpec) {
  const auto stored = one_.Create(Job("a"));
  const Checkpoint checkpoint{0, "state"};
  ASSERT_TRUE(one_.Ask<std::uint64_t>([&](SharedStore& store, auto done) {
                    store.Update({.name = stored->job.name(), .checkpoint = &checkpoint},
                                 std::move(done));
                  })
                  .ok());
  v1::Job large = Job("b");
  large.mutable_scenario()->set_title(std::string(1000, 'x'));
  ASSERT_TRUE(one_.Create(large).ok());
  one_.Beat("w1");
  const auto claimed = one_.ClaimJobs({.worker = "w1", .most = 2, .spec_bytes = 900});
  ASSERT_EQ(claimed.size(), 2U);
  EXPECT_EQ(claimed[0].job.scenario().title(), "of jobs/a");
  EXPECT_EQ(claimed[0].checkpoint, "state");
  EXPECT_TRUE(claimed[1].intact);
  EXPECT_FALSE(claimed[1].job.has_scenario()) << "its worker reads it when it is its turn";
}

TEST_F(SharedStoreTest, DamagedSpecStaysBehind) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  database_.Run("UPDATE contactd.specs SET spec = '\\x00'");
  one_.Beat("w1");
  const auto claimed = one_.ClaimJobs({.worker = "w1", .most = 1});
  ASSERT_EQ(claimed.size(), 1U);
  EXPECT_TRUE(claimed[0].intact);
  EXPECT_EQ(claimed[0].job.owner(), "ada");
  EXPECT_FALSE(claimed[0].job.has_scenario());
}

TEST_F(SharedStoreTest, ManyWorkersThatClaimAtOnceShareNoJob) {
  constexpr int kJobs = 300;
  for (int i = 0; i < kJobs; ++i) {
    const std::string number = std::to_string(i);
    ASSERT_TRUE(one_.Create(Job(number, "owner" + std::to_string(i % 3))).ok());
  }
  std::vector<std::future<std::vector<std::string>>> workers;
  for (int i = 0; i < 4; ++i) {
    workers.push_back(std::async(std::launch::async, [this, i] {
      Process process(database_);
      const std::string name = "w" + std::to_string(i);
      process.Beat(name);
      std::vector<std::string> all;
      for (auto some = process.Claim(name, 7); !some.empty(); some = process.Claim(name, 7)) {
        all.insert(all.end(), some.begin(), some.end());
      }
      return all;
    }));
  }
  std::vector<std::string> claimed;
  for (auto& worker : workers) {
    for (std::string& name : worker.get()) claimed.push_back(std::move(name));
  }
  EXPECT_EQ(claimed.size(), static_cast<std::size_t>(kJobs));
  EXPECT_EQ(std::set(claimed.begin(), claimed.end()).size(), static_cast<std::size_t>(kJobs));
}

TEST_F(SharedStoreTest, WhatOneKeepsFirstAllHave) {
  EXPECT_EQ(one_.Keep("secret", "of one", false), "of one");
  EXPECT_EQ(two_.Keep("secret", "of two", false), "of one");
  EXPECT_EQ(two_.Keep("other", std::string("\0\xff", 2), false), std::string("\0\xff", 2));
  EXPECT_EQ(two_.Keep("secret", "new", true), "new");
  EXPECT_EQ(one_.Keep("secret", "of one", false), "new");
}

TEST_F(SharedStoreTest, UnknownOrExpiredWorkerGetsNoJob) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  EXPECT_THAT(one_.Claim("nobody", 1), IsEmpty());
  one_.Beat("w1", 0ms);
  EXPECT_THAT(one_.Claim("w1", 1), IsEmpty());
}

TEST_F(SharedStoreTest, JobOfADeadWorkerGoesToALivingOneAndTheDeadOneChangesItNoMore) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  one_.Beat("w1");
  const StoredJob before = one_.ClaimJobs({.worker = "w1", .most = 1}).front();
  ASSERT_TRUE(one_.Move(before, v1::Job::RUNNING).ok());
  two_.Beat("w2");
  EXPECT_THAT(two_.Claim("w2", 1), IsEmpty()) << "w1 lives";
  one_.Beat("w1", 0ms);  // It dies.
  const std::vector<StoredJob> taken = two_.ClaimJobs({.worker = "w2", .most = 0});
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].job.state(), v1::Job::RUNNING) << "the new one decides what becomes of it";
  EXPECT_EQ(taken[0].epoch, before.epoch + 1);
  EXPECT_TRUE(absl::IsAborted(one_.Move(before, v1::Job::SUCCEEDED)));
  EXPECT_THAT(one_.Beat("w1"), IsEmpty());
  EXPECT_TRUE(two_.Move(taken[0], v1::Job::QUEUED).ok());
  EXPECT_EQ(two_.Count().queued, 1) << "a job that is handed back waits for anybody";
}

TEST_F(SharedStoreTest, AfterAStartOfTheDatabaseWorkersHaveAWhileToComeBack) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  one_.Beat("w1");
  ASSERT_EQ(one_.Claim("w1", 1).size(), 1U);
  one_.Beat("w1", 0ms);
  two_.Beat("w2");
  EXPECT_THAT(two_.ClaimJobs({.worker = "w2", .most = 1, .grace = 24h}), IsEmpty());
}

TEST_F(SharedStoreTest, WhatALeavingWorkerHasNotBegunWaitsAgain) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  one_.Beat("w1");
  ASSERT_EQ(one_.Claim("w1", 1).size(), 1U);
  ASSERT_TRUE(
      one_.Ask<bool>([](SharedStore& store, auto done) { store.Leave("w1", std::move(done)); })
          .ok());
  const Demand demand = two_.Count();
  EXPECT_EQ(demand.queued, 1);
  EXPECT_EQ(demand.workers, 0);
}

TEST_F(SharedStoreTest, OwnersOfATenantAndTenantsTakeTurns) {
  for (int i = 0; i < 9; ++i) {
    const std::string n = std::to_string(i);
    ASSERT_TRUE(one_.Create(Job("a" + n, "ada")).ok());
    if (i < 3) {
      ASSERT_TRUE(one_.Create(Job("b" + n, "bob")).ok());
      ASSERT_TRUE(one_.Create(Job("e" + n, "eve", 0, "umbra")).ok());
    }
  }
  one_.Beat("w1");
  std::map<char, int> of;
  for (const std::string& name : one_.Claim("w1", 8)) ++of[name[5]];
  EXPECT_EQ(of['e'], 3) << "half, or all there are";
  EXPECT_LE(std::abs(of['a'] - of['b']), 1) << of['a'] << " and " << of['b'];
}

TEST_F(SharedStoreTest, WhatAnOwnerHasTooFewJobsForGoesToTheOthers) {
  for (int i = 0; i < 9; ++i) {
    ASSERT_TRUE(one_.Create(Job("a" + std::to_string(i), "ada")).ok());
  }
  ASSERT_TRUE(one_.Create(Job("b", "bob")).ok());
  one_.Beat("w1");
  EXPECT_EQ(one_.Claim("w1", 8).size(), 8U);
}

TEST_F(SharedStoreTest, OwnerWhoHasUsedMoreWorkerTimeWaits) {
  for (const char* owner : {"ada", "bob"}) {
    ASSERT_TRUE(one_.Create(Job(std::string("of") + owner, owner)).ok());
  }
  one_.Beat("w1");
  const auto first = one_.ClaimJobs(
      {.worker = "w1", .most = 1, .used = {{{"ada", "acme"}, 90s}, {{"bob", "acme"}, 30s}}});
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].job.owner(), "bob");
}

TEST_F(SharedStoreTest, UsedWorkerTimeCountsHalfEachMinute) {
  for (const char* owner : {"ada", "bob"}) {
    ASSERT_TRUE(one_.Create(Job(std::string("of") + owner, owner)).ok());
  }
  one_.Beat("w1");
  one_.ClaimJobs({.worker = "w1", .used = {{{"ada", "acme"}, 90s}}});
  Use("UPDATE contactd.used SET at = at - interval '2 minutes'");
  const auto first = one_.ClaimJobs({.worker = "w1", .most = 1, .used = {{{"bob", "acme"}, 30s}}});
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].job.owner(), "ada");
}

TEST_F(SharedStoreTest, OwnerIsServedAfterDaysAndAfterAClockWasSetBack) {
  for (const char* days : {"-3", "3"}) {
    ASSERT_TRUE(one_.Create(Job(absl::StrCat("a", days))).ok());
    one_.Beat("w1");
    one_.ClaimJobs({.worker = "w1", .used = {{{"ada", "acme"}, 9s}}});
    Use(absl::StrCat("UPDATE contactd.used SET at = at + interval '", days, " days'"));
    EXPECT_EQ(one_.ClaimJobs({.worker = "w1", .most = 1}).size(), 1U) << days;
    one_.ClaimJobs({.worker = "w1", .used = {{{"ada", "acme"}, 9s}}});
  }
}

TEST_F(SharedStoreTest, WhatWasUsedLongAgoTakesNoSpace) {
  one_.Beat("w1");
  one_.ClaimJobs({.worker = "w1", .used = {{{"ada", "acme"}, 9s}, {{"bob", "acme"}, 9s}}});
  Use("UPDATE contactd.used SET at = at - interval '2 hours' WHERE owner = 'ada'");
  two_.Beat("w2");
  EXPECT_EQ(Ask("SELECT count(*) FROM contactd.used"), 1);
}

TEST_F(SharedStoreTest, NoOwnerRunsMoreThanItMayInAllProcesses) {
  for (const char* name : {"a", "b", "c"}) ASSERT_TRUE(one_.Create(Job(name)).ok());
  one_.Beat("w1");
  two_.Beat("w2");
  EXPECT_EQ(one_.Claim("w1", 9, 2).size(), 2U);
  EXPECT_THAT(two_.Claim("w2", 9, 2), IsEmpty());
  EXPECT_EQ(two_.Claim("w2", 9, 3).size(), 1U);
}

TEST_F(SharedStoreTest, OwnersThatAWorkerDoesNotWantAreLeftOut) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  one_.Beat("w1");
  EXPECT_THAT(one_.ClaimJobs({.worker = "w1", .most = 1, .none_of = {{"ada", "acme"}}}), IsEmpty());
  EXPECT_EQ(one_.ClaimJobs({.worker = "w1", .most = 1, .none_of = {{"ada", "umbra"}}}).size(), 1U);
}

TEST_F(SharedStoreTest, LimitsHoldHoweverManyProcessesCreateAtOnce) {
  constexpr int kMost = 7;
  std::atomic<int> created = 0;
  std::vector<std::thread> processes;
  for (int i = 0; i < 3; ++i) {
    processes.emplace_back([&, i] {
      Process process(database_);
      for (int j = 0; j < 5; ++j) {
        const std::string name = std::to_string(i) + "x" + std::to_string(j);
        const auto stored = process.Create(Job(name), {.owner_jobs = kMost});
        created += stored.ok() ? 1 : 0;
        if (stored.ok()) continue;
        EXPECT_TRUE(stored.status().GetPayload(kOwnerJobsPayload)) << stored.status();
      }
    });
  }
  for (std::thread& process : processes) process.join();
  EXPECT_EQ(created, kMost);
  EXPECT_TRUE(one_.Create(Job("other", "bob"), {.owner_jobs = kMost}).ok());
  EXPECT_TRUE(one_.Create(Job("full"), {.waiting = 8}).status().GetPayload(kWaitingPayload));
  v1::Job sweep = Job("sweep", "eve");
  sweep.mutable_progress()->set_cells(100);
  EXPECT_TRUE(one_.Create(sweep, {.owner_cells = 99}).status().GetPayload(kOwnerCellsPayload));
  EXPECT_TRUE(one_.Create(sweep, {.owner_cells = 100}).ok());
}

TEST_F(SharedStoreTest, ChangesOfOneProcessAreHeardByTheOther) {
  std::promise<void> listening, heard;
  std::vector<Note> notes;
  std::once_flag once;
  two_.store().Listen(
      [&](const Note& note) {
        notes.push_back(note);
        if (note.state == v1::Job::CANCELLED) std::call_once(once, [&] { heard.set_value(); });
      },
      [&] { listening.set_value(); });
  one_.store().Listen([](const Note&) {}, [] {});
  listening.get_future().wait();
  const auto stored = one_.Create(Job("a"));
  ASSERT_TRUE(one_.Move(*stored, v1::Job::CANCELLED).ok());
  heard.get_future().wait();
  two_.store().Unlisten();
  EXPECT_EQ(notes.back().name, "jobs/a");
  EXPECT_EQ(notes.back().tenant, "acme");
  one_.store().Unlisten();
}

TEST_F(SharedStoreTest, MovedJobsAreFoundWithoutNotes) {
  const auto moved = [this](std::uint64_t since) {
    return two_
        .Ask<MovedJobs>(
            [since](SharedStore& store, auto done) { store.Moved(since, std::move(done)); })
        .value();
  };
  const auto stored = one_.Create(Job("a"));
  const MovedJobs first = moved(0);
  EXPECT_THAT(first.jobs, IsEmpty());
  ASSERT_TRUE(one_.Ask<JobOwner>([](SharedStore& store, auto done) {
                    store.Remark({.name = "jobs/a", .note = "x"}, std::move(done));
                  })
                  .ok());
  EXPECT_EQ(moved(first.next).jobs.size(), 1U) << "as its note did";
  ASSERT_TRUE(one_.Move(*stored, v1::Job::CANCELLED).ok());
  const MovedJobs second = moved(first.next);
  ASSERT_EQ(second.jobs.size(), 1U);
  EXPECT_EQ(second.jobs[0].name, "jobs/a");
  EXPECT_EQ(second.jobs[0].tenant, "acme");
}

TEST_F(SharedStoreTest, ChangeThatIsSentAgainAfterALoanHasComeBackIsDoneOnce) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  one_.Beat("lender");
  two_.Beat("borrower");
  const StoredJob stored = one_.ClaimJobs({.worker = "lender", .most = 1}).front();
  ASSERT_TRUE(one_.Move(stored, v1::Job::RUNNING).ok());
  const std::vector<v1::Event> cells = {LogEvent("cell")};
  const std::string name = "jobs/a";
  const auto change = Store::Encode({.name = name, .epoch = stored.epoch, .events = cells});
  const auto update = [&](SharedStore& store, auto done) {
    store.Update(change, stored.epoch, std::move(done));
  };
  ASSERT_EQ(one_.Ask<std::uint64_t>(update).value(), 1U);
  const Loan loan{.job = name, .epoch = stored.epoch, .number = 1, .first = 0, .last = 0};
  const auto lend = [&](SharedStore& store, auto done) {
    store.Lend("lender", name, {loan}, std::move(done));
  };
  ASSERT_TRUE(one_.Ask<bool>(lend).ok());
  const auto take = [](SharedStore& store, auto done) {
    store.TakeLoan("borrower", std::move(done));
  };
  ASSERT_TRUE(two_.Ask<std::optional<Loan>>(take).ok());
  const auto give_back = [&](SharedStore& store, auto done) {
    store.ReturnLoan("borrower", loan, {}, cells, std::move(done));
  };
  ASSERT_EQ(two_.Ask<std::uint64_t>(give_back).value(), 2U);
  EXPECT_EQ(one_.Ask<std::uint64_t>(update).value(), 1U) << "the lender's answer was lost";
  EXPECT_TRUE(two_.Ask<std::uint64_t>(give_back).ok()) << "the borrower's answer was lost";
  EXPECT_EQ(database_.Run("SELECT count(*) FROM contactd.events").Integer(0, 0), 2);
}

TEST_F(SharedStoreTest, PositionsAreThoseOfTheLogs) {
  ASSERT_TRUE(one_.Create(Job("a")).ok());
  const auto positions = two_.Ask<std::vector<LogPosition>>([](SharedStore& store, auto done) {
                               store.Positions({"jobs/a", "jobs/none"}, std::move(done));
                             })
                             .value();
  ASSERT_EQ(positions.size(), 1U);
  EXPECT_EQ(positions[0].last_sequence, 0U);
  EXPECT_FALSE(positions[0].ended);
}

}  // namespace
}  // namespace contact
