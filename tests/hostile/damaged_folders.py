# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kind 5: folders of earlier runs, damaged, and then resumed or run anew."""

import shutil
import struct
import zlib

from case import ACCEPTED, ANY, NOT_ACCEPTED, REFUSED
from programs import BARS, THROWN, small, steps

EARLIER, LATER = 10, 20


def settings_for(program, n_steps):
    settings = small(program)
    settings.update(steps(program, n_steps))
    settings["Output/Checkpoint every"] = "5"
    settings["Output/Fields every"] = "2"
    return settings


class Folder:
    """Possible damages of a folder. Each method returns the exit codes that
    --resume may end with."""

    def __init__(self, case):
        self.case, self.rng, self.path = case, case.rng, case.run_folder
        self.ledger = self.path / "energy.csv"
        self.checkpoint = self.path / "checkpoint.bin"

    def rows(self):
        return self.ledger.read_text().splitlines()

    def write_rows(self, rows):
        self.ledger.write_text("\n".join(rows) + "\n")

    def untouched(self):
        return ACCEPTED

    def checkpoint_cut(self):
        data = self.checkpoint.read_bytes()
        self.checkpoint.write_bytes(data[:self.rng.randrange(len(data))])
        return REFUSED

    def checkpoint_changed(self):
        data = bytearray(self.checkpoint.read_bytes())
        data[self.rng.randrange(len(data))] ^= 1 << self.rng.randrange(8)
        self.checkpoint.write_bytes(bytes(data))
        return REFUSED

    def checkpoint_longer(self):
        with open(self.checkpoint, "ab") as file:
            file.write(self.rng.randbytes(self.rng.choice([1, 1000])))
        return REFUSED

    def checkpoint_junk(self):
        self.checkpoint.write_bytes(self.rng.randbytes(self.rng.choice([0, 8, 5000])))
        return REFUSED

    def checkpoint_of_a_stranger(self):
        """A good checksum, and nobody knows what."""
        data = self.checkpoint.read_bytes()
        head = data.index(b"\n") + 1
        payload = bytearray(data[head + 12:])
        if self.rng.random() < .3:
            payload = self.rng.randbytes(self.rng.choice([0, 8, 1000, len(payload)]))
        else:
            for place in self.rng.choices(range(len(payload)),
                                          k=self.rng.choice([1, 10, 100])):
                payload[place] = self.rng.randrange(256)
        payload = bytes(payload)
        self.checkpoint.write_bytes(
            data[:head] + struct.pack("<QI", len(payload), zlib.crc32(payload)) + payload)
        return ANY

    def checkpoint_gone(self):
        self.checkpoint.unlink()
        return REFUSED

    def cell(self):
        """A cell of a row that the checkpoint counts is no number."""
        rows = self.rows()
        k = self.rng.randrange(1, len(rows))
        cells = rows[k].split(",")
        cells[self.rng.randrange(len(cells))] = self.rng.choice(
            ["abc", "nan", "inf", "", "1e400", "1.0x", "0x1p3", " "])
        rows[k] = ",".join(cells)
        self.write_rows(rows)
        return REFUSED

    def digit(self):
        """The first digit of a number is another one."""
        rows = self.rows()
        k = self.rng.randrange(1, len(rows))
        cells = rows[k].split(",")
        c = self.rng.choice([c for c, cell in enumerate(cells) if cell])
        place = 1 if cells[c][0] == "-" else 0
        digit = str((int(cells[c][place]) + self.rng.randrange(1, 10)) % 10)
        cells[c] = cells[c][:place] + digit + cells[c][place + 1:]
        rows[k] = ",".join(cells)
        self.write_rows(rows)
        return REFUSED

    def rows_swapped(self):
        rows = self.rows()
        a, b = self.rng.sample(range(1, len(rows)), 2)
        rows[a], rows[b] = rows[b], rows[a]
        self.write_rows(rows)
        return REFUSED

    def row_missing(self):
        rows = self.rows()
        del rows[self.rng.randrange(len(rows))]
        self.write_rows(rows)
        return REFUSED

    def row_twice(self):
        rows = self.rows()
        k = self.rng.randrange(1, len(rows) - 1)
        rows.insert(k, rows[k])
        self.write_rows(rows)
        return REFUSED

    def last_line_cut(self):
        text = self.ledger.read_text()
        last = len(text.splitlines()[-1])
        self.ledger.write_text(text[:-self.rng.randrange(2, last)])
        return REFUSED

    def more_columns(self):
        rows = self.rows()
        first = self.rng.choice([0, 1])
        self.write_rows([row + ",1" if k >= first else row
                         for k, row in enumerate(rows)])
        return REFUSED

    def ledger_empty(self):
        self.ledger.write_text(self.rng.choice(["", "\n", "abc\n"]))
        return REFUSED

    def ledger_gone(self):
        self.ledger.unlink()
        return REFUSED

    def rows_after_the_checkpoint(self):
        """As a run leaves them that is killed: they are forgotten."""
        with open(self.ledger, "a") as file:
            file.write(self.rng.choice(["1.5,0.1,0.", "\0\0\0", "x\n" * 100,
                                        self.rows()[-1] + "\n"]))
        return ACCEPTED

    def lists(self):
        """Some have obstacles."""
        return [file for file in (self.path / "solution.pvd",
                                  self.path / "obstacles.pvd") if file.exists()]

    def pvd(self):
        """The list of fields can be lost; the run cannot."""
        file = self.rng.choice(self.lists())
        text = file.read_text()
        damaged = self.rng.choice([
            "", "junk\n", text[:self.rng.randrange(len(text))],
            text.replace('timestep="', 'timestep="x'),
            text.replace("step-0", "step-99999999999999999999"),
            text.replace('timestep="0', 'timestep="1e999'),
            text.replace(".vtu", ".xyz"), text * 2, None])
        if damaged is None:
            file.unlink()
        else:
            file.write_text(damaged)
        return ANY

    def field_gone(self):
        file = self.rng.choice(sorted((self.path / "solution").iterdir()))
        self.rng.choice([lambda: file.unlink(), lambda: file.write_text("")])()
        return ANY

    def solution_is_a_file(self):
        shutil.rmtree(self.path / "solution")
        (self.path / "solution").write_text("")
        return NOT_ACCEPTED

    def folder_in_place_of_file(self):
        name = self.rng.choice(["energy.csv", "log.txt", "checkpoint.bin"])
        (self.path / name).unlink()
        (self.path / name).mkdir()
        return REFUSED

    def folder_in_place_of_written_file(self):
        """Not read, but to be written."""
        name = self.rng.choice(["parameters.prm", "energy.h5"]
                               + [file.name for file in self.lists()])
        (self.path / name).unlink()
        (self.path / name).mkdir()
        return ANY if name == "parameters.prm" else NOT_ACCEPTED

    def dangling_link(self):
        """A link to nowhere in place of a file that is read."""
        name = self.rng.choice(["energy.csv", "checkpoint.bin"])
        (self.path / name).unlink()
        (self.path / name).symlink_to("/nowhere/at/all")
        return REFUSED


