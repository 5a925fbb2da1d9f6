// What cluster_benchmark.py compares a cluster with, and clients of it that take less time than
// Python's.
//
//   cluster_peer submit JOBS CALLS FRONT...           creates jobs by gRPC, so many calls at a time
//   cluster_peer submit-small JOBS CALLS FRONT...     the same, jobs that record no trajectory
//   cluster_peer watch JOB WATCHERS SECONDS FRONT...  watches cycles of a job
//   cluster_peer libpq-submit ADDRESS JOB JOBS CONNECTIONS
//   cluster_peer libpq-front ADDRESS JOB              serves CreateJob, until its input ends
//   cluster_peer libpq-run ADDRESS JOB CONNECTIONS [SOLVE]
//
// The last three do what fronts and workers do, with the same statements in the same transactions
// but without a service: they create copies of JOB, which has ended, and claim, begin and end all
// that wait. SOLVE: they compute them, too, and store what they have found. Each prints a line of
// figures, libpq-front its address.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <future>
#include <iostream>
#include <latch>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bare_front.h"
#include "base/ids.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "simulation/model/observer.h"
#include "simulation/run.h"
#include "storage/postgres/statements.h"
#include "storage/postgres/worker_statements.h"
#include "testing/watch_crowd.h"
#include "wire/ledger_codec.h"
#include "wire/result_codec.h"
#include "wire/scenario/scenario_codec.h"

namespace contact {
namespace {

using postgres::Connection;
using postgres::Statement;
using std::chrono::steady_clock;
using testing::Percentile;
using testing::WatchCrowd;
using Words = std::vector<std::string>;

constexpr int kClaim = 32;

double SecondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

template <class T>
T OrThrow(absl::StatusOr<T> value) {
  if (!value.ok()) throw std::runtime_error(value.status().ToString());
  return *std::move(value);
}

void InThreads(int count, const std::function<void(int)>& run) {
  std::vector<std::future<void>> threads;
  for (int i = 0; i < count; ++i) threads.push_back(std::async(std::launch::async, run, i));
  for (auto& thread : threads) thread.get();
}

// The chain of the paper's section 6.1, which takes about a millisecond.
v1::CreateJobRequest Chain() {
  v1::CreateJobRequest request;
  v1::Scenario& scenario = *request.mutable_job()->mutable_scenario();
  for (int i = 0; i < 3; ++i) {
    v1::Body& body = *scenario.add_bodies();
    body.set_name(fmt::format("B{}", i + 1));
    body.set_mass_kg(0.5);
    body.set_radius_m(0.05);
    body.set_position_m(0.1 * i);
  }
  scenario.mutable_bodies(0)->set_velocity_m_per_s(0.2);
  for (int i = 0; i < 2; ++i) {
    v1::Contact& contact = *scenario.add_contacts();
    contact.add_between(scenario.bodies(i).name());
    contact.add_between(scenario.bodies(i + 1).name());
    contact.set_stiffness(1e8);
    contact.set_restitution(i == 0 ? 0.8 : 0.7);
  }
  scenario.mutable_solver()->set_restitution_tolerance(1e-8);
  scenario.set_end_time_s(4e-3);
  return request;
}

// Calls of one program, so many at a time, over a few connections to each front.
class Submitter {
 public:
  Submitter(v1::CreateJobRequest request, int jobs, int calls, const Words& fronts)
      : request_(std::move(request)), jobs_(jobs), calls_(calls), ended_(calls) {
    for (int i = 0; i < kConnections; ++i) {
      for (const std::string& front : fronts) {
        grpc::ChannelArguments apart;
        apart.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
        stubs_.push_back(v1::JobService::NewStub(
            grpc::CreateCustomChannel(front, grpc::InsecureChannelCredentials(), apart)));
      }
    }
  }

  void Run() {
    for (int i = 0; i < calls_; ++i) Next(static_cast<std::size_t>(i) % stubs_.size());
    ended_.wait();
    if (const int failed = failed_; failed > 0) {
      throw std::runtime_error(fmt::format("{} jobs were not created", failed));
    }
  }

 private:
  static constexpr int kConnections = 2;
  struct Call {
    grpc::ClientContext context;
    v1::Job job;
  };

  // A call, and after it the next over the same connection.
  void Next(std::size_t connection) {
    if (next_++ >= jobs_) return ended_.count_down();
    auto call = std::make_shared<Call>();
    stubs_[connection]->async()->CreateJob(
        &call->context, &request_, &call->job,
        [this, connection, call](const grpc::Status& status) mutable {
          if (!status.ok()) ++failed_;
          call.reset();  // The last call must not live longer than the program.
          Next(connection);
        });
  }

