// SPDX-License-Identifier: Apache-2.0
// Controls a plan's page: the common data of its drawings, the selected runs, the chosen run, the theme, the printer.

const table = planTable(JSON.parse(document.getElementById('data').textContent));

/** Columns that can be drawn: columns with at least one number. */
const choices = table.columns.filter((c) => c.of.some((values) => values?.some((v) => !Number.isNaN(v))));

const views = [], waiting = new Set();
const picks = table.plans.map(() => null);  // a flag per run; null: all runs are selected

const page = {
  table, choices, chosen: null,
  picked: (plan, n) => picks[plan.index] === null || picks[plan.index][n] === 1,
  /** Selects the runs whose values are within all ranges on the columns' axes. */
  mark(brushes) {
    const ranges = [...brushes].map(([column, range]) => ({column, scale: scaleOf(column), range}));
    for (const plan of table.plans) picks[plan.index] = ranges.length === 0 ? null : Uint8Array.from(plan.states, (_, n) =>
      (ranges.every(({column, scale, range: [from, to]}) => {
        const s = scale.at(column.of[plan.index]?.[n] ?? NaN);
        return s >= from && s <= to;
      }) ? 1 : 0));
  },
  pick(brushes) {
    page.mark(brushes);
    drawAll();
  },
  choose(run) {
    if (!run) return;
    page.chosen = run;
    tellRun(run);
    drawAll();
  },
  /** Draws once, with the next frame. */
  soon(draw) {
    if (waiting.size === 0) requestAnimationFrame(() => {
      const due = [...waiting];
      waiting.clear();
      for (const one of due) one();
    });
    waiting.add(draw);
  },
};

const drawAll = () => views.forEach((view) => page.soon(view.draw));

function element(name, text, css) {
  return Object.assign(document.createElement(name), {textContent: text ?? '', className: css ?? ''});
}

/** Shows all values of one run, and the command for its report. */
function tellRun({plan, row}) {
  const number = plan.numberOf(row), list = element('table'), body = list.createTBody();
  for (const column of table.columns) {
    if (!column.of[plan.index]) continue;
    const line = body.insertRow(), value = column.of[plan.index][row], limit = column.limits[plan.index];
    line.appendChild(element('th', columnName(column)));
    line.appendChild(element('td', valueText(column, value)));
    if (limit && !((limit.min == null || value >= limit.min) && (limit.max == null || value <= limit.max)) && plan.states[row]) line.className = 'bad';
  }
  const state = element('p', `${table.plans.length > 1 ? plan.name + ', run ' : 'Run '}${number} ${STATES[plan.states[row]]}`, 'state');
  const parts = [state, list];
  if (plan.reports[number]) {
    const link = element('a', 'Its report');
    link.href = plan.reports[number];
    parts.push(link);
  }
  parts.push(element('pre', `${plan.repeats} ${number} --html run-${number}.html`, 'text'));
  document.getElementById('run').replaceChildren(...parts);
  document.getElementById('number').value = number;
}

/** Writes the legend: a colour for each plan and each outcome that occurs. */
function legend() {
  const parent = document.getElementById('legend');
  for (const plan of table.plans) for (const bad of [0, 1]) {
    if (!plan.states.some((s) => (s !== 0) === Boolean(bad))) continue;
    const asks = table.columns.some((c) => c.limits[plan.index]), entry = parent.appendChild(element('span'));
    entry.append(element('i'), (table.plans.length > 1 ? plan.name + ': ' : '') + (bad ? 'misses a requirement, or a fault (+)' : asks ? 'holds' : 'runs'));
    if (bad) entry.firstChild.style.clipPath = 'polygon(0 0, 100% 0, 50% 100%)';  // the shape in the drawing
    entry.firstChild.style.background = `var(--${[['a', 'c'], ['b', 'reference']][bad][plan.index]})`;
  }
}

/** Redraws if the theme, the width or the printer changes. */
function watch() {
  const repaint = () => {
    readPalette();
    for (const view of views) view.draw();
  };
  let width = innerWidth;
  new ResizeObserver(() => {
    const main = document.querySelector('main').clientWidth;
    if (main !== width) drawAll();
    width = main;
  }).observe(document.querySelector('main'));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  for (const [when, printing] of [['beforeprint', true], ['afterprint', false]]) addEventListener(when, () => {
    document.documentElement.classList.toggle('printing', printing);
    repaint();
  });
}

function start() {
  const begin = performance.now();
  globalThis.sixstep = {page, paretoFront, heatCells, scaleOf, table};  // for scripts and tests
  if (choices.length === 0) return;
  document.getElementById('explore').hidden = false;
  readPalette();
  legend();
  const figures = choices.filter((c) => c.kind === 'figure'), places = choices.filter((c) => c.kind !== 'figure');
  const across = places[0] ?? figures[1] ?? choices[0], up = figures[0] ?? choices[0];
  views.push(cloud('scatter', page, {across, up}), parallelView(page), heatView(page), frontView(page));
  document.getElementById('number').addEventListener('change', (event) => {
    const number = Number(event.target.value);
    for (const plan of table.plans) {
      const row = plan.rowOf(number);
      if (row >= 0 && row < plan.runs) return page.choose({plan, row});
    }
    document.getElementById('run').replaceChildren(element('p', 'There is no such run here.', 'quiet'));
  });
  for (const view of views) view.draw();
  watch();
  sixstep.ready_ms = performance.now() - begin;
}

start();
