#pragma once

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "jobs/job/job_metrics.h"
#include "rpc/metrics/rpc_metrics.h"
#include "rpc/metrics/stream_metrics.h"
#include "storage/store_metrics.h"

namespace contact {

/// Where the numbers of the metrics come from.
struct MetricsSources {
  /// What is so at the moment of asking.
  struct Now {
    int workers = 0;
    int queued_jobs = 0;
    int running_jobs = 0;
    std::size_t watchers = 0;
    std::size_t connections = 0;
    std::int64_t refused_connections = 0;  ///< Since the start.
    std::int64_t stored_bytes = 0;
  };
  std::function<Now()> now;
  std::shared_ptr<const JobMetrics> jobs;
  std::shared_ptr<const StoreMetrics> store;
  std::shared_ptr<const RpcMetrics> rpc;
  std::shared_ptr<const StreamMetrics> streams;
};

/// Tells Prometheus what the server counts; server/README.md lists it. Thread-safe.
class MetricsPage final : public prometheus::Collectable {
 public:
  explicit MetricsPage(MetricsSources sources) : sources_(std::move(sources)) {}

  std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  const MetricsSources sources_;
};

}  // namespace contact
