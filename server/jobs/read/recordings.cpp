#include "jobs/read/recordings.h"

#include <utility>

#include "jobs/read/artifact_plan.h"
#include "jobs/read/artifact_reader.h"
#include "jobs/read/series_reader.h"

namespace contact {

void Recordings::GetSeries(const Principal& caller, const v1::GetSeriesRequest& request,
                           Callback<v1::Series> done, Abandoned abandoned) {
  std::make_shared<SeriesReader>(store_, executor_, large_series_, limits_, caller.tenant, request,
                                 std::move(done), std::move(abandoned))
      ->Start();
}

void Recordings::ReadArtifact(const Principal& caller, const v1::ReadArtifactRequest& request,
                              Wake wake, Callback<Artifact> done) {
  if (request.offset() < 0) return done(OffsetOutOfRange(request.offset(), -1));
  Places::Place place = readers_.Take(caller);
  if (!place) return done(WatcherLimit(readers_.open(caller)));
  store_.ReadOf(
      caller.tenant, request.name(), JobPart::kAll,
      [this, request, wake = std::move(wake), done = std::move(done),
       place = std::move(place)](absl::StatusOr<StoredJob> stored) mutable {
        Result<ArtifactPlan> plan = stored.ok() ? PlanArtifact(*std::move(stored), request)
                                                : ToError(stored.status(), request.name());
        if (!plan.ok()) {
          place = nullptr;
          return done(plan.error());
        }
        auto maker =
            std::make_shared<ArtifactMaker>(store_, executor_, artifacts_, std::move(plan.value()),
                                            std::move(wake), BudgetOf(readers_));
        done(Artifact(std::make_unique<ArtifactReader>(std::move(maker), std::move(place))));
      });
}

}  // namespace contact
