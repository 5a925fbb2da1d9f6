#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <utility>

namespace contact::cli {

/// One call that streams messages from the server, read with a limit on how long a read waits. Not
/// thread-safe.
template <class Message>
class StreamCall {
 public:
  /// What Read has found.
  enum class Next {
    kMessage,  ///< `message` holds one.
    kNothing,  ///< None came in time.
    kEnd,      ///< The stream ended; see status().
  };

  /// Begins the call with `start(context, queue, tag)`, such as Stub::AsyncWatchJob.
  template <class Start>
  explicit StreamCall(Start start) : stream_(start(&context_, &queue_, nullptr)) {}

  /// Cancels the call if it has not ended, and waits until gRPC has let go of this object.
  ~StreamCall() {
    context_.TryCancel();
    queue_.Shutdown();
    void* tag = nullptr;
    bool ok = false;
    while (queue_.Next(&tag, &ok)) {
    }
  }

  /// Waits for the next message, at most `limit`. `message` changes only with kMessage.
  Next Read(std::chrono::milliseconds limit, Message* message);

  /// How the stream ended; OK until Read has returned kEnd.
  const grpc::Status& status() const { return status_; }

 private:
  /// The operation of gRPC that has begun and not completed; there is at most one.
  enum class Pending { kStart, kRead, kFinish, kNone };

  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::ClientAsyncReaderInterface<Message>> stream_;
  /// kNone once the stream has ended.
  Pending pending_ = Pending::kStart;
  /// Filled by the read that is pending.
  Message response_;
  /// Filled by Finish.
  grpc::Status status_;
};

template <class Message>
typename StreamCall<Message>::Next StreamCall<Message>::Read(std::chrono::milliseconds limit,
                                                             Message* message) {
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
