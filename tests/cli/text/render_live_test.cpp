#include "cli/text/render_live.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>

#include "cli/text/render_progress.h"
#include "from_text.h"

namespace contact::cli {
namespace {

v1::Event Iteration(int number, bool accepted) {
  v1::Event event = EventFrom(R"(iteration { episode: 1 unknowns {
      contact: "B1-B2" mu: 2.25e8 restitution_out: 0.79 restitution_in: 0.8 update: NEWTON } })");
  event.mutable_iteration()->set_number(number);
  event.mutable_iteration()->set_accepted(accepted);
  return event;
}

// What a view writes when its rows and messages go to one file.
template <class Show>
std::string Shown(LiveView::Options options, Show show) {
  std::FILE* file = std::tmpfile();
  {
    options.rows = options.messages = file;
    LiveView view(std::move(options));
    show(view);
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

TEST(LiveView, IterationTableGrows) {
  const std::string text = Shown({}, [](LiveView& view) {
    view.OnEvent(Iteration(0, false));
    view.OnTick();
    view.OnEvent(Iteration(1, true));
  });
  EXPECT_EQ(text,
            "EPISODE   n  CONTACT                      μ         ε OUT    |Δε|/ε  NEXT\n"
            "      1   0  B1-B2                225000000          0.79   1.3e-02  NEWTON\n"
            "      1   1  B1-B2                225000000          0.79   1.3e-02  accepted\n");
}

TEST(LiveView, AttemptTellsWhereItBegins) {
  const std::string text = Shown({}, [](LiveView& view) {
    view.OnEvent(EventFrom("attempt_started { attempt: 1 }"));
    view.OnEvent(EventFrom("attempt_started { attempt: 1 resume_time_s: 0.0215 }"));
    view.OnEvent(EventFrom("attempt_started { attempt: 2 }"));
    view.OnEvent(EventFrom("progress { cells: 50 cells_done: 3 }"));
    view.OnEvent(EventFrom("attempt_started { attempt: 3 }"));
  });
  EXPECT_EQ(text,
            "attempt 1 goes on from t = 21.5 ms; what was recorded before follows again\n"
            "attempt 2 starts anew\n"
            "attempt 3 goes on; the cells that were solved are kept\n");
}

TEST(LiveView, ManyIterationsEndInAHint) {
  const std::string text = Shown({.most_iterations = 2, .job = "k3v9"}, [](LiveView& view) {
    for (int i = 0; i < 5; ++i) view.OnEvent(Iteration(i, false));
  });
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
  EXPECT_THAT(text, testing::EndsWith("… more iterations; contactctl watch k3v9 shows all\n"));
}

TEST(LiveView, ShowsWhatHappenedToAJob) {
  const std::string text = Shown({}, [](LiveView& view) {
    view.OnEvent(EventFrom("state_changed { state: RUNNING }"));
    view.OnEvent(EventFrom("attempt_started { attempt: 2 }"));
    view.OnEvent(EventFrom("log_entry { severity: WARNING message: 'no velocity' }"));
    view.OnEvent(EventFrom(R"(cycle { contact: "a-b" number: 1 kind: NIRV end: SEPARATION
        status: CONVERGED start_time_s: 1 end_time_s: 2 restitution_out: 0.5 })"));
    view.OnEvent(EventFrom("state_changed { state: FAILED state_reason: 'NUMERIC' message: 'm' }"));
    view.OnEvent(EventFrom("bookmark {}"));
    view.OnEvent(EventFrom("frame_chunk {}"));
    view.OnEvent({});
  });
  EXPECT_EQ(text,
            "RUNNING\n"
            "attempt 2 starts anew\n"
            "warning: no velocity\n"
            "a-b cycle 1: NIRV to SEPARATION, CONVERGED from 1 s to 2 s, ε 0.5\n"
            "FAILED (NUMERIC): m\n");
}

TEST(LiveView, TellsOfEachGrowthAndOfGroupsThatCyclesDoNotTell) {
  const std::string text = Shown({}, [](LiveView& view) {
    view.OnEvent(EventFrom(R"(group_growth { contact: "a-b" first_cycle: 1 cycles: 1
        growth: TOO_LITTLE })"));
    view.OnEvent(EventFrom(R"(group_growth { contact: "a-b" first_cycle: 1 cycles: 2
        growth: TOO_MUCH })"));
    view.OnEvent(EventFrom(R"(group { contact: "a-b" number: 1 first_cycle: 1 cycles: 1
        status: CONVERGED })"));
    view.OnEvent(EventFrom(R"(group { contact: "a-b" number: 2 first_cycle: 2 cycles: 3
        status: CONVERGED mu: 5e6 restitution_out: 0.5 })"));
  });
  EXPECT_EQ(text,
            "a-b cycle 1 and the next share one μ: too little comes back even at μ = 0\n"
            "a-b cycles 1 to 2 and the next share one μ: too much comes back at every μ\n"
            "a-b group 2, cycle 2 to 4: CONVERGED, μ 5000000, ε 0.5\n");
}

TEST(LiveView, GrowthsAfterTheLastIterationShownAreNotShownEither) {
  const std::string text = Shown({.most_iterations = 1}, [](LiveView& view) {
    for (int i = 0; i < 2; ++i) view.OnEvent(Iteration(i, false));
    view.OnEvent(EventFrom("group_growth { growth: JUMP }"));
  });
  EXPECT_THAT(text, testing::EndsWith("shows all\n"));
}

TEST(RenderProgress, FitsTheWidth) {
  v1::Progress progress;
  progress.set_time_s(1);
  progress.set_end_time_s(4);
  progress.set_cycles(12);
  progress.set_iterations(30);
  EXPECT_EQ(RenderProgress(progress, 2, 0),
            "━━━━━━──────────────────  25 %  t = 1 of 4 s, 12 cycles, 30 iterations, 6 s left");
  for (const int width : {10, 40, 80, 200}) {
    EXPECT_LE(Width(RenderProgress(progress, 2, width)), width);
  }
}

TEST(RenderProgress, TellsWhatKeepsALongRunBusy) {
  v1::Progress progress;
  progress.set_end_time_s(4);
  EXPECT_THAT(ProgressWords(progress, 2), testing::Not(testing::HasSubstr("busy")));
  progress.set_busy_with("ball-floor, δ 1e-9 m");
  EXPECT_THAT(ProgressWords(progress, 2), testing::EndsWith("; busy: ball-floor, δ 1e-9 m"));
}

TEST(RenderProgress, NeedsNoUtf8) {
  v1::Progress progress;
  progress.set_time_s(1);
  progress.set_end_time_s(2);
  const std::string line = RenderProgress(progress, 3, 0, false);
  EXPECT_THAT(line, testing::StartsWith("############------------  50 %"));
  EXPECT_EQ(line.size(), static_cast<std::size_t>(Width(line)));
}

TEST(TimeLeft, IsToldOnceEnoughIsDone) {
  EXPECT_EQ(TimeLeft(0.005, 10), "");
  EXPECT_EQ(TimeLeft(0.25, 10), ", 30 s left");
}

TEST(RenderProgress, NothingKnownIsNothingDone) {
  EXPECT_THAT(RenderProgress({}, 0, 0), testing::HasSubstr("  0 %"));
}

}  // namespace
}  // namespace contact::cli
