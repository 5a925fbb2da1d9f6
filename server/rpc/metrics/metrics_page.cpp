#include "rpc/metrics/metrics_page.h"

#include <absl/status/status.h>
#include <prometheus/text_serializer.h>

#include <limits>
#include <string>
#include <utility>

namespace contact {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

// gRPC and absl share the numbers of codes and their names.
std::string CodeName(int code) {
  const std::string name = absl::StatusCodeToString(static_cast<absl::StatusCode>(code));
  return name.empty() ? "UNKNOWN" : name;
}

// Builds the families one after the other: Gauge, Counter or Distribution begins a family, and Add
// gives it one more set of labels.
class Page {
 public:
  Page& Gauge(const char* name, const char* help) { return Begin(name, help, MetricType::Gauge); }
  Page& Counter(const char* name, const char* help) {
    return Begin(name, help, MetricType::Counter);
  }
  Page& Distribution(const char* name, const char* help) {
    return Begin(name, help, MetricType::Histogram);
  }

  template <class Number>
  Page& Add(Number value, Labels labels = {}) {
    ClientMetric& metric = Next(std::move(labels));
    metric.gauge.value = metric.counter.value = static_cast<double>(value);
    return *this;
  }

  Page& Add(const Histogram& histogram, Labels labels = {}) {
    const Histogram::Snapshot snapshot = histogram.Get();
    ClientMetric::Histogram& out = Next(std::move(labels)).histogram;
    for (std::size_t i = 0; i < snapshot.counts.size(); ++i) {
      out.sample_count += static_cast<std::uint64_t>(snapshot.counts[i]);
      const bool last = i == snapshot.bounds.size();
      out.bucket.push_back(
          {out.sample_count, last ? std::numeric_limits<double>::infinity() : snapshot.bounds[i]});
    }
    out.sample_sum = snapshot.sum;
    return *this;
  }

  std::vector<MetricFamily> Take() { return std::move(families_); }

 private:
  Page& Begin(const char* name, const char* help, MetricType type) {
    families_.push_back({name, help, type, {}});
    return *this;
  }
  ClientMetric& Next(Labels labels) {
    ClientMetric& metric = families_.back().metric.emplace_back();
    metric.label = std::move(labels);
    return metric;
  }

  std::vector<MetricFamily> families_;
};

void AddNow(const MetricsSources::Now& now, Page* page) {
  page->Gauge("contactd_workers", "Threads that run simulations").Add(now.workers);
  page->Gauge("contactd_jobs", "Jobs that have not ended, by state")
      .Add(now.queued_jobs, {{"state", "QUEUED"}})
      .Add(now.running_jobs, {{"state", "RUNNING"}});
  page->Gauge("contactd_watchers", "Streams that are open").Add(now.watchers);
  page->Gauge("contactd_connections", "Connections that are open").Add(now.connections);
  page->Counter("contactd_connections_refused_total", "Connections past a limit")
      .Add(now.refused_connections);
  if (now.stored_bytes) {
    page->Gauge("contactd_store_bytes", "Size of the database files").Add(*now.stored_bytes);
  }
  page->Counter("contactd_identity_reload_failed_total",
                "Changes of tokens and rules that could not be used")
      .Add(now.identity_failures);
  page->Counter("contactd_tls_reload_failed_total",
                "Changes of certificate and key that could not be used")
      .Add(now.tls_failures);
  if (!now.tls_seconds_left) return;
  page->Gauge("contactd_tls_not_after_seconds", "Time until the certificate ends")
      .Add(*now.tls_seconds_left);
}

void AddJobs(const JobMetrics& jobs, Page* page) {
  page->Counter("contactd_job_moves_total", "Jobs that came into a state, by state and reason");
  for (const auto& [move, count] : jobs.moves()) {
    page->Add(count, {{"state", v1::Job::State_Name(move.first)}, {"reason", move.second}});
  }
  page->Distribution("contactd_job_wait_seconds", "From creation to the first start")
      .Add(jobs.wait_seconds);
  page->Distribution("contactd_job_run_seconds", "From the last start to the end")
      .Add(jobs.run_seconds);
  page->Distribution("contactd_cycle_iterations", "Iterations of mu in a cycle")
      .Add(jobs.iterations);
  page->Counter("contactd_steps_total", "Integration steps of ended jobs").Add(jobs.steps.load());
  page->Counter("contactd_group_growths_total", "Growths of groups of cycles of ended jobs")
      .Add(jobs.growths.load());
}

void AddStore(const StoreMetrics& store, Page* page) {
  page->Distribution("contactd_store_commit_seconds", "Time of a transaction with its sync")
      .Add(store.commit_seconds);
  page->Distribution("contactd_store_commit_operations", "Operations that shared a transaction")
      .Add(store.commit_operations);
  page->Counter("contactd_store_failed_commits_total", "Transactions that were undone")
      .Add(store.failed_commits.load());
}

void AddCalls(const RpcMetrics& rpc, Page* page) {
  const auto methods = rpc.methods();
  page->Gauge("contactd_rpc_open", "Calls that are open");
  for (const auto& [name, calls] : methods) page->Add(calls.open, {{"method", name}});
  page->Counter("contactd_rpc_ended_total", "Calls that have ended, by code");
  for (const auto& [name, calls] : methods) {
    for (const auto& [code, count] : calls.ended) {
      page->Add(count, {{"method", name}, {"code", CodeName(code)}});
    }
  }
  page->Distribution("contactd_rpc_seconds", "From the start of a call to its status");
  for (const auto& [name, calls] : methods) page->Add(*calls.seconds, {{"method", name}});
  page->Counter("contactd_rpc_streamed_bytes_total", "Bytes of the messages of streams");
  for (const auto& [name, calls] : methods) page->Add(calls.streamed_bytes, {{"method", name}});
  page->Counter("contactd_rpc_refused_total", "Calls refused at once, by reason");
  for (const auto& [reason, count] : rpc.refused()) page->Add(count, {{"reason", reason}});
  page->Counter("contactd_quota_refused_total", "Calls refused for a quota, by resource");
  for (const auto& [what, count] : rpc.past_quota()) page->Add(count, {{"resource", what}});
}

void AddStreams(const StreamMetrics& streams, Page* page) {
  page->Gauge("contactd_streams_slow", "Streams whose reader holds up a write for over a second")
      .Add(streams.slow.load());
  page->Counter("contactd_streams_dropped_total", "Streams whose reader took nothing for too long")
      .Add(streams.dropped.load());
  page->Counter("contactd_events_conflated_total",
                "Events left out for readers that are slow or want few")
      .Add(streams.conflated.load());
  page->Distribution("contactd_stream_reaction_seconds", "Time that a stream's reaction takes")
      .Add(streams.reaction_seconds);
}

}  // namespace

std::vector<MetricFamily> MetricsPage::Collect() const {
  Page page;
  AddNow(sources_.now(), &page);
  AddJobs(*sources_.jobs, &page);
  AddStore(*sources_.store, &page);
  AddCalls(*sources_.rpc, &page);
  AddStreams(*sources_.streams, &page);
  return page.Take();
}

std::string MetricsPage::Text() const { return prometheus::TextSerializer().Serialize(Collect()); }

}  // namespace contact
