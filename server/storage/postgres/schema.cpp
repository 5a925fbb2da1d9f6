#include "storage/postgres/schema.h"

namespace contact::postgres {

const char kTables[] = R"sql(
CREATE SCHEMA contactd;

CREATE TABLE contactd.version(version integer NOT NULL);

CREATE TABLE contactd.jobs(
  number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
  name text COLLATE "C" NOT NULL UNIQUE,
  uid text NOT NULL,
  request_id text COLLATE "C" UNIQUE,
  state smallint NOT NULL,
  epoch bigint NOT NULL DEFAULT 0,
  cancel_requested boolean NOT NULL DEFAULT false,
  last_sequence bigint NOT NULL,
  end_time bigint NOT NULL DEFAULT 0,
  bytes bigint NOT NULL DEFAULT 0,
  crc32 bigint NOT NULL,
  header bytea NOT NULL,
  oldest_sequence bigint NOT NULL DEFAULT 1,
  compacted boolean NOT NULL DEFAULT false,
  owner text COLLATE "C" NOT NULL,
  tenant text COLLATE "C" NOT NULL,
  last_change bigint,
  first_of_change bigint,
  priority bigint NOT NULL DEFAULT 0,
  cells bigint NOT NULL DEFAULT 0,
  worker text COLLATE "C",
  moved xid8 NOT NULL DEFAULT pg_current_xact_id(),
  labels_crc32 bigint NOT NULL DEFAULT -1,
  labels bytea NOT NULL DEFAULT '',
  note_crc32 bigint NOT NULL DEFAULT -1,
  note bytea NOT NULL DEFAULT ''
) WITH (fillfactor=70, autovacuum_vacuum_scale_factor=0.02, autovacuum_vacuum_threshold=200);
CREATE INDEX jobs_by_tenant ON contactd.jobs(tenant, number);
CREATE INDEX jobs_by_owner ON contactd.jobs(tenant, owner);
CREATE INDEX jobs_of_owner_unfinished ON contactd.jobs(tenant, owner) WHERE state NOT IN (3,4,5);
CREATE INDEX jobs_waiting ON contactd.jobs(tenant, owner, priority DESC, number)
  WHERE state = 1 AND worker IS NULL;
CREATE INDEX jobs_taken ON contactd.jobs(worker, number)
  WHERE state = 2 OR (state = 1 AND worker IS NOT NULL);
CREATE INDEX jobs_moved ON contactd.jobs(moved);

CREATE TABLE contactd.labels(
  key text COLLATE "C" NOT NULL,
  value text COLLATE "C" NOT NULL,
  job bigint NOT NULL REFERENCES contactd.jobs ON DELETE CASCADE,
  PRIMARY KEY(key, value, job)
);
CREATE INDEX labels_by_job ON contactd.labels(job);

CREATE TABLE contactd.specs(
  job bigint PRIMARY KEY REFERENCES contactd.jobs ON DELETE CASCADE,
  crc32 bigint NOT NULL,
  spec bytea NOT NULL
);

CREATE TABLE contactd.results(
  job bigint PRIMARY KEY REFERENCES contactd.jobs ON DELETE CASCADE,
  crc32 bigint NOT NULL,
  result bytea NOT NULL
);

CREATE TABLE contactd.events(
  job bigint NOT NULL,
  sequence bigint NOT NULL,
  kind smallint NOT NULL,
  coding smallint NOT NULL,
  size integer NOT NULL,
  crc32 bigint NOT NULL,
  payload bytea NOT NULL,
  PRIMARY KEY(job, sequence)
);

CREATE TABLE contactd.removed(job bigint PRIMARY KEY);

CREATE TABLE contactd.compacting(
  job bigint PRIMARY KEY REFERENCES contactd.jobs ON DELETE CASCADE,
  position bigint NOT NULL
);

CREATE TABLE contactd.checkpoints(
  job bigint PRIMARY KEY REFERENCES contactd.jobs ON DELETE CASCADE,
  sequence bigint NOT NULL,
  crc32 bigint NOT NULL,
  state bytea NOT NULL
);

-- Processes that run jobs. One whose time has passed has lost its jobs.
CREATE TABLE contactd.workers(
  name text COLLATE "C" PRIMARY KEY,
  host text NOT NULL,
  threads bigint NOT NULL,
  batch_id text NOT NULL,
  until timestamptz NOT NULL
);

-- Cells of a running sweep that its worker, under this epoch, lets others compute. `worker`: NULL while
-- nobody has taken them, empty once the lender has them back.
CREATE TABLE contactd.loans(
  job bigint NOT NULL REFERENCES contactd.jobs ON DELETE CASCADE,
  epoch bigint NOT NULL,
  loan bigint NOT NULL,
  first bigint NOT NULL,
  last bigint NOT NULL,
  worker text COLLATE "C",
  done boolean NOT NULL DEFAULT false,
  failed bigint NOT NULL DEFAULT 0,
  not_converged bigint NOT NULL DEFAULT 0,
  steps bigint NOT NULL DEFAULT 0,
  PRIMARY KEY(job, epoch, loan)
);
CREATE INDEX loans_open ON contactd.loans(job, loan) WHERE worker IS NULL;

-- Worker time of each owner [s], as of a moment; it counts half each minute later.
CREATE TABLE contactd.used(
  worker text COLLATE "C" NOT NULL,
  tenant text COLLATE "C" NOT NULL,
  owner text COLLATE "C" NOT NULL,
  seconds double precision NOT NULL,
  at timestamptz NOT NULL,
  PRIMARY KEY(worker, tenant, owner)
);

-- Short values that all processes share.
CREATE TABLE contactd.kept(name text COLLATE "C" PRIMARY KEY, value bytea NOT NULL);

-- They are compressed already, or do not become smaller.
ALTER TABLE contactd.results ALTER COLUMN result SET STORAGE EXTERNAL;
ALTER TABLE contactd.events ALTER COLUMN payload SET STORAGE EXTERNAL;
ALTER TABLE contactd.checkpoints ALTER COLUMN state SET STORAGE EXTERNAL;
)sql";

