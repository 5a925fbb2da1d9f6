#include "gateway/call/answering.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>
#include <variant>

#include "base/clock.h"
#include "gateway/call/outgoing.h"
#include "gateway/call/rpc_call.h"
#include "gateway/call/unary_call.h"
#include "grpc/health/v1/health.pb.h"
#include "jobs/job/errors.h"
#include "rpc/call/status.h"

namespace contact::gateway {
namespace {

using Leaving = Exchange::Leaving;
using ExchangePtr = std::shared_ptr<Exchange>;

constexpr std::chrono::seconds kReadyTime{2};
// A client that takes messages in less reads a stream as fast as it comes: without the next one
// read meanwhile it has a tenth less (service_benchmark --only frames). One that stalls after that
// holds one message more (fault/drain).
constexpr std::chrono::milliseconds kFlows{10};

// The call that asks whether the server serves.
RpcRequest HealthCheck() { return {.path = "/grpc.health.v1.Health/Check", .timeout = kReadyTime}; }

// Watches for a client that leaves, until the end of the scope.
class Watching {
 public:
  Watching(Exchange& exchange, Leaving leaving) : exchange_(exchange) { exchange_.Watch(leaving); }
  ~Watching() { exchange_.Unwatch(); }
  Watching(const Watching&) = delete;
  Watching& operator=(const Watching&) = delete;

 private:
  Exchange& exchange_;
};

// Waits until the call has ended; cancels it if nobody waits for its answer any more.
template <class Call>
Awaitable<void> End(Call& call, Exchange& exchange) {
  while (!call.status()) {
    if (exchange.left()) call.Cancel();
    co_await exchange.Changed();
  }
}

Awaitable<bool> Unary(Service& service, ExchangePtr exchange, const HttpRequest& request,
                      const RpcRequest& asked) {
  HttpAnswer answer;
  {
    const Watching watching(*exchange, Leaving::kResets);
    const auto call = UnaryCall::Start(service, request, asked, exchange);
    co_await End(*call, *exchange);
    answer = AnswerOf(asked, call->TakeAnswer(), *call->status(), call->head(), call->trailers());
  }
  co_return co_await exchange->Send(request, std::move(answer));
}

// Messages of a call in both directions. The next ones are taken from the call once the client has
// taken those before.
class Streaming {
 public:
  Streaming(Service& service, ExchangePtr exchange, const HttpRequest& request,
            const RpcRequest& asked)
      : exchange_(std::move(exchange)),
        request_(request),
        asked_(asked),
        call_(RpcCall::Start(service, request, asked, exchange_)) {
    if (!asked.method) return;  // Its messages stand in the body.
    const grpc::Slice message(asked.message);
    first_ = grpc::ByteBuffer(&message, 1);
  }

  Awaitable<bool> Run() {
    // A stream may wait long for a message, and so for a sign that the client has closed all.
    const Watching watching(*exchange_, Leaving::kCloses);
    const bool sent = co_await Messages();
    if (!sent || !printed_.ok()) call_->Cancel();
    co_await End(*call_, *exchange_);
    if (!sent) co_return false;
    co_return co_await Last();
  }

 private:
  // Gives the call what it can take of the request's messages.
  void Feed() {
    if (!call_->writable()) return;
    auto next = std::exchange(first_, std::nullopt);
    if (!next && !asked_.method) next = exchange_->NextMessage();
    if (next) {
      call_->Write(*next);
    } else if (asked_.method || exchange_->at_end()) {
      call_->EndWrites();
    }
  }

  // Sends messages until there are no more, or one has no form in the client's dialect. False: the
  // client takes nothing more.
  Awaitable<bool> Messages() {
    for (;;) {
      if (exchange_->left()) call_->Cancel();
      Feed();
      auto messages = call_->has_head() ? call_->Take(flows_) : std::vector<grpc::ByteBuffer>();
      if (!began_ && call_->has_head() && !(call_->status() && messages.empty())) {
        const bool sent = co_await Head();
        if (!sent) co_return false;
        if (messages.empty()) continue;
      }
      if (!messages.empty()) {
        const auto begin = SystemClock().Elapsed();
        const bool sent = co_await Send(std::move(messages));
        if (!sent || !printed_.ok()) co_return sent;
        co_await exchange_->Writable();  // So that a stalled client holds few messages.
        flows_ = SystemClock().Elapsed() - begin < kFlows;
        continue;
      }
      if (call_->status()) co_return true;
      co_await exchange_->Changed();
    }
  }

