// What verbs ask of the server, and what they make of its answers: the server is scripted.

#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/verbs/verb_case.h"
#include "contact/v1/event.pb.h"
#include "version.h"

namespace contact::cli {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Pair;
using testing::UnorderedElementsAre;

class VerbRequestsTest : public testing::Test {
 protected:
  End Run(const std::vector<std::string>& words) { return EndOf(words, server_.address()); }

  // The one request of this type that a command line leads to.
  template <class Request>
  Request Asked(const std::vector<std::string>& words) {
    const End end = Run(words);
    EXPECT_EQ(end.told, "");
    const auto asked = server_.Asked<Request>();
    EXPECT_EQ(asked.size(), 1U);
    return asked.empty() ? Request() : asked.back();
  }

  void AddJobs(int count) {
    for (int i = 0; i < count; ++i) server_.Add("jobs/" + std::to_string(i), v1::Job::SUCCEEDED);
  }

  ScriptedServer server_;
};

TEST_F(VerbRequestsTest, ListAsksForNoMoreThanItsLimit) {
  AddJobs(7);
  server_.page = 3;
  const End end = Run({"list", "--limit", "5", "-o", "name"});
  EXPECT_THAT(Lines(end.printed), ElementsAre("jobs/0", "jobs/1", "jobs/2", "jobs/3", "jobs/4"));
  const auto asked = server_.Asked<v1::ListJobsRequest>();
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0].page_size(), 5);
  EXPECT_EQ(asked[1].page_size(), 2);
  EXPECT_EQ(asked[1].page_token(), "3");
  EXPECT_THAT(Run({"list", "--limit", "5"}).said, HasSubstr("--all lists them"));
}

TEST_F(VerbRequestsTest, ListWithoutLimitTakesEveryPage) {
  AddJobs(7);
  server_.page = 3;
  const End end = Run({"list", "--all", "-o", "name"});
  EXPECT_EQ(Lines(end.printed).size(), 7U);
  EXPECT_EQ(server_.Asked<v1::ListJobsRequest>().size(), 3U);
  EXPECT_EQ(Run({"list", "--all"}).said, "");
}

TEST_F(VerbRequestsTest, FilterOfListIsTheServers) {
  const auto asked = Asked<v1::ListJobsRequest>(
      {"list", "--state", "running", "--state", "FAILED", "--label", "a=b=c", "--label", "n=1"});
  EXPECT_THAT(asked.states(), ElementsAre(v1::Job::RUNNING, v1::Job::FAILED));
  EXPECT_THAT(asked.labels(), UnorderedElementsAre(Pair("a", "b=c"), Pair("n", "1")));
}

TEST_F(VerbRequestsTest, EachFormatOfListHasEveryJob) {
  AddJobs(3);
  (*server_.Add("jobs/x", v1::Job::FAILED).mutable_labels())["law"] = "flores";
  EXPECT_EQ(json::parse(Run({"list", "-o", "json"}).printed)["jobs"].size(), 4U);
  const std::vector<std::string> objects = Lines(Run({"list", "-o", "jsonl"}).printed);
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(json::parse(objects[3])["labels"]["law"], "flores");
  const std::vector<std::string> rows = Lines(Run({"list", "-o", "csv"}).printed);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_THAT(rows[0], testing::StartsWith("job,state,title,kind,reason,convergence,missed,"));
  EXPECT_THAT(rows[4], HasSubstr("law=flores"));
}

TEST_F(VerbRequestsTest, ListTellsTitleAndMissedCycles) {
  v1::Job& job = server_.Add("jobs/a", v1::Job::SUCCEEDED);
  job.set_title("A title that is longer than forty characters are");
  job.set_convergence(v1::Job::PARTIAL);
  job.mutable_summary()->set_cycles(249);
  job.mutable_summary()->set_cycles_infeasible(3);
  EXPECT_THAT(
      Lines(Run({"list"}).printed).back(),
      MatchesRegex("a +SUCCEEDED  A title that is longer than forty chara…  scenario  - +PARTIAL "
                   "+3 .*"));
  EXPECT_THAT(Run({"list", "-o", "csv", "--columns", "title,missed"}).printed,
              "title,missed\nA title that is longer than forty characters are,3\n");
  EXPECT_EQ(json::parse(Run({"list", "-o", "json"}).printed)["jobs"][0]["title"], job.title());
}

