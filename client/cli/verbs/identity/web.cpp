#include "cli/verbs/identity/web.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;  // Of an answer.

// Where the path of a URL begins: after scheme and host.
std::size_t PathBegin(const std::string& url) {
  const std::size_t host = url.find("://");
  if (host == std::string::npos) throw Failure(ExitCode::kUsage, url + " is no URL");
  return std::min(url.find('/', host + 3), url.size());
}

}  // namespace

WebAnswer Ask(const std::string& url, const Form* form, const std::string& ca,
              std::chrono::milliseconds timeout) {
  const std::size_t path_begin = PathBegin(url);
  const std::string server = url.substr(0, path_begin);
  const std::string path = path_begin < url.size() ? url.substr(path_begin) : "/";
  httplib::Client client(server);
  if (!client.is_valid()) throw Failure(ExitCode::kUsage, url + " is no http or https URL");
  if (!ca.empty()) client.set_ca_cert_path(ca.c_str());
  client.set_connection_timeout(timeout);
  client.set_read_timeout(timeout);
  std::string text;
  httplib::Request request;
  request.method = form == nullptr ? "GET" : "POST";
  request.path = path;
  if (form != nullptr) {
    request.body = httplib::detail::params_to_query_str({form->begin(), form->end()});
    request.headers = {{"Content-Type", "application/x-www-form-urlencoded"}};
  }
  request.content_receiver = [&text](const char* data, std::size_t size, std::uint64_t /*offset*/,
                                     std::uint64_t /*total*/) {
    text.append(data, size);
    return text.size() <= kMostBytes;
  };
  const httplib::Result result = client.send(request);
  if (!result) {
    const bool long_answer = text.size() > kMostBytes;
    throw Failure(ExitCode::kUnreachable,
                  fmt::format("{}: {}", server,
                              long_answer ? "answers with more than 1 MiB"
                                          : to_string(result.error()) + " failed"));
  }
  auto body = nlohmann::json::parse(text, nullptr, false);
  if (body.is_discarded()) body = nullptr;
  return {result->status, std::move(body)};
}

}  // namespace contact::cli
