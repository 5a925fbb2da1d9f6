// Every method of the contract has a row in the table of permissions, and the server obeys it.
#include "identity/permissions.h"

#include <google/protobuf/descriptor.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "contact/v1/admin_service.pb.h"
#include "contact/v1/model_service.pb.h"
#include "test_server.h"

namespace contact {
namespace {

using google::protobuf::MethodDescriptor;

// All methods of all services of the contract, as gRPC calls them.
std::vector<std::string> Methods() {
  std::vector<std::string> methods;
  for (const auto* file :
       {v1::CreateJobRequest::descriptor()->file(), v1::TranslateModelRequest::descriptor()->file(),
        v1::BackupRequest::descriptor()->file()}) {
    for (int i = 0; i < file->service_count(); ++i) {
      for (int k = 0; k < file->service(i)->method_count(); ++k) {
        const MethodDescriptor& method = *file->service(i)->method(k);
        methods.push_back("/" + method.service()->full_name() + "/" + method.name());
      }
    }
  }
  return methods;
}

// Calls any method with an empty request, and reads its stream until that says something.
grpc::Status Call(const std::shared_ptr<grpc::Channel>& channel, const std::string& method) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  grpc::CompletionQueue queue;
  const auto call = stub.PrepareCall(&context, method, &queue);
  const auto next = [&queue] {
    void* tag = nullptr;
    bool good = false;
    return queue.Next(&tag, &good) && good;
  };
  call->StartCall(nullptr);
  next();
  grpc::Slice nothing;
  call->WriteLast(grpc::ByteBuffer(&nothing, 1), {}, nullptr);
  next();
  grpc::ByteBuffer answer;
  call->Read(&answer, nullptr);
  if (next()) context.TryCancel();  // A stream that was let in.
  grpc::Status status;
  call->Finish(&status, nullptr);
  next();
  return status;
}

GrpcServerOptions As(const Principal& principal) {
  GrpcServerOptions options;
  options.door = Door(principal);
  return options;
}

TEST(PermissionsTest, EveryMethodHasOneRow) {
  std::multiset<std::string> rows;
  for (const MethodRule& rule : MethodRules()) rows.emplace(rule.method);
  const std::vector<std::string> methods = Methods();
  EXPECT_EQ(rows, std::multiset<std::string>(methods.begin(), methods.end()));
  EXPECT_GE(methods.size(), 13U);
}

TEST(PermissionsTest, MethodWithoutRowIsForNobody) {
  EXPECT_EQ(FindMethod("/contact.v1.JobService/getjob"), nullptr);
  EXPECT_EQ(FindMethod(""), nullptr);
}

TEST(PermissionsTest, ServerRefusesEveryMethodThatTheRolesDoNotAllow) {
  for (const Role role : {Role::kRead, Role::kSubmit, Role::kOperator, Role::kAdmin}) {
    TestServer server(As({"ada", "acme", {role}, "token"}));
    for (const std::string& method : Methods()) {
      const bool allowed = static_cast<int>(role) >= static_cast<int>(FindMethod(method)->needs);
      const grpc::Status status = Call(server.Connect(), method);
      EXPECT_EQ(status.error_code() != grpc::StatusCode::PERMISSION_DENIED, allowed)
          << NameOf(role) << ' ' << method << ' ' << status.error_message();
      EXPECT_EQ(Reason(status) != "PERMISSION_DENIED", allowed) << NameOf(role) << ' ' << method;
    }
  }
}

TEST(PermissionsTest, ServerRefusesEveryMethodToStrangers) {
  struct Nobody final : IdentitySource {
    std::shared_ptr<const TokenTable> tokens() const override { return nullptr; }
    std::shared_ptr<const CertificateRules> rules() const override { return nullptr; }
  };
  GrpcServerOptions options;
  options.door = Door(std::make_shared<const Nobody>());
  TestServer server(options);
  for (const std::string& method : Methods()) {
    const grpc::Status status = Call(server.Connect(), method);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAUTHENTICATED) << method;
    EXPECT_EQ(Reason(status), "UNAUTHENTICATED") << method;
  }
  EXPECT_EQ(server.grpc().metrics()->refused()["UNAUTHENTICATED"],
            static_cast<std::int64_t>(Methods().size()));
}

TEST(PermissionsTest, ServerTellsWhoTheCallerIs) {
  TestServer server(As({"ada", "acme", {Role::kSubmit}, "socket"}));
  grpc::ClientContext context;
  v1::ServerInfo info;
  ASSERT_TRUE(server.stub().GetServerInfo(&context, {}, &info).ok());
  EXPECT_EQ(info.principal().ShortDebugString(),
            R"(name: "ada" tenant: "acme" roles: "submit" how: "socket")");
}

}  // namespace
}  // namespace contact
