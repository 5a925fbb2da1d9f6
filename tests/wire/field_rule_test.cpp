#include "wire/rules/field_rule.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "wire/rules/rules.h"
#include "wire/scenario_builder.h"

namespace contact {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

void Collect(const Descriptor& message, std::set<const Descriptor*>* seen,
             std::vector<const FieldDescriptor*>* fields) {
  if (!seen->insert(&message).second) return;
  for (int i = 0; i < message.field_count(); ++i) {
    fields->push_back(message.field(i));
    if (message.field(i)->message_type() != nullptr) {
      Collect(*message.field(i)->message_type(), seen, fields);
    }
  }
}

// Every field of the messages, and of the messages in their fields.
std::vector<const FieldDescriptor*> FieldsOf(std::initializer_list<const Descriptor*> messages) {
  std::set<const Descriptor*> seen;
  std::vector<const FieldDescriptor*> fields;
  for (const Descriptor* message : messages) Collect(*message, &seen, &fields);
  return fields;
}

std::vector<const FieldDescriptor*> AllFields() {
  return FieldsOf({v1::CreateJobRequest::descriptor(), v1::ListJobsRequest::descriptor(),
                   v1::WatchJobRequest::descriptor(), v1::WatchJobResponse::descriptor(),
                   v1::WatchJobsRequest::descriptor(), v1::GetSeriesRequest::descriptor(),
                   v1::ReadArtifactRequest::descriptor(), v1::ServerInfo::descriptor()});
}

const FieldDescriptor& Field(const Descriptor& message, const char* name) {
  return *message.FindFieldByName(name);
}

bool HasRange(const FieldDescriptor& field) {
  return RuleOf(field).low_case() != v1::FieldRule::LOW_NOT_SET || RuleOf(field).has_max();
}

TEST(FieldRule, EveryNumberOfAScenarioHasARange) {
  int numbers = 0;
  for (const FieldDescriptor* field : FieldsOf({v1::Scenario::descriptor()})) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE &&
        field->cpp_type() != FieldDescriptor::CPPTYPE_INT32 &&
        field->cpp_type() != FieldDescriptor::CPPTYPE_INT64) {
      continue;
    }
    EXPECT_TRUE(HasRange(*field)) << field->full_name();
    ++numbers;
  }
  EXPECT_GT(numbers, 30);
}

TEST(FieldRule, RangesAreNotEmptyAndHoldTheDefault) {
  for (const FieldDescriptor* field : AllFields()) {
    if (!HasRange(*field)) continue;
    const Range range = RangeOf(*field);
    EXPECT_LT(range.low, range.high) << field->full_name();
    const v1::FieldRule& rule = RuleOf(*field);
    if (rule.has_default_number()) {
      EXPECT_TRUE(range.Contains(rule.default_number())) << field->full_name();
    }
  }
}

TEST(FieldRule, OnlyNumbersAndDurationsHaveRanges) {
  for (const FieldDescriptor* field : AllFields()) {
    if (!HasRange(*field)) continue;
    const bool duration = field->message_type() != nullptr &&
                          field->message_type()->full_name() == "google.protobuf.Duration";
    EXPECT_TRUE(duration || field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ||
                field->cpp_type() == FieldDescriptor::CPPTYPE_INT32 ||
                field->cpp_type() == FieldDescriptor::CPPTYPE_INT64)
        << field->full_name();
  }
}

TEST(FieldRule, DefaultNamesAreValuesOfTheField) {
  int names = 0;
  for (const FieldDescriptor* field : AllFields()) {
    const v1::FieldRule& rule = RuleOf(*field);
    if (!rule.has_default_name()) continue;
    ++names;
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_BOOL) {
      EXPECT_EQ(rule.default_name(), "false") << field->full_name();
    } else {
      ASSERT_NE(field->enum_type(), nullptr) << field->full_name();
      EXPECT_NE(field->enum_type()->FindValueByName(rule.default_name()), nullptr)
          << field->full_name();
    }
  }
  EXPECT_GT(names, 8);
}

