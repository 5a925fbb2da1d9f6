#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "base/clock.h"
#include "base/ids.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "jobs/job_manager.h"
#include "rpc/grpc_server.h"
#include "storage/sqlite/sqlite_store.h"
#include "testing/await.h"
#include "testing/temp_directory.h"

namespace contact {

/// A whole server in this process, in a folder of its own, without a door.
class TestServer {
 public:
  explicit TestServer(const GrpcServerOptions& options = {}, JobOptions jobs = {.workers = 2})
      : store_(OpenSqlite(folder_.path()).value()),
        jobs_(*store_, SystemClock(), RandomIds(), std::move(jobs)),
        server_(jobs_, *store_, options, {}) {
    server_.Start();
    stub_ = v1::JobService::NewStub(Connect());
  }

  ~TestServer() {
    server_.Shutdown(std::chrono::seconds(1));
    jobs_.Stop();
  }

  TestServer(const TestServer&) = delete;
  TestServer& operator=(const TestServer&) = delete;

  GrpcServer& grpc() { return server_; }
  JobManager& jobs() { return jobs_; }
  Store& store() { return *store_; }
  v1::JobService::Stub& stub() { return *stub_; }

  /// A channel of its own. One who does not read holds up the server's writes.
  std::shared_ptr<grpc::Channel> Connect() const { return server_.Inside(); }

  /// Submits a job and returns its name.
  std::string Create(const v1::Scenario& scenario) {
    v1::CreateJobRequest request;
    *request.mutable_job()->mutable_scenario() = scenario;
    grpc::ClientContext context;
    v1::Job job;
    const grpc::Status status = stub().CreateJob(&context, request, &job);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return job.name();
  }

 private:
  const TempDirectory folder_;
  const std::unique_ptr<Store> store_;
  JobManager jobs_;
  GrpcServer server_;
  std::unique_ptr<v1::JobService::Stub> stub_;
};

/// Reason of a failed call, from its details.
inline std::string Reason(const grpc::Status& status) {
  google::rpc::Status details;
  details.ParseFromString(status.error_details());
  google::rpc::ErrorInfo info;
  for (const auto& detail : details.details()) {
    if (detail.UnpackTo(&info)) return info.reason();
  }
  return "";
}

/// Two balls that meet once.
inline v1::Scenario Collision() {
  v1::Scenario scenario;
  for (const auto* name : {"A", "B"}) {
    auto* body = scenario.add_bodies();
    body->set_name(name);
    body->set_mass_kg(0.5);
    body->set_radius_m(0.05);
  }
  scenario.mutable_bodies(0)->set_velocity_m_per_s(0.2);
  scenario.mutable_bodies(1)->set_position_m(0.1);
  auto* contact = scenario.add_contacts();
  contact->add_between("A");
  contact->add_between("B");
  contact->set_stiffness(1e8);
  contact->set_restitution(0.8);
  scenario.set_end_time_s(4e-3);
  return scenario;
}

/// A driven ball that hits a wall again and again: events for longer than any test lasts.
inline v1::Scenario Endless() {
  v1::Scenario scenario;
  auto* ball = scenario.add_bodies();
  ball->set_name("ball");
  ball->set_mass_kg(0.5);
  ball->set_radius_m(0.05);
  ball->set_position_m(-0.01);
  auto* contact = scenario.add_contacts();
  contact->add_between("ball");
  contact->mutable_wall()->set_position_m(0.048);
  contact->mutable_wall()->set_side(v1::Wall::RIGHT);
  contact->set_stiffness(1.8e7);
  contact->set_restitution(0.9);
  auto* support = scenario.add_supports();
  support->set_body("ball");
  support->set_stiffness_n_per_m(1e6);
  support->set_damping_n_s_per_m(100);
  auto* load = scenario.add_loads();
  load->set_body("ball");
  load->mutable_sine()->set_amplitude_n(250);
  load->mutable_sine()->set_angular_frequency_rad_per_s(2000);
  scenario.mutable_solver()->set_max_steps(1'000'000'000'000);
  scenario.mutable_output()->set_sample_interval_s(1e-4);
  scenario.set_end_time_s(900);
  return scenario;
}

}  // namespace contact
