SET statement_timeout = 0;
SET lock_timeout = 0;
SET idle_in_transaction_session_timeout = 0;
SET client_encoding = 'UTF8';
SET standard_conforming_strings = on;
SELECT pg_catalog.set_config('search_path', '', false);
SET check_function_bodies = false;
SET xmloption = content;
SET client_min_messages = warning;
SET row_security = off;
CREATE SCHEMA contactd;
CREATE FUNCTION contactd.append(a_job bigint, a_last bigint, a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[]) RETURNS void
    LANGUAGE plpgsql
    AS $$
BEGIN
  INSERT INTO contactd.events(job, sequence, kind, coding, size, crc32, payload)
  SELECT a_job, a_last + e.place, e.kind, e.coding, e.size, e.crc32, e.payload
  FROM unnest(a_kinds, a_codings, a_sizes, a_crc32s, a_payloads) WITH ORDINALITY
    AS e(kind, coding, size, crc32, payload, place);
END $$;
CREATE FUNCTION contactd.beat(a_worker text, a_host text, a_threads bigint, a_batch_id text, a_lease bigint) RETURNS TABLE(name text, epoch bigint, cancel_requested boolean)
    LANGUAGE plpgsql
    AS $$
BEGIN
  INSERT INTO contactd.workers AS w(name, host, threads, batch_id, until)
    VALUES(a_worker, a_host, a_threads, a_batch_id,
      clock_timestamp() + a_lease * interval '1 ms')
    ON CONFLICT ON CONSTRAINT workers_pkey DO UPDATE SET until = excluded.until;
  DELETE FROM contactd.workers w WHERE w.until < clock_timestamp() - interval '1 day';
  RETURN QUERY SELECT j.name, j.epoch, j.cancel_requested FROM contactd.jobs j
    WHERE (j.state = 2 OR (j.state = 1 AND j.worker IS NOT NULL)) AND j.worker = a_worker;
END $$;
CREATE FUNCTION contactd.bytes_of(a_tenant text, a_owner text) RETURNS bigint
    LANGUAGE plpgsql STABLE
    AS $$
BEGIN
  RETURN (SELECT coalesce(sum(j.bytes), 0) FROM contactd.jobs j
    WHERE j.tenant = a_tenant AND j.owner = a_owner);
END $$;
CREATE FUNCTION contactd.change_job(a_name text, a_epoch bigint, a_change bigint, a_take boolean, a_state bigint, a_end_time bigint, a_crc32 bigint, a_header bytea, a_result_crc32 bigint, a_result bytea, a_checkpoint_events bigint, a_checkpoint_crc32 bigint, a_checkpoint bytea, a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint, OUT outcome text, OUT first bigint, OUT job_tenant text) RETURNS record
    LANGUAGE plpgsql
    AS $$
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
    WHERE j.name = a_name AND j.epoch = a_epoch AND j.state NOT IN (3,4,5)
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
CREATE FUNCTION contactd.claim(a_worker text, a_most bigint, a_most_running bigint, a_grace bigint, a_tenants text[], a_owners text[], a_milliseconds bigint[], a_not_tenants text[], a_not_owners text[], a_spec_bytes bigint) RETURNS TABLE(number bigint, name text, state smallint, epoch bigint, cancel_requested boolean, last_sequence bigint, crc32 bigint, header bytea, oldest_sequence bigint, compacted boolean, owner text, tenant text, request_id text, spec_crc32 bigint, spec bytea, checkpoint_crc32 bigint, checkpoint bytea, checkpoint_sequence bigint)
    LANGUAGE plpgsql
    SET plan_cache_mode TO 'force_generic_plan'
    SET enable_seqscan TO 'off'
    AS $$
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
    ON CONFLICT ON CONSTRAINT used_pkey DO UPDATE SET at = v_now, seconds = excluded.seconds
      + u.seconds * power(0.5, extract(epoch FROM v_now - u.at) / 60);
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
      j.crc32, j.header, j.oldest_sequence, j.compacted, j.owner, j.tenant, j.request_id, s.crc32,
      s.spec, c.crc32, c.state, c.sequence
    FROM contactd.jobs j
      LEFT JOIN contactd.specs s
        ON s.job = j.number AND j.state = 1 AND octet_length(s.spec) <= a_spec_bytes
      LEFT JOIN contactd.checkpoints c ON c.job = j.number
    WHERE j.number = ANY(v_taken) ORDER BY j.priority DESC, j.number;
END $$;
CREATE FUNCTION contactd.compact_job(a_name text, a_kind bigint, OUT outcome text, OUT job_owner text, OUT job_tenant text) RETURNS record
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.count_of(a_tenant text, a_owner text, OUT jobs bigint, OUT cells bigint, OUT running bigint) RETURNS record
    LANGUAGE plpgsql STABLE
    AS $$
BEGIN
  SELECT count(*), coalesce(sum(j.cells), 0)::bigint,
      count(*) FILTER (WHERE j.state = 2 OR j.worker IS NOT NULL)
    INTO jobs, cells, running FROM contactd.jobs j
    WHERE j.tenant = a_tenant AND j.owner = a_owner AND j.state NOT IN (3,4,5);
END $$;
CREATE FUNCTION contactd.create_job(a_name text, a_uid text, a_request_id text, a_owner text, a_tenant text, a_state bigint, a_end_time bigint, a_crc32 bigint, a_header bytea, a_spec_crc32 bigint, a_spec bytea, a_label_keys text[], a_label_values text[], a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint, a_may_create boolean, a_max_owner_bytes bigint, a_priority bigint, a_cells bigint, a_max_waiting bigint, a_max_owner_jobs bigint, a_max_owner_cells bigint, OUT outcome text, OUT existing text, OUT has bigint) RETURNS record
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.demand(OUT queued bigint, OUT running bigint, OUT workers bigint, OUT threads bigint, OUT cells bigint) RETURNS record
    LANGUAGE sql STABLE
    AS $$
  SELECT
    (SELECT count(*) FROM contactd.jobs j WHERE j.state = 1 AND j.worker IS NULL),
    (SELECT count(*) FROM contactd.jobs j
      WHERE j.state = 2 OR (j.state = 1 AND j.worker IS NOT NULL)),
    count(*), coalesce(sum(w.threads), 0)::bigint,
    (SELECT coalesce(sum(j.cells), 0)::bigint FROM contactd.jobs j WHERE j.state = 2)
  FROM contactd.workers w WHERE w.until > clock_timestamp()
$$;
CREATE FUNCTION contactd.exceeded(a_tenant text, a_owner text, a_cells bigint, a_max_owner_bytes bigint, a_max_waiting bigint, a_max_owner_jobs bigint, a_max_owner_cells bigint, OUT outcome text, OUT has bigint) RETURNS record
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.job_sizes() RETURNS TABLE(name text, end_time bigint, bytes bigint)
    LANGUAGE sql STABLE
    AS $$
  SELECT j.name, j.end_time, j.bytes FROM contactd.jobs j WHERE j.state IN (3,4,5)
  ORDER BY j.end_time, j.number
$$;
CREATE FUNCTION contactd.leave(a_worker text) RETURNS void
    LANGUAGE sql
    AS $$
  UPDATE contactd.jobs j SET worker = NULL, epoch = j.epoch + 1
    WHERE j.state = 1 AND j.worker = a_worker;
  DELETE FROM contactd.workers w WHERE w.name = a_worker;
$$;
CREATE FUNCTION contactd.lend(a_worker text, a_name text, a_loans bigint[], a_firsts bigint[], a_lasts bigint[]) RETURNS void
    LANGUAGE sql
    AS $$
  INSERT INTO contactd.loans(job, epoch, loan, first, last)
  SELECT j.number, j.epoch, n.loan, n.first, n.last
  FROM contactd.jobs j, unnest(a_loans, a_firsts, a_lasts) AS n(loan, first, last)
  WHERE j.name = a_name AND j.worker = a_worker AND j.state = 2
  ON CONFLICT DO NOTHING
