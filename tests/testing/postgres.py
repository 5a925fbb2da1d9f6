"""A PostgreSQL server of its own for tests, in a new folder of /tmp, reached by a socket file only.

As a program: `postgres.py start FILE [SETTING=VALUE]` starts one and writes its folder to FILE,
`postgres.py stop FILE` ends it. It ends itself after an hour."""

import os
import pathlib
import pwd
import shutil
import signal
import subprocess
import sys
import tempfile
import time

BINARIES = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin"))[-1:]
LONGEST_S = 3600


def _as_server(command):
    """PostgreSQL refuses to run as root: then it runs as the user `postgres` of its package."""
    if os.geteuid() != 0:
        return command
    return ["setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups", *command]


class Cluster:
    """A server with its databases. `settings`: as of postgresql.conf."""

    def __init__(self, **settings):
        if not BINARIES:
            raise RuntimeError("PostgreSQL is missing; `deploy/setup tests` installs it")
        self.bin = BINARIES[0]
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contact-pg-", dir="/tmp"))
        self.data = self.folder / "data"
        # Tests kill the server, and never the machine: what the kernel has is as good as on disk.
        self.settings = {"fsync": "off", "listen_addresses": "", "shared_buffers": "64MB",
                         "unix_socket_directories": str(self.folder), "max_connections": "200",
                         **settings}
        self.process = None
        if os.geteuid() == 0:
            user = pwd.getpwnam("postgres")
            os.chown(self.folder, user.pw_uid, user.pw_gid)
        self.make_data()
        self.start()

    def make_data(self):
        """A new one without databases of ours, or what a derived class makes."""
        self.call("initdb", "-D", self.data, "-A", "trust", "-U", "contactd", "-k", "-E", "UTF8",
                  "--no-sync", "--locale=C")

    def call(self, program, *arguments):
        """Runs a program of PostgreSQL as the server's user."""
        subprocess.run(_as_server([self.bin / program, *arguments]), check=True, cwd=self.folder,
                       stdout=subprocess.DEVNULL)

    def start(self):
        """Starts the server, and waits until it answers. One that was killed leaves processes, which end
        soon; until then it cannot start anew."""
        for _ in range(50):
            if self._try_start():
                return
            time.sleep(0.1)
        raise RuntimeError("PostgreSQL does not start: " + (self.folder / "log").read_text()[-2000:])

    def _try_start(self):
        options = [word for name, value in self.settings.items() for word in ("-c", f"{name}={value}")]
        with (self.folder / "log").open("ab") as log:
            self.process = subprocess.Popen(
                ["timeout", str(LONGEST_S),
                 *_as_server([self.bin / "postgres", "-D", self.data, *options])],
                stdout=log, stderr=log, cwd=self.folder, start_new_session=True)
        for _ in range(600):
            if subprocess.run([self.bin / "pg_isready", "-q", "-h", self.folder], check=False).returncode == 0:
                return True
            if self.process.poll() is not None:
                break
            time.sleep(0.05)
        return False

    @property
    def pid(self):
        """Of the postmaster."""
        return int((self.data / "postmaster.pid").read_text().split("\n", 1)[0])

    def kill(self, number=signal.SIGKILL):
        """Ends the postmaster, at once unless told otherwise, and waits for that."""
        os.kill(self.pid, number)
        self.process.wait()

    def address(self, database="postgres"):
        return f"postgresql://contactd@/{database}?host={self.folder}"

    def create(self, database):
        """A new database; returns its address."""
        self.run(f"CREATE DATABASE {database}")
        return self.address(database)

    def run(self, sql, database="postgres"):
        """What psql prints of the statement, without decoration."""
        return subprocess.run([self.bin / "psql", "-XAtq", "-v", "ON_ERROR_STOP=1", "-c", sql,
                               self.address(database)], check=True, capture_output=True,
                              text=True).stdout.strip()

    def stop(self):
        if self.process.poll() is None:
            self.kill(signal.SIGINT)
        shutil.rmtree(self.folder)


def main():
    verb, file = sys.argv[1], pathlib.Path(sys.argv[2])
    if verb == "start":
        cluster = Cluster(**dict(setting.split("=", 1) for setting in sys.argv[3:]))
        file.write_text(f"{cluster.folder} {cluster.pid}\n")
    elif file.exists():
        folder, pid = file.read_text().split()
        os.kill(int(pid), signal.SIGINT)
        for _ in range(200):
            if not (pathlib.Path(folder) / "data/postmaster.pid").exists():
                break
            time.sleep(0.05)
        shutil.rmtree(folder, ignore_errors=True)
        file.unlink()


if __name__ == "__main__":
    main()
