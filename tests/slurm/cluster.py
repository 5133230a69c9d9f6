"""A Slurm cluster on this machine: two virtual nodes of two processors each, brought up from nothing and taken down again.

Needs root, Debian's packages slurmctld, slurmd, slurm-client and munge, and no Slurm that runs already.
"""

import atexit
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

NODES = ("n1", "n2")


class Cluster:
    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="cinesplat-slurm-"))
        self.programs = {}
        # However the check ends: no daemon and no folder stay.
        atexit.register(self.take_down)
        for number in (signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, lambda *_: sys.exit(1))
        host = socket.gethostname().split(".")[0]
        nodes = "\n".join(f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={17100 + idx} CPUs=2 RealMemory=2000 State=UNKNOWN"
                          for idx, name in enumerate(NODES))
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(f"""ClusterName=cinesplat
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort=17000
SlurmUser=root
SlurmdUser=root
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/%n.spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/%n.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdParameters=config_overrides
SlurmdTimeout=15
KillWait=5
MinJobAge=300
SchedulerParameters=sched_interval=1,batch_sched_delay=0
{nodes}
PartitionName=main Nodes={",".join(NODES)} Default=YES State=UP
""")
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")

    def __enter__(self):
        # One munged serves all clusters of a machine.
        if subprocess.run("munge -n | unmunge", shell=True, capture_output=True).returncode != 0:
            subprocess.run("mkdir -p /run/munge && chown munge: /run/munge && runuser -u munge -- /usr/sbin/munged", shell=True, check=True)
        self.programs["slurmctld"] = self.daemon("slurmctld", "-D")
        for name in NODES:
            self.start_node(name)
        for _ in range(100):
            if self.output("sinfo", "-h", "-N", "-o", "%t").split() == ["idle"] * len(NODES):
                return self
            time.sleep(0.2)
        for log in sorted(self.folder.glob("*.log")):
            print(f"{log.name}:", *log.read_text(errors="replace").splitlines()[-10:], sep="\n", file=sys.stderr)
        raise SystemExit("the cluster does not come up")

    def __exit__(self, *_):
        self.take_down()

    def take_down(self):
        """Ends all jobs, all daemons and what they left, and removes the folder. Does nothing the second time."""
        if not self.folder.exists():
            return
        if self.programs:
            try:
                subprocess.run(["scancel", "--signal=KILL", "--full", "--me"], capture_output=True, timeout=10)
            except subprocess.TimeoutExpired:
                # A controller that hangs must not keep the daemons alive.
                pass
        for program in self.programs.values():
            program.terminate()
        for program in self.programs.values():
            try:
                program.wait(10)
            except subprocess.TimeoutExpired:
                program.kill()
        for process in self.orphans():
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass
        shutil.rmtree(self.folder, ignore_errors=True)

    def orphans(self):
        """Processes of this cluster that outlived their daemon: they have its configuration in their environment."""
        mark, found = f"SLURM_CONF={self.folder}/".encode(), []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                is_own = mark in (folder / "environ").read_bytes()
            except OSError:
                continue
            if is_own and int(folder.name) != os.getpid():
                found.append(int(folder.name))
        return found

    def daemon(self, *words):
        return subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start_node(self, name):
        (self.folder / f"{name}.spool").mkdir(exist_ok=True)
        self.programs[name] = self.daemon("slurmd", "-D", "-N", name)

    def kill_node(self, name):
        """Ends the daemon of a node without a word, as a crash does. Its tasks live on, as orphans."""
        self.programs[name].kill()
        self.programs[name].wait()
        self.scontrol("update", f"nodename={name}", "state=down", "reason=crash")

    def scontrol(self, *words):
        return subprocess.run(["scontrol", *words], capture_output=True, text=True)

    def output(self, *words):
        return subprocess.run(words, capture_output=True, text=True).stdout

    def running(self):
        """The running tasks as (number of the job, task, node)."""
        lines = self.output("squeue", "-h", "--array", "-t", "running", "-o", "%A %i %N").splitlines()
        return [tuple(line.split()) for line in lines]