const char kFunctions[] = R"sql(
-- In plpgsql, which keeps the plans of a session; a function in sql is planned at each call.

-- The job with this name, with the parts that are asked for. a_tenant: NULL for any.
CREATE OR REPLACE FUNCTION contactd.read_job(
  a_name text, a_tenant text, a_spec boolean, a_checkpoint boolean, a_result boolean)
RETURNS TABLE(
  number bigint, name text, state smallint, epoch bigint, cancel_requested boolean,
  last_sequence bigint, crc32 bigint, header bytea, oldest_sequence bigint, compacted boolean,
  owner text, tenant text, request_id text, labels_crc32 bigint, labels bytea, note_crc32 bigint,
  note bytea, spec_crc32 bigint, spec bytea, checkpoint_crc32 bigint, checkpoint bytea,
  checkpoint_sequence bigint, result_crc32 bigint, result bytea)
LANGUAGE plpgsql AS $$
BEGIN
  RETURN QUERY SELECT j.number, j.name, j.state, j.epoch, j.cancel_requested, j.last_sequence,
      j.crc32, j.header, j.oldest_sequence, j.compacted, j.owner, j.tenant, j.request_id,
      j.labels_crc32, j.labels, j.note_crc32, j.note, s.crc32, s.spec, c.crc32, c.state, c.sequence,
      r.crc32, r.result
    FROM contactd.jobs j
      LEFT JOIN contactd.specs s ON a_spec AND s.job = j.number
      LEFT JOIN contactd.checkpoints c ON a_checkpoint AND c.job = j.number
      LEFT JOIN contactd.results r ON a_result AND r.job = j.number
    WHERE j.name = a_name AND (a_tenant IS NULL OR j.tenant = a_tenant);
END $$;

-- What of its limits the owner has: unfinished jobs, their cells, and jobs that a worker has.
CREATE OR REPLACE FUNCTION contactd.count_of(
  a_tenant text, a_owner text, OUT jobs bigint, OUT cells bigint, OUT running bigint)
LANGUAGE plpgsql STABLE AS $$
BEGIN
  SELECT count(*), coalesce(sum(j.cells), 0)::bigint,
      count(*) FILTER (WHERE j.state = 2 OR j.worker IS NOT NULL)
    INTO jobs, cells, running FROM contactd.jobs j
    WHERE j.tenant = a_tenant AND j.owner = a_owner AND j.state NOT IN (3,4,5);
END $$;

-- Appends to the log of a job whose last event is a_last.
CREATE OR REPLACE FUNCTION contactd.append(
  a_job bigint, a_last bigint, a_kinds bigint[], a_codings bigint[], a_sizes bigint[],
  a_crc32s bigint[], a_payloads bytea[])
