#include "gateway/connection.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/buffers_suffix.hpp>
#include <boost/beast/http/read.hpp>
#include <cerrno>
#include <chrono>
#include <utility>

#include "gateway/protocol/parsed_request.h"
#include "gateway/protocol/rpc_request.h"
#include "rpc/net/peer.h"

namespace contact::gateway {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using namespace std::chrono_literals;
using asio::generic::stream_protocol;
using ErrorCode = beast::error_code;
using Buffers = std::vector<asio::const_buffer>;

// For what a client still sends when it is refused, so that it reads the answer.
constexpr auto kLingerTime = 2s;
constexpr std::size_t kMostHeadBytes = 16 << 10;

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

Connection::Connection(asio::io_context& io, Service& service, int fd)
    : service_(service),
      peer_(UriOf(fd)),
      stream_(Stream::socket_type(io.get_executor(), stream_protocol(FamilyOf(fd), 0), fd)) {}

// g++ 12 destroys temporaries wrongly, or takes both ways, where a co_await stands in a condition
// or beside && and ||: it stands alone here.

asio::awaitable<bool> Connection::Begin() {
  if (buffer_.size() > 0) co_return true;
  ErrorCode error;
  stream_.expires_after(service_.options().idle);
  constexpr std::size_t kFirst = 4096;
  const std::size_t size = co_await stream_.async_read_some(buffer_.prepare(kFirst), Into(&error));
  buffer_.commit(size);
  co_return !error;
}

asio::awaitable<std::optional<HttpRequest>> Connection::Read() {
  body_.reset();
  if (!keep_alive_) co_return std::nullopt;
  const bool begun = co_await Begin();
  if (!begun) co_return std::nullopt;
  Parser parser;
  parser.header_limit(kMostHeadBytes);
  parser.body_limit(service_.options().max_body_bytes);
  ErrorCode error;
  stream_.expires_after(service_.options().head);
  co_await http::async_read_header(stream_, buffer_, parser, Into(&error));
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

asio::awaitable<bool> Connection::ReadBody(Parser& parser, const HttpRequest& head) {
  const std::size_t most = service_.options().max_body_bytes;
  const std::size_t size = parser.content_length() ? *parser.content_length() : most;
  body_ = service_.bodies().Take(size);
  if (!body_) {
    co_await Refuse(head, Exhausted(head, 503, "too many large requests at once"));
    co_return false;
  }
  if (beast::iequals(parser.get()[http::field::expect], "100-continue")) {
    const bool sent = co_await Write(Parts(1, "HTTP/1.1 100 Continue\r\n\r\n"));
    if (!sent) co_return false;
  }
  ErrorCode error;
  stream_.expires_after(service_.options().body);
  co_await http::async_read(stream_, buffer_, parser, Into(&error));
  if (error) co_await Reject(parser, error);
  co_return !error;
}

asio::awaitable<void> Connection::Reject(const Parser& parser, ErrorCode error) {
  const HttpRequest head = HeadOf(parser.get());
  const ErrorCode any = http::make_error_code(http::error::bad_method);
  if (error.category() != any.category() || error == http::error::end_of_stream ||
      error == http::error::partial_message) {
    co_return;  // The client has left, or takes too long.
  }
  HttpAnswer answer = PlainAnswer(400, "this is no HTTP/1.1 request: " + error.message());
  if (error == http::error::header_limit) answer = PlainAnswer(431, "the head is over 16 KiB");
  if (error == http::error::body_limit) {
    const std::size_t most = service_.options().max_body_bytes;
    answer = Exhausted(head, 413, fmt::format("the body is larger than {} bytes", most));
  }
  co_await Refuse(head, std::move(answer));
}

asio::awaitable<void> Connection::Refuse(const HttpRequest& head, HttpAnswer answer) {
  keep_alive_ = false;
  co_await Send(head, std::move(answer));
  ErrorCode error;
  stream_.socket().shutdown(stream_protocol::socket::shutdown_send, error);
  stream_.expires_after(kLingerTime);
  std::array<char, 16 << 10> waste;
  while (!error) co_await stream_.async_read_some(asio::buffer(waste), Into(&error));
}

std::string Connection::HeadText(const HttpAnswer& answer) const {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\n", answer.status, ReasonOf(answer.status));
  for (const auto& [name, value] : answer.headers) {
    if (IsFieldValue(value)) head += fmt::format("{}: {}\r\n", name, value);
  }
  if (!keep_alive_) head += "connection: close\r\n";
  if (keep_alive_ && !http11_) head += "connection: keep-alive\r\n";
  return head;
}

asio::awaitable<bool> Connection::Send(const HttpRequest& request, HttpAnswer answer) {
  const Memory::Share room = service_.answers().Take(answer.body.size());
  if (!room) answer = Exhausted(request, 503, kNoRoom);
  const HttpAnswer full = service_.Complete(request, std::move(answer));
  std::string head = HeadText(full);
  if (full.status != 204 && full.status != 304) {
    head += fmt::format("content-length: {}\r\n", full.body.size());
  }
  head += "\r\n";
  Parts parts(1, head);
  if (request.method != "HEAD") parts.emplace_back(full.body);
  co_return co_await Write(std::move(parts),
                           std::chrono::steady_clock::now() + service_.options().answer);
}

asio::awaitable<bool> Connection::SendHead(const HttpRequest& request, HttpAnswer answer) {
  if (!http11_) keep_alive_ = false;  // The end of the connection is the end of the answer.
  std::string head = HeadText(service_.Complete(request, std::move(answer)));
  head += http11_ ? "transfer-encoding: chunked\r\n\r\n" : "\r\n";
  co_return co_await Write(Parts(1, head));
}

asio::awaitable<bool> Connection::SendParts(Parts parts) {
  std::size_t bytes = 0;
  for (const std::string_view part : parts) bytes += part.size();
  const std::string size = fmt::format("{:x}\r\n", bytes);
  if (http11_) {
    parts.insert(parts.begin(), size);
    parts.emplace_back("\r\n");
  }
  co_return co_await Write(std::move(parts));
}

asio::awaitable<bool> Connection::SendEnd() {
  if (!http11_) co_return true;
  co_return co_await Write(Parts(1, "0\r\n\r\n"));
}

asio::awaitable<bool> Connection::Write(Parts parts, Time end) {
  Buffers buffers;
  for (const std::string_view part : parts) buffers.emplace_back(part.data(), part.size());
  beast::buffers_suffix<Buffers> rest(buffers);
  ErrorCode error;
  while (!error && asio::buffer_size(rest) > 0) {
    stream_.expires_at(std::min(std::chrono::steady_clock::now() + service_.options().stall, end));
    const std::size_t size = co_await stream_.async_write_some(rest, Into(&error));
    rest.consume(size);
  }
  stream_.expires_never();
  co_return !error;
}

asio::awaitable<void> Connection::Writable() {
  ErrorCode ignored;
  co_await stream_.socket().async_wait(stream_protocol::socket::wait_write, Into(&ignored));
}

bool Connection::Closed() {
  char byte = 0;
  const ssize_t size = recv(stream_.socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return size == 0 || (size < 0 && errno != EAGAIN);
}

void Connection::Watch(Leaving leaving, std::function<void()> left) {
  using Socket = stream_protocol::socket;
  const bool closes = leaving == Leaving::kCloses;
  const auto look = [this, closes, left = std::move(left)](ErrorCode error) {
    if (!error && (!closes || Closed())) left();
  };
  stream_.socket().async_wait(closes ? Socket::wait_read : Socket::wait_error, look);
}

void Connection::Unwatch() {
  ErrorCode ignored;
  stream_.socket().cancel(ignored);
}

void Connection::Close() {
  ErrorCode ignored;
  stream_.socket().shutdown(stream_protocol::socket::shutdown_both, ignored);
}

}  // namespace contact::gateway