TEST_F(VerbRequestsTest, DescribeShowsTheCyclesThatMissWhereAskedTo) {
  v1::Job& job = server_.Add("jobs/a", v1::Job::SUCCEEDED);
  for (const char* contact : {"A-B", "B-C"}) job.add_cycles()->set_contact(contact);
  job.mutable_cycles(0)->set_status(v1::Cycle::CONVERGED);
  job.mutable_cycles(1)->set_status(v1::Cycle::NOT_CONVERGED);
  const std::string printed = Run({"describe", "a", "--only-missed"}).printed;
  EXPECT_THAT(printed, HasSubstr("\nB-C "));
  EXPECT_THAT(printed, testing::Not(HasSubstr("A-B")));
  EXPECT_THAT(Run({"describe", "a"}).printed, HasSubstr("\nA-B "));
  EXPECT_EQ(Run({"describe", "a", "--only-missed", "-o", "json"}).code, ExitCode::kUsage);
}

TEST_F(VerbRequestsTest, DescribeSaysSoIfNoCycleMisses) {
  server_.Add("jobs/a", v1::Job::SUCCEEDED).add_cycles()->set_status(v1::Cycle::CONVERGED);
  EXPECT_EQ(Run({"describe", "a", "--only-missed"}).said, "no cycle misses its restitution\n");
}

TEST_F(VerbRequestsTest, EachVerbTakesTheFirstLettersOfAJob) {
  v1::Job& job = server_.Add("jobs/eh0scma960", v1::Job::SUCCEEDED);
  job.set_convergence(v1::Job::FULL);
  server_.Add("jobs/m8qd61c0va", v1::Job::SUCCEEDED);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"describe", "eh"},
                                                {"watch", "eh"},
                                                {"wait", "eh"},
                                                {"cancel", "eh"},
                                                {"label", "eh", "n=1"},
                                                {"delete", "eh"},
                                                {"series", "eh"},
                                                {"artifact", "list", "eh"},
                                                {"export", "eh", "-o", "csv", "--table", "cycles"},
                                                {"compare", "eh", "last~1"}}) {
    const End end = Run(words);
    EXPECT_EQ(end.told, "") << words.front();
    EXPECT_NE(end.code, ExitCode::kNotFound) << words.front();
  }
  for (const auto& request : server_.Asked<v1::GetJobRequest>()) {
    EXPECT_THAT(request.name(), testing::AnyOf("jobs/eh0scma960", "jobs/m8qd61c0va"));
  }
  EXPECT_EQ(server_.Asked<v1::DeleteJobRequest>().front().name(), "jobs/eh0scma960");
  EXPECT_EQ(server_.Asked<v1::GetSeriesRequest>().front().name(), "jobs/eh0scma960");
}

TEST_F(VerbRequestsTest, CancelTellsWhetherTheJobStillRuns) {
  server_.Add("jobs/a", v1::Job::RUNNING);
  server_.Add("jobs/b", v1::Job::CANCELLED);
  EXPECT_EQ(Run({"cancel", "a"}).printed, "jobs/a  asked to stop\n");
  EXPECT_EQ(Run({"cancel", "jobs/b"}).printed, "jobs/b  CANCELLED\n");
  EXPECT_EQ(Run({"cancel", "a", "-o", "name"}).printed, "jobs/a\n");
}

TEST_F(VerbRequestsTest, LabelChangesThoseThatItNamesAndKeepsTheOthers) {
  v1::Job& a = server_.Add("jobs/a", v1::Job::RUNNING);
  a.set_uid("of a");
  for (const auto& [key, value] : {std::pair("law", "x"), {"n", "1"}, {"trial", ""}}) {
    (*a.mutable_labels())[key] = value;
  }
  server_.Add("jobs/b", v1::Job::SUCCEEDED);
  EXPECT_EQ(Run({"label", "a", "b", "law=y=z", "trial-"}).printed,
            "jobs/a  law=y=z, n=1\njobs/b  law=y=z\n");
  const auto asked = server_.Asked<v1::UpdateJobRequest>();
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_THAT(asked[0].update_mask().paths(), ElementsAre("labels"));
  EXPECT_EQ(asked[0].expected_uid(), "of a");
  EXPECT_EQ(Run({"label", "a", "law-", "n-", "trial-"}).printed, "jobs/a  no labels\n");
  EXPECT_EQ(Run({"label", "a", "b", "c", "n=2"}).code, ExitCode::kNotFound);
  EXPECT_EQ(server_.Asked<v1::UpdateJobRequest>().size(), 3U) << "none, as one is not there";
}

