#include "cli/help/contract/glossary.h"

#include <gmock/gmock.h>

#include <set>

#include "cli/base/failure.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {
namespace {

using testing::HasSubstr;

class GlossaryTest : public testing::Test {
 protected:
  const Contract contract_;
  const std::vector<WordList> glossary_ = Glossary(contract_);
};

TEST_F(GlossaryTest, EveryWordIsExplained) {
  for (const WordList& list : glossary_) {
    EXPECT_FALSE(list.text.empty()) << list.name;
    EXPECT_GT(list.words.size(), 1U) << list.name;
    for (const Word& word : list.words) {
      EXPECT_FALSE(word.text.empty()) << word.of << " " << word.name;
      EXPECT_FALSE(word.name.ends_with("UNSPECIFIED")) << word.name;
    }
  }
}

TEST_F(GlossaryTest, HasEveryWordOfALedger) {
  std::set<std::string> words;
  for (const WordList& list : glossary_) {
    for (const Word& word : list.words) words.insert(word.name);
  }
  for (const auto* type : {v1::Cycle::Kind_descriptor(), v1::Cycle::End_descriptor(),
                           v1::Cycle::Status_descriptor(), v1::Group::Growth_descriptor()}) {
    for (int i = 1; i < type->value_count(); ++i) {
      EXPECT_TRUE(words.contains(type->value(i)->name())) << type->value(i)->name();
    }
  }
}

TEST_F(GlossaryTest, TextIsThatOfTheContract) {
  const std::vector<Word> found = FindWords(glossary_, "nirv");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "NIRV");
  EXPECT_EQ(found[0].of, "Cycle.Kind");
  EXPECT_EQ(found[0].text,
            "Without an initial relative velocity: touching at rest, or still "
            "compressed.");
}

TEST_F(GlossaryTest, WordOfTwoEnumsIsExplainedTwice) {
  const std::vector<Word> found = FindWords(glossary_, "JUMP");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].of, "Cycle.Status");
  EXPECT_EQ(found[1].of, "Group.Growth");
}

TEST_F(GlossaryTest, UnknownWordComesWithTheNearestOne) {
  for (const auto& [word, told] : {std::pair("infeasable", "did you mean 'INFEASIBLE'?"),
                                   {"friction", "contactctl explain shows all words"}}) {
    try {
      FindWords(glossary_, word);
      ADD_FAILURE() << word;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      EXPECT_THAT(failure.what(), HasSubstr(told));
    }
  }
}

}  // namespace
}  // namespace contact::cli
