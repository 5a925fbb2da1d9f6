#pragma once

#include <memory>
#include <string>

#include "rpc/metrics/metrics_page.h"

namespace prometheus {
class Exposer;
}

namespace contact {

/// Serves the metrics page over HTTP, under `/metrics`.
class MetricsServer {
 public:
  /// `address`: HOST:PORT, port 0 being any free one. Null if it cannot be had.
  static std::unique_ptr<MetricsServer> Open(const std::string& address, MetricsSources sources);
  ~MetricsServer();

  int port() const;

 private:
  MetricsServer(const std::string& address, MetricsSources sources);

  const std::shared_ptr<MetricsPage> page_;
  const std::unique_ptr<prometheus::Exposer> exposer_;
};

}  // namespace contact
