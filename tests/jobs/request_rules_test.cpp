#include <gmock/gmock.h>

#include "jobs/read/create_rules.h"
#include "jobs/read/list_rules.h"
#include "jobs/read/series_rules.h"
#include "jobs/read/update_rules.h"
#include "jobs/read/watch_rules.h"

namespace contact {
namespace {

using testing::ElementsAre;

v1::CreateJobRequest Good() {
  v1::CreateJobRequest request;
  request.mutable_job()->mutable_scenario();
  return request;
}

std::vector<std::string> Fields(const std::vector<Violation>& violations) {
  std::vector<std::string> fields;
  fields.reserve(violations.size());
  for (const Violation& violation : violations) fields.push_back(violation.field);
  return fields;
}

TEST(CheckCreate, TakesLabelsUpToTheirLimits) {
  v1::CreateJobRequest request = Good();
  auto& labels = *request.mutable_job()->mutable_labels();
  for (char c = 'a'; c < 'a' + 15; ++c) labels[std::string(63, c)] = std::string(63, 'x');
  labels["A.b_c-9"] = "";
  EXPECT_THAT(CheckCreate(request), testing::IsEmpty());
  labels["one more"] = "x";
  EXPECT_THAT(Fields(CheckCreate(request)), testing::Contains("labels"));
}

TEST(CheckCreate, RefusesLabelsThatAreNoNames) {
  for (const auto& [key, value] : {std::pair<std::string, std::string>("", "x"),
                                   {std::string(64, 'a'), "x"},
                                   {"a", std::string(64, 'x')},
                                   {"a b", "x"},
                                   {"a", "ü"}}) {
    v1::CreateJobRequest request = Good();
    (*request.mutable_job()->mutable_labels())[key] = value;
    EXPECT_EQ(CheckCreate(request).size(), 1U) << key << "=" << value;
  }
}

TEST(CheckCreate, TakesRequestIdsUpToTheirLimit) {
  v1::CreateJobRequest request = Good();
  request.set_request_id(std::string(64, '~'));
  EXPECT_THAT(CheckCreate(request), testing::IsEmpty());
  request.set_request_id(std::string(65, '~'));
  EXPECT_THAT(Fields(CheckCreate(request)), ElementsAre("request_id"));
  request.set_request_id("a\nb");
  EXPECT_THAT(Fields(CheckCreate(request)), ElementsAre("request_id"));
}

TEST(CheckCreate, NamesAllViolationsAtOnce) {
  v1::CreateJobRequest request;
  request.set_request_id("\x01");
  (*request.mutable_job()->mutable_labels())["ö"] = "";
  EXPECT_THAT(Fields(CheckCreate(request)), ElementsAre("request_id", "labels[ö]", "scenario"));
}

TEST(CheckCreate, TakesSettingsUpToTheirLimits) {
  v1::CreateJobRequest request = Good();
  v1::Job& job = *request.mutable_job();
  for (const int priority : {-100, 100}) {
    job.set_priority(priority);
    EXPECT_THAT(CheckCreate(request), testing::IsEmpty());
  }
  job.mutable_budget()->mutable_wall_time()->set_nanos(1'000'000);
  job.mutable_budget()->set_steps(10);
  job.mutable_budget()->set_output_bytes(20);
  job.mutable_time_to_live()->set_seconds(1);
  EXPECT_THAT(CheckCreate(request), testing::IsEmpty());
  const RunBudget most{std::chrono::milliseconds(1), 10, 20};
  EXPECT_THAT(CheckCreate(request, most), testing::IsEmpty());
  job.mutable_budget()->mutable_wall_time()->set_seconds(1);
  job.mutable_budget()->set_steps(11);
  job.mutable_budget()->set_output_bytes(21);
  const auto violations = CheckCreate(request, most);
  EXPECT_THAT(Fields(violations),
              ElementsAre("budget.wall_time", "budget.steps", "budget.output_bytes"));
  EXPECT_EQ(violations[1].description, "is 11; must be at most 10, the server's limit");
  EXPECT_FALSE(violations[1].hint.empty());
}

TEST(CheckCreate, RefusesSettingsThatAreNone) {
  v1::CreateJobRequest request = Good();
  v1::Job& job = *request.mutable_job();
  job.set_priority(101);
  job.mutable_budget()->mutable_wall_time()->set_nanos(999'999);
  job.mutable_budget()->set_steps(-1);
  job.mutable_budget()->set_output_bytes(-1);
  job.mutable_time_to_live()->set_seconds(INT64_MAX);
  EXPECT_THAT(Fields(CheckCreate(request)),
              ElementsAre("priority", "budget.wall_time", "budget.steps", "budget.output_bytes",
                          "time_to_live"));
  job.set_priority(-101);
  job.mutable_budget()->mutable_wall_time()->set_seconds(1);
  job.mutable_budget()->mutable_wall_time()->set_nanos(-1);
  EXPECT_EQ(CheckCreate(request).size(), 5U);
}

v1::UpdateJobRequest NoteOf(const std::string& note, const std::string& path = "note") {
  v1::UpdateJobRequest request;
  request.mutable_job()->set_note(note);
  request.mutable_update_mask()->add_paths(path);
  return request;
}

TEST(ToRemark, ChangesWhatTheMaskNamesOrWhatIsThere) {
  v1::UpdateJobRequest request = NoteOf("x");
  (*request.mutable_job()->mutable_labels())["a"] = "b";
  EXPECT_FALSE(ToRemark(request).value().labels);
  EXPECT_EQ(ToRemark(request).value().note, "x");
  request.clear_update_mask();
  EXPECT_EQ(ToRemark(request).value().labels, (JobLabels{{"a", "b"}}));
  request.mutable_job()->clear_note();
  EXPECT_FALSE(ToRemark(request).value().note);
  request.mutable_update_mask()->add_paths("*");
  EXPECT_EQ(ToRemark(request).value().note, "");
}

TEST(ToRemark, TakesNotesUpToTheirLimit) {
  std::string longest;
  for (int i = 0; i < 1000; ++i) longest += i % 50 == 49 ? "\n" : "ε";
  EXPECT_TRUE(ToRemark(NoteOf(longest)).ok());
  for (const std::string& note : {longest + "x", std::string("\033[2J"), std::string("a\rb"),
                                  std::string("a\0b", 3), std::string("\xe2\x80\xae")}) {
    EXPECT_THAT(Fields(ToRemark(NoteOf(note)).error().violations), ElementsAre("note"));
  }
}

TEST(ToRemark, NamesAllViolationsAtOnce) {
  v1::UpdateJobRequest request = NoteOf("\a", "*");
  (*request.mutable_job()->mutable_labels())["a b"] = "";
  request.mutable_update_mask()->add_paths("state");
  EXPECT_THAT(Fields(ToRemark(request).error().violations),
              ElementsAre("update_mask", "labels[a b]", "note"));
  EXPECT_THAT(Fields(ToRemark({}).error().violations), ElementsAre("update_mask"));
}

TEST(ToQuery, HasDefaultsAndLimits) {
  v1::ListJobsRequest request;
  EXPECT_EQ(ToQuery(request).value().limit, 50);
  EXPECT_EQ(ToQuery(request).value().before, 0);
  request.set_page_size(1000);
  EXPECT_EQ(ToQuery(request).value().limit, 1000);
  for (const int size : {-1, 1001}) {
    request.set_page_size(size);
    const auto query = ToQuery(request);
    ASSERT_FALSE(query.ok());
    EXPECT_EQ(query.error().reason, "FIELD_INVALID");
    EXPECT_THAT(Fields(query.error().violations), ElementsAre("page_size"));
  }
}

TEST(ToQuery, BeginsWhereTheTokenSays) {
  EXPECT_EQ(ToQuery({}, 42).value().before, 42);
  const auto query = ToQuery({}, -1);
  ASSERT_FALSE(query.ok());
  EXPECT_EQ(query.error().reason, "FIELD_INVALID");
  EXPECT_THAT(Fields(query.error().violations), ElementsAre("page_token"));
}

TEST(ToQuery, NamesAllViolationsAtOnce) {
  v1::ListJobsRequest request;
  request.set_page_size(-1);
  request.add_states(static_cast<v1::Job::State>(77));
  request.set_name_prefix(std::string(65, 'j'));
  (*request.mutable_labels())[""] = "";
  EXPECT_THAT(Fields(ToQuery(request, -1).error().violations),
              ElementsAre("page_size", "page_token", "states", "name_prefix", "labels[]"));
}

v1::WatchJobRequest Watching(const std::vector<std::string>& kinds) {
  v1::WatchJobRequest request;
  request.mutable_kinds()->Add(kinds.begin(), kinds.end());
  return request;
}

TEST(WatchRules, KindsAlwaysHoldTheState) {
  EXPECT_EQ(ToRules(Watching({})).value().kinds, ~0U);
  EXPECT_EQ(ToRules(Watching({"cycle"})).value().kinds,
            KindBit(v1::Event::kCycle) | KindBit(v1::Event::kStateChanged));
}

TEST(WatchRules, RefuseWhatIsNoKind) {
  for (const auto* kind : {"cycles", "sequence", "event_time", ""}) {
    EXPECT_FALSE(ToRules(Watching({kind})).ok()) << kind;
  }
}

TEST(WatchRules, DefaultsAreThoseOfTheContract) {
  const WatchRules rules = ToRules(v1::WatchJobRequest()).value();
  EXPECT_EQ(rules.bookmark_interval, std::chrono::seconds(10));
  EXPECT_EQ(rules.delivery.min_frame_interval, std::chrono::seconds(0));
  EXPECT_EQ(rules.delivery.overflow, v1::DeliveryOptions::CONFLATE);
}

TEST(WatchRules, EveryBrokenOneIsTold) {
  v1::WatchJobRequest request = Watching({"cycles"});
  request.mutable_bookmark_interval()->set_nanos(999'999'999);
  request.mutable_delivery()->mutable_min_frame_interval()->set_seconds(3601);
  request.mutable_delivery()->set_overflow(static_cast<v1::DeliveryOptions::OverflowPolicy>(9));
  request.set_after_sequence(1);
  request.set_live_only(true);
  EXPECT_THAT(Fields(ToRules(request).error().violations),
              ElementsAre("kinds", "bookmark_interval", "delivery.min_frame_interval",
                          "delivery.overflow", "live_only"));
}

TEST(WatchRules, FilterOfJobsIsCheckedLikeThatOfAList) {
  v1::WatchJobsRequest request;
  request.add_states(static_cast<v1::Job::State>(77));
  EXPECT_EQ(ToRules(request).error().reason, "FIELD_INVALID");
}

}  // namespace
}  // namespace contact
