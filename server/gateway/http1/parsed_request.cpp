#include "gateway/http1/parsed_request.h"

#include <absl/strings/ascii.h>

#include <string>

namespace contact::gateway {
namespace {

std::string Text(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

HttpRequest HeadOf(const boost::beast::http::request<boost::beast::http::string_body>& message) {
  HttpRequest head{.method = Text(message.method_string()), .target = Text(message.target())};
  for (const auto& field : message) {
    head.headers.emplace_back(absl::AsciiStrToLower(Text(field.name_string())),
                              Text(field.value()));
  }
  return head;
}

}  // namespace contact::gateway
