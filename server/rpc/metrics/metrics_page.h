#pragma once

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jobs/job/job_metrics.h"
#include "rpc/metrics/rpc_metrics.h"
#include "rpc/metrics/stream_metrics.h"
#include "storage/store_metrics.h"

namespace contact {

/// Where the numbers of the metrics come from.
struct MetricsSources {
  /// The numbers that are counted nowhere and are taken when they are asked for.
  struct Now {
    /// Threads that run simulations.
    int workers = 0;
    /// Jobs in state QUEUED.
    int queued_jobs = 0;
    /// Jobs in state RUNNING.
    int running_jobs = 0;
    /// Streams that are open.
    std::size_t watchers = 0;
    /// Connections that are open.
    std::size_t connections = 0;
    /// Connections past a limit, since the start.
    std::int64_t refused_connections = 0;
    /// Size of the database files.
    std::optional<std::int64_t> stored_bytes = 0;
    /// Time until the server's certificate ends; nothing without TLS.
    std::optional<double> tls_seconds_left = {};
    /// Changes of the files of TLS, and of tokens and rules, that could not be used.
    std::int64_t tls_failures = 0;
    std::int64_t identity_failures = 0;
  };
  /// Takes them. Thread-safe.
  std::function<Now()> now;
  std::shared_ptr<const JobMetrics> jobs;
  std::shared_ptr<const StoreMetrics> store;
  std::shared_ptr<const RpcMetrics> rpc;
  std::shared_ptr<const StreamMetrics> streams;
};

/// The metrics of the server in Prometheus's form; the site's reference lists them. Thread-safe.
class MetricsPage final : public prometheus::Collectable {
 public:
  explicit MetricsPage(MetricsSources sources) : sources_(std::move(sources)) {}

  /// All metrics as they are now.
  std::vector<prometheus::MetricFamily> Collect() const override;
  /// The same as Prometheus's text.
  std::string Text() const;

 private:
  const MetricsSources sources_;
};

}  // namespace contact
