#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "cli/base/failure.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {

/// What gRPC says about a connection that failed, in few words where they are known.
std::string TransportWords(const std::string& message);

/// What helps a user who cannot reach a server at a socket file or on another machine; empty if
/// nothing is known, such as for a port of this machine. `words`: the error of the connection, with
/// the system's reason.
std::string ServerAdvice(const std::string& server, const std::string& words);

/// A call that the server, or the way to it, refused.
class CallFailure : public Failure {
 public:
  /// Exit code and message follow from `status` and its error details; `server` is HOST:PORT.
  CallFailure(const grpc::Status& status, const std::string& server);

  /// The code of gRPC.
  grpc::StatusCode status() const { return status_; }
  /// ErrorInfo.reason, such as `JOB_NOT_FOUND`; empty if the server gave none.
  const std::string& reason() const { return reason_; }
  /// The rules that the request breaks; empty if it breaks none.
  const std::vector<Violation>& violations() const { return violations_; }

  /// A failure with the same exit code whose message has all violations, a line each; without
  /// violations the message stays.
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
  /// The service whose methods Call takes.
  using Stub = v1::JobService::Stub;

  /// How answers come: as MakePrintable leaves them, or as they were sent.
  enum class Answers { kPrintable, kAsSent };

  /// Connects to HOST:PORT in the background. Throws Failure (kUsage) for any other text.
  Client(std::string server, std::chrono::milliseconds call_timeout,
         const std::shared_ptr<grpc::ChannelCredentials>& credentials =
             grpc::InsecureChannelCredentials(),
         Answers answers = Answers::kPrintable);

  /// Makes a unary call of JobService. Throws CallFailure.
  template <class Request, class Response>
  Response Call(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                const Request& request) {
    Response response;
    Try([&](grpc::ClientContext* context) {
      return ((*stub_).*method)(context, request, &response);
    });
    return response;
  }

  /// Makes a unary call whose request may break several rules. Throws Failure, with all broken
  /// rules in its message.
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

  /// For streams. Unary calls go through Call, which has a deadline and tries again.
  Stub& stub() { return *stub_; }
  /// For stubs of other services; never null.
  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  /// HOST:PORT, for messages.
  const std::string& server() const { return server_; }

 private:
  /// Makes a call until it succeeds, at most three times. Throws CallFailure.
  void Try(const std::function<grpc::Status(grpc::ClientContext*)>& call);

  std::string server_;
  /// Deadline of each try of a unary call.
  std::chrono::milliseconds call_timeout_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<Stub> stub_;
};

}  // namespace contact::cli
