# SPDX-License-Identifier: LGPL-2.1-or-later
"""Phases of a run in one file: the one ledger, what changes between them, ends by a condition."""

import re
import shutil
import signal
import subprocess
import time

from common import *
from test_static import PILE

SCENE = """
set Program   = ricochet
set Dimension = 2
subsection Body block
  set Shape         = rectangle
  set Size          = 1, 0.5
  set Cells along   = 8, 4
  set Translation   = 0, 0.05
  set Law           = neo-Hookean
  set Young modulus = 1e6
  set Density       = 1000
end
subsection Obstacle floor
  set Shape = half space
end
subsection Contact floor
  set Surface   = block: lower
  set Against   = floor
  set Treatment = improved normal compliance
end
subsection Condition foot
  set Boundary = block: lower
  set Kind     = fixed
end
subsection Condition top
  set Boundary = block: upper
  set Kind     = displacement
  set Value    = 0; -0.05*t
end
subsection Start
  set Gravity = 0, -9.81
end
subsection Output
  set Fields every = 5
end
"""

PRESS = """
  set Without = Contact floor
  subsection Time
    set Scheme     = static
    set Final time = 1
    set Time step  = 0.5
  end
"""

RELEASE = """
  set Without = Condition top; Contact floor
  subsection Time
    set Time step  = 1e-3
    set Final time = 0.5
    set Until      = block_displacement_y > 0.01 && time > 0.01
  end
  subsection Probe block
    set Body = block
  end
"""

HIT = """
  set Without = Condition top; Condition foot
  subsection Body block
    set Velocity = 0, -1
  end
  subsection Time
    set Time step  = 1e-3
    set Final time = 0.5
    set Until      = active_points_floor > 0
  end
"""

PHASES = (("press", PRESS), ("release", RELEASE), ("hit", HIT))


def phase(name, text):
    return f"subsection Phase {name}\n{text}\nend\n"


def scene_of_phases(phases=PHASES):
    return SCENE + "".join(phase(*one) for one in phases)


# A block on a floor that carries another one, held by nothing else.
STANDING = PILE.format(treatment="Signorini active set", scheme="static", step=1, end=1, more="") + """
subsection Phase settle
end
subsection Phase stand
  set Without = Contact floor
  subsection Condition foot
    set Boundary = lower: lower
    set Kind     = fixed
  end
  subsection Time
    set Scheme     = TR-BDF2
    set Final time = 0.02
    set Time step  = 2e-3
  end
end
"""


SHRINK_FIT = ROOT / "examples" / "verification" / "shrink_fit.prm"


