#include "cli/input/variables.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/input/scenario_file.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kBall[] =
    "variables: {e: 0.8, name: ball, side: left, steps: 1e6, free: true}\n"
    "title: ε is ${e} of ${name}\n"
    "bodies:\n"
    "  - {name: \"${name}\", mass_kg: 1}\n"
    "contacts:\n"
    "  - between: [\"${name}\"]\n"
    "    wall: {side: \"${side}\"}\n"
    "    restitution: ${e}\n"
    "solver: {max_steps: \"${steps}\"}\n"
    "output: {ledger_only: \"${free}\"}\n";

std::vector<std::string> Mistakes(const ScenarioFile& file) {
  std::vector<std::string> lines;
  for (const Diagnostic& mistake : file.diagnostics()) lines.push_back(Format(mistake));
  return lines;
}

std::string UsageOf(const std::string& text, const VariableValues& given) {
  try {
    const ScenarioFile file("f", text, given);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    return failure.what();
  }
  return "";
}

TEST(Variables, StandForValuesOfTheTypeOfTheirField) {
  const ScenarioFile file("f", kBall);
  EXPECT_THAT(Mistakes(file), IsEmpty());
  EXPECT_EQ(file.scenario().title(), "ε is 0.8 of ball");
  EXPECT_EQ(file.scenario().bodies(0).name(), "ball");
  EXPECT_EQ(file.scenario().contacts(0).between(0), "ball");
  EXPECT_EQ(file.scenario().contacts(0).wall().side(), v1::Wall::LEFT);
  EXPECT_EQ(file.scenario().contacts(0).restitution(), 0.8);
  EXPECT_EQ(file.scenario().solver().max_steps(), 1'000'000);
  EXPECT_TRUE(file.scenario().output().ledger_only());
}

TEST(Variables, GivenValuesReplaceThoseOfTheFile) {
  const ScenarioFile file("f", kBall, {{"e", "0.5"}, {"name", "B"}});
  EXPECT_EQ(file.scenario().contacts(0).restitution(), 0.5);
  EXPECT_EQ(file.scenario().bodies(0).name(), "B");
  EXPECT_EQ(file.scenario().title(), "ε is 0.5 of B");
}

TEST(Variables, ValueThatDoesNotFitIsToldWhereItIsUsed) {
  EXPECT_THAT(Mistakes(ScenarioFile("f", kBall, {{"e", "much"}})),
              ElementsAre("f:8:18: contacts[0].restitution: expected a number, got 'much'"));
}

TEST(Variables, UndefinedOneIsToldOnceWithItsPlace) {
  EXPECT_THAT(Mistakes(ScenarioFile("f", "variables: {speed: 1}\ntitle: x\nend_time_s: ${sped}\n")),
              ElementsAre("f:3:13: undefined variable 'sped' — did you mean 'speed'?"));
  EXPECT_THAT(Mistakes(ScenarioFile("f", "variables:\nend_time_s: ${t}\n")),
              ElementsAre("f:2:13: undefined variable 't' — the file has none"));
  EXPECT_THAT(Mistakes(ScenarioFile("f", "variables: {t: 1}\nend_time_s: ${t\n")),
              ElementsAre("f:2:13: no } ends the variable 't'"));
}

TEST(Variables, FileThatDeclaresNoneMeansWhatItSays) {
  const ScenarioFile file("f", "title: costs ${x}\nend_time_s: ${t}\n");
  EXPECT_EQ(file.scenario().title(), "costs ${x}");
  EXPECT_THAT(Mistakes(file), ElementsAre("f:2:13: end_time_s: expected a number, got '${t}' — "
                                          "give it a value below variables:"));
}

TEST(Variables, TwoDollarsAreNone) {
  const ScenarioFile file("f", "variables: {a: 1, b: '${a}'}\ntitle: &t $${a} ${a}${b}\n");
  EXPECT_EQ(file.scenario().title(), "${a} 1${a}");
}

TEST(Variables, AliasIsResolvedLikeItsAnchor) {
  const ScenarioFile file("f",
                          "variables: {m: 2}\nbodies:\n  - {name: A, mass_kg: &m \"${m}\"}\n"
                          "  - {name: B, mass_kg: *m}\n");
  EXPECT_THAT(Mistakes(file), IsEmpty());
  EXPECT_EQ(file.scenario().bodies(0).mass_kg(), 2);
  EXPECT_EQ(file.scenario().bodies(1).mass_kg(), 2);
}

std::vector<std::string> Advice(const std::string& text) {
  std::vector<std::string> lines;
  const ScenarioFile file("f", text);
  for (const Diagnostic& advice : file.advice()) lines.push_back(Format(advice));
  return lines;
}

TEST(Variables, OneThatIsUsedNowhereIsToldAtItsPlace) {
  EXPECT_THAT(
      Advice("variables: {e: 0.8, height_m: 1}\ntitle: ${e}\n"),
      ElementsAre("f:1:21: variables.height_m: is used nowhere — ${height_m} stands for its "
                  "value"));
  EXPECT_THAT(Advice("variables:\n  e: 0.8\n  v: 2\ntitle: $${e}\n"),
              ElementsAre(testing::HasSubstr("f:2:3: variables.e"),
                          testing::HasSubstr("f:3:3: variables.v")));
  EXPECT_THAT(Advice(kBall), IsEmpty());
  EXPECT_THAT(Advice("title: nothing\n"), IsEmpty());
}

TEST(Variables, FieldsOfOneAreThoseWhoseWholeValueItIs) {
  const ScenarioFile file("f",
                          "variables: {m: 2, t: x}\ntitle: ${t} of ${m}\nbodies:\n"
                          "  - {name: A, mass_kg: &m \"${m}\"}\n  - {name: B, mass_kg: *m}\n"
                          "end_time_s: ${m}\n");
  EXPECT_THAT(file.variables(),
              ElementsAre(testing::Pair("m", ElementsAre("bodies[0].mass_kg", "bodies[1].mass_kg",
                                                         "end_time_s")),
                          testing::Pair("t", IsEmpty())));
}

TEST(Variables, MistakesOfTheMappingHaveTheirPlace) {
  EXPECT_THAT(Mistakes(ScenarioFile("f", "variables: [a]\n")),
              ElementsAre("f:1:12: variables: expected a mapping of names to values"));
  EXPECT_THAT(Mistakes(ScenarioFile("f", "variables:\n  a b: 1\n  c: [1]\n  d: 1\n  d: 2\n")),
              ElementsAre("f:2:3: variables: 'a b' is no name — names are letters, digits and _",
                          "f:3:6: variables.c: expected a number, a word or a text",
                          "f:5:3: variables.d: is given twice"));
}

TEST(Variables, UnknownNamesAreAMistakeOfTheCommandLine) {
  EXPECT_EQ(UsageOf(kBall, {{"nam", "x"}}),
            "--var nam: unknown variable 'nam' — did you mean 'name'?");
  EXPECT_EQ(UsageOf("title: x\n", {{"e", "1"}}),
            "--var e: unknown variable 'e' — the file has none");
  EXPECT_THROW(ParseVariables({"e"}), Failure);
  EXPECT_THROW(ParseVariables({"=1"}), Failure);
  EXPECT_THAT(ParseVariables({"e=1", "t=a=b", "e=2"}),
              ElementsAre(testing::Pair("e", "2"), testing::Pair("t", "a=b")));
}

}  // namespace
}  // namespace contact::cli
