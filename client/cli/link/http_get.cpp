#include "cli/link/http_get.h"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_future.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <utility>  // Boost 1.74 wants it before its own.

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

// Runs one asynchronous operation to its end: only these can have a time limit.
template <class Begin>
void Await(asio::io_context& io, Begin begin) {
  auto result = begin(asio::use_future);
  io.restart();
  io.run();
  result.get();
}

http::response<http::string_body> Ask(const std::string& address, const std::string& path,
                                      std::chrono::milliseconds timeout) {
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  const std::string port = colon == std::string::npos ? "80" : address.substr(colon + 1);
  asio::io_context io;
  const auto places = asio::ip::tcp::resolver(io).resolve(host, port);
  beast::tcp_stream stream(io);
  stream.expires_after(timeout);
  Await(io, [&](auto token) { return stream.async_connect(places, token); });
  http::request<http::empty_body> request(http::verb::get, path, 11);
  request.set(http::field::host, address);
  Await(io, [&](auto token) { return http::async_write(stream, request, token); });
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  Await(io, [&](auto token) { return http::async_read(stream, buffer, response, token); });
  return response;
}

}  // namespace

std::string HttpGet(const std::string& address, const std::string& path,
                    std::chrono::milliseconds timeout) {
  const std::string url = fmt::format("http://{}{}", address, path);
  try {
    http::response<http::string_body> response = Ask(address, path, timeout);
    if (response.result() == http::status::ok) return std::move(response.body());
    throw Failure(ExitCode::kUnreachable,
                  fmt::format("{}: answers with status {}", url, response.result_int()));
  } catch (const boost::system::system_error& error) {
    if (error.code() == beast::error::timeout) {
      throw Failure(ExitCode::kTimeout, fmt::format("{}: no answer in time", url));
    }
    throw Failure(ExitCode::kUnreachable, fmt::format("{}: {}", url, error.code().message()));
  }
}

}  // namespace contact::cli
