# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a page shows, in a browser: counts, points, stages, keys, the address; and that it gives no error and makes no
request."""
import contextlib
import csv
import json
import pathlib
import sys
from fractions import Fraction

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


def test_plan():
    """Points to measure in their order; one of them says what is to be done."""
    whole = json.loads(harness.run('plan', '--format', 'json', '--quiet', *pages.FIXES).out)
    with opened(pages.page('plan', *pages.FIXES)) as page:
        listed = json.loads(page.value("JSON.stringify([...document.querySelectorAll('#plan-points li')].map((li) => li.textContent))"))
        assert [line.split()[0] for line in listed] == [p['id'] for p in whole['points']], listed
        assert f"{len(whole['points'])} points, 0 of {whole['undecided']} " in page.text('#plan-about')
        page.value("document.querySelector('#plan-points li:nth-child(2) button').click()")
        second = whole['points'][1]
        assert page.text('#measure') == (f"as number 2, within {second['half_width_needed']} (now {second['half_width_now']}): "
                                         f"decides {second['pairs_decided']}, leaves {second['pairs_left']}"), page.text('#measure')


def place_of(page, x, y):
    """Where on the screen a place of the plane is, by the address."""
    page.until("location.hash.includes('at=')")
    cx, cy, wide = map(float, page.value('new URLSearchParams(location.hash.slice(1)).get("at")').split(','))
    left, top, width, height = json.loads(page.value(
        'JSON.stringify((({left, top, width, height}) => [left, top, width, height])(document.querySelector("#map").getBoundingClientRect()))'))
    plot = 64, width - 10, 10, height - 24
    scale = (plot[1] - plot[0]) / wide
    return left + (plot[0] + plot[1]) / 2 + (x - cx) * scale, top + (plot[2] + plot[3]) / 2 - (y - cy) * scale


def test_resized():
    """A page that shows everything still does when its window becomes narrower; a view that was chosen stays."""
    def seen(click):  # by the address, which a click on a box of the legend writes, too
        page.value(f"history.replaceState(null, '', '#'); document.querySelector('{click}').click()")
        page.until("location.hash.includes('at=')")
        return page.value('new URLSearchParams(location.hash.slice(1)).get("at")')

    for chosen in False, True:
        with opened(pages.page('delaunay', *pages.FIXES)) as page:
            if chosen:
                seen('#closer')
            page.call('Emulation.setDeviceMetricsOverride', width=400, height=800, deviceScaleFactor=1, mobile=False)
            page.until("document.querySelector('#map').clientWidth <= 400")
            page.frames(4)
            assert (seen('input[type=checkbox]') == seen('#all')) != chosen


def partners_of(pairs, row, names):
    out = {s: [] for s in ('legal', 'indeterminate', 'tie')}
    for (i, j), status in pairs.items():
        if row in (i, j):
            out[status].append(names[i + j - row])
    return out


def ends(text):
    """The interval of an exact text, or of "MIDDLE±RADIUS", as fractions."""
    number = lambda t: Fraction(t.split('*2^')[0]) * Fraction(2) ** int((t.split('*2^') + ['0'])[1])
    middle, _, radius = text.partition('±')
    return number(middle) - Fraction(radius or 0), number(middle) + Fraction(radius or 0)


def check_side(page, side, lo, hi):
    """The decimal holds the interval, is hardly wider, and the exact text stands below where it says more."""
    decimal, exact, true = page.text('#side-' + side), page.text('#exact-' + side), (ends(lo)[0], ends(hi)[0])
    if exact is None:
        assert ends(decimal) == true, (decimal, lo, hi)
    else:
        assert exact == (lo if lo == hi else f'[{lo}, {hi}]'), exact
        if decimal.startswith('≈'):
            assert lo == hi and abs(Fraction(decimal[2:]) - true[0]) <= abs(true[0]) / 10 ** 11, (decimal, lo)
        else:
            now = ends(decimal)
            assert now[0] <= true[0] and true[1] <= now[1] and now != true, (decimal, lo, hi)
            long = len(decimal.partition('±')[0].replace('.', '')) >= 28
            assert long or now[1] - now[0] <= (true[1] - true[0]) * Fraction(101, 100), (decimal, lo, hi)


def check_card(page, site, pairs, names):
    for side in 'xy':
        check_side(page, side, *site[side])
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
            x, y = (sum(truth['sites'][row][side + '_decimal']) / 2 for side in 'xy')
            page.until("location.hash.includes('point=%d')" % row)
            cx, cy, wide = map(float, page.value('new URLSearchParams(location.hash.slice(1)).get("at")').split(','))
            assert wide < 90 and abs(x - cx) < wide / 2 and abs(y - cy) < wide, 'the point that was found is in view, and near'
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
    text = harness.run('converge', file, *pages.STEPS, '-q').out
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
        assert page.text('#title') == 'points.txt: Delaunay triangulation of a sphere' and page.text('#side-x') == '-170'
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
        assert page.text('#title') == 'gps.csv: Minimum spanning tree'
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
    """Dragging moves the map with the pointer; the wheel keeps the place under it; a click pins a point."""
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
    assert page.value('document.title') == 'points.txt: Delaunay triangulation'
    assert sum('Content Security Policy' in text for text in page.complaints) >= 3, page.complaints
    page.close()


def test_phone():
    """Nothing is wider than the screen, and the legend is next to the map, not on it."""
    for wide, high in (390, 844), (1200, 800):
        with opened(pages.page('delaunay', '--discs', *pages.FIXES), wide=wide, high=high) as page:
            assert page.value('document.documentElement.scrollWidth') <= wide
            assert page.value('''(() => { const a = document.querySelector("#map").getBoundingClientRect(), b = document.querySelector("aside").getBoundingClientRect();
              return a.right <= b.left || a.bottom <= b.top; })()''')


UTM = 'name,e,n,acc\n' + ''.join(f'P{k},{690000 + k * k * 37 % 900}.25,{5334000 + k * 61 % 900}.5,0.25\n' for k in range(30))
OF_UTM = ['--columns', 'e,n', '--id', 'name', '--radius-column', 'acc']


def drawn_texts(page):
    """Texts that the map draws anew."""
    page.value('(() => { const p = CanvasRenderingContext2D.prototype, old = p.fillText; window.texts = []; '
               'p.fillText = function (t, ...at) { window.texts.push(t); return old.call(this, t, ...at); }; })()')
    page.key('0')
    page.frames()
    return page.value('window.texts')


def test_labels():
    """No coordinate is cut at the rim of the map, however many digits it has."""
    file = pages.page('delaunay', *OF_UTM, pages.points(UTM, 'utm.csv'))
    for place in '', '#at=690300,5334300,0.02', '#at=690300,5334300,0.0003':
        for wide, high in (390, 844), (1200, 800):
            with opened(file, place=place, wide=wide, high=high) as page:
                inked = page.value('''(() => { const map = document.querySelector("#map"), out = new Set();
                  const c = new OffscreenCanvas(map.width, map.height).getContext("2d", {willReadFrequently: true});
                  c.drawImage(map, 0, 0);
                  for (const [x, w] of [[0, 2], [map.width - 1, 1]]) {
                    const d = c.getImageData(x, 0, w, map.height).data;
                    for (let k = 0; k < d.length; k += 4) out.add([d[k], d[k + 1], d[k + 2]].join());
                  }
                  return [...out]; })()''')
                assert inked == ['255,255,255'], (place, wide, inked)


def test_globe_ends():
    places = pages.points('0 80\n90 85\n180 88\n-90 84\n10 60\n-20 -70\n')
    with opened(pages.page('delaunay', '--sphere', places)) as page:
        numbers = [float(t) for t in drawn_texts(page) if t.lstrip('-').isdigit()]
        assert {90, -90, 180, -180} <= set(numbers) and max(map(abs, numbers)) <= 180 and not {100, 150} & set(numbers), numbers


def test_names_and_units():
    file = pages.points(UTM, 'utm.csv')
    with opened(pages.page('delaunay', *OF_UTM, '--crs', 'EPSG:25832', file), place='#point=3') as page:
        assert page.text('#title') == 'utm.csv: Delaunay triangulation' and 'EPSG:25832' in page.text('#about')
        assert page.text('#side-x') == '690333.25±0.25 m' and page.text('#side-y') == '5334183.5±0.25 m'
    with opened(pages.page('delaunay', *OF_UTM, '--crs', 'EPSG:2263', file), place='#point=3') as page:
        assert page.text('#side-x') == '690333.25±0.25'
    with opened(pages.page('delaunay', *OF_UTM, file)) as page:
        assert [page.value(f'document.querySelector("#{b}").title') for b in ('closer', 'farther', 'all')] == [
            'Zoom in (+)', 'Zoom out (-)', 'Fit all points (0)'] and page.text('#all') == 'Fit'
        assert page.text('#card p') == 'Hover over a point, or search for it, to see its rectangle and neighbours.'


def test_keyboard():
    """Points are chosen on the map without a pointer."""
    cross = pages.points('0 0\n3 0.5\n-3 0.25\n0.5 4\n0.25 -4\n')
    with opened(pages.page('delaunay', cross)) as page:
        page.value('document.querySelector("#map").focus()')
        page.key('Enter')
        assert page.text('#card h2') == 'Point 0'
        for key, there in ('ArrowRight', 1), ('ArrowLeft', 2), ('ArrowUp', 3), ('ArrowDown', 4):
            page.value('dispatchEvent(new KeyboardEvent("keydown", {key: "Escape", bubbles: true}))')
            assert page.text('#card h2') == 'A point'
            page.key('Enter')
            page.call('Input.dispatchKeyEvent', type='keyDown', key=key, modifiers=8)
            page.call('Input.dispatchKeyEvent', type='keyUp', key=key, modifiers=8)
            assert page.text('#card h2') == f'Point {there}', key
        assert page.text('#card p') == 'Pinned. Esc to release.'


def test_outliers():
    """A point far from the others is named, and the map can exclude it."""
    with opened(pages.page('delaunay', *OF_UTM, pages.points(UTM + 'Far,0,0,5\n', 'utm.csv'))) as page:
        assert 'Far' in page.text('#outliers') and not page.value('document.querySelector("#outliers").hidden')
        page.value('document.querySelector("#fit-others").click()')
        page.until("location.hash.includes('at=')")
        x, y, wide = map(float, page.value('new URLSearchParams(location.hash.slice(1)).get("at")').split(','))
        assert 690000 < x < 690900 and 5334000 < y < 5334900 and wide < 2000
    for args in [*OF_UTM, pages.points(UTM, 'utm.csv')], pages.FIXES, pages.PLACES:
        with opened(pages.page('delaunay', *args)) as page:
            assert page.value('document.querySelector("#outliers").hidden'), args


def test_fit():
    """All points are on the first map, beside their coordinates; a pinned point stays in view when the map is zoomed."""
    places = pages.points('2600000.123 1200000.456\n2600010.5 1200003.25\n2600005.75 1200011.125\n2600001 1200007\n9e6 9e6\n')

    def seen(page):
        page.value("history.replaceState(null, '', '#'); document.querySelector('input[type=checkbox]').click()")
        page.until("location.hash.includes('at=')")
        x, _, wide = map(float, page.value('new URLSearchParams(location.hash.slice(1)).get("at")').split(','))
        return x - wide / 2, x + wide / 2

    for wide, high in (390, 844), (640, 400), (1200, 800):
        with opened(pages.page('delaunay', places), wide=wide, high=high, place='#point=4') as page:
            before, rim = seen(page), 6.4e6 / wide
            assert before[0] + 4 * rim < 2.6e6 and 9e6 < before[1] - 4 * rim, (wide, before)
            assert not page.value('document.querySelector("#outliers").hidden')
            for _ in range(8):
                page.key('+')
            page.frames()
            after = seen(page)
            assert after[0] < 9e6 < after[1] and after[1] - after[0] < (before[1] - before[0]) / 8, (before, after)


def test_discs():
    """Cells of discs stand beside discs and the statuses of discs."""
    pairs = pages.csv_pairs('delaunay', '--discs', *pages.FIXES)
    with opened(pages.page('voronoi', '--discs', *pages.FIXES), place='#point=20') as page:
        assert 'points, discs' in page.text('aside')
        for status, name in ('legal', 'legal'), ('indeterminate', 'undecided'):
            own = sum(20 in ends and word == status for ends, word in pairs.items())
            assert f'{name} ({own})' in page.text('#card'), (status, own, page.text('#card'))


def test_phone_card():
    """Facts about a pinned point are on the first screen of a phone."""
    with opened(pages.page('delaunay', '--discs', *pages.FIXES), wide=390, high=844, place='#point=3') as page:
        assert page.value('document.querySelector("#side-y").getBoundingClientRect().bottom') < 844


def test_empty():
    with opened(pages.page('delaunay', pages.points(''))) as page:
        assert page.text('#message') == 'there are no points'


if __name__ == '__main__':
    with BROWSER:
        harness.main(globals())
