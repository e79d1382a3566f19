# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bad input: a clear sentence, a non-zero exit code, and no time spent."""

import re
import time

from common import *


class Refusal(ProgramTest):

    def refuse(self, *messages, program="bar_sd", exit_code=1, **kwargs):
        start = time.monotonic()
        code, out, error = self.attempt(program, **kwargs)
        text = " ".join(error.split())
        self.assertEqual(code, exit_code, msg=out + error)
        for message in messages:
            self.assertIn(message, text)
        # No stack trace, no name of a C++ function, one screen, and before
        # anything is computed.
        for noise in ("Stacktrace", "dealii::", "terminate called", "violated"):
            self.assertNotIn(noise, error)
        self.assertLess(len(error.splitlines()), 24)
        self.assertLess(time.monotonic() - start, 20)
        return error

    def write(self, text):
        file = self.folder / "given.prm"
        file.write_text(text)
        return file


class BadInput(Refusal):

    def test_missing_file(self):
        self.refuse("the parameter file 'no-such.prm' does not exist",
                    prm="no-such.prm")

    def test_missing_included_file(self):
        self.refuse("line 2: the parameter file",
                    "nowhere.prm' does not exist",
                    prm=self.write("# a comment\ninclude nowhere.prm\n"))

    def test_file_that_includes_itself(self):
        self.refuse("includes itself", prm=self.write("include given.prm\n"))

    def test_unknown_parameter_with_line_and_suggestion(self):
        self.refuse("line 3: there is no parameter 'Time/Time setp'",
                    "Time/Time step",
                    prm=self.write("# a typo\nsubsection Time\n"
                                   "  set Time setp = 0.05\nend\n"))

    def test_right_name_in_wrong_section(self):
        self.refuse("there is no parameter 'Contact/Time step'",
                    "The nearest valid names are: Time/Time step",
                    parameters=["Contact/Time step=0.1"])

    def test_unclosed_subsection(self):
        self.refuse("never closed with 'end'",
                    prm=self.write("subsection Time\n set Time step = 0.05\n"))

    def test_nonsense_line(self):
        self.refuse("line 1: cannot make sense of 'Time step: 0.05'",
                    prm=self.write("Time step: 0.05\n"))

    def test_value_out_of_range(self):
        self.refuse("line 2: the value '0.7' of 'Time/HHT alpha' is not allowed",
                    prm=self.write("subsection Time\nset HHT alpha = 0.7\nend\n"))

    def test_value_that_is_no_number(self):
        self.refuse("the value 'fast' of 'Time/Time step' is not allowed",
                    parameters=["Time/Time step=fast"])

    def test_negative_time_step(self):
        self.refuse("the value '-0.05' of 'Time/Time step' is not allowed",
                    parameters=["Time/Time step=-0.05"])

    def test_negative_integer(self):
        self.refuse("the value '-1' of 'Newton/Maximum iterations'",
                    parameters=["Newton/Maximum iterations=-1"])

    def test_mesh_size_that_does_not_divide_the_bar(self):
        self.refuse("The mesh size 0.3 does not divide the bar of length 1",
                    "1/3 and 1/4", parameters=["Mesh/Mesh size=0.3"])

    def test_hybrid_operator_with_tr_bdf2(self):
        self.refuse("'Nitsche-hybrid'", "cannot be combined with the time "
                    "scheme 'TR-BDF2'", "Allowed with them: midpoint.",
                    parameters=["Contact/Treatment=Nitsche-hybrid",
                                "Time/Scheme=TR-BDF2"])

    def test_arkode_with_constraints(self):
        self.refuse("cannot be combined with the time scheme 'ARKODE'",
                    "Crank-Nicolson, HHT, generalised-alpha, Newmark, TR-BDF2, BDF2, midpoint, static.",
                    parameters=["Contact/Treatment=Signorini active set",
                                "Time/Scheme=ARKODE"])

    def test_arkode_without_inertia(self):
        self.refuse("redistributed mass cannot be combined",
                    parameters=["Time/Mass=redistributed",
                                "Time/Scheme=ARKODE"])

    def test_multipliers_in_nodes_with_degree_two(self):
        self.refuse("Multipliers in the nodes need displacements of degree 1",
                    parameters=["Mesh/Degree=2",
                                "Contact/Treatment=Signorini multipliers"])

    def test_too_coarse_for_redistributed_mass(self):
        self.refuse("The mass cannot be redistributed",
                    parameters=["Mesh/Mesh size=0.5",
                                "Time/Mass=redistributed"], program="bar_ss")

    def test_nitsche_below_its_bound_of_stability(self):
        self.refuse("It must be larger than 9",
                    parameters=["Mesh/Degree=3"])
        self.refuse("It must be larger than 1",
                    parameters=["Contact/Nitsche gamma0=1"])
        # The skew-symmetric method has no bound.
        code, _, error = self.attempt(
            "bar_sd", ["Mesh/Degree=3", "Contact/Nitsche theta=-1"],
            options=["--validate"])
        self.assertEqual(code, 0, msg=error)

    def test_unwritable_output_folder(self):
        blocker = self.folder / "file"
        blocker.write_text("")
        self.refuse("The output folder", "cannot be written to",
                    folder=blocker / "below")

    def test_unknown_option(self):
        self.refuse("There is no option '--resum'. Is '--resume' meant?",
                    options=["--resum"])

    def test_option_in_the_place_of_a_value(self):
        self.refuse("--set needs a value after it, not '--resume'",
                    options=["--set", "--resume"])

    def test_too_many_steps(self):
        self.refuse("is more than 1e8 time steps",
                    parameters=["Time/Final time=1e10"])

    def test_assignment_without_value(self):
        self.refuse("Expected the form", parameters=["Time/Time step"])

    def test_validate_says_so_and_computes_nothing(self):
        code, out, _ = self.attempt("bar_ss", options=["--validate"])
        self.assertEqual(code, 0)
        self.assertIn("The parameters are valid.", out)
        self.assertFalse((self.folder / "run").exists())

    def test_printed_parameters_can_be_read_again(self):
        code, out, _ = self.attempt("bar_sd", ["Time/Time step=0.025"],
                                    options=["--print-parameters"])
        self.assertEqual(code, 0)
        self.assertIn("Length of a step (s)", out)
        code, again, error = self.attempt("bar_sd", prm=self.write(out),
                                          options=["--print-parameters"])
        self.assertEqual(code, 0, msg=error)
        self.assertEqual(again, out)