RETURNS void LANGUAGE plpgsql AS $$
BEGIN
  INSERT INTO contactd.events(job, sequence, kind, coding, size, crc32, payload)
  SELECT a_job, a_last + e.place, e.kind, e.coding, e.size, e.crc32, e.payload
  FROM unnest(a_kinds, a_codings, a_sizes, a_crc32s, a_payloads) WITH ORDINALITY
    AS e(kind, coding, size, crc32, payload, place);
END $$;

-- How many jobs wait for a worker, at most a_most. To count them takes long if there are many, so a
-- session does it ten times a second at most, unless a_now.
CREATE OR REPLACE FUNCTION contactd.waiting(a_most bigint, a_now boolean) RETURNS bigint
LANGUAGE plpgsql AS $$
DECLARE
  v_time bigint := extract(epoch FROM clock_timestamp()) * 1000;
  -- What was counted last: when, up to which number, and how many.
  v_known bigint[] := string_to_array(nullif(current_setting('contactd.waiting', true), ''), ' ');
  v_count bigint;
BEGIN
  IF NOT a_now AND v_known[1] BETWEEN v_time - 100 AND v_time AND v_known[2] = a_most THEN
    RETURN v_known[3];
  END IF;
  SELECT count(*) INTO v_count FROM (SELECT FROM contactd.jobs j
    WHERE j.state = 1 AND j.worker IS NULL LIMIT a_most) w;
  PERFORM set_config('contactd.waiting', concat_ws(' ', v_time, a_most, v_count), false);
  RETURN v_count;
END $$;

-- Bytes of all jobs of the owner. To add them up takes long if there are many, so a session does it
-- once a second for an owner, unless they come as near to a_most as they may grow meanwhile.
CREATE OR REPLACE FUNCTION contactd.stored_of(a_tenant text, a_owner text, a_most bigint)
RETURNS bigint LANGUAGE plpgsql AS $$
DECLARE
  c_place CONSTANT text := 'contactd.stored_' || md5(concat_ws(' ', a_tenant, a_owner));
  v_time bigint := extract(epoch FROM clock_timestamp()) * 1000;
  -- What was added up last: when, and how much.
  v_known bigint[] := string_to_array(nullif(current_setting(c_place, true), ''), ' ');
  v_bytes bigint;
BEGIN
  IF v_known[1] BETWEEN v_time - 1000 AND v_time
      AND v_known[2] + greatest(a_most / 16, 64 << 20) < a_most THEN
    RETURN v_known[2];
  END IF;
  SELECT coalesce(sum(j.bytes), 0) INTO v_bytes FROM contactd.jobs j
    WHERE j.tenant = a_tenant AND j.owner = a_owner;
  PERFORM set_config(c_place, concat_ws(' ', v_time, v_bytes), false);
  RETURN v_bytes;
END $$;

-- Which limit a new job of the owner would exceed, see create_job; 0 is any number. Counts that come
-- near a limit are made once more while nobody else creates jobs.
CREATE OR REPLACE FUNCTION contactd.exceeded(
  a_tenant text, a_owner text, a_cells bigint, a_max_owner_bytes bigint, a_max_waiting bigint,
  a_max_owner_jobs bigint, a_max_owner_cells bigint, OUT outcome text, OUT has bigint)
LANGUAGE plpgsql AS $$
DECLARE
  c_near CONSTANT bigint := 1024;  -- More jobs than are created before they are counted again.
  v_waiting bigint := 0;
  v_jobs bigint := 0;
  v_cells bigint := 0;
BEGIN
  FOR attempt IN 1..2 LOOP
    IF a_max_waiting > 0 THEN
      v_waiting := contactd.waiting(a_max_waiting, attempt = 2);
    END IF;
    IF a_max_owner_jobs > 0 OR a_max_owner_cells > 0 THEN
      SELECT o.jobs, o.cells INTO v_jobs, v_cells FROM contactd.count_of(a_tenant, a_owner) o;
    END IF;
    EXIT WHEN attempt = 2 OR NOT (
      (a_max_waiting > 0 AND v_waiting + c_near > a_max_waiting) OR
      (a_max_owner_jobs > 0 AND v_jobs + c_near > a_max_owner_jobs) OR
      (a_max_owner_cells > 0 AND a_cells > 0 AND v_cells + c_near * a_cells > a_max_owner_cells));
    PERFORM pg_advisory_xact_lock(1668247157);
  END LOOP;
  IF a_max_waiting > 0 AND v_waiting >= a_max_waiting THEN
    outcome := 'W';
    has := v_waiting;
  ELSIF a_max_owner_jobs > 0 AND v_jobs >= a_max_owner_jobs THEN
    outcome := 'J';
    has := v_jobs;
  ELSIF a_max_owner_cells > 0 AND a_cells > 0 AND v_cells + a_cells > a_max_owner_cells THEN
    outcome := 'K';
    has := v_cells;
  ELSIF a_max_owner_bytes > 0 THEN
    has := contactd.stored_of(a_tenant, a_owner, a_max_owner_bytes);
    IF has >= a_max_owner_bytes THEN outcome := 'O'; END IF;
  END IF;
