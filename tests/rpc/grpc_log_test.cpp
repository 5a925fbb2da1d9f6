#include "rpc/grpc_log.h"

#include <gmock/gmock.h>
#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/wrappers.pb.h>
#include <grpc/support/log.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>

namespace contact {
namespace {

TEST(GrpcLogTest, FloodOfLinesIsCutToTenASecondFromEachPlace) {
  std::ostringstream lines;
  const auto before = spdlog::default_logger();
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(lines);
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", sink));
  gpr_log_verbosity_init();  // As gRPC does when it is first used.
  RouteGrpcLog();
  for (int i = 0; i < 1000; ++i) gpr_log(GPR_ERROR, "bad peer");
  gpr_log(GPR_ERROR, "another thing");
  for (int i = 0; i < 1000; ++i) {
    google::protobuf::StringValue text;
    text.ParseFromString("\n\x01\xff");  // Field 1, which is no UTF-8.
  }
  gpr_set_log_function(nullptr);
  google::protobuf::SetLogHandler(nullptr);
  spdlog::set_default_logger(before);

  const std::string text = lines.str();
  EXPECT_THAT(text, testing::HasSubstr("gRPC: bad peer"));
  EXPECT_THAT(text, testing::HasSubstr("gRPC: another thing"));
  EXPECT_THAT(text, testing::HasSubstr("protobuf: String field"));
  // Each loop may see a new second begin, twice on a machine that is very busy.
  EXPECT_LE(std::ranges::count(text, '\n'), 2 * 3 * 11 + 1);
}

}  // namespace
}  // namespace contact
