# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a page shows, in a browser: counts, points, stages, keys, the address; and that it complains and asks of nothing."""
import contextlib
import csv
import json
import pathlib
import sys

import browser
import pages
from pages import harness

if not browser.find():
    print('skipped: there is no chromium')
    sys.exit(77)
BROWSER = browser.Browser()


@contextlib.contextmanager
def opened(file, **options):
    """A page; it may not complain, nor ask for anything but itself."""
    page = BROWSER.open(file, **options)
    yield page
    assert not page.complaints, page.complaints
    assert [url.split('#')[0] for url in page.requests] == [pathlib.Path(file).resolve().as_uri()], page.requests
    page.close()


def shown_counts(page):
    return {s: int(page.text('#count-' + s).replace(',', '')) for s in ('legal', 'indeterminate', 'tie')}


def counts(pairs):
    return {s: list(pairs.values()).count(s) for s in ('legal', 'indeterminate', 'tie')}


def test_counts():
    for args in [pages.points(pages.TWELVE)], ['--radius', '0.01', *pages.PLACES], ['--discs', *pages.FIXES]:
        with opened(pages.page('delaunay', *args)) as page:
            assert shown_counts(page) == counts(pages.csv_pairs('delaunay', *args))


def place_of(page, x, y):
    """Where on the screen a place of the plane is, by the address."""
    page.until("location.hash.includes('at=')")
    cx, cy, wide = map(float, page.value('new URLSearchParams(location.hash.slice(1)).get("at")').split(','))
    left, top, width, height = json.loads(page.value(
        'JSON.stringify((({left, top, width, height}) => [left, top, width, height])(document.querySelector("#map").getBoundingClientRect()))'))
    plot = 64, width - 10, 10, height - 24
    scale = (plot[1] - plot[0]) / wide
    return left + (plot[0] + plot[1]) / 2 + (x - cx) * scale, top + (plot[2] + plot[3]) / 2 - (y - cy) * scale


def partners_of(pairs, row, names):
    out = {s: [] for s in ('legal', 'indeterminate', 'tie')}
    for (i, j), status in pairs.items():
        if row in (i, j):
            out[status].append(names[i + j - row])
    return out


def check_card(page, site, pairs, names):
    for side in 'xy':
        lo, hi = site[side]
        assert page.text('#exact-' + side) == (lo if lo == hi else f'[{lo}, {hi}]'), page.text('#exact-' + side)
    for status, others in partners_of(pairs, site['i'], names).items():
        found = page.value(f'[...document.querySelectorAll("#partners-{status} button")].map((b) => b.textContent)')
        assert found == others, (status, found, others)
    assert site['hull'] in page.text('#card')


def test_hover():
    """The rectangle and the partners of the point under the pointer are those of json."""
    for args, some in ([pages.points(pages.TWELVE)], range(12)), (['--radius', '0.01', *pages.PLACES], (0, 17, 2051, 3375)):
        truth = json.loads(harness.run('delaunay', *args, '--format', 'json', '-q').out)
        names = [s.get('id', str(s['i'])) for s in truth['sites']]
        pairs = {(p['i'], p['j']): p['status'] for p in truth['pairs']}
        file = pages.page('delaunay', *args)
        for row in some:
            site = truth['sites'][row]
            x, y = (sum(site[side + '_decimal']) / 2 for side in 'xy')
            with opened(file, place=f'#at={x + 0.01},{y},0.5') as page:
                page.key('+')
                assert page.text('#card h2') == 'A point'
                page.mouse('mouseMoved', *place_of(page, x, y))
                check_card(page, site, pairs, names)


