'use strict';
// The table of stages and judges, and one of its rows in full.

/** Outcomes from the least severe to the most severe; `unsupported` says nothing of the scene. */
const SEVERITY = ['unsupported', 'equal', 'within', 'ambiguous_only', 'dispute', 'expected', 'fails', 'different', 'missing', 'failed'];
const outcomeClass = (outcome) =>
  ['different', 'missing', 'failed', 'fails'].includes(outcome) ? 'bad' :
  ['dispute', 'expected'].includes(outcome) ? 'odd' : outcome === 'unsupported' ? 'quiet' : 'good';
const outcomeText = (outcome) => outcome.replace('_', ' ');

const isJudged = (row) => !['unsupported', 'missing', 'failed'].includes(row.outcome) && row.pixels > 0;
const sayNumber = (v) => (typeof v === 'number' ? String(Number(v.toPrecision(4))) : v);  // "inf" and "nan" are strings

/** Worst item of a row; of a disputed row, the worst disputed item; null: no item is apart. */
const worstOf = (row) => (row.outcome === 'dispute' ? row.dispute ?? row.worst : row.worst);

function shortText(row) {
  if (row.outcome === 'different' || row.outcome === 'expected') return `${row.differing} of ${row.pixels}`;
  if (row.outcome === 'dispute') return `${row.disputed} of ${row.pixels}`;
  if (row.outcome === 'ambiguous_only') return `${row.ambiguous} of ${row.pixels}`;
  return '';
}

/** Number with its unit: 3 in the unit 1/255 is written 3/255. */
const withUnit = (v, unit) => `${sayNumber(v)}${unit.startsWith('1/') ? unit.slice(1) : ` ${unit}`}`;

function sizeText(row) {
  const worst = worstOf(row);
  return worst ? `${withUnit(worst.difference, row.unit)}, allowed ${sayNumber(worst.tolerance)}` : '';
}

/** Rows are stages, columns who judged them. `chosen(row)` is called for the row of a cell. */
class StageTable {
  constructor(rows, stages, first, chosen) {
    const judges = [...new Set(rows.map((row) => row.title))];
    this.buttons = new Map();
    const table = element('table', {className: 'stages'});
    table.append(element('tr', {}, element('th', {scope: 'col'}, 'stage'),
                         ...judges.map((judge) => element('th', {scope: 'col'}, judge))));
    for (const stage of stages) {
      const of = rows.filter((row) => row.stage === stage);
      if (of.length === 0) continue;
      const cells = judges.map((judge) => {
        const row = of.find((r) => r.title === judge);
        return element('td', {}, row ? this.button(row, chosen) : '');
      });
      const isFirst = first !== null && first.stage === stage;
      table.append(element('tr', {className: isFirst ? 'first' : ''},
                           element('th', {scope: 'row'}, stage, isFirst ? element('div', {className: 'bad'}, 'first wrong') : ''),
                           ...cells));
    }
    this.host = element('div', {className: 'wide', tabIndex: 0, role: 'region', ariaLabel: 'stages'}, table);
  }
  button(row, chosen) {
    const button = element('button', {type: 'button', className: outcomeClass(row.outcome), onclick: () => chosen(row)},
                           `${outcomeText(row.outcome)} `, element('small', {}, shortText(row)),
                           element('small', {}, sizeText(row)));
    this.buttons.set(row, button);
    return button;
  }
  show(row) {
    for (const [of, button] of this.buttons) button.setAttribute('aria-pressed', String(of === row));
  }
}

/** Description list of a row's numbers, beside its histogram. */
function rowDetails(row) {
  const list = element('dl');
  const say = (name, value) => {
    if (value !== undefined && value !== '') list.append(element('dt', {}, name), element('dd', {}, String(value)));
  };
  say('outcome', outcomeText(row.outcome));
  if (isJudged(row)) {
    say('compared', row.pixels);
    say('beyond tolerance', row.differing);
    say('ambiguous', row.ambiguous);
    say('disputed', row.disputed);
    const worst = worstOf(row);
    if (worst) {
      say('worst at', worst.place);
      say('drawn', sayNumberInFull(worst.candidate));
      say('the reference', sayNumberInFull(worst.reference));
      say('apart', withUnit(worst.difference, row.unit));
      say('tolerance', `${withUnit(worst.tolerance, row.unit)}${row.ledger ? ` (ledger: ${row.ledger})` : ''}`);
      say('times the tolerance', row.outcome === 'dispute' ? '' : sayNumber(row.max_ratio));
    }
    say('disputed, for', row.dispute?.reason);
  }
  say('note', row.note);
  return element('div', {className: 'row'}, element('div', {}, element('h3', {}, `${row.stage}, by ${row.title}`), list),
                 isJudged(row) ? histogram(row) : '');
}

const sayNumberInFull = (v) => (typeof v === 'number' ? numberText(v) : v);

/** Histogram of differences: bar i counts items in [2^(i-13), 2^(i-12)) units, bar 0 equal ones, bar 19 no numbers. */
function histogram(row) {
  const total = row.histogram.reduce((sum, n) => sum + n, 0);
  if (total === 0) return '';
  const name = (i) => (i === 0 ? 'equal' : i === 19 ? 'no number' : `2^${i - 13}`);
  const svgElement = (tag, attributes, text = '') => {
    const out = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [key, value] of Object.entries(attributes)) out.setAttribute(key, value);
    out.textContent = text;
    return out;
  };
  const said = row.histogram.map((n, i) => (n > 0 ? `${name(i)}: ${n}` : '')).filter(Boolean).join(', ');
  const svg = svgElement('svg', {viewBox: '-12 0 520 116', class: 'histogram', role: 'img', 'aria-label': `differences: ${said}`});
  const most = Math.log1p(Math.max(...row.histogram));
  row.histogram.forEach((n, i) => {
    const height = n === 0 ? 0 : Math.max(2, 80 * Math.log1p(n) / most);
    const bar = svgElement('rect', {x: 24 * i + 2, y: 96 - height, width: 20, height});
    bar.append(svgElement('title', {}, `${name(i)}: ${n}`));
    svg.append(bar);
    const count = n > 9999 ? `${Math.round(n / 1000)}k` : n;
    if (n > 0) svg.append(svgElement('text', {x: 24 * i + 12, y: 92 - height, 'text-anchor': 'middle'}, count));
    if (i === 0 || i === 19 || (i % 3 === 1 && i > 1)) svg.append(svgElement('text', {x: 24 * i + 12, y: 110, 'text-anchor': 'middle'}, name(i)));
  });
  return element('figure', {}, svg, element('figcaption', {}, `items by difference, in ${row.unit || 'units'}; heights by logarithm`));
}

/** Row that judges a layer against a side, rows with marks first; against 'expected', any judge's row; null: none. */
function rowOf(rows, layer, side) {
  for (const stage of layer.judged) {
    const found = rows.filter((row) => row.stage === stage && (side === 'expected' || row.reference === side));
    const told = found.find((row) => row.mark !== undefined) ?? found.find(isJudged);
    if (told) return told;
  }
  return null;
}
/** Names of the layer and of the side that show what a row is about. */
function lookAt(view, row) {
  const layer = view.layers.find((l) => l.judged[0] === row.stage) ?? view.layers.find((l) => l.judged.includes(row.stage));
  const side = view.sides.find((s) => s === row.reference);
  return {layer: layer?.name, against: side};
}
