// The service from outside: contactd in a process of its own, beside bare gRPC on the same host.
// Prints one table. All counts and times are bounded; --tiny only shows that it runs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server_process.h"
#include "testing/watch_crowd.h"

namespace contact {
namespace {

using std::chrono::steady_clock;
using testing::Percentile;
using testing::WatchCrowd;
using namespace std::chrono_literals;

constexpr auto kPatience = 120s;
constexpr double kEndless = 1e5;
constexpr int kMessageBytes = 256 * 1024;

struct Sizes {
  int submits = 4'000;
  int jobs = 6'000;
  std::int64_t samples = 500'000;
  int streamed_messages = 240;  ///< As many bytes as the samples have.
  int streams = 9;
  std::chrono::milliseconds watched = 4s;
  std::vector<int> crowds = {1, 100, 1'000};
  double run_end_s = 40;
  int run_rounds = 3;
  int idle_watchers = 10'000;
};

Sizes TinySizes() {
  return {.submits = 64,
          .jobs = 64,
          .samples = 10'000,
          .streamed_messages = 4,
          .streams = 1,
          .watched = 200ms,
          .crowds = {1, 10},
          .run_end_s = 0.2,
          .run_rounds = 1,
          .idle_watchers = 100};
}

void PrintRow(const std::string& what, const std::string& contactd, const std::string& beside) {
  fmt::print("{:<52} {:>22}   {}\n", what, contactd, beside);
  std::fflush(stdout);
}

double SecondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

// Jobs.

/// The paper's chain: about a millisecond of work.
v1::Job Chain() {
  v1::Job job;
  v1::Scenario& scenario = *job.mutable_scenario();
  for (int i = 0; i < 3; ++i) {
    v1::Body& body = *scenario.add_bodies();
    body.set_name(fmt::format("B{}", i + 1));
    body.set_mass_kg(0.5);
    body.set_radius_m(0.05);
    body.set_position_m(0.1 * i);
  }
  scenario.mutable_bodies(0)->set_velocity_m_per_s(0.2);
  v1::Contact& contact = *scenario.add_contacts();
  for (const v1::Body& body : scenario.bodies()) contact.add_between(body.name());
  contact.set_stiffness(1e8);
  contact.set_restitution(0.8);
  scenario.set_end_time_s(4e-3);
  return job;
}

/// Bodies that fly apart: nothing to solve, `samples` rows of 120 bytes to record.
v1::Job Flight(std::int64_t samples) {
  v1::Job job = Chain();
  v1::Scenario& scenario = *job.mutable_scenario();
  for (v1::Body& body : *scenario.mutable_bodies()) body.set_velocity_m_per_s(0);
  scenario.mutable_bodies(2)->set_velocity_m_per_s(0.2);
  scenario.mutable_output()->set_sample_interval_s(scenario.end_time_s() /
                                                   static_cast<double>(samples));
  return job;
}

/// A driven ball that hits a wall again and again; only the ledger is kept.
v1::Job DrivenBall(double end_time_s) {
  v1::Job job;
  v1::Scenario& scenario = *job.mutable_scenario();
  v1::Body& ball = *scenario.add_bodies();
  ball.set_name("ball");
  ball.set_mass_kg(0.5);
  ball.set_radius_m(0.05);
  ball.set_position_m(-0.01);
  v1::Contact& contact = *scenario.add_contacts();
  contact.add_between("ball");
  contact.mutable_wall()->set_position_m(0.048);
  contact.mutable_wall()->set_side(v1::Wall::RIGHT);
  contact.set_stiffness(1.8e7);
  contact.set_restitution(0.9);
  v1::Support& support = *scenario.add_supports();
  support.set_body("ball");
  support.set_stiffness_n_per_m(1e6);
  support.set_damping_n_s_per_m(100);
  v1::Load& constant = *scenario.add_loads();
  constant.set_body("ball");
  constant.mutable_constant()->set_force_n(500);
  v1::Load& sine = *scenario.add_loads();
  sine.set_body("ball");
  sine.mutable_sine()->set_amplitude_n(250);
  sine.mutable_sine()->set_angular_frequency_rad_per_s(2000);
  scenario.mutable_output()->set_ledger_only(true);
  scenario.mutable_solver()->set_max_steps(1'000'000'000'000);
  scenario.set_end_time_s(end_time_s);
  return job;
}

/// The same in steps so small that it makes about a hundred events a second.
v1::Job Paced(double end_time_s) {
  v1::Job job = DrivenBall(end_time_s);
  job.mutable_scenario()->mutable_solver()->set_method(v1::Solver::RK4);
  job.mutable_scenario()->mutable_solver()->set_step_s(1e-7);
  return job;
}

/// Calls of one client on a connection of its own.
class Client {
 public:
  explicit Client(const std::string& address) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    stub_ = v1::JobService::NewStub(
        grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments));
  }

