// What a tenant sees of the store.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "storage/every_store.h"

namespace contact {
namespace {

class TenantTest : public EveryStoreTest {
 protected:
  void SetUp() override {
    Open();
    for (const char* tenant : {"acme", "umbra"}) {
      for (const char* owner : {"ada", "bob"}) {
        ASSERT_TRUE(Create(Of(tenant, owner), "same id of " + std::string(owner)).ok());
      }
    }
  }
  static v1::Job Of(const std::string& tenant, const std::string& owner) {
    v1::Job job = MakeJob("jobs/" + tenant + owner);
    job.set_tenant(tenant);
    job.set_owner(owner);
    return job;
  }
  std::vector<std::string> Names(JobQuery query) {
    std::vector<std::string> names;
    const auto page = List(std::move(query));  // Outlives the loop.
    for (const StoredJob& stored : page->jobs) names.push_back(stored.job.name());
    return names;
  }
};

INSTANTIATE_FOR_EVERY_STORE(TenantTest);

TEST_P(TenantTest, SeesItsOwnJobsOnly) {
  EXPECT_EQ(ReadOf("acme", "jobs/acmeada")->job.owner(), "ada");
  EXPECT_TRUE(absl::IsNotFound(ReadOf("umbra", "jobs/acmeada").status()));
  EXPECT_TRUE(absl::IsNotFound(ReadOf("", "jobs/acmeada").status()));
  EXPECT_EQ(Owner("acme", "jobs/acmebob")->owner, "bob");
  EXPECT_TRUE(absl::IsNotFound(Owner("umbra", "jobs/acmebob").status()));
}

TEST_P(TenantTest, OtherJobsAreToldLikeJobsThatAreNotThere) {
  const std::string other(ReadOf("umbra", "jobs/acmeada").status().message());
  EXPECT_EQ(other, "there is no job jobs/acmeada");
  EXPECT_EQ(ReadOf("umbra", "jobs/none").status().message(), "there is no job jobs/none");
}

TEST_P(TenantTest, ListsItsOwnJobsWhateverTheFilter) {
  const std::vector<std::string> own = {"jobs/acmebob", "jobs/acmeada"};
  EXPECT_EQ(Names({.tenant = "acme"}), own);
  EXPECT_EQ(Names({.tenant = "acme", .states = {v1::Job::QUEUED}}), own);
  EXPECT_EQ(Names({.tenant = "acme", .labels = {{"study", "a"}}}), own);
  EXPECT_EQ(Names({.tenant = "acme", .name_prefix = "jobs/u"}), std::vector<std::string>());
  EXPECT_EQ(Names({.tenant = "nobody"}), std::vector<std::string>());
  EXPECT_EQ(Names({}).size(), 4U) << "the server itself sees all";
  const auto first = List({.tenant = "acme", .limit = 1});
  EXPECT_EQ(Names({.tenant = "acme", .before = first->next}),
            std::vector<std::string>({"jobs/acmeada"}));
}

TEST_P(TenantTest, RequestIdsBelongToTheTenant) {
  v1::Job job = Of("acme", "ada");
  job.set_name("jobs/new");
  job.mutable_scenario()->set_title("of jobs/acmeada");
  EXPECT_EQ(Create(job, "same id of ada")->job.name(), "jobs/acmeada");
  job.mutable_scenario()->set_title("another");
  EXPECT_TRUE(absl::IsAlreadyExists(Create(job, "same id of ada").status()));
  job.set_tenant("third");
  EXPECT_EQ(Create(job, "same id of ada")->job.name(), "jobs/new");
}

}  // namespace
}  // namespace contact
