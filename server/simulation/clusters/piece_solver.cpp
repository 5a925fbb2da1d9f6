#include "simulation/clusters/piece_solver.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "simulation/course/cut_cycles.h"
#include "simulation/course/telling.h"
#include "simulation/course/whereabouts.h"
#include "simulation/model/index.h"

namespace contact {
namespace {

// Place of a number in an ascending list that has it.
int Find(const std::vector<int>& in, int what) {
  return static_cast<int>(std::ranges::lower_bound(in, what) - in.begin());
}

void Rename(ContactState* state, int contact) {
  state->cycle.contact = state->member.group.contact = contact;
}

}  // namespace

PieceSolver::PieceSolver(const World& world, Observer& observer, std::stop_token stop)
    : world_(world), scenario_(world.scenario()), observer_(observer), stop_(std::move(stop)) {}

// The bodies of the cast, and after them the fixed ones that they may touch or hang on.
Scenario PieceSolver::PartOf(const Cast& cast) const {
  Scenario part;
  part.solver = scenario_.solver;
  part.end_time = scenario_.end_time;
  for (const int b : cast.bodies) {
    for (const int load : world_.LoadsOf(b)) {
      if (scenario_.loads[At(load)].end <= cast.time) continue;
      part.loads.push_back(scenario_.loads[At(load)]);
      part.loads.back().body = static_cast<int>(part.bodies.size());
    }
    part.bodies.push_back(scenario_.bodies[At(b)]);
  }
  std::vector<int> fixed;
  const auto side = [&](int body) {
    if (body == kNone) return kNone;
    if (!scenario_.bodies[At(body)].fixed) return Find(cast.bodies, body);
    const auto known = std::ranges::find(fixed, body);
    const auto place = static_cast<int>(std::ssize(cast.bodies) + (known - fixed.begin()));
    if (known != fixed.end()) return place;
    fixed.push_back(body);
    part.bodies.push_back(scenario_.bodies[At(body)]);
    part.bodies.back().position += world_.PlaceOf(body, cast.time).u;
    part.bodies.back().velocity = world_.PlaceOf(body, cast.time).v;
    for (const Drive& piece : world_.driven().PiecesFrom(body, cast.time)) {
      part.drives.push_back(piece);
      part.drives.back().body = place;
    }
    return place;
  };
  for (const int c : cast.contacts) {
    Contact contact = scenario_.contacts[At(c)];
    contact.left = side(contact.left);
    contact.right = side(contact.right);
    part.contacts.push_back(std::move(contact));
  }
  for (const int b : cast.bodies) {
    for (const int s : world_.SupportsOf(b)) {
      Support support = scenario_.supports[At(s)];
      support.body = side(support.body);
      support.other = side(support.other);
      part.supports.push_back(std::move(support));
    }
  }
  return part;
}

RunState PieceSolver::Begin(const Cast& cast, const Scenario& part, const RunState& run) const {
  RunState now;
  now.state.time = cast.time;
  now.state.step = cast.outlook.step;
  now.state.contacts = cast.states;
  for (std::size_t i = 0; i < cast.contacts.size(); ++i) {
    Rename(&now.state.contacts[i], static_cast<int>(i));
    now.warned.push_back(run.warned[At(cast.contacts[i])]);
    now.unproven.push_back(run.unproven[At(cast.contacts[i])]);
  }
  for (std::size_t i = 0; i < cast.bodies.size(); ++i) {
    now.state.positions.push_back(scenario_.bodies[At(cast.bodies[i])].position + cast.places[i].u);
    now.state.velocities.push_back(cast.places[i].v);
  }
  for (std::size_t i = cast.bodies.size(); i < part.bodies.size(); ++i) {
    now.state.positions.push_back(part.bodies[i].position);
    now.state.velocities.push_back(part.bodies[i].velocity);
  }
  now.state.slips.resize(part.supports.size());
  now.missed = run.missed;
  now.solved_until = cast.outlook.solved_until;
  now.record_until = cast.outlook.record_until;
  now.finely = cast.outlook.finely;
  now.cut_since = cast.outlook.cut_since;
  now.unknowns = cast.outlook.unknowns;
  now.rest_ends = cast.outlook.rest_ends;
  for (Unknown& unknown : now.unknowns)
    unknown.id.contact = Find(cast.contacts, unknown.id.contact);
  for (RestEnd& rest : now.rest_ends) {
    rest.before.contact = Find(cast.contacts, rest.before.contact);
  }
  return now;
}

// A piece under way, and all that solves it: a course on the scenario of its bodies.
struct PieceSolver::Work {
  Work(const PieceSolver& of, Cast start, const RunState& run)
      : piece(std::make_shared<Piece>()),
        part(of.PartOf(start)),
        now(of.Begin(start, part, run)),
        reporter(piece->start.contacts, start.time, of.observer_, &piece->report),
        course(part, reporter, of.stop_),
        writer(of.scenario_, course.motion(), piece->start.bodies, piece->start.contacts,
               &piece->trace) {
    piece->start = std::move(start);
    piece->end.places = piece->start.places;
    reporter.SetEpisode(piece->start.outlook.episode);
    course.Restore(now);
    course.motion().Restore(run.steps, run.evaluations);
    writer.Begin(piece->end.places);
  }

