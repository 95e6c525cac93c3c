# SPDX-License-Identifier: MIT
"""A browser under remote control: WebDriver (W3C) over HTTP to chromedriver, with the standard library alone."""

import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the key of element references, from the standard

ENTER, END, HOME, UP, RIGHT = "\ue007", "\ue010", "\ue011", "\ue013", "\ue014"


def reference(element):
    """An element as an argument of a script."""
    return {ELEMENT: element}


class WebDriverError(Exception):
    """What the driver refused; `code` is the standard's name of the error."""

    def __init__(self, code, message):
        super().__init__(f"{code}: {message}")
        self.code = code


def missing():
    """The programs that are needed and not there."""
    return [name for name in ("chromedriver", "chromium") if shutil.which(name) is None]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Browser:
    """One browser window with a profile of its own; close() ends it."""

    def __init__(self, *flags, size=(1280, 1000)):
        self.profile = tempfile.mkdtemp(prefix="swarmfit-browser-")
        port = free_port()
        self.base = f"http://127.0.0.1:{port}"
        self.session = ""
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            self._wait_until_ready()
            arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
                         "--force-device-scale-factor=1", f"--window-size={size[0]},{size[1]}", f"--user-data-dir={self.profile}", *flags]
            wanted = {"browserName": "chrome", "goog:loggingPrefs": {"browser": "ALL"},
                      "goog:chromeOptions": {"binary": shutil.which("chromium"), "args": arguments}}
            answer = self._call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}}, timeout=120)
            self.session = f"/session/{answer['sessionId']}"
            self.call("POST", "/timeouts", {"script": 30000, "pageLoad": 60000})
        except BaseException:
            self.close()
            raise

    def close(self):
        try:
            if self.session:
                self._call("DELETE", self.session, None)
        except (OSError, WebDriverError):
            pass
        self.driver.terminate()
        try:
            self.driver.wait(10)
        except subprocess.TimeoutExpired:
            self.driver.kill()
        shutil.rmtree(self.profile, ignore_errors=True)

    def _wait_until_ready(self):
        for _ in range(300):
            try:
                if self._call("GET", "/status", None)["ready"]:
                    return
            except OSError:
                pass
            time.sleep(0.1)
        raise TimeoutError("chromedriver does not answer")

    def _call(self, method, path, body, timeout=60):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=timeout) as reply:
                return json.load(reply)["value"]
        except urllib.error.HTTPError as error:
            value = json.load(error)["value"]
            raise WebDriverError(value["error"], value["message"]) from None

    def call(self, method, path, body=None):
        return self._call(method, self.session + path, {} if body is None and method == "POST" else body)

    def open(self, url):
        self.call("POST", "/url", {"url": url})

    def run(self, script, *arguments):
        """The value of a function body in the page."""
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def run_async(self, script, *arguments):
        """The same; the last argument of the body is what to call with the value."""
        return self.call("POST", "/execute/async", {"script": script, "args": list(arguments)})

    def find(self, selector):
        return self.call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def find_all(self, selector):
        return [e[ELEMENT] for e in self.call("POST", "/elements", {"using": "css selector", "value": selector})]

    def text(self, element):
        return self.call("GET", f"/element/{element}/text")

    def click(self, element):
        self.call("POST", f"/element/{element}/click")

    def press(self, element, keys):
        self.call("POST", f"/element/{element}/value", {"text": keys})

    def drag(self, element, across, down):
        """With the pointer from the middle of an element."""
        origin = {ELEMENT: element}
        steps = [{"type": "pointerMove", "duration": 0, "origin": origin, "x": 0, "y": 0}, {"type": "pointerDown", "button": 0},
                 {"type": "pointerMove", "duration": 50, "origin": origin, "x": across, "y": down}, {"type": "pointerUp", "button": 0}]
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": steps}]})

    def wheel(self, element, down):
        step = {"type": "scroll", "origin": {ELEMENT: element}, "x": 0, "y": 0, "deltaX": 0, "deltaY": down, "duration": 0}
        self.call("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [step]}]})

    def console(self):
        """What the console said since it was last asked."""
        return [f"{entry['level']}: {entry['message']}" for entry in self.call("POST", "/se/log", {"type": "browser"})]

    def devtools(self, command, **parameters):
        return self.call("POST", "/goog/cdp/execute", {"cmd": command, "params": parameters})

    def media(self, medium="", **features):
        """Pretends to be another medium (print), or to prefer something: media(prefers_color_scheme="dark")."""
        wanted = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
        self.devtools("Emulation.setEmulatedMedia", media=medium, features=wanted)

    def screenshot(self):
        """PNG, base64."""
        return self.call("GET", "/screenshot")
