#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plans_test.py PROGRAM SOURCE: mpirun -n N sixstep run .., with a program built with MPI. The rows have the same
bits as with one process. Only the first rank prints messages and writes files. A kill of any rank destroys no
finished run. SIXSTEP_KILLS is the number of kills."""
import contextlib
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import cells  # noqa: E402
from program import PROGRAM, SHORT, SOURCE, ProgramTest  # noqa: E402

KILLS = int(os.environ.get("SIXSTEP_KILLS", "10"))
SPREAD = '[[spread]]\nkey = "motor_override.resistance_ohm"\nrelative = 0.1\n'
# Open MPI must run although the user in a container is root and there are fewer cores than ranks.
ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_btl": "self,vader,tcp",
                            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
                            "HWLOC_HIDE_ERRORS": "2"}  # without /sys Open MPI itself would print messages


def mpirun(ranks, *words):
    return ["mpirun", "--oversubscribe", "--quiet", "-n", str(ranks), PROGRAM, *words]


class Mpi(ProgramTest):
    def held(self, more=SPREAD, length="20e-3"):
        """Writes a scenario with a held rotor: the current is U/R."""
        (self.path / "a.toml").write_text(SHORT.format(limit=20).replace("1e-4", length) + more)
        return "a.toml"

    def on_ranks(self, ranks, *words, code=0, **how):
        result = subprocess.run(mpirun(ranks, *words), cwd=self.path, capture_output=True, text=True, timeout=300,
                                env=ENVIRONMENT, **how)
        self.assertIn(result.returncode, (0, 1) if code is None else (code,), result.stderr + result.stdout)
        return result

    @contextlib.contextmanager
    def started(self, ranks, *words):
        with subprocess.Popen(mpirun(ranks, *words), cwd=self.path, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as job:
            try:
                yield job
            finally:
                job.kill()

    def children(self, job, ranks, seconds=60):
        """The processes that mpirun started, in the order of their ranks."""
        deadline = time.monotonic() + seconds
        while job.poll() is None:
            found = {}
            for pid in pathlib.Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split():
                with contextlib.suppress(OSError):
                    words = (pathlib.Path("/proc") / pid / "environ").read_bytes().split(b"\0")
                    for word in words:
                        if word.startswith(b"OMPI_COMM_WORLD_RANK="):
                            found[int(word.split(b"=")[1])] = int(pid)
            if len(found) == ranks:
                return [found[rank] for rank in range(ranks)]
            self.assertLess(time.monotonic(), deadline, "it never came")
            time.sleep(0.005)
        return []

    def ranks_below(self, pid):
        found = []
        for child in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split():
            words = (pathlib.Path("/proc") / child / "environ").read_bytes()
            found += [int(child)] if b"OMPI_COMM_WORLD_RANK=" in words else self.ranks_below(child)
        return found

    def lives(self, pid):
        """False for a zombie process too. In a container there may be no parent that reads the status of an ended
        process."""
        with contextlib.suppress(OSError):
            return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
        return False

    def ended(self, job, pids):
        """Waits for the end of the job. Returns whether mpirun hung: all ranks have ended, and mpirun still waits.
        Open MPI 4.1 sometimes does this if a process is killed while others start."""
        try:
            job.communicate(timeout=10)
            return False
        except subprocess.TimeoutExpired:
            if any(self.lives(pid) for pid in pids):
                job.communicate(timeout=50)
                return False
        job.kill()
        job.communicate()
        return True

    @staticmethod
    def children_s():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    def all_end(self, pids, seconds=20):
        """Waits until all processes have ended. mpirun does not wait for the processes that it has killed."""
        deadline = time.monotonic() + seconds
        while any(self.lives(pid) for pid in pids):
            self.assertLess(time.monotonic(), deadline, "a rank outlives its job")
            time.sleep(0.01)

    def numbers(self, store="s.sqlite"):
        """The numbers of the runs in a store. The result is empty if the store has no tables yet."""
        if not (self.path / store).exists():
            return set()
        with contextlib.closing(sqlite3.connect(self.path / store)) as db:
            try:
                return {row[0] for row in db.execute("SELECT run FROM runs")}
            except sqlite3.OperationalError as missing:
                self.assertIn("no such table", str(missing))
                return set()

    def table(self, file):
        return (self.path / file).read_text().splitlines()[3:]  # without the first lines, which contain the command

    def wait_for_runs(self, count, job, store="s.sqlite", seconds=60):
        """Waits until the store's file has grown by `count` rows. The store must not be opened while it is written."""
        deadline = time.monotonic() + seconds
        wal = self.path / (store + "-wal")
        while not (wal.exists() and wal.stat().st_size > 100 * count):
            self.assertLess(time.monotonic(), deadline, "it never came")
            self.assertIsNone(job.poll())
            time.sleep(0.01)

    def test_every_cell_is_that_of_the_run_alone(self):
        """A row from another rank has the same names as a row of the first rank."""
        words = ["run", self.held(SPREAD + '[[spread]]\nkey = "supply.voltage_V"\nrelative = 0.05\n')]
        self.on_ranks(3, *words, "--runs", "12", "--store", "s.sqlite", "--csv", "t.csv", "--json", "t.json", code=None)
        tables = [cells.of_csv(self.path / "t.csv"), cells.of_store(self.path / "s.sqlite"), cells.of_json(self.path / "t.json")]
        for n in range(12):
            self.run_program(*words, "--drive", f"{n}", "--json", "one.json", "--force", code=None)
            digest, figures = cells.figures_alone(self.path / "one.json")
            for rows in tables:
                row = rows[n]
                self.assertEqual((row["run"], row["digest"]), (n, digest))
                for figure, measured in figures.items():
                    self.assertEqual(row[figure], measured)
                U, R = row["drive: supply.voltage_V [V]"], row["drive: motor_override.resistance_ohm [ohm]"]
                self.assertAlmostEqual(row["current [A]"], U / R, delta=1e-9 * U / R)  # the current of a held rotor is U/R

    def test_rows_are_those_of_one_process(self):
        file = self.held()
        words = ["run", file, "--vary", "supply.voltage_V=12,24", "--runs", "150"]
        alone = self.run_program(*words, "--csv", "alone.csv", "--json", "alone.json", code=1).stdout
        self.assertEqual(len(self.table("alone.csv")), 301)
        for ranks, more in ((2, []), (3, ["--jobs", "2"]), (5, ["--store", "s.sqlite"])):
            together = self.on_ranks(ranks, *words, *more, "--csv", "mpi.csv", "--json", "mpi.json", "--force", code=1)
            self.assertEqual(together.stdout, alone)
            self.assertEqual(together.stderr, "")
            self.assertEqual(self.table("mpi.csv"), self.table("alone.csv"))
            self.assertEqual((self.path / "mpi.json").read_text().split('"rows"')[1],
                             (self.path / "alone.json").read_text().split('"rows"')[1])
        self.assertEqual(self.numbers(), set(range(300)))
        self.assertEqual(self.names(), ["a.toml", "alone.csv", "alone.json", "mpi.csv", "mpi.json", "s.sqlite"])

    def test_only_the_first_rank_needs_the_files(self):
        """The other ranks run in another folder without the files. The first rank sends them the content."""
        there = self.path / "there"
        there.mkdir()
        shutil.copy(SOURCE / "data/motors/maxon-251601.toml", there / "m.toml")
        (there / "base.toml").write_text(SHORT.format(limit=20))
        (there / "a.toml").write_text('extends = "base.toml"\n' + SPREAD)
        words = ["run", "a.toml", "--vary", "motor=m.toml,maxon-251601", "--runs", "40", "--quiet"]
        each = [["-n", "1", "--wdir", str(there), PROGRAM, *words, "--csv", "mpi.csv"], ["-n", "2", "--wdir", "/", PROGRAM, *words]]
        result = subprocess.run(["mpirun", "--oversubscribe", "--quiet", *each[0], ":", *each[1]], cwd=self.path, env=ENVIRONMENT,
                                capture_output=True, text=True, timeout=300)
        self.assertEqual((result.returncode, result.stdout + result.stderr), (0, ""))
        subprocess.run([PROGRAM, *words, "--csv", "alone.csv"], cwd=there, timeout=300, check=True)
        self.assertEqual(self.table("there/mpi.csv"), self.table("there/alone.csv"))

    def test_one_voice_and_one_exit(self):
        file = self.held()
        for words, code, told in ((["run", file, "--vary", "supply.voltge_V=1:2:3"], 2, "did you mean"),
                                  (["run", "none.toml", "--runs", "3"], 2, "none.toml"),
                                  (["run", file, "--runs"], 2, "--runs"),
                                  (["run", file, "--runs", "3", "--resume"], 2, "--store")):
            result = self.on_ranks(3, *words, code=code)
            alone = self.run_program(*words, code=code)
            self.assertIn(told, result.stderr)
            self.assertEqual(result.stderr, alone.stderr)
        self.assertEqual(self.on_ranks(3, "run", file, code=1).stdout, self.run_program("run", file, code=1).stdout)
        self.held(SPREAD.replace("0.1", "0.01").replace("resistance_ohm", "inductance_mH"))
        self.assertIn("hold every", self.on_ranks(2, "run", file, "--set", "require[0].max=30", "--runs", "20").stdout)

    def test_a_corner_that_cannot_run_is_a_row(self):
        self.held("")
        words = ["run", "a.toml", "--vary", "bridge.dead_time_s=0,1us", "--vary", "pwm.period_s=30us,1us"]
        self.assertEqual(self.on_ranks(3, *words, code=2).stdout, self.run_program(*words, code=2).stdout)

    def test_what_it_would_take_counts_all_processes(self):
        words = ["run", self.held(), "--runs", "100", "--dry-run"]
        self.assertRegex(self.on_ranks(3, *words).stdout, r"about .* on 3 cores")
        self.assertRegex(self.on_ranks(3, *words, "--jobs", "2").stdout, r"about .* on 6 cores")

    def test_several_plans_one_after_the_other(self):
        self.held()
        (self.path / "b.toml").write_text((self.path / "a.toml").read_text().replace("20e-3", "10e-3"))
        words = ["run", "a.toml", "b.toml", "--runs", "50"]
        self.assertEqual(self.on_ranks(3, *words, code=1).stdout, self.run_program(*words, code=1).stdout)

    def test_interruptions_end_cleanly_and_resume_goes_on(self):
        file = self.held()
        words = ["run", file, "--runs", "1500"]
        self.run_program(*words, "--csv", "whole.csv", code=1)
        for told in (signal.SIGINT, signal.SIGTERM):
            endless = ["run", file, "--runs", "100000000", "--store", "s.sqlite", "--resume"]
            with self.started(3, *endless) as job:
                pids = self.children(job, 3)
                self.wait_for_runs(20, job)
                job.send_signal(told)
                job.communicate(timeout=60)
            self.assertNotEqual(job.returncode, 0)
            self.all_end(pids)
            self.assertGreater(len(self.numbers()), 0)
        self.on_ranks(2, *words, "--store", "s.sqlite", "--resume", "--csv", "mpi.csv", code=1)
        self.assertEqual(self.table("mpi.csv"), self.table("whole.csv"))

    def test_waiting_burns_no_core(self):
        """Two runs occupy two ranks, and two other ranks wait. Together they take little more CPU time than one
        process alone."""
        file = self.held("", length="5e3")
        words = ["run", file, "--vary", "supply.voltage_V=24,25", "--jobs", "1", "--quiet"]

        before = self.children_s()
        self.run_program(*words, code=1)
        alone = self.children_s() - before
        # mpirun does not count its processes' time. A shell around each process counts it.
        counted = ["bash", "-c", '"$0" "$@"; times >cpu.$OMPI_COMM_WORLD_RANK', PROGRAM, *words]
        subprocess.run([*mpirun(4)[:-1], *counted], cwd=self.path, env=ENVIRONMENT, timeout=300, check=True)
        took = [sum(60 * float(m) + float(s) for m, s in re.findall(r"(\d+)m([\d.]+)s", (self.path / f"cpu.{rank}").read_text()))
                for rank in range(4)]
        print(f"{alone:.2f} s of work; on four ranks {took}")
        # A rank that waits in a busy loop takes as much CPU time as a rank that works. Two of the four ranks wait.
        self.assertGreater(sum(took), 0.5 * alone)
        for waited in sorted(took)[:2]:
            self.assertLess(waited, 0.1 * alone + 0.3)

    def test_the_script_for_slurm_goes_on_until_all_is_there(self):
        """mpirun replaces srun. A job that is told to end puts itself into the queue again, and its second part
        completes the plan."""
        tools = self.path / "bin"
        tools.mkdir()
        for name, text in (("srun", f'shift 2; shift; exec {" ".join(mpirun(2)[:-1])} {PROGRAM} "$@"'),
                           ("scontrol", 'echo "$@" >>scontrol.txt')):
            (tools / name).write_text(f"#!/bin/bash\n{text}\n")
            (tools / name).chmod(0o755)
        self.held()
        (self.path / "p.toml").write_text('scenario = "a.toml"\ndrives = 20000\n')
        script = ["bash", str(SOURCE / "docs/slurm/plan.sh"), "p.toml"]
        slurm = ENVIRONMENT | {"PATH": f"{tools}:{os.environ['PATH']}", "SLURM_JOB_ID": "7", "SLURM_CPUS_PER_TASK": "2"}
        with subprocess.Popen(script, cwd=self.path, env=slurm, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as job:
            self.wait_for_runs(100, job, "p.sqlite")
            for pid in self.ranks_below(job.pid):  # Slurm too signals each process, and not the launcher
                os.kill(pid, signal.SIGTERM)
            job.wait(timeout=60)
        self.assertEqual(job.returncode, 143)
        self.assertEqual((self.path / "scontrol.txt").read_text(), "requeue 7\n")
        before = self.numbers("p.sqlite")
        self.assertGreater(len(before), 0)
        self.assertLess(len(before), 20000)
        again = subprocess.run(script, cwd=self.path, env=slurm, capture_output=True, text=True, timeout=300)
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertEqual(len(self.table("p.csv")), 20001)
        self.assertEqual((self.path / "scontrol.txt").read_text(), "requeue 7\n")

    def test_kills_take_nothing_that_was_finished(self):
        """One rank is killed at a random instant, and the job ends. The store keeps the runs that it has counted. A
        resumed job, with any number of ranks or without MPI, gives the table of a job without interruption."""
        seed = random.randrange(2**32)
        draw = random.Random(seed)
        file = self.held()
        words = ["run", file, "--runs", "20000"]
        self.run_program(*words, "--csv", "whole.csv", code=1)
        before, kills, hung, told = set(), 0, 0, []
        while kills < KILLS:
            ranks = draw.choice((2, 3, 4))
            with self.started(ranks, *words, "--store", "s.sqlite", "--resume", "--quiet") as job:
                pids = self.children(job, ranks)
                time.sleep(draw.uniform(0.0, 1.2))
                victim = draw.randrange(ranks)
                if pids:
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(pids[victim], signal.SIGKILL)
                hung += self.ended(job, pids)
                self.all_end(pids)
            if job.returncode in (0, 1):
                (self.path / "s.sqlite").unlink()  # the run was complete: start again
                before = set()
                continue
            kills += 1
            now = self.numbers()
            self.assertLessEqual(before, now, f"seed {seed}")
            told.append(f"{victim}/{ranks}:{len(now) - len(before)}")
            before = now
        print(f"kills (rank/ranks:rows more) {' '.join(told)}; {len(before)} rows before the last "
              f"sitting, seed {seed}; mpirun hung {hung} times")
        shutil.copy(self.path / "s.sqlite", self.path / "t.sqlite")
        self.on_ranks(3, *words, "--store", "s.sqlite", "--resume", "--csv", "mpi.csv", code=1)
        self.run_program(*words, "--store", "t.sqlite", "--resume", "--csv", "alone.csv", code=1)
        for table in ("mpi.csv", "alone.csv"):
            self.assertEqual(self.table(table), self.table("whole.csv"), f"seed {seed}")
        self.assertEqual(len(self.table("whole.csv")), 20001)


if __name__ == "__main__":
    unittest.main()
