#include "gateway/http1/connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

#include "gateway/call/answering.h"
#include "gateway/http1/parsed_request.h"
#include "gateway/protocol/rpc_request.h"

namespace contact::gateway {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using namespace std::chrono_literals;
using std::chrono::steady_clock;
using ErrorCode = beast::error_code;

// For what a client still sends when it is refused, so that it reads the answer.
constexpr auto kLingerTime = 2s;
constexpr std::size_t kMostHeadBytes = 16 << 10;

// True if nobody knows where the body ends.
template <class Parser>
bool IsOfUnknownCoding(const Parser& parser) {
  return parser.get().count(http::field::transfer_encoding) > 0 && !parser.chunked();
}

std::string_view ReasonOf(int status) {
  if (status == 499) return "Client Closed Request";
  const auto reason = http::obsolete_reason(static_cast<http::status>(status));
  return {reason.data(), reason.size()};
}

}  // namespace

Awaitable<void> Http1Connection::Serve(std::shared_ptr<Service> service, HeldBytes& held,
                                       std::shared_ptr<Socket> socket, asio::io_context& io,
                                       Peer peer, std::string_view first) {
  const std::shared_ptr<Http1Connection> self(
      new Http1Connection(std::move(service), held, std::move(socket), io, std::move(peer)));
  self->buffer_.commit(asio::buffer_copy(self->buffer_.prepare(first.size()),
                                         asio::buffer(first.data(), first.size())));
  co_await self->Run();
}

Http1Connection::Http1Connection(std::shared_ptr<Service> service, HeldBytes& held,
                                 std::shared_ptr<Socket> socket, asio::io_context& io, Peer peer)
    : Exchange(io),
      service_(std::move(service)),
      socket_(std::move(socket)),
      peer_(std::move(peer)),
      account_(held, [&io, weak = std::weak_ptr(socket_)] {
        asio::post(io, [weak] {
          if (const auto open = weak.lock()) open->Close();
        });
      }) {}

// g++ 12 destroys temporaries wrongly, or takes both ways, where a co_await stands in a condition
// or beside && and ||: it stands alone here.

Awaitable<void> Http1Connection::Run() {
  for (;;) {
    const std::optional<HttpRequest> request = co_await Read();
    if (!request) break;
    const std::size_t bytes = request->body.size();
    account_.Add(bytes);
    const bool going_on = co_await Answer(*service_, shared_from_this(), *request);
    account_.Sub(bytes);
    if (!going_on) break;
  }
  socket_->Close();
}

Awaitable<bool> Http1Connection::Begin() {
  if (buffer_.size() > 0) co_return true;
  constexpr std::size_t kFirst = 4096;
  const std::size_t size = co_await socket_->ReadSome(
      buffer_.prepare(kFirst).data(), kFirst, steady_clock::now() + service_->options().idle);
  buffer_.commit(size);
  co_return size > 0;
}

Awaitable<ErrorCode> Http1Connection::Parse(Parser& parser, bool all, Time end) {
  constexpr std::size_t kPart = 64 << 10;
  parser.eager(all);
  ErrorCode error;
  for (;;) {
    if (buffer_.size() > 0) buffer_.consume(parser.put(buffer_.data(), error));
    if (error && error != http::error::need_more) co_return error;
    if (all ? parser.is_done() : parser.is_header_done()) co_return ErrorCode();
    const std::size_t size = co_await socket_->ReadSome(buffer_.prepare(kPart).data(), kPart, end);
    if (size == 0) co_return ErrorCode(http::error::partial_message);
    buffer_.commit(size);
  }
}

Awaitable<std::optional<HttpRequest>> Http1Connection::Read() {
  body_.reset();
  if (!keep_alive_) co_return std::nullopt;
  const bool begun = co_await Begin();
  if (!begun) co_return std::nullopt;
  Parser parser;
  parser.header_limit(kMostHeadBytes);
  parser.body_limit(service_->options().max_body_bytes);
  const Time end = steady_clock::now() + service_->options().head;
  ErrorCode error = co_await Parse(parser, false, end);
  if (!error && IsOfUnknownCoding(parser)) error = http::error::bad_transfer_encoding;
  keep_alive_ = !error && parser.get().keep_alive();
  http11_ = parser.get().version() >= 11;
  if (error) {
    co_await Reject(parser, error);
    co_return std::nullopt;
  }
  HttpRequest request = HeadOf(parser.get());
  if (!parser.is_done()) {
    const bool read = co_await ReadBody(parser, request);
    if (!read) co_return std::nullopt;
  }
  request.body = std::move(parser.get().body());
  co_return request;
}

Awaitable<bool> Http1Connection::ReadBody(Parser& parser, const HttpRequest& head) {
  const std::size_t most = service_->options().max_body_bytes;
  const std::size_t size = parser.content_length() ? *parser.content_length() : most;
  body_ = service_->bodies().Take(size);
  if (!body_) {
    co_await Refuse(head, Exhausted(head, 503, "too many large requests at once"));
    co_return false;
  }
  if (beast::iequals(parser.get()[http::field::expect], "100-continue")) {
    const bool sent = co_await Write(Parts(1, "HTTP/1.1 100 Continue\r\n\r\n"));
    if (!sent) co_return false;
  }
  const Time end = steady_clock::now() + service_->options().body;
  const ErrorCode error = co_await Parse(parser, true, end);
  if (error) co_await Reject(parser, error);
  co_return !error;
}