def test_search():
    truth = json.loads(harness.run('delaunay', *pages.PLACES, '--radius', '0.01', '--format', 'json', '-q').out)
    names = [s['id'] for s in truth['sites']]
    pairs = {(p['i'], p['j']): p['status'] for p in truth['pairs']}
    with opened(pages.page('delaunay', '--radius', '0.01', *pages.PLACES)) as page:
        for typed, row in ('jfk', names.index('JFK')), ('1200', names.index('1200') if '1200' in names else 1200):
            page.key('/')
            page.value('document.querySelector("#query").value = ""')
            page.call('Input.insertText', text=typed)
            page.call('Input.dispatchKeyEvent', type='keyDown', key='Enter', code='Enter', windowsVirtualKeyCode=13, text='\r')
            assert page.text('#card h2') == f'{names[row]} (point {row})'
            check_card(page, truth['sites'][row], pairs, names)
        page.value('document.querySelector("#query").focus()')
        page.call('Input.insertText', text='no such name')
        assert page.text('#found') == 'no such point'
        page.key('Escape')
        assert page.text('#card h2') == 'A point' and page.value('document.querySelector("#found").hidden')


def test_alias():
    with opened(pages.page('delaunay', pages.points(pages.TWELVE)), place='#point=4') as page:
        assert '12' in page.text('#card') and page.text('#card h2') == 'Point 4'


def test_stages():
    """The slider has a stop for each row of converge, with its counts; keys move it."""
    file = pages.points(pages.SLOW)
    text = harness.run('converge', file, *pages.STEPS, '--no-voronoi', '-q').out
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith('#')))
    with opened(pages.page('delaunay', file, *pages.STEPS)) as page:
        assert page.value('document.querySelector("#stage").max') == str(len(rows))
        assert page.text('#stage-number') == f'{len(rows)} of {len(rows)}'
        for k in [*range(len(rows)), 3, 0]:
            page.value(f'(() => {{ const s = document.querySelector("#stage"); s.value = {k + 1}; s.dispatchEvent(new Event("input")); }})()')
            assert shown_counts(page) == {s: int(rows[k][s]) for s in ('legal', 'indeterminate', 'tie')}, k
        page.key(']')
        assert page.text('#stage-number').startswith('2 of')
        page.key('[')
        page.key('[')
        assert page.text('#stage-number').startswith('1 of')
        page.until("location.hash.includes('stage=1')")
    with opened(pages.page('delaunay', file, *pages.STEPS), place='#point=3&stage=1') as page:
        there, back = [page.text('#card')], []
        for cards, key in (there, ']'), (back, '['):
            for _ in rows[1:]:
                page.key(key)
                cards.append(page.text('#card'))
        assert back[::-1] == there[:-1] and len(set(there)) > 2, 'a stage looks otherwise on the way back'
    with opened(pages.page('delaunay', pages.points('0 0\n1 0\n0 1\n'))) as page:
        assert page.value('document.querySelector("#stages").hidden')


def test_converge():
    file = pages.points(pages.SLOW)
    args = ['converge', file, *pages.STEPS, '--no-times']
    rows = json.loads(harness.run(*args, '--format', 'json', '-q').out)['stages']
    with opened(pages.page(*args)) as page:
        for k, row in enumerate(rows):
            page.value(f'document.querySelectorAll("#chart > div")[{k}].click()')
            assert shown_counts(page) == {s: row[s] for s in ('legal', 'indeterminate', 'tie')}
            assert f'{row["bits_least"]} to {row["bits_most"]}, {row["bits_total"]} in all' in page.text('#row')


def colours(page):
    """How many pixels of the map have each colour."""
    return page.value('''(() => {
      const map = document.querySelector("#map"), copy = new OffscreenCanvas(map.width, map.height), out = {};
      const ctx = copy.getContext("2d", {willReadFrequently: true});
      ctx.drawImage(map, 0, 0);
      const d = ctx.getImageData(0, 0, map.width, map.height).data;
      for (let k = 0; k < d.length; k += 4) { const key = [d[k], d[k + 1], d[k + 2]].join(); out[key] = (out[key] ?? 0) + 1; }
      return out; })()''')


def near(counted, colour, most=40):
    return sum(n for key, n in counted.items() if sum(abs(a - b) for a, b in zip(map(int, key.split(',')), colour)) < most)


LEGAL, OPEN = (0, 0x72, 0xb2), (0xd5, 0x5e, 0)


