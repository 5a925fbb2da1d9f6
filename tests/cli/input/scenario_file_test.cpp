#include "cli/input/scenario_file.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>

#include "cli/base/failure.h"
#include "cli/text/render_json.h"

namespace contact::cli {
namespace {

using google::protobuf::util::MessageDifferencer;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> Lines(const ScenarioFile& file) {
  std::vector<std::string> lines;
  for (const Diagnostic& diagnostic : file.diagnostics()) lines.push_back(Format(diagnostic));
  return lines;
}

ScenarioFile ReadFile(const std::string& text) {
  ScenarioFile file("f", text);
  EXPECT_THAT(Lines(file), IsEmpty()) << text;
  return file;
}

constexpr char kYaml[] = R"(
title: μ
bodies:
  - {name: ball, mass_kg: 0.5, fixed: true}
contacts:
  - between: [ball]
    wall: {side: LEFT}
    stiffness: 1.0e8
    damping: HU_GUO
solver: {max_iterations: 20, max_steps: 1e6}
end_time_s: 1
)";

TEST(ScenarioFile, JsonIsYaml) {
  const ScenarioFile json = ReadFile(R"({"title": "\u03bc",
      "bodies": [{"name": "ball", "mass_kg": 0.5, "fixed": true}],
      "contacts": [{"between": ["ball"], "wall": {"side": "LEFT"}, "stiffness": 1e8,
                    "damping": "HU_GUO"}],
      "solver": {"max_iterations": 20, "max_steps": "1000000"}, "end_time_s": 1})");
  EXPECT_TRUE(MessageDifferencer::Equals(json.scenario(), ReadFile(kYaml).scenario()));
}

TEST(ScenarioFile, WhatIsPrintedAsJsonCanBeReadBack) {
  const ScenarioFile file = ReadFile(kYaml);
  const ScenarioFile again = ReadFile(ToJson(file.scenario()));
  // Zeros are printed, so fields without presence may differ in nothing.
  EXPECT_TRUE(MessageDifferencer::Equivalent(file.scenario(), again.scenario()));
}

TEST(ScenarioFile, EnumsAreReadInEitherCase) {
  const auto damping = [](const std::string& text) {
    return ReadFile("contacts: [{damping: " + text + "}]").scenario().contacts(0).damping();
  };
  EXPECT_EQ(damping("hunt-crossley"), v1::Contact::HUNT_CROSSLEY);
  EXPECT_EQ(damping("Hunt_Crossley"), v1::Contact::HUNT_CROSSLEY);
}

TEST(ScenarioFile, KeyWithoutAValueIsLeftOut) {
  const ScenarioFile file = ReadFile("title:\nbodies: [{name: a, mass_kg: ~}]\nloads: null");
  EXPECT_FALSE(file.scenario().bodies(0).has_mass_kg());
}

TEST(ScenarioFile, MessageWithoutAValueIsThereWithItsDefaults) {
  EXPECT_TRUE(ReadFile("loads: [{gravity: }]").scenario().loads(0).has_gravity());
}

TEST(ScenarioFile, AnchorsNeedNotBeRepeated) {
  const ScenarioFile file =
      ReadFile("bodies: [&a {name: a, mass_kg: 2}, {name: b, mass_kg: 3}]\ncontacts: []");
  EXPECT_EQ(file.scenario().bodies(0).mass_kg(), 2);
}

TEST(ScenarioFile, BrokenRuleIsShownWhereTheFieldIsWritten) {
  ScenarioFile file = ReadFile("end_time_s: -1\nbodies:\n- name: a\n  mass_kg: 0");
  file.Check();
  EXPECT_THAT(Lines(file), ElementsAre("f:1:13: end_time_s: is -1; must be in (0, 1e6]",
                                       "f:4:12: bodies[0].mass_kg: is 0; must be in (0, 1e12]"));
}

TEST(ScenarioFile, MissingFieldIsShownWhereItsMessageBegins) {
  ScenarioFile file = ReadFile("end_time_s: 1\nbodies:\n- name: a");
  file.Check();
  EXPECT_THAT(Lines(file), ElementsAre("f:3:3: bodies[0].mass_kg: is missing — give mass_kg, or "
                                       "density_kg_per_m3 and radius_m"));
}

TEST(ScenarioFile, RuleThatOnlyAMistakeBreaksIsNotShown) {
  ScenarioFile file("f", "end_time_s: 1\nbodies:\n- nam: a\n  mass_kg: 1\nsupports: [{body: a}]");
  file.Check();
  EXPECT_THAT(Lines(file),
              ElementsAre("f:3:3: bodies[0].nam: unknown field — did you mean 'name'?"));
}

TEST(ScenarioFile, NumberOutOfRangeIsShownBesideAMistakeElsewhere) {
  ScenarioFile file("f",
                    "end_time_s: -1\nbodies:\n- {name: a, mas_kg: 1}\n- {name: b, mass_kg: -1}");
  file.Check();
  EXPECT_THAT(Lines(file),
              ElementsAre("f:1:13: end_time_s: is -1; must be in (0, 1e6]",
                          "f:3:13: bodies[0].mas_kg: unknown field — did you mean 'mass_kg'?",
                          "f:4:22: bodies[1].mass_kg: is -1; must be in (0, 1e12]"));
}

TEST(ScenarioFile, DeepNestingIsAMistakeNotACrash) {
  const ScenarioFile file("f", "a: " + std::string(100'000, '[') + std::string(100'000, ']'));
  EXPECT_THAT(Lines(file), testing::SizeIs(1));
}

TEST(ScenarioFile, EndlessAliasIsAMistakeNotALoop) {
  const ScenarioFile file("f", "bodies: &a [*a]");
  EXPECT_THAT(Lines(file), testing::SizeIs(1));
}

TEST(ScenarioFile, MissingFileIsALocalFailure) {
  try {
    ScenarioFile::Open("/no/such/file.yaml");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kLocal);
    EXPECT_STREQ(failure.what(), "cannot read /no/such/file.yaml: No such file or directory");
  }
}

TEST(ScenarioFile, FolderIsALocalFailure) { EXPECT_THROW(ScenarioFile::Open("/tmp"), Failure); }

}  // namespace
}  // namespace contact::cli
