#pragma once

#include <gmock/gmock.h>
#include <google/protobuf/empty.pb.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include "cli/base/failure.h"
#include "cli/link/loopback_server.h"
#include "cli/verbs/verbs.h"
#include "contact/v1/job_service.grpc.pb.h"

namespace contact::cli {

/// The lines of a text.
inline std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// How a command line ended.
struct End {
  ExitCode code = ExitCode::kOk;
  /// What() of a failure.
  std::string told;
  /// What it wrote to the standard output.
  std::string printed;
  /// What it wrote to the standard error.
  std::string said;
};

/// Runs a command line in this process, against the server at `address`.
inline End EndOf(std::vector<std::string> words, const std::string& address = "127.0.0.1:1") {
  CommandLine line("A program.");
  AddGlobalFlags(line);
  AddVerbs(line);
  words.insert(words.begin(), {"--server", address});
  std::reverse(words.begin(), words.end());
  line.app().parse(words);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  End end;
  try {
    end.code = line.action()();
  } catch (const Failure& failure) {
    end.code = failure.code();
    end.told = failure.what();
  }
  std::fflush(stdout);
  end.printed = testing::internal::GetCapturedStdout();
  end.said = testing::internal::GetCapturedStderr();
  return end;
}

/// A JobService on a loopback port that knows the jobs that a test gives it before the first call,
/// and keeps the requests that it receives.
class ScriptedServer final : public v1::JobService::Service {
 public:
  const std::string& address() const { return server_.address(); }

  /// Adds a job after those that it has.
  v1::Job& Add(const std::string& name, v1::Job::State state) {
    jobs_.emplace_back();
    jobs_.back().set_name(name);
    jobs_.back().set_state(state);
    return jobs_.back();
  }

  /// The requests of one type, in the order of their arrival.
  template <class Request>
  std::vector<Request> Asked() const {
    const std::scoped_lock lock(mutex_);
    std::vector<Request> all;
    for (const auto& request : requests_) {
      if (const auto* one = dynamic_cast<const Request*>(request.get())) all.push_back(*one);
    }
    return all;
  }

  v1::ServerInfo info;
  v1::Series series;
  /// What a watch of any job brings before the end of the job.
  std::vector<v1::Event> events;
  /// Gives a job that was submitted its result.
  std::function<void(v1::Job&)> solve = [](v1::Job&) {};
  /// The most jobs in one answer to ListJobs.
  int page = 100;

 private:
  // Keeps a request. The lock is held until the call is answered.
  template <class Request>
  std::unique_lock<std::mutex> Keep(const Request& request) {
    std::unique_lock lock(mutex_);
    requests_.push_back(std::make_unique<Request>(request));
    return lock;
  }

  grpc::Status Find(const std::string& name, v1::Job* job) const {
    const auto found = std::ranges::find(jobs_, name, &v1::Job::name);
    if (found == jobs_.end()) return {grpc::StatusCode::NOT_FOUND, "there is no " + name};
    *job = *found;
    return grpc::Status::OK;
  }

  grpc::Status CreateJob(grpc::ServerContext*, const v1::CreateJobRequest* request,
                         v1::Job* job) override {
    const auto lock = Keep(*request);
    *job = request->job();
    job->set_name(created_++ == 0 ? "jobs/new" : "jobs/new" + std::to_string(created_));
    job->set_state(v1::Job::SUCCEEDED);  // As soon as anybody asks again.
    job->set_convergence(v1::Job::FULL);
    solve(*job);
    jobs_.push_back(*job);
    job->set_state(v1::Job::QUEUED);
    return grpc::Status::OK;
  }
  grpc::Status GetJob(grpc::ServerContext*, const v1::GetJobRequest* request,
                      v1::Job* job) override {
    const auto lock = Keep(*request);
    return Find(request->name(), job);
  }
  grpc::Status ListJobs(grpc::ServerContext*, const v1::ListJobsRequest* request,
                        v1::ListJobsResponse* answer) override {
    const auto lock = Keep(*request);
    std::vector<v1::Job> found = jobs_;
    std::erase_if(found, [request](const v1::Job& job) {
      return !job.name().starts_with(request->name_prefix());
    });
    const std::string& token = request->page_token();
    auto next = token.empty() ? std::size_t{0} : std::stoul(token);
    const auto end = std::min(
        found.size(), next + static_cast<std::size_t>(std::min(page, request->page_size())));
    while (next < end) *answer->add_jobs() = found[next++];
    if (next < found.size()) answer->set_next_page_token(std::to_string(next));
    return grpc::Status::OK;
  }
  grpc::Status CancelJob(grpc::ServerContext*, const v1::CancelJobRequest* request,
                         v1::Job* job) override {
    const auto lock = Keep(*request);
    return Find(request->name(), job);
  }
  grpc::Status UpdateJob(grpc::ServerContext*, const v1::UpdateJobRequest* request,
                         v1::Job* job) override {
    const auto lock = Keep(*request);
    *job = request->job();
    return grpc::Status::OK;
  }
  grpc::Status DeleteJob(grpc::ServerContext*, const v1::DeleteJobRequest* request,
                         google::protobuf::Empty*) override {
    const auto lock = Keep(*request);
    return grpc::Status::OK;
  }
  grpc::Status WatchJob(grpc::ServerContext*, const v1::WatchJobRequest* request,
                        grpc::ServerWriter<v1::WatchJobResponse>* writer) override {
    const auto lock = Keep(*request);
    v1::WatchJobResponse message;
    grpc::Status status = Find(request->name(), message.mutable_snapshot());
    if (!status.ok()) return status;
    message.mutable_snapshot()->set_last_sequence(events.size() + 1);
    for (const v1::Event& event : events) {
      *message.add_events() = event;
      message.mutable_events()->rbegin()->set_sequence(
          static_cast<std::uint64_t>(message.events_size()));
    }
    v1::Event& last = *message.add_events();
    last.set_sequence(events.size() + 1);
    last.mutable_state_changed()->set_state(message.snapshot().state());
    writer->Write(message);
    return grpc::Status::OK;
  }
  grpc::Status GetSeries(grpc::ServerContext*, const v1::GetSeriesRequest* request,
                         v1::Series* answer) override {
    const auto lock = Keep(*request);
    *answer = series;
    return grpc::Status::OK;
  }
  grpc::Status GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest* request,
                             v1::ServerInfo* answer) override {
    const auto lock = Keep(*request);
    *answer = info;
    return grpc::Status::OK;
  }

  mutable std::mutex mutex_;
  std::vector<v1::Job> jobs_;
  int created_ = 0;
  std::vector<std::unique_ptr<google::protobuf::Message>> requests_;
  LoopbackServer server_{this};
};

}  // namespace contact::cli
