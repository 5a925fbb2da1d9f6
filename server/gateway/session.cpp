#include "gateway/session.h"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <exception>
#include <utility>
#include <variant>

#include "gateway/connection.h"
#include "gateway/rpc_call.h"
#include "gateway/unary_call.h"
#include "grpc/health/v1/health.pb.h"
#include "jobs/job/errors.h"
#include "rpc/call/status.h"

namespace contact::gateway {
namespace {

namespace asio = boost::asio;
using asio::awaitable;
using Leaving = Connection::Leaving;

constexpr std::chrono::seconds kReadyTime{2};

// The call that asks whether the server serves.
RpcRequest HealthCheck() { return {.path = "/grpc.health.v1.Health/Check", .timeout = kReadyTime}; }

// Answers the requests of one connection, one after the other. On each side one thing is under way
// at a time: the next message is asked of gRPC once the last one has been written.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(asio::io_context& io, Service& service, int fd)
      : service_(service), connection_(io, service, fd), wake_(connection_.executor()) {
    wake_.expires_at(std::chrono::steady_clock::time_point::max());
  }

  void Start() {
    asio::co_spawn(
        connection_.executor(), [self = shared_from_this()] { return self->Run(); },
        asio::detached);
  }

 private:
  // A call whose user is this session, until the end of the scope.
  template <class Call>
  class Running {
   public:
    Running(Session& session, const RpcRequest& request, Leaving leaving) : session_(session) {
      call_ = Call::Start(session.service_, request, session.connection_.peer(), session.Poster(),
                          session.Waker());
      session.connection_.Watch(
          leaving, [self = session.shared_from_this(), call = call_] { call->Cancel(); });
    }
    ~Running() {
      call_->Leave();
      session_.connection_.Unwatch();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    Call& operator*() const { return *call_; }
    Call* operator->() const { return call_.get(); }

   private:
    Session& session_;
    std::shared_ptr<Call> call_;
  };

  awaitable<void> Run();
  // Each answers a request. False: the connection is to end.
  awaitable<bool> Answer(const HttpRequest& request);
  awaitable<bool> Call(const HttpRequest& request);
  awaitable<bool> Unary(const HttpRequest& request, const RpcRequest& asked);
  awaitable<bool> Streaming(const HttpRequest& request, const RpcRequest& asked);
  awaitable<bool> Readiness(const HttpRequest& request);

  // What a call needs to run on the thread of this session, and to tell it that something changed.
  Post Poster();
  std::function<void()> Waker();
  // Waits until something of a call has changed.
  awaitable<void> Changed();
  // The next message of a call; nothing once it has ended.
  awaitable<std::optional<grpc::ByteBuffer>> Next(RpcCall& call);

  Service& service_;
  Connection connection_;
  // Cancelled when something has changed.
  asio::steady_timer wake_;
};

awaitable<void> Session::Run() {
  try {
    for (;;) {
      const std::optional<HttpRequest> request = co_await connection_.Read();
      if (!request) break;
      const bool going_on = co_await Answer(*request);
      if (!going_on) break;
    }
  } catch (const std::exception& error) {
    spdlog::error("a connection of the gateway failed: {}", error.what());
  }
  connection_.Close();
}

awaitable<bool> Session::Answer(const HttpRequest& request) {
  const OpenRequests::Request open = service_.requests().Begin();
  if (!open) {
    const Error draining = MakeError(Reason::kServerDraining);
    co_return co_await connection_.Send(request, Refused(request, 503, ToGrpc(draining)));
  }
  if (auto refusal = service_.Refusal(request)) {
    co_return co_await connection_.Send(request, *std::move(refusal));
  }
  const bool options = request.method == "OPTIONS";
  if (!options && IsRpc(request)) co_return co_await Call(request);
  if (!options && request.path() == "/readyz") co_return co_await Readiness(request);
  co_return co_await connection_.Send(request, service_.Answer(request));
}

awaitable<bool> Session::Call(const HttpRequest& request) {
  auto read = ReadRpc(request);
  if (auto* refusal = std::get_if<HttpAnswer>(&read)) {
    co_return co_await connection_.Send(request, std::move(*refusal));
  }
  const auto& asked = std::get<RpcRequest>(read);
  if (asked.method->server_streaming()) co_return co_await Streaming(request, asked);
  co_return co_await Unary(request, asked);
}

Post Session::Poster() {
  // The guard keeps the thread until gRPC is done with the call.
  return [work = asio::make_work_guard(connection_.executor())](std::function<void()> run) {
    asio::post(work.get_executor(), std::move(run));
  };
}

std::function<void()> Session::Waker() {
  return [self = weak_from_this()] {
    if (const auto session = self.lock()) session->wake_.cancel();
  };
}

awaitable<void> Session::Changed() {
  boost::system::error_code ignored;
  co_await wake_.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
}

awaitable<std::optional<grpc::ByteBuffer>> Session::Next(RpcCall& call) {
  call.Read();
  for (;;) {
    if (auto message = call.TakeMessage()) co_return message;
    if (call.status()) co_return std::nullopt;
    co_await Changed();
  }
}

awaitable<bool> Session::Unary(const HttpRequest& request, const RpcRequest& asked) {
  HttpAnswer answer;
  {
    const Running<UnaryCall> call(*this, asked, Leaving::kResets);
    while (!call->status()) co_await Changed();
    answer = AnswerOf(asked, call->TakeAnswer(), *call->status(), call->head(), call->trailers());
  }
  co_return co_await connection_.Send(request, std::move(answer));
}

awaitable<bool> Session::Streaming(const HttpRequest& request, const RpcRequest& asked) {
  // A stream may wait long for a message, and so for a sign that the client has closed all.
  const Running<RpcCall> call(*this, asked, Leaving::kCloses);
  while (!call->has_head()) co_await Changed();
  HttpAnswer head;
  head.headers = HeadersOf(asked.dialect);
  for (auto& header : ToHeaders(call->head(), "")) head.headers.push_back(std::move(header));
  bool sent = co_await connection_.SendHead(request, std::move(head));
  grpc::Status printed;
  while (sent) {
    co_await connection_.Writable();  // So that a stalled client holds one message, that of gRPC.
    std::optional<grpc::ByteBuffer> message = co_await Next(*call);
    if (!message) break;
    const Outgoing outgoing(asked, *std::exchange(message, std::nullopt));
    printed = outgoing.status();
    if (!printed.ok()) break;
    sent = co_await connection_.SendParts(outgoing.parts());
  }
  if (!sent) co_return false;
  const std::string end = printed.ok() ? EndOf(asked.dialect, *call->status(), call->trailers())
                                       : EndOf(asked.dialect, printed, {});
  sent = co_await connection_.SendParts(Parts(1, end));
  if (!sent) co_return false;
  co_return co_await connection_.SendEnd();
}

awaitable<bool> Session::Readiness(const HttpRequest& request) {
  using grpc::health::v1::HealthCheckResponse;
  HealthCheckResponse health;
  {
    const Running<UnaryCall> call(*this, HealthCheck(), Leaving::kResets);
    while (!call->status()) co_await Changed();
    if (call->status()->ok()) health.ParseFromString(call->TakeAnswer());
  }
  HttpAnswer answer = PlainAnswer(503, "not ready");
  if (health.status() == HealthCheckResponse::SERVING) answer = PlainAnswer(200, "ready");
  co_return co_await connection_.Send(request, std::move(answer));
}

}  // namespace

void Serve(asio::io_context& io, Service& service, int fd) {
  std::make_shared<Session>(io, service, fd)->Start();
}

}  // namespace contact::gateway
