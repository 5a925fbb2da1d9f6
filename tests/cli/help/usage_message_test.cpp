#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <sstream>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/help/manual.h"
#include "cli/help/usage.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A program with a command, a group and the global flags.
class UsageTest : public testing::Test {
 protected:
  UsageTest() {
    AddGlobalFlags(line_);
    CLI::App* run = line_.app().add_subcommand("run", "Run a file");
    run->add_option("FILE", file_, "What to run")->required();
    line_.SetWords(run->add_option("--law", law_, "Which law"), {"EXACT", "FLORES"});
    CLI::App* sweep = line_.app().add_subcommand("sweep", "Run many");
    sweep->require_subcommand(1);
    sweep->add_subcommand("export", "Print the cells");
    // What the manual needs.
    line_.app().footer("0 ok, 1 not.");
    line_.app().add_subcommand("config", "Settings")->footer("Files are read.");
  }

  std::string Message(const std::string& words) {
    try {
      line_.app().parse(words);
    } catch (const CLI::ParseError& error) {
      return UsageMessage(line_.app(), error);
    }
    return "";
  }

  CommandLine line_{"A program."};
  std::string file_, law_;
};

TEST_F(UsageTest, MisspeltCommandComesWithTheNearest) {
  EXPECT_EQ(Message("rnu x"),
            "unknown command 'rnu' — did you mean 'run'?\nSee contactctl --help.");
  EXPECT_EQ(Message("sweep exprot"),
            "unknown command 'exprot' — did you mean 'export'?\nSee contactctl sweep --help.");
  EXPECT_THAT(Message("elephant"), Not(HasSubstr("did you mean")));
}

TEST_F(UsageTest, MisspeltFlagComesWithTheNearestOfItsCommandOrTheGlobalOnes) {
  EXPECT_THAT(Message("run x --lwa EXACT"),
              HasSubstr("unknown flag '--lwa' — did you mean '--law'?"));
  EXPECT_THAT(Message("run x --sever=a:1"), HasSubstr("did you mean '--server'?"));
  EXPECT_THAT(Message("run x --lwa"), HasSubstr("See contactctl run --help."));
}

TEST_F(UsageTest, MisspeltValueComesWithTheNearest) {
  EXPECT_THAT(Message("run x --law FLORIS"),
              AllOf(HasSubstr("FLORIS"), HasSubstr("did you mean 'FLORES'?")));
}

TEST_F(UsageTest, OtherMistakesAreInTheWordsOfTheParser) {
  EXPECT_EQ(Message("run"), "FILE is required\nSee contactctl run --help.");
  EXPECT_THAT(Message("run x y"), Not(HasSubstr("unknown command")));
}

TEST_F(UsageTest, HelpIsThatOfTheCommandNamed) {
  EXPECT_EQ(HelpOf(line_.app(), {}), line_.app().help());
  EXPECT_THAT(HelpOf(line_.app(), {"run"}), AllOf(HasSubstr("Run a file"), HasSubstr("--law")));
  EXPECT_THAT(HelpOf(line_.app(), {"sweep", "export"}), HasSubstr("contactctl sweep export"));
}

TEST_F(UsageTest, HelpOfAnUnknownCommandIsAUsageError) {
  try {
    HelpOf(line_.app(), {"sweep", "exprot"});
    FAIL() << "there is no such command";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_STREQ(failure.what(), "unknown command 'exprot' — did you mean 'export'?");
  }
}

class ManualTest : public UsageTest {
 protected:
  std::string Page(const std::string& name) const {
    std::ifstream file(folder_.path() / (name + ".scd"));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  const ScratchFolder folder_;
};

TEST_F(ManualTest, EachCommandHasAPageWithItsOptions) {
  WriteManual(line_, folder_.path(), "/bin/echo");
  EXPECT_THAT(Page("contactctl.1"), AllOf(HasSubstr("*contactctl-run*(1)"), HasSubstr("--output"),
                                          HasSubstr("Files are read.")));
  EXPECT_THAT(Page("contactctl-run.1"),
              AllOf(HasSubstr("# SYNOPSIS\n\n*contactctl run* [options] _FILE_"),
                    HasSubstr("One of: EXACT,FLORES"), HasSubstr("Which law")));
  EXPECT_THAT(Page("contactctl-sweep.1"), HasSubstr("## contactctl sweep export"));
  EXPECT_THAT(Page("contact-scenario.5"), HasSubstr("*mass\\_kg*"));
}

TEST_F(ManualTest, OptionsOfTheServerAreWhatItPrints) {
  WriteManual(line_, folder_.path(), "/bin/echo");
  EXPECT_THAT(Page("contactd.8"), HasSubstr("```\nUsage: /bin/echo"));
}

TEST_F(ManualTest, ServerThatFailsIsALocalError) {
  try {
    WriteManual(line_, folder_.path(), "/bin/false");
    FAIL() << "false has no help";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kLocal);
  }
}

TEST(WrapHelp, IsTheTextItselfWhereItFits) {
  const std::string help = "Usage: x\n\n  run                         Run a file\n";
  EXPECT_EQ(WrapHelp(help, 0), help);
  EXPECT_EQ(WrapHelp(help, 60), help);
}

TEST(WrapHelp, KeepsWhatANameMeansInItsColumn) {
  EXPECT_EQ(
      WrapHelp("  --law LAW                   Which law of damping it is that is taken\n", 60),
      "  --law LAW                   Which law of damping it is\n"
      "                              that is taken\n");
}

TEST(WrapHelp, NarrowTerminalsHaveItBelowTheName) {
  EXPECT_EQ(
      WrapHelp("  --law LAW:{EXACT,FLORES,HUNT_CROSSLEY,LINEAR} Which law of damping is taken\n",
               40)
          .find("  --law LAW:{EXACT,FLORES,"),
      0U);
  EXPECT_EQ(
      WrapHelp("  --law LAW                   Which law of damping it is that is taken\n", 40),
      "  --law LAW\n"
      "      Which law of damping it is that is\n"
      "      taken\n");
  EXPECT_EQ(WrapHelp("                              Which law of damping is taken\n", 40),
            "      Which law of damping is taken\n");
}

}  // namespace
}  // namespace contact::cli
