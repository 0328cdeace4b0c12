"""MkDocs hook: pages that the navigation does not name stand at its end, and links from docs/ to files
of the repository, which are no pages of the site, become paths.

`[text](../models/ur5/ur5.urdf)` becomes the text and the path in the clone; a file that is not there
is an error, as dead links between pages are.
"""

import os
import re

from mkdocs.exceptions import PluginError

LINK = re.compile(r"\[([^\]]+)\]\((\.\./[^)#]+)(#[^)]*)?\)")
FENCE = re.compile(r"^(```.*?^```[ ]*$)", re.MULTILINE | re.DOTALL)


def named(entry):
    """The pages of an entry of the navigation."""
    if isinstance(entry, str):
        return [entry]
    return [page for part in (entry.values() if isinstance(entry, dict) else entry)
            for page in named(part)]


def on_config(config):
    pages = sorted(name for name in os.listdir(config["docs_dir"]) if name.endswith(".md"))
    rest = [page for page in pages if page not in named(config["nav"])]
    if rest:
        config["nav"].append({"More": rest})
    return config


def on_page_markdown(markdown, page, config, files):
    root = os.path.dirname(config["docs_dir"])

    def replace(link):
        text, path = link[1], os.path.normpath(link[2][len("../"):])
        if not os.path.exists(os.path.join(root, path)):
            raise PluginError(f"{page.file.src_path}: no {path} in the repository")
        return f"{text} (`{path}`)" if text.strip("`") not in (path, path + "/") else f"`{path}`"

    parts = FENCE.split(markdown)
    return "".join(part if part.startswith("```") else LINK.sub(replace, part) for part in parts)
