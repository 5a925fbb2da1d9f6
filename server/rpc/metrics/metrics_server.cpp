#include "rpc/metrics/metrics_server.h"

#include <prometheus/exposer.h>

#include <exception>
#include <utility>

namespace contact {

std::unique_ptr<MetricsServer> MetricsServer::Open(const std::string& address,
                                                   MetricsSources sources) {
  try {
    return std::unique_ptr<MetricsServer>(new MetricsServer(address, std::move(sources)));
  } catch (const std::exception&) {
    return nullptr;
  }
}

MetricsServer::MetricsServer(const std::string& address, MetricsSources sources)
    : page_(std::make_shared<MetricsPage>(std::move(sources))),
      exposer_(std::make_unique<prometheus::Exposer>(address)) {
  exposer_->RegisterCollectable(page_);
}

MetricsServer::~MetricsServer() = default;

int MetricsServer::port() const { return exposer_->GetListeningPorts().front(); }

}  // namespace contact
