#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The drawing of the folders in src/README.md is true, and neither folders nor files nor modules use each other in a circle.

Usage: check_map.py ROOT            (prints every breach; exit status 1 when there is one)
       check_map.py ROOT --renew    (writes the drawing anew, then checks)
       check_map.py ROOT --pairs    (counts a .c and the .h of its name as one file: stricter, for looking around)

A file uses another one when it includes it, or calls a function that this one alone defines (a header: in its inline
functions; not those of its own .c), be it declared in include/dyadel or anywhere. A folder uses another one when a file of
it does. The drawing has an arrow from a folder to each folder that it uses, unless it reaches them by way of others;
the lines below it have all.
Below it each folder's files (a .c and its .h as one) have an order in which they can be read: each after the files it
uses. So do the modules of a Python package: one uses another that it imports, be it within a function or for types
alone. The table of rooms in the same guide has a row for each folder, below those of all that it uses.
"""
import ast
import collections
import pathlib
import re
import sys

from check_constants import without_comments

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)
DEFINITION = re.compile(r'^(?!static\b|typedef\b|#)[A-Za-z_][\w \t*]*?\b(\w+)\([^;{}]*\)\s*\{', re.M)
TYPE = re.compile(r'\b(?:struct|enum|union) (\w+)')
WORD = re.compile(r'[A-Za-z_]\w*')
BEGIN, END = '<!-- map: tests/house/check_map.py --renew writes what follows -->\n', '<!-- end of the map -->\n'
ROOM = re.compile(r'^\| `src/(\w+)` \|', re.M)
GUIDE = 'src/README.md'


def read_files(root):
    """{path from src: text without comments}"""
    return {str(path.relative_to(root / 'src')): without_comments(path.read_text(encoding='utf-8'))
            for path in sorted((root / 'src').rglob('*.[ch]'))}


def homes(files):
    """{function: the one file that defines it for others}; without names that are types as well"""
    types = {'main'}.union(*(TYPE.findall(text) for text in files.values()))
    found = collections.defaultdict(list)
    for path, text in files.items():
        for function in DEFINITION.findall(text) if path.endswith('.c') else ():
            found[function].append(path)
    return {function: paths[0] for function, paths in found.items() if len(paths) == 1 and function not in types}


def bodies(text):
    """The text between braces at the outermost level."""
    out, depth = [], 0
    for piece in re.split(r'([{}])', text):
        depth += {'{': 1, '}': -1}.get(piece, 0)
        if depth > 0:
            out.append(piece)
    return ' '.join(out)


def uses(files):
    """{file: {file used: why}}"""
    home, graph = homes(files), {}
    for path, text in files.items():
        used = graph[path] = {}
        for header in INCLUDE.findall(text):
            target = header if '/' in header else str(pathlib.PurePosixPath(path).parent / header)
            if target in files and target != path:
                used[target] = f'includes {header}'
        plain = re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)
        for word in WORD.findall(plain if path.endswith('.c') else bodies(plain)):
            if home.get(word, path)[:-2] != path[:-2]:
                used.setdefault(home[word], f'calls {word}')
    return graph


def imports(root):
    """{module of a Python package: {module used: why}}, by their paths from src without ending"""
    paths = {path.relative_to(root / 'src').with_suffix(''): path for path in sorted((root / 'src').rglob('*.py'))
             if path.with_name('__init__.py').exists()}
    graph = {str(module): {} for module in paths}
    for module, path in paths.items():
        for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
            if not isinstance(node, ast.ImportFrom) or node.level != 1:
                continue
            for name in [node.module] if node.module else [alias.name for alias in node.names]:
                if module.with_name(name) in paths:
                    graph[str(module)].setdefault(str(module.with_name(name)), f'imports {name}')
    return graph


def join_pairs(graph):
    """The same with x.c and x.h as one file x."""
    joined = collections.defaultdict(dict)
    for path, used in graph.items():
        for other, why in used.items():
            if other[:-2] != path[:-2]:
                joined[path[:-2]].setdefault(other[:-2], why)
    return {path[:-2]: joined[path[:-2]] for path in graph}


def knots(graph):
    """Sets of nodes that reach each other, single ones included, each after all that it reaches (Tarjan)."""
    order, low, stack, found = {}, {}, [], []

    def visit(node):
        order[node] = low[node] = len(order)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in order:
                visit(other)
            if other in stack:
                low[node] = min(low[node], low[other])
        if low[node] == order[node]:
            at = stack.index(node)
            found.append(frozenset(stack[at:]))
            del stack[at:]
    for node in sorted(graph):
        if node not in order:
            visit(node)
    return found


def way_round(graph, members):
    """A shortest way round in such a set: [node, ..., the same node]"""
    ways = []
    for start in sorted(members):
        came, queue = {}, collections.deque([start])
        while queue and start not in came:
            node = queue.popleft()
            for other in sorted(set(graph[node]) & members - set(came)):
                came[other] = node
                queue.append(other)
        way = [start]
        while len(way) == 1 or way[-1] != start:
            way.append(came[way[-1]])
        ways.append(way[::-1])
    return min(ways, key=len)


def check_circles(what, graph):
    for members in knots(graph):
        if len(members) > 1:
            way = way_round(graph, members)
            steps = (f'{a} {graph[a][b]} ({b})' for a, b in zip(way, way[1:]))
            yield f'src: a circle of {what}: {", ".join(sorted(members))}; a way round: {"; ".join(steps)}'


def folder(path):
    return path.partition('/')[0]


def folders(graph):
    """{folder: {folder used: an example}}"""
    found = {}
    for path, used in graph.items():
        own = found.setdefault(folder(path), {})
        for other, why in used.items():
            if folder(other) != folder(path):
                own.setdefault(folder(other), f'by {path}, which {why}')
    return found


def below(graph, start):
    """All that a folder reaches."""
    reached, queue = set(), list(graph[start])
    while queue:
        node = queue.pop()
        if node not in reached:
            reached.add(node)
            queue += graph[node]
    return reached


def levels(graph):
    """Nodes, independent ones first; each after all that it uses; the nodes of one circle are together."""
    height, first = {}, {}
    for members in knots(graph):
        level = max((height[o] + 1 for m in members for o in graph[m] if o not in members), default=0)
        height.update(dict.fromkeys(members, level))
        first.update(dict.fromkeys(members, min(members)))
    return sorted(graph, key=lambda f: (height[f], first[f], f))


def arrows(graph):
    """(folder, folder used) but for those reached by way of others."""
    knot = {m: members for members in knots(graph) for m in members}
    for f in graph:
        for t in graph[f]:
            others = (o for o in graph[f] if o not in knot[f] and o not in knot[t])
            if t in knot[f] or not any(t in below(graph, o) for o in others):
                yield f, t


def reading_order(graph, room):
    """Names of a folder's files without folder and ending: each after the ones it uses, families with one header
    together."""
    joined = join_pairs(graph)
    own = {f for f in joined if folder(f) == room}
    inner = {f: {t for t in joined[f] if t in own} for f in own}
    return [f.partition('/')[2] for f in levels(inner)]


def packages(graph):
    """Lines about Python packages: their modules, each after the ones it imports."""
    found = collections.defaultdict(list)
    for module in levels(graph):
        package, _, name = module.rpartition('/')
        found[package].append(name)
    return [f'* `{package}`, in Python: {", ".join(names)}' for package, names in found.items()]


def drawing(graph, files, modules):
    """The map as the guide should have it: of folders, of the files of each, and of Python's modules."""
    order = levels(graph)
    lines = [f'  {f} --> {t}' for f, t in sorted(arrows(graph), key=lambda a: (-order.index(a[0]), -order.index(a[1])))]
    rows = [f'| `{f}` | {", ".join(f"`{t}`" for t in order if t in graph[f]) or "nothing"} |' for f in order]
    reading = [f'* `{f}`: {", ".join(reading_order(files, f))}' for f in order] + packages(modules)
    return '\n'.join(['', '```mermaid', 'flowchart TD'] + lines +
                     ['```', '', '| folder | uses, by include or call |', '|---|---|'] + rows +
                     ['', 'The files of each, in an order to read them: each stands after those that it uses, and files that',
                      'share a header stand together.', ''] + reading + ['', ''])


