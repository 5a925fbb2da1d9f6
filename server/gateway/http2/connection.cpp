#include "gateway/http2/connection.h"

#include <spdlog/spdlog.h>

#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>
#include <cerrno>
#include <exception>
#include <utility>

#include "gateway/call/answering.h"
#include "gateway/http2/headers.h"

namespace contact::gateway {
namespace {

namespace asio = boost::asio;
using namespace std::chrono_literals;
using std::chrono::steady_clock;
using ErrorCode = boost::system::error_code;

constexpr std::uint32_t kStreams = 1000;
// A request sends so much before anything of it is taken.
constexpr std::uint32_t kWindow = 256 << 10;
constexpr std::int32_t kConnectionWindow = 4 << 20;
constexpr std::uint32_t kMostHeaderList = 64 << 10;
// Calls that a connection has taken back and that have not ended, before it starts others.
constexpr std::size_t kTakenBack = 64;
// Frames that wait for a client that takes nothing, before nothing more is read of it.
constexpr std::size_t kWaitingFrames = 500;
// A silent connection is probed, and is over if it stays silent. A busy client with gRPC's
// synchronous interface answers a ping only every 5 s.
constexpr auto kPingAfter = 30s;
constexpr auto kSilence = 20s;
// A connection without requests is of no use.
constexpr auto kIdle = 300s;
constexpr auto kTick = 250ms;
// Bytes that are written at a time.
constexpr std::size_t kMostOut = 128 << 10;

}  // namespace

Http2Connection::Http2Connection(std::shared_ptr<Service> service, HeldBytes& held,
                                 Http2Thread& thread, std::shared_ptr<Socket> socket, Peer peer,
                                 OpenConnections::Lease lease)
    : service_(std::move(service)),
      thread_(thread),
      socket_(std::move(socket)),
      peer_(std::move(peer)),
      lease_(std::move(lease)),
      account_(held,
               [this] {
                 asio::post(io(), [weak = weak_from_this()] {
                   const auto self = weak.lock();
                   if (!self) return;
                   spdlog::warn("connection {} holds most of the memory of all, and is cut",
                                self->peer_.uri);
                   self->Close();
                 });
               }),
      tick_(thread.io),
      heard_(steady_clock::now()),
      wrote_(heard_),
      pinged_(heard_),
      idle_(heard_) {}

Http2Connection::~Http2Connection() { nghttp2_session_del(session_); }

void Http2Connection::Serve(std::shared_ptr<Service> service, HeldBytes& held, Http2Thread& thread,
                            std::shared_ptr<Socket> socket, Peer peer, OpenConnections::Lease lease,
                            std::string_view first) {
  const std::shared_ptr<Http2Connection> self(new Http2Connection(
      std::move(service), held, thread, std::move(socket), std::move(peer), std::move(lease)));
  self->Begin(first);
}

void Http2Connection::Begin(std::string_view first) {
  registered_ = service_->connections()->Register([this](bool cut) {
    asio::post(io(), [weak = weak_from_this(), cut] {
      if (const auto self = weak.lock()) cut ? self->Close() : self->Drain();
    });
  });
  session_ = NewSession();
  const std::array<nghttp2_settings_entry, 4> settings = {
      {{NGHTTP2_SETTINGS_MAX_CONCURRENT_STREAMS, kStreams},
       {NGHTTP2_SETTINGS_INITIAL_WINDOW_SIZE, kWindow},
       {NGHTTP2_SETTINGS_MAX_HEADER_LIST_SIZE, kMostHeaderList},
       {NGHTTP2_SETTINGS_NO_RFC7540_PRIORITIES, 1}}};
  nghttp2_submit_settings(session_, NGHTTP2_FLAG_NONE, settings.data(), settings.size());
  nghttp2_session_set_local_window_size(session_, NGHTTP2_FLAG_NONE, 0, kConnectionWindow);
  AwaitTick();
  if (Take(first)) ReadSoon();
}

bool Http2Connection::paused() const {
  return !ready_.empty() ||
         (!rest_.empty() && nghttp2_session_get_outbound_queue_size(session_) > kWaitingFrames);
}

void Http2Connection::ReadSoon() {
  if (!open_ || reading_ || paused()) return;
  reading_ = true;
  const auto read = [self = shared_from_this()](ErrorCode error) {
    self->reading_ = false;
    if (!self->open_) return;
    if (error) return self->Close();
    self->Read();
  };
  if (socket_->has_buffered()) {
    asio::post(io(), [read] { read(ErrorCode()); });
  } else {
    socket_->handle().async_wait(Socket::Handle::wait_read, read);
  }
}

void Http2Connection::Read() {
  const ssize_t size = socket_->Read(thread_.in.data(), thread_.in.size());
  if (size < 0 && errno == EAGAIN) return ReadSoon();
  if (size <= 0) return Close();
  const auto* bytes = reinterpret_cast<const char*>(thread_.in.data());
  if (Take({bytes, static_cast<std::size_t>(size)})) ReadSoon();
}

bool Http2Connection::Take(std::string_view bytes) {
  heard_ = steady_clock::now();
  const ssize_t taken = nghttp2_session_mem_recv(
      session_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (taken >= 0 && !frames_.Spent(heard_)) {
    StartCalls();
    Flush();
    return open_;
  }
  Flush();  // What nghttp2 says of the error.
  Close();
  return false;
}

void Http2Connection::Ready(const StreamPtr& stream) {
  if (stream->begun() || stream->queued()) return;
  stream->SetQueued();
  ready_.push_back(stream->id());
}

void Http2Connection::StartCalls() {
  for (int i = 0; i < Turns::kCalls && !ready_.empty() && live_ < begun_ + kTakenBack; ++i) {
    const auto found = streams_.find(ready_.front());
    if (found == streams_.end()) {
      --i;  // Taken back meanwhile.
      ready_.pop_front();
      continue;
    }
    const auto place = thread_.turns.Take();
    if (!place) break;
    ready_.pop_front();
    Start(found->second, *place);
  }
  const bool may_wait = live_ < begun_ + kTakenBack;  // Else the end of a call goes on.
  if (!ready_.empty() && may_wait && !std::exchange(waiting_, true)) {
    thread_.turns.Wait(weak_from_this());
  }
}

void Http2Connection::TakeTurn() {
  waiting_ = false;
  if (!open_) return;
  StartCalls();
  FlushSoon();
  ReadSoon();
}

void Http2Connection::Start(const StreamPtr& stream, std::uint64_t place) {
  stream->Begin(place);
  ++live_;
  ++begun_;
  asio::co_spawn(
      io(), [self = shared_from_this(), stream] { return self->AnswerTo(stream); },
      [self = shared_from_this(), stream](const std::exception_ptr& error, bool /*going_on*/) {
        if (error) spdlog::error("a call of the gateway failed");
        if (error && !stream->left()) self->Reset(stream->id());
        self->Ended(*stream);
      });
}

Awaitable<bool> Http2Connection::AnswerTo(StreamPtr stream) {
  if (auto& refusal = stream->refusal()) {
    co_return co_await stream->Send(stream->request(), *std::move(refusal));
  }
  co_return co_await Answer(*service_, stream, stream->request());
}

void Http2Connection::Ended(const Http2Stream& stream) {
  --live_;
  thread_.turns.GiveBack(stream.place());
  if (!open_ || ready_.empty()) return;
  StartCalls();
  ReadSoon();
}

void Http2Connection::Submit(Http2Stream& stream, const HttpAnswer& answer, bool more) {
  thread_.turns.GiveBack(stream.place());
  const std::string status = std::to_string(answer.status);
  Headers headers = {{":status", status}};
  headers.insert(headers.end(), answer.headers.begin(), answer.headers.end());
  const auto all = ToNv(headers);
  const nghttp2_data_provider provider = AnswerProvider();
  nghttp2_submit_response(session_, stream.id(), all.data(), all.size(),
                          more ? &provider : nullptr);
  FlushSoon();
}

void Http2Connection::Resume(std::int32_t id, bool asked) {
  if (asked) nghttp2_session_resume_data(session_, id);
  FlushSoon();
}

void Http2Connection::OpenWindow(std::int32_t id, std::size_t bytes) {
  nghttp2_session_consume_stream(session_, id, bytes);
  FlushSoon();
}

void Http2Connection::Reset(std::int32_t id) {
  nghttp2_submit_rst_stream(session_, NGHTTP2_FLAG_NONE, id, NGHTTP2_CANCEL);
  FlushSoon();
}

void Http2Connection::FlushSoon() {
  if (!open_ || std::exchange(flushing_, true)) return;
  asio::post(io(), [self = shared_from_this()] {
    self->flushing_ = false;
    self->Flush();
    self->ReadSoon();
  });
}

bool Http2Connection::Fill(std::string* out) {
  out->clear();
  for (;;) {
    const std::uint8_t* bytes = nullptr;
    const ssize_t size = nghttp2_session_mem_send(session_, &bytes);
    if (size < 0) return false;
    if (size == 0) return true;
    out->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
    if (out->size() >= kMostOut) return true;
  }
}

void Http2Connection::Flush() {
  while (open_ && rest_.empty()) {
    std::string& out = thread_.out;
    if (!Fill(&out)) return Close();
    if (out.empty()) {
      const bool over =
          nghttp2_session_want_read(session_) == 0 && nghttp2_session_want_write(session_) == 0;
      if (over) Close();
      return;
    }
    wrote_ = steady_clock::now();
    std::size_t at = 0;
    while (at < out.size()) {
      const ssize_t size = socket_->Write(out.data() + at, out.size() - at);
      if (size < 0 && errno != EAGAIN) return Close();
      if (size < 0) break;
      at += static_cast<std::size_t>(size);
    }
    if (at == out.size()) continue;
    rest_ = out.substr(at);
    rest_at_ = 0;
    WriteRest();
  }
}

void Http2Connection::WriteRest() {
  socket_->handle().async_wait(
      Socket::Handle::wait_write, [self = shared_from_this()](ErrorCode error) {
        if (!self->open_) return;
        if (error) return self->Close();
        while (self->rest_at_ < self->rest_.size()) {
          const ssize_t size = self->socket_->Write(self->rest_.data() + self->rest_at_,
                                                    self->rest_.size() - self->rest_at_);
          if (size < 0 && errno != EAGAIN) return self->Close();
          if (size < 0) return self->WriteRest();
          self->wrote_ = steady_clock::now();
          self->rest_at_ += static_cast<std::size_t>(size);
        }
        std::string().swap(self->rest_);
        self->Flush();
        self->ReadSoon();
      });
}

void Http2Connection::AwaitTick() {
  tick_.expires_after(kTick);
  tick_.async_wait([weak = weak_from_this()](ErrorCode error) {
    const auto self = weak.lock();
    if (error || !self || !self->open_) return;
    self->Tick(steady_clock::now());
    if (self->open_) self->AwaitTick();
  });
}

void Http2Connection::Tick(Time now) {
  const bool stalls = !rest_.empty() && now - wrote_ > service_->options().stall;
  const bool silent = pinged_ > heard_ && now - pinged_ > kSilence;
  if (stalls || (silent && !paused())) return Close();
  std::vector<std::int32_t> stalled;
  for (const auto& [id, stream] : streams_) {
    if (stream->IsStalled(now)) stalled.push_back(id);
  }
  for (const std::int32_t id : stalled) Reset(id);
  if (streams_.empty() && now - idle_ > kIdle) Drain();
  if (now - std::max(heard_, pinged_) < kPingAfter) return;
  pinged_ = now;
  nghttp2_submit_ping(session_, NGHTTP2_FLAG_NONE, nullptr);
  FlushSoon();
}

void Http2Connection::Drain() {
  if (!open_) return;
  nghttp2_submit_goaway(session_, NGHTTP2_FLAG_NONE,
                        nghttp2_session_get_last_proc_stream_id(session_), NGHTTP2_NO_ERROR,
                        nullptr, 0);
  FlushSoon();
}

void Http2Connection::Close() {
  if (!std::exchange(open_, false)) return;
  registered_.reset();
  tick_.cancel();
  socket_->Close();
  ErrorCode ignored;
  socket_->handle().close(ignored);
  for (const auto& [id, stream] : std::exchange(streams_, {})) stream->Close();
  ready_.clear();
  lease_.reset();
}

}  // namespace contact::gateway
