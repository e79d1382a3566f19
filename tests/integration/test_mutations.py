# SPDX-License-Identifier: LGPL-2.1-or-later
"""The list of deliberate errors follows the code: each text occurs once, each test is there.
That the tests find the errors is checked by test.sh --full."""

from common import *


class Mutations(unittest.TestCase):
    def test_list_follows_the_code(self):
        result = subprocess.run(
            [sys.executable, ROOT / "tests/mutations/mutations.py", "--source", ROOT, "--list"],
            capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    main()
