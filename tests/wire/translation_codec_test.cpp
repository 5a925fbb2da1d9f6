#include "wire/translation_codec.h"

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "wire/scenario_builder.h"

namespace contact {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

v1::TranslateModelRequest Request(const std::string& text) {
  v1::TranslateModelRequest request;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &request)) << text;
  return request;
}

std::vector<std::string> Wrong(const std::string& text) {
  return Lines(DecodeTranslation(Request(text)).violations);
}

constexpr char kMeeting[] = "mass_kg: 2 velocities_m_per_s: 0.5 radius_m: 0.02 step_s: 1e-5 ";
constexpr char kWanted[] = "wanted { restitution: 0.6 stiffness: 1e6 }";

TEST(TranslationCodec, ARequestIsReadAsItIsMeant) {
  const auto decoded =
      DecodeTranslation(Request(std::string(kMeeting) + kWanted + "gravity_m_per_s2: 10"));
  EXPECT_THAT(decoded.violations, IsEmpty());
  EXPECT_EQ(decoded.wanted.restitution, 0.6);
  EXPECT_EQ(decoded.wanted.exponent, 1.5) << "the default of the contract";
  EXPECT_EQ(decoded.wanted.duration, 0);
  ASSERT_THAT(decoded.setups, SizeIs(1));
  EXPECT_EQ(decoded.setups[0].collision.load, 20) << "the weight of the mass";
  EXPECT_EQ(decoded.setups[0].collision.velocity, 0.5);
  EXPECT_THAT(decoded.targets, SizeIs(translate::Tools().size())) << "all, where none is named";
}

TEST(TranslationCodec, AllThatIsWrongIsSaidAtOnce) {
  EXPECT_THAT(Wrong(R"(mass_kg: -1 velocities_m_per_s: [1, 0] gravity_m_per_s2: -9 radius_m: 0
                       models: "mujoko" wanted { restitution: 1.2 exponent: 0.5 })"),
              ElementsAre("models[0]: is 'mujoko', which is no model — did you mean 'mujoco'?",
                          "mass_kg: is -1; must be in [1e-30, 1e12]",
                          "gravity_m_per_s2: is -9; must be in [0, 1e6]",
                          "radius_m: is 0; must be in [1e-12, 1e6]",
                          "velocities_m_per_s: holds 2; must hold 1 without from",
                          "velocities_m_per_s[1]: is 0; must be in [1e-9, 1e6]",
                          "wanted.restitution: is 1.2; must be in [0.01, 1]",
                          "wanted.exponent: is 0.5; must be in [1, 10]",
                          "wanted: must have either stiffness or contact_time_s"));
}

TEST(TranslationCodec, WhatIsMissingIsSaid) {
  EXPECT_THAT(Wrong(""), ElementsAre("mass_kg: is missing; must be in [1e-30, 1e12]",
                                     "velocities_m_per_s: is missing — give one",
                                     "contact: is missing — give wanted or from"));
}

TEST(TranslationCodec, NaNIsNoNumberOfAContact) {
  const auto wrong = Wrong(std::string(kMeeting) + "wanted { restitution: nan stiffness: inf }");
  EXPECT_THAT(wrong, ElementsAre("wanted.restitution: is nan; must be in [0.01, 1]",
                                 "wanted.stiffness: is inf; must be in [1e-15, 1e30]"));
}

TEST(TranslationCodec, ParametersOfAModelAreReadInItsOrder) {
  const auto decoded = DecodeTranslation(Request(std::string(kMeeting) + R"(
      velocities_m_per_s: 1 from { model: "mujoco" values { key: "damping" value: 20 }
                                   values { key: "stiffness" value: 1e4 } })"));
  EXPECT_THAT(decoded.violations, IsEmpty());
  EXPECT_EQ(decoded.from, translate::FindTool("mujoco"));
  EXPECT_THAT(decoded.values, ElementsAre(1e4, 20));
  EXPECT_THAT(decoded.setups, SizeIs(2));
  EXPECT_THAT(decoded.targets, IsEmpty()) << "none, where none is named";
}

TEST(TranslationCodec, ParametersThatAModelDoesNotHaveAreSaid) {
  EXPECT_THAT(Wrong(R"(mass_kg: 1 velocities_m_per_s: 1 from { model: "ode"
                       values { key: "soft_erp" value: 0.2 } values { key: "erp" value: 1 } })"),
              ElementsAre("from.values[soft_cfm]: is missing; its unit is m/(N*s)",
                          "from.values[erp]: is no parameter of ode — its parameters are "
                          "soft_erp, soft_cfm",
                          "step_s: is missing; ode needs it"));
}