TEST_F(VerbRequestsTest, NoteReplacesTheNoteAlone) {
  server_.Add("jobs/a", v1::Job::SUCCEEDED);
  const auto asked = Asked<v1::UpdateJobRequest>({"label", "a", "--note", "two\nlines"});
  EXPECT_THAT(asked.update_mask().paths(), ElementsAre("note"));
  EXPECT_EQ(asked.job().note(), "two\nlines");
  EXPECT_EQ(Run({"label", "a", "-o", "name", "--note", ""}).printed, "jobs/a\n");
  EXPECT_THAT(server_.Asked<v1::UpdateJobRequest>().back().update_mask().paths(),
              ElementsAre("note"));
}

TEST_F(VerbRequestsTest, DescribeShowsLabelsAndEachLineOfTheNote) {
  v1::Job& job = server_.Add("jobs/a", v1::Job::SUCCEEDED);
  job.set_note("good\n\nbut \033[2J");
  (*job.mutable_labels())["law"] = "x";
  EXPECT_THAT(Run({"describe", "a"}).printed,
              HasSubstr("labels: law=x\nnote: good\n      \n      but ?[2J\n"));
}

TEST_F(VerbRequestsTest, DeleteNamesTheJobInFull) {
  EXPECT_EQ(Asked<v1::DeleteJobRequest>({"delete", "a"}).name(), "jobs/a");
  EXPECT_EQ(Run({"delete", "a"}).printed, "jobs/a  deleted\n");
  EXPECT_EQ(Run({"delete", "a", "-o", "name"}).printed, "jobs/a\n");
}

TEST_F(VerbRequestsTest, ExitCodeOfWaitIsThatOfTheJob) {
  server_.Add("jobs/full", v1::Job::SUCCEEDED).set_convergence(v1::Job::FULL);
  server_.Add("jobs/part", v1::Job::SUCCEEDED).set_convergence(v1::Job::PARTIAL);
  server_.Add("jobs/failed", v1::Job::FAILED);
  server_.Add("jobs/cancelled", v1::Job::CANCELLED);
  EXPECT_EQ(Run({"wait", "full"}).code, ExitCode::kOk);
  EXPECT_EQ(Run({"wait", "part"}).code, ExitCode::kNotConverged);
  EXPECT_EQ(Run({"wait", "failed"}).code, ExitCode::kRunFailed);
  const End cancelled = Run({"wait", "cancelled"});
  EXPECT_EQ(cancelled.code, ExitCode::kRunFailed);
  EXPECT_EQ(cancelled.printed, "jobs/cancelled  CANCELLED\n");
  EXPECT_EQ(Run({"wait", "nobody"}).code, ExitCode::kNotFound);
  EXPECT_THAT(server_.Asked<v1::WatchJobRequest>().front().kinds(), ElementsAre("state_changed"));
}

TEST_F(VerbRequestsTest, WatchAsksForTheKindsThatItShows) {
  server_.Add("jobs/a", v1::Job::SUCCEEDED);
  Run({"watch", "a"});
  Run({"watch", "a", "-o", "jsonl"});
  Run({"watch", "a", "--kinds", "cycle,iteration", "--after-sequence", "0"});
  Run({"watch", "a", "--live", "--min-frame-interval", "250ms"});
  const auto asked = server_.Asked<v1::WatchJobRequest>();
  ASSERT_EQ(asked.size(), 4U);
  EXPECT_THAT(asked[0].kinds(), ElementsAre("log_entry", "iteration", "group_growth", "cycle",
                                            "group", "attempt_started", "progress"));
  EXPECT_TRUE(asked[1].kinds().empty());
  EXPECT_THAT(asked[2].kinds(), ElementsAre("cycle", "iteration"));
  EXPECT_FALSE(asked[2].live_only());
  EXPECT_TRUE(asked[3].live_only());
  EXPECT_EQ(asked[3].delivery().min_frame_interval().nanos(), 250'000'000);
}

