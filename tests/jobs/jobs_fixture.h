#pragma once

#include <gmock/gmock.h>

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "jobs/job_manager.h"
#include "storage/sqlite/sqlite_store.h"
#include "testing/await.h"
#include "testing/fake_run.h"
#include "testing/fake_sources.h"
#include "testing/temp_directory.h"

namespace contact {

/// Two who submit for one tenant.
inline const Principal kAda{"ada", "acme", {Role::kSubmit}, "token"};
inline const Principal kBob{"bob", "acme", {Role::kSubmit}, "token"};

/// A ball that falls to a floor and bounces, for so long or practically for ever.
inline v1::Scenario BouncingBall(double end_time_s = 1e6) {
  v1::Scenario scenario;
  v1::Body& ball = *scenario.add_bodies();
  ball.set_name("ball");
  ball.set_mass_kg(1);
  ball.set_position_m(0.1);
  v1::Contact& floor = *scenario.add_contacts();
  floor.add_between("ball");
  floor.mutable_wall()->set_side(v1::Wall::LEFT);
  floor.set_stiffness(1e6);
  floor.set_restitution(1);  // Never comes to rest.
  scenario.add_loads()->mutable_gravity();
  scenario.mutable_solver()->set_max_steps(1'000'000'000'000);
  scenario.mutable_output()->set_sample_interval_s(0.25);
  scenario.mutable_output()->set_samples_per_contact(0);
  scenario.set_end_time_s(end_time_s);
  return scenario;
}

inline v1::CreateJobRequest RequestFor(v1::Scenario scenario, std::string request_id = "") {
  v1::CreateJobRequest request;
  *request.mutable_job()->mutable_scenario() = std::move(scenario);
  request.set_request_id(std::move(request_id));
  return request;
}

/// The event of a record, as a watcher gets it.
inline v1::Event ToEvent(const LogRecord& record) {
  v1::Event event;
  EXPECT_TRUE(event.ParseFromString(*record.event));
  EXPECT_EQ(event.payload_case(), record.kind);
  event.set_sequence(record.sequence);
  return event;
}

inline std::vector<v1::Event> ToEvents(const std::vector<LogRecord>& records) {
  std::vector<v1::Event> events;
  events.reserve(records.size());
  for (const LogRecord& record : records) events.push_back(ToEvent(record));
  return events;
}

/// Reads a cursor to its end, waiting where it waits.
class LogReader {
 public:
  std::function<void()> wake() {
    return [signal = signal_] {
      const std::lock_guard lock(signal->mutex);
      signal->woken = true;
      signal->changed.notify_all();
    };
  }

  /// The next events; none at the end, which `end` then tells.
  std::vector<v1::Event> Next(LogCursor& cursor, std::size_t max_bytes = 1 << 16) {
    for (;;) {
      std::vector<LogRecord> records;
      switch (end_ = cursor.Read(max_bytes, &records)) {
        case LogCursor::Next::kEvents:
          return ToEvents(records);
        case LogCursor::Next::kWait:
          Wait();
          break;
        default:
          return {};
      }
    }
  }

  std::vector<v1::Event> ToEnd(LogCursor& cursor, std::size_t max_bytes = 1 << 16) {
    std::vector<v1::Event> all;
    for (auto events = Next(cursor, max_bytes); !events.empty(); events = Next(cursor, max_bytes)) {
      all.insert(all.end(), events.begin(), events.end());
    }
    return all;
  }

  LogCursor::Next end() const { return end_; }

  /// Until it is woken.
  void Wait() {
    std::unique_lock lock(signal_->mutex);
    if (!signal_->changed.wait_for(lock, kPatience, [&] { return signal_->woken; })) {
      throw std::runtime_error("nobody wakes the reader");
    }
    signal_->woken = false;
  }

 private:
  struct Signal {
    std::mutex mutex;
    std::condition_variable changed;
    bool woken = false;
  };

  std::shared_ptr<Signal> signal_ = std::make_shared<Signal>();
  LogCursor::Next end_ = LogCursor::Next::kWait;
};

/// A manager with its store in a folder of its own, a fake solver, and calls that wait.
class JobsTest : public testing::Test {
 protected:
  // Leaves what a killed process would leave: a copy of its files at this moment.
  void Crash() {
    TempDirectory image;
    for (const char* file : {"contactd.db", "contactd.db-wal", "initialised"}) {
      std::filesystem::copy(directory_.path() / file, image.path() / file);
    }
    manager_.reset();
    store_.reset();
    for (const auto& file : std::filesystem::directory_iterator(directory_.path())) {
      std::filesystem::remove(file);
    }
    std::filesystem::copy(image.path(), directory_.path());
  }

