#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "cli/text/render_json.h"

namespace contact::cli {
namespace {

TEST(RenderYaml, FieldsKeepTheirOrder) {
  EXPECT_EQ(YamlOfJson(R"({"title": "Two balls", "bodies": [{"name": "B", "mass_kg": 0.5}],
                           "end": 4e-3, "on": true, "none": null, "empty": [], "of": {}})"),
            "title: Two balls\n"
            "bodies:\n"
            "  - name: B\n"
            "    mass_kg: 0.5\n"
            "end: 0.004\n"
            "\"on\": true\n"
            "none: ~\n"
            "empty: []\n"
            "of: {}\n");
}

TEST(RenderYaml, TextsThatLookLikeSomethingElseAreInQuotes) {
  for (const std::string text :
       {"1000", "-1", "0x10", "1e5", ".5", "NaN", "Infinity", "true", "No", "off", "y", "null", "~",
        "", "2026-11-21", "- x", "[a]", "#", "="}) {
    const std::string quoted = fmt::format("\"{}\"", text);
    EXPECT_EQ(YamlOfJson(quoted), fmt::format("{}\n", quoted));
  }
  EXPECT_EQ(YamlOfJson(R"("SUCCEEDED")"), "SUCCEEDED\n");
}

TEST(RenderYaml, NumbersAreNumbersToReadersOfYaml11) {
  EXPECT_EQ(YamlOfJson("[1e-8, 1e300, -2.5e-7, 1E+22, 100, -0.5, 9007199254740993]"),
            "[1.0e-08, 1.0e+300, -2.5e-07, 1.0e+22, 100, -0.5, 9007199254740993]\n");
}

TEST(RenderYaml, AnyTextIsReadBack) {
  for (const std::string text :
       {"a: b", "a #b", "two\nlines", "tab\there", " leading", "trailing ", "it's", "\"quoted\"",
        "back\\slash", "ε = 0.8", "a\x01z", "{a: b}", "${name}", "end:", "a, b", "|", "%x"}) {
    std::string quoted = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c == '\n' ? "\\n" : c == '\t' ? "\\t" : c == '\x01' ? "\\u0001" : std::string(1, c);
    }
    EXPECT_EQ(YAML::Load(YamlOfJson(quoted + "\"")).Scalar(), text);
  }
}

}  // namespace
}  // namespace contact::cli
