#include "wire/scenario/law_catalogue.h"

#include <gtest/gtest.h>

#include <string>

#include "wire/scenario_builder.h"

namespace contact {
namespace {

TEST(LawCatalogue, NamesLawsAsTheContractDoes) {
  for (const DampingLawRow& law : DampingLaws()) {
    EXPECT_EQ(v1::Contact::Damping_Name(DampingOf(law.law)), std::string(law.name));
  }
}

TEST(LawCatalogue, HasEveryLawOfTheContractButWhatIsGiven) {
  EXPECT_EQ(LawCatalogue().size(), DampingLaws().size() - 3);
  for (const LawEntry& law : LawCatalogue()) {
    EXPECT_NE(DampingOf(law.law), v1::Contact::MU);
    EXPECT_NE(law.alpha, nullptr) << law.name;
  }
}

TEST(LawCatalogue, EachLawIsDecodedToItself) {
  for (const LawEntry& law : LawCatalogue()) {
    v1::Scenario scenario = TwoBalls();
    scenario.mutable_contacts(0)->set_damping(DampingOf(law.law));
    if (law.contact_exponent != 0) {
      scenario.mutable_contacts(0)->set_exponent(law.contact_exponent);
    }
    const DecodedScenario decoded = DecodeScenario(scenario);
    ASSERT_TRUE(decoded.violations.empty()) << law.name;
    EXPECT_EQ(decoded.scenario.contacts[0].damping, law.law) << law.name;
  }
}

}  // namespace
}  // namespace contact
