#include "gateway/session.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <utility>

#include "gateway/codec.h"
#include "gateway/frames.h"
#include "gateway/rpc_call.h"
#include "grpc/health/v1/health.pb.h"
#include "rpc/net/peer.h"

namespace contact::gateway {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using namespace std::chrono_literals;
using asio::awaitable;
using asio::generic::stream_protocol;
using Strand = asio::strand<asio::io_context::executor_type>;
using Stream = beast::basic_stream<stream_protocol, Strand>;
using Parser = http::request_parser<http::string_body>;
using ErrorCode = beast::error_code;
using Buffers = std::vector<asio::const_buffer>;

// Times that a client has: between two requests, for a head, for a body.
constexpr auto kIdle = 60s;
constexpr auto kHeadTime = 10s;
constexpr auto kBodyTime = 30s;
// For what a client still sends when it is refused, so that it reads the answer.
constexpr auto kLingerTime = 2s;
constexpr std::size_t kMostHeadBytes = 16 << 10;
// A body up to this size needs no reservation.
constexpr std::size_t kSmallBody = 64 << 10;
constexpr auto kReadyTime = 2s;

// Token of an operation that gives its error instead of throwing it.
auto Into(ErrorCode* error) { return asio::redirect_error(asio::use_awaitable, *error); }

std::string UriOf(int fd) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  if (getpeername(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return "unix:";
  return contact::UriOf(address);
}

int FamilyOf(int fd) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  return address.ss_family;
}

std::string Text(beast::string_view text) { return {text.data(), text.size()}; }

// What is known of a request once its head is there.
HttpRequest HeadOf(const Parser& parser) {
  const auto& message = parser.get();
  HttpRequest head{.method = Text(message.method_string()), .target = Text(message.target())};
  for (const auto& field : message) {
    std::string name = Text(field.name_string());
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    head.headers.emplace_back(std::move(name), Text(field.value()));
  }
  return head;
}

std::string Flat(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  (void)buffer.Dump(&slices);
  std::string bytes;
  bytes.reserve(buffer.Length());
  for (const auto& slice : slices) {
    bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  }
  return bytes;
}

asio::const_buffer Buffer(const std::string& text) {
  return asio::buffer(text.data(), text.size());
}

Buffers Single(const std::string& text) { return {Buffer(text)}; }

// The call that asks whether the server serves.
RpcRequest HealthCheck() { return {.path = "/grpc.health.v1.Health/Check", .timeout = kReadyTime}; }

// A message of an answer as it goes out, in parts that live as long as this.
class Outgoing {
 public:
  // Nothing is left of `message`.
  Outgoing(const RpcRequest& call, grpc::ByteBuffer message) {
    if (!call.dialect.json && call.dialect.protocol != Dialect::Protocol::kGrpcWebText) {
      prefix_ = MessagePrefix(message.Length());
      (void)message.Dump(&slices_);
      return;
    }
    std::string bytes = Flat(message);
    message.Clear();
    if (call.dialect.json) {
      bytes = ToJson(call.method->output_type()->full_name(), bytes).value_or("{}");
    }
    text_ = MessagePrefix(bytes.size()) + bytes;
    if (call.dialect.protocol == Dialect::Protocol::kGrpcWebText) text_ = ToPaddedBase64(text_);
  }

  Buffers Parts() const {
    Buffers parts = {Buffer(prefix_), Buffer(text_)};
    for (const auto& slice : slices_) parts.emplace_back(slice.begin(), slice.size());
    return parts;
  }

 private:
  std::string prefix_;
  std::vector<grpc::Slice> slices_;
  std::string text_;
};

// One connection.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(asio::io_context& io, Service& service, int fd)
      : service_(service),
        peer_(UriOf(fd)),
        stream_(Stream::socket_type(asio::make_strand(io), stream_protocol(FamilyOf(fd), 0), fd)),
        wake_(stream_.get_executor()) {
    wake_.expires_at(std::chrono::steady_clock::time_point::max());
  }
  ~Session() { service_.GiveBack(reserved_); }

  void Start() {
    asio::co_spawn(
        stream_.get_executor(), [self = shared_from_this()] { return self->Run(); },
        asio::detached);
  }

