// What verbs refuse before they ask a server: no server answers in these tests.

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/base/files.h"
#include "cli/verbs/verb_case.h"
#include "version.h"

namespace contact::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

void ExpectUsage(const std::vector<std::string>& words, const std::string& told) {
  const End end = EndOf(words);
  EXPECT_EQ(end.code, ExitCode::kUsage) << end.told;
  EXPECT_THAT(end.told, HasSubstr(told));
  EXPECT_EQ(end.printed, "");
}

TEST(VerbUsageTest, FormatThatACommandDoesNotPrintIsRefused) {
  ExpectUsage({"list", "-o", "svg"}, "--output svg: this command prints table, json, yaml");
  ExpectUsage({"watch", "x", "-o", "json"}, "this command prints table, jsonl");
  ExpectUsage({"delete", "x", "-o", "json"}, "this command prints table, name");
  ExpectUsage({"export", "x", "-o", "svg"},
              "this command prints jsonl, csv, netcdf, mat, protobuf");
  ExpectUsage({"compare", "x", "y", "-o", "name"}, "this command prints table, json, yaml, csv");
  ExpectUsage({"model", "show", "exact", "-o", "csv"}, "this command prints table, json");
}

TEST(VerbUsageTest, RunTakesExactlyOneScenario) {
  ExpectUsage({"run"}, "give a FILE, --template NAME or --like JOB");
  ExpectUsage({"run", "a.yaml", "-t", "two-balls"}, "one of them");
  ExpectUsage({"run", "-t", "table-3-sweep"}, "contactctl sweep run -t table-3-sweep");
  ExpectUsage({"submit", "-t", "table-3-sweep", "--set", "title=T"}, "--set is for scenarios");
  ExpectUsage({"sweep", "run"}, "give a FILE or --template NAME");
  ExpectUsage({"sweep", "run", "a.yaml", "-t", "table-3-sweep"}, "one of them");
  ExpectUsage({"run", "-t", "tow-balls"}, "did you mean 'two-balls'?");
  ExpectUsage({"run", "-t", "two-balls", "--set", "contacts"}, "--set");
}

TEST(VerbUsageTest, ExportRefusesWhatAFormatCannotHave) {
  ExpectUsage({"export", "x", "-o", "mat"}, "mat is no text; give a file with -f");
  ExpectUsage({"export", "x", "-o", "protobuf"}, "protobuf is no text");
  ExpectUsage({"export", "x", "-f", "x.pb", "--every", "2"}, "protobuf has all that was recorded");
  ExpectUsage({"export", "x", "-f", "x.nc", "--precision", "3"}, "--precision is of csv and jsonl");
  ExpectUsage({"export", "x", "-f", "x.jsonl", "--comments"}, "--comments are of csv");
  ExpectUsage({"export", "x", "--table", "cycles", "--every", "2"}, "are of the series");
  ExpectUsage({"export", "x", "--every", "2", "--max-points", "9"}, "do not go together");
}

TEST(VerbUsageTest, FileOfAnUnknownEndingIsRefusedBeforeAnyWork) {
  ExpectUsage({"export", "x", "-f", "r.h5"},
              "no format has the ending .h5; there are .jsonl, .csv");
  ExpectUsage({"plot", "x", "force", "-f", "x.jpg"},
              "there are .csv, .svg, .png, .pdf, .txt, .eps, .pgf");
  ExpectUsage({"compare", "x", "y", "--plot", "x.bmp"}, "no format has the ending .bmp");
  ExpectUsage({"model", "plot", "alpha", "-f", "a.jpg"}, "no format has the ending .jpg");
}

TEST(VerbUsageTest, FolderThatIsNotThereIsFoundBeforeAnyWork) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"export", "x", "-f", "/nowhere/x.csv"},
        {"plot", "x", "force", "-f", "/nowhere/x.svg"}}) {
    const End end = EndOf(words);
    EXPECT_EQ(end.code, ExitCode::kLocal) << words.front();
    EXPECT_THAT(end.told, HasSubstr("No such file or directory"));
  }
}