class BadSettings(Refusal):
    """Settings without meaning, or without notice."""

    def test_forms_of_set(self):
        for text in ("=1", "/Time/Time step=0.1", "Time//Time step=0.1", "=",
                     "Time/=1", " =1", "Time", ""):
            with self.subTest(text):
                self.refuse("--set", parameters=[text])

    def test_empty_file_name(self):
        self.refuse("The name of the parameter file is empty", prm="")

    def test_a_file_that_never_ends(self):
        self.refuse("is larger than", prm="/dev/zero")

    def test_a_file_that_cannot_be_read_to_its_end(self):
        self.refuse("cannot be read", prm="/proc/self/mem")

    def test_a_file_with_a_mark_of_its_encoding(self):
        file = self.write("")
        file.write_bytes(b"\xef\xbb\xbfsubsection Time\r\n  set Final time = 1"
                         b"\r\nend\r\n")
        code, _, error = self.attempt("bar_sd", prm=file, options=["--validate"])
        self.assertEqual(code, 0, msg=error)

    def test_output_that_cannot_be_written(self):
        for option in ("--print-parameters", "--help", "--version"):
            with open("/dev/full", "w") as full:
                result = subprocess.run([program_path("bar_sd"), option],
                                        stdout=full, stderr=subprocess.PIPE,
                                        text=True)
            self.assertEqual(result.returncode, 2, msg=result.stderr)
            self.assertIn("standard output cannot be written", result.stderr)

    def test_parameters_without_effect(self):
        for program, parameters, message in (
                ("bar_sd", ["Time/HHT alpha=0.1"],
                 "belongs to the time scheme HHT; Time/Scheme is Crank-Nicolson"),
                ("bar_sd", ["Contact/Penalty epsilon0=1"],
                 "belongs to penalty; Contact/Treatment is Nitsche"),
                ("elastic_ball", ["Material/c1=1"],
                 "belongs to the law Ciarlet-Geymonat"),
                ("hyperelastic_ring", ["Material/Young modulus=1e6"],
                 "belongs to the other laws"),
                ("elastic_ball", ["Contact/Tangential compliance=1"],
                 "Contact/Friction coefficient is 0"),
                ("sphere", [f"Mesh/File={ROOT / 'meshes' / 'sphere_h4.msh'}",
                            "Mesh/Mesh size=3"], "belongs to meshes that are made")):
            self.refuse("has no effect", message, program=program,
                        parameters=parameters)
        # With what it belongs to, or at its default, it is fine.
        for parameters in (["Time/HHT alpha=0.1", "Time/Scheme=HHT"],
                           ["Time/HHT alpha=0.05"]):
            code, _, error = self.attempt("bar_sd", parameters,
                                          options=["--validate"])
            self.assertEqual(code, 0, msg=error)
        # A file may set parameters without effect; a note is printed.
        code, out, error = self.attempt(
            "bar_sd", options=["--validate"],
            prm=self.write("subsection Time\nset HHT alpha = 0.1\nend\n"))
        self.assertEqual(code, 0, msg=error)
        self.assertIn("given.prm, line 2: 'Time/HHT alpha' is set to '0.1' and "
                      "has no effect", out)

    def test_the_file_of_another_program(self):
        self.refuse("this file is for the program 'hyperelastic_ring', not for "
                    "'bar_sd'",
                    prm=ROOT / "parameter_files/hyperelastic_ring/default.prm")

    def test_a_step_longer_than_the_run(self):
        self.refuse("The time step 0.5 is longer than the whole run of 0.1",
                    parameters=["Time/Time step=0.5", "Time/Final time=0.1"])

    def test_sizes_beyond_memory(self):
        for program, parameters in (
                ("bar_sd", ["Time/Final time=1e30", "Time/Time step=1e29"]),
                ("elastic_ball", ["Mesh/Nodes=2147483647"]),
                ("hyperelastic_ring", ["Mesh/Nodes around=65536",
                                       "Mesh/Nodes across=65536"]),
                ("sphere", ["Mesh/Mesh size=0.1"])):
            self.refuse("GB of memory", "unknowns", "Limits/Memory",
                        program=program, parameters=parameters)
        # The limit can be set.
        self.refuse("0.001 GB are allowed", program="elastic_ball",
                    parameters=["Limits/Memory=0.001"])

    def test_nitsche_below_its_bound_on_any_mesh(self):
        """Default 5 Pa against a body of 10 GPa, and the ball at half its bound."""
        ball = BALL + ["Contact/Treatment=Nitsche", "Material/Plane state=plane strain"]
        error = self.refuse("Contact/Nitsche gamma0 = 5 is too small",
                            "It must be larger than", program="elastic_ball",
                            parameters=ball + ["Contact/Nitsche gamma0=5"])
        bound = float(re.search(r"larger than ([0-9.e+]+)\.", error).group(1))
        # For constant strains h^2/area times a modulus: some GPa times a few.
        self.assertGreater(bound, 1.6e10)
        self.assertLess(bound, 2e11)
        self.refuse("is too small", program="elastic_ball",
                    parameters=ball + [f"Contact/Nitsche gamma0={.99 * bound}"])
        code, _, error = self.attempt(
            "elastic_ball", ball + NO_FIELDS +
            [f"Contact/Nitsche gamma0={1.01 * bound}", "Time/Final time=2e-3"])
        self.assertEqual(code, 0, msg=error)
        self.refuse("is too small", program="sphere", folder=self.folder / "sphere",
                    parameters=["Mesh/Mesh size=10", "Contact/Nitsche gamma0=10"])


