#include "rpc/metrics/metrics_server.h"

#include <prometheus/exposer.h>

#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace contact {

namespace {

// A request that comes half holds a thread of the page until the time is over, and Prometheus needs
// one.
std::vector<std::string> OptionsFor(const std::string& address) {
  return {"listening_ports", address, "num_threads", "32", "request_timeout_ms", "500"};
}

}  // namespace

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
      exposer_(std::make_unique<prometheus::Exposer>(OptionsFor(address))) {
  exposer_->RegisterCollectable(page_);
}

MetricsServer::~MetricsServer() = default;

int MetricsServer::port() const { return exposer_->GetListeningPorts().front(); }

}  // namespace contact