TEST_F(VerbRequestsTest, WatchPrintsAnObjectForEachEvent) {
  server_.Add("jobs/a", v1::Job::SUCCEEDED);
  for (int i = 1; i <= 3; ++i) server_.events.emplace_back().mutable_cycle()->set_number(i);
  const std::vector<std::string> lines = Lines(Run({"watch", "a", "-o", "jsonl"}).printed);
  ASSERT_EQ(lines.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(json::parse(lines[static_cast<std::size_t>(i)])["cycle"]["number"], i + 1);
  }
  EXPECT_EQ(json::parse(lines[3])["state_changed"]["state"], "SUCCEEDED");
}

TEST_F(VerbRequestsTest, SeriesIsThinnedUnlessItIsRaw) {
  AddJobs(1);
  const auto some =
      Asked<v1::GetSeriesRequest>({"series", "0", "--channel", "B1.velocity", "--channel",
                                   "B2.velocity", "--from", "0", "--points", "10"});
  EXPECT_EQ(some.name(), "jobs/0");
  EXPECT_THAT(some.channels(), ElementsAre("B1.velocity", "B2.velocity"));
  EXPECT_TRUE(some.has_start_time_s());
  EXPECT_FALSE(some.has_end_time_s());
  EXPECT_EQ(some.max_points(), 10);
  EXPECT_EQ(some.decimation(), v1::GetSeriesRequest::MINMAX);
  Run({"series", "0", "--raw", "--to", "1e-3"});
  const v1::GetSeriesRequest raw = server_.Asked<v1::GetSeriesRequest>().back();
  EXPECT_EQ(raw.decimation(), v1::GetSeriesRequest::RAW);
  EXPECT_DOUBLE_EQ(raw.end_time_s(), 1e-3);
  EXPECT_EQ(raw.max_points(), 0);
}

TEST_F(VerbRequestsTest, ArtifactsAreNamed) {
  v1::Artifact& artifact = *server_.Add("jobs/a", v1::Job::SUCCEEDED).add_artifacts();
  artifact.set_name("trajectory.csv");
  artifact.set_size_bytes(12);
  EXPECT_EQ(Run({"artifact", "list", "a"}).printed, "trajectory.csv\n");
  const json object = json::parse(Run({"artifact", "list", "a", "-o", "jsonl"}).printed);
  EXPECT_EQ(object["size_bytes"], 12);
}

TEST_F(VerbRequestsTest, FlagsOfASubmissionAreItsJob) {
  const auto asked = Asked<v1::CreateJobRequest>(
      {"submit", "-t", "two-balls", "--label", "a=b", "--request-id", "r", "--priority", "7",
       "--budget-steps", "1e6", "--set", "title=T", "-o", "name"});
  EXPECT_EQ(asked.request_id(), "r");
  EXPECT_THAT(asked.job().labels(), UnorderedElementsAre(Pair("a", "b")));
  EXPECT_EQ(asked.job().priority(), 7);
  EXPECT_EQ(asked.job().budget().steps(), 1'000'000);
  EXPECT_EQ(asked.job().scenario().title(), "T");
  EXPECT_FALSE(asked.validate_only());
}

TEST_F(VerbRequestsTest, RequestIdIsRandomUnlessItIsGiven) {
  for (int i = 0; i < 3; ++i) Run({"submit", "-t", "two-balls"});
  std::set<std::string> ids;
  for (const auto& asked : server_.Asked<v1::CreateJobRequest>()) {
    EXPECT_THAT(asked.request_id(), MatchesRegex("[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}"));
    ids.insert(asked.request_id());
  }
  EXPECT_EQ(ids.size(), 3U);
}

TEST_F(VerbRequestsTest, RunShowsTheResultAndSubmitDoesNotWait) {
  const End run = Run({"run", "-t", "two-balls"});
  EXPECT_EQ(run.code, ExitCode::kOk);
  EXPECT_THAT(run.printed, HasSubstr("jobs/new  SUCCEEDED"));
  EXPECT_THAT(run.said, testing::StartsWith("jobs/new submitted\n"));
  EXPECT_THAT(run.said, HasSubstr("Next:  contactctl watch new "));
  const std::size_t watches = server_.Asked<v1::WatchJobRequest>().size();
  const End submit = Run({"submit", "-t", "two-balls"});
  EXPECT_THAT(submit.printed, HasSubstr("QUEUED"));
  EXPECT_EQ(submit.said, "Next:  contactctl watch new2\n");
  EXPECT_EQ(server_.Asked<v1::WatchJobRequest>().size(), watches);
}

