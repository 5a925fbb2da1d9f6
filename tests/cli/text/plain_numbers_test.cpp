#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/text/render_json.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {
namespace {

std::string Plain(std::string_view text) { return WithPlainNumbers(text, *v1::Job::descriptor()); }

TEST(PlainNumbers, WholeNumbersLoseTheirQuotesAtAnyDepth) {
  EXPECT_EQ(Plain(R"({"summary":{"steps":"481"}})"), R"({"summary":{"steps":481}})");
  EXPECT_EQ(Plain(R"({"artifacts":[{"size_bytes":"12"},{"size_bytes":"0"}]})"),
            R"({"artifacts":[{"size_bytes":12},{"size_bytes":0}]})");
  EXPECT_EQ(Plain(R"({"sweep":{"random":{"seed":"7"},"metrics":["12"]}})"),
            R"({"sweep":{"random":{"seed":"7"},"metrics":["12"]}})")
      << "a metric is a text, and Sweep has no field of the name random";
}

TEST(PlainNumbers, TextsThatLookLikeNumbersStayTexts) {
  const std::string text = R"({"name":"12","title":"2.5","labels":{"steps":"481"}})";
  EXPECT_EQ(Plain(text), text);
}

TEST(PlainNumbers, NumbersThatADoubleDoesNotHoldStayTexts) {
  EXPECT_EQ(Plain(R"({"last_sequence":"9007199254740992"})"),
            R"({"last_sequence":9007199254740992})");
  EXPECT_EQ(Plain(R"({"last_sequence":"9007199254740993"})"),
            R"({"last_sequence":"9007199254740993"})");
  EXPECT_EQ(Plain(R"({"last_sequence":"99999999999999999999999"})"),
            R"({"last_sequence":"99999999999999999999999"})");
}

TEST(PlainNumbers, NegativeNumbersAreNumbersToo) {
  EXPECT_EQ(Plain(R"({"summary":{"steps":"-9007199254740992"}})"),
            R"({"summary":{"steps":-9007199254740992}})");
  EXPECT_EQ(Plain(R"({"summary":{"steps":"-"}})"), R"({"summary":{"steps":"-"}})");
}

TEST(PlainNumbers, QuotesAndBracesInTextsDoNotLeadAstray) {
  const std::string title = R"({"title":"a \"}{\\","summary":{"steps":)";
  EXPECT_EQ(Plain(title + R"("3"}})"), title + "3}}");
}

TEST(PlainNumbers, WhitespaceStays) {
  EXPECT_EQ(Plain("{\n \"summary\": {\n  \"steps\": \"3\"\n }\n}\n"),
            "{\n \"summary\": {\n  \"steps\": 3\n }\n}\n");
}

TEST(PlainNumbers, DurationsAreTextsWithTheirUnit) {
  v1::Job job;
  job.mutable_budget()->mutable_wall_time()->set_seconds(3);
  job.mutable_budget()->set_steps(5);
  const nlohmann::json object = nlohmann::json::parse(ToJson(job));
  EXPECT_EQ(object["budget"]["wall_time"], "3s");
  EXPECT_EQ(object["budget"]["steps"], 5);
}

TEST(PlainNumbers, WhatIsPrintedIsWhatProtobufReads) {
  v1::Job job;
  job.set_name("jobs/a");
  job.set_last_sequence(12);
  job.mutable_summary()->set_steps((std::int64_t{1} << 53) + 1);
  job.mutable_summary()->set_iterations(3);
  v1::Job read;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(ToJson(job), &read).ok());
  EXPECT_EQ(read.SerializeAsString(), job.SerializeAsString());
}

}  // namespace
}  // namespace contact::cli
