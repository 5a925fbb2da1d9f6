#include "log.h"

#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace contact {
namespace {

std::string Line(LogFormat format, const std::string& message) {
  std::ostringstream lines;
  spdlog::logger log("test", std::make_shared<spdlog::sinks::ostream_sink_st>(lines));
  SetFormat(format, &log);
  log.info(message);
  return lines.str();
}

TEST(LogTest, JsonHoldsAnyMessageInOneLine) {
  for (const std::string message :
       {"job=jobs/a state=RUNNING", "\"},{\"level\":\"error", "two\nlines\t\\", "100 %v %*"}) {
    const std::string line = Line(LogFormat::kJson, message);
    EXPECT_EQ(line.find('\n'), line.size() - 1);
    const auto object = nlohmann::json::parse(line);
    EXPECT_EQ(object["message"], message);
    EXPECT_EQ(object["level"], "info");
    EXPECT_EQ(object["time"].get<std::string>().at(10), 'T');
    EXPECT_EQ(object.size(), 3U);
  }
  EXPECT_TRUE(nlohmann::json::accept(Line(LogFormat::kJson, "\xff\xfe no UTF-8")));
}

TEST(LogTest, TextIsTimeLevelMessage) {
  EXPECT_TRUE(Line(LogFormat::kText, "as it is").ends_with(" info as it is\n"));
}

}  // namespace
}  // namespace contact