  v1::Job Create(const v1::Job& job) {
    v1::CreateJobRequest request;
    *request.mutable_job() = job;
    return Call<v1::Job>(&v1::JobService::Stub::CreateJob, request);
  }
  v1::Job Get(const std::string& name) {
    return Call<v1::Job>(&v1::JobService::Stub::GetJob, Named<v1::GetJobRequest>(name));
  }
  void Cancel(const std::string& name) {
    Call<v1::Job>(&v1::JobService::Stub::CancelJob, Named<v1::CancelJobRequest>(name));
  }

  /// Waits until no job is queued or running.
  void AwaitIdle() {
    for (const auto start = steady_clock::now(); SecondsSince(start) < 120;) {
      const auto info =
          Call<v1::ServerInfo>(&v1::JobService::Stub::GetServerInfo, v1::GetServerInfoRequest());
      if (info.queued_jobs() + info.running_jobs() == 0) return;
      std::this_thread::sleep_for(2ms);
    }
    throw std::runtime_error("the jobs do not end");
  }

  v1::Job AwaitState(const std::string& name, v1::Job::State state) {
    for (const auto start = steady_clock::now(); SecondsSince(start) < 120;) {
      v1::Job job = Get(name);
      if (job.state() == state) return job;
      std::this_thread::sleep_for(10ms);
    }
    throw std::runtime_error(name + " does not get there");
  }

 private:
  template <class Request>
  static Request Named(const std::string& name) {
    Request request;
    request.set_name(name);
    return request;
  }

  template <class Response, class Method, class Request>
  Response Call(Method method, const Request& request) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kPatience);
    context.set_wait_for_ready(true);  // Many connect at once to a server that has much to do.
    Response response;
    const grpc::Status status = ((*stub_).*method)(&context, request, &response);
    if (!status.ok()) throw std::runtime_error(status.error_message());
    return response;
  }

  std::unique_ptr<v1::JobService::Stub> stub_;
};

/// Milliseconds that each of `calls` submits took, sorted; `clients` work at once.
std::vector<double> Submit(const std::string& address, const v1::Job& job, int clients, int calls) {
  const auto submit = [&address, &job, n = std::max(1, calls / clients)] {
    std::vector<double> own;
    Client client(address);
    for (int i = 0; i < n; ++i) {
      const auto start = steady_clock::now();
      client.Create(job);
      own.push_back(1e3 * SecondsSince(start));
    }
    return own;
  };
  std::vector<std::future<std::vector<double>>> each;
  for (int i = 0; i < clients; ++i) each.push_back(std::async(std::launch::async, submit));
  std::vector<double> all;
  for (auto& future : each) {
    const std::vector<double> own = future.get();
    all.insert(all.end(), own.begin(), own.end());
  }
  std::ranges::sort(all);
  return all;
}

void SubmitLatency(const std::string& contactd, const std::string& bare, const Sizes& sizes) {
  const auto show = [](const std::vector<double>& ms) {
    return fmt::format("{:.2f} / {:.2f} ms", Percentile(ms, 50), Percentile(ms, 99));
  };
  Client client(contactd);
  for (const int clients : {1, 16, 64}) {
    const int calls = clients == 1 ? sizes.submits / 4 : sizes.submits;
    const auto ours = Submit(contactd, Chain(), clients, calls);
    client.AwaitIdle();
    const auto theirs = Submit(bare, Chain(), clients, calls);
    PrintRow(fmt::format("submit, {} clients, p50 / p99", clients), show(ours),
             "bare unary call and one fdatasync: " + show(theirs));
  }
}

/// Both rates of short jobs: how fast they are taken, and how fast they are done.
void JobRate(const ServerProcess& contactd, const Sizes& sizes) {
  Client client(contactd.address());
  const double cpu = contactd.CpuSeconds();
  const auto start = steady_clock::now();
  const auto calls = Submit(contactd.address(), Chain(), 64, sizes.jobs);
  const double acknowledged = static_cast<double>(calls.size()) / SecondsSince(start);
  client.AwaitIdle();
  const double completed = static_cast<double>(calls.size()) / SecondsSince(start);
  PrintRow("1-ms jobs, acknowledged durably while 64 submit",
           fmt::format("{:.0f} jobs/s", acknowledged),
           fmt::format("goal 2000; p50 / p99 {:.2f} / {:.2f} ms", Percentile(calls, 50),
                       Percentile(calls, 99)));
  PrintRow("1-ms jobs, completed, from first submit to last result",
           fmt::format("{:.0f} jobs/s", completed),
           fmt::format("{:.2f} ms CPU of contactd a job, with its solving",
                       1e3 * (contactd.CpuSeconds() - cpu) / static_cast<double>(calls.size())));
}