 private:
  awaitable<void> Run();
  // Reads one request and answers it. False: the connection is to end.
  awaitable<bool> Exchange();
  // Waits until something of the next request is there. False: nothing comes.
  awaitable<bool> Begin();
  // Reads the body, if the service has room for it.
  awaitable<bool> ReadBody(Parser& parser, const HttpRequest& head);
  // Answers a request whose head cannot be used, and ends.
  awaitable<bool> Reject(const Parser& parser, ErrorCode error);
  awaitable<bool> Handle(HttpRequest request);
  awaitable<bool> Call(const HttpRequest& request);
  awaitable<bool> Unary(const HttpRequest& request, const RpcRequest& call);
  awaitable<bool> Streaming(const HttpRequest& request, const RpcRequest& call);
  awaitable<bool> Readiness(const HttpRequest& request);
  // The next message of a call; nothing once it has ended.
  awaitable<std::optional<grpc::ByteBuffer>> Next(RpcCall& call);
  awaitable<void> Changed();
  std::shared_ptr<RpcCall> StartCall(RpcRequest request);
  // Cancels the call once the client leaves.
  void Watch(const std::shared_ptr<RpcCall>& call);

  awaitable<bool> Send(const HttpRequest& request, HttpAnswer answer);
  awaitable<bool> SendHead(const HttpRequest& request, HttpAnswer answer);
  awaitable<bool> SendChunk(Buffers parts);
  // Writes all; a client that takes nothing for a while is given up.
  awaitable<bool> Write(Buffers parts);
  // Ends a connection whose request was not read to its end.
  awaitable<void> Linger();
  std::string HeadText(const HttpAnswer& answer) const;

  Service& service_;
  const std::string peer_;
  Stream stream_;
  asio::steady_timer wake_;
  beast::flat_buffer buffer_;
  // Of the request that is being answered.
  bool keep_alive_ = true;
  bool http11_ = true;
  std::size_t reserved_ = 0;
};

awaitable<void> Session::Run() {
  try {
    while (co_await Exchange()) {
    }
  } catch (const std::exception& error) {
    spdlog::error("a connection of the gateway failed: {}", error.what());
  }
  ErrorCode ignored;
  stream_.socket().shutdown(stream_protocol::socket::shutdown_both, ignored);
}

awaitable<bool> Session::Begin() {
  if (buffer_.size() > 0) co_return true;
  ErrorCode error;
  stream_.expires_after(kIdle);
  constexpr std::size_t kFirst = 4096;
  const std::size_t size = co_await stream_.async_read_some(buffer_.prepare(kFirst), Into(&error));
  buffer_.commit(size);
  co_return !error;
}

awaitable<bool> Session::Exchange() {
  if (!co_await Begin()) co_return false;
  Parser parser;
  parser.header_limit(kMostHeadBytes);
  parser.body_limit(service_.options().max_body_bytes);
  ErrorCode error;
  stream_.expires_after(kHeadTime);
  co_await http::async_read_header(stream_, buffer_, parser, Into(&error));
  keep_alive_ = !error && parser.get().keep_alive();
  http11_ = parser.get().version() >= 11;
  if (error) co_return co_await Reject(parser, error);
  HttpRequest request = HeadOf(parser);
  if (!parser.is_done() && !co_await ReadBody(parser, request)) co_return false;
  request.body = std::move(parser.get().body());
  const bool going_on = co_await Handle(std::move(request));
  service_.GiveBack(std::exchange(reserved_, 0));
  if (!going_on) co_return false;
  co_return keep_alive_;
}

awaitable<bool> Session::ReadBody(Parser& parser, const HttpRequest& head) {
  const std::size_t most = service_.options().max_body_bytes;
  const std::size_t size = parser.content_length() ? *parser.content_length() : most;
  if (size > kSmallBody) {
    if (!service_.Reserve(size)) {
      keep_alive_ = false;
      co_await Send(head, PlainAnswer(503, "too many large requests at once"));
      co_await Linger();
      co_return false;
    }
    reserved_ = size;
  }
  if (beast::iequals(Text(parser.get()[http::field::expect]), "100-continue")) {
    static const std::string go_on = "HTTP/1.1 100 Continue\r\n\r\n";
    if (!co_await Write(Single(go_on))) co_return false;
  }
  ErrorCode error;
  stream_.expires_after(kBodyTime);
  co_await http::async_read(stream_, buffer_, parser, Into(&error));
  if (!error) co_return true;
  keep_alive_ = false;
  co_return co_await Reject(parser, error);
}