def check_drawing(root, now, renew):
    path = root / GUIDE
    before, begin, rest = path.read_text(encoding='utf-8').partition(BEGIN)
    old, end, after = rest.partition(END)
    if not begin or not end:
        yield f'{GUIDE}: the lines "{BEGIN.strip()}" and "{END.strip()}" are needed'
    elif renew:
        path.write_text(before + begin + now + end + after, encoding='utf-8')
    elif old != now:
        wrong = sorted(set(old.splitlines()) ^ set(now.splitlines()))
        yield f'{GUIDE}: the map is not that of the sources; check_map.py ROOT --renew writes it: {"; ".join(wrong[:4]).strip()}'


def check_rooms(root, graph):
    rows = ROOM.findall((root / GUIDE).read_text(encoding='utf-8'))
    knot = {m: members for members in knots(graph) for m in members}
    for room in sorted(set(graph) ^ set(rows)):
        yield f'{GUIDE}: {room} is {"a room without a row" if room in graph else "no room"} in the table of rooms'
    for room in (r for r in rows if r in graph):
        for used in graph[room]:
            if used in rows and used not in knot[room] and rows.index(used) > rows.index(room):
                yield f'{GUIDE}: {room} stands above {used}, which it uses, in the table of rooms'


def breaches(root, options):
    graph = uses(read_files(root))
    rooms, modules = folders(graph), imports(root)
    yield from check_circles('modules', modules)
    yield from check_circles('files', join_pairs(graph) if '--pairs' in options else graph)
    yield from check_circles('folders', rooms)
    yield from check_drawing(root, drawing(rooms, graph, modules), '--renew' in options)
    yield from check_rooms(root, rooms)


def main():
    found = list(breaches(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]))
    print('\n'.join(found) or 'no breach')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
