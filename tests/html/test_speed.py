# SPDX-License-Identifier: LGPL-3.0-or-later
"""How long pages take, by the marks that they leave: the first picture, and a frame while the map moves.

What a quiet machine should show (0.3 s, 16 ms) is printed next to the measured time. A test fails by ratios alone: to a
plain canvas that draws as many lines, in the same browser at the same time."""
import pathlib
import random
import sys

import browser
import pages
from pages import harness

if not browser.find():
    print('skipped: there is no chromium')
    sys.exit(77)
BROWSER = browser.Browser()

# The work of a frame, between callbacks before and after that of the page, while the pointer drags the map.
FRAMES = '''(async () => {
  const map = document.querySelector("#map"), spent = [], frame = () => new Promise(requestAnimationFrame);
  const fire = (type, x, y) => map.dispatchEvent(new PointerEvent(type, {pointerId: 1, clientX: x, clientY: y, buttons: 1, bubbles: true}));
  map.setPointerCapture = () => {};
  fire("pointerdown", 400, 400);
  for (let k = 0; k < 60; k++) {
    let begun;
    const before = frame().then(() => { begun = performance.now(); });
    fire("pointermove", 400 + 3 * k, 400 + 2 * k);
    const after = frame().then(() => { map.getContext("2d").getImageData(0, 0, 1, 1); return performance.now(); }); // what was asked for is done
    await before;
    spent.push(await after - begun);
  }
  fire("pointerup", 580, 520);
  return spent.sort((a, b) => a - b);
})()'''
# The same of a canvas of the map's size on which the same number of lines, of the same length and width, are drawn in a
# path, and as many dots. Lines of one pixel are quicker than wider ones.
PLAIN = '''(async (count, long, broad) => {
  const map = document.querySelector("#map"), canvas = document.createElement("canvas"), spent = [];
  const wide = canvas.width = map.width, high = canvas.height = map.height, ctx = canvas.getContext("2d");
  let seed = 1;
  const chance = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  const ends = Float64Array.from({length: 4 * count}, (_, k) => (k & 2 ? 2 * long * chance() - long : (k & 1 ? high : wide) * chance()));
  for (let round = 0; round < 15; round++) {
    await new Promise(requestAnimationFrame);
    const begun = performance.now();
    ctx.clearRect(0, 0, wide, high);
    ctx.beginPath();
    ctx.lineWidth = broad;
    for (let k = 0; k < ends.length; k += 4) {
      ctx.moveTo(ends[k] + round, ends[k + 1]);
      ctx.lineTo(ends[k] + round + ends[k + 2], ends[k + 1] + ends[k + 3]);
    }
    ctx.stroke();
    for (let k = 0; k < ends.length; k += 4) ctx.fillRect(ends[k] + round, ends[k + 1], 2, 2);
    ctx.getImageData(0, 0, 1, 1);
    spent.push(performance.now() - begun);
  }
  return spent.sort((a, b) => a - b)[7];
})'''


def plain(page, lines, long=15, broad=1):
    """Milliseconds."""
    return page.value(f'{PLAIN}({lines}, {long}, {broad})')


def first_picture(page):
    """Milliseconds from navigation to the page's own mark, and from when its script began: without the browser's start."""
    at, begun = page.value('''(() => { const [mark] = performance.getEntriesByName("first picture"), [load] = performance.getEntriesByType("navigation");
      return [mark.startTime, mark.startTime - load.responseEnd]; })()''')
    return at, begun


def drag(page, name, lines, shape):
    """Times a plain canvas; a thousand lines are the fewest that take a time worth telling."""
    spent, usual = page.value(FRAMES), plain(page, max(lines, 1000), *shape)
    middle, high = spent[30], spent[54]
    print(f'{name}: a frame while dragging: median {middle:.1f} ms, nine of ten within {high:.1f} ms (wanted: 16); '
          f'{lines} lines on a plain canvas: {usual:.1f} ms')
    return middle / usual


def look(file, name, lines, place='', shape=()):
    """Ratios of the better of three openings: first picture and drag, to a plain canvas of all lines, and of those seen,
    which are as long and wide."""
    all_lines, seen = lines
    first, moved = [], []
    for _ in range(3):
        page = BROWSER.open(file, place=place)
        at, begun = first_picture(page)
        usual = plain(page, all_lines)
        print(f'{name}: first picture {at:.0f} ms after navigation, {begun:.0f} ms of them with the page (wanted: 300); '
              f'{all_lines} lines on a plain canvas: {usual:.1f} ms')
        first.append(begun / usual)
        moved.append(drag(page, name, seen, shape))
        page.close()
    print(f'{name}: {min(first):.1f} and {min(moved):.2f} times a plain canvas')
    return min(first), min(moved)


def test_airports():
    first, moved = look(pages.page('delaunay', '--radius', '0.01', *pages.PLACES), 'airports', (11415, 11415))
    assert first < 40 and moved < 3


def test_many_boxes():
    """Zoomed in, only visible parts cost time."""
    chance = random.Random(5)
    text = ''.join(f'{chance.uniform(0, 1000):.4f}+-0.001 {chance.uniform(0, 1000):.4f}+-0.001\n' for _ in range(98000))
    file = pages.page('delaunay', pages.points(text))
    print(f'98,000 boxes: {pathlib.Path(file).stat().st_size} bytes')
    first, moved = look(file, '98,000 boxes, zoomed', (294000, 500), place='#at=500,500,40', shape=(90, 1.4))
    assert first < 15 and moved < 2


if __name__ == '__main__':
    with BROWSER:
        harness.main(globals())
