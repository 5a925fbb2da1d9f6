#pragma once

#include <memory>
#include <string>

#include "rpc/metrics/metrics_page.h"

namespace prometheus {
class Exposer;
}

namespace contact {

/// Serves the metrics page over HTTP under `/metrics`, on threads of its own, until it is
/// destroyed.
class MetricsServer {
 public:
  /// Listens on `address`, which is HOST:PORT with port 0 for any free one. Null if the address
  /// cannot be had.
  static std::unique_ptr<MetricsServer> Open(const std::string& address, MetricsSources sources);
  ~MetricsServer();

  /// The port that it listens on.
  int port() const;

 private:
  /// Throws if the address cannot be had.
  MetricsServer(const std::string& address, MetricsSources sources);

  /// Shared with the exposer, which has a weak reference only.
  const std::shared_ptr<MetricsPage> page_;
  const std::unique_ptr<prometheus::Exposer> exposer_;
};

}  // namespace contact
