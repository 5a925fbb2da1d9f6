#include "cli/input/templates.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "cli/input/scenario_file.h"
#include "cli/input/sweep_file.h"
#include "cli/input/yaml_document.h"

namespace contact::cli {
namespace {

const std::filesystem::path kScenarios =
    std::filesystem::path(CONTACT_SOURCE_DIR) / "client" / "scenarios";

bool IsSweep(const std::filesystem::path& file) { return file.stem().string().ends_with("-sweep"); }

TEST(Templates, AreTheShippedScenarios) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kScenarios)) {
    if (entry.path().extension() == ".yaml") files.insert(entry.path().stem());
  }
  std::set<std::string> names;
  for (const Template& scenario : Templates()) {
    names.emplace(scenario.name);
    std::ifstream file(kScenarios / (std::string(scenario.name) + ".yaml"));
    EXPECT_EQ(scenario.text, std::string(std::istreambuf_iterator<char>(file), {}));
  }
  EXPECT_EQ(names, files);
  EXPECT_GE(names.size(), 8);
}

TEST(Templates, ObeyTheRulesAndSayWhatTheyShow) {
  for (const Template& scenario : Templates()) {
    EXPECT_TRUE(scenario.text.starts_with("# ")) << scenario.name;
    EXPECT_NE(scenario.shows, "") << scenario.name;
    if (IsSweep(scenario.name)) continue;
    ScenarioFile file(std::string(scenario.name), std::string(scenario.text));
    file.Check();
    EXPECT_EQ(file.scenario().title(), scenario.shows) << scenario.name;
    for (const Diagnostic& diagnostic : file.diagnostics()) ADD_FAILURE() << Format(diagnostic);
    for (const Diagnostic& advice : file.advice()) ADD_FAILURE() << Format(advice, "warning");
  }
}

TEST(Templates, ShippedSweepsObeyTheRules) {
  int sweeps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenarios)) {
    if (!IsSweep(entry.path())) continue;
    ++sweeps;
    EXPECT_NO_THROW(ReadSweep(entry.path(), ReadYaml(entry.path()))) << entry.path();
  }
  EXPECT_GT(sweeps, 0);
}

}  // namespace
}  // namespace contact::cli