  Awaitable<bool> Head() {
    began_ = true;
    HttpAnswer head{.headers = HeadersOf(asked_.dialect)};
    for (auto& header : ToHeaders(call_->head(), "")) head.headers.push_back(std::move(header));
    co_return co_await exchange_->SendHead(request_, std::move(head));
  }

  Awaitable<bool> Send(std::vector<grpc::ByteBuffer> messages) {
    std::vector<Outgoing> outgoing;
    Parts parts;
    for (const grpc::ByteBuffer& message : messages) {
      Outgoing next(asked_, message);
      printed_ = next.status();
      if (!printed_.ok()) break;
      outgoing.push_back(std::move(next));
    }
    for (const Outgoing& message : outgoing) message.AddTo(&parts);
    if (parts.empty()) co_return true;
    co_return co_await exchange_->SendParts(std::move(parts));
  }

  // Sends how the call has ended.
  Awaitable<bool> Last() {
    const grpc::Status& status = printed_.ok() ? *call_->status() : printed_;
    const Trailers trailers = printed_.ok() ? call_->trailers() : Trailers();
    if (!began_) {
      co_return co_await exchange_->Send(request_, Failure(asked_.dialect, status, trailers));
    }
    if (asked_.dialect.protocol == Dialect::Protocol::kGrpc) {
      co_return co_await exchange_->SendEnd(TrailersOf(status, trailers));
    }
    const std::string end = EndOf(asked_.dialect, status, trailers);
    const bool sent = co_await exchange_->SendParts(Parts(1, end));
    if (!sent) co_return false;
    co_return co_await exchange_->SendEnd({});
  }

  const ExchangePtr exchange_;
  const HttpRequest& request_;
  const RpcRequest& asked_;
  const std::shared_ptr<RpcCall> call_;
  // The message of a request that was read as a whole, until it is written.
  std::optional<grpc::ByteBuffer> first_;
  // The client has taken the last messages at once: the next are read while it takes those before.
  bool flows_ = false;
  // The head was sent.
  bool began_ = false;
  // Why a message cannot be sent.
  grpc::Status printed_;
};

Awaitable<bool> Call(Service& service, ExchangePtr exchange, const HttpRequest& request) {
  auto read = IsRpc(request) ? ReadRpc(request) : ReadNativeHead(request);
  if (auto* refusal = std::get_if<HttpAnswer>(&read)) {
    co_return co_await exchange->Send(request, std::move(*refusal));
  }
  const auto& asked = std::get<RpcRequest>(read);
  if (asked.method && !asked.method->server_streaming()) {
    co_return co_await Unary(service, exchange, request, asked);
  }
  Streaming streaming(service, exchange, request, asked);
  co_return co_await streaming.Run();
}

Awaitable<bool> Readiness(Service& service, ExchangePtr exchange, const HttpRequest& request) {
  using grpc::health::v1::HealthCheckResponse;
  HealthCheckResponse health;
  {
    const Watching watching(*exchange, Leaving::kResets);
    const auto call = UnaryCall::Start(service, request, HealthCheck(), exchange);
    co_await End(*call, *exchange);
    if (call->status()->ok()) health.ParseFromString(call->TakeAnswer());
  }
  HttpAnswer answer = PlainAnswer(503, "not ready");
  if (health.status() == HealthCheckResponse::SERVING) answer = PlainAnswer(200, "ready");
  co_return co_await exchange->Send(request, std::move(answer));
}

}  // namespace

Awaitable<bool> Answer(Service& service, ExchangePtr exchange, const HttpRequest& request) {
  const OpenRequests::Request open = service.requests().Begin();
  if (!open) {
    const Error draining = MakeError(Reason::kServerDraining);
    co_return co_await exchange->Send(request, Refused(request, 503, ToGrpc(draining)));
  }
  if (auto refusal = service.Refusal(request)) {
    co_return co_await exchange->Send(request, *std::move(refusal));
  }
  const bool options = request.method == "OPTIONS";
  if (!options && (IsRpc(request) || IsNative(request))) {
    co_return co_await Call(service, exchange, request);
  }
  if (!options && request.path() == "/readyz") {
    co_return co_await Readiness(service, exchange, request);
  }
  co_return co_await exchange->Send(request, service.Answer(request));
}

}  // namespace contact::gateway