DAMAGES = [name for name, method in vars(Folder).items()
           if name not in ("rows", "write_rows", "lists") and name[0] != "_"]
DAMAGES += ["checkpoint_cut", "checkpoint_changed", "cell", "cell", "digit", "pvd"]


def run(case):
    rng = case.rng
    program = rng.choice(BARS + THROWN)
    before, after = settings_for(program, EARLIER), settings_for(program, LATER)
    earlier = case.undisturbed(program, before)
    reference = case.undisturbed(program, after)
    if earlier is None or reference is None:
        return
    shutil.copytree(earlier, case.run_folder, symlinks=True)
    name = rng.choice(DAMAGES)
    case.note(f"a run of {EARLIER} steps, then: {name}")
    expected = getattr(Folder(case), name)()
    if rng.random() < .8:
        options = ["--resume"]
    else:
        # Anew: whatever lies there is replaced, if it can be.
        options, expected = rng.choice([[], ["--overwrite"]]), ANY
    # The damaged folder is kept, so that the command can be repeated.
    damaged = case.folder / "damaged"
    shutil.copytree(case.run_folder, damaged, symlinks=True)
    case.script("cp", "-a", damaged, case.run_folder)
    result = case.attempt(program, after, expected, options=options)
    if result.code == 0 and name != "checkpoint_of_a_stranger":
        case.expect_same_ledger(case.run_folder, reference)
