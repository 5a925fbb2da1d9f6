#include "storage/postgres/worker_statements.h"

#include <absl/strings/str_cat.h>

#include "storage/postgres/statements.h"

namespace contact::postgres {
namespace {

std::uint64_t Unsigned(const Rows& rows, int row, int column) {
  return static_cast<std::uint64_t>(rows.Integer(row, column));
}

}  // namespace

Statement Beat(const WorkerProcess& worker) {
  return {"SELECT name, epoch, cancel_requested FROM contactd.beat($1,$2,$3,$4,$5)",
          Parameters()
              .Bytes(worker.name)
              .Bytes(worker.host)
              .Integer(worker.threads)
              .Bytes(worker.batch_id)
              .Integer(worker.lease.count())};
}

absl::StatusOr<std::vector<HeldJob>> HeldJobsOf(const Rows& rows) {
  std::vector<HeldJob> jobs;
  for (int row = 0; row < rows.size(); ++row) {
    jobs.push_back({rows.Bytes(row, 0), Unsigned(rows, row, 1), rows.Integer(row, 2) != 0});
  }
  return jobs;
}

Statement Claim(const JobClaim& claim) {
  std::vector<std::string> tenants, owners;
  std::vector<std::int64_t> milliseconds;
  for (const JobClaim::Used& used : claim.used) {
    tenants.push_back(used.whose.tenant);
    owners.push_back(used.whose.owner);
    milliseconds.push_back(used.time.count());
  }
  std::vector<std::string> not_tenants, not_owners;
  for (const JobOwner& whose : claim.none_of) {
    not_tenants.push_back(whose.tenant);
    not_owners.push_back(whose.owner);
  }
  return {absl::StrCat("SELECT ", kHeader, " FROM contactd.claim($1,$2,$3,$4,$5,$6,$7,$8,$9)"),
          Parameters()
              .Bytes(claim.worker)
              .Integer(claim.most)
              .Integer(claim.most_running)
              .Integer(claim.grace.count())
              .Texts(tenants)
              .Texts(owners)
              .Integers(milliseconds)
              .Texts(not_tenants)
              .Texts(not_owners)};
}

Statement Leave(const std::string& worker) {
  return {"SELECT contactd.leave($1)", Parameters().Bytes(worker)};
}

Statement Count() { return {"SELECT queued, running, workers, threads FROM contactd.demand()"}; }

absl::StatusOr<Demand> DemandOf(const Rows& rows) {
  return Demand{rows.Integer(0, 0), rows.Integer(0, 1), rows.Integer(0, 2), rows.Integer(0, 3)};
}

Statement CountOf(const JobOwner& whose) {
  return {"SELECT jobs, cells, running FROM contactd.count_of($1,$2)",
          Parameters().Bytes(whose.tenant).Bytes(whose.owner)};
}

absl::StatusOr<OwnerCounts> OwnerCountsOf(const Rows& rows) {
  return OwnerCounts{rows.Integer(0, 0), rows.Integer(0, 1), rows.Integer(0, 2)};
}

Statement FindPositions(const std::vector<std::string>& names) {
  return {"SELECT name, last_sequence, state IN (3,4,5) FROM contactd.jobs WHERE name = ANY($1)",
          Parameters().Texts(names)};
}

absl::StatusOr<std::vector<LogPosition>> PositionsOf(const Rows& rows) {
  std::vector<LogPosition> positions;
  for (int row = 0; row < rows.size(); ++row) {
    positions.push_back({rows.Bytes(row, 0), Unsigned(rows, row, 1), rows.Integer(row, 2) != 0});
  }
  return positions;
}

Statement FindMoved(std::uint64_t since) {
  return {"SELECT next, name, tenant FROM contactd.moved_since($1)",
          Parameters().Integer(static_cast<std::int64_t>(since))};
}

absl::StatusOr<MovedJobs> MovedJobsOf(const Rows& rows) {
  MovedJobs moved{.jobs = {}, .next = Unsigned(rows, 0, 0)};
  for (int row = 0; row < rows.size(); ++row) {
    if (!rows.IsNull(row, 1)) moved.jobs.push_back({rows.Bytes(row, 1), rows.Bytes(row, 2)});
  }
  return moved;
}

}  // namespace contact::postgres
