// What it costs the server to make the messages of many watchers of one job: a message of their own
// for each, as a typed stream needs it, or one composed of bytes that all of them share. What gRPC
// adds to send a message is the same for both and not counted.

#include <benchmark/benchmark.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "contact/v1/job_service.pb.h"
#include "rpc/stream/watch_message.h"

namespace contact {
namespace {

v1::Event IterationEvent() {
  v1::Event event;
  event.mutable_event_time()->set_seconds(1'700'000'000);
  v1::Iteration& iteration = *event.mutable_iteration();
  iteration.set_episode(7);
  for (const auto* contact : {"B1-B2", "B2-B3"}) {
    v1::Iteration::Unknown& unknown = *iteration.add_unknowns();
    unknown.set_contact(contact);
    unknown.set_mu(2.25e8);
    unknown.set_restitution_in(0.8);
    unknown.set_restitution_out(0.8000001);
    unknown.set_residual(1e-7);
    unknown.set_update(v1::Iteration::NEWTON);
  }
  return event;
}

v1::Event FrameEvent() {
  v1::Event event;
  event.mutable_event_time()->set_seconds(1'700'000'000);
  v1::FrameChunk& chunk = *event.mutable_frame_chunk();
  chunk.set_samples(256);
  for (int i = 0; i < 15; ++i) {
    v1::FrameChunk::Column& column = *chunk.add_columns();
    column.set_name("B1.velocity");
    column.set_quantity("velocity");
    column.set_unit("m/s");
    column.set_values(std::string(std::size_t{256} * 8, '\1'));
  }
  return event;
}

// 32 iterations in a message, or one chunk of 256 samples of 15 columns.
std::vector<v1::Event> Batch(bool frames) {
  if (frames) return {FrameEvent()};
  return std::vector<v1::Event>(32, IterationEvent());
}

void Typed(benchmark::State& state, bool frames) {
  const std::vector<v1::Event> batch = Batch(frames);
  while (state.KeepRunning()) {
    std::vector<std::shared_ptr<const v1::Event>> log;
    for (const v1::Event& event : batch) log.push_back(std::make_shared<const v1::Event>(event));
    for (std::int64_t watcher = 0; watcher < state.range(0); ++watcher) {
      v1::WatchJobResponse message;
      for (const auto& event : log) *message.add_events() = *event;
      grpc::ByteBuffer buffer;
      bool own = false;
      benchmark::DoNotOptimize(
          grpc::SerializationTraits<v1::WatchJobResponse>::Serialize(message, &buffer, &own));
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(batch.size()));
}

void Shared(benchmark::State& state, bool frames) {
  const std::vector<v1::Event> batch = Batch(frames);
  while (state.KeepRunning()) {
    std::vector<LogRecord> log;
    for (const v1::Event& event : batch) log.push_back(ToRecord(log.size() + 1, event));
    for (std::int64_t watcher = 0; watcher < state.range(0); ++watcher) {
      WatchMessage message;
      for (const LogRecord& record : log) message.Add(record);
      benchmark::DoNotOptimize(message.Take());
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(batch.size()));
}

BENCHMARK_CAPTURE(Typed, iterations, false)->Arg(1)->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(Shared, iterations, false)->Arg(1)->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(Typed, frames, true)->Arg(1)->Arg(20)->Arg(100);
BENCHMARK_CAPTURE(Shared, frames, true)->Arg(1)->Arg(20)->Arg(100);

}  // namespace
}  // namespace contact

BENCHMARK_MAIN();
