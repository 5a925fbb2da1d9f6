#pragma once

#include <memory>
#include <utility>

#include "contact/v1/job_service.pb.h"
#include "jobs/log/stream_source.h"
#include "jobs/quota/places.h"
#include "jobs/read/artifact_maker.h"

namespace contact {

/// Reads an artifact: it is made from the log piece by piece, no faster than it is read. Not
/// thread-safe: one reader. Destroying it ends the making.
class ArtifactReader final : public StreamSource<v1::ReadArtifactResponse> {
 public:
  /// `place` is kept until the reader is destroyed.
  ArtifactReader(std::shared_ptr<ArtifactMaker> maker, Places::Place place)
      : maker_(std::move(maker)), place_(std::move(place)) {}

  /// The last message has the artifact with size and SHA-256.
  StreamStep Read(v1::ReadArtifactResponse* out) override { return maker_->Take(out); }

 private:
  const std::shared_ptr<ArtifactMaker> maker_;
  const Places::Place place_;
};

}  // namespace contact
