#include "storage/postgres/worker_statements.h"

#include <utility>

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
  return {"SELECT * FROM contactd.claim($1,$2,$3,$4,$5,$6,$7,$8,$9,$10)",
          Parameters()
              .Bytes(claim.worker)
              .Integer(claim.most)
              .Integer(claim.most_running)
              .Integer(claim.grace.count())
              .Texts(tenants)
              .Texts(owners)
              .Integers(milliseconds)
              .Texts(not_tenants)
              .Texts(not_owners)
              .Integer(claim.spec_bytes)};
}

Statement Leave(const std::string& worker) {
  return {"SELECT contactd.leave($1)", Parameters().Bytes(worker)};
}

Statement Lend(const std::string& worker, const std::string& job, const std::vector<Loan>& loans) {
  std::vector<std::int64_t> numbers, firsts, lasts;
  for (const Loan& loan : loans) {
    numbers.push_back(loan.number);
    firsts.push_back(loan.first);
    lasts.push_back(loan.last);
  }
  return {"SELECT contactd.lend($1,$2,$3,$4,$5)",
          Parameters().Bytes(worker).Bytes(job).Integers(numbers).Integers(firsts).Integers(lasts)};
}

Statement SettleLoans(const std::string& worker, const std::string& job,
                      const std::vector<std::int64_t>& numbers, bool back) {
  return {"SELECT loan, done, failed, not_converged, steps FROM contactd.settle_loans($1,$2,$3,$4)",
          Parameters().Bytes(worker).Bytes(job).Integers(numbers).Boolean(back)};
}

absl::StatusOr<std::vector<LoanEnd>> LoanEndsOf(const Rows& rows) {
  std::vector<LoanEnd> ends;
  for (int row = 0; row < rows.size(); ++row) {
    ends.push_back({rows.Integer(row, 0),
                    rows.Integer(row, 1) != 0,
                    {static_cast<std::int32_t>(rows.Integer(row, 2)),
                     static_cast<std::int32_t>(rows.Integer(row, 3)), rows.Integer(row, 4)}});
  }
  return ends;
}

Statement TakeLoan(const std::string& worker) {
  return {"SELECT name, epoch, loan, first, last FROM contactd.take_loan($1)",
          Parameters().Bytes(worker)};
}

absl::StatusOr<std::optional<Loan>> LoanOf(const Rows& rows) {
  if (rows.size() == 0) return std::nullopt;
  return Loan{rows.Bytes(0, 0), Unsigned(rows, 0, 1), rows.Integer(0, 2),
              static_cast<std::int32_t>(rows.Integer(0, 3)),
              static_cast<std::int32_t>(rows.Integer(0, 4))};
}

Statement ReturnLoan(const std::string& worker, const Loan& loan, const LoanCounts& counts,
                     const JobChange& change) {
  Parameters parameters;
  parameters.Bytes(worker).Bytes(loan.job).Integer(static_cast<std::int64_t>(loan.epoch));
  parameters.Integer(loan.number).Integer(counts.failed).Integer(counts.not_converged);
  parameters.Integer(counts.steps);
  AddEvents(change.name, change.events, &parameters);
  return {"SELECT * FROM contactd.return_loan($1,$2,$3,$4,$5,$6,$7,$8,$9,$10,$11,$12,$13)",
          std::move(parameters)};
}

Statement RefuseLoan(const std::string& worker, const Loan& loan) {
  return {"SELECT contactd.refuse_loan($1,$2,$3,$4)",
          Parameters()
              .Bytes(worker)
              .Bytes(loan.job)
              .Integer(static_cast<std::int64_t>(loan.epoch))
              .Integer(loan.number)};
}

Statement Count() {
  return {"SELECT queued, running, workers, threads, cells FROM contactd.demand()"};
}

absl::StatusOr<Demand> DemandOf(const Rows& rows) {
  return Demand{rows.Integer(0, 0), rows.Integer(0, 1), rows.Integer(0, 2), rows.Integer(0, 3),
                rows.Integer(0, 4)};
}

Statement CountOf(const JobOwner& whose) {
  return {"SELECT jobs, cells, running FROM contactd.count_of($1,$2)",
          Parameters().Bytes(whose.tenant).Bytes(whose.owner)};
}

absl::StatusOr<OwnerCounts> OwnerCountsOf(const Rows& rows) {
  return OwnerCounts{rows.Integer(0, 0), rows.Integer(0, 1), rows.Integer(0, 2)};
}

Statement FindPositions(const std::vector<std::string>& names) {
  return {"SELECT name, last_sequence, ended FROM contactd.positions_of($1)",
          Parameters().Texts(names)};
}

absl::StatusOr<std::vector<LogPosition>> PositionsOf(const Rows& rows) {
  std::vector<LogPosition> positions;
  for (int row = 0; row < rows.size(); ++row) {
    positions.push_back({rows.Bytes(row, 0), Unsigned(rows, row, 1), rows.Integer(row, 2) != 0});
  }
  return positions;
}

Statement Keep(const std::string& name, const std::string& value, bool replace) {
  return {"SELECT contactd.keep($1,$2,$3)", Parameters().Bytes(name).Bytes(value).Boolean(replace)};
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
