"""A whole Slurm of its own for tests: munge, a controller and two nodes with two cores each, on
free ports of this machine, in a new folder of /tmp. It ends itself after an hour.

Anybody may run it; then all its jobs are that one's."""

import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "srun", "squeue", "scancel", "sinfo")
PATH = f"{os.environ['PATH']}:/usr/sbin:/sbin"
MISSING = [name for name in PROGRAMS if not shutil.which(name, path=PATH)]
LONGEST_S = 3600
PATIENCE_S = 60

SETTINGS = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/ctld.pid
SlurmdPidFile={folder}/d-%n.pid
SlurmctldLogFile={folder}/ctld.log
SlurmdLogFile={folder}/d-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
KillWait=5
SlurmdParameters=config_overrides
NodeName=w1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=2 State=UNKNOWN
NodeName=w2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=2 State=UNKNOWN
PartitionName=all Nodes=w[1-2] Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    """Ports that nobody has; the system gives none of them to others soon."""
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [listener.getsockname()[1] for listener in sockets]
    for listener in sockets:
        listener.close()
    return ports


class Slurm:
    """A running Slurm. `environment` leads its commands to it."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="contact-slurm-", dir="/tmp"))
        self.environment = {**os.environ, "PATH": PATH,
                            "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.processes = []
        try:
            self._start()
        except BaseException:
            self.stop()
            raise

    def _start(self):
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(SETTINGS.format(
            host=socket.gethostname().split(".")[0], ports=free_ports(3), folder=self.folder,
            user=getpass.getuser()))
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self._spawn("munged", "--foreground", "--force", f"--key-file={key}",
                    f"--pid-file={self.folder}/munge.pid", f"--log-file={self.folder}/munge.log",
                    f"--seed-file={self.folder}/munge.seed",
                    f"--socket={self.folder}/munge.socket")
        self._await(lambda: (self.folder / "munge.socket").exists(), "munged does not answer")
        self._spawn("slurmctld", "-D")
        for node in ("w1", "w2"):
            self._spawn("slurmd", "-D", "-N", node)
        self._await(lambda: self.run("sinfo", "-hNo%T", check=False).split() == ["idle"] * 2,
                    "the nodes do not answer")

    def _spawn(self, *command):
        with (self.folder / "out").open("ab") as out:
            self.processes.append(subprocess.Popen(
                ["timeout", str(LONGEST_S), *command], stdin=subprocess.DEVNULL, stdout=out,
                stderr=out, env=self.environment, start_new_session=True))

    def _await(self, done, why):
        deadline = time.monotonic() + PATIENCE_S
        while not done():
            if time.monotonic() > deadline or any(p.poll() is not None for p in self.processes):
                logs = [*self.folder.glob("*.log"), self.folder / "out"]
                raise RuntimeError(why + "\n" + "\n".join(log.read_text()[-2000:] for log in logs))
            time.sleep(0.05)

    def run(self, *command, check=True):
        """What a command of Slurm prints."""
        return subprocess.run(command, env=self.environment, check=check, capture_output=True,
                              text=True, timeout=PATIENCE_S, cwd=self.folder).stdout

    def jobs(self, name):
        """{number: state} of the jobs of this name that have not ended."""
        lines = self.run("squeue", "-h", f"--name={name}", "-o%A %T").splitlines()
        return dict(line.split() for line in lines)

    def cancel(self, *numbers):
        self.run("scancel", *numbers)

    def stop(self):
        """Ends all jobs, then the daemons, the last one first."""
        if len(self.processes) == 4:
            self.run("scancel", f"--user={getpass.getuser()}", check=False)
            deadline = time.monotonic() + PATIENCE_S
            while self.run("squeue", "-h", check=False) and time.monotonic() < deadline:
                time.sleep(0.1)
        while self.processes:
            process = self.processes.pop()
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
