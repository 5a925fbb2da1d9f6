#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/base/files.h"
#include "cli/help/candidates.h"
#include "cli/help/completion.h"

namespace contact::cli {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

// A small program, whose server does not answer.
class CompleteTest : public testing::Test {
 protected:
  CompleteTest() {
    AddGlobalFlags(line_);
    line_.settings().server = "127.0.0.1:1";
    AddRun(*line_.app().add_subcommand("run", "Run it"));
    AddList(*line_.app().add_subcommand("list", "List them"));
    CLI::App* group = line_.app().add_subcommand("sweep", "Many of them");
    group->add_subcommand("run", "Run many");
    group->add_subcommand("remove", "Remove many");
    line_.app().add_subcommand("__hidden", "")->group("");
  }

  void AddRun(CLI::App& run) {
    line_.SetKind(run.add_option("FILE", text_, "A file"), ValueKind::kScenarioFile);
    line_.SetKind(run.add_option("--set", texts_, "A field"), ValueKind::kAssignment);
    line_.SetKind(run.add_option("--law", text_, "A law"), ValueKind::kLaw);
    line_.SetKind(run.add_option("--keep", text_, "A folder"), ValueKind::kDirectory);
    line_.SetKind(run.add_option("--to", text_, "A file"), ValueKind::kFile);
    run.add_option("--title", text_, "Anything\nand more");
  }

  void AddList(CLI::App& list) {
    line_.SetKind(list.add_option("--kinds", texts_, "Kinds")->delimiter(','),
                  ValueKind::kEventKind);
    line_.SetKind(list.add_option("JOB", texts_, "Jobs"), ValueKind::kJob);
    line_.SetKind(list.add_option("--key", text_, "A key"), ValueKind::kConfigKey);
    line_.SetKind(list.add_option("--state", text_, "A state"), ValueKind::kState);
    line_.SetKind(list.add_option("--item", text_, "An item"), ValueKind::kPaperItem);
    line_.SetKind(list.add_option("--template", text_, "A scenario"), ValueKind::kTemplate);
    line_.SetKind(list.add_option("--command", text_, "A command"), ValueKind::kCommand);
  }

  // What is offered, without what it is; `rule_` becomes the last line.
  std::vector<std::string> Offered(const std::vector<std::string>& words) {
    std::istringstream lines(Complete(line_, words));
    std::vector<std::string> offered;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(":")) {
        rule_ = line;
      } else {
        offered.push_back(line.substr(0, line.find('\t')));
      }
    }
    return offered;
  }

  CommandLine line_{"A program."};
  std::string rule_;

 private:
  std::string text_;
  std::vector<std::string> texts_;
};

TEST_F(CompleteTest, FirstWordIsAVerbThatHelpShows) {
  EXPECT_THAT(Offered({""}), UnorderedElementsAre("run", "list", "sweep"));
  EXPECT_THAT(Offered({"r"}), ElementsAre("run"));
  EXPECT_THAT(Offered({"sweep", "r"}), ElementsAre("run", "remove"));
  EXPECT_EQ(rule_, ":none");
}

TEST_F(CompleteTest, CandidateComesWithTheFirstLineOfItsHelp) {
  EXPECT_EQ(Complete(line_, {"ru"}), "run\tRun it\n:none\n");
  EXPECT_EQ(Complete(line_, {"run", "--tit"}), "--title\tAnything\n:none\n");
}

TEST_F(CompleteTest, FlagsAreThoseOfTheCommandAndTheGlobalOnes) {
  EXPECT_THAT(Offered({"run", "--"}), IsSupersetOf({"--set", "--law", "--output", "--server"}));
  EXPECT_THAT(Offered({"list", "--l"}), IsEmpty());
}

TEST_F(CompleteTest, NoWordAtAllHasNoCandidates) {
  EXPECT_THAT(Offered({}), IsEmpty());
  EXPECT_EQ(rule_, ":none");
}

