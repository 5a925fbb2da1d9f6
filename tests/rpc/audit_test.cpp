// What the audit log says of calls, and what happens when it cannot be written.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "contact/v1/admin_service.grpc.pb.h"
#include "identity/audit_log.h"
#include "test_server.h"

namespace contact {
namespace {

class AuditTest : public testing::Test {
 protected:
  AuditTest() : audit_(OpenLog()), server_(OptionsWith(audit_)) {}

  std::shared_ptr<AuditLog> OpenLog() const {
    return std::get<std::unique_ptr<AuditLog>>(AuditLog::Open(file_));
  }
  static GrpcServerOptions OptionsWith(std::shared_ptr<AuditLog> audit) {
    GrpcServerOptions options;
    options.audit = std::move(audit);
    return options;
  }
  // `method code job` of each line.
  std::vector<std::string> Lines() {
    audit_->Flush();
    std::vector<std::string> lines;
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);) {
      const auto json = nlohmann::json::parse(line);
      const std::string method = json.at("method");
      lines.push_back(method.substr(method.rfind('/') + 1) + ' ' + std::string(json.at("code")) +
                      ' ' + json.value("job", "-"));
    }
    return lines;
  }
  grpc::Status Backup() {
    const auto stub = v1::AdminService::NewStub(server_.Connect());
    grpc::ClientContext context;
    const auto reader = stub->Backup(&context, {});
    v1::BackupChunk chunk;
    while (reader->Read(&chunk)) ++chunks_;
    return reader->Finish();
  }

  const TempDirectory folder_;
  const std::filesystem::path file_ = folder_.path() / "audit.log";
  const std::shared_ptr<AuditLog> audit_;
  TestServer server_;
  int chunks_ = 0;
};

TEST_F(AuditTest, ChangesHaveALineAndReadsHaveNone) {
  const std::string name = server_.Create(Collision());
  for (int i = 0; i < 3; ++i) {
    grpc::ClientContext context;
    v1::Job job;
    v1::GetJobRequest request;
    request.set_name(name);
    EXPECT_TRUE(server_.stub().GetJob(&context, request, &job).ok());
  }
  grpc::ClientContext context;
  google::protobuf::Empty empty;
  v1::DeleteJobRequest request;
  request.set_name("jobs/none");
  EXPECT_FALSE(server_.stub().DeleteJob(&context, request, &empty).ok());
  EXPECT_TRUE(Backup().ok());
  EXPECT_EQ(Lines(),
            (std::vector<std::string>{"CreateJob OK " + name, "DeleteJob NOT_FOUND jobs/none",
                                      "Backup STARTED -"}));
}

TEST_F(AuditTest, BackupThatCannotBeWrittenDownDoesNotBegin) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit full = {0, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const grpc::Status refused = Backup();
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(Reason(refused), "AUDIT_FAILED");
  EXPECT_EQ(chunks_, 0);
  EXPECT_TRUE(Backup().ok()) << "once there is space";
  EXPECT_GT(chunks_, 0);
}

}  // namespace
}  // namespace contact
