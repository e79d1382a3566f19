# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sphinx: how the pages that doc/make_pages.py writes become HTML. See scripts/docs.sh."""

import pathlib
import re

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Operator, String, Text

DOC = pathlib.Path(__file__).resolve().parent

project = "Ricochet"
author = "The Ricochet developers"
copyright = author  # noqa: A001
version = re.search(
    r"project\(Ricochet VERSION (\S+)", (DOC.parent / "CMakeLists.txt").read_text()
)[1]
html_title = f"Ricochet {version}"

extensions = ["myst_parser", "sphinx.ext.mathjax"]
if list((DOC / "notebooks").glob("*.ipynb")):
    extensions.append("nbsphinx")
myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
myst_heading_anchors = None
myst_dmath_double_inline = True
# Sphinx supports MathJax 3 only.
myst_update_mathjax = False
exclude_patterns = ["extra"]
nitpicky = True
highlight_language = "text"
smartquotes = False

# Formulas without a network: Debian's MathJax 2, copied into the site.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {
    "tex2jax": {
        "inlineMath": [["\\(", "\\)"]],
        "displayMath": [["\\[", "\\]"]],
        "processClass": "tex2jax_process|mathjax_process|math|output_area",
        "ignoreClass": "document",
    },
    "SVG": {"font": "TeX", "scale": 92, "linebreaks": {"automatic": True, "width": "container"}},
    "showMathMenu": False,
    "messageStyle": "none",
    "menuSettings": {"explorer": False, "assistiveMML": False},
}

html_theme = "furo"
html_static_path = [str(DOC / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False

nbsphinx_requirejs_path = ""
nbsphinx_execute = "always"
nbsphinx_timeout = 300
# The file as it is in doc/notebooks, without results.
nbsphinx_prolog = """
.. raw:: html

    {% set file = env.docname.split("/")[-1] ~ ".ipynb" %}
    <p><a href="{{ file }}" download>Download this notebook, <code>{{ file }}</code></a>. It looks for
    the source of Ricochet in the folders above its own.</p>
"""


class ParameterFile(RegexLexer):
    """Colours of a parameter file."""

    name = "prm"
    tokens = {
        "root": [
            (r"#.*", Comment.Single),
            (r"(subsection)(\s+)([^#\n]+)", bygroups(Keyword, Text, Name.Class)),
            (r"(include)(\s+)([^#\n]+)", bygroups(Keyword, Text, String)),
            (
                r"(set)(\s+)([^=#\n]+)(=)([^#\n]*)",
                bygroups(Keyword, Text, Name.Attribute, Operator, String),
            ),
            (r"end\b", Keyword),
            (r"\s+", Text),
            (r".", Text),
        ]
    }


def take_extra_files(app, config):
    """Pictures and MathJax, which go into the site as they are."""
    config.html_extra_path = [str(pathlib.Path(app.srcdir) / "extra")]


def setup(app):
    app.add_lexer("prm", ParameterFile)
    app.connect("config-inited", take_extra_files)
