#include "identity/audit_log.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "identity/audit_chain.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

class AuditLogTest : public testing::Test {
 protected:
  std::unique_ptr<AuditLog> Open(std::int64_t max_bytes = 0) {
    auto log = AuditLog::Open(file_, max_bytes);
    if (const auto* why = std::get_if<std::string>(&log)) ADD_FAILURE() << *why;
    return std::get<std::unique_ptr<AuditLog>>(std::move(log));
  }
  static AuditRecord RecordOf(const std::string& job, bool known = true) {
    AuditRecord record;
    record.time = std::chrono::system_clock::from_time_t(1'800'000'000);
    record.call = "c1";
    if (known) record.caller = Principal{"ci", "acme", {Role::kRead}, "token", "id7"};
    record.peer = "ipv4:127.0.0.1:4711";
    record.method = "/contact.v1.JobService/DeleteJob";
    record.job = job;
    record.code = "OK";
    record.duration = std::chrono::microseconds(1500);
    return record;
  }
  static bool WriteDurably(AuditLog& log) {
    std::promise<bool> written;
    log.WriteDurably(RecordOf("jobs/a"), [&written](bool good) { written.set_value(good); });
    return written.get_future().get();
  }
  std::vector<std::string> Lines() const {
    std::ifstream in(file_);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  void Rewrite(const std::vector<std::string>& lines) const {
    std::ofstream out(file_, std::ios::trunc);
    for (const std::string& line : lines) out << line << '\n';
  }
  void WriteJobs(int count, std::int64_t max_bytes = 0) {
    const auto log = Open(max_bytes);
    for (int i = 0; i < count; ++i) log->Write(RecordOf("jobs/" + std::to_string(i)));
    log->Flush();
  }

  const TempDirectory folder_;
  const std::filesystem::path file_ = folder_.path() / "audit.log";
};

TEST_F(AuditLogTest, LineSaysWhoDidWhat) {
  WriteJobs(1);
  const auto line = nlohmann::json::parse(Lines().at(0));
  const auto expected = nlohmann::json::parse(R"({
    "time": "2027-01-15T08:00:00.000Z", "call": "c1", "principal": "ci", "tenant": "acme",
    "how": "token", "token": "id7", "peer": "ipv4:127.0.0.1:4711",
    "method": "/contact.v1.JobService/DeleteJob", "job": "jobs/0", "code": "OK",
    "duration_us": 1500,
    "prev": "0000000000000000000000000000000000000000000000000000000000000000"})");
  EXPECT_EQ(line, expected);
  using std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(file_).permissions(), perms::owner_read | perms::owner_write);
}

TEST_F(AuditLogTest, ChainGoesOnAfterARestart) {
  WriteJobs(3);
  WriteJobs(2);
  const auto findings = VerifyAudit(file_);
  ASSERT_TRUE(findings);
  EXPECT_EQ(findings->lines, 5);
  EXPECT_EQ(findings->bad_line, 0) << findings->mistake;
}

TEST_F(AuditLogTest, EveryChangeOfALineIsFound) {
  WriteJobs(5);
  const std::vector<std::string> lines = Lines();
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    std::vector<std::string> changed = lines;
    changed[i].replace(changed[i].find("acme"), 4, "evil");
    Rewrite(changed);
    EXPECT_EQ(VerifyAudit(file_)->bad_line, static_cast<std::int64_t>(i) + 2);
    std::vector<std::string> shorter = lines;
    shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
    Rewrite(shorter);
    EXPECT_EQ(VerifyAudit(file_)->bad_line, static_cast<std::int64_t>(i) + 1);
  }
  Rewrite({lines[0], lines[1], lines[3], lines[2], lines[4]});
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 3);
  Rewrite({lines[0], lines[1], lines[2]});
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0) << "only the digest of the last line tells";
  EXPECT_NE(VerifyAudit(file_)->last, "");
}

TEST_F(AuditLogTest, UnfinishedLineIsCutOff) {
  WriteJobs(2);
  std::ofstream(file_, std::ios::app) << R"({"time": "20)";
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 3);
  WriteJobs(1);
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0);
  EXPECT_EQ(VerifyAudit(file_)->lines, 3);
}

