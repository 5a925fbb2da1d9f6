#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "cli/input/scenario_file.h"

namespace contact::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kTwoContacts[] = R"(
bodies:
  - {name: a, mass_kg: 1}
  - {name: b, mass_kg: 1, position_m: 1}
  - {name: c, mass_kg: 1, position_m: 2}
contacts:
  - {between: [a, b], stiffness: 1, restitution: 0.5}
  - {between: [b, c], stiffness: 1, restitution: 0.5}
end_time_s: 1
)";

// The mistakes that are left after an override and the check of the rules.
std::vector<std::string> Mistakes(const std::string& assignment) {
  ScenarioFile file("f", kTwoContacts);
  file.Set(assignment);
  file.Check();
  std::vector<std::string> lines;
  for (const Diagnostic& diagnostic : file.diagnostics()) lines.push_back(Format(diagnostic));
  return lines;
}

v1::Scenario With(const std::string& assignment) {
  ScenarioFile file("f", kTwoContacts);
  file.Set(assignment);
  EXPECT_THAT(file.diagnostics(), IsEmpty()) << assignment;
  return file.scenario();
}

TEST(Override, ReplacesOneField) {
  const v1::Scenario scenario = With("contacts[1].restitution=0.7");
  EXPECT_EQ(scenario.contacts(0).restitution(), 0.5);
  EXPECT_EQ(scenario.contacts(1).restitution(), 0.7);
}

TEST(Override, StarIsEveryEntry) {
  const v1::Scenario scenario = With("contacts[*].damping=flores");
  EXPECT_EQ(scenario.contacts(0).damping(), v1::Contact::FLORES);
  EXPECT_EQ(scenario.contacts(1).damping(), v1::Contact::FLORES);
}

TEST(Override, EntriesAreFoundByTheirNames) {
  const v1::Scenario scenario = With("contacts[b-c].restitution=0.7");
  EXPECT_EQ(scenario.contacts(0).restitution(), 0.5);
  EXPECT_EQ(scenario.contacts(1).restitution(), 0.7);
  EXPECT_EQ(With("bodies[b].mass_kg=3").bodies(1).mass_kg(), 3);
}

TEST(Override, UnknownNameIsToldAndAKnownOneIsPlacedAtItsField) {
  EXPECT_THAT(Mistakes("contacts[b-d].restitution=1"),
              ElementsAre("--set: contacts: there is no contact 'b-d' — did you mean 'b-c'?"));
  EXPECT_THAT(Mistakes("contacts[b-c].restitution=1.2"),
              ElementsAre("--set: contacts[1].restitution: is 1.2; must be in (0, 1]"));
}

TEST(Override, MakesMessagesThatAreNotThere) {
  EXPECT_EQ(With("solver.max_iterations=7").solver().max_iterations(), 7);
}

TEST(Override, TakesListsAndMappings) {
  EXPECT_EQ(With("contacts[0].between=[a, c]").contacts(0).between(1), "c");
  EXPECT_EQ(With("loads=[{body: a, constant: {force_n: 5}}]").loads(0).constant().force_n(), 5);
  EXPECT_EQ(With("title=a=b").title(), "a=b");
}

TEST(Override, IsTyped) {
  EXPECT_THAT(Mistakes("contacts[0].restitution=high"),
              ElementsAre("--set: contacts[0].restitution: expected a number, got 'high'"));
}

TEST(Override, BrokenRuleIsShownAtTheOverride) {
  EXPECT_THAT(Mistakes("contacts[*].restitution=1.2"),
              ElementsAre("--set: contacts[0].restitution: is 1.2; must be in (0, 1]",
                          "--set: contacts[1].restitution: is 1.2; must be in (0, 1]"));
}

TEST(Override, UnknownFieldHasAHint) {
  EXPECT_THAT(Mistakes("contacts[0].restituton=1"),
              ElementsAre("--set: contacts[0].restituton: unknown field — did you mean "
                          "'restitution'?"));
  EXPECT_THAT(Mistakes("solvr.max_steps=1"),
              ElementsAre("--set: solvr: unknown field — did you mean 'solver'?"));
}

TEST(Override, WrongStepsOfAPathAreMistakes) {
  EXPECT_THAT(Mistakes("contacts[2].restitution=1"),
              ElementsAre("--set: contacts[2]: there are only 2"));
  EXPECT_THAT(Mistakes("contacts.restitution=1"),
              ElementsAre("--set: contacts: is a list — contacts[0], or contacts[*] for every "
                          "entry"));
  EXPECT_THAT(Mistakes("solver[0].max_steps=1"),
              ElementsAre("--set: solver: is no list — leave the index out"));
  EXPECT_THAT(Mistakes("end_time_s.x=1"), ElementsAre("--set: end_time_s: has no field 'x'"));
  EXPECT_THAT(Mistakes("contacts[0].between[0]=c"),
              ElementsAre("--set: contacts[0].between: cannot be set entry by entry — set a field "
                          "of it, or the whole list"));
}

TEST(Override, WhatIsNoAssignmentIsAWrongUsage) {
  for (const char* text :
       {"", "x", "=1", "a..b=1", "a[=1", "a[-1].b=1", "a[x].b=1", "a]=1x[", "end_time_s=[1"}) {
    ScenarioFile file("f", kTwoContacts);
    try {
      file.Set(text);
      EXPECT_THAT(file.diagnostics(), testing::Not(IsEmpty())) << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage) << text;
    }
  }
}

}  // namespace
}  // namespace contact::cli
