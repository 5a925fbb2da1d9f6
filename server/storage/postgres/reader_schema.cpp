#include "storage/postgres/schema.h"

namespace contact::postgres {

const char kReaderFunctions[] = R"sql(
-- Version of the tables, which a role without rights to them asks for, too.
CREATE OR REPLACE FUNCTION contactd.schema_version() RETURNS integer LANGUAGE sql STABLE AS $$
  SELECT v.version FROM contactd.version v
$$;

-- NULL: the tenant has no such job.
CREATE OR REPLACE FUNCTION contactd.owner_of(a_tenant text, a_name text) RETURNS text
LANGUAGE plpgsql STABLE AS $$
BEGIN
  RETURN (SELECT j.owner FROM contactd.jobs j WHERE j.name = a_name AND j.tenant = a_tenant);
END $$;

-- Of all jobs of the owner.
CREATE OR REPLACE FUNCTION contactd.bytes_of(a_tenant text, a_owner text) RETURNS bigint
LANGUAGE plpgsql STABLE AS $$
BEGIN
  RETURN (SELECT coalesce(sum(j.bytes), 0) FROM contactd.jobs j
    WHERE j.tenant = a_tenant AND j.owner = a_owner);
END $$;

-- The newest jobs with a number below a_before. a_tenant: NULL for any; no a_states: any; a_keys
-- and a_values: labels that a job must have.
CREATE OR REPLACE FUNCTION contactd.list_jobs(
  a_before bigint, a_tenant text, a_states bigint[], a_keys text[], a_values text[],
  a_prefix text, a_limit bigint)
RETURNS SETOF contactd.jobs LANGUAGE plpgsql STABLE AS $$
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
END $$;

-- The ended jobs, the oldest end first.
CREATE OR REPLACE FUNCTION contactd.job_sizes()
RETURNS TABLE(name text, end_time bigint, bytes bigint) LANGUAGE sql STABLE AS $$
  SELECT j.name, j.end_time, j.bytes FROM contactd.jobs j WHERE j.state IN (3,4,5)
  ORDER BY j.end_time, j.number
$$;

-- How far the logs of these jobs are.
CREATE OR REPLACE FUNCTION contactd.positions_of(a_names text[])
RETURNS TABLE(name text, last_sequence bigint, ended boolean) LANGUAGE plpgsql STABLE AS $$
BEGIN
  RETURN QUERY SELECT j.name, j.last_sequence, j.state IN (3,4,5) FROM contactd.jobs j
    WHERE j.name = ANY(a_names);
END $$;
)sql";

}  // namespace contact::postgres
