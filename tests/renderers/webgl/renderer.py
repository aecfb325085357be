"""WebGL in Chromium as plumb runs it: by plumbline's kit, each scene is handed to a page (draw.js), which draws it and
sends the frame back."""

import atexit
import http.server
import os
import pathlib
import queue
import shutil
import subprocess
import sys
import tempfile
import threading

import numpy as np

import plumbline
from prepare import prepare

HERE = pathlib.Path(__file__).parent
FILES = {"/": (HERE / "page.html", "text/html"), "/draw.js": (HERE / "draw.js", "text/javascript"),
         "/draw.glsl": (HERE.parent / "gpu" / "draw.glsl", "text/plain")}
DEPTH_CODES = {"z16": 65535, "z24": 16777215}
SECONDS = 50

scenes, answers = queue.Queue(), queue.Queue()


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def answer(self, body, kind):
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        if self.path == "/scene":
            self.answer(scenes.get(), "application/octet-stream")
        elif self.path in FILES:
            file, kind = FILES[self.path]
            self.answer(file.read_bytes(), kind)
        else:
            self.send_error(404)

    def do_POST(self):
        answers.put((self.path, self.rfile.read(int(self.headers["Content-Length"]))))
        self.answer(b"", "text/plain")

    def log_message(self, format, *arguments):
        pass


def start():
    """The browser, which asks for scenes from then on."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    home = tempfile.mkdtemp(prefix="chromium-")
    browser = subprocess.Popen(
        ["chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking",
         f"--user-data-dir={home}/profile", f"http://127.0.0.1:{server.server_port}/"],
        env={**os.environ, "HOME": home}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL)
    atexit.register(shutil.rmtree, home, ignore_errors=True)
    atexit.register(browser.wait)
    atexit.register(browser.kill)
    return browser


def answer_of(browser):
    """What the page sends, and where."""
    for _ in range(SECONDS):
        try:
            return answers.get(timeout=1)
        except queue.Empty:
            if browser.poll() is not None:
                sys.exit(f"chromium ended with status {browser.returncode}")
    sys.exit("chromium did not draw")


def draw(scene, out):
    width, height = scene["frame"]["width"], scene["frame"]["height"]
    scenes.put(prepare(scene))
    draw.browser = draw.browser or start()
    path, body = answer_of(draw.browser)
    if path != "/frame":
        raise RuntimeError(body.decode())
    values = np.frombuffer(body, "<f4").astype(float)
    color, depth = np.split(values, [4 * width * height])
    codes = DEPTH_CODES.get(scene["frame"]["depth"])
    out.plane("color", (color / 255 if scene["frame"]["color"] == "rgba8" else color).reshape(height, width, 4))
    out.plane("depth", (np.rint(depth * codes) / codes if codes else depth).reshape(height, width))


draw.browser = None
plumbline.main("WebGL", draw)
