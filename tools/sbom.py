#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The bill of materials: what a build of tripoint holds, loads and fetches, as SPDX 2.3.

    tools/sbom.py [BUILD] [--out FILE]      default: build, BUILD/tripoint.spdx.json

Five kinds of packages: tripoint itself; what is in the repository and not ours (reports/vendor); what the built
programs load, and what they are compiled with, as the Debian packages that are installed here, with their versions; and
what set-up or `tripoint engine install` fetches, with the pinned hash of every file or crate. Two calls on one build
write the same bytes."""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENDORED = {
    "tabulator-tables": ("MIT", ("tabulator.min.js", "tabulator.min.css"), r"Tabulator v([0-9.]+)"),
    "three": ("MIT", ("three.module.min.js",), r'const t="([0-9]+)"'),
}
RELEASE = {"three": "0.{}.0"}  # how npm spells what the file says


def said_by(*words):
    return subprocess.run(
        words, capture_output=True, text=True, check=True, env=dict(os.environ, TZ="UTC", LC_ALL="C.UTF-8")
    ).stdout


def package(kind, name, version, **more):
    """One package of the document. @param kind prefix of its identifier, and its purl type"""
    identifier = re.sub(r"[^A-Za-z0-9.-]", "-", f"SPDXRef-{kind}-{name}-{version}")
    row = {
        "SPDXID": identifier,
        "name": name,
        "versionInfo": version,
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": "NOASSERTION",
        "licenseDeclared": "NOASSERTION",
        "copyrightText": "NOASSERTION",
    }
    if kind != "tripoint":
        spoken = f"deb/debian/{name}" if kind == "deb" else f"{kind}/{name}"
        row["externalRefs"] = [
            {
                "referenceCategory": "PACKAGE-MANAGER",
                "referenceType": "purl",
                "referenceLocator": f"pkg:{spoken}@{version}",
            }
        ]
    return row | more


def checksum(sha256):
    return [{"algorithm": "SHA256", "checksumValue": sha256}]


def ourselves(build):
    version = said_by(build / "bin" / "tripoint", "--version").split()[-1]
    return package("tripoint", "tripoint", version, licenseDeclared="BSD-3-Clause", primaryPackagePurpose="APPLICATION")


def vendored():
    """What lies in reports/vendor; a file that nobody names is an error."""
    folder = ROOT / "reports" / "vendor"
    known = set()
    for name, (licence, files, pattern) in VENDORED.items():
        found = re.search(pattern, (folder / files[0]).read_text(encoding="utf-8")[:2000])
        known.update(files)
        sums = "; ".join(f"{file} SHA256 {hashlib.sha256((folder / file).read_bytes()).hexdigest()}" for file in files)
        version = RELEASE.get(name, "{}").format(found.group(1))
        yield package("npm", name, version, licenseDeclared=licence, comment=f"in reports/vendor: {sums}")
    unnamed = {path.name for path in folder.iterdir()} - known
    if unnamed:
        sys.exit(f"sbom: {', '.join(sorted(unnamed))} in reports/vendor: say in VENDORED what it is")


def programs(build):
    yield build / "bin" / "tripoint"
    for folder in (build / "libexec" / "tripoint", build / "lib" / "tripoint"):
        yield from (path for path in sorted(folder.iterdir()) if path.is_file() and path.read_bytes()[:4] == b"\x7fELF")


def loaded(build):
    """Debian packages of the libraries that the built programs load, at the versions that are installed here."""
    files = set()
    for path in programs(build):
        files.update(re.findall(r"=> (/\S+)", said_by("ldd", path)))
    foreign = sorted(file for file in files if str(ROOT) not in file and str(build) not in file)
    places = {
        file: {
            file,
            str(Path(file).resolve()),
            file.removeprefix("/usr"),
            str(Path(file).resolve()).removeprefix("/usr"),
        }
        for file in foreign
    }
    answer = subprocess.run(
        ["dpkg", "-S", *sorted(set().union(*places.values()))], capture_output=True, text=True, check=False
    ).stdout
    owners = {line.rpartition(": ")[2]: line.partition(": ")[0].split(",")[0] for line in answer.splitlines()}
    names = set()
    for file in foreign:
        owner = next((owners[place] for place in sorted(places[file]) if place in owners), None)
        if not owner:
            sys.exit(f"sbom: no Debian package has {file}, which the programs load")
        names.add(owner)
    for name in sorted(names):
        shown, version = said_by("dpkg-query", "-W", "-f", "${Package} ${Version}", name).split()
        yield package("deb", shown, version)


def built_with():
    """The packages that set-up installs to compile: libraries of headers alone are in the programs, and no loader names
    them."""
    core = re.search(r"^core=\((.*?)\)", (ROOT / "tools" / "setup.sh").read_text(encoding="utf-8"), re.S | re.M).group(
        1
    )
    for line in said_by(
        "dpkg-query", "-W", "-f", "${db:Status-Status} ${Package} ${Version}\n", *core.split()
    ).splitlines():
        status, name, version = line.split()
        if status == "installed":
            yield package("deb", name, version)


def crates(lock):
    """What cargo fetches for one program; the program itself is ours, and has no checksum."""
    for crate in tomllib.loads(lock.read_text(encoding="utf-8"))["package"]:
        if "checksum" in crate:
            yield package("cargo", crate["name"], crate["version"], checksums=checksum(crate["checksum"]))


def fetched():
    """What is fetched by pin and hash: wheels of the requirement files, and the files of engines that can be
    installed."""
    for pins in sorted((ROOT / "tools").glob("requirements-*.txt")):
        text = re.sub(r"\\\n\s*", " ", pins.read_text(encoding="utf-8"))
        for line in text.splitlines():
            found = re.match(r"([A-Za-z0-9_.-]+)(?:\[[^\]]*\])?==(\S+)\s+(.*)", line)
            if found:
                hashes = re.findall(r"--hash=sha256:([0-9a-f]{64})", found.group(3))
                yield package(
                    "pypi", found.group(1).lower(), found.group(2), checksums=[c for h in hashes for c in checksum(h)]
                )
    vendors = ROOT / "adapters" / "vendors"
    for spelled, file in json.loads((vendors / "catalogue.json").read_text(encoding="utf-8"))["files"].items():
        if spelled.endswith("/Cargo.lock"):
            yield from crates(vendors / spelled)
            continue
        name, at, version = (
            spelled.partition("==")
            if "==" in spelled
            else spelled.rpartition("@")
            if "@" in spelled
            else spelled.partition("=")
        )
        kind = {"==": "pypi", "@": "npm", "=": "deb"}[at]
        yield package(kind, name.lower(), version, checksums=checksum(file["sha256"]))


def date_of_commit():
    """Of the checkout, so that two calls agree; where it has no history, the beginning of time."""
    words = ["git", "-C", str(ROOT), "log", "-1", "--format=%cd", "--date=format-local:%Y-%m-%dT%H:%M:%SZ"]
    try:
        return said_by(*words).strip()
    except (OSError, subprocess.CalledProcessError):
        return "1970-01-01T00:00:00Z"


def document(build):
    us = ourselves(build)
    rows, relations = {us["SPDXID"]: us}, [("SPDXRef-DOCUMENT", "DESCRIBES", us["SPDXID"])]
    for how, found in (
        ("CONTAINS", vendored()),
        ("DYNAMIC_LINK", loaded(build)),
        ("BUILD_DEPENDENCY_OF", built_with()),
        ("OPTIONAL_DEPENDENCY_OF", fetched()),
    ):
        for row in found:
            if row["SPDXID"] in rows:  # fetched for two reasons
                continue
            rows[row["SPDXID"]] = row
            turned = how.endswith("_OF")
            relations.append((row["SPDXID"], how, us["SPDXID"]) if turned else (us["SPDXID"], how, row["SPDXID"]))
    packages = list(rows.values())
    digest = hashlib.sha256(json.dumps(packages, sort_keys=True).encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"tripoint-{us['versionInfo']}",
        "documentNamespace": f"urn:sha256:{digest}",
        "creationInfo": {"created": date_of_commit(), "creators": ["Tool: tripoint-sbom"]},
        "packages": packages,
        "relationships": [
            {"spdxElementId": a, "relationshipType": how, "relatedSpdxElement": b} for a, how, b in relations
        ],
    }


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("build", nargs="?", type=Path, default=ROOT / "build")
    words.add_argument("--out", type=Path)
    given = words.parse_args()
    if not (given.build / "bin" / "tripoint").is_file():
        sys.exit(f"sbom: {given.build} has no bin/tripoint: build first, make build")
    out = given.out or given.build / "tripoint.spdx.json"
    made = document(given.build.resolve())
    out.write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")
    print(f"{out}: {len(made['packages'])} packages")


if __name__ == "__main__":
    main()