class Phases(ProgramTest):

    def compute(self, text, parameters=(), folder="run", options=("--overwrite",), code=0, ranks=1):
        path = self.folder / "scene.prm"
        path.write_text(text, encoding="utf-8")
        found, out, err = self.attempt("ricochet", parameters, self.folder / folder, prm=path,
                                       options=options, n_ranks=ranks)
        self.assertEqual(found, code, msg=out + err)
        return Ledger(self.folder / folder) if code == 0 else " ".join(err.split())

    def test_one_ledger(self):
        """The account of the whole is closed in each row; between phases the energy changes by what
        a phase adds to the motion, by hand; and each phase is what it is as a run of its own."""
        ledger = self.compute(scene_of_phases())
        energy, scale = ledger["energy"], largest(ledger["energy"])
        for row in range(len(energy)):
            gained = sum(sign * ledger[name][row] for sign, name in (
                (1, "external_work"), (1, "imposed_work"), (1, "phase_change"), (-1, "contact_work"),
                (-1, "friction_work"), (-1, "viscous_dissipation"), (-1, "numerical_dissipation")))
            self.assertAlmostEqual((energy[row] - energy[0] - gained) / scale, 0., places=11)
        numbers = ledger["phase"]
        self.assertEqual(sorted(set(numbers)), [1., 2., 3.])
        begin = {p: numbers.index(p) for p in (2., 3.)}
        times = ledger["time"]
        for row in range(1, len(times)):
            step = times[row] - times[row - 1]
            (self.assertEqual if row in begin.values() else self.assertGreater)(step, 0.)
        # Letting go changes nothing; a velocity v is added to the momentum P of the mass m:
        # P v + m v^2 / 2.
        self.assertEqual(ledger["phase_change"][begin[2.]], 0.)
        momentum = ledger["momentum_y"][begin[3.] - 1]
        self.assertAlmostEqual(ledger["phase_change"][-1] / (-momentum + 250.), 1., places=9)
        self.assertAlmostEqual(ledger["momentum_y"][begin[3.]], momentum - 500., places=6)

        # Ends by conditions, at the first step where they are true.
        shown = Ledger(self.folder / "run" / "2_release")
        true = [t > .01 and u > .01
                for t, u in zip(shown["time"], shown["block_displacement_y"])]
        self.assertEqual(true, [False] * (len(true) - 1) + [True])
        self.assertEqual(ledger["active_points_floor"][-2], 0.)
        self.assertGreater(ledger["active_points_floor"][-1], 0.)
        self.assertNotEqual(ledger["active_points_floor"][0], 0., msg="not a number")
        log = (self.folder / "run" / "2_release" / "log.txt").read_text()
        self.assertIn("ends at t = ", log)

        # The third one by hand: a file that starts from the folder of the second.
        by_hand = SCENE
        for condition in ("foot", "top"):
            at = by_hand.index(f"subsection Condition {condition}")
            by_hand = by_hand[:at] + by_hand[by_hand.index("end\n", at) + 4:]
        before = self.folder / "run" / "2_release"
        self.compute(by_hand, [f"Start/From={before}", "Body block/Velocity=0, -1", "Time/Final time=0.5",
                               "Time/Time step=1e-3", "Time/Until=active_points_floor > 0"], "by_hand")
        self.assertEqual((self.folder / "by_hand" / "energy.csv").read_text(),
                         (self.folder / "run" / "3_hit" / "energy.csv").read_text())

        # Fields of all phases, with the times of the whole.
        fields = re.findall(r'timestep="([^"]*)".*file="([^"]*)"',
                            (self.folder / "run" / "solution.pvd").read_text())
        self.assertEqual({name.split("/")[0] for _, name in fields},
                         {"1_press", "2_release", "3_hit"})
        for when, name in fields:
            self.assertTrue((self.folder / "run" / name).is_file())
            self.assertTrue(any(abs(float(when) - t) < 1e-9 for t in times))

    def test_resumed_in_any_phase(self):
        """A run that was stopped in a phase goes on to the same end, digit for digit; a phase that began
        from another state than is there now is refused."""
        text = scene_of_phases()
        self.compute(text, folder="whole")
        whole = (self.folder / "whole" / "energy.csv").read_text()
        # Complete, or stopped within the last one.
        for first in ([], ["Phase hit/Time/Final time=0.005"]):
            self.compute(text, first)
            ledger = self.compute(text, options=["--resume"])
            self.assertEqual((self.folder / "run" / "energy.csv").read_text(), whole)
        self.assertGreater(len(ledger["time"]), 20)
        self.compute(text, ["Phase release/Time/Final time=0.005"])
        self.assertIn("the phase before it ended with the checkpoint", self.compute(
            text, options=["--resume"], code=1))
        # Without what came after it, the second phase goes on, and the third begins.
        shutil.rmtree(self.folder / "run")
        self.compute(text, ["Phase release/Time/Final time=0.005",
                            "Phase hit/Contact floor/Compliance coefficient=-1"], code=1)
        self.compute(scene_of_phases(PHASES[:2]), ["Phase release/Time/Final time=0.005"])
        self.compute(text, options=["--resume"])
        self.assertEqual((self.folder / "run" / "energy.csv").read_text(), whole)

    def test_stopped_by_a_signal(self):
        text = scene_of_phases().replace("set Final time = 0.5\n    set Until      = active",
                                         "set Final time = 500\n    set Until      = 1 < 0 * active")
        path = self.folder / "scene.prm"
        path.write_text(text, encoding="utf-8")
        folder = self.folder / "run"
        with subprocess.Popen(self.command("ricochet", (), folder, prm=path),
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
            while not (folder / "3_hit" / "energy.csv").is_file() and process.poll() is None:
                time.sleep(.05)
            time.sleep(.2)
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        ledger = Ledger(folder)
        self.assertEqual(ledger["phase"][-1], 3.)
        self.assertEqual(len(Ledger(folder / "3_hit")["time"]), ledger["phase"].count(3.))

    def test_two_ranks(self):
        one = self.compute(scene_of_phases())
        two = self.compute(scene_of_phases(), ["Linear solver/Distribute=true"], ranks=2)
        for name in ("time", "energy", "phase_change", "external_work"):
            scale = largest(one[name])
            for a, b in zip(one[name], two[name]):
                self.assertAlmostEqual((a - b) / scale, 0., places=10)
        self.assertEqual(len(one["time"]), len(two["time"]))

    def test_velocities_of_the_file(self):
        """They are those of the first phase, in which a block is thrown upwards; the second one goes on."""
        flight = """
  set Without = Condition top; Condition foot; Contact floor
  subsection Time
    set Time step  = 1e-3
    set Final time = 2e-3
  end
"""
        ledger = self.compute(scene_of_phases((("begin", flight), ("on", flight))),
                              ["Body block/Velocity=0, 1"])
        self.assertAlmostEqual(ledger["phase_change"][-1], 0., places=9)
        self.assertAlmostEqual(ledger["momentum_y"][-1] / (500. * (1. - 9.81 * 4e-3)), 1., places=9)

    def test_forces_go_on_by_name(self):
        """A contact is left out, in whose place a support is: the other one still carries m g."""
        ledger = self.compute(STANDING)
        second = ledger["phase"].index(2.)
        for force in ledger["resultant_y_joint"][second:]:
            self.assertAlmostEqual(force / (9.81 * 500.), 1., places=6)
        self.assertLess(max(ledger["kinetic_energy"]), 1e-12)
        self.assertAlmostEqual(ledger["phase_change"][-1], 0., places=9)

    def test_bodies_that_overlap_undeformed(self):
        """A ring that is smaller than its shaft: a contact that begins in a later phase begins where
        nothing overlaps, or is refused. (The pressure of the fit is in the verification.)"""
        for opening, begins in (("4", True), ("1", False)):
            parameters = [f"Phase {name}/Condition opening/Value={opening}*x*{t};{opening}*y*{t}"
                          for name, t in (("open", "t"), ("fit", "(1-t)"))]
            code, out, err = self.attempt("ricochet", [*parameters, "Phase fit/Time/Final time=0.5"],
                                          self.folder / opening, prm=SHRINK_FIT)
            self.assertEqual(code, 0 if begins else 1, msg=out + err)
            if not begins:
                self.assertIn("Phase fit: The contact 'fit' begins here, and its surfaces overlap",
                              " ".join(err.split()))
        # The same with an obstacle: a block that comes up through the floor.
        rise = """
  set Without = Condition top; Condition foot; Contact floor
  subsection Time
    set Time step  = 1e-3
    set Final time = 0.1
    set Until      = block_displacement_y > {height}
  end
  subsection Probe block
    set Body = block
  end
"""
        stand = rise.replace("; Contact floor", "")
        for height, code in ((.03, 0), (.01, 1)):
            found = self.compute(
                scene_of_phases((("rise", rise.format(height=height)),
                                 ("on", stand.format(height=.04)))),
                ["Body block/Velocity=0, 2", "Body block/Translation=0, -0.02"],
                f"rise_{code}", code=code)
            if code == 1:
                self.assertIn("Phase on: The contact 'floor' begins here", found)
        code, out, err = self.attempt("ricochet", ["Phase open/Without="], self.folder / "at_once",
                                      prm=SHRINK_FIT)
        self.assertEqual(code, 1, msg=out + err)
        self.assertIn("At the start bodies overlap", err)

    def test_what_is_refused(self):
        def refused(text, parameters=(), options=("--overwrite",)):
            message = self.compute(text, parameters, "refused", options, code=1)
            self.assertFalse((self.folder / "refused" / "energy.csv").exists())
            return message

        text = scene_of_phases()
        self.assertIn("exists already", refused(scene_of_phases((*PHASES, ("hit", HIT)))))
        self.assertIn("should be 'Phase NAME'", refused(SCENE + phase("a.b", PRESS)))
        self.assertIn("should be 'Phase NAME'", refused(SCENE + phase("", PRESS)))
        for name, value in (("Start", "From = x"), ("Output", "Folder = x")):
            self.assertIn("cannot be set in a phase", refused(SCENE + phase(
                "press", PRESS + f"  subsection {name}\n    set {value}\n  end\n")))
        for parameters, message in (
                (["Phase hit/Without=Condition topp"], "Is 'Condition top' meant?"),
                (["Phase hut/Time/Until=time > 1"], "there is no section 'Phase hut'"),
                (["Phase hit/Time/Untill=time > 1"], "Phase hit: --set"),
                (["Output/Checkpoint every=0"], "each of which begins at the last checkpoint"),
                (["Phase hit/Time/Until=time >"], "Phase hit: Time/Until, a condition on columns"),
                (["Phase hit/Time/Until=rand() > .5"], "random numbers"),
                # Before the first phase is made.
                (["Phase hit/Body block/Young modulus=-1"], "Phase hit: "),
                (["Phase hit/Body block/Translation=0, 0.06"],
                 "Phase hit: it has other bodies than the first phase"),
                (["Phase press/Body block/Cells along=8, 2"],
                 "Phase release: it has other bodies than the first phase"),
                (["Phase press/Time/Until=kinetic_enrgy > 1"], "Is 'kinetic_energy' meant?")):
            with self.subTest(parameters[0]):
                self.assertIn(message, refused(text, parameters))
        self.assertIn("has a velocity at the start",
                      refused(text, ["Body block/Velocity=0, -1"]))
        self.assertIn("cannot be resumed", refused(text, options=["--resume"]))
        # Other programs have no phases.
        self.assertIn("Phase press", " ".join(self.attempt(
            "elastic_ball", ["Phase press/Time/Final time=1"], self.folder / "ball")[2].split()))

    def test_an_end_that_does_not_come(self):
        self.compute(scene_of_phases(PHASES[:1]), ["Phase press/Time/Until=time > 3"])
        self.assertIn("it was never so that time > 3",
                      (self.folder / "run" / "1_press" / "log.txt").read_text())

    def test_each_phase_is_described(self):
        path = self.folder / "scene.prm"
        path.write_text(scene_of_phases(), encoding="utf-8")
        code, out, err = self.attempt("ricochet", (), prm=path, options=["--validate"])
        self.assertEqual(code, 0, msg=err)
        for name, _ in PHASES:
            self.assertIn(f"\nPhase {name}\n", out)
        self.assertEqual(out.count("Contact floor: improved normal compliance"), 1)


if __name__ == "__main__":
    main()
