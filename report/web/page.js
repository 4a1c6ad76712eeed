// SPDX-License-Identifier: Apache-2.0
// Adapts charts to the page: its width, the theme, the printer.

function watchPage(charts, changed, parent = document.getElementById('charts')) {
  const repaint = () => {
    readPalette();
    for (const {plot} of charts) plot.redraw();
    changed();
  };
  const resize = () => {
    for (const {plot, box} of charts) if (box.clientWidth) plot.setSize({width: box.clientWidth, height: plot.height});
    changed();
  };
  new ResizeObserver(resize).observe(parent);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  // Paper is white in every theme, and narrower than most screens.
  addEventListener('beforeprint', () => {
    document.documentElement.classList.add('printing');
    readPalette();
    for (const {plot} of charts) plot.setSize({width: 680, height: plot.height});
    repaint();
  });
  addEventListener('afterprint', () => {
    document.documentElement.classList.remove('printing');
    repaint();
    resize();
  });
}
