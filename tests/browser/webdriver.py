"""A page in headless Chromium, over the W3C WebDriver protocol."""

import base64
import io
import json
import os
import pathlib
import re
import subprocess
import time
import urllib.error
import urllib.request

from PIL import Image

ARGUMENTS = [
    "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
    "--window-size=1280,1000", "--force-device-scale-factor=1",
    "--force-prefers-reduced-motion",  # pages stand still unless a test wants more
    # WebGL by a software rasteriser, the same on every machine.
    "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
]


class Browser:
    """`with Browser(chromedriver, chromium) as browser:`"""

    def __init__(self, driver, browser):
        self.driver, self.browser = driver, browser

    def __enter__(self):
        self.process = subprocess.Popen([self.driver, "--port=0"], stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True)
        for line in self.process.stdout:
            found = re.search(r"on port (\d+)", line)
            if found and "successfully" in line:
                self.url = f"http://127.0.0.1:{found[1]}"
                break
        try:
            options = {"args": ARGUMENTS, "binary": self.browser}
            self.session = self._call("POST", "/session", {"capabilities": {"alwaysMatch": {
                "browserName": "chrome", "goog:chromeOptions": options,
                "goog:loggingPrefs": {"browser": "ALL"}}}})["sessionId"]
        except BaseException:
            self.process.kill()
            raise
        return self

    def __exit__(self, *_):
        try:
            self._call("DELETE", f"/session/{self.session}")
        finally:
            self.process.terminate()
            self.process.wait()
            self.process.stdout.close()

    def _call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.url + path, data, {"Content-Type": "application/json"},
                                         method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(json.load(error)["value"]["message"]) from None

    def command(self, method, path, body=None):
        return self._call(method, f"/session/{self.session}{path}", body)

    def open(self, url):
        self.command("POST", "/url", {"url": url})

    def run(self, script, *arguments):
        """The value of a JavaScript function body."""
        return self.command("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def wait(self, condition, seconds=20):
        """Until a JavaScript expression is true."""
        end = time.monotonic() + seconds
        while not self.run(f"return Boolean({condition})"):
            if time.monotonic() > end:
                raise TimeoutError(f"{condition}: {self.log()}")
            time.sleep(0.05)

    def cpu_seconds(self):
        """Of the driver, the browser and all its processes, since they began."""
        parent, used = {}, {}
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = stat.read_text().rpartition(")")[2].split()
            except OSError:  # it has ended
                continue
            pid = int(stat.parent.name)
            parent[pid] = int(fields[1])
            used[pid] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        def ours(pid):
            while pid and pid != self.process.pid:
                pid = parent.get(pid, 0)
            return pid != 0
        return sum(time for pid, time in used.items() if ours(pid))

    def log(self):
        """Messages on the console since the last call."""
        return self.command("POST", "/se/log", {"type": "browser"})

    def picture(self, selector):
        """A screenshot of an element, RGB."""
        found = self.command("POST", "/element", {"using": "css selector", "value": selector})
        (element,) = found.values()
        for patience in (3, 2, 1, 0):  # the driver waits ten seconds, a busy machine may need more
            try:
                png = base64.b64decode(self.command("GET", f"/element/{element}/screenshot"))
                break
            except RuntimeError as error:
                if patience == 0 or "timeout" not in str(error):
                    raise
        return Image.open(io.BytesIO(png)).convert("RGB")