TEST_F(VerbRequestsTest, RowsOfTheIterationAreAskedForIfTheyAreShown) {
  for (const char* rows : {"first", "all", "none"}) {
    Run({"run", "-t", "two-balls", "--iterations", rows});
  }
  Run({"run", "-t", "two-balls", "-o", "json"});
  const auto asked = server_.Asked<v1::WatchJobRequest>();
  ASSERT_EQ(asked.size(), 4U);
  const std::vector<std::string> words = {"progress", "log_entry", "attempt_started"};
  EXPECT_THAT(asked[0].kinds(), testing::Contains("iteration"));
  EXPECT_THAT(asked[1].kinds(), testing::Contains("iteration"));
  EXPECT_THAT(asked[2].kinds(), testing::ElementsAreArray(words));
  EXPECT_THAT(asked[3].kinds(), ElementsAre("progress"));
}

TEST_F(VerbRequestsTest, ManyRowsOfTheIterationEndInAHint) {
  v1::Event event;
  event.mutable_iteration()->add_unknowns()->set_contact("A-B");
  server_.events.assign(70, event);
  const auto rows = [](const std::string& said) {
    const std::vector<std::string> lines = Lines(said);
    return std::ranges::count_if(
        lines, [](const auto& line) { return line.find("A-B") != std::string::npos; });
  };
  const End first = Run({"run", "-t", "two-balls"});
  EXPECT_EQ(rows(first.said), 60);
  EXPECT_THAT(first.said, HasSubstr("… more iterations; contactctl watch new shows all"));
  EXPECT_EQ(rows(Run({"run", "-t", "two-balls", "--iterations", "all"}).said), 70);
}

TEST_F(VerbRequestsTest, LikeRepeatsTheScenarioOfAJobWithItsChanges) {
  server_.info.set_version("1.0.0");
  v1::Job& job = server_.Add("jobs/a", v1::Job::SUCCEEDED);
  job.set_server_version("0.9.0");
  v1::Body& body = *job.mutable_scenario()->add_bodies();
  body.set_name("A");
  body.set_mass_kg(2);
  job.mutable_scenario()->set_end_time_s(1);
  const End end = Run({"submit", "--like", "a", "--set", "bodies[0].mass_kg=3"});
  EXPECT_THAT(end.said, HasSubstr("jobs/a was made by contactd 0.9.0 , this one is 1.0.0 : last "
                                  "digits may differ"));
  const auto asked = server_.Asked<v1::CreateJobRequest>();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_DOUBLE_EQ(asked[0].job().scenario().bodies(0).mass_kg(), 3);
  EXPECT_DOUBLE_EQ(asked[0].job().scenario().end_time_s(), 1);
}

TEST_F(VerbRequestsTest, SubmitTakesSweepsOfTemplatesAndJobs) {
  v1::Sweep& sweep = *server_.Add("jobs/s", v1::Job::SUCCEEDED).mutable_sweep();
  sweep.add_metrics("iterations");
  const End end = Run({"submit", "-t", "table-3-sweep", "-o", "name"});
  EXPECT_EQ(end.code, ExitCode::kOk) << end.told;
  EXPECT_THAT(end.printed, testing::StartsWith("jobs/"));
  Run({"submit", "--like", "s"});
  const auto asked = server_.Asked<v1::CreateJobRequest>();
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0].job().sweep().axes_size(), 2);
  EXPECT_EQ(asked[0].job().sweep().base().bodies_size(), 3);
  EXPECT_EQ(asked[1].job().sweep().metrics(0), "iterations");
  EXPECT_EQ(Run({"submit", "--like", "s", "--var", "a=1"}).code, ExitCode::kUsage);
}

TEST_F(VerbRequestsTest, SweepIsNotRepeatedAsARun) {
  server_.Add("jobs/s", v1::Job::SUCCEEDED).mutable_sweep()->add_metrics("iterations");
  const End end = Run({"run", "--like", "s"});
  EXPECT_EQ(end.code, ExitCode::kUsage);
  EXPECT_EQ(end.told, "jobs/s is a sweep, not a run");
}

