#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the examples and check the numbers that their files promise.

    examples/check.py                                all of them
    examples/check.py newtons_cradle golf_ball       some of them
    examples/check.py --quick                        the three quickest
    examples/check.py gear_pair --no-run             what is in the output folder already

Prints a table; the exit code is 1 if a number is off or a run fails.
"""

import argparse
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import time
from collections import namedtuple

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path.insert(0, str(ROOT / "python"))

import ricochet  # noqa: E402
GRAVITY = 9.81

# A checked quantity, its value and its bounds; `expected` is the number computed by hand.
Check = namedtuple("Check", "what found low high expected")


def near(what, found, expected, relative):
    """A number that must be that, up to a relative difference."""
    width = relative * abs(expected)
    return Check(what, found, expected - width, expected + width, expected)


def between(what, found, low, high):
    return Check(what, found, low, high, None)


class Run:
    """The ledger of a run: columns by their names without units."""

    def __init__(self, folder):
        with open(pathlib.Path(folder) / "energy.csv", newline="") as file:
            rows = list(csv.reader(file))
        table = np.array([[float(x or "nan") for x in row] for row in rows[1:]])
        self.columns = {name.split(" [")[0]: table[:, i]
                        for i, name in enumerate(rows[0])}

    def __getitem__(self, name):
        return self.columns[name]

    def at(self, name, when):
        """The value of a column at an instant."""
        return float(np.interp(when, self["time"], self[name]))

    def touching(self, contact):
        """From when to when there is a force."""
        on = np.flatnonzero(self[f"contact_force_{contact}"] > 0)
        # The force of a row is that over the step before it.
        return self["time"][on[0] - 1], self["time"][on[-1]]

    def impulse(self, contact, of_step=True):
        """Integral of the force; not of a step but at its end with treatments that
        are springs."""
        force = self[f"contact_force_{contact}"]
        mean = force[1:] if of_step else .5 * (force[1:] + force[:-1])
        return float(np.sum(mean * np.diff(self["time"])))


# The examples --------------------------------------------------------------------------
def colliding_bars(run):
    return [
        near("elastic energy of the left bar at 1 us (J)",
             run.at("elastic_energy_left", 1e-6), 5e-5, .03),
        near("stress at 1 us (Pa)", run.at("left_stress_xx", 1e-6), -1e8, .03),
        near("velocity of the left bar after it (m/s)",
             run["motion_of_left_velocity_x"][-1], -100., .02),
    ]


def chain_of_cylinders(n, radius, young, poisson, density, velocity):
    """Velocities of point masses with the force between cylinders (Johnson, 5.57)."""
    mass = math.pi * radius**2 * density
    force = np.concatenate([[0.], np.logspace(-6, 5, 4000)])
    width = np.sqrt(8. * force * radius / 2. * (1. - poisson**2) / (math.pi * young))
    approach = np.zeros_like(force)
    approach[1:] = (2. * force[1:] * (1. - poisson**2) / (math.pi * young) *
                    (2. * np.log(4. * radius / width[1:]) - 1.))
    x, v = np.zeros(n), np.zeros(n)
    v[0] = velocity
    step = 1e-6

    def acceleration():
        f = np.interp(x[:-1] - x[1:], approach, force, left=0.)
        return (np.append(0., f) - np.append(f, 0.)) / mass

    a = acceleration()
    for _ in range(8000):
        v += .5 * step * a
        x += step * v
        a = acceleration()
        v += .5 * step * a
    return v


def newtons_cradle(run):
    shares = [run[f"momentum_x_disk_{i}"][-1] / run["momentum_x"][0]
              for i in range(1, 6)]
    by_hand = chain_of_cylinders(5, .02, 1e7, .3, 1000., 1.)
    momentum = run["momentum_x"]
    return [
        near("share of the last disk", shares[4], by_hand[4], .01),
        near("share of the one before it", shares[3], by_hand[3], .3),
        near("share of the first, which bounces back", shares[0], by_hand[0], .4),
        between("momentum changes by (of the whole)",
                np.ptp(momentum) / momentum[0], 0., 1e-12),
        between("energy changes by (of the whole)",
                abs(run["energy"][-1] / run["energy"][0] - 1.), 0., 1e-12),
    ]


def rigid_disks(places, radii, masses, velocities, end):
    """Hits of disks that lose nothing: list of (time, i, j), and the velocities."""
    x, v = np.array(places), np.array(velocities)
    hits, now = [], 0.
    while True:
        first = None
        for i in range(len(x)):
            for j in range(i):
                d, w = x[i] - x[j], v[i] - v[j]
                b, c = d @ w, d @ d - (radii[i] + radii[j])**2
                root = b * b - (w @ w) * c
                if b < 0. and root > 0.:
                    t = c / (-b + math.sqrt(root))
                    if first is None or t < first[0]:
                        first = (t, i, j)
        if first is None or now + first[0] > end:
            return hits, v
        t, i, j = first
        x = x + t * v
        now += t
        n = (x[i] - x[j]) / np.linalg.norm(x[i] - x[j])
        push = 2. * n @ (v[i] - v[j]) / (1. / masses[i] + 1. / masses[j])
        v[i] -= push / masses[i] * n
        v[j] += push / masses[j] * n
        hits.append((now, i, j))


def bowling(run):
    names = ["ball"] + [f"pin_{k}" for k in range(1, 11)]
    places = [(-.25, .0635)] + [(row * .3048 * math.sqrt(3.) / 2.,
                                 (row - 2 * j) * .1524)
                                for row in range(4) for j in range(row + 1)]
    radii = [.108] + [.0605] * 10
    masses = [7.] + [1.55] * 10
    hits, _ = rigid_disks(places, radii, masses, [(8., 0.)] + [(0., 0.)] * 10, .1)
    # Velocities after the first hit.
    after = hits[0][0] + .012
    velocity = {name: np.array([run.at(f"momentum_{c}_{name}", after) / m
                                for c in "xy"])
                for name, m in zip(names, masses)}
    head, ball = velocity["pin_1"], velocity["ball"]
    angle = math.asin(.0635 / .1685)
    speed = 2. * 7. / 8.55 * 8. * math.cos(angle)
    ball_after = np.array([8., 0.]) - 1.55 / 7. * speed * np.array(
        [math.cos(angle), -math.sin(angle)])
    # Who was moved in the first 45 ms, in what order.
    moved = sorted((run["time"][np.argmax(run[f"momentum_x_{n}"]**2 +
                                          run[f"momentum_y_{n}"]**2 > 1e-8)], n)
                   for n in names[1:]
                   if np.any(np.abs(run[f"momentum_x_{n}"]) > 1e-4))
    order, by_hand = [], []
    for t, i, j in hits:
        by_hand += [names[k] for k in (i, j) if k > 0 and names[k] not in by_hand]
    order = [n for _, n in moved]
    n_same = 4
    return [
        near("speed of the head pin (m/s)", np.linalg.norm(head), speed, .06),
        near("its direction (degrees)",
             math.degrees(math.atan2(head[1], head[0])), -math.degrees(angle), .1),
        near("speed of the ball after that (m/s)", np.linalg.norm(ball),
             np.linalg.norm(ball_after), .03),
        near("its direction (degrees)", math.degrees(math.atan2(ball[1], ball[0])),
             math.degrees(math.atan2(ball_after[1], ball_after[0])), .15),
        near(f"pins hit first: of {', '.join(by_hand[:n_same])}",
             len(set(order[:n_same]) & set(by_hand[:n_same])), n_same, 0.),
        between("momentum changes by (of the whole)",
                max(np.ptp(run["momentum_x"]), np.ptp(run["momentum_y"])) /
                run["momentum_x"][0], 0., 1e-11),
        between("energy changes by (of the whole)",
                abs(run["energy"][-1] / run["energy"][0] - 1.), 0., 1e-9),
    ]


def belt_with_spring(run):
    omega, belt, drive = 6., .3, .3 * GRAVITY
    t1 = math.asin(belt * omega / drive) / omega
    x1 = drive / omega**2 * (1. - math.cos(omega * t1))
    middle = drive / omega**2
    t2 = t1 + (middle - x1) / belt
    t3 = t2 + 2. * math.pi / omega
    time_, x = run["time"], run["block_displacement_x"]
    by_hand = np.where(time_ < t1, middle * (1. - np.cos(omega * time_)),
                       np.where(time_ < t2, x1 + belt * (time_ - t1),
                                middle + belt / omega *
                                np.sin(omega * (time_ - t2))))
    weight = 10. * GRAVITY
    heat = .3 * weight * (belt * t1 - x1)
    after = time_ > t2
    return [
        near("sticks from (s)",
             time_[np.argmax(run["motion_of_block_velocity_x"] > .998 * belt)], t1, .1),
        near("farthest place (m)", np.max(x), middle + belt / omega, .01),
        near("and back at (m)", np.min(x[after]), middle - belt / omega, .02),
        between("place differs at most by (m)",
                np.max(np.abs(x - by_hand)[time_ < t3]), 0., 1e-3),
        near("friction takes at first (J)", run.at("friction_work", .5 * (t1 + t2)), heat,
             .03),
        near("and then (J)", run.at("friction_work", t3) -
             run.at("friction_work", .5 * (t1 + t2)),
             .3 * weight * belt * 2. * math.pi / omega, .01),
        near("work of the belt, by force and way (J)", run["obstacle_work"][-1],
             -run["contact_work"][-1], 1e-3),
    ]


def suitcase_on_belt(run):
    return [
        near("work of the belt, m v^2 (J)", run["obstacle_work"][-1], 5., .01),
        near("friction takes (J)", run["friction_work"][-1], 2.5, .01),
        near("it slides on the belt by (m)",
             .5 * run["time"][-1] - run["suitcase_displacement_x"][-1],
             .25 / (2. * .3 * GRAVITY), .01),
        near("velocity at the end (m/s)",
             run["motion_of_suitcase_velocity_x"][-1], .5, 1e-3),
    ]


def gear_pair(run):
    t = run["time"]
    motor = np.where(t < .004, 6250. * t**2, 50. * t - .1)
    # A diameter of the hub, turned by half a tooth.
    start = math.pi / 24.
    along = (20. * math.cos(start) + run["right_displacement_x"] -
             run["left_displacement_x"])
    across = (20. * math.sin(start) + run["right_displacement_y"] -
              run["left_displacement_y"])
    gear = np.arctan2(across, along) - start
    on = t > .006
    ratio, offset = np.polyfit(motor[on], gear[on], 1)
    power = np.polyfit(t[on], run["imposed_work"][on], 1)[0]
    loss = np.polyfit(t[on], run["viscous_dissipation"][on], 1)[0]
    speed = 50. * 16. / 24.
    torque = 2. * math.pi * 10.**3 * 5e-4 * speed
    return [
        near("ratio of the angles", ratio, -16. / 24., .003),
        between("they differ from that by (degrees)",
                math.degrees(np.max(np.abs(gear - ratio * motor - offset)[on])),
                0., .1),
        near("power of the motor (N mm/s)", power, torque * speed, .03),
        near("what the brake takes of it", loss / power, 1., .01),
        near("force of the teeth (N)",
             np.mean(run["contact_force_teeth"][on]),
             torque / (24. * math.cos(math.radians(20.))), .04),
        near("force of the axle (N)",
             np.mean(run["contact_force_axle"][on]),
             np.mean(run["contact_force_teeth"][on]), .03),
    ]


def snap_fit(run):
    young, thickness, length, catch = 1300., 2., 30.6, 1.5
    stiffness = 3. * young * thickness**3 / 12. / length**3
    mu, alpha = .3, math.radians(30.)
    share = mu / (math.cos(alpha) * (math.sin(alpha) + mu * math.cos(alpha)))
    elastic, touching = run["elastic_energy"], run["contact_force_edge"] > 0.
    begin = np.argmax(touching) - 1
    half = np.argmax(elastic > .5 * np.max(elastic))
    push = run["imposed_work"] - run["kinetic_energy"] - run["viscous_dissipation"]
    return [
        near("energy of the bent arm (N mm)", np.max(elastic),
             .5 * stiffness * catch**2, .05),
        near("on the front friction takes of the push",
             (run["friction_work"][half] - run["friction_work"][begin]) /
             (push[half] - push[begin]), share, .08),
        near("work of the push (N mm)", run["imposed_work"][-1],
             run["friction_work"][-1] + run["viscous_dissipation"][-1], .001),
        between("energy at the end (N mm)", run["energy"][-1], 0., 1e-4),
        near("the tip is back at its height (mm)",
             run["tip_displacement_y"][-1] + 1., 1., 1e-3),
    ]


def cylinder_squeeze(force, radius, young, poisson):
    """Squeeze of a long cylinder between two plates (Johnson, 5.57)."""
    soft = (1. - poisson**2) / (math.pi * young)
    width = math.sqrt(4. * force * radius * soft)
    return 2. * force * soft * (2. * math.log(4. * radius / width) - 1.)


def seal_in_groove(run):
    t = run["time"]
    way = 1.3325 * (1. - np.cos(math.pi * t / .02)) / 2.
    squeeze = way - run["penetration_groove"] - run["penetration_lid"]
    checks = []
    for percent in (3., 6., 10.):
        i = int(np.argmin(np.abs(squeeze / 5.33 - percent / 100.)))
        by_hand = cylinder_squeeze(run["contact_force_lid"][i], 2.665, 4., .49)
        checks.append(near(f"squeeze by {run['contact_force_lid'][i]:.3f} N/mm (mm)",
                           squeeze[i], by_hand, .06))
    last = run["contact_force_lid"][-1]
    walls = int(np.argmax(run["contact_force_walls"] > 0.))
    return checks + [
        near("force of the groove over that of the lid",
             run["contact_force_groove"][-1] / last, 1., .005),
        between("touches the walls at the squeeze (%)",
                100. * squeeze[walls] / 5.33,
                *(100. * squeezes for squeezes in wall_squeezes())),
        near("work of the lid (N mm)", run["obstacle_work"][-1],
             run["modified_energy"][-1], .005),
    ]


def wall_squeezes(diameter=5.33, groove=6.2):
    """Squeezes at which a section that keeps its area fills the groove: with half
    circles at its sides, and as a rectangle. The truth is in between."""
    area = math.pi * diameter**2 / 4.
    # h (groove - h) + pi h^2/4 = area
    c = 1. - math.pi / 4.
    height = (groove - math.sqrt(groove**2 - 4. * c * area)) / (2. * c)
    return 1. - height / diameter, 1. - area / groove / diameter


def golf_ball(run):
    mass = run["momentum_z"][0] / -67.
    begin, end = run.touching("wall")
    after = run["motion_of_ball_velocity_z"][-1]
    force = np.max(run["contact_force_wall"])
    modulus = 1e8 / (1. - .45**2)
    hertz = 2.868 * (mass**2 / (.02135 * modulus**2 * 67.))**.2
    shortest = .0427 + np.min(run["rear_displacement_z"] -
                              run["front_displacement_z"])
    return [
        near("mass (kg)", mass, .0459, .02),
        between("restitution", after / 67., .65, .75),
        between("touches for (ms)", 1e3 * (end - begin), .35, .5),
        between("the same over Hertz's duration", (end - begin) / hertz, .8, 1.),
        near("impulse of the wall (N s)", run.impulse("wall", of_step=False),
             mass * (67. + after), .005),
        near("largest force over the mean",
             force / (mass * (67. + after) / (end - begin)), 1.84, .06),
        between("shortest diameter (mm)", 1e3 * shortest, 28., 36.),
    ]


def box_on_its_corner(run):
    phase = run["phase"]
    fall, hit = np.flatnonzero(phase == 2), np.flatnonzero(phase == 3)
    squeezed = fall[0] - 1
    momentum, time = run["momentum_z"], run["time"]
    mass = -momentum[fall[-1]] / (GRAVITY * (time[fall[-1]] - time[fall[0]]))
    speed = -momentum[fall[-1]] / mass
    fallen = run["box_displacement_z"][fall[0]] - run["box_displacement_z"][fall[-1]]
    force = run["contact_force_floor"][hit]
    on = time[hit][1:][force[1:] > 0]
    push = run["impulse_z_floor"][-1]
    return [
        near("mass (kg)", mass, .482, .04),
        near("work of the vice over what is stored",
             (run["imposed_work"][squeezed] + run["external_work"][squeezed]) /
             run["elastic_energy"][squeezed], 1., .005),
        between("energy by letting go (J)", float(np.max(abs(run["phase_change"]))), 0., 1e-12),
        near("meets the floor with sqrt(2 g h) (m/s)", speed, math.sqrt(2. * GRAVITY * fallen), 1e-3),
        near("push of the floor (N s)", push,
             momentum[-1] - momentum[fall[-1]] + mass * GRAVITY * (time[-1] - time[fall[-1]]), 1e-9),
        between("largest force over the mean", np.max(force) / (push / (on[-1] - on[0])), 1.57, 2.),
        between("largest force in weights", np.max(force) / (mass * GRAVITY), 60., 90.),
    ]


def hollow_ball(run):
    mass = run["momentum_z"][0] / -.6
    stiffness = (4. * 3e6 * .004**2 /
                 (.028 * math.sqrt(3. * (1. - .45**2))))
    begin, end = run.touching("floor")
    after = run["motion_of_ball_velocity_z"][-1]
    return [
        near("mass (kg)", mass, 4. / 3. * math.pi * (.03**3 - .026**3) * 1100., .04),
        near("touches for (ms)", 1e3 * (end - begin),
             1e3 * math.pi * math.sqrt(mass / stiffness), .08),
        near("largest force (N)", np.max(run["contact_force_floor"]),
             .6 * math.sqrt(stiffness * mass), .15),
        near("impulse of the floor (N s)", run.impulse("floor"), mass * (.6 + after),
             1e-6),
        between("restitution", after / .6, .97, 1.),
        between("energy changes by (of the whole)",
                abs(run["energy"][-1] / run["energy"][0] - 1.), 0., 1e-10),
    ]


def thrusts(thickness, n=9, points=721):
    """The thrusts in the keystone that keep the resultant within all joints of an arch of mean
    radius 1, and the weight of a stone: (smallest, largest) over the weight of the arch; None if
    there are none."""
    inner, outer = 1. - thickness / 2., 1. + thickness / 2.
    step = math.pi / n
    # Middle of mass of a sector.
    middle = (2. / 3. * (outer**3 - inner**3) / (outer**2 - inner**2) *
              math.sin(step / 2.) / (step / 2.))
    bounds = []
    for top in np.linspace(inner, outer, points):
        # Through the crown at this height, the resultant at the joint k has the weight
        # of the half keystone and of k stones; lever arms about the joint's ends.
        low, high = 0., math.inf
        for k in range(n // 2 + 1):
            phi = math.pi / 2. - (k + .5) * step
            weight, moment = 0., 0.
            half = step / 2.
            w = .5 / n
            x = (2. / 3. * (outer**3 - inner**3) / (outer**2 - inner**2) *
                 math.sin(half / 2.) / (half / 2.) * math.sin(half / 2.))
            weight += w
            moment += w * x
            for i in range(1, k + 1):
                weight += 1. / n
                moment += middle * math.sin(i * step) / n
            # The resultant crosses the joint between its ends: about the inner one it
            # presses outwards, about the outer one inwards.
            for radius, sign in ((inner, 1.), (outer, -1.)):
                px, py = radius * math.cos(phi), radius * math.sin(phi)
                # Moment about the end: H (top - py) - weight px + moment.
                lever, rest = top - py, weight * px - moment
                if sign > 0.:
                    # above the inner end: H lever >= rest
                    if lever > 0.:
                        low = max(low, rest / lever)
                    elif rest > 0.:
                        low = math.inf
                elif lever > 0.:
                    high = min(high, rest / lever)
                elif rest < 0.:
                    low = math.inf
                elif lever < 0.:
                    low = max(low, rest / lever)
        if low <= high:
            bounds.append((low, high))
    if not bounds:
        return None
    return min(b[0] for b in bounds), max(b[1] for b in bounds)


def thinnest_arch():
    low, high = .02, .3
    while high - low > 1e-4:
        middle = .5 * (low + high)
        if thrusts(middle):
            high = middle
        else:
            low = middle
    return high


def stone_weight(thickness):
    # Straight sides instead of arcs.
    inner, outer = 1. - thickness / 2., 1. + thickness / 2.
    return (outer**2 - inner**2) * math.sin(math.pi / 9.) / 2. * 2000. * GRAVITY


def arch(run):
    weight = stone_weight(.18)
    smallest, largest = thrusts(.18)
    late = run["time"] > .3
    thrust = []
    for k in range(4):
        phi = (k + 1) * math.pi / 9.
        normal = np.mean(run[f"contact_force_{k + 1}_and_{k + 2}"][late])
        # All weight above the joint, on this side of the crown.
        above = (3.5 - k) * weight
        thrust.append((normal - above * math.cos(phi)) / math.sin(phi))
    feet = [np.mean(run[f"contact_force_{side}_foot"][late])
            for side in ("left", "right")]
    return [
        near("force of the left foot (N)", feet[0], 4.5 * weight, .005),
        near("force of the right foot (N)", feet[1], 4.5 * weight, .005),
        between("thrust in the keystone (N)", thrust[-1], 9. * weight * smallest,
                9. * weight * largest),
        near("thrust told by the lowest joint (N)", thrust[0], thrust[-1], .02),
        near("thrust told by the second joint (N)", thrust[1], thrust[-1], .02),
        between("the keystone sinks by (mm)",
                -1e3 * run["keystone_displacement_y"][-1], 0., 2.),
        between("needs a thickness of (m)", thinnest_arch(), .06, .18),
    ]


def arch_too_thin(run):
    return [
        between("the keystone sinks by (mm)",
                -1e3 * run["keystone_displacement_y"][-1], 100., math.inf),
        between("needs a thickness of (m)", thinnest_arch(), .06, .18),
    ]


def tyre_over_kerb(run):
    mass = run["momentum_x_tyre"][0] / 1.5
    radius, height = .3, .05
    k = (1. + (.18 / .3)**2) / 2.
    keeps = (radius * (1. + k) - height) / (radius * (1. + k))
    no_loss = math.sqrt(1.5**2 - 2. * GRAVITY * height / (1. + k))
    after = math.sqrt((keeps * 1.5)**2 - 2. * GRAVITY * height / (1. + k))
    t = run["time"]
    x, y = (run[f"tyre_displacement_{c}"] + s for c, s in (("x", -.15), ("y", .3)))
    vx, vy = (run[f"motion_of_tyre_velocity_{c}"] for c in "xy")
    spin = ((run["angular_momentum_tyre"] - mass * (x * vy - y * vx)) /
            (k * mass * radius**2))
    late, early = t > .7, (t > .05) & (t < .18)
    rise = run["tyre_displacement_y"][-1]
    return [
        near("rolls before: omega R/v", np.mean(-spin[early] * radius) /
             np.mean(vx[early]), 1., .04),
        near("rolls on the kerb: omega R/v",
             np.mean(-spin[late] * radius) / np.mean(vx[late]), 1., .04),
        near("lies higher by (m)", np.mean(y[late]) - np.mean(y[early]), height, .06),
        near("work of gravity over - m g rise",
             run["external_work"][-1] / (-mass * GRAVITY * rise), 1., 1e-3),
        near("velocity on the kerb, rigid wheel (m/s)", np.mean(vx[late]), after, .1),
        between("the same (m/s)", np.mean(vx[late]), 0., no_loss),
        between("friction takes of what is lost",
                run["friction_work"][-1] /
                (run["energy"][0] - run["energy"][-1] + run["external_work"][-1]),
                0., .03),
    ]


def falls_onto_next(height, thickness, space, spin, step=1e-6):
    """Time and speed of turning of a rigid block about its lower edge when it meets
    the next one."""
    angle, now = 0., 0.
    inertia = (height**2 + thickness**2) / 3.  # per mass
    while height * math.sin(angle) < space:
        # Lever of the weight: the middle, from the edge.
        lever = (.5 * height * math.sin(angle + .5 * step * spin) -
                 .5 * thickness * math.cos(angle + .5 * step * spin))
        spin += step * GRAVITY * lever / inertia
        angle += step * spin
        now += step
    return now, spin


def dominoes(run):
    height, thickness, space, n = .048, .0075, .0175, 7
    t = run["time"]
    tilts = [np.arctan2(run[f"head_{i}_displacement_x"] - run[f"foot_{i}_displacement_x"],
                        height + run[f"head_{i}_displacement_y"] -
                        run[f"foot_{i}_displacement_y"]) for i in range(1, n + 1)]
    hits = [int(np.argmax(run[f"contact_force_{i}_and_{i + 1}"] > 0.)) for i in range(1, n)]
    by_hand, spin = falls_onto_next(height, thickness, space, 6.)
    angle = math.asin(space / height)
    between_hits = np.diff(t[hits])
    mass = 1400. * height * thickness
    # Centre of a block that keeps its shape: the mean of opposite corners, where the left foot is
    # by the thickness beside the right one.
    sinks = sum(.5 * (run[f"head_{i}_displacement_y"][-1] +
                      run[f"foot_{i}_displacement_y"][-1] +
                      thickness * math.sin(tilt[-1])) for i, tilt in
                enumerate(tilts, start=1))
    return [
        near("the first meets the second after (s)", t[hits[0]], by_hand, .05),
        near("it turns then with (rad/s)",
             (tilts[0][hits[0] - 2] - tilts[0][hits[0] - 6]) / (4. * (t[1] - t[0])),
             spin, .08),
        near("it is tilted then by (degrees)", math.degrees(tilts[0][hits[0]]),
             math.degrees(angle), .05),
        near("the fourth, when it meets the fifth (degrees)",
             math.degrees(tilts[3][hits[3]]), math.degrees(angle), .05),
        between("they meet in order, at least apart by (s)", np.min(between_hits), .005,
                .1),
        between("last time between hits over the first",
                between_hits[-1] / between_hits[0], .2, 1.),
        near("work of gravity (J)", run["external_work"][-1], -mass * GRAVITY * sinks,
             .005),
    ]


def stretched_cube(stretch, shear, lame):
    """Force and energy of a unit cube of neo-Hookean material, first if it is free to
    get wider, then if it is not."""
    def force(side):
        return (shear * (stretch - 1. / stretch) +
                lame * math.log(stretch * side**2) / stretch)

    def energy(side):
        log_j = math.log(stretch * side**2)
        return (.5 * shear * (stretch**2 + 2. * side**2 - 3.) - shear * log_j +
                .5 * lame * log_j**2)

    low, high = 1., 2.
    for _ in range(60):
        side = .5 * (low + high)
        across = shear * (side**2 - 1.) + lame * math.log(stretch * side**2)
        low, high = (side, high) if across < 0. else (low, side)
    return [(-force(x), energy(x)) for x in (side, 1.)]


def twisted_cubes(run):
    free, held = stretched_cube(.97, 10., 10. / 3.)
    force, energy = run["contact_force_joint"], run["energy"]
    points = run["active_points_joint"]
    half = int(np.argmin(abs(run["time"] - 13.)))
    return [
        between("force when it has been pressed", run.at("contact_force_joint", 5.),
                .98 * free[0], held[0]),
        between("and when it has been turned by 90 degrees", force[-1],
                .98 * free[0], held[0]),
        between("stored when it has been pressed", run.at("elastic_energy_upper", 4.) +
                run.at("elastic_energy_lower", 4.), 2. * .98 * free[1], 2. * held[1]),
        near("energy at 90 degrees over that at 0", energy[-1] / run.at("energy", 4.), 1.,
             .005),
        # Points count in part until half a facet of theirs is beyond an edge: of eight facets
        # along an edge that is up to an eighth.
        near("part that touches at 45 degrees", points[half] / points[4],
             2. * (math.sqrt(2.) - 1.), .125),
        near("part that touches at 90 degrees", points[-1] / points[4], 1., 0.),
        # Against that of the upper one in the middle of the turn.
        between("spin of the lower cube over that of the upper one",
                np.max(np.abs(run["angular_momentum_z_lower"])) /
                run["angular_momentum_z_upper"][half], 0., .1),
    ]


def ball_on_block(run):
    modulus = 9. * 10. * .25 / (3. * 10. + .25)
    poisson = .5 * (3. * 10. - 2. * .25) / (3. * 10. + .25)
    hertz = 4. / 3. * modulus / (2. * (1. - poisson**2)) * math.sqrt(.5) * .06**1.5
    mass, omega = .51455, math.pi / 20.
    force = run["contact_force_sole"]
    return [
        near("force when it has been pressed", np.mean(force[6:9]), hertz, .1),
        near("and when it has been turned by 90 degrees", force[-1], hertz, .1),
        near("angular momentum in the middle of the turn",
             run.at("angular_momentum_z_ball", 13.), .4 * mass * .25 * omega, .08),
        between("that of the block over it",
                np.max(np.abs(run["angular_momentum_z_block"])) /
                (.4 * mass * .25 * omega), 0., .05),
    ]


# Names, and whether they are quick.
EXAMPLES = {
    "suitcase_on_belt": (suitcase_on_belt, True),
    "belt_with_spring": (belt_with_spring, True),
    "arch": (arch, True),
    "arch_too_thin": (arch_too_thin, False),
    "colliding_bars": (colliding_bars, False),
    "tyre_over_kerb": (tyre_over_kerb, False),
    "hollow_ball": (hollow_ball, False),
    "snap_fit": (snap_fit, False),
    "bowling": (bowling, False),
    "newtons_cradle": (newtons_cradle, False),
    "seal_in_groove": (seal_in_groove, False),
    "dominoes": (dominoes, False),
    "golf_ball": (golf_ball, False),
    "box_on_its_corner": (box_on_its_corner, False),
    "gear_pair": (gear_pair, False),
    "twisted_cubes": (twisted_cubes, False),
    "ball_on_block": (ball_on_block, False),
}


# Running and checking ------------------------------------------------------------------
def run_file(file, programs, folder, settings=()):
    """Run a parameter file into the folder, without a terminal's checks for root and with one
    thread; returns what it has printed and its exit code."""
    for variable in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                     "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(variable, "1")
    command = [str(pathlib.Path(programs) / "ricochet"), str(file), "--output-dir", str(folder),
               "--overwrite"]
    for setting in settings:
        command += ["--set", setting]
    return subprocess.run(command, capture_output=True, text=True)


def run_example(name, programs, folder):
    """Run it into the folder; returns seconds. Raises RuntimeError if it fails."""
    begin = time.monotonic()
    result = run_file(HERE / f"{name}.prm", programs, folder)
    # An open balance or promise is a number that is off, among the others.
    if result.returncode not in (0, 4):
        raise RuntimeError(f"{name} ended with exit code {result.returncode}:\n"
                           f"{result.stderr}")
    return time.monotonic() - begin


def checks_of(name, folder):
    """All numbers of an example, the balance first."""
    run = Run(folder)
    # The run itself accounts for round-off, at the start of bodies at rest.
    n_open = len(ricochet.Run(folder).open_lines)
    return ([between("open balances and promises", float(n_open), 0., 0.)] +
            EXAMPLES[name][0](run))


def is_good(check):
    return check.low <= check.found <= check.high


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all")
    parser.add_argument("--programs", default=ROOT / "build" / "release",
                        type=pathlib.Path, help="folder of the built programs")
    parser.add_argument("--output", default=ROOT / "output" / "examples",
                        type=pathlib.Path, help="folder for the runs")
    parser.add_argument("--quick", action="store_true",
                        help="only the quickest examples")
    parser.add_argument("--no-run", action="store_true",
                        help="check what has been run before")
    options = parser.parse_args()
    names = options.names or [name for name, (_, quick) in EXAMPLES.items()
                              if quick or not options.quick]
    for name in names:
        if re.sub(r"\.prm$", "", pathlib.Path(name).name) not in EXAMPLES:
            parser.error(f"there is no example '{name}'. There are: " +
                         ", ".join(EXAMPLES))
    n_bad = 0
    for name in names:
        name = re.sub(r"\.prm$", "", pathlib.Path(name).name)
        folder = options.output / name
        try:
            seconds = None
            if not options.no_run:
                seconds = run_example(name, options.programs, folder)
            checks = checks_of(name, folder)
        except (OSError, RuntimeError, KeyError) as error:
            n_bad += 1
            print(f"{name}: {error}")
            continue
        print(name + (f", {seconds:.1f} s" if seconds is not None else ""))
        for check in checks:
            good = is_good(check)
            n_bad += not good
            expected = (f"{check.expected:11.5g}" if check.expected is not None
                        else " " * 11)
            print(f"  {'ok ' if good else 'BAD'} {check.what:48s} {check.found:11.5g}"
                  f"  by hand {expected}  must be in [{check.low:.5g}, "
                  f"{check.high:.5g}]", flush=True)
    print(f"{n_bad} numbers are off." if n_bad else "All numbers are as they must be.")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