Awaitable<void> Http1Connection::Reject(const Parser& parser, ErrorCode error) {
  const HttpRequest head = HeadOf(parser.get());
  const ErrorCode any = http::make_error_code(http::error::bad_method);
  if (error.category() != any.category() || error == http::error::end_of_stream ||
      error == http::error::partial_message) {
    co_return;  // The client has left, or takes too long.
  }
  HttpAnswer answer = PlainAnswer(400, "this is no HTTP/1.1 request: " + error.message());
  if (error == http::error::header_limit) answer = PlainAnswer(431, "the head is over 16 KiB");
  if (error == http::error::body_limit) {
    const std::size_t most = service_->options().max_body_bytes;
    answer = Exhausted(head, 413, fmt::format("the body is larger than {} bytes", most));
  }
  co_await Refuse(head, std::move(answer));
}

Awaitable<void> Http1Connection::Refuse(const HttpRequest& head, HttpAnswer answer) {
  keep_alive_ = false;
  co_await Send(head, std::move(answer));
  socket_->CloseHalf();
  const Time end = steady_clock::now() + kLingerTime;
  std::array<char, 16 << 10> waste;
  for (std::size_t size = 1; size > 0 && steady_clock::now() < end;) {
    size = co_await socket_->ReadSome(waste.data(), waste.size(), end);
  }
}

std::string Http1Connection::HeadText(const HttpAnswer& answer) const {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\n", answer.status, ReasonOf(answer.status));
  for (const auto& [name, value] : answer.headers) {
    if (IsFieldValue(value)) head += fmt::format("{}: {}\r\n", name, value);
  }
  if (!keep_alive_) head += "connection: close\r\n";
  if (keep_alive_ && !http11_) head += "connection: keep-alive\r\n";
  return head;
}

Awaitable<bool> Http1Connection::Send(const HttpRequest& request, HttpAnswer answer) {
  const Memory::Share room = service_->answers().Take(answer.body.size());
  if (!room) answer = Exhausted(request, 503, kNoRoom);
  const HttpAnswer full = service_->Complete(request, std::move(answer));
  std::string head = HeadText(full);
  if (full.status != 204 && full.status != 304) {
    head += fmt::format("content-length: {}\r\n", full.body.size());
  }
  head += "\r\n";
  Parts parts(1, head);
  if (request.method != "HEAD") parts.emplace_back(full.body);
  account_.Add(full.body.size());
  const bool sent =
      co_await Write(std::move(parts), steady_clock::now() + service_->options().answer);
  account_.Sub(full.body.size());
  co_return sent;
}

Awaitable<bool> Http1Connection::SendHead(const HttpRequest& request, HttpAnswer answer) {
  if (!http11_) keep_alive_ = false;  // The end of the connection is the end of the answer.
  std::string head = HeadText(service_->Complete(request, std::move(answer)));
  head += http11_ ? "transfer-encoding: chunked\r\n\r\n" : "\r\n";
  co_return co_await Write(Parts(1, head));
}

Awaitable<bool> Http1Connection::SendParts(Parts parts) {
  std::size_t bytes = 0;
  for (const std::string_view part : parts) bytes += part.size();
  const std::string size = fmt::format("{:x}\r\n", bytes);
  if (http11_) {
    parts.insert(parts.begin(), size);
    parts.emplace_back("\r\n");
  }
  co_return co_await Write(std::move(parts));
}

Awaitable<bool> Http1Connection::SendEnd(Headers /*trailers*/) {
  if (!http11_) co_return true;
  co_return co_await Write(Parts(1, "0\r\n\r\n"));
}

Awaitable<bool> Http1Connection::Write(Parts parts, Time end) {
  co_return co_await socket_->WriteAll(std::move(parts), service_->options().stall, end);
}

Awaitable<void> Http1Connection::Writable() {
  const Time late = steady_clock::now() + service_->options().stall;
  const bool writable = co_await socket_->Wait(Socket::Handle::wait_write, late);
  if (!writable) left_ = true;
}

void Http1Connection::Watch(Leaving leaving) {
  left_ = false;
  Look(leaving, ++watch_);
}

void Http1Connection::Look(Leaving leaving, int watch) {
  const bool closes = leaving == Leaving::kCloses;
  const auto look = [self = shared_from_this(), leaving, watch](ErrorCode error) {
    if (error || watch != self->watch_) return;
    const auto input = leaving == Leaving::kCloses ? self->socket_->Peek() : Socket::Input::kEnd;
    // What was read before may wake late.
    if (input == Socket::Input::kNothing) return self->Look(leaving, watch);
    if (input == Socket::Input::kBytes) return;  // The next request.
    self->left_ = true;
    self->Wake();
  };
  socket_->handle().async_wait(closes ? Socket::Handle::wait_read : Socket::Handle::wait_error,
                               look);
}

void Http1Connection::Unwatch() {
  ErrorCode ignored;
  ++watch_;
  socket_->handle().cancel(ignored);
}

}  // namespace contact::gateway
