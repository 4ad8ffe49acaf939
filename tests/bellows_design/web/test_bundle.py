"""The viewer's bundle is that of its sources and stands in a page as it is."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path

from bellows_design.web.element import viewer_bundle, viewer_script

WEB = Path(__file__).parents[3] / "bellows_design" / "web"
SOURCES = WEB / "javascript"


def digest_of_sources() -> str:
    """As javascript/build.mjs computes it."""
    names = ["build.mjs", "package.json", "package-lock.json"]
    names += sorted(f"source/{path.name}" for path in (SOURCES / "source").iterdir())
    made = hashlib.sha256()
    for name in names:
        made.update(f"{name}\n".encode() + (SOURCES / name).read_bytes() + b"\n")
    return made.hexdigest()


def test_the_bundle_was_built_from_these_sources() -> None:
    (built,) = re.findall(r"sources sha256 ([0-9a-f]{64})", viewer_bundle()[:400])
    assert built == digest_of_sources(), (
        "run npm ci && npm run build in bellows_design/web/javascript"
    )


def test_the_bundle_says_whose_code_it_holds() -> None:
    assert "three.js, MIT" in viewer_bundle()[:400]
    licence = (WEB / "assets" / "LICENSE.three.txt").read_text("utf-8")
    assert licence.startswith("The MIT License") and "three.js authors" in licence


def test_the_bundle_ends_no_script_and_loads_nothing() -> None:
    bundle = viewer_bundle()
    assert not re.search(r"</script|<!--", bundle, re.IGNORECASE)
    hosts = {host for host in re.findall(r"https?://([\w.-]+)", bundle)}
    assert hosts <= {"www.w3.org"}, "names of SVG and XHTML only"
    assert len(bundle) < 700_000


def test_versions_of_what_it_is_built_from_are_exact() -> None:
    about = json.loads((SOURCES / "package.json").read_text("utf-8"))
    versions = about["dependencies"] | about["devDependencies"]
    assert set(versions) == {"three", "esbuild"}
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in versions.values())


def test_a_page_may_admit_the_script_by_a_nonce() -> None:
    assert viewer_script('a1"><').startswith('<script nonce="a1&quot;&gt;&lt;">')
