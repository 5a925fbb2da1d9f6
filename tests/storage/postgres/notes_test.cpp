#include "storage/postgres/notes.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace contact::postgres {
namespace {

std::vector<Note> Told(WaitingNotes& waiting) {
  std::vector<Note> notes;
  for (const std::string& text : waiting.Take()) {
    EXPECT_LE(text.size(), WaitingNotes::kMostBytes);
    for (Note& note : NotesOf(text)) notes.push_back(std::move(note));
  }
  return notes;
}

TEST(Notes, ArriveAsTheyWereTold) {
  WaitingNotes waiting;
  waiting.Add({.name = "jobs/a", .tenant = "a b\n\xff", .last_sequence = 7, .state = 3});
  waiting.Add({.kind = Note::Kind::kProgress, .name = "jobs/a", .progress = std::string(9, '\0')});
  waiting.Add({.kind = Note::Kind::kCancel, .name = "jobs/b"});
  const std::vector<Note> told = Told(waiting);
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told[0].tenant, "a b\n\xff");
  EXPECT_EQ(told[0].last_sequence, 7U);
  EXPECT_EQ(told[0].state, 3);
  EXPECT_EQ(told[1].kind, Note::Kind::kCancel);
  EXPECT_EQ(told[2].progress, std::string(9, '\0'));
  EXPECT_TRUE(waiting.empty());
}

TEST(Notes, OfOneJobBecomeOneThatForgetsNoState) {
  WaitingNotes waiting;
  waiting.Add({.name = "jobs/a", .tenant = "t", .last_sequence = 9, .state = 2});
  waiting.Add({.name = "jobs/a", .tenant = "t", .last_sequence = 8});
  const std::vector<Note> told = Told(waiting);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].last_sequence, 9U);
  EXPECT_EQ(told[0].state, 2);
}

TEST(Notes, ManyAreSplitIntoTextsThatFit) {
  WaitingNotes waiting;
  for (int i = 0; i < 1000; ++i) waiting.Add({.name = "jobs/" + std::to_string(i)});
  EXPECT_EQ(Told(waiting).size(), 1000U);
}

TEST(Notes, TextThatIsNoneIsLeftOut) {
  EXPECT_TRUE(NotesOf("").empty());
  EXPECT_TRUE(NotesOf("hello\n\n9 jobs/a  0 0 \n1 jobs/a ? 0 0 \n").empty());
}

}  // namespace
}  // namespace contact::postgres
