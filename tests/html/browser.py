# SPDX-License-Identifier: LGPL-3.0-or-later
"""A headless chromium, driven by its DevTools protocol: JSON over a websocket (RFC 6455), by the standard library alone.

Everything that a page logs, throws or asks for is kept in `Page.complaints` and `Page.requests`.
"""
import base64
import json
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import tempfile
import time
import urllib.request

NAMES = 'chromium', 'chromium-browser', 'google-chrome'


def find():
    """The browser's program; None: there is none."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Socket:
    """The client's end of a websocket, as far as whole texts go to and fro."""

    def __init__(self, url):
        place, path = url.removeprefix('ws://').split('/', 1)
        host, port = place.split(':')
        self.socket = socket.create_connection((host, int(port)), timeout=120)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f'GET /{path} HTTP/1.1\r\nHost: {place}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n'
                            f'Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n'.encode())
        self.file = self.socket.makefile('rb')
        if b' 101 ' not in self.file.readline():
            raise OSError('the browser does not open a websocket')
        while self.file.readline().strip():
            pass

    def send(self, text):
        data, mask = text.encode(), os.urandom(4)
        size = len(data)
        head = (struct.pack('!BB', 0x81, 0x80 | size) if size < 126 else
                struct.pack('!BBH', 0x81, 0xfe, size) if size < 1 << 16 else struct.pack('!BBQ', 0x81, 0xff, size))
        self.socket.sendall(head + mask + bytes(b ^ mask[k & 3] for k, b in enumerate(data)))

    def receive(self):
        text, last = b'', False
        while not last:
            first, size = self.file.read(2)
            last = bool(first & 0x80)
            if size == 126:
                size, = struct.unpack('!H', self.file.read(2))
            elif size == 127:
                size, = struct.unpack('!Q', self.file.read(8))
            text += self.file.read(size)
        return text.decode()

    def close(self):
        self.file.close()
        self.socket.close()


class Browser:
    """One process; `with Browser() as browser: page = browser.open(file)`."""

    def __enter__(self):
        self.folder = tempfile.mkdtemp()
        options = ['--headless=new', '--no-sandbox', '--disable-gpu', '--no-first-run', '--disable-extensions', '--disable-dev-shm-usage',
                   '--disable-background-networking', '--remote-debugging-port=0', '--user-data-dir=' + self.folder, 'about:blank']
        self.process = subprocess.Popen([find(), *options], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        port = pathlib.Path(self.folder, 'DevToolsActivePort')
        for _ in range(600):
            if port.exists() and port.read_text(encoding='utf-8').strip():
                break
            time.sleep(0.1)
        self.port = int(port.read_text(encoding='utf-8').split()[0])
        return self

    def __exit__(self, *_):
        try:
            os.killpg(self.process.pid, 9)  # our own session: the browser and its children
        except ProcessLookupError:
            pass
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def open(self, file, wide=1200, high=800, dark=False, place='', scale=1):
        """A page that shows a file, when its first picture stands."""
        request = urllib.request.Request(f'http://127.0.0.1:{self.port}/json/new?about:blank', method='PUT')
        with urllib.request.urlopen(request) as answer:
            page = Page(json.load(answer)['webSocketDebuggerUrl'])
        page.call('Emulation.setDeviceMetricsOverride', width=wide, height=high, deviceScaleFactor=scale, mobile=False)
        page.call('Emulation.setEmulatedMedia', features=[{'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}])
        for domain in ('Page', 'Runtime', 'Log', 'Network'):
            page.call(domain + '.enable')
        page.call('Page.navigate', url=pathlib.Path(file).resolve().as_uri() + place)
        page.until("performance.getEntriesByName('first picture').length || document.querySelector('#message')?.textContent.includes('cannot')")
        return page


class Page:
    def __init__(self, url):
        self.socket, self.last = Socket(url), 0
        self.complaints, self.requests = [], []

    def call(self, method, **parameters):
        """The result of a method of the protocol."""
        self.last += 1
        self.socket.send(json.dumps({'id': self.last, 'method': method, 'params': parameters}))
        while True:
            message = json.loads(self.socket.receive())
            if message.get('id') == self.last:
                if 'error' in message:
                    raise AssertionError(f'{method}: {message["error"]}')
                return message['result']
            self.note(message)

    def note(self, message):
        method, parameters = message.get('method', ''), message.get('params', {})
        if method == 'Runtime.exceptionThrown':
            self.complaints.append(str(parameters['exceptionDetails'])[:600])
        elif method in ('Runtime.consoleAPICalled', 'Log.entryAdded'):
            self.complaints.append(str(parameters)[:600])
        elif method == 'Network.requestWillBeSent':
            self.requests.append(parameters['request']['url'])

    def value(self, expression):
        """The value of an expression, also of a promise, in the page."""
        result = self.call('Runtime.evaluate', expression=expression, returnByValue=True, awaitPromise=True)
        if 'exceptionDetails' in result:
            raise AssertionError(f'{expression}: {result["exceptionDetails"]}')
        return result['result'].get('value')

    def until(self, expression, seconds=120):
        end = time.monotonic() + seconds
        while not self.value(expression):
            assert time.monotonic() < end, f'not so in time: {expression}'
            time.sleep(0.02)

    def text(self, selector):
        return self.value(f'document.querySelector({json.dumps(selector)})?.textContent')

    def key(self, key):
        self.call('Input.dispatchKeyEvent', type='keyDown', key=key, text=key if len(key) == 1 else '')
        self.call('Input.dispatchKeyEvent', type='keyUp', key=key)

    def mouse(self, kind, x, y, **more):
        self.call('Input.dispatchMouseEvent', type=kind, x=x, y=y, **more)

    def frames(self, count=2):
        """Waits for frames to be drawn."""
        self.value(f'new Promise((done) => {{ let n = {count}; const next = () => n-- ? requestAnimationFrame(next) : done(true); next(); }})')

    def picture(self, file):
        data = self.call('Page.captureScreenshot', format='png')['data']
        pathlib.Path(file).write_bytes(base64.b64decode(data))

    def close(self):
        self.call('Page.close')
        self.socket.close()