WatchCrowd::Options Watchers(const std::string& address, const std::string& name, int watchers) {
  WatchCrowd::Options options;
  options.address = address;
  options.request.set_name(name);
  options.watchers = watchers;
  options.connections = std::max(1, watchers / 100);
  return options;
}

/// What one watcher gets of a server, stream after stream.
class Streams {
 public:
  Streams(const ServerProcess& server, std::string name)
      : server_(server), name_(std::move(name)), cpu_(server.CpuSeconds()) {}

  void Run() {
    const auto start = steady_clock::now();
    WatchCrowd crowd(Watchers(server_.address(), name_, 1));
    if (!crowd.AwaitEnded(0, kPatience)) throw std::runtime_error("the stream does not end");
    const double megabytes = static_cast<double>(crowd.figures().bytes) / 1e6;
    megabytes_ += megabytes;
    rates_.push_back(megabytes / SecondsSince(start));
  }

  /// MB a second, in the middle of all.
  double Rate() const {
    std::vector<double> rates = rates_;
    std::ranges::sort(rates);
    return Percentile(rates, 50);
  }
  /// Milliseconds that the server uses for a MB.
  double Cost() const { return 1e3 * (server_.CpuSeconds() - cpu_) / megabytes_; }

 private:
  const ServerProcess& server_;
  const std::string name_;
  const double cpu_;
  double megabytes_ = 0;
  std::vector<double> rates_;
};

void Streaming(const ServerProcess& contactd, const ServerProcess& bare, const Sizes& sizes) {
  Client client(contactd.address());
  const std::string name = client.Create(Flight(sizes.samples)).name();
  client.AwaitState(name, v1::Job::SUCCEEDED);
  Streams ours(contactd, name);
  Streams theirs(bare, "jobs/any");
  for (int i = 0; i < sizes.streams; ++i) {
    ours.Run();
    theirs.Run();
  }
  PrintRow(
      "stored frames to one watcher",
      fmt::format("{:.0f} MB/s, {:.2f} ms/MB", ours.Rate(), ours.Cost()),
      fmt::format("bare stream of {} KiB messages: {:.0f} MB/s, {:.2f} ms/MB: {:.0f} %; goal 70",
                  kMessageBytes / 1024, theirs.Rate(), theirs.Cost(),
                  100 * ours.Rate() / theirs.Rate()));
}

void EventLatency(const std::string& contactd, const Sizes& sizes) {
  Client client(contactd);
  for (const int watchers : sizes.crowds) {
    for (const int stalled : {0, 1}) {
      if (stalled == watchers) continue;
      const std::string name = client.Create(Paced(kEndless)).name();
      WatchCrowd::Options options = Watchers(contactd, name, watchers);
      options.stalled = stalled;
      options.request.add_kinds("cycle");
      options.request.add_kinds("iteration");
      WatchCrowd crowd(options);
      if (!crowd.AwaitAttached(kPatience)) throw std::runtime_error("not all can watch");
      std::this_thread::sleep_for(sizes.watched);
      client.Cancel(name);
      crowd.AwaitEnded(stalled, kPatience);
      const auto figures = crowd.figures();
      PrintRow(fmt::format("event latency, {} watchers, {} stalled, p50 / p99", watchers, stalled),
               fmt::format("{:.1f} / {:.1f} ms", Percentile(figures.latencies_ms, 50),
                           Percentile(figures.latencies_ms, 99)),
               fmt::format("{} events received", figures.events));
    }
  }
}

/// What a run took, in seconds: by the clock, and of a core.
struct RunTime {
  double wall = std::numeric_limits<double>::infinity();
  double cpu = wall;
};

RunTime Least(const RunTime& a, const RunTime& b) {
  return {std::min(a.wall, b.wall), std::min(a.cpu, b.cpu)};
}

/// Of a run with so many watchers.
RunTime TimeOf(const ServerProcess& contactd, const v1::Job& job, int watchers) {
  Client client(contactd.address());
  const double before = contactd.WorkerSeconds();
  const std::string name = client.Create(job).name();
  std::optional<WatchCrowd> crowd;
  if (watchers > 0) crowd.emplace(Watchers(contactd.address(), name, watchers));
  const double wall = client.AwaitState(name, v1::Job::SUCCEEDED).summary().wall_time_s();
  return {wall, contactd.WorkerSeconds() - before};
}

