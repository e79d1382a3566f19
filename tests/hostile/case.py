# SPDX-License-Identifier: LGPL-2.1-or-later
"""One hostile case: a folder, random numbers of its own, runs and findings."""

import os
import pathlib
import random
import shlex
import shutil
import signal
import subprocess
import threading
import time
from dataclasses import dataclass

import contract
import programs

HANG = 60.
ANY = frozenset((0, 1, 2))
REFUSED = frozenset((1,))
NOT_ACCEPTED = frozenset((1, 2))
ACCEPTED = frozenset((0,))


@dataclass
class Result:
    code: int
    out: str
    err: str
    seconds: float
    timed_out: bool = False
    killed: bool = False


class Context:
    """Common parts of all cases: programs, environment, undisturbed runs."""

    def __init__(self, programs, mpiexec, seed, work, verbose=False):
        self.programs = pathlib.Path(programs).resolve()
        self.mpiexec = mpiexec
        self.seed = seed
        self.work = work
        self.verbose = verbose
        self.root = pathlib.Path(__file__).resolve().parents[2]
        self.environment = self._environment()
        self._kept = {}
        self._lock = threading.Lock()
        self.can_mount = self._try_mount()

    def _environment(self):
        """As little as possible from outside, so that a case is the same
        everywhere; and as the scripts set it for Open MPI."""
        environment = {
            "PATH": os.environ.get("PATH", "/usr/bin:/bin"),
            "HOME": str(self.work),
            "TMPDIR": str(self.work / "tmp"),
            "LC_ALL": "C",
            "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
            "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_rmaps_base_oversubscribe": "1",
            "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self,vader",
            "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
        if "LD_LIBRARY_PATH" in os.environ:
            environment["LD_LIBRARY_PATH"] = os.environ["LD_LIBRARY_PATH"]
        (self.work / "tmp").mkdir(parents=True)
        return environment

    def _try_mount(self):
        """May this user mount a small file system?"""
        point = self.work / "tmp" / "mount"
        point.mkdir()
        try:
            mount(point, 1 << 20)
            unmount(point)
        except (OSError, subprocess.CalledProcessError):
            return False
        return True

    def keep(self, key, make):
        """The result of make(), which is called once per @p key."""
        with self._lock:
            lock = self._kept.setdefault(key, [threading.Lock()])
        with lock[0]:
            if len(lock) == 1:
                lock.append(make())
        return lock[1]

    def folder_for(self, key):
        name = "".join(c if c.isalnum() else "-" for c in str(key))[:60]
        with self._lock:
            number = len(list((self.work / "kept").glob("*"))) \
                if (self.work / "kept").is_dir() else 0
            folder = self.work / "kept" / f"{number}-{name}"
            folder.mkdir(parents=True)
        return folder


def mount(point, size, *options):
    words = ["mount", "-t", "tmpfs", "-o", ",".join([f"size={size}", *options]),
             "hostile", str(point)]
    subprocess.run(words, check=True, capture_output=True)
    return words


def unmount(point):
    subprocess.run(["umount", "-l", str(point)], check=True, capture_output=True)


class Case:

    def __init__(self, context, kind, number):
        self.context = context
        self.kind = kind
        self.number = number
        # The same case gives the same input, whichever others are run.
        self.rng = random.Random(f"{context.seed} {kind} {number}")
        self.folder = context.work / kind / f"{number:05d}"
        self.folder.mkdir(parents=True)
        self.commands = []
        self.findings = []
        self.codes = []

    @property
    def name(self):
        return f"{self.kind}:{self.number}"

    @property
    def run_folder(self):
        return self.folder / "run"

    def finding(self, sort, detail=""):
        """Remember a defect, with the command that showed it last."""
        programs = str(self.context.programs)
        last = next((c for c in reversed(self.commands) if programs in c), "")
        self.findings.append((sort, detail, last))

    def note(self, text):
        """A note for readers of commands.sh."""
        self.commands.append("# " + text)

    def script(self, *words):
        """A step of the case that is no command of a program."""
        self.commands.append(shlex.join(map(str, words)))

    def mount(self, size, *options):
        """A small file system in place of the output folder."""
        self.run_folder.mkdir()
        self.script("mkdir", "-p", self.run_folder)
        self.script(*mount(self.run_folder, size, *options))

    def remount(self, option):
        words = ["mount", "-o", "remount," + option, str(self.run_folder)]
        subprocess.run(words, check=True, capture_output=True)
        self.script(*words)

    def unmount(self):
        unmount(self.run_folder)
        self.script("umount", "-l", self.run_folder)

    def write(self, name, content):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(content, str):
            content = content.encode("utf-8", "surrogateescape")
        file.write_bytes(content)
        return file

    def command(self, program, settings=(), prm=None, folder=None, options=(),
                n_ranks=1):
        """The words of a run; an output folder is always given, and a file to programs that need
        one."""
        if prm is None:
            prm = programs.FILES.get(program)
        words = []
        if n_ranks > 1:
            words = [self.context.mpiexec, "-n", str(n_ranks)]
        words.append(str(self.context.programs / program))
        if prm is not None:
            words.append(str(prm))
        for name, value in dict(settings).items():
            words += ["--set", f"{name}={value}"]
        words += ["--output-dir", str(folder or self.run_folder)]
        return words + list(options)

    def start(self, words, cwd=None, environment=None):
        """Start a process in a session of its own; return it and its outputs.
        They go to files: whoever outlives the process cannot hold them open."""
        if self.context.verbose:
            print("$ " + shlex.join(words), flush=True)
        everything = dict(self.context.environment)
        everything.update(environment or {})
        self.commands.append(self._shell_line(words, cwd, environment))
        number = len(list(self.folder.glob("stdout-*")))
        out = self.folder / f"stdout-{number}"
        err = self.folder / f"stderr-{number}"
        with open(out, "wb") as out_file, open(err, "wb") as err_file:
            process = subprocess.Popen(
                words, cwd=cwd or self.folder, env=everything,
                stdin=subprocess.DEVNULL, stdout=out_file, stderr=err_file,
                start_new_session=True)
        return process, out, err

    @staticmethod
    def _shell_line(words, cwd, environment):
        line = "".join(f"{name}={shlex.quote(value)} "
                       for name, value in (environment or {}).items())
        line += shlex.join(words)
        return f"(cd {shlex.quote(str(cwd))} && {line})" if cwd else line

    def finish(self, started, limit=HANG, began=None):
        """Wait for a started process and collect what it said."""
        process, out, err = started
        began = time.monotonic() if began is None else began
        timed_out = False
        try:
            process.wait(limit)
        except subprocess.TimeoutExpired:
            timed_out = True
        kill_session(process)
        result = Result(process.wait(), read(out), read(err),
                        time.monotonic() - began, timed_out)
        if self.context.verbose:
            print(f"{result.out[-3000:]}{result.err[-6000:]}"
                  f"-> {result.code}, {result.seconds:.2f} s", flush=True)
        return result

    def execute(self, words, cwd=None, environment=None, n_ranks=1, limit=HANG):
        """Run to the end, without judgement."""
        if n_ranks == 1:
            # A program that asks for too much must not take the machine down.
            words = ["prlimit", f"--as={physical_memory()}", "--"] + list(words)
        began = time.monotonic()
        return self.finish(self.start(words, cwd, environment), limit, began)

    def execute_limited(self, words, file_size, with_signal):
        """Run with a largest size of files. Outputs go through pipes, which the
        limit does not reach. Without the signal SIGXFSZ the limit is as a full
        disk is; with it, it is as 'ulimit -f' is."""
        prefix = [] if with_signal else ["env", "--ignore-signal=XFSZ"]
        words = prefix + ["prlimit", f"--fsize={file_size}", "--"] + list(words)
        if self.context.verbose:
            print("$ " + shlex.join(words), flush=True)
        self.commands.append(self._shell_line(words, None, None))
        began = time.monotonic()
        process = subprocess.Popen(
            words, cwd=self.folder, env=self.context.environment,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, start_new_session=True)
        timed_out = False
        try:
            out, err = process.communicate(timeout=HANG)
        except subprocess.TimeoutExpired:
            timed_out = True
            kill_session(process)
            out, err = process.communicate()
        result = Result(process.returncode, decode(out), decode(err),
                        time.monotonic() - began, timed_out)
        if self.context.verbose:
            print(f"{result.out[-3000:]}{result.err[-6000:]}"
                  f"-> {result.code}, {result.seconds:.2f} s", flush=True)
        return result

    def judge(self, result, program, expected=ANY, folder=None, n_ranks=1):
        """Hold a result to the contract; @p folder if it was a run."""
        complaints = contract.check_exit(result, expected)
        complaints += contract.check_texts(result)
        complaints += contract.check_report(result, program, n_ranks)
        if result.code == 0 and folder is not None:
            complaints += contract.check_results(program, folder)
        for complaint in complaints:
            self.finding(*complaint)
        self.codes.append(result.code)
        return not complaints

    def attempt(self, program, settings=(), expected=ANY, is_run=True, n_ranks=1,
                cwd=None, environment=None, **kwargs):
        """Run and judge."""
        words = self.command(program, settings, n_ranks=n_ranks, **kwargs)
        result = self.execute(words, cwd, environment, n_ranks)
        folder = (kwargs.get("folder") or self.run_folder) if is_run else None
        self.judge(result, program, expected, folder, n_ranks)
        return result

    def undisturbed(self, program, settings, n_ranks=1):
        """The folder of an undisturbed run, made once."""
        key = (program, tuple(sorted(settings.items())), n_ranks)

        def make():
            folder = self.context.folder_for(key)
            words = self.command(program, settings, folder=folder / "run",
                                 n_ranks=n_ranks)
            began = time.monotonic()
            with open(folder / "output", "wb") as output:
                code = subprocess.run(words, cwd=folder, stdout=output,
                                      env=self.context.environment,
                                      stderr=output, timeout=300).returncode
            return folder / "run", code, time.monotonic() - began

        folder, code, _ = self.context.keep(key, make)
        if code != 0:
            self.commands.append(shlex.join(
                self.command(program, settings, n_ranks=n_ranks)))
            self.finding("a run that nobody disturbs fails", f"exit code {code}")
            return None
        return folder

    def expect_same_ledger(self, folder, reference):
        """energy.csv is that of an undisturbed run, byte for byte."""
        if reference is None:
            return
        ours, theirs = folder / "energy.csv", reference / "energy.csv"
        if not ours.is_file():
            self.finding("no energy.csv after success")
        elif ours.read_bytes() != theirs.read_bytes():
            self.finding("energy.csv differs from that of an undisturbed run",
                         first_difference(ours, theirs))

    def close(self, keep):
        """Write down how to do it again, or leave nothing."""
        if self.findings or keep:
            lines = ["#!/bin/bash", f"cd {shlex.quote(str(self.folder))}",
                     "umount -l run 2>/dev/null", "rm -rf run"]
            lines += [f"export {name}={shlex.quote(value)}" for name, value
                      in self.context.environment.items()]
            self.write("commands.sh", "\n".join(lines + self.commands) + "\n")
        else:
            shutil.rmtree(self.folder, ignore_errors=True)


def first_difference(ours, theirs):
    a, b = ours.read_text().splitlines(), theirs.read_text().splitlines()
    for number, (x, y) in enumerate(zip(a, b)):
        if x != y:
            return f"row {number} of {len(a)} and {len(b)}"
    return f"{len(a)} and {len(b)} rows"


def decode(data):
    return data.decode("utf-8", "replace")


def read(file):
    return decode(file.read_bytes())


def physical_memory():
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def kill_session(process):
    """End the process and all that it started."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        pass
