#include "cli/help/contract/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "contact/v1/scenario.pb.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

const Chapter& ChapterOf(const std::vector<Chapter>& chapters, const std::string& name) {
  const auto found = std::ranges::find(chapters, name, &Chapter::name);
  if (found == chapters.end()) throw std::out_of_range(name);
  return *found;
}

const Term& TermOf(const Chapter& chapter, const std::string& name) {
  const auto found = std::ranges::find(chapter.fields, name, &Term::name);
  if (found == chapter.fields.end()) throw std::out_of_range(name);
  return *found;
}

TEST(Contract, UnknownMessageIsRefused) {
  EXPECT_THROW(Contract().Message("Nothing"), std::logic_error);
}

TEST(Contract, RulesOfItsFieldsAreThoseOfTheGeneratedClasses) {
  const Contract contract;
  const Descriptor& read = contract.Message("Solver");
  const Descriptor& generated = *v1::Solver::descriptor();
  for (int i = 0; i < read.field_count(); ++i) {
    EXPECT_EQ(RuleOf(*read.field(i)).SerializeAsString(),
              RuleOf(*generated.field(i)).SerializeAsString())
        << read.field(i)->name();
  }
}

TEST(Contract, CommentsDoNotRepeatRules) {
  const Contract contract;
  int fields = 0;
  for (const char* name :
       {"Scenario", "Body", "Material", "Contact", "Wall", "Support", "Load", "Load.Sine",
        "Load.Table", "Solver", "Output", "Sweep", "Sweep.Axis", "Sweep.Range", "Job", "Budget"}) {
    const Descriptor& message = contract.Message(name);
    for (int i = 0; i < message.field_count(); ++i, ++fields) {
      const std::string comment = CommentOf(*message.field(i));
      for (const char* word : {"Range:", "Default:", "Required.", "Unit:"}) {
        EXPECT_EQ(comment.find(word), std::string::npos) << message.field(i)->full_name();
      }
    }
  }
  EXPECT_GT(fields, 80);
}

TEST(Contract, ParagraphsOfACommentAreOneLine) {
  const std::string comment = CommentOf(Contract().Message("Scenario"));
  EXPECT_EQ(std::ranges::count(comment, '\n'), 2);  // Two paragraphs and the line between them.
  EXPECT_EQ(comment.back(), '.');
}

TEST(Contract, FormulasOfACommentKeepTheirLine) {
  const std::string comment = CommentOf(Contract().Message("Contact"));
  EXPECT_NE(comment.find("\n  F = k δⁿ + μ δⁿ δ̇"), std::string::npos) << comment;
}

TEST(Contract, FieldTextEndsWithTheRules) {
  const Contract contract;
  const auto text = [&](const char* message, const char* field) {
    return FieldText(*contract.Message(message).FindFieldByName(field));
  };
  EXPECT_EQ(text("Contact", "exponent"),
            "Exponent n of the deformation. 1.5 is a Hertz contact of spheres. Range: [1, 5]. "
            "Default: 1.5.");
  EXPECT_EQ(
      text("Scenario", "end_time_s"),
      "Simulated time at which the run ends. The run starts at 0. Required. Range: (0, 1e6].");
  EXPECT_EQ(text("Support", "other"), "The body at the other end. Default: the ground.");
  EXPECT_EQ(
      text("Scenario", "title"),
      "What the scenario shows, in one line, without control characters. Optional. At most 200 "
      "characters.");
  EXPECT_NE(text("Contact", "stiffness").find("Unit: N/m^exponent. Range: (0, 1e30]."),
            std::string::npos);
  EXPECT_NE(text("Load.Table", "points").find("At least 2 entries. At most 10000 entries."),
            std::string::npos);
  EXPECT_EQ(text("Solver", "tension"), "Treatment of pulling forces. Default: ALLOW.");
}

TEST(Reference, EveryFieldOfTheContractIsInIt) {
  const Contract contract;
  const std::vector<Chapter> chapters = ScenarioReference(contract);
  EXPECT_GT(chapters.size(), 15U);
  for (const Chapter& chapter : chapters) {
    const Descriptor& message = contract.Message(chapter.name);
    ASSERT_EQ(chapter.fields.size(), static_cast<std::size_t>(message.field_count()));
    for (int i = 0; i < message.field_count(); ++i) {
      const Term& term = chapter.fields[static_cast<std::size_t>(i)];
      EXPECT_EQ(term.name, message.field(i)->name());
      EXPECT_FALSE(term.text.empty()) << message.field(i)->full_name();
      EXPECT_FALSE(term.type.empty()) << message.field(i)->full_name();
    }
  }
}

TEST(Reference, EveryMessageHasOneChapter) {
  const std::vector<Chapter> chapters = ScenarioReference(Contract());
  for (const Chapter& chapter : chapters) {
    EXPECT_EQ(std::ranges::count(chapters, chapter.name, &Chapter::name), 1) << chapter.name;
  }
}

TEST(Reference, TypesAreInWords) {
  const std::vector<Chapter> chapters = ScenarioReference(Contract());
  const Chapter& scenario = ChapterOf(chapters, "Scenario");
  EXPECT_EQ(TermOf(scenario, "title").type, "text");
  EXPECT_EQ(TermOf(scenario, "bodies").type, "list of Body");
  EXPECT_EQ(TermOf(scenario, "solver").type, "Solver");
  EXPECT_EQ(TermOf(scenario, "end_time_s").type, "number");
  EXPECT_EQ(TermOf(ChapterOf(chapters, "Body"), "fixed").type, "true or false");
  EXPECT_EQ(TermOf(ChapterOf(chapters, "Solver"), "max_steps").type, "whole number");
}

TEST(Reference, EnumsListTheirValuesWithoutTheOneForNone) {
  const std::vector<Chapter> chapters = ScenarioReference(Contract());
  const Term& method = TermOf(ChapterOf(chapters, "Solver"), "method");
  ASSERT_EQ(method.values.size(), 2U);
  EXPECT_EQ(method.values[0].name, "ADAPTIVE");
  EXPECT_EQ(method.values[1].name, "RK4");
  EXPECT_TRUE(method.values[0].type.empty());
}

TEST(Reference, RequiredChoiceIsExactlyOne) {
  const Chapter load = ChapterOf(ScenarioReference(Contract()), "Load");
  EXPECT_NE(load.text.find("Exactly one of `constant`, `sine`"), std::string::npos) << load.text;
}

TEST(Reference, StarsOfFormulasAreNotMarkdown) {
  const std::string page = ReferenceInMarkdown(ScenarioReference(Contract()));
  EXPECT_NE(page.find("4/3 E\\* √R\\*"), std::string::npos);
  EXPECT_NE(page.find("`*`"), std::string::npos);
}

}  // namespace
}  // namespace contact::cli
