#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The twenty checks of OpenSSF Scorecard, as far as a checkout alone can answer them: no network, no token.

    tools/scorecard.py [--root FOLDER]     a line a check: pass, FAIL, borne, or "not here" with why; exit 1 where one
    fails

What only the server knows (protected branches, webhooks, who reviewed) is "not here": a checkout does not hold it.
"Borne" is what Scorecard would fault and we want so: BORNE says why."""

import argparse
import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import yaml

HASH = re.compile(r"--hash=sha256:[0-9a-f]{64}")
BINARY = (
    b"\x7fELF",
    b"MZ",
    b"\xca\xfe\xba\xbe",
    b"\xfe\xed\xfa",
    b"\xcf\xfa\xed\xfe",
    b"!<arch>",
    b"PK\x03\x04",
    b"\x1f\x8b",
    b"\0asm",
)
# Texts of others that a workflow must not paste into a script: whoever opens a pull request writes them.
FOREIGN = re.compile(
    r"\$\{\{[^}]*github\.(event\.(issue|pull_request|comment|review|head_commit|commits|workflow_run)|head_ref)[^}]*\}\}"
)


class Checkout:
    def __init__(self, root):
        self.root = root
        answer = subprocess.run(
            ["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            capture_output=True,
            text=True,
            check=False,
        )
        inside = (
            answer.stdout.split("\0")
            if answer.returncode == 0
            else [str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()]
        )
        self.files = sorted(
            name for name in inside if name and (root / name).is_file() and not name.startswith("build")
        )

    def text(self, name):
        path = self.root / name
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""

    def workflows(self):
        """(name, document) of every workflow, the ones of examples too."""
        return [
            (name, yaml.safe_load(self.text(name)))
            for name in self.files
            if re.search(r"(^|/)\.github/workflows/[^/]+\.ya?ml$", name)
        ]

    def actions(self):
        return [
            (name, yaml.safe_load(self.text(name)))
            for name in self.files
            if re.search(r"(^|/)\.github/actions/.*action\.ya?ml$", name)
        ]

    def steps(self):
        """(name of the file, step) of all workflows and actions."""
        for name, document in self.workflows():
            yield from ((name, step) for job in document["jobs"].values() for step in job.get("steps", []))
        for name, document in self.actions():
            yield from ((name, step) for step in document["runs"].get("steps", []))


def triggers(document):
    on = document.get("on", document.get(True))  # YAML 1.1 reads the key `on` as true
    return set(on if isinstance(on, (list, dict)) else [on])


# Each check yields what is wrong, and returns its evidence.


def binary_artifacts(c):
    for name in c.files:
        with (c.root / name).open("rb") as file:
            start = file.read(8)
        if start.startswith(BINARY):
            yield f"{name} is a program, library or archive"
    return f"{len(c.files)} files, none is a program, library or archive"


def ci_tests(c):
    runs = [
        step.get("run", "")
        for name, document in c.workflows()
        if "pull_request" in triggers(document)
        for job in document["jobs"].values()
        for step in job["steps"]
    ]
    if not any(".ci/run" in run or "make test" in run for run in runs):
        yield "no workflow runs the tests on a pull request"
    if "make test" not in c.text(".ci/run"):
        yield ".ci/run runs no tests"
    return "ci.yml calls .ci/run on every pull request; it runs make test, the commit profile and the gate"


def dangerous_workflow(c):
    for name, document in c.workflows():
        if "pull_request_target" in triggers(document):
            yield f"{name} runs on pull_request_target"
        if "workflow_run" in triggers(document) and re.search(
            r"uses:\s*actions/checkout|git fetch|git checkout", c.text(name)
        ):
            yield f"{name} runs on workflow_run and checks out code"
    for name, step in c.steps():
        if FOREIGN.search(str(step.get("run", ""))):
            yield f"{name}: a script is given the text of others: {step['run'].strip().splitlines()[0]}"
    return "no pull_request_target, no checkout after workflow_run, no text of others in a script"


def fuzzing(c):
    targets = [
        name
        for name in c.files
        if re.fullmatch(r"tests/fuzz/\w+\.cpp", name)
        and "LLVMFuzzerTestOneInput" in c.text(name)
        and not name.endswith("replay.cpp")
    ]
    for name in targets:
        if not any(other.startswith(f"tests/fuzz/corpus/{Path(name).stem}/") for other in c.files):
            yield f"{name} has no corpus"
    if not targets:
        yield "no target of libFuzzer"
    return f"{len(targets)} targets of libFuzzer, each with a corpus that every build replays"


def licence(c):
    if "Redistribution and use" not in c.text("LICENSE"):
        yield "LICENSE is not there, or not the text of BSD-3-Clause"
    return "LICENSE: BSD-3-Clause; texts of all licences in LICENSES"


def packaging(c):
    if not any("docker push" in str(step.get("run", "")) for _, step in c.steps()):
        yield "no workflow publishes"
    return "image.yml publishes the image of a tag"


def unpinned_uses(c):
    for name, step in c.steps():
        uses = step.get("uses")
        if (
            uses and not uses.startswith("./") and not re.fullmatch(r"[\w./-]+@([0-9a-f]{40}|COMMIT)", uses)
        ):  # COMMIT: an example's place to fill in
            yield f"{name}: {uses} is pinned by no commit"


def unpinned_downloads(c):
    for name in c.files:
        if not (name.endswith((".sh", ".yml", ".yaml", "Makefile", "Dockerfile")) or name == ".ci/run"):
            continue
        joined = re.sub(r"\\\n\s*", " ", c.text(name))
        for line in joined.splitlines():
            code = line.strip()
            if code.startswith("#"):
                continue
            if re.search(r"(?<![\w./-])pip3? install|/pip3? install", code) and "--require-hashes" not in code:
                yield f"{name}: pip without --require-hashes: {code[:80]}"
            if re.search(r"\b(curl|wget)\b.*\|\s*(ba|z)?sh\b", code):
                yield f"{name}: a download is piped into a shell: {code[:80]}"
            if (
                re.search(r"\bnpm (install|i)\b", code)
                or re.search(r"\bcargo (build|install|run)\b", code)
                and "--locked" not in code
            ):
                yield f"{name}: packages without a lock: {code[:80]}"


def unpinned_files(c):
    for name in c.files:
        if re.fullmatch(r"tools/requirements-[\w-]+\.txt", name):
            yield from unhashed_requirements(name, c.text(name))
        if name.endswith("Cargo.lock"):
            for crate in tomllib.loads(c.text(name))["package"]:
                if crate.get("source") and not crate.get("checksum"):
                    yield f"{name}: {crate['name']} has no checksum"
        if name.endswith("Cargo.toml") and str(Path(name).with_name("Cargo.lock")) not in c.files:
            yield f"{name} has no Cargo.lock"
    for spelled, file in json.loads(c.text("adapters/vendors/catalogue.json") or '{"files": {}}')["files"].items():
        if not re.fullmatch(r"[0-9a-f]{64}", file.get("sha256", "")):
            yield f"catalogue.json: {spelled} has no hash"


def unhashed_requirements(name, text):
    for line in re.sub(r"\\\n\s*", " ", text).splitlines():
        if line.strip() and not line.startswith("#") and not ("==" in line and HASH.search(line)):
            yield f"{name}: without hash: {line[:60]}"


def unpinned_images(c):
    stages, defaults = set(), {}
    for line in c.text("Dockerfile").splitlines():
        if line.startswith("ARG ") and "=" in line:
            name, value = line[4:].split("=", 1)
            defaults[f"${{{name}}}"] = value
        found = re.match(r"FROM (\S+)(?: AS (\S+))?", line)
        if found:
            image = defaults.get(found.group(1), found.group(1))
            if image not in stages and "@sha256:" not in image:
                yield f"Dockerfile: {image} has no digest"
            stages.add(found.group(2))
    for name, document in c.workflows():
        for job in document["jobs"].values():
            image = job.get("container")
            image = image.get("image") if isinstance(image, dict) else image
            if image and "@sha256:" not in image:
                yield f"{name}: the container {image} has no digest"


def pinned_dependencies(c):
    yield from unpinned_uses(c)
    yield from unpinned_downloads(c)
    yield from unpinned_files(c)
    wheels = sum(len(HASH.findall(c.text(name))) for name in c.files if name.startswith("tools/requirements-"))
    uses = sum("uses" in step for _, step in c.steps())
    return (
        f"{uses} actions by commit, {wheels} hashes of wheels, crates by Cargo.lock, engines' packages by "
        "catalogue.json"
    )


def sast(c):
    jobs = [
        job
        for _, document in c.workflows()
        for job in document["jobs"].values()
        if any("tools/checks.sh" in str(step.get("run", "")) for step in job["steps"])
    ]
    checks = {check for job in jobs for check in job["strategy"]["matrix"]["check"]}
    for what in ("tidy", "clang", "asan-ubsan", "tsan"):
        if what not in checks:
            yield f"no workflow runs tools/checks.sh {what}"
        if not re.search(rf"^  {what}\)", c.text("tools/checks.sh"), re.M):
            yield f"tools/checks.sh knows no {what}"
    return (
        "ci.yml builds with warnings as errors, runs clang-tidy and tests under the address, undefined-behaviour "
        "and thread sanitizers"
    )


def sbom(c):
    if "spdxVersion" not in c.text("tools/sbom.py") or not re.search(r"^sbom:", c.text("Makefile"), re.M):
        yield "no tool writes an SPDX document"
    return "make sbom: SPDX 2.3 of a build; the test `sbom` reads it"


def security_policy(c):
    policy = c.text("SECURITY.md")
    for what, pattern in (
        ("a way to report", r"[Rr]eport it privately"),
        ("days until an answer", r"\d+ days"),
        ("disclosure", r"public"),
    ):
        if not re.search(pattern, policy):
            yield f"SECURITY.md has no {what}"
    return "SECURITY.md: what may be hostile, how to report, 5, 14 and 90 days"


def signed_releases(c):
    script = c.text("tools/release.sh")
    if not (re.search(r"^git .*\btag --sign", script, re.M) and re.search(r"git .*\bverify-tag", script)):
        yield "no script signs a tag and verifies it"
    if not any(re.search(r"git .*\bverify-tag", str(step.get("run", ""))) for _, step in c.steps()):
        yield "what a tag publishes does not ask for its signature"
    return "tools/release.sh signs a tag and verifies it; image.yml publishes a verified tag alone"


def token_permissions(c):
    for name, document in c.workflows():
        given = document.get("permissions")
        if given not in ({}, {"contents": "read"}):
            yield f"{name}: permissions of the whole workflow: {given}"
        for job, about in document["jobs"].items():
            for what, how in (about.get("permissions") or {}).items():
                if how == "write" and what != "pull-requests":
                    yield f"{name}: job {job} may write {what}"
    return "every workflow may read the contents at most; one job of an example may write comments"


def base_images(c):
    yield from unpinned_images(c)
    return "every image by its digest"


BORNE = {
    "debian:12 has no digest": "the newest debian:12 brings the fixes of its packages; a published image keeps the "
    "digest in its label, and the Dockerfile takes one",
    "OWNER/": "an example's place to fill in",
}
SERVER = "the server's setting: not in a checkout"
CHECKS = (
    ("Binary-Artifacts", binary_artifacts),
    ("Branch-Protection", SERVER),
    ("CI-Tests", ci_tests),
    ("CII-Best-Practices", "a registration elsewhere: not in a checkout"),
    ("Code-Review", "who approved a change is the server's record: not in a checkout"),
    ("Contributors", "companies of the authors' accounts: the server's record"),
    ("Dangerous-Workflow", dangerous_workflow),
    (
        "Dependency-Update-Tool",
        "pins are changed by hand, with their figures beside them (docs/releases.md): no robot is wanted",
    ),
    ("Fuzzing", fuzzing),
    ("License", licence),
    ("Maintained", "activity of the last 90 days: the server's record"),
    ("Packaging", packaging),
    ("Pinned-Dependencies", pinned_dependencies),
    ("Pinned-Dependencies: images", base_images),
    ("SAST", sast),
    ("SBOM", sbom),
    ("Security-Policy", security_policy),
    ("Signed-Releases", signed_releases),
    ("Token-Permissions", token_permissions),
    ("Vulnerabilities", "a data base of vulnerabilities: not offline; `make sbom` is what such a scan reads"),
    ("Webhooks", SERVER),
)


def verdict(check, checkout):
    """(pass | FAIL | not here, lines that say why)"""
    if isinstance(check, str):
        return "not here", [check]
    wrong, walk = [], check(checkout)
    while True:
        try:
            wrong.append(next(walk))
        except StopIteration as end:
            if not wrong:
                return "pass", [end.value]
            borne = [next((f"{line}: {why}" for words, why in BORNE.items() if words in line), None) for line in wrong]
            return (
                ("borne", borne) if all(borne) else ("FAIL", [line for line, known in zip(wrong, borne) if not known])
            )


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    checkout = Checkout(words.parse_args().root.resolve())
    counts = {"pass": 0, "borne": 0, "FAIL": 0, "not here": 0}
    for name, check in CHECKS:
        how, why = verdict(check, checkout)
        counts[how] += 1
        for line in dict.fromkeys(why):
            print(f"{how:8}  {name:27}  {line}")
    print(
        f"{counts['pass']} pass, {counts['borne']} borne, {counts['FAIL']} fail, {counts['not here']} cannot be seen "
        "in a checkout"
    )
    return 1 if counts["FAIL"] else 0


if __name__ == "__main__":
    sys.exit(main())
