# Documentation of APF. Needs Debian's python3-sphinx only, and no network: docutils turns formulas
# into MathML, which browsers draw themselves, so neither MathJax nor LaTeX is wanted. To have them
# drawn by a MathJax of your own instead:
#
#   sphinx-build -D html_math_renderer=mathjax -D mathjax_path=FOLDER/MathJax.js ...

import re
from pathlib import Path

from docutils import nodes
from docutils.utils.math import latex2mathml

project = "APF"
author = "APF developers"
copyright = "APF developers"
extensions = ["sphinx.ext.mathjax"]
root_doc = "index"
nitpicky = True
highlight_language = "none"

# cmake --build BUILD --target man: apf.7 is all pages in one, and each page by itself
pages = sorted(Path(__file__).parent.glob("*.rst"))
titles = {page.stem: re.search(r"^(.+)\n=+$", page.read_text(), re.M)[1] for page in pages}
titles["index"] = "adhesive particle flow for LAMMPS"
man_pages = [(name, "apf" if name == "index" else "apf-" + name, title, "", 7) for name, title in titles.items()]

html_theme = "alabaster"
html_theme_options = {
    "description": "Adhesive particle flow for LAMMPS",
    "page_width": "1100px",
    "sidebar_width": "250px",
    "show_powered_by": False,
}
html_sidebars = {"**": ["about.html", "navigation.html", "searchbox.html"]}
html_copy_source = False
html_math_renderer = "mathml"


def mathml(latex, block):
    """A LaTeX formula as MathML text. Raises for what docutils cannot translate."""
    try:
        return latex2mathml.tex2mathml(latex, as_block=block)    # docutils 0.21 and later
    except TypeError:
        return latex2mathml.tex2mathml(latex, inline=not block)


def visit_math(translator, node):
    translator.body.append(mathml(node.astext(), False).strip())
    raise nodes.SkipNode


def visit_math_block(translator, node):
    translator.body.append(mathml(node.astext(), True))
    raise nodes.SkipNode


# alignment at & in formulas of several lines, which Chromium does not take from MathML, and fonts
# that have the sizes of brackets and roots
STYLE = """<style>
math { font-family: "STIX Two Math", "STIX Math", "Latin Modern Math", "Cambria Math", math; }
mtd:nth-child(odd) { text-align: -webkit-right; text-align: right; }
mtd:nth-child(even) { text-align: -webkit-left; text-align: left; }
</style>"""


def add_style(app, pagename, templatename, context, doctree):
    context["metatags"] = context.get("metatags", "") + STYLE


def setup(app):
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math_block, None))
    app.connect("html-page-context", add_style)
    return {"parallel_read_safe": True}
