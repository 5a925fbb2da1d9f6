#include "storage/postgres/schema.h"

namespace contact::postgres {

const char kWorkerFunctions[] = R"sql(
-- What counts now of seconds that were used at a moment: half of them a minute later. Without the
-- bounds the power is out of range, an error, after 18 hours, and after a clock was set back.
CREATE OR REPLACE FUNCTION contactd.left_of(a_seconds double precision, a_at timestamptz)
RETURNS double precision LANGUAGE sql STABLE AS $$
  SELECT a_seconds * power(0.5::double precision,
    least(greatest(extract(epoch FROM statement_timestamp() - a_at) / 60, 0), 64)::double precision);
$$;

-- A worker lives for so many milliseconds more. Answers the jobs that it has. What was used an hour
-- ago counts no more, and goes; claim may have some of these rows.
CREATE OR REPLACE FUNCTION contactd.beat(
  a_worker text, a_host text, a_threads bigint, a_batch_id text, a_lease bigint)
RETURNS TABLE(name text, epoch bigint, cancel_requested boolean)
LANGUAGE plpgsql AS $$
BEGIN
  INSERT INTO contactd.workers AS w(name, host, threads, batch_id, until)
    VALUES(a_worker, a_host, a_threads, a_batch_id,
      clock_timestamp() + a_lease * interval '1 ms')
    ON CONFLICT ON CONSTRAINT workers_pkey DO UPDATE SET until = excluded.until;
  DELETE FROM contactd.workers w WHERE w.until < clock_timestamp() - interval '1 day';
  DELETE FROM contactd.used u WHERE (u.worker, u.tenant, u.owner) IN (
    SELECT o.worker, o.tenant, o.owner FROM contactd.used o
    WHERE o.at < clock_timestamp() - interval '1 hour' FOR UPDATE SKIP LOCKED);
  RETURN QUERY SELECT j.name, j.epoch, j.cancel_requested FROM contactd.jobs j
    WHERE (j.state = 2 OR (j.state = 1 AND j.worker IS NOT NULL)) AND j.worker = a_worker;
END $$;

-- A worker goes: what it has not begun may be claimed, and what it has begun is lost.
CREATE OR REPLACE FUNCTION contactd.leave(a_worker text) RETURNS void LANGUAGE sql AS $$
  UPDATE contactd.jobs j SET worker = NULL, epoch = j.epoch + 1
    WHERE j.state = 1 AND j.worker = a_worker;
  DELETE FROM contactd.workers w WHERE w.name = a_worker;
$$;

-- The tenants and owners whose jobs wait, each once. One look at the index for each: only
-- jobs_waiting has this order.
CREATE OR REPLACE FUNCTION contactd.waiting_owners()
RETURNS TABLE(tenant text, owner text) LANGUAGE plpgsql AS $$
BEGIN
  RETURN QUERY WITH RECURSIVE o(tenant, owner) AS (
    (SELECT j.tenant, j.owner FROM contactd.jobs j WHERE j.state = 1 AND j.worker IS NULL
      ORDER BY j.tenant, j.owner, j.priority DESC, j.number LIMIT 1)
    UNION ALL
    SELECT n.tenant, n.owner FROM o, LATERAL (
      SELECT j.tenant, j.owner FROM contactd.jobs j
      WHERE j.state = 1 AND j.worker IS NULL AND (j.tenant, j.owner) > (o.tenant, o.owner)
      ORDER BY j.tenant, j.owner, j.priority DESC, j.number LIMIT 1) n)
  SELECT o.tenant, o.owner FROM o;
END $$;

-- Whose jobs are to have the next a_most workers, and how many of them, as if all owners had
-- enough: tenants get the same worker time, and so do the owners of one tenant. A job that a worker
-- has counts for a second that it will use. Not those of a_not_tenants and a_not_owners.
CREATE OR REPLACE FUNCTION contactd.shares(
  a_most bigint, a_most_running bigint, a_not_tenants text[], a_not_owners text[])
RETURNS TABLE(tenant text, owner text, jobs bigint) LANGUAGE plpgsql AS $$
BEGIN
  RETURN QUERY WITH
  shares AS (
    SELECT s.tenant, s.owner, sum(s.seconds) AS seconds, sum(s.running)::bigint AS running FROM (
      SELECT u.tenant, u.owner, contactd.left_of(u.seconds, u.at) AS seconds, 0 AS running
        FROM contactd.used u
      UNION ALL
      SELECT j.tenant, j.owner, count(*), count(*) FROM contactd.jobs j
        WHERE j.state = 2 OR (j.state = 1 AND j.worker IS NOT NULL) GROUP BY j.tenant, j.owner) s
    GROUP BY s.tenant, s.owner),
  tenants AS (SELECT s.tenant, sum(s.seconds) AS seconds FROM shares s GROUP BY s.tenant),
  owners AS (
    SELECT w.tenant, w.owner, coalesce(t.seconds, 0) AS before, coalesce(s.seconds, 0) AS seconds,
      coalesce(s.running, 0) AS running
    FROM contactd.waiting_owners() w
      LEFT JOIN shares s ON s.tenant = w.tenant AND s.owner = w.owner
      LEFT JOIN tenants t ON t.tenant = w.tenant
    WHERE (a_most_running = 0 OR coalesce(s.running, 0) < a_most_running) AND NOT EXISTS(
      SELECT FROM unnest(a_not_tenants, a_not_owners) AS n(tenant, owner)
      WHERE n.tenant = w.tenant AND n.owner = w.owner)),
  -- Nobody else can be among the next a_most.
  first AS (
    SELECT o.* FROM owners o
    ORDER BY o.before + row_number() OVER (PARTITION BY o.tenant ORDER BY o.seconds, o.owner),
      o.seconds, o.tenant, o.owner LIMIT a_most),
  next AS (
    SELECT f.tenant, f.owner FROM first f, generate_series(1, CASE
      WHEN a_most_running = 0 THEN a_most ELSE least(a_most, a_most_running - f.running) END) AS k
    ORDER BY f.before + row_number() OVER (
      PARTITION BY f.tenant ORDER BY f.seconds + k, f.owner), f.seconds + k, f.tenant, f.owner
    LIMIT a_most)
  SELECT n.tenant, n.owner, count(*) FROM next n GROUP BY n.tenant, n.owner;
END $$;

-- Gives a living worker the jobs whose worker is dead, and then a_most of those that wait; at most
-- a_most_running of one owner run at a time. Whoever had them can change them no more. A job comes
-- with its checkpoint, and if it waits and its spec has at most a_spec_bytes, with that. Takes in
-- what the worker has used, by owner. After a start of the database the workers have a while to
-- come back. Plans are kept, so those of the time when there were few jobs must not read all of them:
-- only jobs_taken has the first order, and the rest goes by number.
CREATE OR REPLACE FUNCTION contactd.claim(
  a_worker text, a_most bigint, a_most_running bigint, a_grace bigint, a_tenants text[],
  a_owners text[], a_milliseconds bigint[], a_not_tenants text[], a_not_owners text[],
  a_spec_bytes bigint)
RETURNS TABLE(
  number bigint, name text, state smallint, epoch bigint, cancel_requested boolean,
  last_sequence bigint, crc32 bigint, header bytea, oldest_sequence bigint, compacted boolean,
  owner text, tenant text, request_id text, labels_crc32 bigint, labels bytea, note_crc32 bigint,
  note bytea, spec_crc32 bigint, spec bytea, checkpoint_crc32 bigint, checkpoint bytea,
  checkpoint_sequence bigint)
LANGUAGE plpgsql SET enable_seqscan = off AS $$
DECLARE
  c_lost CONSTANT bigint := 64;
  v_now timestamptz := clock_timestamp();
  v_alive text[];
  v_taken bigint[] := '{}';
  v_left bigint := a_most;
  v_before bigint;
  v_more bigint[];
  v_next record;
BEGIN
  INSERT INTO contactd.used AS u(worker, tenant, owner, seconds, at)
    SELECT a_worker, n.tenant, n.owner, n.milliseconds / 1000.0, v_now
    FROM unnest(a_tenants, a_owners, a_milliseconds) AS n(tenant, owner, milliseconds)
    ON CONFLICT ON CONSTRAINT used_pkey DO UPDATE SET at = v_now,
      seconds = excluded.seconds + contactd.left_of(u.seconds, u.at);
  SELECT array_agg(w.name) INTO v_alive FROM contactd.workers w WHERE w.until > v_now;
  IF a_worker = ANY(v_alive) IS NOT TRUE THEN RETURN; END IF;
  IF v_now > pg_postmaster_start_time() + a_grace * interval '1 ms' THEN
    SELECT coalesce(array_agg(l.number), '{}') INTO v_taken FROM (
      SELECT j.number FROM contactd.jobs j
      WHERE (j.state = 2 OR (j.state = 1 AND j.worker IS NOT NULL))
        AND coalesce(j.worker, '') <> ALL(v_alive)
      ORDER BY j.worker, j.number LIMIT c_lost FOR UPDATE SKIP LOCKED) l;
    UPDATE contactd.jobs j SET worker = a_worker, epoch = j.epoch + 1
      WHERE j.number = ANY(v_taken);
  END IF;
  WHILE v_left > 0 LOOP
    v_before := v_left;
    FOR v_next IN
      SELECT * FROM contactd.shares(v_left, a_most_running, a_not_tenants, a_not_owners)
    LOOP
      SELECT coalesce(array_agg(n.number), '{}') INTO v_more FROM (
        SELECT j.number FROM contactd.jobs j
        WHERE j.state = 1 AND j.worker IS NULL AND j.tenant = v_next.tenant
          AND j.owner = v_next.owner
        ORDER BY j.priority DESC, j.number LIMIT v_next.jobs FOR UPDATE SKIP LOCKED) n;
      UPDATE contactd.jobs j SET worker = a_worker, epoch = j.epoch + 1
        WHERE j.number = ANY(v_more);
      v_taken := v_taken || v_more;
      v_left := v_left - cardinality(v_more);
    END LOOP;
    EXIT WHEN v_left = v_before;
  END LOOP;
  RETURN QUERY SELECT j.number, j.name, j.state, j.epoch, j.cancel_requested, j.last_sequence,
      j.crc32, j.header, j.oldest_sequence, j.compacted, j.owner, j.tenant, j.request_id,
      j.labels_crc32, j.labels, j.note_crc32, j.note, s.crc32, s.spec, c.crc32, c.state, c.sequence
    FROM contactd.jobs j
      LEFT JOIN contactd.specs s
        ON s.job = j.number AND j.state = 1 AND octet_length(s.spec) <= a_spec_bytes
      LEFT JOIN contactd.checkpoints c ON c.job = j.number
    WHERE j.number = ANY(v_taken) ORDER BY j.priority DESC, j.number;
END $$;

-- Lends cells of a sweep that the worker runs; each range has the number a_loans.
CREATE OR REPLACE FUNCTION contactd.lend(
  a_worker text, a_name text, a_loans bigint[], a_firsts bigint[], a_lasts bigint[])
RETURNS void LANGUAGE sql AS $$
  INSERT INTO contactd.loans(job, epoch, loan, first, last)
  SELECT j.number, j.epoch, n.loan, n.first, n.last
  FROM contactd.jobs j, unnest(a_loans, a_firsts, a_lasts) AS n(loan, first, last)
  WHERE j.name = a_name AND j.worker = a_worker AND j.state = 2
  ON CONFLICT DO NOTHING
$$;

-- The loan that the worker has, or else one that nobody has, of the oldest sweep.
CREATE OR REPLACE FUNCTION contactd.take_loan(a_worker text)
RETURNS TABLE(name text, epoch bigint, loan bigint, first bigint, last bigint)
LANGUAGE plpgsql SET enable_seqscan = off AS $$
DECLARE
  v_loan contactd.loans;
BEGIN
  SELECT l.* INTO v_loan FROM contactd.loans l
    JOIN contactd.jobs j ON j.number = l.job AND j.epoch = l.epoch AND j.state = 2
    WHERE l.worker = a_worker AND NOT l.done LIMIT 1;
  IF NOT FOUND THEN
    SELECT l.* INTO v_loan FROM contactd.loans l
      JOIN contactd.jobs j ON j.number = l.job AND j.epoch = l.epoch AND j.state = 2
      WHERE l.worker IS NULL ORDER BY l.job, l.loan LIMIT 1 FOR UPDATE OF l SKIP LOCKED;
    IF NOT FOUND THEN RETURN; END IF;
    UPDATE contactd.loans l SET worker = a_worker
      WHERE l.job = v_loan.job AND l.epoch = v_loan.epoch AND l.loan = v_loan.loan;
  END IF;
  RETURN QUERY SELECT j.name, v_loan.epoch, v_loan.loan, v_loan.first, v_loan.last
    FROM contactd.jobs j WHERE j.number = v_loan.job;
END $$;

-- Appends the cells of a loan to the log of its sweep. Outcomes: as of change_job; O, too, if the
-- lender has them back.
CREATE OR REPLACE FUNCTION contactd.return_loan(
  a_worker text, a_name text, a_epoch bigint, a_loan bigint, a_failed bigint,
  a_not_converged bigint, a_steps bigint, a_kinds bigint[], a_codings bigint[], a_sizes bigint[],
  a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint,
  OUT outcome text, OUT first bigint, OUT job_tenant text)
LANGUAGE plpgsql AS $$
DECLARE
  v_job bigint;
  v_loan contactd.loans;
BEGIN
  SELECT j.number, j.tenant INTO v_job, job_tenant FROM contactd.jobs j
    WHERE j.name = a_name FOR UPDATE;
  SELECT l.* INTO v_loan FROM contactd.loans l
    WHERE l.job = v_job AND l.epoch = a_epoch AND l.loan = a_loan AND l.worker = a_worker
    FOR UPDATE;
  IF NOT FOUND THEN
    outcome := 'O';
    RETURN;
  ELSIF v_loan.done THEN  -- Sent again because the answer was lost.
    outcome := 'D';
    first := 1;
    RETURN;
  END IF;
  SELECT c.outcome, c.first INTO outcome, first FROM contactd.change_job(a_name, a_epoch, NULL,
    false, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, a_kinds, a_codings, a_sizes,
    a_crc32s, a_payloads, a_event_bytes) c;
  IF outcome = 'D' THEN
    UPDATE contactd.loans l SET done = true, failed = a_failed, not_converged = a_not_converged,
      steps = a_steps WHERE l.job = v_job AND l.epoch = a_epoch AND l.loan = a_loan;
  END IF;
END $$;

-- A worker gives a loan back as it was.
CREATE OR REPLACE FUNCTION contactd.refuse_loan(
  a_worker text, a_name text, a_epoch bigint, a_loan bigint) RETURNS void LANGUAGE sql AS $$
  UPDATE contactd.loans l SET worker = '' FROM contactd.jobs j
    WHERE j.name = a_name AND l.job = j.number AND l.epoch = a_epoch AND l.loan = a_loan
      AND l.worker = a_worker AND NOT l.done
$$;

-- Which of these loans have come to an end: done, or taken back because the worker is dead or, with
-- a_back, because nobody has taken them.
CREATE OR REPLACE FUNCTION contactd.settle_loans(
  a_worker text, a_name text, a_loans bigint[], a_back boolean)
RETURNS TABLE(loan bigint, done boolean, failed bigint, not_converged bigint, steps bigint)
LANGUAGE plpgsql AS $$
DECLARE
  v_job contactd.jobs;
BEGIN
  SELECT j.* INTO v_job FROM contactd.jobs j
    WHERE j.name = a_name AND j.worker = a_worker AND j.state = 2;
  UPDATE contactd.loans l SET worker = ''
    WHERE l.job = v_job.number AND l.epoch = v_job.epoch AND l.loan = ANY(a_loans) AND NOT l.done
      AND CASE WHEN l.worker IS NULL THEN a_back ELSE NOT EXISTS(SELECT FROM contactd.workers w
        WHERE w.name = l.worker AND w.until > clock_timestamp()) END;
  RETURN QUERY SELECT l.loan, l.done, l.failed, l.not_converged, l.steps FROM contactd.loans l
    WHERE l.job = v_job.number AND l.epoch = v_job.epoch AND l.loan = ANY(a_loans)
      AND (l.done OR l.worker = '');
END $$;

-- How much there is to do, and who does it; what launchers and scalers ask. `cells`: of sweeps that
-- run, which several workers can compute.
CREATE OR REPLACE FUNCTION contactd.demand(
  OUT queued bigint, OUT running bigint, OUT workers bigint, OUT threads bigint, OUT cells bigint)
LANGUAGE sql STABLE AS $$
  SELECT
    (SELECT count(*) FROM contactd.jobs j WHERE j.state = 1 AND j.worker IS NULL),
    (SELECT count(*) FROM contactd.jobs j
      WHERE j.state = 2 OR (j.state = 1 AND j.worker IS NOT NULL)),
    count(*), coalesce(sum(w.threads), 0)::bigint,
    (SELECT coalesce(sum(j.cells), 0)::bigint FROM contactd.jobs j WHERE j.state = 2)
  FROM contactd.workers w WHERE w.until > clock_timestamp()
$$;

-- Jobs that have changed their state in transactions that a_since had not seen the end of, and what
-- to ask with next; in the first row, and in all.
CREATE OR REPLACE FUNCTION contactd.moved_since(a_since bigint)
RETURNS TABLE(next bigint, name text, tenant text) LANGUAGE sql STABLE AS $$
  SELECT pg_snapshot_xmin(pg_current_snapshot())::text::bigint, j.name, j.tenant
  FROM (VALUES(1)) AS one(row) LEFT JOIN contactd.jobs j
    ON a_since > 0 AND j.moved >= a_since::text::xid8
$$;
)sql";

}  // namespace contact::postgres