  void Open(JobOptions options = {}, StoreOptions store_options = {}) {
    manager_.reset();
    store_.reset();
    auto opened = OpenSqlite(directory_.path(), std::move(store_options));
    ASSERT_TRUE(opened.ok()) << opened.status();
    store_ = *std::move(opened);
    manager_ = std::make_unique<JobManager>(*store_, clock_, ids_, std::move(options));
  }
  JobOptions WithFakeRun(JobOptions options = {}) {
    options.run = [this](const Scenario& scenario, Observer& observer,
                         const std::stop_token& stop) { return run_(scenario, observer, stop); };
    return options;
  }
  void OpenWithFakeRun() { Open(WithFakeRun()); }
  ~JobsTest() override { manager_.reset(); }

  Result<v1::Job> Create(const v1::CreateJobRequest& request) {
    Await<Result<v1::Job>> result;
    manager_->creator().Create(LocalPrincipal(), request, result.callback());
    return result.Get();
  }
  /// Name of a new job.
  std::string Create(v1::Scenario scenario = BouncingBall()) {
    return Create(RequestFor(std::move(scenario))).value().name();
  }
  Result<v1::Job> Get(const std::string& name) {
    Await<Result<v1::Job>> result;
    manager_->reader().Get(LocalPrincipal(), name, result.callback());
    return result.Get();
  }
  Result<v1::Job> Cancel(const std::string& name, const std::string& expected_uid = "") {
    v1::CancelJobRequest request;
    request.set_name(name);
    request.set_expected_uid(expected_uid);
    Await<Result<v1::Job>> result;
    manager_->Cancel(LocalPrincipal(), request, result.callback());
    return result.Get();
  }
  Result<v1::Job> Update(const v1::UpdateJobRequest& request) {
    Await<Result<v1::Job>> result;
    manager_->Update(LocalPrincipal(), request, result.callback());
    return result.Get();
  }
  /// Replaces labels of a job.
  Result<v1::Job> Relabel(const std::string& name, const std::string& key,
                          const std::string& value) {
    v1::UpdateJobRequest request;
    request.mutable_job()->set_name(name);
    (*request.mutable_job()->mutable_labels())[key] = value;
    return Update(request);
  }
  Result<bool> Delete(const std::string& name, const std::string& expected_uid = "") {
    v1::DeleteJobRequest request;
    request.set_name(name);
    request.set_expected_uid(expected_uid);
    Await<Result<bool>> result;
    manager_->Delete(LocalPrincipal(), request, result.callback());
    return result.Get();
  }
  Result<v1::ListJobsResponse> List(const v1::ListJobsRequest& request) {
    Await<Result<v1::ListJobsResponse>> result;
    manager_->reader().List(LocalPrincipal(), request, result.callback());
    return result.Get();
  }
  Result<WatchedJob> Watch(const std::string& name, LogReader& reader, std::uint64_t after = 0,
                           const std::vector<std::string>& kinds = {}) {
    v1::WatchJobRequest request;
    request.set_name(name);
    request.set_after_sequence(after);
    request.mutable_kinds()->Add(kinds.begin(), kinds.end());
    request.mutable_delivery()->set_overflow(v1::DeliveryOptions::LAG);
    return Watch(request, reader);
  }
  Result<WatchedJob> Watch(const v1::WatchJobRequest& request, LogReader& reader) {
    // A promise of what can only be moved.
    auto box = std::make_shared<std::promise<Result<WatchedJob>>>();
    manager_->watches().WatchJob(
        LocalPrincipal(), request, reader.wake(),
        [box](Result<WatchedJob> result) { box->set_value(std::move(result)); });
    return box->get_future().get();
  }
  /// The log of a job, waiting for its end.
  std::vector<v1::Event> Log(const std::string& name, std::uint64_t after = 0,
                             const std::vector<std::string>& kinds = {}) {
    LogReader reader;
    const auto watched = Watch(name, reader, after, kinds);
    return reader.ToEnd(*watched.value().cursor);
  }
  /// Waits for the end of a job and returns it.
  v1::Job Ended(const std::string& name) {
    Log(name, 0, {"state_changed"});
    return Get(name).value();
  }

  TempDirectory directory_;
  FakeClock clock_{std::chrono::milliseconds(1)};
  CountingIds ids_;
  FakeRun run_;
  std::unique_ptr<Store> store_;
  std::unique_ptr<JobManager> manager_;
};

}  // namespace contact