awaitable<bool> Session::Reject(const Parser& parser, ErrorCode error) {
  const HttpRequest head = HeadOf(parser);
  const bool protocol =
      error.category() == http::make_error_code(http::error::bad_method).category();
  if (!protocol || error == http::error::end_of_stream || error == http::error::partial_message) {
    co_return false;  // The client has left, or takes too long.
  }
  if (error == http::error::header_limit) {
    co_await Send(head, PlainAnswer(431, "the head is larger than 16 KiB"));
  } else if (error == http::error::body_limit) {
    co_await Send(head, TooLarge(head, service_.options().max_body_bytes));
  } else {
    co_await Send(head, PlainAnswer(400, "this is no HTTP/1.1 request: " + error.message()));
  }
  co_await Linger();
  co_return false;
}

awaitable<void> Session::Linger() {
  ErrorCode error;
  stream_.socket().shutdown(stream_protocol::socket::shutdown_send, error);
  stream_.expires_after(kLingerTime);
  std::array<char, 16 << 10> waste;
  while (!error) co_await stream_.async_read_some(asio::buffer(waste), Into(&error));
}

awaitable<bool> Session::Handle(HttpRequest request) {
  if (auto refusal = service_.Refusal(request)) co_return co_await Send(request, *refusal);
  if (request.method == "OPTIONS") co_return co_await Send(request, service_.Answer(request));
  if (IsRpc(request)) co_return co_await Call(request);
  if (request.path() == "/readyz") co_return co_await Readiness(request);
  co_return co_await Send(request, service_.Answer(request));
}

awaitable<bool> Session::Call(const HttpRequest& request) {
  auto read = ReadRpc(request);
  if (auto* refusal = std::get_if<HttpAnswer>(&read)) {
    co_return co_await Send(request, std::move(*refusal));
  }
  const auto& call = std::get<RpcRequest>(read);
  if (call.method->server_streaming()) co_return co_await Streaming(request, call);
  co_return co_await Unary(request, call);
}

std::shared_ptr<RpcCall> Session::StartCall(RpcRequest request) {
  // The guard keeps the threads until gRPC is done with the call.
  auto post = [work = asio::make_work_guard(stream_.get_executor())](std::function<void()> run) {
    asio::post(work.get_executor(), std::move(run));
  };
  return RpcCall::Start(service_.stub(), std::move(request), peer_, std::move(post),
                        [self = weak_from_this()] {
                          if (const auto session = self.lock()) session->wake_.cancel();
                        });
}

