#include "cli/watch_call.h"

#include <utility>

namespace contact::cli {

WatchCall::WatchCall(v1::JobService::StubInterface& stub, const v1::WatchJobRequest& request)
    : stream_(stub.AsyncWatchJob(&context_, request, &queue_, nullptr)) {}

WatchCall::~WatchCall() {
  context_.TryCancel();
  queue_.Shutdown();
  void* tag = nullptr;
  bool ok = false;
  while (queue_.Next(&tag, &ok)) {
  }
}

WatchCall::Next WatchCall::Read(std::chrono::milliseconds limit, v1::WatchJobResponse* message) {
  const auto deadline = std::chrono::system_clock::now() + limit;
  while (pending_ != Pending::kNone) {
    void* tag = nullptr;
    bool ok = false;
    if (queue_.AsyncNext(&tag, &ok, deadline) != grpc::CompletionQueue::GOT_EVENT) {
      return Next::kNothing;
    }
    const Pending done = std::exchange(pending_, Pending::kNone);
    if (done == Pending::kFinish) break;
    if (!ok) {
      pending_ = Pending::kFinish;
      stream_->Finish(&status_, nullptr);
      continue;
    }
    if (done == Pending::kRead) std::swap(*message, response_);
    pending_ = Pending::kRead;
    response_.Clear();
    stream_->Read(&response_, nullptr);
    if (done == Pending::kRead) return Next::kMessage;
  }
  return Next::kEnd;
}

}  // namespace contact::cli
