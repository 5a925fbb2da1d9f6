#include "cli/link/http_get.h"

#include <fmt/format.h>
#include <httplib.h>

#include "cli/base/failure.h"

namespace contact::cli {

std::string HttpGet(const std::string& address, const std::string& path,
                    std::chrono::milliseconds timeout) {
  const std::string server = "http://" + address;
  httplib::Client client(server);
  client.set_connection_timeout(timeout);
  client.set_read_timeout(timeout);
  const auto start = std::chrono::steady_clock::now();
  constexpr std::size_t kMostBytes = 64 << 20;
  std::string body;
  const httplib::Result result = client.Get(path, [&body](const char* data, std::size_t size) {
    body.append(data, size);
    return body.size() <= kMostBytes;
  });
  if (result && result->status == 200) return body;
  const bool late = !result && std::chrono::steady_clock::now() - start >= timeout;
  const std::string why = result ? fmt::format("answers with status {}", result->status)
                                 : to_string(result.error()) + " failed";
  throw Failure(late ? ExitCode::kTimeout : ExitCode::kUnreachable,
                fmt::format("{}{}: {}", server, path, late ? "no answer in time" : why));
}

}  // namespace contact::cli
