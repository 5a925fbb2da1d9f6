#pragma once

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"

namespace contact {

/// Version of the tables below, kept in PRAGMA user_version of the database. A change of the tables
/// raises it by 1 and adds a step to migration.cpp.
inline constexpr int kSchemaVersion = 8;

/// SQL condition on a row of jobs: the job has ended, so its state is one of those below.
inline constexpr char kEnded[] = "state IN (3,4,5)";
static_assert(v1::Job::SUCCEEDED == 3 && v1::Job::FAILED == 4 && v1::Job::CANCELLED == 5);

/// The tables of a new database, without those of kSchemaOfVersion3. Meaning of each: README.md.
inline constexpr char kSchema[] = R"sql(
CREATE TABLE jobs(
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  request_id TEXT UNIQUE,
  state INTEGER NOT NULL,
  epoch INTEGER NOT NULL,
  cancel_requested INTEGER NOT NULL DEFAULT 0,
  last_sequence INTEGER NOT NULL,
  end_time INTEGER NOT NULL DEFAULT 0,
  bytes INTEGER NOT NULL DEFAULT 0,
  crc32 INTEGER NOT NULL,
  header BLOB NOT NULL,
  oldest_sequence INTEGER NOT NULL DEFAULT 1,
  compacted INTEGER NOT NULL DEFAULT 0,
  owner TEXT NOT NULL DEFAULT 'local',
  tenant TEXT NOT NULL DEFAULT 'local',
  row_crc32 INTEGER NOT NULL DEFAULT 0,
  labels_crc32 INTEGER NOT NULL DEFAULT -1,
  labels BLOB NOT NULL DEFAULT x'',
  note_crc32 INTEGER NOT NULL DEFAULT -1,
  note BLOB NOT NULL DEFAULT x''
) STRICT;
CREATE INDEX jobs_by_state ON jobs(state, number);
CREATE INDEX jobs_by_tenant ON jobs(tenant, number);

CREATE TABLE labels(
  key TEXT NOT NULL,
  value TEXT NOT NULL,
  job INTEGER NOT NULL REFERENCES jobs ON DELETE CASCADE,
  PRIMARY KEY(key, value, job)
) WITHOUT ROWID, STRICT;
CREATE INDEX labels_by_job ON labels(job);

CREATE TABLE specs(
  job INTEGER PRIMARY KEY REFERENCES jobs ON DELETE CASCADE,
  crc32 INTEGER NOT NULL,
  spec BLOB NOT NULL
) STRICT;

CREATE TABLE results(
  job INTEGER PRIMARY KEY REFERENCES jobs ON DELETE CASCADE,
  crc32 INTEGER NOT NULL,
  result BLOB NOT NULL
) STRICT;

CREATE TABLE events(
  job INTEGER NOT NULL,
  sequence INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  coding INTEGER NOT NULL DEFAULT 0,
  crc32 INTEGER NOT NULL,
  payload BLOB NOT NULL,
  PRIMARY KEY(job, sequence)
) WITHOUT ROWID, STRICT;

CREATE TABLE removed(
  job INTEGER PRIMARY KEY
) STRICT;
)sql";

/// The tables that version 3 added: for compacted jobs, and for the checkpoints of runs. Both new
/// and migrated databases get them by this text.
inline constexpr char kSchemaOfVersion3[] = R"sql(
CREATE TABLE compacting(
  job INTEGER PRIMARY KEY REFERENCES jobs ON DELETE CASCADE,
  position INTEGER NOT NULL
) STRICT;

CREATE TABLE checkpoints(
  job INTEGER PRIMARY KEY REFERENCES jobs ON DELETE CASCADE,
  sequence INTEGER NOT NULL,
  crc32 INTEGER NOT NULL,
  state BLOB NOT NULL
) STRICT;
)sql";

/// What the jobs of each owner take, summed up when the database is opened and kept in step with
/// every transaction by triggers, which are undone with it. In memory only, so nothing of it can be
/// damaged.
inline constexpr char kOwnerBytes[] = R"sql(
PRAGMA temp_store=MEMORY;
CREATE TEMP TABLE owner_bytes(
  tenant TEXT NOT NULL,
  owner TEXT NOT NULL,
  bytes INTEGER NOT NULL,
  PRIMARY KEY(tenant, owner)
) WITHOUT ROWID, STRICT;
INSERT INTO owner_bytes SELECT tenant, owner, SUM(bytes) FROM jobs GROUP BY tenant, owner;

CREATE TEMP TRIGGER job_comes AFTER INSERT ON main.jobs BEGIN
  INSERT INTO owner_bytes VALUES(new.tenant, new.owner, new.bytes)
    ON CONFLICT DO UPDATE SET bytes=bytes+excluded.bytes;
END;
CREATE TEMP TRIGGER job_grows AFTER UPDATE OF bytes ON main.jobs BEGIN
  UPDATE owner_bytes SET bytes=bytes+new.bytes-old.bytes
    WHERE tenant=new.tenant AND owner=new.owner;
END;
CREATE TEMP TRIGGER job_goes AFTER DELETE ON main.jobs BEGIN
  UPDATE owner_bytes SET bytes=bytes-old.bytes WHERE tenant=old.tenant AND owner=old.owner;
END;
)sql";

}  // namespace contact