$$;
SET default_tablespace = '';
SET default_table_access_method = heap;
CREATE TABLE contactd.jobs (
    number bigint NOT NULL,
    name text NOT NULL COLLATE pg_catalog."C",
    uid text NOT NULL,
    request_id text COLLATE pg_catalog."C",
    state smallint NOT NULL,
    epoch bigint DEFAULT 0 NOT NULL,
    cancel_requested boolean DEFAULT false NOT NULL,
    last_sequence bigint NOT NULL,
    end_time bigint DEFAULT 0 NOT NULL,
    bytes bigint DEFAULT 0 NOT NULL,
    crc32 bigint NOT NULL,
    header bytea NOT NULL,
    oldest_sequence bigint DEFAULT 1 NOT NULL,
    compacted boolean DEFAULT false NOT NULL,
    owner text NOT NULL COLLATE pg_catalog."C",
    tenant text NOT NULL COLLATE pg_catalog."C",
    last_change bigint,
    first_of_change bigint,
    priority bigint DEFAULT 0 NOT NULL,
    cells bigint DEFAULT 0 NOT NULL,
    worker text COLLATE pg_catalog."C",
    moved xid8 DEFAULT pg_current_xact_id() NOT NULL
)
WITH (fillfactor='70', autovacuum_vacuum_scale_factor='0.02', autovacuum_vacuum_threshold='200');
CREATE FUNCTION contactd.list_jobs(a_before bigint, a_tenant text, a_states bigint[], a_keys text[], a_values text[], a_prefix text, a_limit bigint) RETURNS SETOF contactd.jobs
    LANGUAGE plpgsql STABLE
    AS $_$
DECLARE
  v_sql text := 'SELECT j.* FROM contactd.jobs j WHERE j.number < $1';
BEGIN
  IF a_tenant IS NOT NULL THEN v_sql := v_sql || ' AND j.tenant = $2'; END IF;
  IF cardinality(a_states) > 0 THEN
    v_sql := v_sql || ' AND j.state = ANY($3)';
    -- By the index of the unfinished, who are few beside those that have ended.
    IF a_states <@ '{1,2}' THEN v_sql := v_sql || ' AND j.state NOT IN (3,4,5)'; END IF;
  END IF;
  FOR i IN 1..cardinality(a_keys) LOOP
    v_sql := v_sql || format(' AND EXISTS(SELECT FROM contactd.labels l WHERE l.job = j.number'
      ' AND l.key = ($4)[%1$s] AND l.value = ($5)[%1$s])', i);
  END LOOP;
  IF a_prefix <> '' THEN v_sql := v_sql || ' AND starts_with(j.name, $6)'; END IF;
  RETURN QUERY EXECUTE v_sql || ' ORDER BY j.number DESC LIMIT $7'
    USING a_before, a_tenant, a_states, a_keys, a_values, a_prefix, a_limit;
END $_$;
CREATE FUNCTION contactd.moved_since(a_since bigint) RETURNS TABLE(next bigint, name text, tenant text)
    LANGUAGE sql STABLE
    AS $$
  SELECT pg_snapshot_xmin(pg_current_snapshot())::text::bigint, j.name, j.tenant
  FROM (VALUES(1)) AS one(row) LEFT JOIN contactd.jobs j
    ON a_since > 0 AND j.moved >= a_since::text::xid8
$$;
CREATE FUNCTION contactd.owner_of(a_tenant text, a_name text) RETURNS text
    LANGUAGE plpgsql STABLE
    AS $$
BEGIN
  RETURN (SELECT j.owner FROM contactd.jobs j WHERE j.name = a_name AND j.tenant = a_tenant);
END $$;
CREATE FUNCTION contactd.positions_of(a_names text[]) RETURNS TABLE(name text, last_sequence bigint, ended boolean)
    LANGUAGE plpgsql STABLE
    AS $$
BEGIN
  RETURN QUERY SELECT j.name, j.last_sequence, j.state IN (3,4,5) FROM contactd.jobs j
    WHERE j.name = ANY(a_names);
END $$;
CREATE FUNCTION contactd.purge(a_kind bigint) RETURNS boolean
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.read_events(a_name text, a_after bigint, a_kinds bigint, a_bytes bigint, a_scanned bigint) RETURNS TABLE(last_sequence bigint, oldest_sequence bigint, sequence bigint, kind smallint, coding smallint, size integer, crc32 bigint, payload bytea)
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.read_job(a_name text, a_tenant text, a_spec boolean, a_checkpoint boolean, a_result boolean) RETURNS TABLE(number bigint, name text, state smallint, epoch bigint, cancel_requested boolean, last_sequence bigint, crc32 bigint, header bytea, oldest_sequence bigint, compacted boolean, owner text, tenant text, request_id text, spec_crc32 bigint, spec bytea, checkpoint_crc32 bigint, checkpoint bytea, checkpoint_sequence bigint, result_crc32 bigint, result bytea)
    LANGUAGE plpgsql
    AS $$
BEGIN
  RETURN QUERY SELECT j.number, j.name, j.state, j.epoch, j.cancel_requested, j.last_sequence,
      j.crc32, j.header, j.oldest_sequence, j.compacted, j.owner, j.tenant, j.request_id, s.crc32,
      s.spec, c.crc32, c.state, c.sequence, r.crc32, r.result
    FROM contactd.jobs j
      LEFT JOIN contactd.specs s ON a_spec AND s.job = j.number
      LEFT JOIN contactd.checkpoints c ON a_checkpoint AND c.job = j.number
      LEFT JOIN contactd.results r ON a_result AND r.job = j.number
    WHERE j.name = a_name AND (a_tenant IS NULL OR j.tenant = a_tenant);
END $$;
CREATE FUNCTION contactd.refuse_loan(a_worker text, a_name text, a_epoch bigint, a_loan bigint) RETURNS void
    LANGUAGE sql
    AS $$
  UPDATE contactd.loans l SET worker = '' FROM contactd.jobs j
    WHERE j.name = a_name AND l.job = j.number AND l.epoch = a_epoch AND l.loan = a_loan
      AND l.worker = a_worker AND NOT l.done
$$;
CREATE FUNCTION contactd.remove_job(a_name text, a_uid text, OUT outcome text, OUT job_owner text, OUT job_tenant text, OUT job_uid text) RETURNS record
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.request_cancel(a_name text) RETURNS text
    LANGUAGE plpgsql
    AS $$
BEGIN
  UPDATE contactd.jobs j SET cancel_requested = true WHERE j.name = a_name;
  RETURN CASE WHEN FOUND THEN 'D' ELSE 'N' END;
END $$;
CREATE FUNCTION contactd.return_loan(a_worker text, a_name text, a_epoch bigint, a_loan bigint, a_failed bigint, a_not_converged bigint, a_steps bigint, a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint, OUT outcome text, OUT first bigint, OUT job_tenant text) RETURNS record
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.schema_version() RETURNS integer
    LANGUAGE sql STABLE
    AS $$
  SELECT v.version FROM contactd.version v
$$;
CREATE FUNCTION contactd.settle_loans(a_worker text, a_name text, a_loans bigint[], a_back boolean) RETURNS TABLE(loan bigint, done boolean, failed bigint, not_converged bigint, steps bigint)
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.shares(a_most bigint, a_most_running bigint, a_not_tenants text[], a_not_owners text[]) RETURNS TABLE(tenant text, owner text, jobs bigint)
    LANGUAGE plpgsql
    AS $$
