#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Deliberate errors in the library: do the tests find them?

Each entry of list.toml replaces a piece of code by a wrong one, in a copy of the
source; the tests that it names must then fail. An error that survives shows a test
that is missing. Portions make a long list short: --portion 2/3 takes every third
entry from the second one on.
"""

import argparse
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib

# Seconds that a test may take; one that hangs has found the error too.
TIME_LIMIT = 600

ENVIRONMENT = {
    "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self,vader",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
}

# A wrong line may leave variables that nobody uses.
QUIET = "add_compile_options(-w)\n"


class ListError(Exception):
    """The list does not fit the code, or the tests fail without any error."""


class Test:
    """A test by its name in the list."""

    def __init__(self, name, source):
        self.name = name
        words = name.split()
        self.n_ranks = 1
        if words[-1].startswith("mpirun="):
            self.n_ranks = int(words.pop().split("=")[1])
        self.kind, *self.words = words
        if self.kind == "unit":
            self.check_unit(source)
        elif self.kind == "integration":
            self.check_integration(source)
        elif self.kind == "figure":
            letter, _, number = self.words[0].lower().partition("-")
            file = (f"table_{letter}_{number[1:]}" if number.startswith("t")
                    else f"figure_{letter}_{number:0>2}")
            self.require(list(source.glob(f"figures/*/{file}.py")))
        elif self.kind == "ctest":
            stem = self.words[0].removesuffix(".release")
            self.require((source / f"tests/{stem}.prm").exists())
        else:
            self.require(False)

    def require(self, condition):
        if not condition:
            raise ListError(f"there is no test '{self.name}'")

    def check_unit(self, source):
        suite, _, case = self.words[0].partition("/")
        texts = [file.read_text() for file in (source / "tests/unit").glob("*.cc")]
        texts = [t for t in texts if f"BOOST_AUTO_TEST_SUITE({suite})" in t]
        self.require(texts)
        if case:
            self.require(any(re.search(rf"_TEST_CASE\({case}\b", t) for t in texts))

    def check_integration(self, source):
        file = source / "tests/integration" / self.words[0]
        self.require(file.exists())
        class_name, _, method = self.words[1].partition(".")
        after = file.read_text().partition(f"\nclass {class_name}(")[2]
        body = re.split(r"\nclass ", after)[0]
        self.require(f"    def {method}(self)" in body)

    def target(self):
        """Targets to build. Programs take the library as it is."""
        if self.kind == "unit":
            return ["unit_tests"]
        return ["ricochet"] + (["all"] if self.kind == "ctest" else [])

    def command(self, source, build):
        if self.kind == "unit":
            words = [str(build / "tests/unit_tests"), f"--run_test={self.words[0]}"]
            if self.n_ranks > 1:
                words = ["mpirun", "-n", str(self.n_ranks)] + words
            return words
        if self.kind == "figure":
            return ["/usr/bin/python3", str(source / "figures/make.py"), self.words[0],
                    "--build-dir", str(build)]
        if self.kind == "ctest":
            return ["ctest", "--test-dir", str(build), "--no-tests=error",
                    "-R", f"^{re.escape(self.words[0])}$"]
        return ["/usr/bin/python3", str(source / "tests/integration" / self.words[0]),
                "--programs", str(build), "--mpiexec", "mpirun", self.words[1]]

    def fails(self, source, build):
        """Run; return what went wrong, or nothing."""
        if self.kind == "ctest":
            # The harness runs a program again only when the program is newer
            # than its output; here the library has changed.
            for output in (build / "tests" / self.words[0]).glob("output*"):
                output.unlink()
        process = subprocess.Popen(
            self.command(source, build), cwd=source, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace",
            env=dict(os.environ, **ENVIRONMENT), start_new_session=True)
        try:
            output, _ = process.communicate(timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            # With all that it has started; mpirun takes its ranks along.
            os.killpg(process.pid, signal.SIGTERM)
            try:
                process.communicate(timeout=20)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
            return "time limit"
        if process.returncode == 0:
            return ""
        return output[-3000:] or f"exit code {process.returncode}"


class Entry:

    def __init__(self, values, source):
        self.name = values["name"]
        self.file = values["file"]
        self.text = values["text"]
        self.error = values["error"]
        try:
            self.tests = [Test(name, source) for name in values["tests"]]
            if not self.tests:
                raise ListError("no test")
            if not (source / self.file).exists():
                raise ListError(f"there is no {self.file}")
            n = (source / self.file).read_text().count(self.text)
            if n != 1:
                raise ListError(f"'{self.text}' occurs {n} times in {self.file}, "
                                "not once: the list must follow the code")
        except ListError as error:
            raise ListError(f"{self.name}: {error}") from None


def read_list(source):
    file = pathlib.Path(__file__).resolve().parent / "list.toml"
    with open(file, "rb") as stream:
        values = tomllib.load(stream)["error"]
    entries, problems = [], []
    for value in values:
        try:
            entries.append(Entry(value, source))
        except ListError as error:
            problems.append(str(error))
    names = [value["name"] for value in values]
    problems += [f"{name}: twice in the list" for name in set(names)
                 if names.count(name) > 1]
    if problems:
        raise ListError("\n".join(problems))
    return entries


def copy_source(source, copy, build_dir):
    """Only differences are written, so that little is compiled again."""
    wanted = set()
    for folder, folders, files in os.walk(source):
        here = pathlib.Path(folder)
        top = here == source
        folders[:] = [name for name in folders
                      if name != "__pycache__" and
                      not (top and name in (".git", "build", "output")) and
                      (here / name).resolve() != build_dir]
        for name in files:
            relative = (here / name).relative_to(source)
            wanted.add(relative)
            target = copy / relative
            if (target.exists() and
                    target.read_bytes() == (source / relative).read_bytes()):
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / relative, target)
            shutil.copymode(source / relative, target)
    for file in list(copy.rglob("*")):
        if (file.is_file() and file.relative_to(copy) not in wanted and
                "output" not in file.relative_to(copy).parts[:1] and
                "__pycache__" not in file.parts):
            file.unlink()


def run(words, **kwargs):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace",
                          env=dict(os.environ, **ENVIRONMENT), **kwargs)


def compile_targets(build, targets):
    """@return the output of a failure, or nothing."""
    result = run(["ninja", "-C", str(build)] + targets)
    return result.stdout[-3000:] if result.returncode != 0 else ""


def configure_and_build(copy, build):
    build.mkdir(parents=True, exist_ok=True)
    (build / "quiet.cmake").write_text(QUIET)
    result = run(["cmake", "-S", str(copy), "-B", str(build), "-G", "Ninja",
                  "-DCMAKE_BUILD_TYPE=Release",
                  "-DPython3_EXECUTABLE=/usr/bin/python3",
                  f"-DCMAKE_PROJECT_INCLUDE={build / 'quiet.cmake'}",
                  # Programs need not be linked again for another library.
                  "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON"])
    if result.returncode != 0:
        raise ListError("cmake failed:\n" + result.stdout[-3000:])
    problem = compile_targets(build, [])
    if problem:
        raise ListError("the build without errors failed:\n" + problem)


def targets_of(entry):
    targets = []
    for test in entry.tests:
        targets += [t for t in test.target() if t not in targets]
    return targets


class DoesNotCompile(Exception):
    """An error that the compiler finds is none for the tests."""


def try_entry(entry, copy, build):
    """@return what found the error, empty if nothing did."""
    file = copy / entry.file
    original = file.read_text()
    file.write_text(original.replace(entry.text, entry.error))
    try:
        problem = compile_targets(build, targets_of(entry))
        if problem:
            raise DoesNotCompile(problem)
        for test in entry.tests:
            if test.fails(copy, build):
                return test.name
        return ""
    finally:
        file.write_text(original)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", default=".", type=pathlib.Path,
                        help="the repository; it is not touched")
    parser.add_argument("--build-dir", type=pathlib.Path,
                        help="a scratch folder, for a copy and its build")
    parser.add_argument("--portion", default="1/1", metavar="K/N",
                        help="every N-th entry, from the K-th on")
    parser.add_argument("--only", metavar="NAME", action="append",
                        help="entries whose name or file contains this; may be "
                        "repeated")
    parser.add_argument("--list", action="store_true",
                        help="print the list, checked against the code, and stop")
    arguments = parser.parse_args()

    source = arguments.source.resolve()
    entries = read_list(source)
    match = re.fullmatch(r"(\d+)/(\d+)", arguments.portion)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        parser.error("--portion is K/N with K from 1 to N")
    entries = entries[int(match[1]) - 1::int(match[2])]
    if arguments.only:
        entries = [entry for entry in entries
                   if any(only in entry.name or only in entry.file
                          for only in arguments.only)]
        if not entries:
            raise ListError("no entry has such a name")

    if arguments.list:
        for entry in entries:
            print(f"{entry.name}\n    {entry.file}\n    " +
                  "\n    ".join(test.name for test in entry.tests))
        print(f"mutations: {len(entries)} in the list")
        return 0

    if not arguments.build_dir:
        parser.error("--build-dir is missing")
    build_dir = arguments.build_dir.resolve()
    copy, build = build_dir / "source", build_dir / "build"
    copy_source(source, copy, build_dir)
    print("building without errors ...", flush=True)
    configure_and_build(copy, build)

    names = {test.name: test for entry in entries for test in entry.tests}
    print(f"running {len(names)} tests without errors ...", flush=True)
    for name, test in names.items():
        problem = test.fails(copy, build)
        if problem:
            raise ListError(f"'{name}' fails without any error:\n{problem}")

    survivors, broken = [], []
    width = max(len(entry.name) for entry in entries)
    file_width = max(len(entry.file) for entry in entries)
    print(f"{'error':{width}}  {'file':{file_width}}  seconds  found by")
    for entry in entries:
        start = time.monotonic()
        try:
            found_by = try_entry(entry, copy, build)
        except DoesNotCompile as problem:
            print(problem)
            broken.append(entry)
            found_by = "the compiler: the list must follow the code"
        if not found_by:
            survivors.append(entry)
        print(f"{entry.name:{width}}  {entry.file:{file_width}}  "
              f"{time.monotonic() - start:7.0f}  {found_by or 'NOTHING'}",
              flush=True)
    n_found = len(entries) - len(survivors) - len(broken)
    print(f"mutations: {len(entries)} tried, {n_found} found")
    for entry in survivors:
        print(f"survived: {entry.name} ({entry.file})")
    for entry in broken:
        print(f"does not compile: {entry.name} ({entry.file})")
    return 1 if survivors else 2 if broken else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except ListError as error:
        print(f"mutations: {error}", file=sys.stderr)
        sys.exit(2)
