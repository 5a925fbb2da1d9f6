#include "simulation/episode/timeline.h"

#include <gmock/gmock.h>

#include <set>

namespace contact {
namespace {

using ::testing::ElementsAre;

constexpr double kXi = 1e-8, kGood = 1e-3;

// Groups of contacts 0, 1, 2 … that separate, in order of start.
class TimelineTest : public ::testing::Test {
 protected:
  TimelineTest() { sight_.groups.reserve(16); }  // What Add returns stays where it is.

  GroupSight& Add(double start, double end, double miss) {
    GroupSight& g = sight_.groups.emplace_back();
    g.id.contact = static_cast<int>(sight_.groups.size()) - 1;
    g.sought = g.ended = g.separated = true;
    g.restitution_in = 0.5;
    g.start_time = start, g.end_time = end;
    g.squared = 0.25 * (1 + miss) * (1 + miss);
    sight_.time = std::max(sight_.time, end);
    groups_.At(g.id).mu = 1;
    return g;
  }
  Timeline Read(double end = 100) const {
    return {sight_, groups_, end, [this](const GroupId& id) { return settled_.contains(id); }};
  }
  static GroupId Of(int contact) { return {.contact = contact}; }

  Sight sight_;
  Groups groups_;
  std::set<GroupId> settled_;
};

TEST_F(TimelineTest, TheFirstMissIsTheFirstToEnd) {
  Add(0, 9, 0.1);
  Add(1, 3, 0.1);
  Add(2, 4, 0.1);
  EXPECT_EQ(Read().FirstMiss(kGood)->id, Of(1));
  EXPECT_EQ(Read().FirstMiss(0.2), nullptr);
}

TEST_F(TimelineTest, WhatBeginsAfterTheRunIsNoMiss) {
  Add(5, 6, 0.1);
  EXPECT_EQ(Read(4).FirstMiss(kGood), nullptr);
}

TEST_F(TimelineTest, ABlockIsWhatOverlapsTransitivelyAndEndsNoLater) {
  Add(0, 2, 0);  // Apart from all that follows.
  Add(3, 5, 0);  // Overlaps the next but one only.
  Add(4.5, 7, 0);
  const GroupSight& miss = Add(6, 8, 0.1);
  Add(7.5, 9, 0.1);  // Ends later.
  EXPECT_THAT(Read().Block(miss, 0, 30), ElementsAre(Of(1), Of(2), Of(3)));
  EXPECT_THAT(Read().Block(miss, 4, 30), ElementsAre(Of(1), Of(2), Of(3), Of(4)));
  EXPECT_THAT(Read().Block(miss, 3, 30), ElementsAre(Of(1), Of(2), Of(3)));
  EXPECT_THAT(Read().Block(miss, 0, 2), ElementsAre(Of(2), Of(3)));
}

TEST_F(TimelineTest, WhatIsSettledOrDecidedLeavesTheBlock) {
  Add(0, 5, 0);
  Add(1, 6, 0);
  const GroupSight& miss = Add(2, 7, 0.1);
  settled_.insert(Of(0));
  groups_.At(Of(1)).status = Cycle::Status::kJump;
  EXPECT_THAT(Read().Block(miss, 0, 30), ElementsAre(Of(2)));
}

TEST_F(TimelineTest, WhatWaitsIsNoMissAndInNoBlock) {
  Add(0, 5, 0.1);
  groups_.At(Of(0)).waits = true;
  const GroupSight& miss = Add(1, 6, 0.1);
  EXPECT_EQ(Read().FirstMiss(kGood)->id, Of(1));
  EXPECT_THAT(Read().Block(miss, 8, 30), ElementsAre(Of(1)));
}

TEST_F(TimelineTest, APoorGuessLeavesTheTurnToWhatBeganBeforeIt) {
  Add(0, 5, 0.1);
  Add(1, 3, 0.5);  // Of a μ that is far off, and ends too early.
  EXPECT_EQ(Read().FirstMiss(kGood)->id, Of(0));
  EXPECT_THAT(Read().Block(sight_.groups[0], 8, 30), ElementsAre(Of(0)));
  groups_.At(Of(1)).corrected = true;
  EXPECT_EQ(Read().FirstMiss(kGood)->id, Of(1));
  EXPECT_THAT(Read().Block(sight_.groups[0], 8, 30), ElementsAre(Of(1), Of(0)));
}

TEST_F(TimelineTest, AMissIsShownWithWhatOverlapsItOrMoreThanAFew) {
  Add(0, 2, 0.1);
  EXPECT_FALSE(Read().ShowsMiss(0.2, 8));
  EXPECT_TRUE(Read().ShowsMiss(kGood, 8));
  Add(1, 4, 0);
  Add(3, 0, 0).ended = false;  // Overlaps what the miss overlaps, and still runs.
  EXPECT_FALSE(Read().ShowsMiss(kGood, 8));
  EXPECT_TRUE(Read().ShowsMiss(kGood, 2));
}

TEST_F(TimelineTest, SolvedIsWhatMayStillBePolished) {
  Add(0, 1, 0);
  Add(2, 3, 1e-4);
  Add(4, 5, 0.1);
  Add(6, 7, 0).weak = true;
  EXPECT_THAT(Read().Solved(kXi, kGood), ElementsAre(Of(0), Of(1)));
  settled_ = {Of(0), Of(1)};
  EXPECT_THAT(Read().Solved(kXi, kGood), ElementsAre(Of(1)));
}

TEST_F(TimelineTest, FinalIsWhatEndsBeforeAllThatMayChange) {
  Add(0, 1, 0);
  Add(2, 5, 0);
  const GroupSight& miss = Add(4, 6, 0.1);
  EXPECT_EQ(Read().FinalUntil(&miss), 2);
  EXPECT_EQ(Read().FinalUntil(nullptr), 6);
}

TEST_F(TimelineTest, WhatIsSettledIsFinalIfAllThatOverlapsItIsSolvedAndSeenToEnd) {
  Add(2, 5, 0);
  Add(4, 7, 0);
  const GroupSight& miss = Add(6, 9, 0.1);
  settled_ = {Of(0), Of(1)};
  EXPECT_EQ(Read().FinalUntil(&miss), 4);  // The second overlaps what misses.
  sight_.groups[2].ended = false;          // And that overlaps what the first does.
  EXPECT_EQ(Read().FinalUntil(nullptr), 2);
}

TEST_F(TimelineTest, WhatTheNextOfItsEncounterMayJoinIsNotFinal) {
  Add(0, 1, 0).separated = false;
  const GroupSight& miss = Add(2, 3, 0.1);
  EXPECT_EQ(Read().FinalUntil(&miss), 0);
  sight_.groups.push_back(sight_.groups[0]);
  sight_.groups.back().id.place = 2;
  sight_.groups.back().start_time = 1, sight_.groups.back().end_time = 1.5;
  sight_.groups.back().separated = true;
  EXPECT_EQ(Read().FinalUntil(&sight_.groups[1]), 2);
}

}  // namespace
}  // namespace contact
