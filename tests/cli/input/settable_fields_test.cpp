#include "cli/input/settable_fields.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "cli/input/diagnostic.h"
#include "cli/input/scenario_file.h"

namespace contact::cli {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::Not;

const SettableField* Find(const std::vector<SettableField>& fields, const std::string& path) {
  const auto found = std::ranges::find(fields, path, &SettableField::path);
  return found == fields.end() ? nullptr : &*found;
}

v1::Scenario TwoBalls() {
  return ScenarioFile("two",
                      "end_time_s: 1e-3\n"
                      "bodies: [{name: A, mass_kg: 1}, {name: B, mass_kg: 1}]\n"
                      "contacts: [{between: [A, B], stiffness: 1e10}]\n")
      .scenario();
}

TEST(SettableFields, EveryPathCanBeSet) {
  const std::vector<SettableField> fields = SettableFields(TwoBalls());
  ASSERT_NE(Find(fields, "contacts[0].stiffness"), nullptr);
  ASSERT_NE(Find(fields, "contacts[*].restitution"), nullptr);
  for (const SettableField& field : fields) {
    ScenarioFile file("f", "bodies: [{name: A}]\ncontacts: [{stiffness: 1}]\n");
    file.Set(field.path + "=" + (field.words.empty() ? "1" : field.words.front()));
    for (const Diagnostic& mistake : file.diagnostics()) {
      EXPECT_NE(mistake.what, "unknown field") << field.path;
    }
  }
}

TEST(SettableFields, EntriesWithANameAreThereByItToo) {
  const std::vector<SettableField> fields = SettableFields(TwoBalls());
  EXPECT_NE(Find(fields, "contacts[A-B].restitution"), nullptr);
  EXPECT_NE(Find(fields, "bodies[B].mass_kg"), nullptr);
}

TEST(SettableFields, EnumsAndFlagsHaveTheirWords) {
  const std::vector<SettableField> fields = SettableFields(TwoBalls());
  const SettableField* method = Find(fields, "solver.method");
  ASSERT_NE(method, nullptr);
  EXPECT_THAT(method->words, Contains("RK4"));
  EXPECT_THAT(method->words, Not(Contains("METHOD_UNSPECIFIED")));
  EXPECT_THAT(Find(fields, "end_time_s")->words, IsEmpty());
}

TEST(SettableFields, EntriesOfALongListAreThoseAtItsBeginAndAll) {
  v1::Scenario scenario = TwoBalls();
  while (scenario.bodies_size() < 100) scenario.add_bodies();
  const std::vector<SettableField> fields = SettableFields(scenario);
  for (const char* path : {"bodies[0].mass_kg", "bodies[19].mass_kg", "bodies[*].mass_kg"}) {
    EXPECT_NE(Find(fields, path), nullptr) << path;
  }
  EXPECT_EQ(Find(fields, "bodies[20].mass_kg"), nullptr);
}

}  // namespace
}  // namespace contact::cli
