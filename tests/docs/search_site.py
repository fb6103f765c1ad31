"""Looks at the documentation site in headless Chromium, as scripts/site.sh made it: links of all pages lead somewhere,
the search finds each option and each diagnostic, flowcharts are drawn, and pages load nothing from elsewhere.

    search_site.py --bin build/bin [--site build/site/html]       (minutes)
"""

import argparse
import functools
import http.server
import json
import re
import sys
import threading
import time
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urljoin

from check_text import Programs
from pages import DIAGNOSTICS, ROOT

sys.path.insert(0, str(ROOT / "tests/render"))
from browser import Browser  # noqa: E402

sys.path.insert(0, str(ROOT / "scripts/site"))
import command_pages  # noqa: E402

FIRST = 5  # results among which something counts as found


class Page(HTMLParser):
    def __init__(self, text: str):
        super().__init__()
        self.links: list[str] = []
        self.names: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names |= {values[name] for name in ("id", "name") if values.get(name)}
        self.links += [values[name] for name in ("href", "src") if values.get(name)]


def dead_links(site: Path) -> list[str]:
    """Returns links, within the site, to files or headings that are not there."""
    pages = {path: Page(path.read_text()) for path in site.rglob("*.html")}
    found, count = [], 0
    for path, page in pages.items():
        for link in page.links:
            if re.match(r"[a-z]+:|//", link):
                continue
            count += 1
            target, anchor = urldefrag(urljoin(path.as_uri(), link))
            to = Path(unquote(target.removeprefix("file://")))
            to = to / "index.html" if to.is_dir() else to
            is_heading = anchor and to in pages and not anchor.startswith("__")
            if not to.exists() and path.name != "404.html":
                found.append(f"{path.relative_to(site)}: {link}")
            elif is_heading and unquote(anchor) not in pages[to].names:
                found.append(f"{path.relative_to(site)}: {link} has no such heading")
    print(f"{len(pages)} pages, {count} links, {len(found)} dead")
    return found


class Search:
    """The search box of a page."""

    def __init__(self, browser: Browser, address: str):
        self.browser = browser
        browser.call("Page.navigate", url=f"{address}/index.html")
        self.wait("document.querySelector('.md-search__input') && document.readyState === 'complete'")
        browser.evaluate("document.querySelector('.md-search__input').focus()")
        time.sleep(2)  # the index loads

    def wait(self, expression: str, seconds: float = 20.0):
        end = time.monotonic() + seconds
        while not (value := self.browser.evaluate(f"!!({expression})")) and time.monotonic() < end:
            time.sleep(0.05)
        return value

    def results(self, words: str) -> list[dict]:
        """Returns the places of the first results."""
        typed = ("(() => { const box = document.querySelector('.md-search__input'); box.value = %s;"
                 "for (const each of ['input', 'keyup']) box.dispatchEvent(new Event(each, {bubbles: true})); })()")
        self.browser.evaluate("document.querySelector('.md-search-result__list').replaceChildren()")
        self.browser.evaluate(typed % json.dumps(words))
        self.wait("document.querySelector('.md-search-result__list').children.length", 3)
        return self.browser.evaluate(
            "[...document.querySelectorAll('.md-search-result__list > li')].slice(0, %d).map((each) => ({"
            "links: [...each.querySelectorAll('a')].map((one) => one.getAttribute('href'))}))" % FIRST)


def options_of(folder: Path) -> set[str]:
    programs = Programs(folder)
    commands = [command.name for name in ("rddl", "rddlc") for command in command_pages.commands(folder, name)]
    return {option for name in commands for option in programs.options(name.split()[0], " ".join(name.split()[1:]))}


def not_found(search: Search, options: set[str]) -> list[str]:
    missing = []
    codes = sorted(page.stem for page in DIAGNOSTICS.glob("*.md"))
    places = {option: f"commands/options.html#{option}" for option in options} | {code: f"diagnostics/{code}.html" for code in codes}
    for words, place in sorted(places.items()):
        links = [re.sub(r"\?[^#]*", "", link) for each in search.results(words) for link in each["links"]]
        if not any(link.endswith(place) or f"{place}#" in link for link in links):
            missing.append(f"the search does not find {words}: {links}")
    print(f"{len(options)} options, {len(codes)} diagnostics, {len(missing)} not found")
    return missing


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=Path, default=ROOT / "build/bin", help="folder of rddlc and rddl")
    parser.add_argument("--site", type=Path, default=ROOT / "build/site/html")
    options = parser.parse_args()
    site = options.site.resolve()
    complaints = dead_links(site)

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}"
    browser = Browser()
    try:
        complaints += not_found(Search(browser, address), options_of(options.bin))
        browser.call("Page.navigate", url=f"{address}/architecture.html")
        time.sleep(2)
        drawn = browser.evaluate("[...document.querySelectorAll('figure.diagram svg')].filter((each) => each.clientHeight > 100).length")
        if drawn != 3:
            complaints.append(f"{drawn} of 3 flowcharts are drawn")
        urls = {event["params"]["request"]["url"] for event in browser.events if event.get("method") == "Network.requestWillBeSent"}
        complaints += [f"a page asks the network for {url}" for url in urls if not url.startswith((address, "data:", "blob:"))]
    finally:
        browser.close()
        server.shutdown()
    print("\n".join(complaints))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
