// What callers of one tenant find of the jobs of others.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "jobs_fixture.h"

namespace contact {
namespace {

const Principal kBoss{"boss", "acme", {Role::kOperator}, "token"};
const Principal kEveAsAdmin{"eve", "umbra", {Role::kAdmin}, "token"};

class TenantJobsTest : public JobsTest {
 protected:
  std::string CreateAs(const Principal& caller, const v1::Scenario& scenario) {
    Await<Result<v1::Job>> result;
    manager_->creator().Create(caller, RequestFor(scenario), result.callback());
    return result.Get().value().name();
  }
  std::string Get(const Principal& caller, const std::string& name) {
    Await<Result<v1::Job>> result;
    manager_->reader().Get(caller, name, result.callback());
    return Reason(result.Get());
  }
  Result<v1::ListJobsResponse> ListAs(const Principal& caller, const v1::ListJobsRequest& request) {
    Await<Result<v1::ListJobsResponse>> result;
    manager_->reader().List(caller, request, result.callback());
    return result.Get();
  }
  std::string CancelAs(const Principal& caller, const std::string& name) {
    v1::CancelJobRequest request;
    request.set_name(name);
    Await<Result<v1::Job>> result;
    manager_->Cancel(caller, request, result.callback());
    return Reason(result.Get());
  }
  std::string NoteAs(const Principal& caller, const std::string& name) {
    v1::UpdateJobRequest request;
    request.mutable_job()->set_name(name);
    request.mutable_job()->set_note("by " + caller.name);
    Await<Result<v1::Job>> result;
    manager_->Update(caller, request, result.callback());
    return Reason(result.Get());
  }
  std::string DeleteAs(const Principal& caller, const std::string& name) {
    v1::DeleteJobRequest request;
    request.set_name(name);
    Await<Result<bool>> result;
    manager_->Delete(caller, request, result.callback());
    return Reason(result.Get());
  }
  template <class T>
  static std::string Reason(const Result<T>& result) {
    return result.ok() ? "" : result.error().reason;
  }
};

TEST_F(TenantJobsTest, JobBelongsToItsCreator) {
  OpenWithFakeRun();
  v1::CreateJobRequest request = RequestFor(BouncingBall());
  request.mutable_job()->set_owner("root");
  request.mutable_job()->set_tenant("umbra");
  Await<Result<v1::Job>> result;
  manager_->creator().Create(kAda, request, result.callback());
  const v1::Job job = result.Get().value();
  EXPECT_EQ(job.owner(), "ada") << "whatever the request says";
  EXPECT_EQ(job.tenant(), "acme");
}

TEST_F(TenantJobsTest, PageTokenOfAnotherTenantIsNone) {
  OpenWithFakeRun();
  CreateAs(kAda, BouncingBall());
  CreateAs(kAda, BouncingBall());
  CreateAs(kEveAsAdmin, BouncingBall());
  v1::ListJobsRequest page;
  page.set_page_size(1);
  page.set_page_token(ListAs(kAda, page).value().next_page_token());
  ASSERT_NE(page.page_token(), "");
  EXPECT_EQ(ListAs(kBob, page).value().jobs_size(), 1);
  EXPECT_EQ(Reason(ListAs(kEveAsAdmin, page)), "FIELD_INVALID");
}

TEST_F(TenantJobsTest, JobIsNotThereForOtherTenants) {
  OpenWithFakeRun();
  const std::string name = CreateAs(kAda, BouncingBall());
  EXPECT_EQ(Get(kBob, name), "");
  for (const Principal& stranger : {kEveAsAdmin, LocalPrincipal()}) {
    EXPECT_EQ(Get(stranger, name), "JOB_NOT_FOUND");
    EXPECT_EQ(CancelAs(stranger, name), "JOB_NOT_FOUND");
    EXPECT_EQ(DeleteAs(stranger, name), "JOB_NOT_FOUND");
    LogReader reader;
    v1::WatchJobRequest watch;
    watch.set_name(name);
    Await<Result<v1::Series>> series;
    v1::GetSeriesRequest ask;
    ask.set_name(name);
    manager_->recordings().GetSeries(stranger, ask, series.callback());
    EXPECT_EQ(Reason(series.Get()), "JOB_NOT_FOUND");
    auto watched = std::make_shared<std::promise<std::string>>();
    manager_->watches().WatchJob(stranger, watch, reader.wake(),
                                 [watched](const auto& job) { watched->set_value(Reason(job)); });
    EXPECT_EQ(watched->get_future().get(), "JOB_NOT_FOUND");
    v1::ReadArtifactRequest read;
    read.set_name(name);
    auto artifact = std::make_shared<std::promise<std::string>>();
    manager_->recordings().ReadArtifact(
        stranger, read, reader.wake(),
        [artifact](const auto& opened) { artifact->set_value(Reason(opened)); });
    EXPECT_EQ(artifact->get_future().get(), "JOB_NOT_FOUND");
    Await<Result<v1::ListJobsResponse>> listed;
    manager_->reader().List(stranger, {}, listed.callback());
    EXPECT_EQ(listed.Get().value().jobs_size(), 0);
  }
  EXPECT_NE(Create(RequestFor(BouncingBall())).value().name(), name);
}

TEST_F(TenantJobsTest, OnlyOwnerAndOperatorChangeAJob) {
  OpenWithFakeRun();
  const std::string first = CreateAs(kAda, BouncingBall());
  const std::string second = CreateAs(kAda, BouncingBall());
  EXPECT_EQ(CancelAs(kBob, first), "PERMISSION_DENIED");
  EXPECT_EQ(CancelAs(kAda, first), "");
  EXPECT_EQ(CancelAs(kBoss, second), "");
  EXPECT_EQ(NoteAs(kBob, second), "PERMISSION_DENIED");
  EXPECT_EQ(NoteAs(kEveAsAdmin, second), "JOB_NOT_FOUND");
  EXPECT_EQ(NoteAs(kAda, second), "");
  EXPECT_EQ(NoteAs(kBoss, second), "");
  EXPECT_EQ(DeleteAs(kBob, second), "PERMISSION_DENIED");
  for (const Principal& owner : {kAda, kBoss}) {
    const std::string& name = owner.name == "ada" ? first : second;
    std::string reason = "INVALID_STATE";  // Until its run has ended.
    while (reason == "INVALID_STATE") reason = DeleteAs(owner, name);
    EXPECT_EQ(reason, "");
  }
}

// Not even names of jobs come to the wrong tenant.
TEST_F(TenantJobsTest, WatcherHearsOfTheJobsOfItsTenantOnly) {
  OpenWithFakeRun();
  LogReader reader;
  const auto watch = std::move(manager_->watches().WatchJobs(kAda, {}, reader.wake()).value());
  const std::string hidden = CreateAs(kEveAsAdmin, BouncingBall());
  const std::string seen = CreateAs(kAda, BouncingBall());
  CancelAs(kEveAsAdmin, hidden);
  std::string reason = "INVALID_STATE";
  while (reason == "INVALID_STATE") reason = DeleteAs(kEveAsAdmin, hidden);
  CancelAs(kAda, seen);
  for (bool cancelled = false; !cancelled;) {
    v1::WatchJobsResponse message;
    if (!watch->Read(&message).has_message) {
      reader.Wait();
      continue;
    }
    EXPECT_EQ(message.ShortDebugString().find(hidden), std::string::npos);
    for (const v1::Job& job : message.jobs()) cancelled |= job.state() == v1::Job::CANCELLED;
  }
}

}  // namespace
}  // namespace contact
