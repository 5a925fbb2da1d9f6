#include "cli/input/sweep_file.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kBase[] =
    "end_time_s: 4e-3\n"
    "bodies:\n"
    "- {name: A, mass_kg: 0.5, position_m: 0, radius_m: 0.05, velocity_m_per_s: 0.2}\n"
    "- {name: B, mass_kg: 0.5, position_m: 0.1, radius_m: 0.05}\n"
    "contacts:\n"
    "- {between: [A, B], stiffness: 1e10, restitution: 0.8}\n";

class SweepFileTest : public testing::Test {
 protected:
  SweepFileTest() { WriteText(kBase, folder_.path() / "base.yaml"); }

  v1::Sweep Read(const std::string& text, const VariableValues& variables = {}) {
    return ReadSweep(folder_.path() / "sweep.yaml", text, variables);
  }

  std::string Refused(const std::string& text, const VariableValues& variables = {}) {
    try {
      Read(text, variables);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "no failure";
  }

  const TempDirectory folder_;
};

TEST_F(SweepFileTest, BaseIsAFileBesideItOrStandsInIt) {
  const std::string axes = "axes: [{field: 'contacts[0].restitution', values: [0.5, 0.9]}]\n";
  const v1::Sweep beside = Read("base: base.yaml\n" + axes);
  EXPECT_EQ(beside.base().bodies(1).name(), "B");
  std::string inside = "base:\n";
  std::istringstream lines(kBase);
  for (std::string line; std::getline(lines, line);) inside += "  " + line + "\n";
  EXPECT_EQ(Read(inside + axes).SerializeAsString(), beside.SerializeAsString());
}

TEST_F(SweepFileTest, ValuesOfAnEnumMayBeItsWords) {
  const v1::Sweep sweep =
      Read("base: base.yaml\naxes: [{field: solver.phase_split, values: [PEAK_FORCE, 1]}]\n");
  EXPECT_THAT(sweep.axes(0).values(), ElementsAre(v1::Solver::PEAK_FORCE, 1));
  EXPECT_THAT(Refused("base: base.yaml\naxes: [{field: solver.phase_split, values: [PEAK]}]\n"),
              HasSubstr("sweep.yaml:2:45: axes[0].values[0]"));
}

TEST_F(SweepFileTest, MistakesHaveTheirPlaceInTheFileThatHasThem) {
  EXPECT_THAT(Refused("base: base.yaml\naxes:\n- {field: contacts[0].restituton, values: [1]}\n"),
              HasSubstr("sweep.yaml:3:"));
  WriteText("end_time_s: 1\nbodies: [{nam: A}]\n", folder_.path() / "base.yaml");
  EXPECT_THAT(Refused("base: base.yaml\naxes: [{field: end_time_s, values: [1]}]\n"),
              HasSubstr("base.yaml:2:11: bodies[0].nam: unknown field"));
}

TEST_F(SweepFileTest, ABrokenRuleOfTheBaseIsPlacedInTheBase) {
  WriteText(std::string(kBase).replace(std::string(kBase).find("0.5"), 3, "-1."),
            folder_.path() / "base.yaml");
  EXPECT_THAT(Refused("base: base.yaml\naxes: [{field: end_time_s, values: [1]}]\n"),
              HasSubstr("base.yaml:3:22: bodies[0].mass_kg: is -1"));
}

TEST_F(SweepFileTest, WhatIsNoSweepIsTold) {
  EXPECT_THAT(Refused(""), HasSubstr("is empty"));
  EXPECT_THAT(Refused("axes: []\n"), HasSubstr("base: is missing"));
  EXPECT_THAT(Refused("base: [\n"), HasSubstr("malformed YAML"));
  EXPECT_THAT(Refused("base: base.yaml\naxess: []\n"), HasSubstr("did you mean 'axes'?"));
  EXPECT_THAT(Refused("base: none.yaml\n"), HasSubstr("none.yaml: No such file"));
}

TEST_F(SweepFileTest, VariablesGoToTheSweepFirstAndThenToItsBase) {
  WriteText("variables: {end: 1e-3}\n" + std::string(kBase).replace(12, 4, "${end}"),
            folder_.path() / "base.yaml");
  const std::string text =
      "variables: {low: 0.5}\nbase: base.yaml\n"
      "axes: [{field: 'contacts[0].restitution', values: [\"${low}\"]}]\n";
  const v1::Sweep sweep = Read(text, {{"low", "0.6"}, {"end", "3e-3"}});
  EXPECT_THAT(sweep.axes(0).values(), ElementsAre(0.6));
  EXPECT_EQ(sweep.base().end_time_s(), 3e-3);
  EXPECT_THAT(Refused(text, {{"lwo", "1"}}), HasSubstr("unknown variable 'lwo'"));
}

TEST_F(SweepFileTest, AnAxisMayBeAVariableOfTheBase) {
  WriteText("variables: {e: 0.8}\n" +
                std::string(kBase).replace(std::string(kBase).find("0.8"), 3, "\"${e}\""),
            folder_.path() / "base.yaml");
  const std::string axes = "axes: [{field: 'var:e', values: [0.5, 0.9]}]\n";
  const v1::Sweep beside = Read("base: base.yaml\n" + axes);
  EXPECT_EQ(beside.axes(0).field(), "contacts[0].restitution");
  EXPECT_EQ(beside.axes(0).label(), "var:e");
  EXPECT_THAT(beside.axes(0).values(), ElementsAre(0.5, 0.9));
  std::string inside = "variables: {e: 0.8}\nbase:\n";
  std::istringstream lines(
      std::string(kBase).replace(std::string(kBase).find("0.8"), 3, "\"${e}\""));
  for (std::string line; std::getline(lines, line);) inside += "  " + line + "\n";
  EXPECT_EQ(Read(inside + axes).SerializeAsString(), beside.SerializeAsString());
  EXPECT_THAT(Refused("base: base.yaml\naxes: [{field: 'var:f', values: [1]}]\n"),
              HasSubstr("sweep.yaml:2:16: axes[0].field: unknown variable 'f' — there are e"));
}

TEST_F(SweepFileTest, WordsOfAVariableAxisAreThoseOfItsField) {
  WriteText("variables: {law: EXACT}\n" +
                std::string(kBase).replace(std::string(kBase).find("restitution"), 0,
                                           "damping: \"${law}\", "),
            folder_.path() / "base.yaml");
  const v1::Sweep sweep =
      Read("base: base.yaml\naxes: [{field: 'var:law', values: [FLORES, exact]}]\n");
  EXPECT_THAT(sweep.axes(0).values(), ElementsAre(v1::Contact::FLORES, v1::Contact::EXACT));
}

TEST_F(SweepFileTest, BaseOrAxesTellASweepFromAScenario) {
  EXPECT_TRUE(IsSweep("base: a.yaml\n"));
  EXPECT_TRUE(IsSweep("axes: []\n"));
  EXPECT_FALSE(IsSweep(kBase));
  EXPECT_FALSE(IsSweep("- base\n"));
  EXPECT_FALSE(IsSweep("base: [\n"));
  EXPECT_TRUE(IsScenario(kBase));
  EXPECT_FALSE(IsScenario("base: a.yaml\nbodies: []\n"));
  EXPECT_FALSE(IsScenario("metrics: [steps]\n"));
}

}  // namespace
}  // namespace contact::cli