BEGIN
  RETURN QUERY WITH
  shares AS (
    SELECT s.tenant, s.owner, sum(s.seconds) AS seconds, sum(s.running)::bigint AS running FROM (
      SELECT u.tenant, u.owner, u.seconds
          * power(0.5, extract(epoch FROM clock_timestamp() - u.at) / 60) AS seconds, 0 AS running
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
CREATE FUNCTION contactd.stored_of(a_tenant text, a_owner text, a_most bigint) RETURNS bigint
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.take_loan(a_worker text) RETURNS TABLE(name text, epoch bigint, loan bigint, first bigint, last bigint)
    LANGUAGE plpgsql
    SET enable_seqscan TO 'off'
    AS $$
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
CREATE FUNCTION contactd.waiting(a_most bigint, a_now boolean) RETURNS bigint
    LANGUAGE plpgsql
    AS $$
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
CREATE FUNCTION contactd.waiting_owners() RETURNS TABLE(tenant text, owner text)
    LANGUAGE plpgsql
    AS $$
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
CREATE TABLE contactd.checkpoints (
    job bigint NOT NULL,
    sequence bigint NOT NULL,
    crc32 bigint NOT NULL,
    state bytea NOT NULL
);
ALTER TABLE ONLY contactd.checkpoints ALTER COLUMN state SET STORAGE EXTERNAL;
CREATE TABLE contactd.compacting (
    job bigint NOT NULL,
    "position" bigint NOT NULL
);
CREATE TABLE contactd.events (
    job bigint NOT NULL,
    sequence bigint NOT NULL,
    kind smallint NOT NULL,
    coding smallint NOT NULL,
    size integer NOT NULL,
    crc32 bigint NOT NULL,
    payload bytea NOT NULL
);
ALTER TABLE ONLY contactd.events ALTER COLUMN payload SET STORAGE EXTERNAL;
ALTER TABLE contactd.jobs ALTER COLUMN number ADD GENERATED ALWAYS AS IDENTITY (
    SEQUENCE NAME contactd.jobs_number_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1
);
CREATE TABLE contactd.labels (
    key text NOT NULL COLLATE pg_catalog."C",
    value text NOT NULL COLLATE pg_catalog."C",
    job bigint NOT NULL
);
CREATE TABLE contactd.loans (
    job bigint NOT NULL,
    epoch bigint NOT NULL,
    loan bigint NOT NULL,
    first bigint NOT NULL,
    last bigint NOT NULL,
    worker text COLLATE pg_catalog."C",
    done boolean DEFAULT false NOT NULL,
    failed bigint DEFAULT 0 NOT NULL,
    not_converged bigint DEFAULT 0 NOT NULL,
    steps bigint DEFAULT 0 NOT NULL
);
CREATE TABLE contactd.removed (
    job bigint NOT NULL
);
CREATE TABLE contactd.results (
    job bigint NOT NULL,
    crc32 bigint NOT NULL,
    result bytea NOT NULL
);
ALTER TABLE ONLY contactd.results ALTER COLUMN result SET STORAGE EXTERNAL;
CREATE TABLE contactd.specs (
    job bigint NOT NULL,
    crc32 bigint NOT NULL,
    spec bytea NOT NULL
);
CREATE TABLE contactd.used (
    worker text NOT NULL COLLATE pg_catalog."C",
    tenant text NOT NULL COLLATE pg_catalog."C",
    owner text NOT NULL COLLATE pg_catalog."C",
    seconds double precision NOT NULL,
    at timestamp with time zone NOT NULL
);
CREATE TABLE contactd.version (
    version integer NOT NULL
);
CREATE TABLE contactd.workers (
    name text NOT NULL COLLATE pg_catalog."C",
    host text NOT NULL,
    threads bigint NOT NULL,
    batch_id text NOT NULL,
    until timestamp with time zone NOT NULL
);
INSERT INTO contactd.checkpoints VALUES (5, 5, 4246106929, '\x7768657265207468652072756e20676f6573206f6e');
INSERT INTO contactd.compacting VALUES (2, 0);
INSERT INTO contactd.events VALUES (1, 1, 10, 0, 38, 3568045615, '\x120c08facb94d80610cf8beea00252160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.events VALUES (1, 2, 10, 0, 18, 2957834520, '\x120c08facb94d80610dcd6b1ba0252020802');
INSERT INTO contactd.events VALUES (1, 3, 14, 0, 18, 3782211867, '\x120c08facb94d80610f7dab5bb0272020801');
INSERT INTO contactd.events VALUES (1, 4, 12, 0, 116, 1198779864, '\x120c08facb94d8061081d5a5bc0262640801222f0a0542312d423210011918745d5bc23da64121f717d24e236fea3f299a9999999999e93f31a0921158a1b3a5bf4801222f0a0542322d4233100119f519a2fc5aebb2412178a4f27c8b80e83f29666666666666e63f316c5c92f608a6b8bf4801');
INSERT INTO contactd.events VALUES (1, 5, 12, 0, 118, 2002414926, '\x120c08facb94d80610bf85a8bc02626608011001222f0a0542312d423210011962c6a4b56adbaa41212f096fe3d59ce93f299a9999999999e93f3100f819ba5ab644bf4801222f0a0542322d4233100119652135755ff3ba4121967cbecd8575e63f29666666666666e63f3180fa9fa41c3365bf4801');
INSERT INTO contactd.events VALUES (1, 6, 12, 0, 118, 1208945723, '\x120c08facb94d80610a092a8bc02626608011002222f0a0542312d423210011918982cfe05efaa4121ebf3cfdd9b99e93f299a9999999999e93f3100000000b902bdbe4801222f0a0542322d42331001193d950c36cd33bb41212c25c00d6966e63f29666666666666e63f310000fcb4bbb8bdbe4801');
INSERT INTO contactd.events VALUES (1, 7, 12, 0, 116, 934634089, '\x120c08facb94d8061095baacbc02626408011003222d0a0542312d4232100119c934d71f13efaa4121d6b399999999e93f299a9999999999e93f310000000080fc74bd222d0a0542322d423310011920f550afd933bb4121249466666666e63f29666666666666e63f3100000000800280bd2801');
INSERT INTO contactd.events VALUES (1, 8, 13, 0, 214, 2633260222, '\x120c08facb94d80610f8c7acbc026ac5010a0542312d423210011801200128013003380149871c7c87402b493f51334d394af1a6613f61780bdd36ecfe193f719a9999999999c93f792eda2b8fc295adbf8101c934d71f13efaa41890163d17bd0341302409101054ff9b387ebdc3f99012bf70b1056b4743fa101bc4905296e806abfa9018c7dd999b7a3523fb101509797a88859463fb9013bcc152f64ba0c3fc1014ee58678281567bfc9019a9999999999e93fd101d6b399999999e93fd901df9005ffbb295a40e901aaf3698b282c8c3df00101');
INSERT INTO contactd.events VALUES (1, 9, 13, 0, 195, 3120788404, '\x120c08facb94d80610e5fdacbc026ab2010a0542322d4233100118022001280130033801499bd51c58c2e7583f51971df5a15f1a653f61cd074affc4ef143f798e7ee1a31435bbbf810120f550afd933bb418901547b89605c411240990181d92daf1153693fa1014f87e05e68d158bfa9010801d6ff74944a3fb1015e5620ff0015493fb9018cf52daf1153693fc101a02883ded7f71abfc901666666666666e63fd101249466666666e63fd9018bdc5a76e5d95340e9018faa1757b0b7713df00101');
INSERT INTO contactd.events VALUES (1, 10, 20, 0, 102, 2766000376, '\x120c08facb94d806108985adbc02a201550a0542312d4232100118012001280139334d394af1a6613f400149c934d71f13efaa41512bf70b1056b4743f59bc4905296e806abf619a9999999999e93f69d6b399999999e93f700178018101aaf3698b282c8c3d');
INSERT INTO contactd.events VALUES (1, 11, 20, 0, 102, 471789311, '\x120c08facb94d80610b699adbc02a201550a0542322d4233100118012001280139971df5a15f1a653f40014920f550afd933bb415181d92daf1153693f594f87e05e68d158bf61666666666666e63f69249466666666e63f7001780181018faa1757b0b7713d');
INSERT INTO contactd.events VALUES (1, 12, 15, 1, 1890, 4186775982, '\x28b52ffd6062067d2900544936020000120c08facb94d80610d7c8aebc027aa504100b1a0f0a0474696d65121a01731a1a0a0b42312e706f736974696f6e12081a016d1a1c76656c6f6369747912081a036d2f32323333230a1142312d42322e6465666f726d610b1a016d1a370a1a5f14270a13636f6e746163745f666f726365120d1a014e1a290a1465787465726e616c0e1a014e1a230a1142322d4233002dd335960497ff010003008877bd796dbe0800ff019a62523a98c15ec10000009ac8daf7440263e43c00000077614ca3fa71f2dc00009aa3679f0bf5eea162000000abfd2499b037aa0a000000466d881fc8ee9cd454789a1364d49fb45795dc000000d1678b729865ce000000000020dd5109cff2e800000076662428dc1eb48e919800c6be16aa4874da26000000c88fa750d0688c709c60d00000000043bcef215621ff00005600fcae984b2585b200ff009957a7c33d7e6e7900000099271b1ee15b726f890000001a33d8dcf66d781f0000998646d36369f3073b000000b01e7b2ad94dabb800000075eb5d5b051b49a90bdd9974761fbce66f291f000000fa8f8e5fe43072000000000e50b7ce04ae82e50000004336e90aba37c79cec5000bc46e52b88681ae00000000d1ce3388e0e8eff00000e00dbd2e1b1a24b0100ff00997bbe1bc51b5dd20000009961d410fd7b2a95f900000027f21f2aed168a0d000099ca86e8dc24f9ec830000005d4f4a2a089840fc000000d6ed6bb5565722a70bc69936b8461b0186800d000000fe449ba47b5ca400000000fcfac3b93013cc7b0000007425ba37b1350120cc4b00f5e4cef5cee4bcf2eb1445752d75ff00002d007cc17a9277c32500ff0099af002fa4afca6800000099d09ffc17a3e0dc800000002a1722cc0c8dfd380000997144b911bc56ad3f000000314403fd842de6f1000000912c389a32e2f63fb35e994a9cff67e09868380000005878f8daec452900000000bcf52133ba46de180000004048422b15f6897c9bc6009c97b9a597bd4dc7e21d4771b271ff0000b200b2fb7988c8e38f3055006cae49a1825caf207be0ff000000139d82ea63ba9c28000099660646b7a74c0f000000008d9f064eb60c05b50000000add50c4d99802d8c71399b93a267d18e6a628000000880eff8f7bde7f0000000066f90901262f4fef00000099a0b1af4b95cbe0be0700d0a6c0b22c53bdd736c9721b9d1bff00009d000ad630c51fd6ff00ff00999d517ed505938b00000099660101ffffffffff0000002ed3e0be951f5c4d000099664222d63e79819fec0000001db8e2009242472af58a99d73a8081190cdf4d00000085f671c75840b100000000219c01c46ac688c3000000a978c81c4f22ec06b72a00145b2ae900388fb23ad5f9fdfffdff0000ff0014f8f6fdffffff00ff00c932f5f7e82808fd000000b94600009e7de8f2000205000000c9361948cbe6f3fafef3f2f7ee290df5fbfec92ecc6bcefc00040000000054aeeef7e62c0300000000d876cde1edeacd63e1f0f6ec1f13f2fc009e7ce0e443e3faff000000e866cde1edea191000000044beeef7e63cf3000000003fc0ff8080ff3fc03fc1ffffffff3fc07f8000000040bfffffffc0403e8080ffff7f8040bfffffffc03f00000042208002a1d271037006141880f030463adbdd4488b1c86eb58fa036288bca831407a844208a0d636d7a07467d6da02cee9746dc263676222af21a0314c2a415c4a2c22ee88d58c9628a414d0adb580c92c463cb2049d1c4b0194a0ac99547b00438019e00860005026a1c73c8db749c0533a453790eaf72582a11dd5c75c150e64247e686005cc4f0bed941f4c0a426f4ba5a4f0cb9f013');
INSERT INTO contactd.events VALUES (1, 13, 10, 0, 20, 4079321821, '\x120c08facb94d80610f2c1debd02520408032001');
INSERT INTO contactd.events VALUES (2, 1, 10, 0, 38, 2296722774, '\x120c08facb94d8061094f0efc50252160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.events VALUES (2, 2, 10, 0, 18, 1999163946, '\x120c08facb94d80610c086f3ca0252020802');
INSERT INTO contactd.events VALUES (2, 3, 14, 0, 18, 681856495, '\x120c08facb94d806108ef5f6ca0272020801');
INSERT INTO contactd.events VALUES (2, 4, 12, 0, 116, 3413303816, '\x120c08facb94d80610dca182cb0262640801222f0a0542312d423210011918745d5bc23da64121f717d24e236fea3f299a9999999999e93f31a0921158a1b3a5bf4801222f0a0542322d4233100119f519a2fc5aebb2412178a4f27c8b80e83f29666666666666e63f316c5c92f608a6b8bf4801');
INSERT INTO contactd.events VALUES (2, 5, 12, 0, 118, 1800884109, '\x120c08facb94d806109ae286cb02626608011001222f0a0542312d423210011962c6a4b56adbaa41212f096fe3d59ce93f299a9999999999e93f3100f819ba5ab644bf4801222f0a0542322d4233100119652135755ff3ba4121967cbecd8575e63f29666666666666e63f3180fa9fa41c3365bf4801');
INSERT INTO contactd.events VALUES (2, 6, 12, 0, 118, 1525985901, '\x120c08facb94d80610bcf186cb02626608011002222f0a0542312d423210011918982cfe05efaa4121ebf3cfdd9b99e93f299a9999999999e93f3100000000b902bdbe4801222f0a0542322d42331001193d950c36cd33bb41212c25c00d6966e63f29666666666666e63f310000fcb4bbb8bdbe4801');
INSERT INTO contactd.events VALUES (2, 7, 12, 0, 116, 3297180877, '\x120c08facb94d80610f0f78acb02626408011003222d0a0542312d4232100119c934d71f13efaa4121d6b399999999e93f299a9999999999e93f310000000080fc74bd222d0a0542322d423310011920f550afd933bb4121249466666666e63f29666666666666e63f3100000000800280bd2801');
INSERT INTO contactd.events VALUES (2, 8, 13, 0, 214, 3338385575, '\x120c08facb94d80610f4868bcb026ac5010a0542312d423210011801200128013003380149871c7c87402b493f51334d394af1a6613f61780bdd36ecfe193f719a9999999999c93f792eda2b8fc295adbf8101c934d71f13efaa41890163d17bd0341302409101054ff9b387ebdc3f99012bf70b1056b4743fa101bc4905296e806abfa9018c7dd999b7a3523fb101509797a88859463fb9013bcc152f64ba0c3fc1014ee58678281567bfc9019a9999999999e93fd101d6b399999999e93fd901df9005ffbb295a40e901aaf3698b282c8c3df00101');
INSERT INTO contactd.events VALUES (2, 9, 13, 0, 195, 3306277281, '\x120c08facb94d80610a4ae8bcb026ab2010a0542322d4233100118022001280130033801499bd51c58c2e7583f51971df5a15f1a653f61cd074affc4ef143f798e7ee1a31435bbbf810120f550afd933bb418901547b89605c411240990181d92daf1153693fa1014f87e05e68d158bfa9010801d6ff74944a3fb1015e5620ff0015493fb9018cf52daf1153693fc101a02883ded7f71abfc901666666666666e63fd101249466666666e63fd9018bdc5a76e5d95340e9018faa1757b0b7713df00101');
INSERT INTO contactd.events VALUES (2, 10, 20, 0, 102, 3399754227, '\x120c08facb94d80610cab68bcb02a201550a0542312d4232100118012001280139334d394af1a6613f400149c934d71f13efaa41512bf70b1056b4743f59bc4905296e806abf619a9999999999e93f69d6b399999999e93f700178018101aaf3698b282c8c3d');
INSERT INTO contactd.events VALUES (2, 11, 20, 0, 102, 2402397373, '\x120c08facb94d80610f2c88bcb02a201550a0542322d4233100118012001280139971df5a15f1a653f40014920f550afd933bb415181d92daf1153693f594f87e05e68d158bf61666666666666e63f69249466666666e63f7001780181018faa1757b0b7713d');
INSERT INTO contactd.events VALUES (2, 12, 15, 1, 930, 2561396682, '\x28b52ffd60a2020d1200b41f36020000120c08facb94d80610febb8ecb027aa50410031a0f0a0474696d65121a01731a1a0a0b42312e706f736974696f6e12081a016d1a1c76656c6f6369747912081a036d2f32323333230a1142312d42322e6465666f726d610b1a016d1a370a1a5f14270a13636f6e746163745f666f726365120d1a014e1a290a1465787465726e616c0e1a014e1a230a1142322d423300fc04001ae59a396c9a27cf00fb5b9a1bea0099a900b0ac9ac55400ce6400c27c007e6000b42600c27c00d06000a956002fbc99fcf0991700008abc99cc52008f5400cc729943b900721a004e6200b5440059cb004e6200721a00f10e0040b299c2d09944f2002f2b990b9a004d7800ea4d99646700a4b700c477002a5f0083da00c47700a4b700d22d0085b2995ca099bfc3003e5499bf070090a5009dff99f8950029ac000fe000970b0081a0000fe00029ac004db200b15999fe1e992fb900937f99691500a5e800fc639977f7007f01002ea3003c7f008111002ea3007f0100629d00cd3899e8f29970fc00e91f996907004f3700af2a9922c900b19d0010df0015ab002ae00010df00b19d0060af0024dac9d85fb946ff00ae4bc9360000c23f00e352c91d130003f8002ba9000e0700b550003b8900f318003fc0003fc03f3f803fc0ff003fc03fc000003fc0003e413f408000407f00407f003f4100bf4000407f003f801c00600053020404b81200800029026a66cc99f236e538539821f354aec3ab6658ce1251cd55a16048cd8589cced09002c02c2033703417485490ba19f576b21865ce509');
INSERT INTO contactd.events VALUES (2, 13, 10, 0, 20, 1512985156, '\x120c08facb94d80610f7e891cb02520408032001');
INSERT INTO contactd.events VALUES (3, 1, 10, 0, 38, 2686934169, '\x120c08facb94d8061081cfd3dd0252160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.events VALUES (3, 2, 10, 0, 18, 1239672202, '\x120c08facb94d80610bd96c3e20252020802');
INSERT INTO contactd.events VALUES (3, 3, 14, 0, 18, 1094002760, '\x120c08facb94d80610ba83cee20272020801');
INSERT INTO contactd.events VALUES (3, 4, 12, 0, 116, 439320224, '\x120c08facb94d80610f0b1dfe20262640801222f0a0542312d423210011918745d5bc23da64121f717d24e236fea3f299a9999999999e93f31a0921158a1b3a5bf4801222f0a0542322d4233100119f519a2fc5aebb2412178a4f27c8b80e83f29666666666666e63f316c5c92f608a6b8bf4801');
INSERT INTO contactd.events VALUES (3, 5, 12, 0, 118, 1297761703, '\x120c08facb94d80610e3bde3e202626608011001222f0a0542312d423210011962c6a4b56adbaa41212f096fe3d59ce93f299a9999999999e93f3100f819ba5ab644bf4801222f0a0542322d4233100119652135755ff3ba4121967cbecd8575e63f29666666666666e63f3180fa9fa41c3365bf4801');
INSERT INTO contactd.events VALUES (3, 6, 12, 0, 118, 61751847, '\x120c08facb94d80610c6cbe3e202626608011002222f0a0542312d423210011918982cfe05efaa4121ebf3cfdd9b99e93f299a9999999999e93f3100000000b902bdbe4801222f0a0542322d42331001193d950c36cd33bb41212c25c00d6966e63f29666666666666e63f310000fcb4bbb8bdbe4801');
INSERT INTO contactd.events VALUES (3, 7, 12, 0, 116, 3294335765, '\x120c08facb94d8061094fae5e202626408011003222d0a0542312d4232100119c934d71f13efaa4121d6b399999999e93f299a9999999999e93f310000000080fc74bd222d0a0542322d423310011920f550afd933bb4121249466666666e63f29666666666666e63f3100000000800280bd2801');
INSERT INTO contactd.events VALUES (3, 8, 13, 0, 214, 2385969382, '\x120c08facb94d80610ca85e6e2026ac5010a0542312d423210011801200128013003380149871c7c87402b493f51334d394af1a6613f61780bdd36ecfe193f719a9999999999c93f792eda2b8fc295adbf8101c934d71f13efaa41890163d17bd0341302409101054ff9b387ebdc3f99012bf70b1056b4743fa101bc4905296e806abfa9018c7dd999b7a3523fb101509797a88859463fb9013bcc152f64ba0c3fc1014ee58678281567bfc9019a9999999999e93fd101d6b399999999e93fd901df9005ffbb295a40e901aaf3698b282c8c3df00101');
INSERT INTO contactd.events VALUES (3, 9, 13, 0, 195, 491052260, '\x120c08facb94d8061089afe6e2026ab2010a0542322d4233100118022001280130033801499bd51c58c2e7583f51971df5a15f1a653f61cd074affc4ef143f798e7ee1a31435bbbf810120f550afd933bb418901547b89605c411240990181d92daf1153693fa1014f87e05e68d158bfa9010801d6ff74944a3fb1015e5620ff0015493fb9018cf52daf1153693fc101a02883ded7f71abfc901666666666666e63fd101249466666666e63fd9018bdc5a76e5d95340e9018faa1757b0b7713df00101');
INSERT INTO contactd.events VALUES (3, 10, 20, 0, 102, 2742665722, '\x120c08facb94d80610ccb7e6e202a201550a0542312d4232100118012001280139334d394af1a6613f400149c934d71f13efaa41512bf70b1056b4743f59bc4905296e806abf619a9999999999e93f69d6b399999999e93f700178018101aaf3698b282c8c3d');
INSERT INTO contactd.events VALUES (3, 11, 20, 0, 102, 1917711485, '\x120c08facb94d80610dbcbe6e202a201550a0542322d4233100118012001280139971df5a15f1a653f40014920f550afd933bb415181d92daf1153693f594f87e05e68d158bf61666666666666e63f69249466666666e63f7001780181018faa1757b0b7713d');
INSERT INTO contactd.events VALUES (3, 12, 10, 0, 20, 1600387403, '\x120c08facb94d80610ae92ece202520408032001');
INSERT INTO contactd.events VALUES (4, 1, 10, 0, 38, 1525695242, '\x120c08facb94d80610dc86b4f40252160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.events VALUES (4, 2, 10, 0, 18, 1286787827, '\x120c08facb94d80610bcdeb2f80252020802');
INSERT INTO contactd.events VALUES (4, 3, 14, 0, 18, 2274272246, '\x120c08facb94d8061095aab6f80272020801');
INSERT INTO contactd.events VALUES (4, 4, 19, 0, 41, 758614906, '\x120c08facb94d80610979abaf9029a01181208333333333333e33f180330013a080000000000001040');
INSERT INTO contactd.events VALUES (4, 5, 19, 0, 43, 200519244, '\x120c08facb94d80610b482c7f9029a011a080112089a9999999999e93f180330013a080000000000000840');
INSERT INTO contactd.events VALUES (4, 6, 10, 0, 20, 4286273902, '\x120c08facb94d80610cdc2caf902520408032001');
INSERT INTO contactd.events VALUES (5, 2, 10, 0, 18, 1995500897, '\x120c08facb94d80610dbb2b0910352020802');
INSERT INTO contactd.events VALUES (5, 3, 14, 0, 18, 3769837015, '\x120c08facb94d80610c1dab9910372020801');
INSERT INTO contactd.events VALUES (5, 4, 12, 0, 80, 2144772248, '\x120c08facb94d806108dd4f695036240080119850c07be26b64f3f22310a0962616c6c2d77616c6c100119fc5719a9c31e0b4121000000000000f87f29cdccccccccccec3f31000000000000f87f2801');
INSERT INTO contactd.events VALUES (5, 5, 12, 0, 29, 2232272929, '\x120c08facb94d80610a5b5989703620d080219f69aca19cc68563f2801');
INSERT INTO contactd.events VALUES (5, 1, 10, 0, 38, 2028015441, '\x120c08facb94d80610b8e2ba8d0352160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.events VALUES (6, 1, 10, 0, 38, 2911092894, '\x120c08facb94d806108cbee6a10352160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.events VALUES (7, 1, 10, 0, 38, 4271859165, '\x120c08facb94d80610d88fd9a50352160801121257414954494e475f464f525f574f524b4552');
INSERT INTO contactd.jobs OVERRIDING SYSTEM VALUE VALUES (1, 'jobs/jd7ns17d48', '7ff8a78f-597a-4a74-b116-12e991e87f48', 'local/once', 3, 2, false, 13, 1795499514, 3383, 3676985233, '\x0a0f6a6f62732f6a64376e733137643438220d0a057374756479120464656d6f2803421909fca9f1d24d62703f11fca9f1d24d62703f18840120022803480150015801620c08facb94d80610cf8beea0026a0c08facb94d80610dcd6b1ba02720c08facb94d80610f2c1debd02780192014208840110820d1803200129a752fd9474de403f31aaf3698b282c8c3d397e447677d547b33c41feffffff27d36d3d4991e5f3d3740c7b3f51fca9f1d24d62703f68029a017a6f75747075742e73616d706c655f696e74657276616c5f733a206769766573206120636f6e74616374206f662042312d423220342e30322073616d706c65733b206974206c617374732061626f757420302e30303136207320617420302e32206d2f7320e280942038652d303620676976657320697420323030a20105302e312e30ca014064363539336338323861353535666238633231626139616132356462626232386639623232343062303864353763376363613137346165326361376337343630d2010d393834376130382d6469727479e2012437666638613738662d353937612d346137342d623131362d313265393931653837663438fa0111547269706c652d62616c6c20636861696e8202056c6f63616c8a02056c6f63616c', 1, false, 'local', 'local', 8795884229973373583, 2, 0, 0, NULL, '729');
INSERT INTO contactd.jobs OVERRIDING SYSTEM VALUE VALUES (4, 'jobs/z90g9kknd3', '7b87e0d8-9fb1-49b6-a819-d466505b53db', NULL, 3, 2, false, 6, 1795499514, 453, 2432875816, '\x0a0f6a6f62732f7a393067396b6b6e64332803420430023802480150015801620c08facb94d80610dc86b4f4026a0c08facb94d80610bcdeb2f802720c08facb94d80610cdc2caf9027801a20105302e312e30ca014061313361376262613033333363333339386332626566343530306632333738363531666561366563623864373438373837303631613861313336343331363835d2010d393834376130382d6469727479e2012437623837653064382d396662312d343962362d613831392d643436363530356235336462fa0111547269706c652d62616c6c20636861696e8202056c6f63616c8a02056c6f63616c', 1, false, 'local', 'local', 8795884229973373589, 4, 0, 2, NULL, '745');
INSERT INTO contactd.jobs OVERRIDING SYSTEM VALUE VALUES (2, 'jobs/7sfgtdd1c9', 'fc04c42a-5167-4e83-a6f6-3eb386ba9a34', NULL, 3, 2, false, 13, 1795499514, 2610, 1787092534, '\x0a0f6a6f62732f377366677464643163392803421909fca9f1d24d62703f11fca9f1d24d62703f18840120022803480150015801620c08facb94d8061094f0efc5026a0c08facb94d80610c086f3ca02720c08facb94d80610f7e891cb02780192014208840110f30c1803200129bf3bba9095ff333f31aaf3698b282c8c3d397e447677d547b33c41feffffff27d36d3d4991e5f3d3740c7b3f51fca9f1d24d62703f68029a017b6f75747075742e73616d706c655f696e74657276616c5f733a206769766573206120636f6e74616374206f662042312d423220302e3830352073616d706c65733b206974206c617374732061626f757420302e30303136207320617420302e32206d2f7320e280942038652d303620676976657320697420323030a20105302e312e30ca014032386137623864373633333635376162623134386162623232363432386233306264303038333235316237643864396535646636653532633835376433623564d2010d393834376130382d6469727479e2012466633034633432612d353136372d346538332d613666362d336562333836626139613334fa0109436f6d7061637465648202056c6f63616c8a02056c6f63616c', 13, true, 'local', 'local', 8795884229973373585, 2, 0, 0, NULL, '734');
INSERT INTO contactd.jobs OVERRIDING SYSTEM VALUE VALUES (7, 'jobs/xym2w10nq2', 'a32fee36-f885-4db2-abed-3e7c75f42900', NULL, 1, 0, true, 1, 0, 268, 2017882640, '\x0a0f6a6f62732f78796d327731306e7132220d0a057374756479120464656d6f2801321257414954494e475f464f525f574f524b4552620c08facb94d80610d88fd9a503e2012461333266656533362d663838352d346462322d616265642d336537633735663432393030fa0111547269706c652d62616c6c20636861696e8202056c6f63616c8a02056c6f63616c', 1, false, 'local', 'local', NULL, NULL, 0, 0, NULL, '753');
INSERT INTO contactd.jobs OVERRIDING SYSTEM VALUE VALUES (5, 'jobs/j4bwfxfb7c', '91e6b280-614a-4022-9cec-e79be5679d4e', NULL, 2, 2, false, 5, 0, 384, 2300778315, '\x0a0f6a6f62732f6a3462776678666237632802480150015801620c08facb94d80610b8e2ba8d036a0c08facb94d80610dbb2b09103e2012439316536623238302d363134612d343032322d396365632d6537396265353637396434658202056c6f63616c8a02056c6f63616c', 1, false, 'local', 'local', 8795884229973373591, 4, 0, 0, 'worker-one', '750');
INSERT INTO contactd.jobs OVERRIDING SYSTEM VALUE VALUES (6, 'jobs/fnv9k6ypd1', '0a9c2e32-6359-4766-a65d-b4cfce413491', NULL, 1, 1, false, 1, 0, 329, 3332574496, '\x0a0f6a6f62732f666e76396b36797064312801321257414954494e475f464f525f574f524b455242023004620c08facb94d806108cbee6a103e2012430613963326533322d363335392d343736362d613635642d623463666365343133343931fa0111547269706c652d62616c6c20636861696e8202056c6f63616c8a02056c6f63616c', 1, false, 'local', 'local', NULL, NULL, 0, 4, 'worker-one', '752');
INSERT INTO contactd.labels VALUES ('study', 'demo', 1);
INSERT INTO contactd.labels VALUES ('study', 'demo', 7);
INSERT INTO contactd.loans VALUES (6, 1, 1, 0, 1, 'worker-two', false, 0, 0, 0);
INSERT INTO contactd.loans VALUES (6, 1, 2, 2, 3, NULL, false, 0, 0, 0);
INSERT INTO contactd.removed VALUES (3);
INSERT INTO contactd.results VALUES (1, 363007987, '\x8201c5010a0542312d423210011801200128013003380149871c7c87402b493f51334d394af1a6613f61780bdd36ecfe193f719a9999999999c93f792eda2b8fc295adbf8101c934d71f13efaa41890163d17bd0341302409101054ff9b387ebdc3f99012bf70b1056b4743fa101bc4905296e806abfa9018c7dd999b7a3523fb101509797a88859463fb9013bcc152f64ba0c3fc1014ee58678281567bfc9019a9999999999e93fd101d6b399999999e93fd901df9005ffbb295a40e901aaf3698b282c8c3df001018201b2010a0542322d4233100118022001280130033801499bd51c58c2e7583f51971df5a15f1a653f61cd074affc4ef143f798e7ee1a31435bbbf810120f550afd933bb418901547b89605c411240990181d92daf1153693fa1014f87e05e68d158bfa9010801d6ff74944a3fb1015e5620ff0015493fb9018cf52daf1153693fc101a02883ded7f71abfc901666666666666e63fd101249466666666e63fd9018bdc5a76e5d95340e9018faa1757b0b7713df001018a01160a02423111191b33bdbcd3233f19acb52327e8906ebf8a01160a02423211ebfb460fe6a9b93f1951d28ad0a5f2a83f8a01160a02423311eeb77e52b5a6c93f19db7313c633d7c33ff201550a0542312d4232100118012001280139334d394af1a6613f400149c934d71f13efaa41512bf70b1056b4743f59bc4905296e806abf619a9999999999e93f69d6b399999999e93f700178018101aaf3698b282c8c3df201550a0542322d4233100118012001280139971df5a15f1a653f40014920f550afd933bb415181d92daf1153693f594f87e05e68d158bf61666666666666e63f69249466666666e63f7001780181018faa1757b0b7713d');
INSERT INTO contactd.results VALUES (2, 363007987, '\x8201c5010a0542312d423210011801200128013003380149871c7c87402b493f51334d394af1a6613f61780bdd36ecfe193f719a9999999999c93f792eda2b8fc295adbf8101c934d71f13efaa41890163d17bd0341302409101054ff9b387ebdc3f99012bf70b1056b4743fa101bc4905296e806abfa9018c7dd999b7a3523fb101509797a88859463fb9013bcc152f64ba0c3fc1014ee58678281567bfc9019a9999999999e93fd101d6b399999999e93fd901df9005ffbb295a40e901aaf3698b282c8c3df001018201b2010a0542322d4233100118022001280130033801499bd51c58c2e7583f51971df5a15f1a653f61cd074affc4ef143f798e7ee1a31435bbbf810120f550afd933bb418901547b89605c411240990181d92daf1153693fa1014f87e05e68d158bfa9010801d6ff74944a3fb1015e5620ff0015493fb9018cf52daf1153693fc101a02883ded7f71abfc901666666666666e63fd101249466666666e63fd9018bdc5a76e5d95340e9018faa1757b0b7713df001018a01160a02423111191b33bdbcd3233f19acb52327e8906ebf8a01160a02423211ebfb460fe6a9b93f1951d28ad0a5f2a83f8a01160a02423311eeb77e52b5a6c93f19db7313c633d7c33ff201550a0542312d4232100118012001280139334d394af1a6613f400149c934d71f13efaa41512bf70b1056b4743f59bc4905296e806abf619a9999999999e93f69d6b399999999e93f700178018101aaf3698b282c8c3df201550a0542322d4233100118012001280139971df5a15f1a653f40014920f550afd933bb415181d92daf1153693f594f87e05e68d158bf61666666666666e63f69249466666666e63f7001780181018faa1757b0b7713d');
INSERT INTO contactd.specs VALUES (1, 365461284, '\x12db010a11547269706c652d62616c6c20636861696e121f0a02423111000000000000e03f199a9999999999a93f319a9999999999c93f121f0a02423211000000000000e03f199a9999999999a93f299a9999999999b93f121f0a02423311000000000000e03f199a9999999999a93f299a9999999999c93f1a210a0542312d42321202423112024232210000000084d79741319a9999999999e93f1a210a0542322d42331202423212024233210000000084d7974131666666666666e63f3209213a8c30e28e79453e3a09092d431cebe2363a3f41fca9f1d24d62703f220d0a057374756479120464656d6f');
INSERT INTO contactd.specs VALUES (2, 2550345797, '\x12d3010a09436f6d706163746564121f0a02423111000000000000e03f199a9999999999a93f319a9999999999c93f121f0a02423211000000000000e03f199a9999999999a93f299a9999999999b93f121f0a02423311000000000000e03f199a9999999999a93f299a9999999999c93f1a210a0542312d42321202423112024232210000000084d79741319a9999999999e93f1a210a0542322d42331202423212024233210000000084d7974131666666666666e63f3209213a8c30e28e79453e3a0909fca9f1d24d62603f41fca9f1d24d62703f');
INSERT INTO contactd.specs VALUES (4, 4148746534, '\x1a90020ad4010a11547269706c652d62616c6c20636861696e121f0a02423111000000000000e03f199a9999999999a93f319a9999999999c93f121f0a02423211000000000000e03f199a9999999999a93f299a9999999999b93f121f0a02423311000000000000e03f199a9999999999a93f299a9999999999c93f1a210a0542312d42321202423112024232210000000084d79741319a9999999999e93f1a210a0542322d42331202423212024233210000000084d7974131666666666666e63f3209213a8c30e28e79453e3a02100141fca9f1d24d62703f122b0a17636f6e74616374735b305d2e7265737469747574696f6e1210333333333333e33f9a9999999999e93f320a697465726174696f6e73');
INSERT INTO contactd.specs VALUES (5, 4211762048, '\x12c60112210a0462616c6c11000000000000e03f199a9999999999a93f297b14ae47e17a84bf1a300a0962616c6c2d77616c6c120462616c6c1a0b09fa7e6abc7493a83f10022100000000882a714131cdccccccccccec3f22180a0462616c6c190000000080842e412100000000000059402a110a0462616c6c1209090000000000407f402a1a0a0462616c6c1a12090000000000406f40110000000000409f40321208021148afbc9af2d77a3e5880a094a58d1d3a09099a9999999999b93f4100000000006af840');
INSERT INTO contactd.specs VALUES (6, 1386987442, '\x1aa0020ad4010a11547269706c652d62616c6c20636861696e121f0a02423111000000000000e03f199a9999999999a93f319a9999999999c93f121f0a02423211000000000000e03f199a9999999999a93f299a9999999999b93f121f0a02423311000000000000e03f199a9999999999a93f299a9999999999c93f1a210a0542312d42321202423112024232210000000084d79741319a9999999999e93f1a210a0542322d42331202423212024233210000000084d7974131666666666666e63f3209213a8c30e28e79453e3a02100141fca9f1d24d62703f123b0a17636f6e74616374735b305d2e7265737469747574696f6e1220000000000000e03f333333333333e33f666666666666e63f9a9999999999e93f320a697465726174696f6e73');
INSERT INTO contactd.specs VALUES (7, 1742406479, '\x12d4010a11547269706c652d62616c6c20636861696e121f0a02423111000000000000e03f199a9999999999a93f319a9999999999c93f121f0a02423211000000000000e03f199a9999999999a93f299a9999999999b93f121f0a02423311000000000000e03f199a9999999999a93f299a9999999999c93f1a210a0542312d42321202423112024232210000000084d79741319a9999999999e93f1a210a0542322d42331202423212024233210000000084d7974131666666666666e63f3209213a8c30e28e79453e3a02100141fca9f1d24d62703f220d0a057374756479120464656d6f');
INSERT INTO contactd.used VALUES ('worker-one', 'local', 'local', 1.5, '2026-11-24 05:59:00+00');
INSERT INTO contactd.version VALUES (2);
INSERT INTO contactd.workers VALUES ('worker-one', 'one.example', 1, '', '2026-11-01 06:00:00+00');
INSERT INTO contactd.workers VALUES ('worker-two', 'two.example', 2, '4711', '2026-11-01 06:00:00+00');
SELECT pg_catalog.setval('contactd.jobs_number_seq', 7, true);
ALTER TABLE ONLY contactd.checkpoints
    ADD CONSTRAINT checkpoints_pkey PRIMARY KEY (job);
ALTER TABLE ONLY contactd.compacting
    ADD CONSTRAINT compacting_pkey PRIMARY KEY (job);
ALTER TABLE ONLY contactd.events
    ADD CONSTRAINT events_pkey PRIMARY KEY (job, sequence);
ALTER TABLE ONLY contactd.jobs
    ADD CONSTRAINT jobs_name_key UNIQUE (name);
ALTER TABLE ONLY contactd.jobs
    ADD CONSTRAINT jobs_pkey PRIMARY KEY (number);
ALTER TABLE ONLY contactd.jobs
    ADD CONSTRAINT jobs_request_id_key UNIQUE (request_id);
ALTER TABLE ONLY contactd.labels
    ADD CONSTRAINT labels_pkey PRIMARY KEY (key, value, job);
ALTER TABLE ONLY contactd.loans
    ADD CONSTRAINT loans_pkey PRIMARY KEY (job, epoch, loan);
ALTER TABLE ONLY contactd.removed
    ADD CONSTRAINT removed_pkey PRIMARY KEY (job);
ALTER TABLE ONLY contactd.results
    ADD CONSTRAINT results_pkey PRIMARY KEY (job);
ALTER TABLE ONLY contactd.specs
    ADD CONSTRAINT specs_pkey PRIMARY KEY (job);
ALTER TABLE ONLY contactd.used
    ADD CONSTRAINT used_pkey PRIMARY KEY (worker, tenant, owner);
ALTER TABLE ONLY contactd.workers
    ADD CONSTRAINT workers_pkey PRIMARY KEY (name);
CREATE INDEX jobs_by_owner ON contactd.jobs USING btree (tenant, owner);
CREATE INDEX jobs_by_tenant ON contactd.jobs USING btree (tenant, number);
CREATE INDEX jobs_moved ON contactd.jobs USING btree (moved);
CREATE INDEX jobs_of_owner_unfinished ON contactd.jobs USING btree (tenant, owner) WHERE (state <> ALL (ARRAY[3, 4, 5]));
CREATE INDEX jobs_taken ON contactd.jobs USING btree (worker, number) WHERE ((state = 2) OR ((state = 1) AND (worker IS NOT NULL)));
CREATE INDEX jobs_waiting ON contactd.jobs USING btree (tenant, owner, priority DESC, number) WHERE ((state = 1) AND (worker IS NULL));
CREATE INDEX labels_by_job ON contactd.labels USING btree (job);
CREATE INDEX loans_open ON contactd.loans USING btree (job, loan) WHERE (worker IS NULL);
ALTER TABLE ONLY contactd.checkpoints
    ADD CONSTRAINT checkpoints_job_fkey FOREIGN KEY (job) REFERENCES contactd.jobs(number) ON DELETE CASCADE;
ALTER TABLE ONLY contactd.compacting
    ADD CONSTRAINT compacting_job_fkey FOREIGN KEY (job) REFERENCES contactd.jobs(number) ON DELETE CASCADE;
ALTER TABLE ONLY contactd.labels
    ADD CONSTRAINT labels_job_fkey FOREIGN KEY (job) REFERENCES contactd.jobs(number) ON DELETE CASCADE;
ALTER TABLE ONLY contactd.loans
    ADD CONSTRAINT loans_job_fkey FOREIGN KEY (job) REFERENCES contactd.jobs(number) ON DELETE CASCADE;
ALTER TABLE ONLY contactd.results
    ADD CONSTRAINT results_job_fkey FOREIGN KEY (job) REFERENCES contactd.jobs(number) ON DELETE CASCADE;
ALTER TABLE ONLY contactd.specs
    ADD CONSTRAINT specs_job_fkey FOREIGN KEY (job) REFERENCES contactd.jobs(number) ON DELETE CASCADE;
REVOKE ALL ON FUNCTION contactd.append(a_job bigint, a_last bigint, a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[]) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.beat(a_worker text, a_host text, a_threads bigint, a_batch_id text, a_lease bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.bytes_of(a_tenant text, a_owner text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.change_job(a_name text, a_epoch bigint, a_change bigint, a_take boolean, a_state bigint, a_end_time bigint, a_crc32 bigint, a_header bytea, a_result_crc32 bigint, a_result bytea, a_checkpoint_events bigint, a_checkpoint_crc32 bigint, a_checkpoint bytea, a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint, OUT outcome text, OUT first bigint, OUT job_tenant text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.claim(a_worker text, a_most bigint, a_most_running bigint, a_grace bigint, a_tenants text[], a_owners text[], a_milliseconds bigint[], a_not_tenants text[], a_not_owners text[], a_spec_bytes bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.compact_job(a_name text, a_kind bigint, OUT outcome text, OUT job_owner text, OUT job_tenant text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.count_of(a_tenant text, a_owner text, OUT jobs bigint, OUT cells bigint, OUT running bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.create_job(a_name text, a_uid text, a_request_id text, a_owner text, a_tenant text, a_state bigint, a_end_time bigint, a_crc32 bigint, a_header bytea, a_spec_crc32 bigint, a_spec bytea, a_label_keys text[], a_label_values text[], a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint, a_may_create boolean, a_max_owner_bytes bigint, a_priority bigint, a_cells bigint, a_max_waiting bigint, a_max_owner_jobs bigint, a_max_owner_cells bigint, OUT outcome text, OUT existing text, OUT has bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.demand(OUT queued bigint, OUT running bigint, OUT workers bigint, OUT threads bigint, OUT cells bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.exceeded(a_tenant text, a_owner text, a_cells bigint, a_max_owner_bytes bigint, a_max_waiting bigint, a_max_owner_jobs bigint, a_max_owner_cells bigint, OUT outcome text, OUT has bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.job_sizes() FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.leave(a_worker text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.lend(a_worker text, a_name text, a_loans bigint[], a_firsts bigint[], a_lasts bigint[]) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.list_jobs(a_before bigint, a_tenant text, a_states bigint[], a_keys text[], a_values text[], a_prefix text, a_limit bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.moved_since(a_since bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.owner_of(a_tenant text, a_name text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.positions_of(a_names text[]) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.purge(a_kind bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.read_events(a_name text, a_after bigint, a_kinds bigint, a_bytes bigint, a_scanned bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.read_job(a_name text, a_tenant text, a_spec boolean, a_checkpoint boolean, a_result boolean) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.refuse_loan(a_worker text, a_name text, a_epoch bigint, a_loan bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.remove_job(a_name text, a_uid text, OUT outcome text, OUT job_owner text, OUT job_tenant text, OUT job_uid text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.request_cancel(a_name text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.return_loan(a_worker text, a_name text, a_epoch bigint, a_loan bigint, a_failed bigint, a_not_converged bigint, a_steps bigint, a_kinds bigint[], a_codings bigint[], a_sizes bigint[], a_crc32s bigint[], a_payloads bytea[], a_event_bytes bigint, OUT outcome text, OUT first bigint, OUT job_tenant text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.schema_version() FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.settle_loans(a_worker text, a_name text, a_loans bigint[], a_back boolean) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.shares(a_most bigint, a_most_running bigint, a_not_tenants text[], a_not_owners text[]) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.stored_of(a_tenant text, a_owner text, a_most bigint) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.take_loan(a_worker text) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.waiting(a_most bigint, a_now boolean) FROM PUBLIC;
REVOKE ALL ON FUNCTION contactd.waiting_owners() FROM PUBLIC;
