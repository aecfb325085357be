'use strict';
// The page of plumb check: an overview of scenes, and one scene at a time. The address after # keeps the place.

const report = JSON.parse(document.getElementById('report').textContent);
const byName = new Map(report.scenes.map((scene) => [scene.key, scene]));
const by = (id) => document.getElementById(id);
let open = null;    // the SceneView that is shown
let opening = null;  // the key of the scene that is being read or shown
let arrived = null;  // what a scene's file hands over

/** Called by a scene's file. */
function sceneArrived(scene) {
  arrived = scene;
}

function load(file) {
  return new Promise((resolve, reject) => {
    const script = element('script', {src: file, onerror: () => reject(new Error(`${file} cannot be read`))});
    script.onload = () => { script.remove(); resolve(arrived); };
    document.head.append(script);
  });
}

// The address: #filter=...&outcome=...&stage=...&group=... and, of a scene, &scene=...&picture=... as viewers have it.
const place = () => new URLSearchParams(location.hash.slice(1));
function go(changes, {anew = false} = {}) {
  const to = place();
  for (const [name, value] of Object.entries(changes)) {
    if (value === null || value === '') to.delete(name);
    else to.set(name, value);
  }
  const address = `#${to}`;
  if (address === location.hash || (address === '#' && location.hash === '')) return;
  if (anew) location.hash = address;
  else history.replaceState(null, '', address);
}
const VIEWER_PARTS = {picture: null, against: null, as: null, pixel: null, zoom: null};

let keeping = 0;
/**
 * Keeps the viewer's state in the address, 0.4 s after the last change: browsers stop pages that change their address
 * with every move of the pointer.
 */
function keepViewer(viewer) {
  clearTimeout(keeping);
  keeping = setTimeout(() => {
    if (open?.viewer !== viewer) return;
    const {layer, view, against, mode, pixel, scale} = viewer;
    go({picture: layer?.name ?? null, against: view.sides[against] ?? null, as: mode === MODES[0] ? null : mode,
        pixel: pixel ? pixel.join(',') : null, zoom: scale || null});
  }, 400);
}

// ---- overview

/** Parts of a name, between which lines may break: after each / and _. */
const breakable = (name) => name.split(/(?<=[/_])/).flatMap((part, i) => (i === 0 ? [part] : [element('wbr'), part]));

function card(scene) {
  const picture = scene.thumbnail ? element('img', {src: scene.thumbnail, alt: '', loading: 'lazy'}) : 'no picture';
  const says = scene.first ? `${outcomeText(scene.outcome)}: ${scene.first}` : outcomeText(scene.outcome);
  const link = element('a', {href: `#${new URLSearchParams({scene: scene.key})}`, className: scene.fails ? 'fails' : scene.outcome},
                       element('span', {className: 'shot'}, picture), element('div', {}, ...breakable(scene.name)),
                       element('div', {className: outcomeClass(scene.outcome)}, says));
  link.onclick = (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    go({scene: scene.key}, {anew: true});
  };
  scene.card = element('li', {}, link);
  return scene.card;
}

function choices() {
  const of = {
    outcome: [...SEVERITY].reverse().filter((o) => report.scenes.some((s) => s.outcome === o)),
    stage: report.stages.filter((stage) => report.scenes.some((s) => s.first === stage)),
    group: [...new Set(report.scenes.map((s) => s.group))].sort(),
  };
  return Object.entries(of).filter(([, names]) => names.length > 0).map(([name, names]) => {
    const select = element('select', {id: `by-${name}`}, element('option', {value: ''}, 'any'));
    for (const value of names) {
      const count = report.scenes.filter((s) => (name === 'stage' ? s.first : s[name]) === value).length;
      select.append(element('option', {value}, `${outcomeText(value)} (${count})`));
    }
    select.onchange = () => { go({[name]: select.value}); filter(); };
    return element('label', {className: 'set'}, `${name === 'stage' ? 'first wrong stage' : name} `, select);
  });
}

const shownScenes = () => report.scenes.filter((scene) => !scene.card.hidden);

