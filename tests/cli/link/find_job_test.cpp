#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "cli/base/failure.h"
#include "cli/link/jobs.h"
#include "cli/verbs/verb_case.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;

class FindJobTest : public testing::Test {
 protected:
  std::string Find(const std::string& text) {
    Client client(server_.address(), std::chrono::seconds(10));
    return FindJob(client, text);
  }

  // The message of the failure with this code.
  std::string Refused(const std::string& text, ExitCode code) {
    try {
      ADD_FAILURE() << Find(text);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), code) << failure.what();
      return failure.what();
    }
    return "";
  }

  void Add(const std::string& id, const std::string& title = "") {
    server_.Add("jobs/" + id, v1::Job::SUCCEEDED).set_title(title);
  }

  std::size_t Asked() const { return server_.Asked<v1::ListJobsRequest>().size(); }

  ScriptedServer server_;
};

TEST_F(FindJobTest, WholeIdNeedsNoQuestion) {
  EXPECT_EQ(Find("eh0scma960"), "jobs/eh0scma960");
  EXPECT_EQ(Find("jobs/eh0scma960"), "jobs/eh0scma960");
  EXPECT_EQ(Asked(), 0U);
}

TEST_F(FindJobTest, BeginningNamesTheOnlyJobThatHasIt) {
  Add("eh0scma960");
  Add("ehz5s4t9pw");
  EXPECT_EQ(Find("eh0"), "jobs/eh0scma960");
  EXPECT_EQ(Find("jobs/ehz"), "jobs/ehz5s4t9pw");
  EXPECT_EQ(server_.Asked<v1::ListJobsRequest>().front().name_prefix(), "jobs/eh0");
}

TEST_F(FindJobTest, BeginningOfSeveralListsThem) {
  Add("eh0scma960", "Triple-ball chain");
  Add("ehz5s4t9pw");
  Add("a000000000");
  const std::string told = Refused("eh", ExitCode::kUsage);
  EXPECT_THAT(told, HasSubstr("several jobs begin with 'eh':\n"));
  EXPECT_THAT(told, HasSubstr("\n  eh0scma960  -  SUCCEEDED  Triple-ball chain\n"));
  EXPECT_THAT(told, testing::EndsWith("\n  ehz5s4t9pw  -  SUCCEEDED"));
  for (int i = 0; i < 10; ++i) Add("eh" + std::to_string(10000000 + i));
  EXPECT_THAT(Refused("eh", ExitCode::kUsage), testing::EndsWith("\n  … and more"));
}

TEST_F(FindJobTest, WholeNameWinsOverLongerOnes) {
  Add("ab");
  Add("abc");
  EXPECT_EQ(Find("ab"), "jobs/ab");
}

TEST_F(FindJobTest, TextThatNoIdBeginsWithIsLeftToTheServer) {
  Add("eh0scma960");
  EXPECT_EQ(Find("zz"), "jobs/zz");
  EXPECT_EQ(Find(""), "jobs/");
}

TEST_F(FindJobTest, LastIsTheNewestAndCountsBack) {
  for (const char* id : {"c000000000", "b000000000", "a000000000"}) Add(id);  // Newest first.
  EXPECT_EQ(Find("last"), "jobs/c000000000");
  EXPECT_EQ(Find("last~0"), "jobs/c000000000");
  EXPECT_EQ(Find("last~2"), "jobs/a000000000");
  EXPECT_EQ(Refused("last~3", ExitCode::kNotFound), "there is no last~3: the server has 3 jobs");
}

TEST_F(FindJobTest, LastOfNoJobsIsNotFound) {
  EXPECT_EQ(Refused("last", ExitCode::kNotFound), "the server has no jobs");
}

TEST_F(FindJobTest, CountThatIsNoneIsAMistake) {
  for (const char* text : {"last~", "last~x", "last~-1", "last~1000"}) {
    EXPECT_THAT(Refused(text, ExitCode::kUsage), HasSubstr("N of last~N is a whole number"));
  }
  EXPECT_EQ(Asked(), 0U);
}

}  // namespace
}  // namespace contact::cli
