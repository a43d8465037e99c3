"""The page around a report: style and the few lines of script that move pictures."""

from __future__ import annotations

import html

STYLE = """
:root { color-scheme: light dark; --ink: #1b1b1b; --paper: #fdfdfc; --soft: #6a6a6a; --line: #d8d8d4; --plot: #ffffff }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e6e1; --paper: #17181a; --soft: #a3a19c; --line: #3a3b3e; --plot: #f4f4f1 } }
* { box-sizing: border-box }
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem; font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: var(--paper) }
h1 { font-size: 1.9rem; margin: 0 0 .5rem } h2 { margin: 2.5rem 0 .5rem; border-top: 1px solid var(--line); padding-top: 1.2rem } h3 { margin: 1.2rem 0 .4rem }
nav ol { columns: 2; padding-left: 1.4rem } nav a { color: inherit }
.grid { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 17rem), 1fr)); gap: 1rem; margin: .8rem 0 }
.wide { width: 100%; height: auto; border-radius: 4px }
figure { margin: 0 } figcaption { font-size: .85rem; color: var(--soft) }
.plot svg { width: 100%; height: auto; max-width: 42rem; background: var(--plot); border-radius: 4px }
.plots { grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr)) }
.scroll { overflow-x: auto } table { border-collapse: collapse; margin: .8rem 0; font-variant-numeric: tabular-nums }
caption { text-align: left; font-size: .85rem; color: var(--soft); padding-bottom: .3rem }
th, td { text-align: right; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line); white-space: nowrap } th[scope=row], thead th:first-child { text-align: left }
td small { color: var(--soft) } .paper { border-left: 3px solid var(--line); padding-left: .8rem }
code { font-size: .85rem; overflow-wrap: anywhere } .command, .hint { color: var(--soft); font-size: .9rem }
.zoom, .slider { position: relative; overflow: hidden; background: #000; border-radius: 4px; touch-action: none }
.zoom img, .pair img { position: absolute; inset: 0; width: 100%; height: 100%; image-rendering: pixelated; transform-origin: 0 0; user-select: none }
.slider { max-width: 60rem } .pair { position: absolute; inset: 0 } .slider input { position: absolute; inset: auto 0 .4rem 0; width: 96%; margin: 0 2% }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .2rem 1rem } dt { color: var(--soft) } dd { margin: 0; overflow-wrap: anywhere }
@media print { .slider, .pick, .hint { display: none } section { break-inside: avoid-page } }
"""

SCRIPT = """
for (const gallery of document.querySelectorAll('.gallery')) {
  const slider = gallery.querySelector('.slider'), [under, over] = slider.querySelectorAll('.pair img');
  const range = slider.querySelector('input'), [left, right] = gallery.querySelectorAll('select');
  const source = name => [...gallery.querySelectorAll('[data-name]')].find(image => image.dataset.name === name).src;
  const show = () => {
    under.src = source(right.value); over.src = source(left.value);
    over.style.clipPath = `inset(0 ${100 - range.value}% 0 0)`;
  };
  left.selectedIndex = 0; right.selectedIndex = right.options.length - 1;
  for (const control of [range, left, right]) control.addEventListener('input', show);
  show();
  // All pictures of a gallery show the same part: scale, and the part's corner in picture widths.
  const boxes = [...gallery.querySelectorAll('.zoom')]; let scale = 1, x = 0, y = 0;
  const place = () => {
    x = Math.min(Math.max(x, 0), 1 - 1 / scale); y = Math.min(Math.max(y, 0), 1 - 1 / scale);
    for (const box of boxes) box.firstChild.style.transform = `scale(${scale}) translate(${-100 * x}%, ${-100 * y}%)`;
  };
  for (const box of boxes) {
    box.addEventListener('wheel', event => {
      event.preventDefault();
      const area = box.getBoundingClientRect(), u = (event.clientX - area.left) / area.width, v = (event.clientY - area.top) / area.height;
      const next = Math.min(Math.max(scale * Math.exp(-event.deltaY / 300), 1), 16);
      x += u / scale - u / next; y += v / scale - v / next; scale = next; place();
    }, {passive: false});
    box.addEventListener('pointerdown', event => box.setPointerCapture(event.pointerId));
    box.addEventListener('pointermove', event => {
      if (!box.hasPointerCapture(event.pointerId)) return;
      const area = box.getBoundingClientRect();
      x -= event.movementX / area.width / scale; y -= event.movementY / area.height / scale; place();
    });
    box.addEventListener('dblclick', () => { scale = 1; x = y = 0; place(); });
  }
}
"""


def html_page(title: str, body: str) -> str:
    return (f"<!doctype html><html lang=en><head><meta charset=utf-8><meta name=viewport content='width=device-width, initial-scale=1'>"
            f"<title>{html.escape(title)}</title><link rel=icon href='data:,'><style>{STYLE}</style></head><body><h1>{html.escape(title)}</h1>{body}"
            f"<script>{SCRIPT}</script></body></html>\n")
