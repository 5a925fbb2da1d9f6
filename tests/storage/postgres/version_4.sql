-- Version 4 has the tables of version 3, and these functions.
SET check_function_bodies = false;
CREATE OR REPLACE FUNCTION contactd.claim(
  a_worker text, a_most bigint, a_most_running bigint, a_grace bigint, a_tenants text[],
  a_owners text[], a_milliseconds bigint[], a_not_tenants text[], a_not_owners text[],
  a_spec_bytes bigint)
RETURNS TABLE(
  number bigint, name text, state smallint, epoch bigint, cancel_requested boolean,
  last_sequence bigint, crc32 bigint, header bytea, oldest_sequence bigint, compacted boolean,
  owner text, tenant text, request_id text, spec_crc32 bigint, spec bytea, checkpoint_crc32 bigint,
  checkpoint bytea, checkpoint_sequence bigint)
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
      j.crc32, j.header, j.oldest_sequence, j.compacted, j.owner, j.tenant, j.request_id, s.crc32,
      s.spec, c.crc32, c.state, c.sequence
    FROM contactd.jobs j
      LEFT JOIN contactd.specs s
        ON s.job = j.number AND j.state = 1 AND octet_length(s.spec) <= a_spec_bytes
      LEFT JOIN contactd.checkpoints c ON c.job = j.number
    WHERE j.number = ANY(v_taken) ORDER BY j.priority DESC, j.number;
END $$;
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
UPDATE contactd.version SET version = 4;