  const v1::CreateJobRequest request_;
  const int jobs_, calls_;
  std::latch ended_;
  std::vector<std::unique_ptr<v1::JobService::Stub>> stubs_;
  std::atomic<int> next_ = 0, failed_ = 0;
};

void SubmitLike(const v1::CreateJobRequest& request, const Words& words) {
  const int jobs = std::stoi(words[0]);
  Submitter submitter(request, jobs, std::stoi(words[1]), {words.begin() + 2, words.end()});
  const auto start = steady_clock::now();
  submitter.Run();
  fmt::print("{:.0f}\n", jobs / SecondsSince(start));
}

void Submit(const Words& words) { SubmitLike(Chain(), words); }

void SubmitSmall(const Words& words) {
  v1::CreateJobRequest request = Chain();
  request.mutable_job()->mutable_scenario()->mutable_output()->set_ledger_only(true);
  SubmitLike(request, words);
}

// Prints median and 99th percentile [ms].
void Watch(const Words& words) {
  std::vector<std::unique_ptr<WatchCrowd>> crowds;
  for (std::size_t front = 3; front < words.size(); ++front) {
    WatchCrowd::Options options;
    options.address = words[front];
    options.request.set_name(words[0]);
    options.request.add_kinds("cycle");
    options.request.set_live_only(true);
    options.watchers = std::stoi(words[1]) / static_cast<int>(words.size() - 3);
    options.connections = options.watchers / 100 + 1;
    crowds.push_back(std::make_unique<WatchCrowd>(options));
  }
  for (const auto& crowd : crowds) crowd->AwaitAttached(std::chrono::seconds(60));
  std::this_thread::sleep_for(std::chrono::seconds(std::stoi(words[2])));
  std::vector<double> all;
  for (const auto& crowd : crowds) {
    const auto figures = crowd->figures();
    if (figures.failed > 0) throw std::runtime_error("some cannot watch");
    all.insert(all.end(), figures.latencies_ms.begin(), figures.latencies_ms.end());
  }
  std::ranges::sort(all);
  fmt::print("{:.1f} {:.1f} {}\n", Percentile(all, 50), Percentile(all, 99), all.size());
}

// A job that has ended, and how it came to that.
struct Sample {
  v1::Job job;
  std::vector<v1::Event> events;
  JobChange run;
};

Sample ReadSample(Connection& connection, const std::string& name) {
  StoredJob stored = OrThrow(postgres::JobOf(
      OrThrow(connection.Run(postgres::ReadJob(name, std::nullopt, JobPart::kAll))), name));
  stored.MergeResult();
  const EventQuery query{.name = name};
  std::vector<v1::Event> events;
  for (const StoredEvent& event :
       OrThrow(postgres::EventsOf(OrThrow(connection.Run(postgres::ReadEvents(query))), query))
           .events) {
    v1::Event parsed;
    if (event.sequence > 1 && event.Parse(&parsed)) events.push_back(std::move(parsed));
  }
  JobChange run = ToChange({.name = name, .take = true, .job = &stored.job, .events = events});
  return {std::move(stored.job), std::move(events), std::move(run)};
}

void RunAll(Connection& connection, const std::vector<Statement>& statements) {
  std::vector<const Statement*> all;
  for (const Statement& statement : statements) all.push_back(&statement);
  if (!all.empty()) OrThrow(connection.Run(all));
}

std::unique_ptr<Connection> Connect(const std::string& address) {
  return OrThrow(Connection::Open(address));
}

// A job that waits, like the one that has ended.
v1::Job LikeThat(const std::string& address, const std::string& name) {
  const v1::Job ended = ReadSample(*Connect(address), name).job;
  v1::Job job;
  *job.mutable_scenario() = ended.scenario();
  *job.mutable_create_time() = ended.create_time();
  job.set_owner(ended.owner());
  job.set_tenant(ended.tenant());
  job.set_state(v1::Job::QUEUED);
  return job;
}

Statement Copy(v1::Job job) {
  job.set_name("jobs/" + RandomIds().NextId());
  job.set_uid(RandomIds().NextUuid());
  v1::Event event;
  *event.mutable_event_time() = job.create_time();
  event.mutable_state_changed()->set_state(v1::Job::QUEUED);
  JobInsert insert = ToInsert({job, "", {&event, 1}});
  insert.limits.waiting = 10'000;
  return postgres::CreateJob(insert);
}

void LibpqFront(const Words& words) {
  const v1::Job like = LikeThat(words[0], words[1]);
  const BareFront front(Connect(words[0]), [&like] { return Copy(like); });
  fmt::print("127.0.0.1:{}\n", front.port());
  std::fflush(stdout);
  std::cin.get();
}

void LibpqSubmit(const Words& words) {
  const int jobs = std::stoi(words[2]);
  const int connections = std::stoi(words[3]);
  const v1::Job like = LikeThat(words[0], words[1]);
  std::atomic<int> next = 0;
  const auto start = steady_clock::now();
  InThreads(connections, [&](int) {
    const auto connection = Connect(words[0]);
    while (next < jobs) {
      // As many as come together when 64 clients call.
      std::vector<Statement> statements;
      for (int i = 0; i < 64 / connections && next++ < jobs; ++i) statements.push_back(Copy(like));
      RunAll(*connection, statements);
    }
  });
  fmt::print("{:.0f}\n", jobs / SecondsSince(start));
}

// Computes a job as a worker does, and makes of it what is to be stored.
class Solver : public Observer {
 public:
  Solver(const Sample& sample, const v1::Job& claimed)
      : sample_(sample), job_(sample.job), scenario_(Decoded(claimed)) {
    job_.set_name(claimed.name());
    job_.clear_cycles();
    job_.clear_groups();
    job_.clear_final_bodies();
  }

