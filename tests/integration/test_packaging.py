# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recipes of packages and containers: they run, with commands in place of those that install and
compile, and agree with CMakeLists.txt, scripts/setup.sh and CITATION.cff."""

import gzip
import hashlib
import importlib.util
import json
import re
import tarfile
import tomllib
import types
import unittest.mock

from common import *

CMAKE = (ROOT / "CMakeLists.txt").read_text()
VERSION = re.search(r"project\(Ricochet VERSION (\S+)", CMAKE)[1]
CONTACT = re.search(r'CPACK_PACKAGE_CONTACT "(.+)"', CMAKE)[1]

# Names in Spack of what CMakeLists.txt looks for.
IN_SPACK = {"deal.II": "dealii", "Eigen": "eigen", "CHOLMOD": "suite-sparse", "Gmsh": "gmsh",
            "Boost": "boost", "HDF5": "hdf5"}


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def cited(key):
    """A value of CITATION.cff."""
    return re.search(rf'^[ -]*{key}: "?(.*?)"?$', text("CITATION.cff"), re.MULTILINE)[1]


def spack_recipe():
    """Class attributes of the recipe, and the words of its directives."""
    words = []
    api, base = types.ModuleType("spack.package"), types.ModuleType("cmake")
    for name in ("license", "version", "depends_on"):
        setattr(api, name, lambda *args, name=name, **_: words.append((name, *args)))
    base.CMakePackage = type("CMakePackage", (), {"define": lambda self, *args: args})
    modules = {"spack": types.ModuleType("spack"), "spack.package": api,
               "spack_repo.builtin.build_systems.cmake": base}
    path = "packaging/spack_repo/ricochet/packages/ricochet/package.py"
    with unittest.mock.patch.dict(sys.modules, modules):
        scope = {"__name__": "package"}
        exec(compile(text(path), path, "exec"), scope)
    return scope["Ricochet"], words


class Metadata(ProgramTest):

    def test_one_version_licence_and_name(self):
        project = tomllib.loads(text("python/pyproject.toml"))["project"]
        code = json.loads(text("codemeta.json"))
        _, spack = spack_recipe()
        licence = cited("license")
        self.assertEqual({cited("version"), project["version"], code["version"],
                          dict(spack[:2])["version"]}, {VERSION})
        self.assertEqual(code["license"], f"https://spdx.org/licenses/{licence}")
        self.assertEqual({project["license"]["text"], dict(spack[:2])["license"]}, {licence})
        self.assertEqual(f"{code['name']}: {code['description']}", cited("title"))
        self.assertEqual(code["author"][0]["name"], cited("name"))
        keywords = re.search(r"^keywords:\n((?:  - .+\n)+)", text("CITATION.cff"), re.MULTILINE)
        self.assertEqual(code["keywords"], re.findall(r"  - (.+)", keywords[1]))

    def test_one_address(self):
        name, address = re.fullmatch(r"(.+) <(.+)>", CONTACT).groups()
        self.assertEqual(name, cited("name"))
        self.assertEqual(json.loads(text("codemeta.json"))["author"][0]["email"], address)
        for path in ("SECURITY.md", "CODE_OF_CONDUCT.md", "packaging/debian/copyright"):
            self.assertIn(CONTACT, " ".join(text(path).split()), msg=path)

    def test_paper(self):
        _, head, body = text("paper/paper.md").split("---\n", 2)
        self.assertLessEqual(len(body.split()), 1000)
        self.assertIn(f'title: "{cited("title")}"', head)
        self.assertIn(f'name: "{cited("name")}"', head)
        entries = re.findall(r"@article\{(\w+),(.*?)\n\}", text("paper/paper.bib"), re.DOTALL)
        keys = [key for key, _ in entries]
        self.assertEqual(sorted(keys), sorted(set(re.findall(r"@(\w+)", body))))
        for key, entry in entries:
            self.assertRegex(entry, r"doi +=\s\{10\.\d{4,}/\S+\}", msg=key)
        # Verdicts of the table of all numbers.
        table = text("doc/benchmarks.md").split("not by hand. -->")[1].split("<!--")[0]
        verdicts = re.findall(
            r"\| (equal|within|holds|differs|not reproduced)[^|]*(?:\\\|[^|]*)*\|$",
            table, re.MULTILINE)
        count = {verdict: verdicts.count(verdict) for verdict in set(verdicts)}
        self.assertEqual(len(verdicts), table.count("\n| ") - 1)
        words = " ".join(body.split())
        for claim in (f"{len(verdicts)} numbers and statements",
                      f"{count['equal'] + count['within']} numbers are equal",
                      f"{count['holds']} statements hold", f"{count['differs']} differ",
                      f"{count['not reproduced']} were not reproduced"):
            self.assertIn(claim, words)

    def test_spack(self):
        """A library, a feature of deal.II or a version that CMakeLists.txt asks for is there."""
        recipe, words = spack_recipe()
        needs = {re.match(r"[\w-]+", spec)[0]: spec for name, spec in words if name == "depends_on"}
        libraries = re.findall(r'ricochet_missing\("([\w.]+)', CMAKE)
        self.assertEqual(set(libraries) - set(IN_SPACK), {"OpenMP"})
        self.assertLessEqual({IN_SPACK[name] for name in libraries if name in IN_SPACK}, set(needs))
        features = re.search(r"foreach\(feature (.+)\)", CMAKE)[1].lower().split()
        self.assertEqual(re.findall(r"\+(\w+)", needs["dealii"]), features)
        for library, pattern in (("dealii", r"find_package\(deal.II (\S+)"),
                                 ("eigen", r"find_package\(Eigen3 (\S+)"),
                                 ("cmake", r"cmake_minimum_required\(VERSION (\S+)\)")):
            self.assertIn(f"{library}@{re.search(pattern, CMAKE)[1]}:", needs[library])
        recipe.spec = types.SimpleNamespace(target=("sse4_2", "avx2"))
        ((option, value),) = recipe().cmake_args()
        self.assertIn(f"option({option} ", CMAKE)
        self.assertIs(value, True)


class Recipes(ProgramTest):
    """Commands that install and compile are replaced: they write down how they were called."""

    def setUp(self):
        super().setUp()
        self.commands = self.folder / "commands"
        self.commands.mkdir()
        for command in ("bash", "cat", "dirname", "sed", "rm", "env"):
            (self.commands / command).symlink_to(shutil.which(command))
        self.replace("dpkg", "exit 1")

    def replace(self, name, then=""):
        path = self.commands / name
        path.unlink(missing_ok=True)
        path.write_text(f'#!{shutil.which("bash")}\necho "{name} $*" >> {self.folder}/calls\n'
                        f"{then}\n")
        path.chmod(0o755)

    def calls(self):
        path = self.folder / "calls"
        found = path.read_text().splitlines() if path.exists() else []
        path.unlink(missing_ok=True)
        return found

    def bash(self, script, *arguments, **environment):
        result = subprocess.run(
            ["bash", "-c", script, *map(str, arguments)], capture_output=True, text=True,
            env={"PATH": str(self.commands), **environment}, cwd=self.folder)
        return result.returncode, result.stdout, result.stderr

    def packages(self):
        code, out, err = self.bash(f"install_packages() {{ :; }}; dpkg() {{ :; }}; "
                                   f"source {ROOT}/scripts/setup.sh; echo $packages")
        self.assertEqual(code, 0, msg=err)
        return out.split()

    def test_who_may_install(self):
        source = f"source {ROOT}/scripts/setup.sh"
        self.replace("id", "echo 1000")
        code, _, err = self.bash(source)
        self.assertEqual(code, 1)
        self.assertIn("there is no apt-get to install them: cmake", err)
        self.replace("apt-get")
        code, _, err = self.bash(source)
        self.assertEqual(code, 1)
        self.assertIn("neither root nor allowed to use sudo", err)
        self.assertIn("apt-get install cmake", err)
        self.assertNotIn("command not found", err)
        self.replace("sudo", "echo sudo: a password is required >&2; exit 1")
        self.assertEqual(self.bash(source)[::2], (1, err))
        self.assertNotIn("apt-get", "".join(self.calls()))
        self.replace("sudo", '"$@"')
        self.replace("true")
        self.assertEqual(self.bash(source)[0], 0)
        self.assertIn("sudo apt-get update -qq", self.calls())
        self.replace("id", "echo 0")
        self.assertEqual(self.bash(source)[0], 0)
        calls = self.calls()
        self.assertIn("apt-get update -qq", calls)
        self.assertNotIn("sudo", " ".join(calls))
        self.assertEqual(calls[-1].split("recommends ")[1].split(), self.packages())

    def test_container(self):
        """Packages are those of setup.sh, and the programs are built, installed and found; who runs
        them is not root."""
        source = self.folder / "src"
        recipe = re.sub(r"\\\n\s*", "", text("Dockerfile")).replace("/src", str(source))
        lines = [line.split(" ", 1) for line in recipe.splitlines() if re.match("[A-Z]", line)]
        self.assertEqual(lines[0], ["ARG", "DEBIAN=bookworm"])
        self.replace("id", "echo 0")
        for command in ("apt-get", "cmake", "ninja", "useradd"):
            self.replace(command)
        user = "root"
        for name, words in lines:
            if name == "COPY":
                what, to = words.split()
                target = pathlib.Path(to)
                if what == ".":
                    shutil.copytree(ROOT / "scripts", source / "scripts", dirs_exist_ok=True)
                    (source / "build").mkdir()
                else:
                    target.parent.mkdir(parents=True)
                    shutil.copyfile(ROOT / what, target)
            elif name == "RUN":
                self.assertEqual(user, "root")
                code, out, err = self.bash(words)
                self.assertEqual(code, 0, msg=f"{words}\n{out}\n{err}")
            elif name == "USER":
                user = words
        calls = self.calls()
        installed = [call for call in calls if call.startswith("apt-get install")]
        self.assertEqual(installed[0].split("recommends ")[1].split(), self.packages())
        configured, built, put = [call for call in calls if call.startswith(("cmake", "ninja"))]
        preset = configured.removeprefix("cmake --preset ")
        presets = json.loads(text("CMakePresets.json"))["configurePresets"]
        self.assertIn(preset, [each["name"] for each in presets])
        self.assertEqual([built, put], [f"ninja -C build/{preset} programs",
                                        f"cmake --install build/{preset}"])
        self.assertEqual(calls[-1].split()[-1], user)
        self.assertEqual(lines[-1][0], "ENTRYPOINT")
        (program,) = json.loads(lines[-1][1])
        self.assertTrue((ROOT / "steps" / program).is_dir())

    @unittest.skipUnless(shutil.which("apt-get"), "not on Debian")
    def test_mirror(self):
        """Debian's mirror is found in both forms of sources, after a source of others."""
        packages = b"Package: a\nVersion: 1\nArchitecture: amd64\n"
        for label in ("Others", "Debian"):
            release = self.folder / label / "dists" / "bookworm"
            (release / "main" / "binary-amd64").mkdir(parents=True)
            (release / "main" / "binary-amd64" / "Packages").write_bytes(packages)
            (release / "Release").write_text(
                f"Origin: {label}\nLabel: {label}\nCodename: bookworm\nArchitectures: amd64\n"
                "Components: main\nDate: Mon, 01 Jan 2024 00:00:00 UTC\nSHA256:\n"
                f" {hashlib.sha256(packages).hexdigest()} {len(packages)} "
                "main/binary-amd64/Packages\n")
        for each in ("state/lists/partial", "cache/archives/partial", "parts"):
            (self.folder / each).mkdir(parents=True)
        (self.folder / "status").write_text("")
        (self.folder / "apt.conf").write_text(
            f'Dir::Etc "{self.folder}";\nDir::Etc::sourceparts "parts";\nDir::Etc::parts "parts";\n'
            f'Dir::State "{self.folder}/state";\nDir::State::status "{self.folder}/status";\n'
            f'Dir::Cache "{self.folder}/cache";\nAPT::Sandbox::User "root";\n'
            'APT::Architecture "amd64";\nAPT::Architectures "amd64";\n')
        others, debian = (f"file:{self.folder}/{label}" for label in ("Others", "Debian"))
        self.replace("id", "echo 0")
        self.replace("debootstrap", "exit 1")
        (self.commands / "apt-get").symlink_to(shutil.which("apt-get"))
        one_line = "deb [trusted=yes] {} bookworm main\n"
        many = "Types: deb\nURIs: {}\nSuites: bookworm\nComponents: main\nTrusted: yes\n\n"
        for name, form in (("sources.list", one_line), ("parts/debian.sources", many)):
            with self.subTest(name):
                path = self.folder / name
                path.write_text(form.format(others) + form.format(debian))
                _, _, err = self.bash(f"bash {ROOT}/scripts/debian_13.sh {self.folder}/new",
                                      APT_CONFIG=str(self.folder / "apt.conf"))
                path.unlink()
                self.assertEqual(self.calls()[1:], [
                    f"debootstrap --variant=minbase trixie {self.folder}/new {debian}/"], msg=err)

    def test_services(self):
        """Commands of the services exist, and are equal for both; PyYAML reads their files."""
        workflow, other = text(".github/workflows/tests.yml"), text(".gitlab-ci.yml")
        self.assertLessEqual(len(other.splitlines()), 20)
        self.assertEqual(
            re.findall(r"debian: (\w+)\n +command: (.+)", workflow),
            re.findall(r"image: debian:(\w+)\n +script: bash (.+)", other))
        self.assertIn("bash scripts/test.sh ", text("README.md"))
        for script, option in re.findall(r"command: (\S+) ?(.*)", workflow):
            self.assertIn(f"#   {pathlib.Path(script).name}{' ' if option else ''}{option}  ",
                          text(script))
        try:
            import yaml
        except ImportError:
            return
        for path in (*(ROOT / ".github").rglob("*.yml"), ROOT / ".gitlab-ci.yml",
                     ROOT / "CITATION.cff", *(ROOT / "packaging").rglob("*.yaml")):
            self.assertIsInstance(yaml.safe_load(path.read_text()), dict, msg=path)
        for path in (*(ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.md"), ROOT / "paper/paper.md"):
            head = yaml.safe_load(path.read_text().split("---\n")[1])
            self.assertTrue({"name", "about"} <= set(head) or "title" in head, msg=path)

    def test_named_files(self):
        """Files that the page on installation and the rules for contributions name are there."""
        for page in ("doc/how_to/install.md", "SECURITY.md", "CODE_OF_CONDUCT.md", "Dockerfile",
                     ".github/PULL_REQUEST_TEMPLATE.md", ".github/workflows/tests.yml"):
            named = re.findall(r"\b((?:scripts|packaging|paper|doc|tests|examples)/[\w./]*\w)",
                               text(page))
            self.assertTrue(named or page.startswith("CODE"), msg=page)
            for path in named:
                self.assertTrue((ROOT / path).exists(), msg=f"{path} in {page}")


class Installed(ProgramTest):

    def run_here(self, *words, **environment):
        result = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                                cwd=self.folder, timeout=300, env={**os.environ, **environment})
        self.assertEqual(result.returncode, 0, msg=f"{words}\n{result.stdout}\n{result.stderr}")
        return result.stdout + result.stderr

    def test_newer_dealii(self):
        """A deal.II that is newer than those tested is reported, and not refused."""
        newest = re.search(r"ricochet_newest_dealii (\S+)\)", CMAKE)[1]
        major, minor = map(int, newest.split("."))
        for version, is_new in ((f"{newest}.2", False), (f"{major}.{minor + 1}.0", True)):
            folder = self.folder / version
            folder.mkdir()
            (folder / "deal.IIConfigVersion.cmake").write_text(
                f"set(PACKAGE_VERSION {version})\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
            # Without features, so that the configuration ends soon after.
            (folder / "deal.IIConfig.cmake").write_text(
                "macro(deal_ii_initialize_cached_variables)\nendmacro()\n")
            result = subprocess.run(
                ["cmake", "-S", ROOT, "-B", folder / "build", f"-DDEAL_II_DIR={folder}"],
                capture_output=True, text=True)
            self.assertIn("was built without MPI", result.stderr)
            self.assertEqual(f"deal.II {version} is newer than {newest}" in result.stderr, is_new,
                             msg=result.stderr)

    def test_pip(self):
        if not all(map(importlib.util.find_spec, ("pip", "setuptools", "wheel"))):
            self.skipTest("pip, setuptools or wheel (Debian's python3-wheel) is missing")
        # In a copy, since pip leaves files beside the sources.
        shutil.copytree(ROOT / "python", self.folder / "python",
                        ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        target = self.folder / "there"
        self.run_here(sys.executable, "-m", "pip", "install", "--no-index", "--no-deps",
                      "--no-build-isolation", "--target", target, "./python")
        self.assertTrue((target / f"ricochet-{VERSION}.dist-info").is_dir())
        files = [sorted(path.name for path in folder.iterdir() if path.name != "__pycache__")
                 for folder in (ROOT / "python" / "ricochet", target / "ricochet")]
        self.assertEqual(*files)
        for script in (ROOT / "python" / "bin").iterdir():
            told = self.run_here(target / "bin" / script.name, "--help", PYTHONPATH=str(target))
            self.assertIn(f"usage: {script.name}", told)

    def test_packages(self):
        """The package for Debian recommends what is not linked; the archive has one folder. Both
        are made of one program, and libraries are not looked for, which takes a minute."""
        programs = pathlib.Path(program_path("ricochet")).parent
        config = programs / "CPackConfig.cmake"
        if not config.exists() or not shutil.which("dpkg-deb"):
            self.skipTest("the programs are not in a build folder, or this is not Debian")
        files = self.folder / "files"
        (files / "bin").mkdir(parents=True)
        shutil.copy2(programs / "ricochet", files / "bin")
        self.assertIn('PACKAGE_SHLIBDEPS "ON"', config.read_text())
        for generator in ("DEB", "TGZ"):
            self.run_here("cpack", "-G", generator, "--config", config, "-D",
                          "CPACK_INSTALL_CMAKE_PROJECTS=", "-D",
                          f"CPACK_INSTALLED_DIRECTORIES={files};.", "-D",
                          "CPACK_DEBIAN_PACKAGE_SHLIBDEPS=OFF", "-B", self.folder)
        (package,) = self.folder.glob("*.deb")
        fields = dict(re.findall(r"^([\w-]+): (.*(?:\n .*)*)",
                                 self.run_here("dpkg-deb", "-f", package), re.MULTILINE))
        self.assertEqual(fields["Version"], f"{VERSION}-1")
        self.assertEqual(fields["Maintainer"], CONTACT)
        self.assertGreater(fields["Description"].count("\n"), 3)
        setup = text("scripts/setup.sh").split('packages="')[1].split('"')[0].split()
        recommended = fields["Recommends"].split(", ")
        self.assertLessEqual({*recommended, *fields["Suggests"].split(", ")}, set(setup))
        for name in ("libopenblas0-pthread", "openmpi-bin", "python3-matplotlib"):
            self.assertIn(name, recommended)
        self.assertFalse([name for name in recommended if name.endswith("-dev")])
        (archive,) = self.folder.glob("*.tar.gz")
        with tarfile.open(archive) as members:
            self.assertEqual({name.split("/")[0] for name in members.getnames()},
                             {f"ricochet-{VERSION}-Linux"})

    def test_documents(self):
        programs = pathlib.Path(program_path("ricochet")).parent
        if not (programs / "cmake_install.cmake").exists():
            self.skipTest("the programs are not in a build folder")
        self.run_here("cmake", "--install", programs, "--prefix", self.folder)
        documents = self.folder / "share" / "doc" / "ricochet"
        self.assertEqual({path.name for path in documents.iterdir()}, {
            "LICENSE", "README.md", "CITATION.cff", "copyright", "changelog.gz"})
        self.assertEqual(gzip.decompress((documents / "changelog.gz").read_bytes()),
                         (ROOT / "CHANGELOG.md").read_bytes())


if __name__ == "__main__":
    main()
