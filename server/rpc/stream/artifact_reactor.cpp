#include "rpc/stream/artifact_reactor.h"

#include <utility>

#include "rpc/call/status.h"

namespace contact {

ArtifactReactor* ArtifactReactor::Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                                        grpc::CallbackServerContext* context,
                                        const v1::ReadArtifactRequest& request,
                                        std::chrono::milliseconds write_stall) {
  const std::shared_ptr<ArtifactReactor> self(
      new ArtifactReactor(context, request, write_stall, loop->metrics()));
  self->Own(self);
  const std::weak_ptr<ArtifactReactor> weak = self;
  loop->Add(self);
  jobs.ReadArtifact(
      request, [stream = std::weak_ptr<Stream>(self), loop] { loop->Wake(stream); },
      [weak](Result<std::unique_ptr<ArtifactReader>> result) {
        const auto reactor = weak.lock();
        if (!reactor) return;
        reactor->Step([&] {
          if (!result.ok()) return reactor->EndWith(ToGrpc(result.error()));
          reactor->reader_ = std::move(result.value());
        });
      });
  return self.get();  // Alive: gRPC calls OnDone only after it has been given the reactor.
}

bool ArtifactReactor::Next(v1::ReadArtifactResponse* out) {
  if (!reader_) return false;
  switch (reader_->Read(out)) {
    case ArtifactReader::Next::kData:
      return true;
    case ArtifactReader::Next::kWait:
      return false;
    case ArtifactReader::Next::kEnd:
      reader_ = nullptr;
      EndWith(grpc::Status::OK);
      return true;
    case ArtifactReader::Next::kFailed:
      EndWith(ToGrpc(reader_->error()));
      return false;
  }
  return false;
}

}  // namespace contact
