# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium, driven over a pipe in its DevTools protocol: that tells what a log keeps to itself."""

import base64
import contextlib
import fcntl
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import tempfile
import time

NAMES = ("chromium", "chromium-browser", "google-chrome")
ANSWER_SECONDS = 60


def find():
    """The program's path, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One window. Must be closed."""

    def __init__(self):
        folder = self.folder = tempfile.mkdtemp(prefix="trismooth-browser-")
        commands_out, self.commands = os.pipe()
        self.messages, messages_in = os.pipe()
        # The browser wants the pipes as 3 and 4. Both numbers are taken here, by these pipes or by others, so that no
        # pipe that subprocess itself needs is overwritten.
        above = [fcntl.fcntl(end, fcntl.F_DUPFD_CLOEXEC, 10) for end in (commands_out, messages_in)]
        with open(os.path.join(folder, "browser.log"), "wb") as log:
            self.process = subprocess.Popen(
                [find(), "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run",
                 "--disable-extensions", "--disable-background-networking", "--hide-scrollbars",
                 "--remote-debugging-pipe", f"--user-data-dir={os.path.join(folder, 'browser')}", "about:blank"],
                cwd=folder, env={**os.environ, "TMPDIR": folder}, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                start_new_session=True, pass_fds=(3, 4),
                preexec_fn=lambda: (os.dup2(above[0], 3), os.dup2(above[1], 4)))
        for end in (commands_out, messages_in, *above):
            os.close(end)
        self.unread = b""
        self.asked = 0
        self.session = None
        self.events = []
        try:
            target = self.ask("Target.createTarget", url="about:blank")["targetId"]
            self.session = self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
            for domain in ("Page", "Runtime", "Log", "Network"):
                self.ask(f"{domain}.enable")
        except OSError as error:
            with open(os.path.join(folder, "browser.log"), encoding="utf-8", errors="replace") as log:
                told = log.read()[-4000:]
            self.close()
            raise RuntimeError(f"{error}\n{told}") from error

    def close(self):
        self.session = None
        try:
            self.ask("Browser.close")
            self.process.wait(timeout=ANSWER_SECONDS)
        except (OSError, subprocess.TimeoutExpired):
            pass  # it has ended, or does not listen
        finally:
            # Its helpers may outlive it for a moment, and go on writing.
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
            os.close(self.commands)
            os.close(self.messages)
            shutil.rmtree(self.folder, ignore_errors=True)

    def message(self, deadline):
        """The next one."""
        while b"\0" not in self.unread:
            if not select.select([self.messages], [], [], max(0, deadline - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            more = os.read(self.messages, 1 << 20)
            if not more:
                raise ConnectionError("the browser has ended")
            self.unread += more
        message, self.unread = self.unread.split(b"\0", 1)
        return json.loads(message)

    def ask(self, method, **parameters):
        """The answer to a command. What else the browser tells is kept in `events`."""
        self.asked += 1
        command = {"id": self.asked, "method": method, "params": parameters}
        if self.session:
            command["sessionId"] = self.session
        os.write(self.commands, json.dumps(command).encode() + b"\0")
        deadline = time.monotonic() + ANSWER_SECONDS
        while True:
            message = self.message(deadline)
            if message.get("id") == self.asked:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]
            self.events.append(message)

    def happened(self, method):
        """What the browser has told under this name since the page was asked for."""
        return [event["params"] for event in self.events if event["method"] == method]

    def load(self, url):
        self.events = []
        self.ask("Page.navigate", url=url)
        deadline = time.monotonic() + ANSWER_SECONDS
        while not self.happened("Page.loadEventFired"):
            self.events.append(self.message(deadline))

    def open(self, path, width=1200, height=900):
        """Opens a page in a window of this size and waits until it is there with all that belongs to it."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.load("about:blank")  # with it, what the page before has to tell has been told
        self.load(pathlib.Path(path).as_uri())
        # What the page has started while it loaded is told before it draws a second time.
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def requests(self):
        """The addresses that the open page has asked for, itself among them."""
        return [event["request"]["url"] for event in self.happened("Network.requestWillBeSent")]

    def complaints(self):
        """What a developer would be shown in red or yellow: console, exceptions, failed requests."""
        texts = [f"{event['entry']['level']}: {event['entry']['text']}" for event in self.happened("Log.entryAdded")
                 if event["entry"]["level"] in ("warning", "error")]
        texts += [f"console: {' '.join(str(part.get('value')) for part in event['args'])}"
                  for event in self.happened("Runtime.consoleAPICalled")
                  if event["type"] in ("warning", "error", "assert")]
        texts += [f"exception: {event['exceptionDetails'].get('exception', {}).get('description')}"
                  for event in self.happened("Runtime.exceptionThrown")]
        texts += [f"request: {event['errorText']}" for event in self.happened("Network.loadingFailed")]
        return texts

    def evaluate(self, script):
        """The value of a script's expression in the open page; a promise's where it is one."""
        answer = self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def screenshot(self, left, top, width, height):
        """A part of the open page as a PNG, wherever the window is."""
        clip = {"x": left, "y": top, "width": width, "height": height, "scale": 1}
        return base64.b64decode(self.ask("Page.captureScreenshot", format="png", captureBeyondViewport=True,
                                         clip=clip)["data"])

    def print(self):
        """The open page as a PDF."""
        return base64.b64decode(self.ask("Page.printToPDF", printBackground=True)["data"])
