-- Version 5 has the tables and functions of version 4, and these.
CREATE TABLE contactd.kept(name text COLLATE "C" PRIMARY KEY, value bytea NOT NULL);
CREATE FUNCTION contactd.keep(a_name text, a_value bytea, a_replace boolean)
RETURNS bytea LANGUAGE plpgsql AS $$
BEGIN
  INSERT INTO contactd.kept AS k(name, value) VALUES(a_name, a_value)
    ON CONFLICT (name) DO UPDATE SET value = excluded.value WHERE a_replace;
  RETURN (SELECT k.value FROM contactd.kept k WHERE k.name = a_name);
END $$;
UPDATE contactd.version SET version = 5;