void Session::Watch(const std::shared_ptr<RpcCall>& call) {
  const auto look = [self = shared_from_this(), call](ErrorCode error) {
    if (error) return;
    char byte = 0;
    const ssize_t size =
        recv(self->stream_.socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    if (size == 0 || (size < 0 && errno != EAGAIN)) call->Cancel();
  };
  stream_.socket().async_wait(stream_protocol::socket::wait_read, look);
}

awaitable<void> Session::Changed() {
  ErrorCode ignored;
  co_await wake_.async_wait(Into(&ignored));
}

awaitable<std::optional<grpc::ByteBuffer>> Session::Next(RpcCall& call) {
  call.Read();
  for (;;) {
    if (auto message = call.TakeMessage()) co_return message;
    if (call.status()) co_return std::nullopt;
    co_await Changed();
  }
}

// Ends a call when its user is done with it, however that ends.
class Leaving {
 public:
  Leaving(RpcCall& call, Stream& stream) : call_(call), stream_(stream) {}
  ~Leaving() {
    call_.Leave();
    ErrorCode ignored;
    stream_.socket().cancel(ignored);  // Ends Watch.
  }
  Leaving(const Leaving&) = delete;
  Leaving& operator=(const Leaving&) = delete;

 private:
  RpcCall& call_;
  Stream& stream_;
};

awaitable<bool> Session::Unary(const HttpRequest& request, const RpcRequest& asked) {
  HttpAnswer answer;
  {
    const auto call = StartCall(asked);
    const Leaving leaving(*call, stream_);
    Watch(call);
    std::optional<grpc::ByteBuffer> message;
    while (auto next = co_await Next(*call)) message = std::move(next);
    answer = AnswerOf(asked, message ? Flat(*message) : "", *call->status(), call->head(),
                      call->trailers());
  }
  co_return co_await Send(request, std::move(answer));
}

awaitable<bool> Session::Streaming(const HttpRequest& request, const RpcRequest& asked) {
  const auto call = StartCall(asked);
  const Leaving leaving(*call, stream_);
  Watch(call);
  call->Read();
  while (!call->has_head()) co_await Changed();
  HttpAnswer head;
  head.headers = HeadersOf(asked.dialect);
  for (auto& header : ToHeaders(call->head(), "")) head.headers.push_back(std::move(header));
  if (!co_await SendHead(request, std::move(head))) co_return false;
  while (auto message = co_await Next(*call)) {
    const Outgoing outgoing(asked, *std::move(message));
    message.reset();
    if (!co_await SendChunk(outgoing.Parts())) co_return false;
  }
  const std::string end = EndOf(asked.dialect, *call->status(), call->trailers());
  if (!co_await SendChunk(Single(end))) co_return false;
  static const std::string last = "0\r\n\r\n";
  co_return !http11_ || co_await Write(Single(last));
}

awaitable<bool> Session::Readiness(const HttpRequest& request) {
  using grpc::health::v1::HealthCheckResponse;
  HealthCheckResponse health;
  {
    const auto call = StartCall(HealthCheck());
    const Leaving leaving(*call, stream_);
    while (const auto message = co_await Next(*call)) health.ParseFromString(Flat(*message));
  }
  // g++ 12 destroys temporaries of a conditional wrongly beside a co_await.
  HttpAnswer answer = PlainAnswer(503, "not ready");
  if (health.status() == HealthCheckResponse::SERVING) answer = PlainAnswer(200, "ready");
  co_return co_await Send(request, std::move(answer));
}

std::string Session::HeadText(const HttpAnswer& answer) const {
  const auto status = static_cast<http::status>(answer.status);
  const auto reason = answer.status == 499 ? beast::string_view("Client Closed Request")
                                           : http::obsolete_reason(status);
  std::string head = fmt::format("HTTP/1.1 {} {}\r\n", answer.status, Text(reason));
  for (const auto& [name, value] : answer.headers) {
    if (IsFieldValue(value)) head += fmt::format("{}: {}\r\n", name, value);
  }
  if (!keep_alive_) head += "connection: close\r\n";
  if (keep_alive_ && !http11_) head += "connection: keep-alive\r\n";
  return head;
}

awaitable<bool> Session::Send(const HttpRequest& request, HttpAnswer answer) {
  const HttpAnswer full = service_.Complete(request, std::move(answer));
  std::string head = HeadText(full);
  if (full.status != 204 && full.status != 304) {
    head += fmt::format("content-length: {}\r\n", full.body.size());
  }
  head += "\r\n";
  Buffers parts = Single(head);
  if (request.method != "HEAD") parts.push_back(Buffer(full.body));
  co_return co_await Write(std::move(parts));
}

awaitable<bool> Session::SendHead(const HttpRequest& request, HttpAnswer answer) {
  if (!http11_) keep_alive_ = false;  // The end of the connection is the end of the answer.
  const std::string head = HeadText(service_.Complete(request, std::move(answer))) +
                           (http11_ ? "transfer-encoding: chunked\r\n\r\n" : "\r\n");
  co_return co_await Write(Single(head));
}

awaitable<bool> Session::SendChunk(Buffers parts) {
  if (!http11_) co_return co_await Write(std::move(parts));
  static const std::string end = "\r\n";
  const std::string size = fmt::format("{:x}\r\n", asio::buffer_size(parts));
  parts.insert(parts.begin(), Buffer(size));
  parts.push_back(Buffer(end));
  co_return co_await Write(std::move(parts));
}

awaitable<bool> Session::Write(Buffers parts) {
  beast::buffers_suffix<Buffers> rest(std::move(parts));
  ErrorCode error;
  while (!error && asio::buffer_size(rest) > 0) {
    stream_.expires_after(service_.options().stall);
    rest.consume(co_await stream_.async_write_some(rest, Into(&error)));
  }
  stream_.expires_never();
  co_return !error;
}

}  // namespace

void Serve(asio::io_context& io, Service& service, int fd) {
  std::make_shared<Session>(io, service, fd)->Start();
}

}  // namespace contact::gateway