TEST(VerbUsageTest, HeatMapThatCannotBeDrawnIsRefusedBeforeTheSweep) {
  const std::string chain = CONTACT_SOURCE_DIR "/client/scenarios/three-ball-chain.yaml";
  const std::string e = "contacts[*].restitution=", v = "bodies[0].velocity_m_per_s=",
                    r = "bodies[0].radius_m=";
  const auto draw = [&](const std::vector<std::string>& grids, const std::string& path) {
    std::vector<std::string> words = {"sweep", "run", chain, "--heatmap", path};
    for (const std::string& grid : grids) words.insert(words.end(), {"--grid", grid});
    return EndOf(words);
  };
  const ScratchFolder folder;
  const std::string map = folder.path() / "map.svg";
  for (const std::vector<std::string>& grids :
       {std::vector<std::string>{e + "0.5:0.9:5", v + "0.1:0.5:5", r + "0.04:0.06:5"},
        {e + "0.5:0.9:101", v + "0.1:0.5:100"}}) {
    const End end = draw(grids, map);
    EXPECT_EQ(end.code, ExitCode::kUsage) << end.told;
    EXPECT_THAT(end.told, HasSubstr("a grid of two axes with at most 10000 cells"));
  }
  const std::vector<std::string> good = {e + "0.5:0.9:100", v + "0.1:0.5:100"};
  EXPECT_EQ(draw(good, "/nowhere/map.svg").code, ExitCode::kLocal);
  for (const char* name : {"map.csv", "map.jpg"}) {
    EXPECT_THAT(draw(good, folder.path() / name).told,
                HasSubstr("drawn as svg, png, pdf, eps or pgf"));
  }
  EXPECT_EQ(draw(good, map).code, ExitCode::kUnreachable) << "nothing is wrong but the server";
}

TEST(VerbUsageTest, WatchRefusesSpeedsAndPlotsThatCannotBe) {
  ExpectUsage({"watch", "x", "--replay", "1e-3x"}, "--replay goes with --plot");
  ExpectUsage({"watch", "x", "--plot", "a", "--replay", "0x"}, "must be a speed > 0");
  ExpectUsage({"watch", "x", "--plot", "a", "--replay", "fast"}, "must be a speed > 0");
}

TEST(VerbUsageTest, StateAndLabelsAreChecked) {
  ExpectUsage({"label", "x"}, "say what to change: KEY=VALUE, KEY- or --note TEXT");
  ExpectUsage({"label", "n=1"}, "give a job to label");
  ExpectUsage({"list", "--state", "runing"}, "did you mean 'RUNNING'?");
  ExpectUsage({"list", "--state", "gone"}, "one of QUEUED, RUNNING, SUCCEEDED, FAILED, CANCELLED");
  ExpectUsage({"list", "--columns", "ownr"}, "there is no column");
  ExpectUsage({"list", "-o", "json", "--columns", "job"}, "--columns");
}

TEST(VerbUsageTest, ServerThatIsNotThereIsCode4) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"list"},
                                                {"describe", "x"},
                                                {"cancel", "x"},
                                                {"plot", "x", "force"},
                                                {"report", "x"},
                                                {"sweep", "cell", "x", "0"},
                                                {"run", "-t", "two-balls"}}) {
    EXPECT_EQ(EndOf(words).code, ExitCode::kUnreachable) << words.front();
  }
}

TEST(VerbUsageTest, TutorialNamesCommandsThatThereAre) {
  const std::string tutorial = EndOf({"help", "tutorial"}).printed;
  std::size_t commands = 0;
  for (std::size_t at = tutorial.find("contactctl "); at != std::string::npos;
       at = tutorial.find("contactctl ", at + 1)) {
    const std::size_t begin = at + std::string("contactctl ").size();
    const std::string verb = tutorial.substr(begin, tutorial.find_first_of(" \n", begin) - begin);
    EXPECT_TRUE(std::ranges::any_of(Verbs(), [&](const Verb& v) { return v.name == verb; }))
        << verb;
    ++commands;
  }
  EXPECT_GT(commands, 5U);
}

TEST(VerbUsageTest, LawsAreShownWithoutAServer) {
  EXPECT_THAT(EndOf({"model", "show", "hunt-crossley"}).printed,
              HasSubstr("In an isolated collision"));
  EXPECT_THAT(EndOf({"model", "list", "-o", "json"}).printed, HasSubstr(R"("law": "EXACT")"));
  EXPECT_THAT(EndOf({"model", "list", "-o", "yaml"}).printed, HasSubstr("law: EXACT"));
  EXPECT_THAT(EndOf({"model", "compare", "exact", "-o", "csv"}).printed,
              testing::StartsWith("law,requested,delivered,miss,method\nEXACT,0.05,"));
  ExpectUsage({"model", "compare", "exact", "--restitution", "0"}, "must be in (0, 1]");
}

TEST(VerbUsageTest, InitWritesAFileOnceUnlessForced) {
  const ScratchFolder folder;
  const std::string path = folder.path() / "mine.yaml";
  EXPECT_EQ(EndOf({"init", "two-balls", "--file", path}).printed, path + "\n");
  EXPECT_EQ(EndOf({"init", "two-balls", "--file", path}).code, ExitCode::kLocal);
  EXPECT_EQ(EndOf({"init", "two-balls", "--file", path, "--force"}).code, ExitCode::kOk);
  EXPECT_THAT(EndOf({"validate", path}).printed, HasSubstr("valid; 2 bodies"));
}

