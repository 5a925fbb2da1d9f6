#pragma once

#include <nghttp2/nghttp2.h>

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gateway/call/service.h"
#include "gateway/http2/frame_budget.h"
#include "gateway/http2/stream.h"
#include "gateway/http2/turns.h"
#include "gateway/net/held_bytes.h"
#include "gateway/net/open_connections.h"

namespace contact::gateway {

/// What the connections of one thread share.
struct Http2Thread {
  explicit Http2Thread(boost::asio::io_context& thread) : io(thread), turns(thread) {}
  boost::asio::io_context& io;
  Turns turns;
  /// Buffers of whoever reads or writes.
  std::vector<std::uint8_t> in = std::vector<std::uint8_t>(64 << 10);
  std::string out;
};

/// One HTTP/2 connection. All that was read is parsed before any call of it starts, so that a call
/// that is taken back within has cost nothing; and nothing is read while calls wait for their turn,
/// or while the client takes nothing, so that a flood waits in its own socket. Used on the one
/// thread of its io_context.
class Http2Connection final : public TurnTaker,
                              public StreamHost,
                              public std::enable_shared_from_this<Http2Connection> {
 public:
  /// Serves a connection, of which `first` was read already, until it ends. `lease` goes then.
  static void Serve(std::shared_ptr<Service> service, HeldBytes& held, Http2Thread& thread,
                    std::shared_ptr<Socket> socket, Peer peer, OpenConnections::Lease lease,
                    std::string_view first);
  ~Http2Connection() override;

  boost::asio::io_context& io() const override { return thread_.io; }
  Service& service() const override { return *service_; }
  const Peer& peer() const override { return peer_; }
  HeldBytes::Account& account() override { return account_; }
  void Submit(Http2Stream& stream, const HttpAnswer& answer, bool more) override;
  void Resume(std::int32_t id, bool asked) override;
  void OpenWindow(std::int32_t id, std::size_t bytes) override;
  void Reset(std::int32_t id) override;

  void TakeTurn() override;

 private:
  /// What nghttp2 calls, in callbacks.cpp.
  friend struct Http2Callbacks;
  using StreamPtr = std::shared_ptr<Http2Stream>;

  Http2Connection(std::shared_ptr<Service> service, HeldBytes& held, Http2Thread& thread,
                  std::shared_ptr<Socket> socket, Peer peer, OpenConnections::Lease lease);
  void Begin(std::string_view first);

  // Of callbacks.cpp.

  /// A session of nghttp2 that tells this of frames, and takes what its streams have to send.
  nghttp2_session* NewSession();
  /// Where nghttp2 has the bytes of an answer from.
  static nghttp2_data_provider AnswerProvider();

  /// Reads when there is something, unless reading is paused.
  void ReadSoon();
  void Read();
  /// Takes bytes. False: the connection is over.
  bool Take(std::string_view bytes);
  /// True while nothing is to be read.
  bool paused() const;

  /// The request of a stream can be answered.
  void Ready(const StreamPtr& stream);
  /// Starts calls, as many as it is the turn for.
  void StartCalls();
  void Start(const StreamPtr& stream, std::uint64_t place);
  Awaitable<bool> AnswerTo(StreamPtr stream);
  /// The user of a stream is done.
  void Ended(const Http2Stream& stream);

  /// Writes what there is to write, at once or soon.
  void Flush();
  void FlushSoon();
  /// Has nghttp2 fill `out`. False: the connection is over.
  bool Fill(std::string* out);
  /// Writes what the socket takes of `rest_`, and the remainder once it takes more.
  void WriteRest();

  /// Looks once a second at what takes too long.
  void AwaitTick();
  void Tick(Time now);
  /// Takes no more requests, and ends once those before are answered.
  void Drain();
  void Close();

  const std::shared_ptr<Service> service_;
  Http2Thread& thread_;
  const std::shared_ptr<Socket> socket_;
  const Peer peer_;
  OpenConnections::Lease lease_;
  OpenConnections::Lease registered_;
  HeldBytes::Account account_;
  nghttp2_session* session_ = nullptr;
  std::map<std::int32_t, StreamPtr> streams_;
  /// Streams that wait for their turn.
  std::deque<std::int32_t> ready_;
  /// Calls whose users are not done, those of streams that are over included.
  std::size_t live_ = 0;
  /// Those of streams_ that have a user.
  std::size_t begun_ = 0;
  FrameBudget frames_;

  bool open_ = true;
  bool reading_ = false;
  bool flushing_ = false;
  bool waiting_ = false;
  /// What the socket has not taken.
  std::string rest_;
  std::size_t rest_at_ = 0;

  boost::asio::steady_timer tick_;
  /// When something came last, was taken last, and when a ping was sent.
  Time heard_, wrote_, pinged_;
  /// Since when there are no streams.
  Time idle_;
};

}  // namespace contact::gateway