class FailureWhileRunning(ProgramTest):

    def test_the_run_stops_with_all_results(self):
        """With one iteration allowed and no halving, some step in contact
        cannot be made. (The run starts in free flight, which takes one.)"""
        parameters = ["Newton/Maximum iterations=1", "Time/Maximum halvings=0"]
        code, _, error = self.attempt("bar_sd", parameters)
        self.assertEqual(code, 2)
        self.assertIn("after 0 halvings", error)
        self.assertIn("relative residual", error)
        self.assertIn("1 of 1", error)
        self.assertIn("All results up to then are in the output folder", error)
        ledger = Ledger(self.folder / "run")
        n_steps = len(ledger["time"]) - 1
        self.assertGreater(n_steps, 15)
        self.assertLess(n_steps, 240)
        self.assertAlmostEqual(ledger["time"][-1], .05 * n_steps)
        run = self.folder / "run"
        self.assertTrue((run / "energy.h5").exists())
        self.assertTrue((run / "solution" / f"step-{n_steps:06d}.vtu").exists())

        # The checkpoint is whole: resumed, the run stops at the same place.
        text = (run / "energy.csv").read_text()
        code, _, again = self.attempt("bar_sd", parameters, options=["--resume"])
        self.assertEqual(code, 2)
        self.assertEqual(again, error)
        self.assertEqual((run / "energy.csv").read_text(), text)

        # With more patience it goes on to the end.
        code, _, again = self.attempt("bar_sd", options=["--resume"])
        self.assertEqual(code, 0, msg=again)
        self.assertEqual(len(Ledger(run)["time"]), 241)

    def test_halved_steps_are_counted_and_close_their_balance(self):
        """Halving helps where one iteration is not enough."""
        ledger = self.run_program(
            "bar_sd", NO_FIELDS + ["Newton/Maximum iterations=1",
                                   "Time/Maximum halvings=8"])
        self.assertGreater(ledger["step_halvings"][-1], 0)
        self.assertLess(max(map(abs, ledger["balance_residual"])), 1e-11)
        self.assertEqual(len(ledger["time"]), 241)