END $$;

-- Stores a job, or finds the one that the same request has made. Outcomes: C made now; F made before
-- by the same request; U the request id was used for another job, `existing`; N it may not be new;
-- O the owner's jobs take too many bytes, W too many jobs wait, J the owner has too many unfinished
-- jobs, K too many cells: so many are there now, `has`.
CREATE OR REPLACE FUNCTION contactd.create_job(
  a_name text, a_uid text, a_request_id text, a_owner text, a_tenant text, a_state bigint,
  a_end_time bigint, a_crc32 bigint, a_header bytea, a_spec_crc32 bigint, a_spec bytea,
  a_label_keys text[], a_label_values text[], a_kinds bigint[], a_codings bigint[],
  a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint,
  a_may_create boolean, a_max_owner_bytes bigint, a_priority bigint, a_cells bigint,
  a_max_waiting bigint, a_max_owner_jobs bigint, a_max_owner_cells bigint,
  OUT outcome text, OUT existing text, OUT has bigint)
LANGUAGE plpgsql AS $$
DECLARE
  v_job bigint;
  v_uid text;
  v_spec bytea;
BEGIN
  -- Twice: another session may make the same job meanwhile.
  FOR attempt IN 1..2 LOOP
    -- A session may keep the plan that it has made while there were few jobs, so each of these is
    -- one look at a unique index.
    SELECT j.number INTO v_job FROM contactd.jobs j WHERE j.name = a_name;
    IF v_job IS NULL AND a_request_id IS NOT NULL THEN
      SELECT j.number INTO v_job FROM contactd.jobs j WHERE j.request_id = a_request_id;
    END IF;
    IF v_job IS NOT NULL THEN
      SELECT j.name, j.uid, s.spec INTO existing, v_uid, v_spec
        FROM contactd.jobs j LEFT JOIN contactd.specs s ON s.job = j.number
        WHERE j.number = v_job;
      IF existing = a_name AND v_uid <> a_uid THEN
        RAISE unique_violation USING MESSAGE = 'there is a job ' || a_name;
      END IF;
      -- The same name: this very call, sent again because its answer was lost.
      outcome := CASE WHEN existing = a_name THEN 'C' WHEN v_spec = a_spec THEN 'F' ELSE 'U' END;
      RETURN;
    END IF;
    IF NOT a_may_create THEN
      outcome := 'N';
      RETURN;
    END IF;
    SELECT e.outcome, e.has INTO outcome, has FROM contactd.exceeded(a_tenant, a_owner, a_cells,
      a_max_owner_bytes, a_max_waiting, a_max_owner_jobs, a_max_owner_cells) e;
    IF outcome IS NOT NULL THEN RETURN; END IF;
    INSERT INTO contactd.jobs(name, uid, request_id, owner, tenant, state, last_sequence, end_time,
        bytes, crc32, header, priority, cells)
      VALUES(a_name, a_uid, a_request_id, a_owner, a_tenant, a_state, cardinality(a_kinds),
        a_end_time, octet_length(a_spec) + a_event_bytes, a_crc32, a_header, a_priority, a_cells)
      ON CONFLICT DO NOTHING RETURNING jobs.number INTO v_job;
    EXIT WHEN v_job IS NOT NULL;
  END LOOP;
  INSERT INTO contactd.specs(job, crc32, spec) VALUES(v_job, a_spec_crc32, a_spec);
  INSERT INTO contactd.labels(key, value, job)
    SELECT l.key, l.value, v_job FROM unnest(a_label_keys, a_label_values) AS l(key, value);
  PERFORM contactd.append(v_job, 0, a_kinds, a_codings, a_sizes, a_crc32s, a_payloads);
  outcome := 'C';
  existing := a_name;
