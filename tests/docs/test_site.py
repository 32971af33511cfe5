"""The documentation site has every page, and every page says who it is for."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = sorted(
    page.relative_to(DOCS).as_posix()
    for page in DOCS.rglob("*.md")
    if not page.relative_to(DOCS).parts[0].startswith(("_", "gallery"))
)
READERS = re.compile(r"\b[Ff]or (?:\w+ ){0,2}(?:people|researchers|experimenters|anyone|readers)\b")


def beginning(page):
    """Return a page's text before its second heading."""
    text = (DOCS / page).read_text("utf-8")
    if page == "contributing.md":
        text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    return text.partition("\n## ")[0]


@pytest.mark.parametrize("page", [p for p in PAGES if not p.startswith("decisions/0")])
def test_a_page_says_who_it_is_for(page):
    """Before its first section."""
    assert READERS.search(beginning(page)), page


def test_every_page_is_in_the_contents():
    """Who opens the site finds each of them."""
    contents = (DOCS / "index.md").read_text("utf-8")
    contents += (DOCS / "reference" / "api" / "index.md").read_text("utf-8")
    entries = set(re.findall(r"^([\w/-]+)$", contents, re.MULTILINE))
    entries |= {f"reference/api/{entry}" for entry in entries}
    missing = [
        page
        for page in PAGES
        if page.removesuffix(".md") not in entries
        and page != "index.md"
        and not page.startswith("decisions/0")
    ]
    assert missing == []


def test_the_module_pages_name_modules_that_exist():
    """Each has a file; and each package's page holds its own."""
    for page in (DOCS / "reference" / "api").glob("*.md"):
        for module in re.findall(
            r"^```\{automodule\} (\S+)$", page.read_text("utf-8"), re.MULTILINE
        ):
            path = ROOT / module.replace(".", "/")
            assert path.with_suffix(".py").is_file() or (path / "__init__.py").is_file()
            assert module.split(".")[0] == page.stem