TEST_F(AuditLogTest, UnknownCallersCannotFillTheDisk) {
  {
    const auto log = Open();
    AuditRecord refused = RecordOf("", false);
    refused.code = refused.reason = "UNAUTHENTICATED";
    for (int i = 0; i < 250; ++i) log->Write(refused);
    log->Write(RecordOf("jobs/a"));
    log->Flush();
  }
  const auto lines = Lines();
  ASSERT_EQ(lines.size(), 101U);
  EXPECT_EQ(nlohmann::json::parse(lines.back()).at("suppressed"), 150);
}

TEST_F(AuditLogTest, RefusalsOfOnePrincipalCannotFillTheDiskNorHideThoseOfOthers) {
  {
    const auto log = Open();
    AuditRecord refused = RecordOf("");
    for (const char* code : {"RESOURCE_EXHAUSTED", "PERMISSION_DENIED"}) {
      refused.code = refused.reason = code;
      for (int i = 0; i < 125; ++i) log->Write(refused);
    }
    refused.caller->name = "other";
    log->Write(refused);
    log->Flush();
  }
  EXPECT_EQ(Lines().size(), 101U);
  const auto last = nlohmann::json::parse(Lines().back());
  EXPECT_EQ(last.at("principal"), "other");
  EXPECT_EQ(last.at("suppressed"), 150);
}

TEST_F(AuditLogTest, TheHeadShowsLinesThatAreCutOffOrMadeAnew) {
  const auto head = folder_.path() / "head";
  const auto has_head = [&] { return VerifyAudit(file_, ReadHead(head))->has_head; };
  {
    auto opened = AuditLog::Open(file_, 0, head);
    auto& log = *std::get<std::unique_ptr<AuditLog>>(opened);
    for (int i = 0; i < 3; ++i) log.Write(RecordOf("jobs/" + std::to_string(i)));
    log.Flush();
  }
  EXPECT_EQ(ReadHead(head), VerifyAudit(file_)->last);
  EXPECT_TRUE(has_head());
  const auto lines = Lines();
  for (const std::size_t kept : {2U, 1U, 0U}) {
    Rewrite({lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(kept)});
    EXPECT_EQ(VerifyAudit(file_)->bad_line, 0) << "the chain alone does not show it";
    EXPECT_FALSE(has_head()) << kept;
  }
  WriteJobs(2);  // Without the third, in a chain that fits.
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0);
  EXPECT_FALSE(has_head());
}

class KeyedAuditLogTest : public AuditLogTest {
 protected:
  KeyedAuditLogTest() { WriteKey(std::string(32, 'k') + "\n", 0600); }

  void WriteKey(const std::string& text, mode_t mode) const {
    std::ofstream(key_file_, std::ios::trunc) << text;
    ::chmod(key_file_.c_str(), mode);
  }
  auto OpenKeyed() const { return AuditLog::Open({.file = file_, .key_file = key_file_}); }
  void WriteKeyed(int count) const {
    auto opened = OpenKeyed();
    auto& log = *std::get<std::unique_ptr<AuditLog>>(opened);
    for (int i = 0; i < count; ++i) log.Write(RecordOf("jobs/" + std::to_string(i)));
    log.Flush();
  }
  std::int64_t BadLine(const std::string& key) const {
    return VerifyAudit(file_, "", key)->bad_line;
  }

  const std::filesystem::path key_file_ = folder_.path() / "key";
  const std::string key_ = std::string(32, 'k');
};

TEST_F(KeyedAuditLogTest, ChainNeedsItsKey) {
  WriteKeyed(2);
  WriteKeyed(2);  // It goes on after a restart.
  EXPECT_EQ(BadLine(key_), 0);
  EXPECT_EQ(BadLine(""), 2);
  EXPECT_EQ(BadLine(std::string(32, 'x')), 2);
}

TEST_F(KeyedAuditLogTest, ChainThatIsMadeAnewWithoutTheKeyIsFound) {
  WriteKeyed(3);
  std::vector<std::string> lines = Lines();
  std::filesystem::remove(file_);
  WriteJobs(3);
  EXPECT_EQ(BadLine(""), 0) << "by itself it is whole";
  EXPECT_EQ(BadLine(key_), 2);
  lines[1].replace(lines[1].find("acme"), 4, "evil");
  Rewrite(lines);
  EXPECT_EQ(BadLine(key_), 3);
}