END $$;

-- Changes a job and appends to its log. Outcomes: D done, the first event appended is a_first; N no
-- such job; O the job has another epoch, or has ended. A change that is sent again because its answer
-- was lost is done once. a_change: NULL for one that may come between such a change and its
-- repetition.
CREATE OR REPLACE FUNCTION contactd.change_job(
  a_name text, a_epoch bigint, a_change bigint, a_take boolean, a_state bigint, a_end_time bigint,
  a_crc32 bigint, a_header bytea, a_result_crc32 bigint, a_result bytea, a_checkpoint_events bigint,
  a_checkpoint_crc32 bigint, a_checkpoint bytea, a_kinds bigint[], a_codings bigint[],
  a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint,
  OUT outcome text, OUT first bigint, OUT job_tenant text)
LANGUAGE plpgsql AS $$
DECLARE
  v_job bigint;
  v_cells bigint;
BEGIN
  UPDATE contactd.jobs j SET
      epoch = j.epoch + a_take::int,
      last_sequence = j.last_sequence + cardinality(a_kinds),
      bytes = j.bytes + a_event_bytes + coalesce(octet_length(a_result), 0),
      state = coalesce(a_state, j.state),
      worker = CASE WHEN a_state <> 2 THEN NULL ELSE j.worker END,
      moved = CASE WHEN a_state <> j.state THEN pg_current_xact_id() ELSE j.moved END,
      end_time = coalesce(a_end_time, j.end_time),
      crc32 = coalesce(a_crc32, j.crc32),
      header = coalesce(a_header, j.header),
      last_change = coalesce(a_change, j.last_change),
      first_of_change = CASE WHEN a_change IS NULL THEN j.first_of_change
        ELSE j.last_sequence + 1 END
    WHERE j.name = a_name AND j.epoch = a_epoch
      -- Without the sum a plan of a time when all jobs had ended reads all that have not.
      AND j.state + 0 NOT IN (3,4,5)
      AND (a_change IS NULL OR j.last_change IS DISTINCT FROM a_change)
    RETURNING j.number, j.tenant, j.last_sequence + 1 - cardinality(a_kinds), j.cells
    INTO v_job, job_tenant, first, v_cells;
  IF v_job IS NULL THEN
    SELECT CASE WHEN j.last_change = a_change THEN 'D' ELSE 'O' END, j.first_of_change, j.tenant
      INTO outcome, first, job_tenant FROM contactd.jobs j WHERE j.name = a_name;
    outcome := coalesce(outcome, 'N');
    RETURN;
  END IF;
  outcome := 'D';
  IF a_result IS NOT NULL THEN
    INSERT INTO contactd.results(job, crc32, result) VALUES(v_job, a_result_crc32, a_result)
      ON CONFLICT DO NOTHING;
    IF NOT FOUND THEN
      UPDATE contactd.jobs j SET bytes = j.bytes - octet_length(r.result)
        FROM contactd.results r WHERE j.number = v_job AND r.job = v_job;
      UPDATE contactd.results r SET crc32 = a_result_crc32, result = a_result WHERE r.job = v_job;
    END IF;
  END IF;
  IF a_end_time > 0 THEN
    IF v_cells > 0 THEN DELETE FROM contactd.loans l WHERE l.job = v_job; END IF;
    DELETE FROM contactd.checkpoints c WHERE c.job = v_job;
  ELSIF a_checkpoint IS NOT NULL THEN
    INSERT INTO contactd.checkpoints(job, sequence, crc32, state)
      VALUES(v_job, first - 1 + a_checkpoint_events, a_checkpoint_crc32, a_checkpoint)
      ON CONFLICT (job) DO UPDATE SET sequence = excluded.sequence, crc32 = excluded.crc32,
        state = excluded.state;
  END IF;
  PERFORM contactd.append(v_job, first - 1, a_kinds, a_codings, a_sizes, a_crc32s, a_payloads);
END $$;

-- Keeps a value under a name; one that is there already stays unless a_replace. The value then.
CREATE OR REPLACE FUNCTION contactd.keep(a_name text, a_value bytea, a_replace boolean)
RETURNS bytea LANGUAGE plpgsql AS $$
BEGIN
  INSERT INTO contactd.kept AS k(name, value) VALUES(a_name, a_value)
    ON CONFLICT (name) DO UPDATE SET value = excluded.value WHERE a_replace;
  RETURN (SELECT k.value FROM contactd.kept k WHERE k.name = a_name);