def test_switches():
    """Each switch takes its colour off the map, and keys switch."""
    with opened(pages.page('delaunay', pages.points(pages.TWELVE))) as page:
        for key, colour in ('1', LEGAL), ('2', OPEN):
            page.frames()
            assert near(colours(page), colour) > 100, key
            page.key(key)
            page.frames()
            assert near(colours(page), colour) < 30, key
            page.key(key)
        page.value('document.querySelector("#show-boxes").click()')
        page.frames()
        page.until("!/show=[^&]*boxes/.test(location.hash) && location.hash.includes('show=')")


def test_diagram():
    """Cells, the band, their switches; the cell of a point."""
    args = [pages.points(pages.TWELVE)]
    truth = json.loads(harness.run('voronoi', *args, '--format', 'json', '-q').out)
    with opened(pages.page('voronoi', *args)) as page:
        band = 0xe6, 0x9f, 0
        assert page.text('#count-cells') == str(len(truth['cells'])) and page.text('#count-regions') == str(len(truth['regions']))
        assert near(colours(page), band, 8) > 10000 and near(colours(page), (0xdc, 0xeb, 0xf5), 8) > 10000
        page.key('2')
        page.frames()
        assert near(colours(page), band, 8) < 50
        page.key('/')
        page.call('Input.insertText', text='7')
        page.call('Input.dispatchKeyEvent', type='keyDown', key='Enter', code='Enter', windowsVirtualKeyCode=13, text='\r')
        low, high = map(float, page.text('#area').split(' … '))
        area = next(c['area'] for c in truth['cells'] if c['i'] == 7)
        assert low <= area[0] <= low * 1.0001 and high * 0.9999 <= area[1] <= high


def test_sphere():
    """Sides along great circles, across the meridian of 180 degrees and over the pole; degrees are those of json."""
    places = '0 0\n90 0\n190 0\n270 0\n0 90\n0 -90\n100 50\n-100 50\n'
    csv_rows = pages.csv_pairs('delaunay', '--sphere', pages.points(places))
    with opened(pages.page('delaunay', '--sphere', pages.points(places)), place='#point=2') as page:
        assert shown_counts(page) == {'legal': len(csv_rows), 'indeterminate': 0, 'tie': 0}
        assert page.text('#title') == 'Delaunay triangulation of a sphere' and page.text('#exact-x') == '-170'
        assert page.text('#partners-legal') == ''.join(str(i + j - 2) for i, j in sorted(csv_rows) if 2 in (i, j))
        assert page.value('document.querySelector("#show-areas")') is None
    with opened(pages.page('delaunay', '--sphere', pages.points('100 50\n-100 50\n0 -80\n')), place='#at=180,80,40') as page:
        page.frames()
        assert near(colours(page), LEGAL) > 100, 'the way between the first two points is the short one, across 180 degrees'
    with opened(pages.page('delaunay', '--sphere', pages.points('100 50\n-100 50\n0 -80\n')), place='#at=60,65,40') as page:
        page.frames()
        assert near(colours(page), LEGAL) < 30, 'no side is there: a straight line would be'


def test_graph():
    args = ['--layer', 'graph:mst', *pages.FIXES]
    edges = pages.csv_pairs('delaunay', *args)
    with opened(pages.page('delaunay', *args), place='#point=0') as page:
        assert page.text('#title') == 'Minimum spanning tree'
        for name, status in ('legal', 'certain'), ('indeterminate', 'possible'):
            assert page.text('#count-' + name) == str(list(edges.values()).count(status)) and status in page.text('#card')
        assert page.value('document.querySelector("#show-tie") ?? document.querySelector("#show-triangles")') is None


