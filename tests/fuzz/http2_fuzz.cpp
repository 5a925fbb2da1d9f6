// What a client sends over HTTP/2, after the preface: frames, headers, calls, in whatever order.
#include <grpcpp/grpcpp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "gateway/call/service.h"
#include "gateway/http2/connection.h"

namespace {

using namespace contact;

// Knows no method: what matters is before it.
std::shared_ptr<grpc::Channel> Inside() {
  static const std::unique_ptr<grpc::Server> server = grpc::ServerBuilder().BuildAndStart();
  return server->InProcessChannel({});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto service = std::make_shared<gateway::Service>(Inside(), GatewayOptions());
  static gateway::HeldBytes held(64 << 20);
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return 0;
  const FileDescriptor client(ends[0]);
  boost::asio::io_context io{1};
  gateway::Http2Thread thread(io);
  // Half comes at once, half is read; then the client is gone.
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string first = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + bytes.substr(0, size / 2);
  const std::string rest = bytes.substr(size / 2);
  (void)write(client.get(), rest.data(), rest.size());
  shutdown(client.get(), SHUT_WR);
  gateway::Http2Connection::Serve(
      service, held, thread,
      std::make_shared<gateway::Socket>(io, FileDescriptor(ends[1]), nullptr),
      gateway::Peer{"unix:0:1"}, service->connections()->Enter("unix:0"), first);
  io.run();
  if (held.bytes() != 0 || service->connections()->open() != 0) __builtin_trap();
  return 0;
}
