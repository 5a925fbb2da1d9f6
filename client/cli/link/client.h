#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "cli/base/failure.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "wire/scenario_codec.h"

namespace contact::cli {

/// A call that the server, or the way to it, refused.
class CallFailure : public Failure {
 public:
  CallFailure(const grpc::Status& status, const std::string& server);

  grpc::StatusCode status() const { return status_; }
  const std::string& reason() const { return reason_; }  ///< ErrorInfo.reason; may be empty.
  const std::vector<Violation>& violations() const { return violations_; }  ///< Of a request.

  /// The same with every violation in its message, a line each; itself without any.
  Failure AllTold() const;

 private:
  grpc::StatusCode status_;
  std::string reason_;
  std::vector<Violation> violations_;
};

/// A connection to one server. Calls are made when they are needed, have a deadline, and are
/// tried again a few times while the server is UNAVAILABLE.
class Client {
 public:
  using Stub = v1::JobService::Stub;

  /// Connects to HOST:PORT in the background. Throws Failure (kUsage) for any other text.
  Client(std::string server, std::chrono::milliseconds call_timeout);

  /// Makes a unary call. Throws CallFailure.
  template <class Request, class Response>
  Response Call(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                const Request& request) {
    Response response;
    Try([&](grpc::ClientContext* context) {
      return ((*stub_).*method)(context, request, &response);
    });
    return response;
  }

  /// The same, where the request may be wrong in several places. Throws Failure with all of them.
  template <class Request, class Response>
  Response CallTellingAll(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&,
                                                       Response*),
                          const Request& request) {
    try {
      return Call(method, request);
    } catch (const CallFailure& failure) {
      throw failure.AllTold();
    }
  }

  Stub& stub() { return *stub_; }
  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  const std::string& server() const { return server_; }

 private:
  void Try(const std::function<grpc::Status(grpc::ClientContext*)>& call);

  std::string server_;
  std::chrono::milliseconds call_timeout_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<Stub> stub_;
};

}  // namespace contact::cli
