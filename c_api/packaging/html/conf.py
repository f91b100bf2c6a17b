"""Settings of Sphinx for `make html`; c_api/packaging/html/pages.py writes the sources."""

import os

project = "harmorph"
author = "the harmorph authors"
copyright = "2026, the harmorph authors, MIT licence"
version = release = os.environ["HARMORPH_VERSION"]
extensions = ["myst_parser"]
# Headings get the anchors that links between the pages use.
myst_heading_anchors = 4
pygments_style = "xcode"
html_theme = "alabaster"
html_theme_options = {
    "description": "Morphs an airfoil and its CFD mesh together",
    "page_width": "1250px",
    "body_max_width": "960px",
    "sidebar_width": "240px",
    "fixed_sidebar": True,
    "font_family": "sans-serif",
    "head_font_family": "sans-serif",
    "font_size": "16px",
    "code_font_size": "14px",
    "show_powered_by": False,
}
html_static_path = html_css_files = ["captions.css"]
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_copy_source = False
html_show_sourcelink = False
# Examples contain programs in the languages below and lines that no lexer knows.
highlight_language = "text"
suppress_warnings = ["misc.highlighting_failure"]
