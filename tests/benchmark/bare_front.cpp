#include "bare_front.h"

#include <utility>

namespace contact {

BareFront::BareFront(std::unique_ptr<postgres::Connection> connection, Insert insert)
    : connection_(std::move(connection)), insert_(std::move(insert)) {
  grpc::ServerBuilder builder;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
  builder.RegisterService(this);
  server_ = builder.BuildAndStart();
  thread_ = std::jthread([this](const std::stop_token& stop) { Loop(stop); });
}

BareFront::~BareFront() { server_->Shutdown(); }

grpc::ServerUnaryReactor* BareFront::CreateJob(grpc::CallbackServerContext* context,
                                               const v1::CreateJobRequest* request, v1::Job* job) {
  *job = request->job();
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  postgres::Statement statement = insert_();
  const MutexLock lock(mutex_);
  calls_.push_back({std::move(statement), reactor});
  called_.notify_one();
  return reactor;
}

void BareFront::Loop(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<Call> calls;
    {
      const MutexLock lock(mutex_);
      called_.wait(mutex_, stop,
                   [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return !calls_.empty(); });
      calls.swap(calls_);
    }
    std::vector<const postgres::Statement*> statements;
    for (const Call& call : calls) statements.push_back(&call.statement);
    if (calls.empty()) continue;
    const bool stored = connection_->Run(statements).ok();
    for (const Call& call : calls) {
      call.reactor->Finish(stored ? grpc::Status::OK
                                  : grpc::Status(grpc::StatusCode::ABORTED, "not stored"));
    }
  }
}

}  // namespace contact
