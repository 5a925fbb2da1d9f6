#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/call/exchange.h"
#include "gateway/call/service.h"
#include "gateway/net/held_bytes.h"
#include "gateway/net/memory.h"

namespace contact::gateway {

class Http2Stream;

/// What a stream needs of its connection.
class StreamHost {
 public:
  virtual ~StreamHost() = default;
  virtual boost::asio::io_context& io() const = 0;
  virtual Service& service() const = 0;
  virtual const Peer& peer() const = 0;
  virtual HeldBytes::Account& account() = 0;

  /// Submits the head of an answer. Without `more` it is the whole.
  virtual void Submit(Http2Stream& stream, const HttpAnswer& answer, bool more) = 0;
  /// Goes on with a stream that has bytes again, if nghttp2 has asked for them.
  virtual void Resume(std::int32_t id, bool asked) = 0;
  /// Lets the client send so many more bytes.
  virtual void OpenWindow(std::int32_t id, std::size_t bytes) = 0;
  /// Cuts a stream.
  virtual void Reset(std::int32_t id) = 0;
};

/// One request of an HTTP/2 connection and its answer. On one side its user, on the other the
/// connection, which tells of what nghttp2 reads, and takes what it writes.
class Http2Stream final : public Exchange {
 public:
  Http2Stream(std::shared_ptr<StreamHost> connection, std::int32_t id);

  const Peer& peer() const override;
  Awaitable<bool> Send(const HttpRequest& request, HttpAnswer answer) override;
  Awaitable<bool> SendHead(const HttpRequest& request, HttpAnswer answer) override;
  Awaitable<bool> SendParts(Parts parts) override;
  Awaitable<bool> SendEnd(Headers trailers) override;
  Awaitable<void> Writable() override;
  void Watch(Leaving /*leaving*/) override {}
  void Unwatch() override {}
  bool left() const override { return !open_; }
  std::optional<grpc::ByteBuffer> NextMessage() override;
  bool at_end() const override { return request_ended_ && request_.body.empty(); }

  std::int32_t id() const { return id_; }
  const HttpRequest& request() const { return request_; }
  /// Why the request is not read to its end; its answer.
  std::optional<HttpAnswer>& refusal() { return refusal_; }

  // The request, for the connection.

  /// Takes a header. False: there are so many that the connection is to end.
  bool AddHeader(std::string_view name, std::string_view value);
  /// The head is there. True: the request can be answered although its body still comes.
  bool EndHead();
  /// Takes a part of the body; none once the request is refused. Returns how many bytes of the
  /// stream's window can be opened again.
  std::size_t AddBody(std::string_view part);
  void EndRequest();
  /// The request waits for its turn.
  void SetQueued() { queued_ = true; }
  bool queued() const { return queued_; }
  /// The request is handed to its user, with a place of Turns: nothing of its body is taken any
  /// more but messages.
  void Begin(std::uint64_t place) {
    begun_ = true;
    place_ = place;
  }
  bool begun() const { return begun_; }
  std::uint64_t place() const { return place_; }

  // The answer, for the connection.

  /// Bytes to send now, at most so many; 0 also if there are none yet, and the stream then waits
  /// for them until the connection is told to resume it.
  std::size_t Offer(std::size_t most);
  /// True once all bytes that will ever be are offered in `bytes`.
  bool Ends(std::size_t bytes) const { return ending_ && bytes == out_bytes_; }
  const Headers& trailers() const { return trailers_; }
  /// Appends so many bytes to `out`.
  void Move(std::size_t bytes, std::string* out);
  /// The stream is over; well, or not.
  void Close();

  /// True if nothing came of the request, or nothing was taken of the answer, for too long.
  bool IsStalled(Time now) const;

 private:
  /// Bytes that the body will have, as far as is known.
  std::size_t Expected() const;
  /// Submits the head of an answer, with more to come or not.
  void Submit(const HttpAnswer& answer, bool more);
  /// Has the connection go on with this answer.
  void Resume();
  /// Waits until all is sent and the stream is over. False: it was cut before.
  Awaitable<bool> AwaitEnd();

  const std::shared_ptr<StreamHost> connection_;
  const std::int32_t id_;
  bool open_ = true;

  HttpRequest request_;
  std::size_t head_bytes_ = 0;
  bool streams_ = false;
  bool request_ended_ = false;
  bool queued_ = false;
  bool begun_ = false;
  std::uint64_t place_ = 0;
  std::optional<HttpAnswer> refusal_;
  /// What the body has of the service's memory.
  Memory::Share room_;
  /// Bytes of head and body in the connection's account.
  std::size_t counted_ = 0;
  /// Bytes of the body for which the window is still closed.
  std::size_t unopened_ = 0;

  /// What is to be sent, of its user; `at_` is the first part with `skip_` bytes sent.
  Parts out_;
  std::size_t at_ = 0;
  std::size_t skip_ = 0;
  std::size_t out_bytes_ = 0;
  /// nghttp2 has asked for bytes in vain.
  bool hungry_ = false;
  bool ending_ = false;
  Headers trailers_;
  /// When something of the request came last, or something of the answer was taken.
  Time progress_;
  /// A whole answer is to be taken by then.
  Time end_ = Time::max();
};

}  // namespace contact::gateway