def test_address():
    """The address brings back place, stage, point, switches and theme."""
    file = pages.page('delaunay', pages.points(pages.SLOW), *pages.STEPS)
    with opened(file, place='#at=1.5,2,0.75&stage=3&point=4&show=legal,boxes&theme=dark') as page:
        assert page.text('#stage-number').startswith('3 of') and page.text('#card h2') == 'Point 4'
        assert page.value('document.querySelector("#show-tie").checked') is False
        assert page.value('document.documentElement.classList.contains("dark")')
        page.key('ArrowRight')
        page.key('-')
        page.until("location.hash.includes('at=') && !location.hash.includes('at=1.5,') && !location.hash.includes(',0.75')")
        parts = dict(part.split('=') for part in page.value('location.hash').lstrip('#').split('&'))
        x, y, wide = map(float, parts['at'].split(','))
        assert abs(x - 1.5 - 0.75 / 8) < 1e-9 and abs(y - 2) < 1e-9 and abs(wide - 0.75 * 1.5) < 1e-9
        assert (parts['stage'], parts['point'], parts['show'], parts['theme']) == ('3', '4', 'legal,boxes', 'dark')


def test_hand():
    """Dragging moves what is seen with the pointer; the wheel keeps what is under it; a click keeps a point."""
    with opened(pages.page('delaunay', pages.points(pages.TWELVE))) as page:
        page.key('0')
        x, y = place_of(page, 2, 2)
        page.mouse('mousePressed', x + 30, y, button='left', buttons=1, clickCount=1)
        for k in range(1, 6):
            page.mouse('mouseMoved', x + 30 + 20 * k, y + 10 * k, button='left', buttons=1)
        page.mouse('mouseReleased', x + 130, y + 50, button='left', clickCount=1)
        page.value('new Promise((done) => setTimeout(done, 400))')
        now = place_of(page, 2, 2)
        assert abs(now[0] - x - 100) < 1.5 and abs(now[1] - y - 50) < 1.5, (now, x, y)
        page.mouse('mouseWheel', *now, deltaX=0, deltaY=-400)
        page.value('new Promise((done) => setTimeout(done, 400))')
        then = place_of(page, 2, 2)
        assert abs(now[0] - then[0]) < 1.5 and abs(now[1] - then[1]) < 1.5
        page.mouse('mousePressed', *then, button='left', buttons=1, clickCount=1)
        page.mouse('mouseReleased', *then, button='left', clickCount=1)
        page.mouse('mouseMoved', then[0] + 60, then[1] + 7)
        page.until("location.hash.includes('point=4')")
        assert page.text('#card h2') == 'Point 4'


def test_dark_and_print():
    with opened(pages.page('delaunay', pages.points(pages.TWELVE)), dark=True) as page:
        assert near(colours(page), (0x14, 0x17, 0x1a)) > 100000
        for event, paper in ('beforeprint', (255, 255, 255)), ('afterprint', (0x14, 0x17, 0x1a)):
            page.value(f'dispatchEvent(new Event("{event}"))')
            page.frames()
            assert near(colours(page), paper) > 100000, event
        assert len(page.call('Page.printToPDF')['data']) > 20000


def test_no_request():
    """What the page, or a name in it, would ask for, it does not get; and nothing else runs."""
    page = BROWSER.open(pages.page('delaunay', pages.points('0 0\n1 1\n')))
    page.value('fetch("data:text/plain,x").catch(() => 0)')
    page.value('''(() => { const s = document.createElement("script"); s.textContent = "document.title = 'seized'"; document.body.append(s); })()''')
    page.value('''(() => { const s = new Image(); s.src = "http://127.0.0.1:9/x.png"; document.body.append(s); })()''')
    page.frames()
    assert page.value('document.title') == 'dyadel delaunay'
    assert sum('Content Security Policy' in text for text in page.complaints) >= 3, page.complaints
    page.close()


def test_phone():
    """Nothing is wider than the screen, and the legend is beside the map, not on it."""
    for wide, high in (390, 844), (1200, 800):
        with opened(pages.page('delaunay', '--discs', *pages.FIXES), wide=wide, high=high) as page:
            assert page.value('document.documentElement.scrollWidth') <= wide
            assert page.value('''(() => { const a = document.querySelector("#map").getBoundingClientRect(), b = document.querySelector("aside").getBoundingClientRect();
              return a.right <= b.left || a.bottom <= b.top; })()''')


def test_empty():
    with opened(pages.page('delaunay', pages.points(''))) as page:
        assert page.text('#message') == 'there are no points'


if __name__ == '__main__':
    with BROWSER:
        harness.main(globals())
