# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the product says: the command in a process of its own, Python and C in one that serves many cases."""
import json
import os
import re
import resource
import select
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


class Hangs(Exception):
    """No end within the time that a case may take."""


class Product:
    """The commands under test. limit: seconds of the processor for a run. Few cases come near to 20; bounds of a diagram from
    2^-400 to 2^900 took 61. A loaded machine takes longer by the clock."""

    def __init__(self, command, python=None, capi=None, tiles=None, limit=90):
        self.command, self.python, self.capi, self.tiles, self.limit = command, python, capi, tiles, limit
        self.folder = tempfile.mkdtemp(prefix='truth-')
        self.servers, self.text, self.runs = {}, None, 0

    def close(self):
        for s in self.servers.values():
            s.kill()
            s.wait()
        subprocess.run(['rm', '-rf', self.folder], check=False)

    def __call__(self, name, content):
        """Puts a file, or the standard input of the next run; returns its name."""
        if name is None:
            self.text = content.encode()
            return '-'
        path = os.path.join(self.folder, name)
        with open(path, 'wb') as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def here(self, name):
        return os.path.join(HERE, name)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, args, program=None):
        """Exit status, output, messages."""
        self.runs += 1
        p = subprocess.Popen([program or self.command, *args], stdin=subprocess.PIPE if self.text else subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE, close_fds=False)
        try:
            resource.prlimit(p.pid, resource.RLIMIT_CPU, (int(self.limit), int(self.limit) + 1))
        except ProcessLookupError:
            pass  # it has ended
        try:
            out, err = p.communicate(self.text, timeout=30 * self.limit)
        except subprocess.TimeoutExpired:
            p.kill()
            p.communicate()
            raise Hangs('no end within %d seconds' % self.limit) from None
        if p.returncode in (-24, -9):
            raise Hangs('no end within %d seconds of the processor' % self.limit)
        return p.returncode, out.decode('utf-8', 'replace'), err.decode('utf-8', 'replace')

    def serve(self, name, question):
        """One line to a server, one line back: both json."""
        s = self.servers.get(name)
        if s is None or s.poll() is not None:
            argv = [sys.executable if name == 'python' else self.capi, *([self.here('serve.py')] if name == 'python' else [])]
            s = subprocess.Popen(argv, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1,
                                 env={**os.environ, **({'PYTHONPATH': self.python} if self.python else {})})
            self.servers[name] = s
        self.runs += 1
        s.stdin.write(question + '\n')
        s.stdin.flush()
        if not select.select([s.stdout], [], [], 30 * self.limit)[0]:
            s.kill()
            s.wait()
            raise Hangs('no end within %d seconds' % self.limit)
        return json.loads(s.stdout.readline() or '{"error": "the process died"}')


def offers(command):
    """The command's own table, from the completion that it prints: commands; options, formats, layers of each; the
    words that an option takes."""
    text = subprocess.run([command, '--help=bash'], capture_output=True, text=True, check=True).stdout
    commands = re.search(r"-z \$command \]\]; then words='([^']*)'", text)[1].split()
    by_option, option, words = {}, None, {}
    for line in text.splitlines():
        m = re.match(r"    --([a-z-]+)(?:\|-\w)?\) (.*)", line)
        if m:
            option = m[1]
            w = re.search(r"words='([^']*)' ;;", m[2])
            words[option] = w[1].split() if w else []
        m = re.match(r"      (\S+)\) words='([^']*)' ;;", line)
        if m and option:
            by_option.setdefault(option, {})[m[1]] = m[2].split()
    tail = text[text.index('if [[ -z $words && $cur == -* ]]'):]
    options = {m[1]: m[2].split() for m in re.finditer(r"    (\w+)\) words='([^']*)' ;;", tail)}
    return {'commands': commands, 'options': {c: [o for o in options[c] if o.startswith('--')] for c in commands},
            'formats': {c: by_option['format'].get(c, []) for c in commands},
            'layers': {c: by_option['layer'].get(c, []) for c in commands},
            'words': {o: w for o, w in words.items() if w and o not in ('format', 'layer')}}