TEST_F(KeyedAuditLogTest, KeyThatOthersMayReadOrThatIsShortIsRefused) {
  WriteKey(key_, 0604);
  EXPECT_TRUE(std::holds_alternative<std::string>(OpenKeyed()));
  WriteKey(" " + std::string(31, 'k') + "\n", 0600);
  EXPECT_TRUE(std::holds_alternative<std::string>(OpenKeyed()));
  std::filesystem::remove(key_file_);
  EXPECT_TRUE(std::holds_alternative<std::string>(OpenKeyed()));
  EXPECT_FALSE(std::filesystem::exists(file_)) << "no line is written without the key";
}

constexpr std::int64_t kThreeLines = 1200;

TEST_F(AuditLogTest, ChainGoesThroughAllFilesAlsoAfterARestart) {
  WriteJobs(10, kThreeLines);
  const auto files = AuditFiles(file_);
  ASSERT_GT(files.size(), 3U);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_LE(std::filesystem::file_size(files[i].path), kThreeLines);
    EXPECT_EQ(files[i].number, i + 1 < files.size() ? static_cast<int>(i) + 1 : 0);
  }
  WriteJobs(10, kThreeLines);
  auto findings = VerifyAudit(file_);
  EXPECT_EQ(findings->bad_line, 0) << findings->mistake;
  EXPECT_EQ(findings->lines, 20);
  std::filesystem::remove(file_);  // A crash between the two renames leaves this.
  const std::int64_t left = VerifyAudit(file_)->lines;
  WriteJobs(1, kThreeLines);
  findings = VerifyAudit(file_);
  EXPECT_EQ(findings->bad_line, 0) << findings->mistake;
  EXPECT_EQ(findings->lines, left + 1);
}

TEST_F(AuditLogTest, FileThatIsMissingOrOutOfOrderIsFound) {
  WriteJobs(12, kThreeLines);
  const auto numbered = [this](int number) {
    return std::filesystem::path(file_.string() + '.' + std::to_string(number));
  };
  const auto aside = folder_.path() / "aside";
  std::filesystem::rename(numbered(2), aside);
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 1);
  EXPECT_EQ(VerifyAudit(file_)->bad_file, numbered(3));
  std::filesystem::rename(numbered(1), numbered(2));
  EXPECT_EQ(VerifyAudit(file_)->bad_file, numbered(3));
  std::filesystem::remove(numbered(2));
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0) << "old files may be kept elsewhere";
  EXPECT_EQ(VerifyAudit(file_)->missing, 2);
}

TEST_F(AuditLogTest, LogGoesOnInItsFileWhereNoOtherCanBeBegun) {
  const auto log = Open(kThreeLines);
  EXPECT_TRUE(WriteDurably(*log));
  std::filesystem::create_directories(file_.string() + ".new/x");
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(WriteDurably(*log));
  EXPECT_EQ(VerifyAudit(file_)->files, 1);
  EXPECT_EQ(VerifyAudit(file_)->lines, 10);
  std::filesystem::remove_all(file_.string() + ".new");
  EXPECT_TRUE(WriteDurably(*log));
  EXPECT_EQ(VerifyAudit(file_)->files, 2);
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0);
}

TEST_F(AuditLogTest, WhatCannotBeWrittenIsTold) {
  const auto log = Open();
  EXPECT_TRUE(WriteDurably(*log));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit full = {600, limit.rlim_max};  // One line fits, the second does not.
  setrlimit(RLIMIT_FSIZE, &full);
  EXPECT_FALSE(WriteDurably(*log));
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_TRUE(WriteDurably(*log));
  EXPECT_EQ(nlohmann::json::parse(Lines().back()).at("lost"), 1);
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0);
  EXPECT_EQ(VerifyAudit(file_)->lines, 2);
  EXPECT_TRUE(std::holds_alternative<std::string>(AuditLog::Open("/dev/null")));
  EXPECT_TRUE(std::holds_alternative<std::string>(AuditLog::Open(folder_.path() / "no/audit.log")));
}

TEST_F(AuditLogTest, StrangeNamesStayOneLine) {
  const auto log = Open();
  log->Write(RecordOf("jobs/\n\x1b]0;x\x07\xff\xfe\""));
  log->Flush();
  ASSERT_EQ(Lines().size(), 1U);
  EXPECT_EQ(VerifyAudit(file_)->bad_line, 0);
}

}  // namespace
}  // namespace contact