TEST(TranslationCodec, AModelWithoutASpringIsRefused) {
  for (const char* values : {"values { key: 'soft_erp' value: 0.2 } values { key: 'soft_cfm' }",
                             "values { key: 'soft_erp' value: 2 } "
                             "values { key: 'soft_cfm' value: 1e-4 }"}) {
    EXPECT_THAT(Wrong(std::string(kMeeting) + "from { model: 'ode' " + values + "}"),
                ElementsAre("from.values: have no spring or damper, or damp nearly everything"));
  }
}

TEST(TranslationCodec, AnAnswerHasAllThatTheTranslationHas) {
  const auto decoded = DecodeTranslation(Request(std::string(kMeeting) + kWanted));
  for (const translate::Tool* tool : decoded.targets) {
    const auto found = Translate(*tool, decoded.wanted, decoded.setups[0]);
    const v1::ModelTranslation message = EncodeTranslation(found, 0.5);
    EXPECT_EQ(message.model(), tool->name);
    ASSERT_EQ(message.parameters_size(), static_cast<int>(tool->parameters.size())) << tool->name;
    EXPECT_EQ(message.parameters(0).value(), found.values[0]);
    EXPECT_EQ(message.line(), LineOf(*tool, found.values));
    EXPECT_NEAR(message.delivered().restitution_alone(), 0.6, 1e-6) << tool->name;
    EXPECT_EQ(message.has_at_step(), tool->stepping != translate::Stepping::kAccurate);
    EXPECT_EQ(message.velocity_m_per_s(), 0.5);
  }
}

TEST(TranslationCodec, WhatAModelLacksIsAWarning) {
  const auto decoded = DecodeTranslation(
      Request(std::string("mass_kg: 2 velocities_m_per_s: 1 models: 'simbody' ") + kWanted));
  const auto message =
      EncodeTranslation(Translate(*decoded.targets[0], decoded.wanted, decoded.setups[0]), 1);
  EXPECT_THAT(message.warnings(), ElementsAre("needs the radius"));
  EXPECT_FALSE(message.has_delivered());
  EXPECT_EQ(message.line(), "");
}

TEST(TranslationCodec, EveryModelIsListedWithItsParameters) {
  const v1::ListModelsResponse list = EncodeModels();
  ASSERT_EQ(list.models_size(), static_cast<int>(translate::Tools().size()));
  for (const v1::ContactModel& model : list.models()) {
    EXPECT_GT(model.parameters_size(), 0) << model.name();
    EXPECT_NE(model.source(), "") << model.name();
  }
}

// Whatever the numbers within the ranges of the contract: no exception, and an end.
TEST(TranslationCodec, TheEndsOfAllRangesCanBeComputed) {
  const char* meetings[] = {
      "mass_kg: 1e-30 velocities_m_per_s: 1e-9 radius_m: 1e-12 step_s: 1e-18 ",
      "mass_kg: 1e12 velocities_m_per_s: 1e6 radius_m: 1e6 step_s: 1e6 ",
      "mass_kg: 1e12 velocities_m_per_s: 1e-9 radius_m: 1 step_s: 1e-5 "};
  const char* contacts[] = {"wanted { restitution: 0.01 stiffness: 1e-15 exponent: 10 }",
                            "wanted { restitution: 0.5 stiffness: 1e30 exponent: 1 }",
                            "wanted { restitution: 1 contact_time_s: 1e-15 }"};
  for (const std::string meeting : meetings) {
    for (const std::string contact : contacts) {
      const auto decoded = DecodeTranslation(Request(meeting + contact + " gravity_m_per_s2: 1e6"));
      ASSERT_THAT(Lines(decoded.violations), IsEmpty());
      for (const char* name : {"adams", "lammps-tsuji", "liggghts-hooke", "ode"}) {
        EXPECT_NO_THROW(Translate(*translate::FindTool(name), decoded.wanted, decoded.setups[0]))
            << meeting << contact << name;
      }
    }
  }
}

}  // namespace
}  // namespace contact