json JsonOf(const End& end) { return json::parse(end.printed); }

TEST(VerbUsageTest, ValidatePrintsWhatAFileHasForPrograms) {
  const std::string folder = CONTACT_SOURCE_DIR "/client/scenarios/";
  const End scenario = EndOf({"validate", folder + "three-ball-chain.yaml", "-o", "json"});
  EXPECT_EQ(scenario.code, ExitCode::kOk);
  EXPECT_EQ(JsonOf(scenario), json({{"file", folder + "three-ball-chain.yaml"},
                                    {"valid", true},
                                    {"errors", json::array()},
                                    {"kind", "scenario"},
                                    {"bodies", 3},
                                    {"contacts", 2},
                                    {"supports", 0},
                                    {"loads", 0},
                                    {"warnings", json::array()}}));
  const json sweep = JsonOf(EndOf({"validate", folder + "table-3-sweep.yaml", "-o", "json"}));
  EXPECT_EQ(sweep["kind"], "sweep");
  EXPECT_EQ(sweep["cells"], 50);
  EXPECT_THAT(EndOf({"validate", folder + "two-balls.yaml", "-o", "yaml"}).printed,
              HasSubstr("\nvalid: true\n"));
}

TEST(VerbUsageTest, ValidateTellsProgramsEachMistakeAndWarningAtItsPlace) {
  const ScratchFolder folder;
  const std::string path = folder.path() / "bad.yaml";
  WriteText("bodies:\n- {name: A, mass_kg: -1}\nend_time_s: 1\n", path);
  const End bad = EndOf({"validate", path, "-o", "json"});
  EXPECT_EQ(bad.code, ExitCode::kInvalidScenario);
  EXPECT_EQ(bad.told, "");
  EXPECT_EQ(JsonOf(bad)["valid"], false);
  const json errors = JsonOf(bad)["errors"];
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0], json({{"file", path},
                             {"line", 2},
                             {"column", 22},
                             {"field", "bodies[0].mass_kg"},
                             {"message", "is -1; must be in (0, 1e12]"},
                             {"hint", ""}}));
  const std::string chain = CONTACT_SOURCE_DIR "/client/scenarios/three-ball-chain.yaml";
  const End warned = EndOf({"validate", chain, "--set", "output.sample_interval_s=1e-3", "--set",
                            "output.samples_per_contact=0", "-o", "json"});
  EXPECT_EQ(warned.code, ExitCode::kOk);
  EXPECT_EQ(warned.said, "") << "the document has it";
  const json warnings = JsonOf(warned)["warnings"];
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0]["field"], "output.sample_interval_s");
  EXPECT_EQ(warnings[0]["line"], nullptr) << "it is not of the file";
}

TEST(VerbUsageTest, ExplainSaysWhatTheContractSays) {
  const End one = EndOf({"explain", "settled"});
  EXPECT_THAT(one.printed,
              testing::StartsWith("SETTLED  (Cycle.Status)\nThe compression work is "));
  const std::string all = EndOf({"explain"}).printed;
  EXPECT_THAT(all,
              testing::StartsWith("Cycle.Kind: How a cycle begins.\n\nCOLLISION  (Cycle.Kind)"));
  EXPECT_THAT(all, HasSubstr("\n\nSolver.RestitutionScope: "));
  const json words = JsonOf(EndOf({"explain", "JUMP", "AUTO", "-o", "json"}));
  ASSERT_EQ(words.size(), 3U);
  EXPECT_EQ(words[2]["of"], "Solver.RestitutionScope");
  ExpectUsage({"explain", "infeasable"}, "did you mean 'INFEASIBLE'?");
}

TEST(VerbUsageTest, VersionIsForProgramsToo) {
  const json version = JsonOf(EndOf({"version", "-o", "json"}));
  EXPECT_EQ(version, json({{"version", kVersion}, {"revision", kRevision}}));
  EXPECT_THAT(EndOf({"version"}).printed, testing::StartsWith("contactctl "));
  ExpectUsage({"version", "-o", "csv"}, "this command prints table, json, yaml");
}

TEST(VerbUsageTest, ConfigRefusesKeysAndValuesThatNoFlagHas) {
  ExpectUsage({"config", "get", "sever"}, "did you mean 'server'?");
  ExpectUsage({"config", "set", "output", "jsn"}, "did you mean 'json'?");
  ExpectUsage({"config", "use", "no such profile"}, "there is no profile 'no such profile'");
}

TEST(VerbUsageTest, ConfigViewTellsTheValueInUse) {
  EXPECT_EQ(EndOf({"config", "get", "server"}).printed, "127.0.0.1:1\n");
  EXPECT_THAT(EndOf({"config", "view", "-o", "json"}).printed, HasSubstr(R"("value": "json")"));
}

}  // namespace
}  // namespace contact::cli
