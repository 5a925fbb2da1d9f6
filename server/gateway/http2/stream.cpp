#include "gateway/http2/stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "gateway/protocol/frames.h"
#include "gateway/protocol/rpc_request.h"

namespace contact::gateway {
namespace {

using std::chrono::steady_clock;

// A head is taken up to the first size, refused up to the second, and ends the connection past it.
constexpr std::size_t kMostHeadBytes = 64 << 10;
constexpr std::size_t kMostIgnoredBytes = 128 << 10;
// Size that HTTP/2 adds to each header (RFC 9113, 6.5.2).
constexpr std::size_t kEntryBytes = 32;
// A body up to this size needs no room of the service's memory; a message of a body that is read
// piece by piece is not larger.
constexpr std::size_t kSmall = 64 << 10;

}  // namespace

Http2Stream::Http2Stream(std::shared_ptr<StreamHost> connection, std::int32_t id)
    : Exchange(connection->io()),
      connection_(std::move(connection)),
      id_(id),
      request_{.http2 = true},
      progress_(steady_clock::now()) {}

const Peer& Http2Stream::peer() const { return connection_->peer(); }

bool Http2Stream::AddHeader(std::string_view name, std::string_view value) {
  head_bytes_ += name.size() + value.size() + kEntryBytes;
  if (head_bytes_ > kMostHeadBytes) return head_bytes_ <= kMostIgnoredBytes;
  if (name == ":method") {
    request_.method = value;
  } else if (name == ":path") {
    request_.target = value;
  } else if (name == ":authority") {
    request_.headers.emplace_back("host", value);
  } else if (!name.starts_with(':')) {
    request_.headers.emplace_back(name, value);
  }
  return true;
}

bool Http2Stream::EndHead() {
  counted_ = head_bytes_;
  connection_->account().Add(counted_);
  if (head_bytes_ > kMostHeadBytes) refusal_ = Exhausted(request_, 431, "the head is over 64 KiB");
  streams_ = IsNative(request_) && !IsRpc(request_);
  return refusal_ || streams_;
}

std::size_t Http2Stream::Expected() const {
  std::size_t bytes = connection_->service().options().max_body_bytes;
  const std::string_view length = request_.header("content-length");
  if (!length.empty()) std::from_chars(length.begin(), length.end(), bytes);
  return length.empty() && IsNative(request_) ? FrameBytes(request_.body) : bytes;
}

std::size_t Http2Stream::AddBody(std::string_view part) {
  if (refusal_ || !open_ || (begun_ && !streams_)) return part.size();
  progress_ = steady_clock::now();
  request_.body += part;
  counted_ += part.size();
  connection_->account().Add(part.size());
  unopened_ += part.size();
  if (streams_) {
    if (request_.body.size() >= 5 && FrameBytes(request_.body) > kSmall) {
      return std::exchange(unopened_, 0);  // NextMessage says so.
    }
    return 0;
  }
  if (request_.body.size() <= kSmall) return 0;
  const std::size_t most = connection_->service().options().max_body_bytes;
  const std::size_t expected = std::max(Expected(), request_.body.size());
  if (expected > most + 5) {
    refusal_ = Exhausted(request_, 413, fmt::format("the body is larger than {} bytes", most));
  } else if (!room_ && !(room_ = connection_->service().bodies().Take(expected))) {
    refusal_ = Exhausted(request_, 503, "too many large requests at once");
  }
  return std::exchange(unopened_, 0);
}

void Http2Stream::EndRequest() {
  request_ended_ = true;
  Wake();
}

std::optional<grpc::ByteBuffer> Http2Stream::NextMessage() {
  std::string& body = request_.body;
  if (body.size() < 5) {
    if (request_ended_) body.clear();  // The client has left within a message.
    return std::nullopt;
  }
  const std::size_t size = FrameBytes(body);
  if (size > kSmall || body[0] != 0) {
    connection_->Reset(id_);
    return std::nullopt;
  }
  if (body.size() < size) {
    if (request_ended_) body.clear();
    return std::nullopt;
  }
  const grpc::Slice slice(body.data() + 5, size - 5);
  body.erase(0, size);
  counted_ -= size;
  connection_->account().Sub(size);
  connection_->OpenWindow(id_, size);
  unopened_ -= std::min(unopened_, size);
  return grpc::ByteBuffer(&slice, 1);
}

void Http2Stream::Submit(const HttpAnswer& answer, bool more) {
  if (open_) connection_->Submit(*this, answer, more);
}

void Http2Stream::Resume() {
  progress_ = steady_clock::now();
  if (open_) connection_->Resume(id_, std::exchange(hungry_, false));
}

Awaitable<bool> Http2Stream::Send(const HttpRequest& request, HttpAnswer answer) {
  const Memory::Share room = connection_->service().answers().Take(answer.body.size());
  if (!room) answer = Exhausted(request, 503, kNoRoom);
  HttpAnswer full = connection_->service().Complete(request, std::move(answer));
  const bool has_body = full.status != 204 && full.status != 304;
  if (has_body && !IsNative(request)) {
    full.headers.emplace_back("content-length", std::to_string(full.body.size()));
  }
  const bool sends_body = has_body && request.method != "HEAD" && !full.body.empty();
  ending_ = true;
  end_ = steady_clock::now() + connection_->service().options().answer;
  progress_ = steady_clock::now();
  if (sends_body) {
    out_ = Parts(1, full.body);
    out_bytes_ = full.body.size();
    trailers_ = std::move(full.trailers);
  }
  connection_->account().Add(out_bytes_);
  const std::size_t held = out_bytes_;
  Submit(full, sends_body);
  const bool sent = co_await AwaitEnd();
  connection_->account().Sub(held);
  co_return sent;
}

Awaitable<bool> Http2Stream::SendHead(const HttpRequest& request, HttpAnswer answer) {
  Submit(connection_->service().Complete(request, std::move(answer)), true);
  co_return open_;
}

Awaitable<bool> Http2Stream::SendParts(Parts parts) {
  out_ = std::move(parts);
  at_ = skip_ = out_bytes_ = 0;
  for (const std::string_view part : out_) out_bytes_ += part.size();
  Resume();
  while (open_ && out_bytes_ > 0) co_await Changed();
  co_return open_;
}

Awaitable<bool> Http2Stream::SendEnd(Headers trailers) {
  trailers_ = std::move(trailers);
  ending_ = true;
  Resume();
  co_return co_await AwaitEnd();
}

Awaitable<bool> Http2Stream::AwaitEnd() {
  while (open_) co_await Changed();
  co_return out_bytes_ == 0;
}

Awaitable<void> Http2Stream::Writable() {
  while (open_ && !hungry_) co_await Changed();
}

std::size_t Http2Stream::Offer(std::size_t most) {
  const std::size_t bytes = std::min(most, out_bytes_);
  if (bytes == 0 && !ending_) {
    hungry_ = true;
    Wake();
  }
  return bytes;
}

void Http2Stream::Move(std::size_t bytes, std::string* out) {
  progress_ = steady_clock::now();
  out_bytes_ -= bytes;
  while (bytes > 0) {
    const std::string_view part = out_[at_].substr(skip_, bytes);
    out->append(part);
    bytes -= part.size();
    skip_ += part.size();
    if (skip_ < out_[at_].size()) continue;
    skip_ = 0;
    ++at_;
  }
  if (out_bytes_ == 0) Wake();
}

void Http2Stream::Close() {
  open_ = false;
  connection_->account().Sub(std::exchange(counted_, 0));
  std::string().swap(request_.body);
  room_.reset();
  Wake();
}

bool Http2Stream::IsStalled(Time now) const {
  const auto& options = connection_->service().options();
  if (!begun_) return now - progress_ > options.body;
  return now > end_ || ((out_bytes_ > 0 || ending_) && now - progress_ > options.stall);
}

}  // namespace contact::gateway
