#include "cli/verbs/verbs.h"

#include <gmock/gmock.h>

#include <cctype>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

namespace contact::cli {
namespace {

using testing::HasSubstr;

class VerbsTest : public testing::Test {
 protected:
  VerbsTest() {
    AddGlobalFlags(line_);
    AddVerbs(line_);
  }

  // Calls `look` with each command and its full name, such as `sweep run`.
  void ForEachCommand(const std::function<void(const CLI::App&, const std::string&)>& look) const {
    ForEachBelow(line_.app(), "", look);
  }

  static void ForEachBelow(const CLI::App& app, const std::string& before,
                           const std::function<void(const CLI::App&, const std::string&)>& look) {
    for (const CLI::App* command : app.get_subcommands({})) {
      const std::string name = before + command->get_name();
      look(*command, name);
      ForEachBelow(*command, name + " ", look);
    }
  }

  CommandLine line_{"A program."};
};

TEST_F(VerbsTest, EachVerbIsACommandOfItsNameOnce) {
  std::set<std::string_view> names;
  for (const Verb& verb : Verbs()) {
    EXPECT_TRUE(names.insert(verb.name).second) << verb.name;
    EXPECT_EQ(line_.app().get_subcommand(std::string(verb.name))->get_description(), verb.about);
  }
  EXPECT_EQ(line_.app().get_subcommands({}).size(), names.size());
}

TEST_F(VerbsTest, EachVerbIsInTheReadme) {
  std::ifstream file(CONTACT_SOURCE_DIR "/client/README.md");
  std::ostringstream text;
  text << file.rdbuf();
  for (const Verb& verb : Verbs()) {
    const std::string name(verb.name);
    EXPECT_THAT(text.str(), testing::AnyOf(HasSubstr("`" + name + "`"), HasSubstr("`" + name + " "),
                                           HasSubstr("contactctl " + name)));
  }
}

TEST_F(VerbsTest, EachCommandIsDescribedByAPhrase) {
  ForEachCommand([](const CLI::App& command, const std::string& name) {
    const std::string about = command.get_description();
    ASSERT_FALSE(about.empty()) << name;
    EXPECT_TRUE(std::isupper(static_cast<unsigned char>(about.front()))) << name;
    EXPECT_NE(about.back(), '.') << name;
  });
}

TEST_F(VerbsTest, EachOptionIsDescribed) {
  ForEachCommand([](const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
      const bool shown = option->get_positional() || !option->get_group().empty();
      EXPECT_TRUE(!shown || !option->get_description().empty()) << name << option->get_name();
    }
  });
}

TEST_F(VerbsTest, OptionWithThePlaceholderOfAKindHasTheKind) {
  ForEachCommand([this](const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
      const std::string word =
          option->get_positional() ? option->get_name() : option->get_type_name();
      for (const char* known : {"JOB", "FILE", "DIR", "TEMPLATE", "LAW", "METRIC", "KEY", "PROFILE",
                                "ARTIFACT", "STATE", "ITEM", "FIELD=VALUE", "NAME"}) {
        if (word == known || word == known + std::string(",…")) {
          EXPECT_NE(line_.KindOf(*option), ValueKind::kAny) << name << " " << word;
        }
      }
    }
  });
}

TEST_F(VerbsTest, ShownFlagMeansOneThingEverywhere) {
  ForEachCommand([](const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
      const bool output = option->check_sname("o") || option->check_lname("output");
      EXPECT_TRUE(!output || option->get_group().empty()) << name << " shows -o of its own";
    }
  });
}

TEST_F(VerbsTest, VerbsThatMendSettingsDoNotNeedThem) {
  for (const auto& [words, needed] : {std::pair("config view", false),
                                      {"version", false},
                                      {"help", false},
                                      {"schema", false},
                                      {"completion bash", false},
                                      {"doctor", false},
                                      {"list", true},
                                      {"sweep watch x", true}}) {
    line_.app().parse(words);
    EXPECT_EQ(NeedsSettings(line_.app()), needed) << words;
  }
}

}  // namespace
}  // namespace contact::cli
