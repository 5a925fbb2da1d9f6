#include "jobs/job/errors.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace contact {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using Pairs = std::set<std::pair<std::string, std::string>>;  // Reason and canonical code.

std::string TextOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What stands in the comments of a service as "`CODE` (REASON, REASON)".
void AddListed(const std::string& text, Pairs* listed) {
  static const std::regex kEntry(R"(`([A-Z_]+)` \(([A-Z_]+(?:,\s[A-Z_]+)*)\))");
  static const std::regex kName("[A-Z_]+");
  for (std::sregex_iterator entry(text.begin(), text.end(), kEntry), end; entry != end; ++entry) {
    const std::string names = (*entry)[2];
    for (std::sregex_iterator name(names.begin(), names.end(), kName); name != end; ++name) {
      listed->emplace(name->str(), (*entry)[1]);
    }
  }
}

Pairs InContract() {
  const fs::path folder = fs::path(CONTACT_SOURCE_DIR) / "proto/contact/v1";
  Pairs listed;
  AddListed(TextOf(folder / "job_service.proto"), &listed);
  AddListed(TextOf(folder / "model_service.proto"), &listed);
  AddListed(TextOf(folder / "admin_service.proto"), &listed);
  return listed;
}

Pairs InTable() {
  Pairs listed;
  for (const ReasonInfo& info : Reasons()) {
    listed.emplace(info.name, absl::StatusCodeToString(info.code));
  }
  return listed;
}

// How often each reason stands in quotes in the sources of the server.
std::map<std::string, int> CountInSources() {
  std::map<std::string, int> counts;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(CONTACT_SOURCE_DIR) / "server")) {
    const std::string ending = entry.path().extension();
    if (ending != ".cpp" && ending != ".h") continue;
    const std::string text = TextOf(entry.path());
    for (const ReasonInfo& info : Reasons()) {
      const std::string quoted = '"' + std::string(info.name) + '"';
      for (auto at = text.find(quoted); at != std::string::npos; at = text.find(quoted, at + 1)) {
        ++counts[info.name];
      }
    }
  }
  return counts;
}

TEST(ReasonsTest, AreThoseOfTheContractWithTheirCodes) { EXPECT_EQ(InTable(), InContract()); }

TEST(ReasonsTest, EachNameStandsOnceInTheServer) {
  const std::map<std::string, int> counts = CountInSources();
  EXPECT_EQ(counts.size(), Reasons().size());
  for (const auto& [name, count] : counts) EXPECT_EQ(count, 1) << name;
}

TEST(ReasonsTest, EachIsFoundByItsEnumerator) {
  for (const ReasonInfo& info : Reasons()) EXPECT_EQ(&InfoOf(info.reason), &info) << info.name;
}

TEST(MakeErrorTest, TakesCodeDelayAndWordsFromTheTable) {
  const Error error = MakeError(Reason::kServerDraining);
  EXPECT_EQ(error.code, absl::StatusCode::kUnavailable);
  EXPECT_EQ(error.reason, "SERVER_DRAINING");
  EXPECT_EQ(error.message, "the server is shutting down");
  EXPECT_GT(error.retry_after.count(), 0);
  EXPECT_EQ(MakeError(Reason::kServerDraining, "other words").message, "other words");
}

TEST(InvalidTest, ListsAllViolationsAndSpeaksOfTheFirst) {
  const Error error = Invalid({{"labels", "has 17", ""}}, {{"scenario.bodies", "is empty", ""}});
  EXPECT_EQ(error.reason, "SCENARIO_INVALID");
  EXPECT_EQ(error.message, "labels: has 17");
  EXPECT_EQ(error.violations.size(), 2U);
  EXPECT_EQ(Invalid({{"labels", "has 17", ""}}).reason, "FIELD_INVALID");
}

TEST(ToErrorTest, EveryStatusOfTheStoreHasAReasonOfItsOwnCode) {
  using enum absl::StatusCode;
  const std::map<absl::StatusCode, Reason> reasons = {
      {kNotFound, Reason::kJobNotFound},    {kAlreadyExists, Reason::kRequestIdReused},
      {kDataLoss, Reason::kDataLoss},       {kFailedPrecondition, Reason::kInvalidState},
      {kUnavailable, Reason::kStoreFailed}, {kResourceExhausted, Reason::kStoreFull},
  };
  for (const auto& [code, reason] : reasons) {
    const Error error = ToError(absl::Status(code, "words"), "jobs/a1");
    EXPECT_EQ(error.code, code);
    EXPECT_EQ(error.reason, InfoOf(reason).name);
    EXPECT_EQ(error.message, "words");
    EXPECT_EQ(error.metadata.at("name"), "jobs/a1");
  }
}

TEST(ToErrorTest, UnexpectedStatusIsAFailureOfTheStore) {
  const Error error = ToError(absl::InternalError("words"), "");
  EXPECT_EQ(error.reason, "STORE_FAILED");
  EXPECT_EQ(error.code, absl::StatusCode::kUnavailable);
  EXPECT_THAT(error.metadata, IsEmpty());
}

}  // namespace
}  // namespace contact
