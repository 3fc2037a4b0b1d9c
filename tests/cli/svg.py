# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads pictures: the shapes drawn, with the attributes they inherit from groups."""
import collections
import re
import xml.etree.ElementTree

Element = collections.namedtuple('Element', 'tag look title text')  # look: attributes, inherited ones included
INHERITED = ('fill', 'fill-opacity', 'stroke', 'stroke-width', 'stroke-dasharray')


def walk(node, look):
    tag = node.tag.rsplit('}', 1)[-1]
    own = {k: v for k, v in look.items() if k in INHERITED} | node.attrib
    titles = [child.text for child in node if child.tag.endswith('}title')]
    yield Element(tag, own, titles[0] if titles else None, node.text)
    if tag != 'clipPath':
        for child in node:
            yield from walk(child, own)


def elements(svg):
    """All elements but what clips; ids are unique."""
    found = list(walk(xml.etree.ElementTree.fromstring(svg), {}))
    ids = [e.look['id'] for e in found if 'id' in e.look]
    assert len(set(ids)) == len(ids), 'an id stands twice'
    return found


def paths(svg):
    return [e for e in elements(svg) if e.tag == 'path']


def words(svg):
    """Everything that is to be read."""
    return [e.text for e in elements(svg) if e.tag == 'text']


def numbers(path):
    """The ends and inner points of a path, x and y in turn; of arcs, without radii and flags."""
    plain = re.sub(r'A-?[\d.]+ -?[\d.]+ 0 [01] [01] ', 'L', path.look['d'])
    return [float(t) for t in re.findall(r'-?[\d.]+', plain)]


def frame(svg):
    """The box that the view is cut to: x lower, x upper, y lower, y upper."""
    clip = re.search(r'<clipPath id="clip1"><path d="([^"]*)"', svg)
    n = [float(t) for t in re.findall(r'-?[\d.]+', clip[1])]
    return min(n[::2]), max(n[::2]), min(n[1::2]), max(n[1::2])
