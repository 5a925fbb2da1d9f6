#include "cli/verbs/identity/web.h"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

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
  const httplib::Result result =
      form == nullptr ? client.Get(path)
                      : client.Post(path, httplib::Params(form->begin(), form->end()));
  if (!result) {
    throw Failure(ExitCode::kUnreachable,
                  fmt::format("{}: {} failed", server, to_string(result.error())));
  }
  auto body = nlohmann::json::parse(result->body, nullptr, false);
  if (body.is_discarded()) body = nullptr;
  return {result->status, std::move(body)};
}

}  // namespace contact::cli
