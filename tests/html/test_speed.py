# SPDX-License-Identifier: LGPL-3.0-or-later
"""How long pages take: the first picture, and a frame while the map moves. What a quiet machine should show is printed;
limits are wide, since machines are shared and draw without a graphics card here."""
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
WIDE = 20  # times what is wanted

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
    const after = frame().then(() => performance.now());
    await before;
    spent.push(await after - begun);
  }
  fire("pointerup", 580, 520);
  return spent.sort((a, b) => a - b);
})()'''


def first_picture(page):
    """Milliseconds of the page's own thread, and of the clock, from navigation to the first picture."""
    return page.value("performance.getEntriesByName('first picture')[0].startTime")


def drag(page, name):
    spent = page.value(FRAMES)
    middle, high = spent[30], spent[54]
    print(f'{name}: a frame while dragging: median {middle:.1f} ms, nine of ten within {high:.1f} ms')
    assert middle < 16 * WIDE, name


def test_airports():
    file = pages.page('delaunay', '--radius', '0.01', *pages.PLACES)
    first = []
    for _ in range(3):
        page = BROWSER.open(file)
        first.append(first_picture(page))
        drag(page, 'airports')
        page.close()
    print(f'airports: first picture after {min(first):.0f} ms')
    assert min(first) < 300 * WIDE


def test_many_boxes():
    """Zoomed in, only what is seen costs."""
    chance = random.Random(5)
    text = ''.join(f'{chance.uniform(0, 1000):.4f}+-0.001 {chance.uniform(0, 1000):.4f}+-0.001\n' for _ in range(98000))
    file = pages.page('delaunay', pages.points(text))
    print(f'98,000 boxes: {pathlib.Path(file).stat().st_size} bytes')
    page = BROWSER.open(file, place='#at=500,500,40')
    print(f'98,000 boxes: first picture after {first_picture(page):.0f} ms')
    drag(page, '98,000 boxes, zoomed')
    page.close()


if __name__ == '__main__':
    with BROWSER:
        harness.main(globals())