TEST_F(CompleteTest, ValuesFollowTheirKind) {
  EXPECT_THAT(Offered({"run", "--law", "hunt"}), ElementsAre("hunt-crossley"));
  EXPECT_THAT(Offered({"list", "--state", "SU"}), ElementsAre("SUCCEEDED"));
  EXPECT_THAT(Offered({"list", "--key", "ser"}), ElementsAre("server"));
  EXPECT_THAT(Offered({"list", "--item", "al"}), ElementsAre("all"));
  EXPECT_THAT(Offered({"list", "--template", "three"}), ElementsAre("three-ball-chain"));
  EXPECT_THAT(Offered({"list", "--command", ""}), IsSupersetOf({"run", "list", "tutorial"}));
  EXPECT_THAT(Offered({"run", "--title", ""}), IsEmpty());
}

TEST_F(CompleteTest, WordsOfAFlagAreOfferedAfterASpaceOrAnEqualsSign) {
  EXPECT_THAT(Offered({"list", "-o", "js"}), ElementsAre("json", "jsonl"));
  EXPECT_THAT(Offered({"list", "--output=net"}), ElementsAre("--output=netcdf"));
  EXPECT_THAT(Offered({"list", "--output", "=", "net"}), ElementsAre("netcdf"));
  EXPECT_THAT(Offered({"list", "--nonsense=x"}), IsEmpty());
}

TEST_F(CompleteTest, FilesAreTheAffairOfTheShell) {
  Offered({"run", ""});
  EXPECT_EQ(rule_, ":scenarios");
  Offered({"run", "--to", ""});
  EXPECT_EQ(rule_, ":files");
  Offered({"run", "--keep", ""});
  EXPECT_EQ(rule_, ":directories");
}

TEST_F(CompleteTest, ListGoesOnAndRepeatsNoEntry) {
  EXPECT_THAT(Offered({"list", "--kinds", "cycle,progr"}), ElementsAre("cycle,progress"));
  EXPECT_EQ(rule_, ":nospace");
  EXPECT_THAT(Offered({"list", "--kinds", "cycle,"}), testing::Not(Contains("cycle,cycle")));
}

TEST_F(CompleteTest, FieldsAreThoseOfTheFileThatStandsBefore) {
  const ScratchFolder folder;
  const std::string path = folder.path() / "chain.yaml";
  std::ofstream(path) << "bodies: [{name: A, mass_kg: 1}, {name: B, mass_kg: 1}]\n"
                         "contacts: [{between: [A, B], stiffness: 1}]\nend_time_s: 1\n";
  EXPECT_THAT(Offered({"run", path, "--set", "bodies[1].ma"}), ElementsAre("bodies[1].mass_kg="));
  EXPECT_EQ(rule_, ":nospace");
  EXPECT_THAT(Offered({"run", path, "--set", "bodies[2].ma"}), IsEmpty());
  EXPECT_THAT(Offered({"run", path, "--set", "solver.tension=C"}),
              ElementsAre("solver.tension=CLIP"));
  EXPECT_THAT(Offered({"run", path, "--set", "solver.tension", "=", "C"}), ElementsAre("CLIP"));
}

TEST_F(CompleteTest, FileThatCannotBeReadLeavesTheFieldsOfAnyScenario) {
  const ScratchFolder folder;
  const std::string path = folder.path() / "broken.yaml";
  std::ofstream(path) << "bodies: [";
  EXPECT_THAT(Offered({"run", path, "--set", "bodies[*].ma"}), ElementsAre("bodies[*].mass_kg="));
}

TEST_F(CompleteTest, WithoutAServerThereAreNoJobs) {
  EXPECT_THAT(Offered({"list", ""}), IsEmpty());
  EXPECT_THAT(Offered({"--server", "no address", "list", ""}), IsEmpty());
}

TEST(ShellScriptsTest, EachScriptAsksTheProgram) {
  std::vector<std::string_view> shells;
  for (const ShellScript& script : ShellScripts()) {
    shells.push_back(script.shell);
    EXPECT_NE(script.text.find("__complete"), std::string_view::npos) << script.shell;
    EXPECT_TRUE(script.text.ends_with("\n")) << script.shell;
  }
  EXPECT_THAT(shells, ElementsAre("bash", "zsh", "fish"));
}

}  // namespace
}  // namespace contact::cli