TEST(FieldRule, RequiredFieldsHaveNoDefault) {
  for (const FieldDescriptor* field : AllFields()) {
    if (!RuleOf(*field).required()) continue;
    EXPECT_EQ(RuleOf(*field).default_case(), v1::FieldRule::DEFAULT_NOT_SET) << field->full_name();
  }
}

TEST(FieldRule, CountsBelongToTextsAndLists) {
  for (const FieldDescriptor* field : AllFields()) {
    const v1::FieldRule& rule = RuleOf(*field);
    if (rule.max_characters() != 0) {
      EXPECT_EQ(field->cpp_type(), FieldDescriptor::CPPTYPE_STRING) << field->full_name();
    }
    if (rule.min_entries() != 0 || rule.max_entries() != 0) {
      EXPECT_TRUE(field->is_repeated()) << field->full_name();
    }
  }
}

TEST(FieldRule, RangeTextRoundTrips) {
  const std::regex pattern(R"(([[(])(\S+), (\S+)\])");
  int ranges = 0;
  for (const FieldDescriptor* field : FieldsOf({v1::Scenario::descriptor()})) {
    if (!RuleOf(*field).has_max()) continue;
    const std::string text = RangeText(*field);
    std::smatch parts;
    ASSERT_TRUE(std::regex_match(text, parts, pattern)) << field->full_name() << ": " << text;
    const Range range = RangeOf(*field);
    EXPECT_EQ(parts[1] == "(", range.open) << text;
    EXPECT_EQ(std::stod(parts[2]), range.low) << text;
    EXPECT_EQ(std::stod(parts[3]), range.high) << text;
    EXPECT_EQ(range.text, "in " + text);
    ++ranges;
  }
  EXPECT_GT(ranges, 30);
}

TEST(FieldRule, NumbersAreWrittenInTheirShorterForm) {
  const FieldDescriptor& real = Field(*v1::Body::descriptor(), "mass_kg");
  for (const auto& [value, text] :
       std::vector<std::pair<double, std::string>>{{0, "0"},
                                                   {1, "1"},
                                                   {-1, "-1"},
                                                   {0.5, "0.5"},
                                                   {0.1, "0.1"},
                                                   {1.5, "1.5"},
                                                   {100, "100"},
                                                   {1000, "1e3"},
                                                   {-1e9, "-1e9"},
                                                   {1e12, "1e12"},
                                                   {1e-3, "1e-3"},
                                                   {1e-13, "1e-13"},
                                                   {1e100, "1e100"},
                                                   {-9.80665, "-9.80665"}}) {
    EXPECT_EQ(NumberText(real, value), text);
    EXPECT_EQ(std::stod(NumberText(real, value)), value);
  }
}

TEST(FieldRule, WholeNumbersOf32BitsHaveAllTheirDigits) {
  const FieldDescriptor& count = Field(*v1::Solver::descriptor(), "max_iterations");
  EXPECT_EQ(NumberText(count, 1000), "1000");
  EXPECT_EQ(RangeText(count), "[1, 1000]");
  EXPECT_EQ(RangeText(Field(*v1::Solver::descriptor(), "max_steps")), "[1, 1e12]");
}

TEST(FieldRule, DurationsAreWrittenWithTheirUnit) {
  EXPECT_EQ(RangeText(Field(*v1::Budget::descriptor(), "wall_time")), "[1 ms, 100 years]");
  EXPECT_EQ(RangeText(Field(*v1::WatchJobRequest::descriptor(), "bookmark_interval")),
            "[1 s, 1 h]");
  EXPECT_EQ(RangeText(Field(*v1::DeliveryOptions::descriptor(), "min_frame_interval")), "[0, 1 h]");
}

TEST(FieldRule, RangeWithoutUpperEndNamesTheLowerOne) {
  EXPECT_EQ(RangeText(Field(*v1::Output::descriptor(), "sample_interval_s")), "> 0");
  EXPECT_EQ(RangeText(Field(*v1::Budget::descriptor(), "steps")), "≥ 0");
}

