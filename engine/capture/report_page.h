// The fixed part of the report: style and script. Data comes as one JSON object, `capture`.
#pragma once

namespace ag::capture {

inline constexpr const char* kReportStyle = R"css(
body { font: 14px/1.4 system-ui, sans-serif; margin: 24px auto; max-width: 1280px; padding: 0 16px; color: #1b2430; }
h1 { font-size: 22px; margin: 0 0 4px } h2 { font-size: 17px; margin: 28px 0 8px }
h3 { font-size: 14px; margin: 14px 0 4px } ul { margin: 0; padding-left: 20px }
.note { color: #5a6b7d } .scroll { overflow: auto; border: 1px solid #d5dbe2; max-height: 620px }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums }
th { position: sticky; top: 0; background: #eef2f6; cursor: pointer; white-space: nowrap; user-select: none }
th, td { padding: 3px 8px; text-align: right; border-bottom: 1px solid #e7ebef; vertical-align: top }
th:first-child, td:first-child, th.words, td.words { text-align: left } td.none { color: #b4bcc5 }
td.words { font-size: 12px; color: #5a6b7d; max-width: 230px; overflow: hidden; text-overflow: ellipsis;
  white-space: nowrap }
th[data-way="up"]::after { content: " \25b2" } th[data-way="down"]::after { content: " \25bc" }
#strip { display: flex; align-items: flex-end; height: 90px; gap: 1px; border-bottom: 1px solid #aab4bf }
#strip div { flex: 1; background: #7ba7d0; min-height: 1px; cursor: pointer }
#strip div.forced { background: #c3c9d0 } #strip div.chosen { background: #d9662b }
#gantt div.row { display: flex; height: 17px; font-size: 12px } #gantt span.name { width: 250px; flex: none }
#gantt div.bars { position: relative; flex: 1; background: #f4f6f8; border-bottom: 1px solid #fff }
#gantt i { position: absolute; top: 1px; bottom: 1px; background: #3c7fb8; min-width: 1px } #gantt i.cpu { background: #d9a12b }
#gantt i.system { background: #5aa86b } #gantt i.wait { background: #eadcb8 } #gantt .left-out { color: #98a3af }
i.key { display: inline-block; width: 10px; height: 10px; background: #3c7fb8 } i.key.cpu { background: #d9a12b }
i.key.system { background: #5aa86b } i.key.wait { background: #eadcb8 }
i.key.gap, #gantt i.gap { background: #d98a8a } i.key.forced { background: #c3c9d0 }
#dearest div { display: flex; align-items: center; height: 19px } #dearest span { width: 250px; flex: none }
#dearest i { background: #3c7fb8; height: 13px; margin-right: 6px; min-width: 1px } #dearest em { font-style: normal }
#dearest i.cpu { background: #d9a12b } #dearest i.system { background: #5aa86b }
#slider { position: relative; display: inline-block; width: 100%; max-width: 960px; margin-top: 8px; background: #000 }
#slider img { display: block; width: 100%; image-rendering: pixelated }
#slider img.over { position: absolute; inset: 0; height: 100% }
#slider b { position: absolute; top: 0; bottom: 0; width: 2px; background: #fff }
#pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(220px, 1fr)); gap: 10px }
figure { margin: 0 } figure img { width: 100%; background: #000 } figcaption { font-size: 12px }
)css";

inline constexpr const char* kReportScript = R"js(
const $ = id => document.getElementById(id);
const make = (tag, parent, text, name) => {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (name) e.className = name;
  if (parent) parent.append(e);
  return e;
};

const brief = v => v.toLocaleString('en', { maximumFractionDigits: v >= 100 ? 0 : v >= 10 ? 1 : 3 });

// A click on a header sorts, another turns the order round; `first` is the column it begins with.
function sortable(head, body, columns, rows, first) {
  const fill = sorted => {
    body.replaceChildren();
    for (const row of sorted) {
      const tr = make('tr', body);
      row.forEach((v, i) => {
        const words = columns[i].words;
        const td = make('td', tr, words ? v : brief(v), words ? (i ? 'words' : '') : v === 0 ? 'none' : '');
        if (words && i) td.title = v;
      });
    }
  };
  columns.forEach((c, i) => {
    const th = make('th', head, c.name, c.words ? 'words' : '');
    th.title = c.help;
    th.onclick = () => {
      const down = th.dataset.way ? th.dataset.way === 'up' : !c.words;
      head.querySelectorAll('th').forEach(h => delete h.dataset.way);
      th.dataset.way = down ? 'down' : 'up';
      fill([...rows].sort((a, b) => (c.words ? String(a[i]).localeCompare(b[i]) : a[i] - b[i]) * (down ? -1 : 1)));
    };
  });
  fill(rows);
  if (first !== undefined) head.children[first].onclick();
}
// By the time where it ran, else by the time it takes if it does.
sortable($('head'), $('rows'), capture.columns, capture.rows, capture.rows.some(r => r[1] > 0) ? 1 : 3);
sortable($('memory-head'), $('memory'), capture.memoryColumns, capture.memory);

// Timeline: the frames as columns, the chosen one as bars on one clock.
const longest = Math.max(...capture.frames.map(f => f.ms), 1e-6);
const columnsOf = capture.frames.map((f, i) => {
  const d = make('div', $('strip'), undefined, f.forced ? 'forced' : '');
  d.style.height = 100 * f.ms / longest + '%';
  d.title = `frame ${f.number}: GPU ${f.ms.toFixed(3)} ms${f.forced ? ', nothing skipped' : ''}`;
  d.onclick = () => choose(i);
  return d;
});
function choose(index) {
  columnsOf.forEach((d, i) => d.classList.toggle('chosen', i === index));
  const f = capture.frames[index], all = f.bars.filter(b => b.end !== null);
  const from = Math.min(...all.map(b => b.begin)), to = Math.max(...all.map(b => b.end));
  const ran = all.filter(b => b.kind === 'gpu'), steps = all.filter(b => b.kind !== 'gap');
  const length = steps.length ? Math.max(...steps.map(b => b.end)) - Math.min(...steps.map(b => b.begin)) : 0;
  $('which').textContent = `frame ${f.number}${f.forced ? ' (warm-up, nothing skipped)' : ''}: GPU ` +
    `${f.ms.toFixed(3)} ms in ${ran.length} passes; ${length.toFixed(3)} ms from the first of its steps to the last`;
  $('counters').textContent = f.counters.map(c => `${c.name} ${brief(c.value)}`).join(', ');
  showDearest(f);
  showFindings(f.findings);
  const gantt = $('gantt'), lanes = new Map();
  gantt.replaceChildren();
  for (const b of f.bars) {
    if (!lanes.has(b.lane)) {
      const row = make('div', gantt, undefined, 'row');
      make('span', row, b.lane, 'name' + (b.end === null ? ' left-out' : ''));
      lanes.set(b.lane, make('div', row, undefined, 'bars'));
    }
    if (b.end === null) { make('span', lanes.get(b.lane), b.why, 'left-out'); continue; }
    const bar = make('i', lanes.get(b.lane), undefined, b.kind);
    bar.style.left = 100 * (b.begin - from) / (to - from) + '%';
    bar.style.width = 100 * (b.end - b.begin) / (to - from) + '%';
    bar.title = b.kind === 'gap' ? b.name : `${b.name}: ${brief(b.end - b.begin)} ms`;
  }
}
// What took longest of the frame, on either side; a system that ran in several ticks once.
function showDearest(f) {
  const sums = new Map();
  for (const b of f.bars.filter(b => b.end !== null && b.kind !== 'wait' && b.kind !== 'gap'))
    sums.set(b.name, { name: b.name, kind: b.kind, ms: (sums.get(b.name)?.ms ?? 0) + b.end - b.begin });
  const dearest = $('dearest'), share = ms => 100 * ms / Math.max(f.ms, 1e-6);
  dearest.replaceChildren();
  for (const b of [...sums.values()].sort((a, b) => b.ms - a.ms).slice(0, 8)) {
    const row = make('div', dearest);
    make('span', row, b.name);
    make('i', row, undefined, b.kind).style.width = Math.min(0.6 * share(b.ms), 60) + '%';
    make('em', row, `${brief(b.ms)} ms` + (b.kind === 'gpu' ? `, ${share(b.ms).toFixed(0)} %` : ''));
  }
}
function showFindings(found) {
  const list = (id, sentences, none) => {
    $(id).replaceChildren();
    for (const sentence of sentences.length ? sentences : [none]) make('li', $(id), sentence);
  };
  list('advice', found.advice, 'None of the measured settings would save a hundredth of it.');
  list('gaps', found.gaps.map(g => g.why), 'None longer than a fiftieth of the frame.');
  list('anew', found.anew, 'Nothing.');
}
let slowest = 0;
capture.frames.forEach((f, i) => { if (!f.forced && (capture.frames[slowest].forced || f.ms > capture.frames[slowest].ms)) slowest = i; });
if (capture.frames.length) choose(slowest);

// Pictures: any two on top of each other, the slider moves the line between them.
const over = $('over'), under = $('under');
function show() {
  const a = capture.pictures[$('left').value], b = capture.pictures[$('right').value];
  if (!a || !b) return;
  over.src = a.data;
  under.src = b.data;
  cut();
}
function cut() {
  const share = $('cut').value;
  over.style.clipPath = `inset(0 ${100 - share}% 0 0)`;
  $('line').style.left = share + '%';
}
capture.pictures.forEach((p, i) => {
  for (const id of ['left', 'right']) make('option', $(id), p.name).value = i;
  const figure = make('figure', $('pictures')), img = make('img', figure);
  img.src = p.data;
  img.alt = p.name;
  make('figcaption', figure, p.pass ? `${p.name}, by ${p.pass}` : p.name);
});
const index = name => capture.pictures.findIndex(p => p.name === name);
$('left').value = Math.max(index('composite.display'), 0);
$('right').value = index('reference') >= 0 ? index('reference') : Math.max(index('composite.radiance'), 0);
$('left').onchange = $('right').onchange = show;
$('cut').oninput = cut;
$('slider').onpointermove = e => {
  if (e.pointerType === 'mouse' && !e.buttons) return;
  const r = $('slider').getBoundingClientRect();
  $('cut').value = 100 * (e.clientX - r.left) / r.width;
  cut();
};
show();
)js";

}  // namespace ag::capture
