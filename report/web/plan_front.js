// SPDX-License-Identifier: Apache-2.0
// Draws the best trade-offs of two figures: no other run is better in one figure without being worse in the other.

/** Rows of the front, from the best x value to the best y value; `signs` are 1 if higher is better, -1 if lower is better. Equal runs
 *  are all on the front. Rows without a value are not on the front. */
function paretoFront(xs, ys, [signX, signY], picked = () => true) {
  const rows = [];
  for (let n = 0; n < xs.length; ++n) if (!Number.isNaN(xs[n]) && !Number.isNaN(ys[n]) && picked(n)) rows.push(n);
  rows.sort((a, b) => signX * (xs[b] - xs[a]) || signY * (ys[b] - ys[a]) || a - b);
  const front = [];
  let best = -Infinity, x = NaN;
  for (const n of rows) {
    const y = signY * ys[n], equal = front.length > 0 && xs[n] === x && y === best;
    if (!(y > best || equal || front.length === 0)) continue;
    front.push(n);
    best = y;
    x = xs[n];
  }
  return front;
}

/** Draws steps from run to run, because no run exists between two neighbours. */
function drawFront(f, plan, front) {
  const {ctx} = f, xs = f.across.of[plan.index], ys = f.up.of[plan.index];
  ctx.strokeStyle = palette.ink;
  ctx.lineWidth = 1.6;
  ctx.setLineDash(plan.index ? [6, 4] : []);
  ctx.beginPath();
  front.forEach((n, at) => {
    if (at > 0) ctx.lineTo(f.px(xs[n]), f.py(ys[front[at - 1]]));
    ctx.lineTo(f.px(xs[n]), f.py(ys[n]));
  });
  ctx.stroke();
  ctx.setLineDash([]);
  ctx.fillStyle = palette.ink;
  for (const n of front) ctx.fillRect(f.px(xs[n]) - 2.5, f.py(ys[n]) - 2.5, 5, 5);
}

const MOST_LISTED = 200;

function listFront(page, fronts, x, y) {
  const list = document.querySelector('#front-list div'), table = document.createElement('table');
  const head = table.createTHead().insertRow();
  for (const text of ['Run', columnTitle(x), columnTitle(y)]) head.appendChild(document.createElement('th')).textContent = text;
  const body = table.createTBody();
  for (const {plan, front} of fronts) for (const n of front.slice(0, MOST_LISTED)) {
    const row = body.insertRow();
    row.insertCell().textContent = (page.table.plans.length > 1 ? plan.name + ' ' : '') + plan.numberOf(n);
    for (const column of [x, y]) row.insertCell().textContent = valueText(column, column.of[plan.index][n]).replace(/\u00a0.*/, '');
    row.addEventListener('click', () => page.choose({plan, row: n}));
  }
  list.replaceChildren(table);
}

/** Whether a lower value of a figure is better. Not if its requirements have only a lower limit. */
const likesHigh = (column) => column.limits.some((l) => l && l.min != null && l.max == null);

function frontView(page) {
  const bests = {x: document.getElementById('front-x-best'), y: document.getElementById('front-y-best')};
  const figures = page.choices.filter((c) => c.kind === 'figure'), [x, y] = figures.length > 1 ? figures : page.choices;
  bests.x.value = likesHigh(x) ? '1' : '-1';
  bests.y.value = likesHigh(y) ? '1' : '-1';
  const extra = (f) => {
    const signs = [Number(bests.x.value), Number(bests.y.value)];
    // Runs that stopped or could not run are left out.
    const fronts = page.table.plans.filter((plan) => f.across.of[plan.index] && f.up.of[plan.index]).map((plan) => ({plan,
      front: paretoFront(f.across.of[plan.index], f.up.of[plan.index], signs, (n) => plan.states[n] < 2 && page.picked(plan, n))}));
    for (const {plan, front} of fronts) drawFront(f, plan, front);
    listFront(page, fronts, f.across, f.up);
    const count = fronts.reduce((sum, {front}) => sum + front.length, 0);
    document.getElementById('front-said').textContent = `${count} ${count === 1 ? 'run' : 'runs'}`;
  };
  const view = cloud('front', page, {across: x, up: y ?? x, extra});
  for (const select of Object.values(bests)) select.addEventListener('change', view.draw);
  return view;
}