void SolverSlowdown(const ServerProcess& contactd, const Sizes& sizes, const std::string& what,
                    const v1::Job& job) {
  RunTime alone;
  RunTime watched;
  for (int i = 0; i < sizes.run_rounds; ++i) {
    alone = Least(alone, TimeOf(contactd, job, 0));
    watched = Least(watched, TimeOf(contactd, job, 100));
  }
  PrintRow(fmt::format("solver slow-down by 100 watchers, {}", what),
           fmt::format("{:+.1f} %", 100 * (watched.wall / alone.wall - 1)),
           fmt::format("{:.2f} s alone, {:.2f} s watched; CPU of the worker {:+.1f} %; goal 1 %",
                       alone.wall, watched.wall, 100 * (watched.cpu / alone.cpu - 1)));
}

/// Twice: as the system places the threads, which counts what watchers and clients take of the
/// cores, and with a core for the solver alone, which counts what the service itself disturbs.
void SolverSlowdown(const ServerProcess& contactd, const Sizes& sizes) {
  const v1::Job few = Paced(sizes.run_end_s / 100);
  const v1::Job dense = DrivenBall(sizes.run_end_s);
  SolverSlowdown(contactd, sizes, "few events", few);
  SolverSlowdown(contactd, sizes, "dense", dense);
  if (std::thread::hardware_concurrency() < 2) return;
  const WorkersApart apart(contactd);
  SolverSlowdown(contactd, sizes, "few, own core", few);
  SolverSlowdown(contactd, sizes, "dense, own core", dense);
}

void IdleMemory(const ServerProcess& contactd, const Sizes& sizes) {
  Client client(contactd.address());
  std::vector<std::string> names;
  for (unsigned i = 0; i <= std::max(1U, std::thread::hardware_concurrency()); ++i) {
    names.push_back(client.Create(Paced(kEndless)).name());  // The last one finds no worker.
  }
  const double before = contactd.ResidentMegabytes();
  {
    WatchCrowd crowd(Watchers(contactd.address(), names.back(), sizes.idle_watchers));
    if (!crowd.AwaitAttached(kPatience)) throw std::runtime_error("not all can watch");
    PrintRow(fmt::format("memory with {} idle watchers", sizes.idle_watchers),
             fmt::format("{:.0f} MB", contactd.ResidentMegabytes()),
             fmt::format("{:.0f} MB before; goal 450 MB", before));
  }
  for (const std::string& name : names) client.Cancel(name);
  client.AwaitIdle();
}

/// `only`: the measurement to make; all of them if empty.
int RunAll(const std::string& self, const std::string& binary, const Sizes& sizes,
           const std::string& only) {
  const auto wanted = [&only](const char* name) { return only.empty() || only == name; };
  const std::string watchers = std::to_string(sizes.idle_watchers + 100);
  const ServerProcess contactd({binary, "--log-level=off", "--max-creates-per-second=0",
                                "--max-watchers=" + watchers,
                                "--max-watchers-per-peer=" + watchers});
  const ServerProcess bare({self, "--bare", "--messages", std::to_string(sizes.streamed_messages)});
  if (wanted("submit")) SubmitLatency(contactd.address(), bare.address(), sizes);
  if (wanted("jobs")) JobRate(contactd, sizes);
  if (wanted("frames")) Streaming(contactd, bare, sizes);
  if (wanted("latency")) EventLatency(contactd.address(), sizes);
  if (wanted("slowdown")) SolverSlowdown(contactd, sizes);
  if (wanted("memory")) IdleMemory(contactd, sizes);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace contact

int main(int argc, char** argv) {
  CLI::App app("Measures contactd beside bare gRPC.");
  std::string contactd;
  std::string data_dir;
  std::string listen;
  std::string only;
  bool tiny = false;
  bool bare = false;
  int messages = 1;
  app.add_option("--contactd", contactd, "The server's binary");
  app.add_option("--only", only, "Make one measurement")
      ->check(CLI::IsMember({"submit", "jobs", "frames", "latency", "slowdown", "memory"}));
  app.add_flag("--tiny", tiny, "Only show that it runs");
  app.add_flag("--bare", bare, "Be the server of bare gRPC")->group("");
  app.add_option("--messages", messages)->group("");
  app.add_option("--listen", listen)->group("");
  app.add_option("--data-dir", data_dir)->group("");
  CLI11_PARSE(app, argc, argv);
  if (bare) return contact::ServeBare(data_dir, messages, contact::kMessageBytes);
  try {
    return contact::RunAll("/proc/self/exe", contactd,
                           tiny ? contact::TinySizes() : contact::Sizes(), only);
  } catch (const std::exception& error) {
    fmt::print(stderr, "service_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
}