END $$;

-- Outcomes: D done; N no such job.
CREATE OR REPLACE FUNCTION contactd.request_cancel(a_name text) RETURNS text
LANGUAGE plpgsql AS $$
BEGIN
  UPDATE contactd.jobs j SET cancel_requested = true WHERE j.name = a_name;
  RETURN CASE WHEN FOUND THEN 'D' ELSE 'N' END;
END $$;

-- Replaces labels or note of a job, with their checksums; NULL: as before. Outcomes: D done; N no
-- such job; U its uid is another, `job_uid`.
CREATE OR REPLACE FUNCTION contactd.remark_job(
  a_name text, a_uid text, a_labels_crc32 bigint, a_labels bytea, a_label_keys text[],
  a_label_values text[], a_note_crc32 bigint, a_note bytea,
  OUT outcome text, OUT job_owner text, OUT job_tenant text, OUT job_uid text, OUT job_state bigint)
LANGUAGE plpgsql AS $$
DECLARE
  v_job bigint;
BEGIN
  SELECT j.number, j.owner, j.tenant, j.uid, j.state
    INTO v_job, job_owner, job_tenant, job_uid, job_state
    FROM contactd.jobs j WHERE j.name = a_name FOR UPDATE;
  outcome := CASE WHEN v_job IS NULL THEN 'N' WHEN a_uid <> '' AND job_uid <> a_uid THEN 'U'
    ELSE 'D' END;
  IF outcome <> 'D' THEN RETURN; END IF;
  UPDATE contactd.jobs j SET moved = pg_current_xact_id(),
      labels_crc32 = coalesce(a_labels_crc32, j.labels_crc32),
      labels = coalesce(a_labels, j.labels),
      note_crc32 = coalesce(a_note_crc32, j.note_crc32),
      note = coalesce(a_note, j.note)
    WHERE j.number = v_job;
  IF a_labels IS NULL THEN RETURN; END IF;
  DELETE FROM contactd.labels l WHERE l.job = v_job;
  INSERT INTO contactd.labels(key, value, job)
    SELECT l.key, l.value, v_job FROM unnest(a_label_keys, a_label_values) AS l(key, value);
END $$;

-- Removes an ended job; its events only vanish from sight, `purge` removes them. Outcomes: D done;
-- N no such job; R it has not ended; U its uid is another, `job_uid`.
CREATE OR REPLACE FUNCTION contactd.remove_job(
  a_name text, a_uid text, OUT outcome text, OUT job_owner text, OUT job_tenant text,
  OUT job_uid text)
LANGUAGE plpgsql AS $$
DECLARE
  v_job contactd.jobs;
BEGIN
  SELECT * INTO v_job FROM contactd.jobs j WHERE j.name = a_name FOR UPDATE;
  outcome := CASE
    WHEN NOT FOUND THEN 'N'
    WHEN a_uid <> '' AND v_job.uid <> a_uid THEN 'U'
    WHEN v_job.state NOT IN (3,4,5) THEN 'R'
    ELSE 'D' END;
  job_owner := v_job.owner;
  job_tenant := v_job.tenant;
  job_uid := v_job.uid;
  IF outcome = 'D' THEN
    INSERT INTO contactd.removed(job) VALUES(v_job.number);
    DELETE FROM contactd.jobs j WHERE j.number = v_job.number;
  END IF;
END $$;

-- Gives up the frame chunks, of the kind a_kind, of an ended job; they only vanish from sight.
-- Outcomes: as of remove_job.
CREATE OR REPLACE FUNCTION contactd.compact_job(
  a_name text, a_kind bigint, OUT outcome text, OUT job_owner text, OUT job_tenant text)
LANGUAGE plpgsql AS $$
DECLARE
  v_job contactd.jobs;
  v_last bigint;