function filter() {
  const at = place();
  const words = (at.get('filter') ?? '').toLowerCase().split(/\s+/).filter(Boolean);
  if (by('filter') !== document.activeElement) by('filter').value = at.get('filter') ?? '';
  for (const name of ['outcome', 'stage', 'group']) if (by(`by-${name}`)) by(`by-${name}`).value = at.get(name) ?? '';
  const is = (name, value) => !at.get(name) || at.get(name) === value;
  for (const scene of report.scenes) {
    const text = `${scene.name} ${outcomeText(scene.outcome)} ${scene.first ?? ''} ${scene.description}`.toLowerCase();
    scene.card.hidden = !(words.every((word) => text.includes(word)) && is('outcome', scene.outcome) &&
                          is('stage', scene.first) && is('group', scene.group));
  }
  const {length} = shownScenes();
  by('count').textContent = length === report.scenes.length ? `${length} scenes` : `${length} of ${report.scenes.length} scenes`;
}

function build() {
  report.scenes.sort((a, b) => b.fails - a.fails || SEVERITY.indexOf(b.outcome) - SEVERITY.indexOf(a.outcome));
  by('tools').append(themeButton(), element('button', {type: 'button', id: 'ask', onclick: () => by('help').showModal()}, 'keys'));
  by('choices').append(...choices());
  by('cards').append(...report.scenes.map(card));
  by('filter').oninput = () => { go({filter: by('filter').value}); filter(); };
}

// ---- one scene

async function show() {
  const at = place();
  filter();
  const scene = byName.get(at.get('scene'));
  if (!scene) return showOverview(at.get('scene'));
  if (opening === scene.key) return placeViewer(at);
  leave();
  opening = scene.key;
  by('overview').hidden = true;
  by('scene').hidden = false;
  by('name').textContent = scene.name;
  by('outcome').textContent = outcomeText(scene.outcome);
  by('outcome').className = outcomeClass(scene.outcome);
  by('view').replaceChildren('reading ...');
  try {
    const read = await load(scene.file);
    read.view = await unpackedView(read.view);
    if (opening !== scene.key) return;
    const made = new SceneView(read, report.stages, keepViewer);
    by('view').replaceChildren(made.host);
    placeViewer(at, made);
    open = made;
    keepViewer(made.viewer);
    by('name').focus({preventScroll: true});
    scrollTo(0, 0);
  } catch (error) {
    by('view').replaceChildren(element('p', {className: 'bad'}, String(error)));
  }
}

function placeViewer(at, view = open) {
  const pixel = at.get('pixel')?.split(',').map(Number);
  view?.viewer.set({layer: at.get('picture') ?? undefined, against: at.get('against') ?? undefined,
                    mode: at.get('as') ?? undefined, scale: at.get('zoom') ?? undefined,
                    ...(pixel?.length === 2 && pixel.every(Number.isInteger) ? {pixel, centred: true} : {})});
}

function leave() {
  open?.close();
  open = null;
  by('view').replaceChildren();
}

function showOverview(unknown) {
  const was = byName.get(opening);
  leave();
  opening = null;
  by('overview').hidden = false;
  by('scene').hidden = true;
  by('unknown').textContent = unknown ? `no scene here is named ${unknown}` : '';
  was?.card.querySelector('a').focus();
}

function step(by_) {
  const scenes = shownScenes();
  const current = opening ?? scenes.find((s) => s.card.contains(document.activeElement))?.key;
  const from = scenes.findIndex((s) => s.key === current);
  const to = scenes[from < 0 ? 0 : Math.min(Math.max(from + by_, 0), scenes.length - 1)];
  if (!to) return;
  if (opening) go({...VIEWER_PARTS, scene: to.key}, {anew: true});
  else to.card.querySelector('a').focus();
}

/** How many cards stand in a row. */
function columns() {
  const cards = shownScenes().map((s) => s.card.offsetTop);
  return Math.max(1, cards.filter((top) => top === cards[0]).length);
}

function key(event) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || by('help').open) return;
  const typing = ['INPUT', 'SELECT'].includes(event.target.tagName);
  if (event.key === 'Escape') {
    if (opening) go({...VIEWER_PARTS, scene: null}, {anew: true});
    else if (typing) event.target.blur();
    return;
  }
  if (typing) return;
  const arrows = opening ? {} : {ArrowRight: 1, ArrowLeft: -1, ArrowDown: columns(), ArrowUp: -columns()};
  const move = {j: 1, k: -1, ...arrows}[event.key];
  if (move) step(move);
  else if (event.key === '/' && !opening) by('filter').focus();
  else if (event.key === '?') by('help').showModal();
  else return;
  event.preventDefault();
}

build();
by('back').onclick = () => go({...VIEWER_PARTS, scene: null}, {anew: true});
by('next').onclick = () => step(1);
by('previous').onclick = () => step(-1);
addEventListener('hashchange', show);
addEventListener('keydown', key);
show();
