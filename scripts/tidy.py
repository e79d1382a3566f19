#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""clang-tidy with the checks of .clang-tidy.

    tidy.py            sources that have changed: in the working tree, and in the commits that
                       the upstream branch does not have (without any, in the last one)
    tidy.py --all      all of them
    tidy.py FILE...    these

A header that has changed is looked at within the source of its name, or within one that includes
it. Findings end it with exit code 1. Without clang-tidy nothing is checked (exit code 77); without git
nothing has changed.

Compile commands are those of the preset "dev", file by file; of its flags only those stay that say how the
source is to be read, as clang does not know all of GCC's.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("lib", "steps", "tests", "benchmarks", "examples")
SKIPPED = 77


def git(root, *words):
    """Lines of what git says in @p root, or nothing where it says no."""
    try:
        result = subprocess.run(["git", *words], cwd=root, capture_output=True, text=True,
                                check=False)
    except FileNotFoundError:
        return []
    return result.stdout.splitlines() if result.returncode == 0 else []


def changed_files(root):
    """Paths of what has changed in the working tree @p root and in its last commits.

    @return nothing where git does not know @p root, also as a folder of something else
    """
    if git(root, "rev-parse", "--show-prefix") != [""]:
        return None
    head = git(root, "rev-parse", "--verify", "HEAD")
    base = git(root, "merge-base", "HEAD", "@{upstream}")
    if not base or base == head:
        base = git(root, "rev-parse", "--verify", "HEAD~") or head
    changed = git(root, "diff", "--name-only", "--relative", *base)
    changed += git(root, "ls-files", "--others", "--exclude-standard")
    return sorted(set(changed))


def to_check(root, sources, changed):
    """The subset of @p sources that covers everything that has @p changed.

    @param sources paths of all sources that are compiled, relative to @p root
    """
    chosen = set(changed) & set(sources)
    texts = {}
    for path in changed:
        header = pathlib.PurePosixPath(path)
        if header.suffix != ".h" or header.parts[0] not in FOLDERS:
            continue
        source = str(header.with_suffix(".cc"))
        if source in sources:
            chosen.add(source)
            continue
        if not texts:
            texts = {each: (root / each).read_text(encoding="utf-8") for each in sources}
        include = re.compile(rf'^#\s*include [<"](\S*/)?{re.escape(header.name)}[">]',
                             re.MULTILINE)
        of_it = [each for each, text in texts.items() if include.search(text)]
        if not chosen.intersection(of_it):
            chosen.update(of_it[:1])
    return sorted(chosen)


def commands_for_clang(commands, root):
    """Entries of compile_commands.json for clang, of our own sources only."""
    result = []
    for entry in commands:
        path = pathlib.Path(entry["file"])
        if root not in path.parents or path.relative_to(root).parts[0] not in FOLDERS:
            continue
        words = iter(shlex.split(entry["command"]))
        flags = []
        for word in words:
            if word == "-isystem":
                flags += [word, next(words)]
            elif word.startswith(("-I", "-D", "-std=", "-mavx")):
                flags.append(word)
        # Warnings are GCC's task.
        result.append({"directory": entry["directory"], "file": entry["file"],
                       "arguments": ["clang++", *flags, "-w", "-c", entry["file"]]})
    return result


def clang_tidy():
    """The program; that of Debian 12 rather than another one."""
    return shutil.which("clang-tidy-14") or shutil.which("clang-tidy")


def write_commands(root):
    """Prepare the build "dev", and write what clang has to know beside it.

    @return the folder of the commands, and the sources of which there are some
    """
    build = root / "build" / "dev"
    subprocess.run(["cmake", "--preset", "dev"], cwd=root, check=True,
                   stdout=subprocess.DEVNULL)
    commands = commands_for_clang(
        json.loads((build / "compile_commands.json").read_text(encoding="utf-8")), root)
    folder = build / "tidy"
    folder.mkdir(exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(commands, indent=1),
                                                  encoding="utf-8")
    return folder, sorted(str(pathlib.Path(entry["file"]).relative_to(root))
                          for entry in commands)


def check(program, folder, root, path):
    """@return whether @p path is without findings, and what there is to say."""
    # Not re.escape(), whose escapes of minus signs and blanks LLVM does not know.
    folder_of_ours = re.sub(r"([.^$*+?()\[\]{}|\\])", r"\\\1", str(root))
    result = subprocess.run(
        [program, "-p", str(folder), "--quiet", "--warnings-as-errors=*",
         f"--header-filter=^{folder_of_ours}/({'|'.join(FOLDERS)})/", path],
        cwd=root, capture_output=True, text=True, check=False)
    counts = r"^\d+ warnings?.* generated\.$"
    errors = "\n".join(line for line in result.stderr.splitlines()
                       if result.returncode != 0 and not re.match(counts, line))
    return result.returncode == 0, (result.stdout + errors).strip()


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true", help="all sources")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at once")
    parser.add_argument("files", nargs="*", metavar="FILE")
    arguments = parser.parse_args()
    if arguments.all and arguments.files:
        parser.error("either --all or files")
    program = clang_tidy()
    if program is None:
        print("tidy.py: skipped, as there is no clang-tidy (apt-get install clang-tidy).")
        return SKIPPED
    if not arguments.all:
        changed = ([str(pathlib.Path(file).resolve().relative_to(ROOT))
                    for file in arguments.files] or changed_files(ROOT))
        if changed is None:
            print("tidy.py: git does not know these sources, so nothing counts as changed "
                  "(--all checks all of them).")
            return 0
        if not any(path.endswith((".cc", ".h")) for path in changed):
            print("tidy.py: no C++ has changed.")
            return 0
    folder, sources = write_commands(ROOT)
    paths = sources if arguments.all else to_check(ROOT, sources, changed)
    failed = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        checks = pool.map(lambda path: (path, *check(program, folder, ROOT, path)), paths)
        for number, (path, is_clean, text) in enumerate(checks, 1):
            print(f"[{number}/{len(paths)}] {path}", flush=True)
            if not is_clean:
                failed.append(path)
                print(text, flush=True)
    if failed:
        print(f"tidy.py: findings in {', '.join(failed)}. Correct them, or say why not beside them: "
              "// NOLINTNEXTLINE(check): reason. .clang-tidy has the list of checks.",
              file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
