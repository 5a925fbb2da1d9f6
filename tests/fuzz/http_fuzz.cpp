// Bytes of a connection: each request in them is answered or refused, and a message that was taken
// in JSON can be written as JSON and taken again.
#include <boost/asio/buffer.hpp>
#include <boost/beast/http.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <variant>

#include "contact/v1/job_service.pb.h"
#include "gateway/http1/parsed_request.h"
#include "gateway/protocol/codec.h"
#include "gateway/protocol/origin.h"
#include "gateway/protocol/rpc_request.h"
#include "gateway/protocol/static_files.h"

namespace {

namespace http = boost::beast::http;
using contact::gateway::HttpAnswer;
using contact::gateway::HttpRequest;
using contact::gateway::RpcRequest;

void TryCall(const HttpRequest& request) {
  const auto read = contact::gateway::ReadRpc(request);
  if (const auto* refusal = std::get_if<HttpAnswer>(&read)) {
    if (refusal->status < 200 || refusal->status > 599) std::abort();
    return;
  }
  const auto& call = std::get<RpcRequest>(read);
  if (!call.dialect.json) return;
  const google::protobuf::Descriptor& type = *call.method->input_type();
  std::string json, again;
  if (!contact::gateway::ToJson(type, call.message, &json).ok() ||
      !contact::gateway::FromJson(type, json, &again).ok()) {
    std::abort();
  }
}

void Try(const HttpRequest& request) {
  contact::gateway::Refuse({{"lab.example"}, {"https://app.example"}}, request);
  if (contact::gateway::IsRpc(request)) return TryCall(request);
  static const contact::gateway::StaticFiles files("/usr/include/linux", "");
  const HttpAnswer answer = files.Get(contact::gateway::DashboardFile(request.path()), request);
  if (answer.status != 200 && answer.status != 304 && answer.status != 404) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  contact::v1::GetJobRequest::descriptor();  // The contract is known once it is linked.
  while (size > 0) {
    http::request_parser<http::string_body> parser;
    parser.header_limit(16 << 10);
    parser.body_limit(2 << 20);
    parser.eager(true);
    boost::system::error_code error;
    const std::size_t taken = parser.put(boost::asio::buffer(data, size), error);
    if (error || !parser.is_done() || taken == 0) break;
    HttpRequest request = contact::gateway::HeadOf(parser.get());
    request.body = std::move(parser.get().body());
    Try(request);
    data += taken;
    size -= taken;
  }
  return 0;
}
