-- Version 3 has the tables of version 2, and these functions.
SET check_function_bodies = false;
CREATE OR REPLACE FUNCTION contactd.left_of(a_seconds double precision, a_at timestamp with time zone) RETURNS double precision
    LANGUAGE sql STABLE
    AS $$
  SELECT a_seconds * power(0.5::double precision,
    least(greatest(extract(epoch FROM statement_timestamp() - a_at) / 60, 0), 64)::double precision);
$$;
CREATE OR REPLACE FUNCTION contactd.beat(a_worker text, a_host text, a_threads bigint, a_batch_id text, a_lease bigint) RETURNS TABLE(name text, epoch bigint, cancel_requested boolean)
    LANGUAGE plpgsql
    AS $$
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
CREATE OR REPLACE FUNCTION contactd.claim(a_worker text, a_most bigint, a_most_running bigint, a_grace bigint, a_tenants text[], a_owners text[], a_milliseconds bigint[], a_not_tenants text[], a_not_owners text[], a_spec_bytes bigint) RETURNS TABLE(number bigint, name text, state smallint, epoch bigint, cancel_requested boolean, last_sequence bigint, crc32 bigint, header bytea, oldest_sequence bigint, compacted boolean, owner text, tenant text, request_id text, spec_crc32 bigint, spec bytea, checkpoint_crc32 bigint, checkpoint bytea, checkpoint_sequence bigint)
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
      j.crc32, j.header, j.oldest_sequence, j.compacted, j.owner, j.tenant, j.request_id, s.crc32,
      s.spec, c.crc32, c.state, c.sequence
    FROM contactd.jobs j
      LEFT JOIN contactd.specs s
        ON s.job = j.number AND j.state = 1 AND octet_length(s.spec) <= a_spec_bytes
      LEFT JOIN contactd.checkpoints c ON c.job = j.number
    WHERE j.number = ANY(v_taken) ORDER BY j.priority DESC, j.number;
END $$;
CREATE OR REPLACE FUNCTION contactd.shares(a_most bigint, a_most_running bigint, a_not_tenants text[], a_not_owners text[]) RETURNS TABLE(tenant text, owner text, jobs bigint)
    LANGUAGE plpgsql
    AS $$
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
REVOKE ALL ON FUNCTION contactd.left_of(a_seconds double precision, a_at timestamp with time zone) FROM PUBLIC;
UPDATE contactd.version SET version = 3;
