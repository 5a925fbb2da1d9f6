#include "cli/settings/command_line.h"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Arguments {
  std::string path = "unset";
};

ExitCode Differ(const Arguments& arguments, const Settings& settings) {
  return arguments.path == "a" && settings.server == "b:1" ? ExitCode::kDiffers : ExitCode::kOk;
}

// What the parser says about a line; empty if it takes it.
std::string Mistake(CommandLine& line, const std::string& words) {
  try {
    line.app().parse(words);
    return "";
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
}

TEST(CommandLineTest, ActionHasTheArgumentsAndTheSettings) {
  CommandLine line("A program.");
  AddGlobalFlags(line);
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = line.app().add_subcommand("act");
  command->add_option("--path", arguments->path);
  line.SetAction(*command, arguments, Differ);
  line.app().parse("act --path a --server b:1");
  ASSERT_TRUE(line.action());
  EXPECT_EQ(line.action()(), ExitCode::kDiffers);
}

TEST(CommandLineTest, LineWithoutACommandHasNoAction) {
  CommandLine line("A program.");
  line.SetAction(*line.app().add_subcommand("act"), [] { return ExitCode::kOk; });
  line.app().parse("");
  EXPECT_FALSE(line.action());
}

TEST(CommandLineTest, KindNamesThePlaceholderOfAFlag) {
  CommandLine line("A program.");
  std::vector<std::string> names;
  CLI::Option* flag =
      line.SetKind(line.app().add_option("--plot", names)->delimiter(','), ValueKind::kChannel);
  CLI::Option* positional = line.SetKind(line.app().add_option("THING", names), ValueKind::kJob);
  EXPECT_EQ(line.KindOf(*flag), ValueKind::kChannel);
  EXPECT_EQ(flag->get_type_name(), "NAME,…");
  EXPECT_TRUE(IsList(*flag));
  EXPECT_EQ(positional->get_name(), "THING");
  EXPECT_FALSE(IsList(*positional));
}

TEST(CommandLineTest, OptionWithoutKindMayBeAnything) {
  CommandLine line("A program.");
  std::string text;
  const CLI::Option* option = line.app().add_option("--title", text);
  EXPECT_EQ(line.KindOf(*option), ValueKind::kAny);
  EXPECT_TRUE(line.WordsOf(*option).empty());
}

TEST(CommandLineTest, WordThatIsNotAmongTheWordsIsRefusedWithTheNearest) {
  CommandLine line("A program.");
  std::string word;
  const CLI::Option* option =
      line.SetWords(line.app().add_option("--color", word), {"auto", "always", "never"});
  EXPECT_THAT(line.WordsOf(*option), ElementsAre("auto", "always", "never"));
  EXPECT_EQ(Mistake(line, "--color never"), "");
  EXPECT_EQ(word, "never");
  EXPECT_THAT(Mistake(line, "--color nevr"), HasSubstr("did you mean 'never'?"));
  EXPECT_THAT(Mistake(line, "--color green"),
              testing::AllOf(HasSubstr("{auto,always,never}"), Not(HasSubstr("did you mean"))));
}

TEST(CommandLineTest, SuggestedWordsAreNotTheOnlyOnes) {
  CommandLine line("A program.");
  std::string word;
  const CLI::Option* option =
      line.SuggestWords(line.app().add_option("--columns", word), {"job", "state"});
  EXPECT_EQ(Mistake(line, "--columns axis"), "");
  EXPECT_EQ(word, "axis");
  EXPECT_THAT(line.WordsOf(*option), ElementsAre("job", "state"));
  EXPECT_THAT(line.app().help(), HasSubstr("{job,state}"));
}

TEST(GlobalFlagsTest, EveryFormatMayFollowOutput) {
  for (const FormatInfo& info : Formats()) {
    CommandLine line("A program.");
    AddGlobalFlags(line);
    EXPECT_EQ(Mistake(line, "-o " + std::string(info.name)), "") << info.name;
    EXPECT_THAT(line.app().help(), HasSubstr(std::string(info.name)));
  }
}

TEST(GlobalFlagsTest, MisspeltFormatIsRefused) {
  CommandLine line("A program.");
  AddGlobalFlags(line);
  EXPECT_THAT(Mistake(line, "-o jsn"), HasSubstr("did you mean 'json'?"));
}

// A command with a destination beside the global -o.
class DestinationTest : public testing::Test {
 protected:
  DestinationTest() {
    AddGlobalFlags(line_);
    CLI::App* command = line_.app().add_subcommand("report");
    AddDestination(line_, *command, "-f,--file", &path_, "Where to");
  }

  CommandLine line_{"A program."};
  std::string path_ = "report.html";
};

TEST_F(DestinationTest, EverySpellingNamesTheFile) {
  for (const char* words :
       {"report -f a.html", "report --file a.html", "report -o a.html", "report --file=a.html"}) {
    path_.clear();
    EXPECT_EQ(Mistake(line_, words), "") << words;
    EXPECT_EQ(path_, "a.html") << words;
  }
  EXPECT_EQ(line_.settings().output, OutputFormat::kTable);
}

TEST_F(DestinationTest, WithoutAFlagThePathIsAsItWas) {
  EXPECT_EQ(Mistake(line_, "report"), "");
  EXPECT_EQ(path_, "report.html");
}

TEST_F(DestinationTest, FormatIsNoFile) {
  EXPECT_THAT(Mistake(line_, "report -o json"),
              HasSubstr("report prints no json; --file says where to write"));
}

TEST_F(DestinationTest, TwoFilesAreOneTooMany) {
  EXPECT_NE(Mistake(line_, "report -o a.html -f b.html"), "");
}

TEST_F(DestinationTest, HelpShowsOnlyTheSpellingThatMeansAFileEverywhere) {
  const std::string help = line_.app().get_subcommand("report")->help();
  EXPECT_THAT(help, HasSubstr("-f,--file FILE"));
  EXPECT_THAT(help, Not(HasSubstr("-o")));
}

// A command that draws.
class FigureFileTest : public testing::Test {
 protected:
  FigureFileTest() {
    AddGlobalFlags(line_);
    AddFigureFile(line_, *line_.app().add_subcommand("plot"), &path_, "Where to");
  }

  CommandLine line_{"A program."};
  std::string path_;
};

TEST_F(FigureFileTest, OutputTakesAFormatOrAFile) {
  EXPECT_EQ(Mistake(line_, "plot -o pgf -f fig.dat"), "");
  EXPECT_EQ(line_.settings().output, OutputFormat::kPgf);
  EXPECT_EQ(path_, "fig.dat");
  EXPECT_GT(line_.app().get_option("--output")->count(), 0U);  // So no variable takes its place.
}

TEST_F(FigureFileTest, FileAfterOutputIsThatOfTheFlagForFiles) {
  for (const char* words : {"plot -o fig.pdf", "plot --output fig.pdf", "plot -f fig.pdf"}) {
    path_.clear();
    EXPECT_EQ(Mistake(line_, words), "") << words;
    EXPECT_EQ(path_, "fig.pdf") << words;
    EXPECT_EQ(line_.settings().output, OutputFormat::kTable) << words;
  }
}

TEST_F(FigureFileTest, WhatIsNeitherIsRefusedWithTheNearest) {
  EXPECT_THAT(Mistake(line_, "plot -o fig.jpg"), HasSubstr("fig.jpg is neither"));
  EXPECT_THAT(Mistake(line_, "plot -o pngg"), HasSubstr("did you mean 'png'?"));
  EXPECT_NE(Mistake(line_, "plot -o a.svg -f b.svg"), "");
}

TEST_F(DestinationTest, OfAnotherCommandOutputIsTheFormat) {
  line_.app().add_subcommand("list");
  EXPECT_EQ(Mistake(line_, "list -o json"), "");
  EXPECT_EQ(line_.settings().output, OutputFormat::kJson);
}

TEST(GivenFlags, AreThoseOfTheLineAsWordsOfALine) {
  CommandLine line("A program.");
  CLI::App& plot = *line.app().add_subcommand("plot");
  plot.add_option("--unit")->delimiter(',')->take_all();
  plot.add_option("--from");
  plot.add_option("--size");
  plot.add_flag("--log");
  plot.add_flag("--no-title");
  line.app().parse("plot --unit ms,kN --from -1e-3 --log");
  EXPECT_THAT(GivenFlags(plot, {"--from", "--unit", "--size", "--log", "--no-title"}),
              testing::ElementsAre("--from=-1e-3", "--unit=ms", "--unit=kN", "--log"));
}

}  // namespace
}  // namespace contact::cli