  // The state that the recording has reached.
  void Arrive() {
    now.state = course.motion().Save();
    for (std::size_t i = 0; i < piece->end.places.size(); ++i) {
      piece->end.places[i].u += course.motion().integrator().y0[static_cast<std::ptrdiff_t>(i)];
      piece->end.places[i].v = now.state.velocities[i];
    }
    writer.Begin(piece->end.places);
  }

  void Tell() {
    for (const Cycle& cycle : course.recorder().cycles) reporter.OnCycle(cycle);
    for (const Group& group : course.recorder().groups) reporter.OnGroup(group);
  }

  const std::shared_ptr<Piece> piece;
  const Scenario part;
  RunState now;
  Reporter reporter;
  Course course;
  TraceWriter writer;
};

std::shared_ptr<Piece> PieceSolver::Solve(Cast start, std::int64_t number, double until,
                                          const RunState& run) const {
  Work work(*this, std::move(start), run);
  work.piece->number = number;
  Go(until, &work);
  const Motion& motion = work.course.motion();
  const bool ended = EndOf(work.piece->pause) != Outcome::End::kFinished;
  work.piece->whereabouts = ended ? Whereabouts(work.part, motion) : BusyWith(work.part, motion);
  if (work.now.state.time >= scenario_.end_time) Cut(&work);
  Close(run, &work);
  return work.piece;
}

std::shared_ptr<Piece> PieceSolver::Look(Cast start, double until, const RunState& run) const {
  Work work(*this, std::move(start), run);
  work.piece->pause =
      work.course.Look(work.now.state, until, scenario_.solver.max_steps, work.writer);
  work.Arrive();
  Close(run, &work);
  return work.piece;
}

void PieceSolver::Go(double until, Work* work) const {
  Piece& piece = *work->piece;
  const std::int64_t most = scenario_.solver.max_steps;
  while (true) {
    const State& state = work->now.state;
    const bool solves = work->course.EpisodeIsNext(state);
    if (solves) {
      piece.has_episode = true;
      work->reporter.SetEpisode(static_cast<int>(piece.number));
    }
    const Course::Stretch stretch = solves ? work->course.Episode(state, 1, most, work->writer)
                                           : work->course.Flight(state, until, most, work->writer);
    piece.pause = stretch.pause;
    if (stretch.recorded) work->Tell();
    if (EndOf(stretch.pause) != Outcome::End::kFinished) return;
    if (!stretch.recorded) continue;
    work->Arrive();
    if (solves || state.time >= until) return;
  }
}

void PieceSolver::Cut(Work* work) const {
  const std::vector<Cycle> rows = CutCycles(work->part, work->course, &work->now.state);
  for (const Cycle& cycle : rows) work->reporter.OnCycle(cycle);
  for (const Group& group : work->course.recorder().groups) work->reporter.OnGroup(group);
  for (const ContactState& contact : work->now.state.contacts) {
    if (!InTouch(contact.phase)) continue;  // The cut has told of these what they have lost.
    const Cycle& cycle = contact.cycle;
    work->now.state.contact_loss += cycle.dissipated_compression + cycle.dissipated_restitution;
  }
}

void PieceSolver::Close(const RunState& run, Work* work) const {
  Piece* const piece = work->piece.get();
  RunState& now = work->now;
  work->course.Save(&now);
  piece->steps = now.steps - run.steps;
  piece->evaluations = now.evaluations - run.evaluations;
  Cast& end = piece->end;
  end.time = now.state.time;
  end.bodies = piece->start.bodies;
  end.contacts = piece->start.contacts;
  end.states = std::move(now.state.contacts);
  for (std::size_t i = 0; i < end.contacts.size(); ++i) Rename(&end.states[i], end.contacts[i]);
  const auto whole = [&](int contact) { return end.contacts[At(contact)]; };
  for (Unknown& unknown : now.unknowns) unknown.id.contact = whole(unknown.id.contact);
  for (RestEnd& rest : now.rest_ends) rest.before.contact = whole(rest.before.contact);
  end.outlook = {.step = now.state.step,
                 .solved_until = now.solved_until,
                 .record_until = now.record_until,
                 .finely = now.finely,
                 .cut_since = now.cut_since,
                 .unknowns = std::move(now.unknowns),
                 .rest_ends = std::move(now.rest_ends),
                 .episode = piece->has_episode ? static_cast<int>(piece->number)
                                               : piece->start.outlook.episode};
  piece->iterations = now.iterations;
  piece->growths = now.growths;
  piece->growths_no_progress = now.growths_no_progress;
  piece->loss = now.state.contact_loss + now.state.support_loss;
  piece->work = now.state.load_work;
  piece->impulse = now.state.impulse;
  for (std::size_t i = 0; i < end.bodies.size(); ++i) {
    const double steady = world_.SteadyForce(end.bodies[i]);
    piece->work -= steady * (end.places[i].u - piece->start.places[i].u);
    piece->impulse -= steady * (piece->ends() - piece->begins());
  }
  piece->warned = std::move(now.warned);
  piece->unproven = std::move(now.unproven);
  piece->missed = std::move(now.missed);
  std::ranges::stable_sort(piece->report.items, {}, &Report::Item::time);
}

}  // namespace contact