  JobChange Run() {
    for (const v1::Event& event : sample_.events) {
      if (!IsRecorded(event)) events_.push_back(event);
    }
    EncodeOutcome(scenario_, contact::Run(scenario_, *this), &job_);
    return ToChange({.name = job_.name(), .take = true, .job = &job_, .events = events_});
  }

  // The events that the methods below add.
  static bool IsRecorded(const v1::Event& event) {
    return event.has_iteration() || event.has_cycle() || event.has_group() ||
           event.has_frame_chunk();
  }

  void OnIteration(const Iteration& iteration) override {
    *events_.emplace_back().mutable_iteration() = Encode(scenario_, iteration);
  }
  void OnCycle(const Cycle& cycle) override {
    *events_.emplace_back().mutable_cycle() = *job_.add_cycles() = Encode(scenario_, cycle);
  }
  void OnGroup(const Group& group) override {
    *events_.emplace_back().mutable_group() = *job_.add_groups() = Encode(scenario_, group);
  }
  void OnSamples(const Samples& samples) override {
    *events_.emplace_back().mutable_frame_chunk() = Encode(scenario_, samples);
  }

 private:
  static Scenario Decoded(const v1::Job& claimed) {
    DecodedScenario decoded = DecodeScenario(claimed.scenario(), {});
    if (!decoded.violations.empty()) throw std::runtime_error("a job came without its scenario");
    return std::move(decoded.scenario);
  }

  const Sample& sample_;
  v1::Job job_;
  const Scenario scenario_;
  std::vector<v1::Event> events_;
};

JobChange Repeat(const Sample& sample, const v1::Job& claimed) {
  JobChange run = sample.run;
  run.name = claimed.name();
  return run;
}

// Prints jobs and events a second.
void LibpqRun(const Words& words) {
  const Sample sample = ReadSample(*Connect(words[0]), words[1]);
  const bool solve = words.size() > 3;
  std::atomic<std::size_t> jobs = 0, events = 0;
  const auto start = steady_clock::now();
  InThreads(std::stoi(words[2]), [&](int number) {
    const auto connection = Connect(words[0]);
    const std::string worker = fmt::format("peer{}", number);
    OrThrow(connection->Run(postgres::Beat({.name = worker, .host = "h"})));
    const Statement claim = postgres::Claim({.worker = worker, .most = kClaim});
    std::vector<StoredJob> claimed;
    do {
      claimed = postgres::ClaimedOf(OrThrow(connection->Run(claim)));
      std::vector<Statement> ends;
      for (const StoredJob& job : claimed) {
        const JobChange run = solve ? Solver(sample, job.job).Run() : Repeat(sample, job.job);
        events += run.events.size();
        ends.push_back(postgres::ChangeJob(run, job.epoch));
      }
      RunAll(*connection, ends);
      jobs += claimed.size();
    } while (!claimed.empty());
  });
  const double seconds = SecondsSince(start);
  fmt::print("{:.0f} {:.0f}\n", static_cast<double>(jobs) / seconds,
             static_cast<double>(events) / seconds);
}

int Main(const Words& words) {
  const std::map<std::string, std::pair<std::size_t, void (*)(const Words&)>> kinds = {
      {"submit", {3, Submit}},
      {"submit-small", {3, SubmitSmall}},
      {"watch", {4, Watch}},
      {"libpq-submit", {4, LibpqSubmit}},
      {"libpq-front", {2, LibpqFront}},
      {"libpq-run", {3, LibpqRun}}};
  const auto kind = words.empty() ? kinds.end() : kinds.find(words[0]);
  if (kind == kinds.end() || words.size() <= kind->second.first) {
    fmt::print(stderr, "cluster_peer submit|watch|libpq-submit|libpq-run ..., see its source\n");
    return EXIT_FAILURE;
  }
  try {
    kind->second.second({words.begin() + 1, words.end()});
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    fmt::print(stderr, "cluster_peer: {}\n", error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) { return contact::Main({argv + 1, argv + argc}); }
