# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium that is asked over a pipe: what a page shows, says on its console and asks the network for."""

import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PATIENCE = 120  # s


class Browser:
    """One page of one Chromium. @raises OSError where it does not start"""

    def __init__(self, *more):
        """@param more: words of its command line, as those that let it draw in three dimensions without a graphics
        card"""
        self.home = tempfile.TemporaryDirectory(prefix="chromium-", ignore_cleanup_errors=True)
        (read, self.to), (self.out, write) = os.pipe(), os.pipe()
        command = [
            shutil.which("chromium"),
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--remote-debugging-pipe",
            f"--user-data-dir={self.home.name}",
            "--no-first-run",
            "--disable-extensions",
            *more,
            "about:blank",
        ]

        def give():
            os.dup2(read, 30), os.dup2(write, 31)
            os.dup2(30, 3), os.dup2(31, 4)

        self.process = subprocess.Popen(
            command,
            preexec_fn=give,
            close_fds=False,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(read), os.close(write)
        self.rest, self.number, self.session, self.events = b"", 0, None, []
        target = next(t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")
        self.ask("Performance.enable", timeDomain="threadTicks")
        self.spent = 0.0  # seconds that the page's thread worked for the last page

    def close(self):
        self.process.kill()
        self.process.wait()
        os.close(self.to), os.close(self.out)
        self.home.cleanup()

    def arrives(self, end):
        """Whether the page comes to be one whose address ends so. While it changes it answers nothing."""
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            try:
                if self.run("document.readyState + ' ' + location.href").endswith(end):
                    return True
            except OSError:
                pass
            time.sleep(0.05)
        return False

    def message(self):
        while b"\0" not in self.rest:
            if not select.select([self.out], [], [], PATIENCE)[0]:
                raise OSError(f"chromium has said nothing for {PATIENCE} s")
            part = os.read(self.out, 1 << 20)
            if not part:
                raise OSError("chromium has ended")
            self.rest += part
        one, self.rest = self.rest.split(b"\0", 1)
        return json.loads(one)

    def ask(self, method, **words):
        self.number += 1
        asked = {"id": self.number, "method": method, "params": words}
        os.write(
            self.to, json.dumps({**asked, **({"sessionId": self.session} if self.session else {})}).encode() + b"\0"
        )
        while True:
            got = self.message()
            if got.get("id") == self.number:
                if "error" in got:
                    raise OSError(f"{method}: {got['error']}")
                return got.get("result", {})
            self.events.append(got)

    def open(self, path, width=1400, height=900):
        """Loads a page, and waits until it is complete."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.events.clear()
        before = self.worked()
        self.ask("Page.navigate", url=path.as_uri())
        while (
            self.run("document.readyState + ' ' + location.href") != f"complete {path.as_uri()}"
        ):  # an event may be of the page before
            time.sleep(0.02)
        now = self.worked()
        self.spent = now - before if now >= before else now  # another process begins anew

    def worked(self):
        return next(m["value"] for m in self.ask("Performance.getMetrics")["metrics"] if m["name"] == "TaskDuration")

    def run(self, script):
        found = self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in found:
            raise AssertionError(found["exceptionDetails"])
        return found["result"].get("value")

    def complaints(self):
        """Errors and warnings of the console, and exceptions, as text."""
        kinds = {"Runtime.exceptionThrown", "Log.entryAdded", "Runtime.consoleAPICalled"}
        return [json.dumps(event["params"])[:400] for event in self.events if event.get("method") in kinds]

    def requests(self):
        """Addresses that the page asked for, besides files of the disk and what is inside it."""
        asked = [
            event["params"]["request"]["url"]
            for event in self.events
            if event.get("method") == "Network.requestWillBeSent"
        ]
        return [url for url in asked if not url.startswith(("file:", "data:", "blob:"))]