class BadThrownBodies(Refusal):
    """Papers A and B: combinations without meaning, and one with a meaning."""

    def refuse_ball(self, *messages, parameters):
        self.refuse(*messages, program="elastic_ball", parameters=parameters)

    def refuse_ring(self, *messages, parameters):
        self.refuse(*messages, program="hyperelastic_ring",
                    parameters=parameters)

    def test_exponent_below_two(self):
        self.refuse_ball("exponent alpha of normal compliance must be at least "
                         "2", "it is 1.5",
                         parameters=["Contact/Compliance exponent=1.5"])

    def test_negative_friction(self):
        self.refuse_ball("friction coefficient must not be negative; it is -0.1",
                         parameters=["Contact/Friction coefficient=-0.1"])

    def test_friction_without_compliance(self):
        self.refuse_ball("tangential compliance must be positive",
                         parameters=["Contact/Friction coefficient=0.1",
                                     "Contact/Tangential compliance=0"])
        # Exact friction needs none.
        code, _, error = self.attempt(
            "elastic_ball", ["Contact/Friction coefficient=0.1",
                             "Contact/Treatment=persistent contact"],
            prm=self.write("subsection Contact\n"
                           "set Tangential compliance = 0\nend\n"),
            options=["--validate"])
        self.assertEqual(code, 0, msg=error)

    def test_two_point_law_with_another_scheme(self):
        for treatment in ("improved normal compliance", "persistent contact",
                          "Hauret-Le Tallec", "Ayyad-Barboteu two-step"):
            self.refuse_ball(f"The contact treatment '{treatment}'",
                             "cannot be combined with the time scheme "
                             "'TR-BDF2'", "Allowed with them: midpoint.",
                             parameters=["Time/Scheme=TR-BDF2",
                                         f"Contact/Treatment={treatment}"])

    def test_friction_with_another_scheme(self):
        self.refuse_ball("Friction cannot be combined with the time scheme "
                         "'ARKODE'", "Allowed with it: Crank-Nicolson, HHT, "
                         "generalised-alpha, Newmark, TR-BDF2, BDF2, midpoint",
                         parameters=["Time/Scheme=ARKODE",
                                     "Contact/Treatment=penalty",
                                     "Contact/Friction coefficient=0.1"])
        for name, parameters in (("Friction", ["Contact/Friction coefficient=0.1"]),
                                 ("Viscosity", ["Material/Viscosity=linear",
                                                "Material/Viscosity eta=1e6"])):
            self.refuse_ball(f"{name} and the redistributed mass cannot be combined "
                             "with the time scheme 'HHT'",
                             "Allowed with them: midpoint; or the consistent mass",
                             parameters=["Time/Scheme=HHT",
                                         "Time/Mass=redistributed",
                                         "Contact/Treatment=Signorini active set",
                                         *parameters])

    def test_nitsche_with_a_hyperelastic_body(self):
        self.refuse_ring("'Nitsche' uses the stress of a linear elastic body",
                         "Allowed with it: penalty",
                         parameters=["Contact/Treatment=Nitsche"])

    def test_viscosity(self):
        self.refuse_ball("The viscosity 'Curnier' does not go with the law "
                         "'linear elastic'", "Allowed with it: none, linear",
                         parameters=["Material/Viscosity=Curnier"])
        self.refuse_ring("The viscosity 'linear' does not go with the law",
                         "none, Curnier, Pioletti",
                         parameters=["Material/Viscosity=linear"])
        self.refuse_ring("Viscosity eta is 3 and Material/Viscosity is none",
                         parameters=["Material/Viscosity eta=3"])
        self.refuse_ring("Viscosity cannot be combined with the time scheme "
                         "'ARKODE'",
                         parameters=["Material/Viscosity=Pioletti",
                                     "Material/Viscosity eta=3",
                                     "Time/Scheme=ARKODE",
                                     "Contact/Treatment=penalty"])

    def test_damping_by_mass(self):
        self.refuse_ring("Damping cannot be combined with the time scheme 'ARKODE'",
                         parameters=["Material/Mass damping=3", "Time/Scheme=ARKODE",
                                     "Contact/Treatment=penalty"])
        self.refuse_ball("Damping and the redistributed mass cannot be combined with the time "
                         "scheme 'Crank-Nicolson'",
                         parameters=["Material/Mass damping=3", "Time/Scheme=Crank-Nicolson",
                                     "Time/Mass=redistributed", "Contact/Treatment=penalty"])

    def test_viscosity_with_nitsche(self):
        self.refuse_ball("'Nitsche' uses the elastic stress on the contact "
                         "boundary and cannot be combined with a viscous body",
                         parameters=["Contact/Treatment=Nitsche",
                                     "Material/Viscosity=linear",
                                     "Material/Viscosity eta=1e6"])

    def test_exponent_of_hauret(self):
        self.refuse_ball("Hauret-Le Tallec is a penalisation with the exponent "
                         "2", parameters=["Contact/Treatment=Hauret-Le Tallec",
                                          "Contact/Compliance exponent=3"])

    def test_poisson_ratio(self):
        self.refuse_ball("Poisson ratio must lie between -1 and 1/2",
                         parameters=["Material/Poisson ratio=0.5"])
        self.refuse_ring("needs a Poisson ratio that is not negative",
                         parameters=["Material/Law=neo-Hookean",
                                     "Material/Poisson ratio=-0.2"])

    def test_meshes(self):
        self.refuse_ball("needs at least 134 nodes; 130 were asked for",
                         parameters=["Mesh/Nodes=130"])
        self.refuse_ball("16 boundary nodes has no room for 20000 nodes",
                         parameters=["Mesh/Nodes=20000",
                                     "Mesh/Boundary nodes=16"])
        self.refuse_ball("8, 16, 32, ... boundary nodes; 100 were asked for",
                         parameters=["Mesh/Cells=quadrilaterals",
                                     "Mesh/Boundary nodes=100"])
        self.refuse_ring("an even number of nodes around; 33 were asked for",
                         parameters=["Mesh/Nodes around=33"])
        self.refuse_ring("'1' of 'Mesh/Nodes across' is not allowed",
                         parameters=["Mesh/Nodes across=1"])


if __name__ == "__main__":
    main()