BEGIN
  SELECT * INTO v_job FROM contactd.jobs j WHERE j.name = a_name FOR UPDATE;
  outcome := CASE
    WHEN NOT FOUND THEN 'N' WHEN v_job.state NOT IN (3,4,5) THEN 'R' ELSE 'D' END;
  job_owner := v_job.owner;
  job_tenant := v_job.tenant;
  IF outcome <> 'D' THEN RETURN; END IF;
  SELECT coalesce(max(e.sequence), 0) INTO v_last FROM contactd.events e
    WHERE e.job = v_job.number AND e.kind = a_kind;
  UPDATE contactd.jobs j SET compacted = true, oldest_sequence = greatest(v_last + 1,
    j.oldest_sequence) WHERE j.number = v_job.number;
  IF v_last > 0 THEN
    INSERT INTO contactd.compacting(job, position) VALUES(v_job.number, 0) ON CONFLICT DO NOTHING;
  END IF;
END $$;

-- Removes some events of a job that was removed or is being compacted. False: there are none.
CREATE OR REPLACE FUNCTION contactd.purge(a_kind bigint) RETURNS boolean LANGUAGE plpgsql AS $$
DECLARE
  c_events CONSTANT bigint := 256;
  c_scanned CONSTANT bigint := 4096;
  v_job bigint;
  v_position bigint;
  v_oldest bigint;
  v_next bigint;
BEGIN
  SELECT r.job INTO v_job FROM contactd.removed r LIMIT 1 FOR UPDATE SKIP LOCKED;
  IF FOUND THEN
    DELETE FROM contactd.events e WHERE e.job = v_job AND e.sequence <
      (SELECT min(m.sequence) FROM contactd.events m WHERE m.job = v_job) + c_events;
    IF NOT FOUND THEN DELETE FROM contactd.removed r WHERE r.job = v_job; END IF;
    RETURN true;
  END IF;
  SELECT c.job, c.position, j.oldest_sequence INTO v_job, v_position, v_oldest
    FROM contactd.compacting c JOIN contactd.jobs j ON j.number = c.job
    LIMIT 1 FOR UPDATE OF c SKIP LOCKED;
  IF NOT FOUND THEN RETURN false; END IF;
  v_next := least(v_position + c_scanned, v_oldest);
  SELECT coalesce(max(o.sequence), v_next) INTO v_next FROM (
    SELECT e.sequence FROM contactd.events e
    WHERE e.job = v_job AND e.sequence > v_position AND e.sequence <= v_next AND e.kind = a_kind
    ORDER BY e.sequence OFFSET c_events - 1 LIMIT 1) o;
  WITH gone AS (
    DELETE FROM contactd.events e
    WHERE e.job = v_job AND e.sequence > v_position AND e.sequence <= v_next AND e.kind = a_kind
    RETURNING octet_length(e.payload) AS bytes)
  UPDATE contactd.jobs j SET bytes = j.bytes - (SELECT coalesce(sum(g.bytes), 0) FROM gone g)
    WHERE j.number = v_job;
  IF v_next >= v_oldest THEN
    DELETE FROM contactd.compacting c WHERE c.job = v_job;
  ELSE
    UPDATE contactd.compacting c SET position = v_next WHERE c.job = v_job;
  END IF;
  RETURN true;
END $$;

-- A page of the log of a job: one row an event, or one row without an event. Stops after the event
-- with which the page has a_bytes, or after a_scanned sequences.
CREATE OR REPLACE FUNCTION contactd.read_events(
  a_name text, a_after bigint, a_kinds bigint, a_bytes bigint, a_scanned bigint)
RETURNS TABLE(
  last_sequence bigint, oldest_sequence bigint, sequence bigint, kind smallint, coding smallint,
  size integer, crc32 bigint, payload bytea)
LANGUAGE plpgsql AS $$
DECLARE
  v_job bigint;
  v_bytes bigint := 0;
BEGIN
  SELECT j.number, j.last_sequence, j.oldest_sequence
    INTO v_job, last_sequence, oldest_sequence FROM contactd.jobs j WHERE j.name = a_name;
  IF NOT FOUND THEN RETURN; END IF;
  RETURN NEXT;
  FOR sequence, kind, coding, size, crc32, payload IN
    SELECT e.sequence, e.kind, e.coding, e.size, e.crc32, e.payload FROM contactd.events e
    WHERE e.job = v_job AND e.sequence > a_after
      AND e.sequence <= least(last_sequence, a_after + a_scanned)
      AND ((1::bigint << e.kind::int) & a_kinds) <> 0
    ORDER BY e.sequence
  LOOP
    RETURN NEXT;
    v_bytes := v_bytes + size + 1;
    EXIT WHEN v_bytes >= a_bytes;
  END LOOP;
END $$;
)sql";

}  // namespace contact::postgres