TEST(FieldRule, FieldWithoutRuleTakesEveryFiniteNumber) {
  const FieldDescriptor& field = Field(*v1::Sweep::Range::descriptor(), "low");
  const Range range = RangeOf(field);
  EXPECT_EQ(RangeText(field), "");
  EXPECT_TRUE(range.Contains(std::numeric_limits<double>::max()));
  EXPECT_TRUE(range.Contains(std::numeric_limits<double>::lowest()));
  EXPECT_FALSE(range.Contains(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(range.Contains(std::nan("")));
}

TEST(FieldRule, DefaultsOfTheContractAreThoseOfTheModel) {
  const DecodedScenario decoded = DecodeScenario(TwoBalls());
  const SolverOptions model;
  const SolverOptions& read = decoded.scenario.solver;
  EXPECT_EQ(read.fixed_step, model.fixed_step);
  EXPECT_EQ(read.relative_tolerance, model.relative_tolerance);
  EXPECT_EQ(read.restitution_tolerance, model.restitution_tolerance);
  EXPECT_EQ(read.max_iterations, model.max_iterations);
  EXPECT_EQ(read.settled_fraction, model.settled_fraction);
  EXPECT_EQ(read.settled_nirv_fraction, model.settled_nirv_fraction);
  EXPECT_EQ(read.max_steps, model.max_steps);
  ASSERT_EQ(decoded.scenario.contacts.size(), 1U);
  EXPECT_EQ(decoded.scenario.contacts[0].exponent, Contact().exponent);
}

TEST(NumberField, UnsetFieldWithPresenceHasNoValue) {
  v1::Contact contact;
  const NumberField& exponent = NumberOf<v1::Contact>(v1::Contact::kExponentFieldNumber);
  EXPECT_EQ(exponent.Find(contact), std::nullopt);
  contact.set_exponent(0);
  EXPECT_EQ(exponent.Find(contact), 0);
}

TEST(NumberField, FieldWithoutPresenceAlwaysHasAValue) {
  v1::Body body;
  const NumberField& position = NumberOf<v1::Body>(v1::Body::kPositionMFieldNumber);
  EXPECT_EQ(position.Find(body), 0);
}

TEST(NumberField, WholeNumbersAreRead) {
  v1::Solver solver;
  solver.set_max_iterations(7);
  solver.set_max_steps(1'000'000'000'000);
  EXPECT_EQ(NumberOf<v1::Solver>(v1::Solver::kMaxIterationsFieldNumber).Find(solver), 7);
  EXPECT_EQ(NumberOf<v1::Solver>(v1::Solver::kMaxStepsFieldNumber).Find(solver), 1e12);
}

TEST(NumberField, EachNumberOfAMessageIsFoundByItsFieldNumber) {
  for (int i = 0; i < v1::Solver::descriptor()->field_count(); ++i) {
    const FieldDescriptor* field = v1::Solver::descriptor()->field(i);
    EXPECT_EQ(NumberOf<v1::Solver>(field->number()).descriptor, field);
  }
  const std::vector<NumberField> body = NumbersOf(*v1::Body::descriptor());
  EXPECT_EQ(body[v1::Body::kNameFieldNumber].descriptor, nullptr) << "a text is no number";
}

TEST(Rules, ReadTakesTheValueOrElseTheDefault) {
  std::vector<Violation> violations;
  const Rules rules(&violations);
  v1::Load::Gravity gravity;
  constexpr int kField = v1::Load::Gravity::kAccelerationMPerS2FieldNumber;
  EXPECT_EQ(rules.Read(gravity, kField), -9.80665);
  gravity.set_acceleration_m_per_s2(0);
  EXPECT_EQ(rules.Read(gravity, kField), 0);
  EXPECT_TRUE(rules.empty());
}

TEST(Rules, ReadTellsAMissingNumberFromOneOutOfRange) {
  std::vector<Violation> violations;
  const Rules rules(&violations, "materials", 2);
  v1::Material material;
  rules.Read(material, v1::Material::kYoungsModulusPaFieldNumber, "steel has 2.1e11");
  rules.Read(material, v1::Material::kPoissonRatioFieldNumber, "steel has 0.3");
  material.set_youngs_modulus_pa(-1);
  material.set_poisson_ratio(-1);
  rules.Read(material, v1::Material::kYoungsModulusPaFieldNumber, "unused");
  rules.Read(material, v1::Material::kPoissonRatioFieldNumber, "unused");
  EXPECT_EQ(Lines(violations),
            (std::vector<std::string>{
                "materials[2].youngs_modulus_pa: is missing; must be in (0, 1e15] — steel has "
                "2.1e11",
                "materials[2].poisson_ratio: is missing — steel has 0.3",
                "materials[2].youngs_modulus_pa: is -1; must be in (0, 1e15]",
                "materials[2].poisson_ratio: is -1; must be in (-1, 0.5]"}));
}

// A number that is read by its generated accessor is held to the same range, in the same words.
TEST(Rules, CheckFindsWhatReadFinds) {
  std::vector<Violation> checked, read;
  v1::Body body;
  for (const double value : {-1e30, -1e9, -0.0, 0.5, 1e9, 1e30, std::nan("")}) {
    body.set_position_m(value);
    Rules(&checked, "b").Check<v1::Body>(v1::Body::kPositionMFieldNumber, body.position_m());
    Rules(&read, "b").Read(body, v1::Body::kPositionMFieldNumber);
  }
  EXPECT_EQ(Lines(checked), Lines(read));
  EXPECT_EQ(checked.size(), 3U);
}

TEST(Rules, UnknownValueOfAnEnumIsTold) {
  std::vector<Violation> violations;
  const Rules rules(&violations);
  for (int i = 0; i < v1::Contact::Damping_ARRAYSIZE; ++i) {
    rules.RequireKnown("damping", static_cast<v1::Contact::Damping>(i));
  }
  EXPECT_TRUE(rules.empty());
  rules.RequireKnown("damping", static_cast<v1::Contact::Damping>(99));
  EXPECT_EQ(Lines(violations),
            std::vector<std::string>{"damping: is 99, which is no value of Damping"});
}

TEST(Rules, ListMayBeAsLongAsItsLimit) {
  std::vector<Violation> violations;
  const Rules rules(&violations);
  EXPECT_TRUE(rules.RequireAtMost("axes", 8, 8));
  EXPECT_FALSE(rules.RequireAtMost("axes", 9, 8));
  EXPECT_EQ(Lines(violations), std::vector<std::string>{"axes: holds 9; must hold at most 8"});
}

TEST(Rules, PathsNameEveryMessageAroundTheField) {
  std::vector<Violation> violations;
  const Rules load(&violations, "loads", 3);
  const Rules table = load.In("table");
  table.In("points", 1).Break("time_s", "is late");
  table.Break("", "is empty");
  Rules(&violations).In("solver").Break("step_s", "is long");
  EXPECT_EQ(violations[0].field, "loads[3].table.points[1].time_s");
  EXPECT_EQ(violations[1].field, "loads[3].table");
  EXPECT_EQ(violations[2].field, "solver.step_s");
}

TEST(Rules, NothingIsNotedPastTheLargestNumberOfViolations) {
  std::vector<Violation> violations;
  const Rules rules(&violations);
  v1::Body body;
  body.set_position_m(1e10);
  for (std::size_t i = 0; i < 2 * Rules::kMostViolations; ++i) {
    rules.Read(body, v1::Body::kPositionMFieldNumber);
  }
  EXPECT_EQ(violations.size(), Rules::kMostViolations);
  EXPECT_TRUE(rules.full());
}

}  // namespace
}  // namespace contact
