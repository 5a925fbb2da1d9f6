#include "cli/settings/resolve.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/base/files.h"
#include "cli/settings/command_line.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;

// A line of the global flags and one command, read in a folder of its own without variables.
class ResolveTest : public testing::Test {
 protected:
  ResolveTest() : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder_.path());
    setenv("HOME", folder_.path().c_str(), 1);
    for (const char* name : {"XDG_CONFIG_HOME", "CONTACT_SERVER", "CONTACT_OUTPUT",
                             "CONTACT_PROFILE", "CONTACT_TIMEOUT"}) {
      unsetenv(name);
    }
    AddGlobalFlags(line_);
    line_.app().add_subcommand("list");
  }
  ~ResolveTest() override {
    std::filesystem::current_path(before_);
    for (const char* name :
         {"CONTACT_SERVER", "CONTACT_OUTPUT", "CONTACT_PROFILE", "CONTACT_TIMEOUT"}) {
      unsetenv(name);
    }
  }

  static void WriteHere(const std::string& text) { std::ofstream("contact.toml") << text; }

  const Settings& Resolve(const std::string& words) {
    line_.app().parse(words);
    ResolveSettings(line_.app(), &line_.settings());
    return line_.settings();
  }

  CommandLine line_{"A program."};

 private:
  const ScratchFolder folder_;
  const std::filesystem::path before_;
};

TEST_F(ResolveTest, WithoutAnyPlaceItIsTheDefault) {
  const Settings& settings = Resolve("list");
  EXPECT_EQ(settings.server, "127.0.0.1:7070");
  EXPECT_EQ(settings.output, OutputFormat::kTable);
  EXPECT_TRUE(settings.origins.empty());
  EXPECT_TRUE(settings.problems.empty());
}

TEST_F(ResolveTest, FlagWinsOverVariableAndThatOverTheFile) {
  WriteHere("server = 'file:1'\ntimeout = '3s'\n");
  setenv("CONTACT_SERVER", "variable:1", 1);
  EXPECT_EQ(Resolve("list").server, "variable:1");
  EXPECT_EQ(line_.settings().origins.at("server"), "CONTACT_SERVER");
  EXPECT_EQ(line_.settings().origins.at("timeout"), "contact.toml:2");
  EXPECT_EQ(Resolve("--server flag:1 list").server, "flag:1");
  EXPECT_EQ(line_.settings().origins.at("server"), "--server");
}

TEST_F(ResolveTest, TypedProfileWinsOverVariables) {
  WriteHere("server = 'file:1'\ntimeout = '3s'\n[profile.lab]\nserver = 'lab:1'\n");
  setenv("CONTACT_SERVER", "variable:1", 1);
  setenv("CONTACT_TIMEOUT", "5s", 1);
  EXPECT_EQ(Resolve("--profile lab list").server, "lab:1");
  EXPECT_EQ(line_.settings().origins.at("server"), "contact.toml:4");
  EXPECT_EQ(line_.settings().timeout, "5s") << "of which the profile says nothing";
  EXPECT_EQ(Resolve("--server flag:1 --profile lab list").server, "flag:1");
}

TEST_F(ResolveTest, ProfileOfAVariableOrAFileDoesNotWinOverVariables) {
  WriteHere("use_profile = 'lab'\n[profile.lab]\nserver = 'lab:1'\n");
  setenv("CONTACT_SERVER", "variable:1", 1);
  EXPECT_EQ(Resolve("list").server, "variable:1");
  setenv("CONTACT_PROFILE", "lab", 1);
  EXPECT_EQ(Resolve("list").server, "variable:1");
  unsetenv("CONTACT_SERVER");
  EXPECT_EQ(Resolve("list").server, "lab:1");
}

TEST_F(ResolveTest, EmptyVariableIsNone) {
  setenv("CONTACT_SERVER", "", 1);
  EXPECT_EQ(Resolve("list").server, "127.0.0.1:7070");
}

TEST_F(ResolveTest, OutputOfAFileIsTakenAsAFlagIs) {
  WriteHere("output = 'yaml'\n");
  const Settings& settings = Resolve("list");
  EXPECT_EQ(settings.output, OutputFormat::kJson);
  EXPECT_TRUE(settings.yaml);
}

TEST_F(ResolveTest, ValueThatNoFlagTakesIsAProblemOfItsPlace) {
  setenv("CONTACT_OUTPUT", "tabel", 1);
  const Settings& settings = Resolve("list");
  ASSERT_EQ(settings.problems.size(), 1U);
  EXPECT_EQ(settings.problems.front().code, ExitCode::kUsage);
  EXPECT_THAT(settings.problems.front().text, testing::StartsWith("CONTACT_OUTPUT: "));
  EXPECT_THAT(settings.problems.front().text, HasSubstr("did you mean 'table'?"));
  EXPECT_EQ(settings.output, OutputFormat::kTable);
}

TEST_F(ResolveTest, ProfileOfTheLineGivesTheValues) {
  WriteHere("server = 'out:1'\n[profile.lab]\nserver = 'lab:1'\n");
  EXPECT_EQ(Resolve("--profile lab list").server, "lab:1");
}

TEST_F(ResolveTest, ProfileThatIsNowhereIsAProblem) {
  WriteHere("use_profile = 'lab'\n[profile.home]\nserver = 'home:1'\n");
  const Settings& settings = Resolve("list");
  ASSERT_EQ(settings.problems.size(), 1U);
  EXPECT_EQ(settings.problems.front().text,
            "contact.toml:1: there is no profile 'lab'; there are home");
}

TEST_F(ResolveTest, MistakeInAFileIsAProblemAndTheOthersCount) {
  WriteHere("sever = 'x:1'\n");
  const Settings& settings = Resolve("list");
  ASSERT_EQ(settings.problems.size(), 1U);
  EXPECT_EQ(settings.problems.front().code, ExitCode::kLocal);
}

TEST_F(ResolveTest, KeysAreTheLongNamesOfTheFlags) {
  EXPECT_THAT(ConfigKeys(line_.app()),
              testing::ElementsAre("server", "tls_ca", "cert", "key", "token_file", "output",
                                   "color", "progress", "timeout", "profile"));
  EXPECT_EQ(VariableOf("time_to_live"), "CONTACT_TIME_TO_LIVE");
}

}  // namespace
}  // namespace contact::cli
