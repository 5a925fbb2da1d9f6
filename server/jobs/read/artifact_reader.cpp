#include "jobs/read/artifact_reader.h"

#include <utility>

#include "jobs/read/artifact_maker.h"

namespace contact {

ArtifactReader::ArtifactReader(Store& store, Executor& executor, ArtifactPlan plan,
                               std::function<void()> wake,
                               std::shared_ptr<std::atomic<int>> readers)
    : readers_(std::move(readers)),
      maker_(std::make_shared<ArtifactMaker>(store, executor, std::move(plan), std::move(wake))) {}

ArtifactReader::~ArtifactReader() { --*readers_; }

ArtifactReader::Next ArtifactReader::Read(v1::ReadArtifactResponse* out) {
  Next next = Next::kWait;
  bool begin = false;
  maker_->Do([&](ArtifactMaker::Made& made) {
    if (!made.chunks.empty()) {
      *out = std::move(made.chunks.front());
      made.chunks.pop_front();
      next = out->has_artifact() ? Next::kEnd : Next::kData;
    } else if (made.error) {
      error_ = *made.error;
      next = Next::kFailed;
    } else {
      begin = !std::exchange(made.working, true);
    }
  });
  if (begin) maker_->Continue();
  return next;
}

}  // namespace contact