TEST_F(VerbRequestsTest, ValidationOnTheServerMakesNoJob) {
  server_.info.mutable_limits()->set_max_samples(1000);
  const auto asked = Asked<v1::CreateJobRequest>(
      {"validate", CONTACT_SOURCE_DIR "/client/scenarios/two-balls.yaml", "--on-server"});
  EXPECT_TRUE(asked.validate_only());
  EXPECT_EQ(asked.job().scenario().bodies_size(), 2);
}

TEST_F(VerbRequestsTest, StatusTellsVersionLoadAndLimits) {
  server_.info.set_version("1.2.3");
  server_.info.set_revision("abc");
  server_.info.set_workers(4);
  server_.info.set_running_jobs(2);
  server_.info.mutable_limits()->set_max_cells(77);
  const std::string printed = Run({"server", "status"}).printed;
  EXPECT_THAT(printed, HasSubstr("contactd 1.2.3 (abc) at " + server_.address()));
  EXPECT_THAT(printed, HasSubstr("workers   4\n"));
  EXPECT_THAT(printed, HasSubstr("2 running, 0 queued"));
  EXPECT_THAT(printed, HasSubstr("77 cells"));
  EXPECT_EQ(json::parse(Run({"server", "info", "-o", "json"}).printed)["workers"], 4);
}

TEST_F(VerbRequestsTest, OnlyAJobWithAResultIsCited) {
  server_.Add("jobs/waits", v1::Job::QUEUED);
  const End early = Run({"cite", "waits"});
  EXPECT_EQ(early.code, ExitCode::kUsage);
  EXPECT_EQ(early.told, "jobs/waits has no result to cite yet; see `contactctl wait`");
  server_.Add("jobs/done", v1::Job::SUCCEEDED).set_spec_sha256("0123");
  EXPECT_THAT(Run({"cite", "done"}).printed, HasSubstr("jobs/done, scenario SHA-256 0123}"));
}

// Finding `check` of contactctl doctor.
json Finding(const End& end, const std::string& check) {
  for (const json& finding : json::parse(end.printed)) {
    if (finding["check"] == check) return finding;
  }
  return {};
}

TEST_F(VerbRequestsTest, DoctorTakesAnyPatchOfTheSameVersion) {
  const std::string version = kVersion;
  server_.info.set_version(version.substr(0, version.rfind('.')) + ".99");
  EXPECT_TRUE(Finding(Run({"doctor", "-o", "json"}), "version")["ok"]);
  server_.info.set_version("99.0.0");
  const End end = Run({"doctor", "-o", "json"});
  EXPECT_FALSE(Finding(end, "version")["ok"]);
  EXPECT_EQ(Finding(end, "version")["fix"], "install the same version on both sides");
  EXPECT_NE(end.code, ExitCode::kOk);
}

TEST_F(VerbRequestsTest, DoctorTellsWhatKeepsLongRunsBusy) {
  server_.Add("jobs/quick", v1::Job::RUNNING);
  EXPECT_TRUE(Finding(Run({"doctor", "-o", "json"}), "busy").is_null());
  server_.Add("jobs/long", v1::Job::RUNNING).mutable_progress()->set_busy_with("a-b, λh 2e4");
  const json busy = Finding(Run({"doctor", "-o", "json"}), "busy");
  EXPECT_EQ(busy["found"], "jobs/long: a-b, λh 2e4");
  EXPECT_TRUE(busy["ok"]);
  EXPECT_THAT(server_.Asked<v1::ListJobsRequest>().back().states(), ElementsAre(v1::Job::RUNNING));
}

TEST_F(VerbRequestsTest, DoctorFindsAServerThatStartedInTheFuture) {
  server_.info.set_version(kVersion);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const auto now_s = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  server_.info.mutable_start_time()->set_seconds(now_s - 3600);
  EXPECT_TRUE(Finding(Run({"doctor", "-o", "json"}), "clock")["ok"]);
  server_.info.mutable_start_time()->set_seconds(now_s + 3600);
  const End end = Run({"doctor", "-o", "json"});
  EXPECT_FALSE(Finding(end, "clock")["ok"]);
  EXPECT_THAT(std::string(Finding(end, "clock")["found"]), HasSubstr("s in the future"));
}

}  // namespace
}  // namespace contact::cli
