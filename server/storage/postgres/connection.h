#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>
#include <libpq-fe.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "storage/postgres/parameters.h"
#include "storage/postgres/rows.h"

namespace contact::postgres {

/// A statement with its parameters. There is a bounded number of texts: each is prepared once a
/// connection.
struct Statement {
  std::string sql;
  Parameters parameters = {};
};

/// A connection to a PostgreSQL database. Belongs to one thread at a time.
///
/// Errors: UNAVAILABLE, the connection is lost, and nobody knows whether the work was done;
/// RESOURCE_EXHAUSTED, no space; ABORTED, another transaction was in the way, try again; DATA_LOSS,
/// damaged; FAILED_PRECONDITION, the role has no right to it; else INTERNAL.
class Connection {
 public:
  /// `address` is a URI or a list of keywords as libpq takes it; what it does not say comes from
  /// libpq's environment variables and files. UNAVAILABLE: nobody answers there, or only a standby.
  /// FAILED_PRECONDITION: the server refuses.
  static absl::StatusOr<std::unique_ptr<Connection>> Open(const std::string& address);

  /// Runs the statements as one transaction and answers the rows of each. They go out together, so
  /// that all of them take one turn of the network and one sync of the disk.
  absl::StatusOr<std::vector<Rows>> Run(const std::vector<const Statement*>& statements);
  /// Runs one statement as a transaction.
  absl::StatusOr<Rows> Run(const Statement& statement);
  /// Runs a text of several statements, without parameters, as one transaction.
  absl::Status RunScript(const std::string& sql);

  /// What other sessions have notified of, if this one listens; and what has come meanwhile.
  std::vector<std::string> TakeNotifications();
  /// Is readable when something has come.
  int socket() const { return PQsocket(connection_.get()); }

  /// Which session of the server this is; no other ever is the same.
  const std::string& session() const { return session_; }
  /// Ends another session of the same role, and waits for it: what it was sent and has not done by
  /// then is never done. OK, too, if it has ended before. UNAVAILABLE: it has not ended yet.
  absl::Status End(const std::string& session);

  /// False: the connection is lost.
  bool good() const { return PQstatus(connection_.get()) == CONNECTION_OK; }
  /// Database and server, without secrets, for messages.
  std::string Name() const;

 private:
  explicit Connection(PGconn* connection) : connection_(connection, PQfinish) {}

  // Queues a statement; before its first use, its preparation too. `expected` gets one element an
  // answer to come: the SQL text that is prepared, or null for the statement itself.
  using Expected = std::vector<const std::string*>;
  void Send(const Statement& statement, Expected* expected);
  // Reads the answers, up to the end of the transaction.
  absl::StatusOr<std::vector<Rows>> Answers(const Expected& expected);
  // Sends what is queued and reads what comes, until libpq has a result. Null at the end of the
  // answer of one statement, and when the connection is lost.
  PGresult* Next();
  // Ends a connection whose server does not answer: what is read next finds it lost.
  void Abandon();
  // What went wrong; `result` may be null.
  absl::Status Failure(const PGresult* result) const;

  std::unique_ptr<PGconn, void (*)(PGconn*)> connection_;
  // By SQL text: the name of the prepared statement.
  std::map<std::string, std::string> names_;
  // Number of the newest name.
  int numbers_ = 0;
  std::string session_;
};

}  // namespace contact::postgres
