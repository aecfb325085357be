// Clicks through the pages of plumb check and plumb diagnose in headless Chromium, by file://, without a network.
// node report_test.mjs PLUMB SCENES MODULES FOLDER: the program, the suite's scenes, the folder that holds
// node_modules, and one to write into.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import test from 'node:test';
import {pathToFileURL} from 'node:url';

const [plumb, scenes, modules, folder] = process.argv.slice(2).map((p) => path.resolve(p));
const {chromium} = createRequire(path.join(modules, 'package.json'))('playwright-core');

const FAULT = 'coverage.inclusive_edges';
const SCENES = ['coverage/fan', 'coverage/six_orders', 'coverage/snap_ties', 'texture/floor_in_fog',
                'antialias/supersample_3', 'notes/gzrender_meeting', 'frame/rgba12'];
const file = (scene) => path.join(scenes, `${scene}.json`);

// 0: all hold, 1: something differs; anything else is an error.
function run(...args) {
  try {
    execFileSync(plumb, args, {stdio: ['ignore', 'ignore', 'inherit']});
  } catch (error) {
    if (error.status !== 1) throw error;
  }
}

/** The codes of a binary PPM: [x, y from the top] gives red, green, blue. */
function readPpm(name) {
  const bytes = fs.readFileSync(name);
  const head = /^P6\s+(\d+)\s+(\d+)\s+255\s/.exec(bytes.toString('latin1', 0, 64));
  const [width, height] = [Number(head[1]), Number(head[2])];
  const at = (x, y) => [...bytes.subarray(head[0].length + 3 * (y * width + x)).subarray(0, 3)];
  return {width, height, at};
}

fs.rmSync(folder, {recursive: true, force: true});
fs.mkdirSync(folder, {recursive: true});
const at = (name) => path.join(folder, name);
run('check', ...SCENES.map(file), '--fault', FAULT, '--report', at('check'));
run('diagnose', file('coverage/snap_ties'), '--fault', FAULT, '--report', at('diagnose'));
run('render', file('coverage/snap_ties'), '--fault', FAULT, '-o', at('ours.ppm'));
run('render', file('coverage/snap_ties'), '--with', 'osmesa', '-o', at('osmesa.ppm'));
run('render', file('coverage/snap_ties'), '--with', 'exact', '-o', at('exact.ppm'));
const url = pathToFileURL(at('check/index.html')).href;

const root = process.getuid?.() === 0;
const browser = await chromium.launch({executablePath: '/usr/bin/chromium', args: root ? ['--no-sandbox'] : []});
test.after(() => browser.close());

/** A page whose every complaint, and every request that is not for a file, ends the test. */
async function open(address, {width = 1280, colorScheme = 'light'} = {}) {
  const page = await browser.newPage({viewport: {width, height: 900}, colorScheme});
  page.complaints = [];
  page.on('console', (message) => {
    const isOurs = message.text().includes('willReadFrequently');  // of this test's own reading of pictures
    if (message.type() !== 'log' && !isOurs) page.complaints.push(message.text());
  });
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('requestfailed', (request) => page.complaints.push(`failed: ${request.url()}`));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.complaints.push(`network: ${request.url()}`);
  });
  await page.goto(address);
  return page;
}
async function done(page) {
  assert.deepEqual(page.complaints, []);
  await page.close();
}
const scenePage = (scene, more = '', options = {}) =>
  open(`${url}#${new URLSearchParams({scene})}${more}`, options).then(async (page) => {
    await page.waitForSelector('.viewer canvas');
    return page;
  });
const shown = (page) => page.locator('#cards li:visible').allInnerTexts();
const hash = (page) => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));
const focused = (page) => page.evaluate(() => document.activeElement.innerText ?? '');

/** A canvas' colour at a place of it, in its own screen pixels from the upper left. */
const colorAt = (page, canvas, x, y) => page.locator('canvas').nth(canvas).evaluate((c, [u, v]) => {
  const k = window.devicePixelRatio;
  return [...c.getContext('2d').getImageData(Math.round(u * k), Math.round(v * k), 1, 1).data].slice(0, 3);
}, [x, y]);
/** The table under the pictures: {layer: [ours, osmesa, ...]}, and what stands in its corner. */
async function numbers(page) {
  const cells = await page.locator('.numbers tr').evaluateAll((rows) => rows.map((r) => [...r.cells].map((c) => c.innerText)));
  return {corner: cells[0][0], sides: cells[0].slice(1), of: Object.fromEntries(cells.slice(1).map(([n, ...v]) => [n, v]))};
}

test('the overview shows every scene, the failing first, with a picture', async () => {
  const page = await open(url);
  assert.equal(await page.locator('#cards li').count(), SCENES.length);
  const texts = await shown(page);
  assert.match(texts[0], /different: coverage/);
  assert.ok(texts.some((t) => t.includes('dispute')));
  const first = texts.findIndex((t) => !t.includes('different'));
  assert.ok(texts.slice(first).every((t) => !t.includes('different')), 'failures stand together');
  await page.waitForFunction(() => [...document.querySelectorAll('#cards img')].every((i) => i.complete && i.naturalWidth > 0));
  await done(page);
});

test('the filter finds by words, outcome, stage and group, and the address keeps it', async () => {
  const page = await open(url);
  await page.keyboard.press('/');
  await page.keyboard.type('fan');
  assert.deepEqual((await shown(page)).length, 1);
  assert.equal(await page.locator('#count').innerText(), `1 of ${SCENES.length} scenes`);
  await page.reload();
  assert.match((await shown(page))[0], /coverage\/fan/);
  assert.equal(await page.locator('#filter').inputValue(), 'fan');
  await page.locator('#filter').fill('no such <b>scene');
  assert.equal((await shown(page)).length, 0);
  await page.locator('#filter').fill('');
  await page.selectOption('#by-outcome', 'dispute');
  assert.ok((await shown(page)).every((t) => t.includes('dispute')));
  await page.selectOption('#by-outcome', '');
  await page.selectOption('#by-stage', 'coverage');
  assert.ok((await shown(page)).every((t) => t.includes('different: coverage')));
  await page.selectOption('#by-stage', '');
  await page.selectOption('#by-group', 'texture');
  assert.ok((await shown(page)).every((t) => t.startsWith('texture/')));
  await page.selectOption('#by-group', '');
  assert.equal((await shown(page)).length, SCENES.length);
  assert.deepEqual(await hash(page), {});
  await done(page);
});

test('keys lead everywhere', async () => {
  const page = await open(url);
  const names = (await shown(page)).map((t) => t.split('\n')[0]);
  await page.keyboard.press('j');
  assert.ok((await focused(page)).startsWith(names[0]));
  await page.keyboard.press('j');
  assert.ok((await focused(page)).startsWith(names[1]));
  await page.keyboard.press('k');
  await page.keyboard.press('ArrowRight');
  assert.ok((await focused(page)).startsWith(names[1]));
  await page.keyboard.press('Enter');
  await page.waitForSelector('.viewer canvas');
  assert.equal(await page.locator('#name').innerText(), names[1]);
  await page.keyboard.press('j');
  await page.waitForFunction((name) => document.getElementById('name').innerText === name, names[2]);
  await page.keyboard.press('k');
  await page.waitForFunction((name) => document.getElementById('name').innerText === name, names[1]);
  await page.waitForSelector('.viewer canvas');
  await page.keyboard.press('Escape');
  await page.waitForSelector('#overview:visible');
  assert.ok((await focused(page)).startsWith(names[1]), 'back where it was');
  await page.keyboard.press('?');
  assert.ok(await page.locator('#help').isVisible());
  await page.keyboard.press('Escape');
  assert.ok(!(await page.locator('#help').isVisible()));
  await page.goBack();  // to the scene
  await page.waitForSelector('.viewer canvas');
  await done(page);
});

test('a scene shows its failure, its command, and every stage', async () => {
  const page = await scenePage('coverage/snap_ties');
  const command = await page.locator('.command code').innerText();
  assert.ok(command.includes('snap_ties.json') && command.includes(`--fault ${FAULT}`), command);
  await page.locator('.command button').click();
  await page.locator('.command button', {hasText: /copied|selected/}).waitFor();
  assert.equal(await page.locator('.stages tr.first th').innerText(), 'coverage\nfirst wrong');
  assert.match(await page.locator('.stages button[aria-pressed=true]').innerText(), /^different/);
  assert.match(await page.locator('.row h3').innerText(), /^coverage, by osmesa$/);
  assert.match(await page.locator('.histogram').getAttribute('aria-label'), /equal: \d+.*2\^0: \d+/);
  const merge = page.locator('.stages tr', {hasText: /^merge/}).locator('button').first();
  await merge.click();
  assert.equal(await merge.getAttribute('aria-pressed'), 'true');
  assert.match(await page.locator('.row h3').innerText(), /^merge, by osmesa$/);
  assert.equal(await page.locator('.viewer button[aria-pressed=true]', {hasText: 'colour'}).count(), 1, 'what the row is about');
  await page.getByRole('button', {name: 'exact', exact: true}).click();
  assert.match(await page.locator('.row h3').innerText(), /^merge, by exact/, 'the row follows what is looked at');
  await done(page);
});

test('the numbers under the cursor are those of the pictures', async () => {
  const [ours, osmesa, exact] = ['ours', 'osmesa', 'exact'].map((name) => readPpm(at(`${name}.ppm`)));
  const page = await scenePage('coverage/snap_ties', '&picture=colour');
  const canvas = page.locator('canvas').first();
  const box = await canvas.boundingBox();
  const scale = parseFloat(await page.locator('.viewer .bar').getByText(/^[\d.]+ x$/).innerText());
  const left = (box.width - 2 - ours.width * scale) / 2, top = (box.height - 2 - ours.height * scale) / 2;
  const differing = [];
  for (let y = 0; y < ours.height; ++y) {
    for (let x = 0; x < ours.width; ++x) if (String(ours.at(x, y)) !== String(osmesa.at(x, y))) differing.push([x, y]);
  }
  assert.ok(differing.length > 3, 'the fault is seen');
  const places = [[0, 0], [ours.width - 1, ours.height - 1], [5, 40], ...differing.slice(0, 5)];
  for (const [x, y] of places) {
    await page.mouse.move(box.x + 1 + left + (x + 0.5) * scale, box.y + 1 + top + (y + 0.5) * scale);
    const {corner, sides, of} = await numbers(page);
    assert.equal(corner, `pixel ${x},${ours.height - 1 - y}`, 'rows are counted from the bottom');
    assert.deepEqual(sides, ['ours', 'osmesa', 'embree', 'exact']);
    const rgb = (i) => of.colour[i].replace('≠ ', '').split(' ').slice(0, 3).map(Number);
    assert.deepEqual(rgb(0), ours.at(x, y));
    assert.deepEqual(rgb(1), osmesa.at(x, y));
    assert.deepEqual(rgb(3), exact.at(x, y));
    assert.equal(of.colour[1].startsWith('≠'), String(ours.at(x, y)) !== String(osmesa.at(x, y)));
    for (const layer of ['depth', 'primitives', 'fragments']) assert.match(of[layer][0], /^-?\d+/);
    assert.deepEqual(await colorAt(page, 1, left + (x + 0.25) * scale, top + (y + 0.25) * scale), osmesa.at(x, y),
                     'and the picture has them');
  }
  await page.waitForFunction((pixel) => new URLSearchParams(location.hash.slice(1)).get('pixel') === pixel,
                             (await numbers(page)).corner.slice('pixel '.length));  // the address keeps it
  await done(page);
});

test('the difference is red where the row says so', async () => {
  const page = await scenePage('coverage/snap_ties');
  const legend = await page.locator('.legend').innerText();
  const beyond = Number(/beyond the tolerance: (\d+)/.exec(legend)[1]);
  const said = Number(/(\d+) of/.exec(await page.locator('.stages button[aria-pressed=true] small').first().innerText())[1]);
  assert.equal(beyond, said);
  const box = await page.locator('canvas').nth(2).boundingBox();
  let red = 0;
  const pixels = await page.locator('canvas').nth(2).evaluate((c) =>
    [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data]);
  for (let i = 0; i < pixels.length; i += 4) red += pixels[i] > 100 && pixels[i + 1] < 60 ? 1 : 0;
  const scale = parseFloat(await page.locator('.viewer .bar').getByText(/^[\d.]+ x$/).innerText());
  assert.ok(Math.abs(red / (scale * scale) - beyond) <= 0.2 * beyond, `${red} red, ${beyond} pixels, ${box.width}`);
  await done(page);
});

test('zoom goes to the pixel, with a grid, and back', async () => {
  const page = await scenePage('coverage/snap_ties', '&picture=colour&pixel=10,20');
  const scaleText = page.locator('.viewer .bar').getByText(/^[\d.]+ x$/);
  const fit = await scaleText.innerText();
  await page.getByRole('button', {name: 'zoom in'}).click();
  await page.getByRole('button', {name: 'zoom in'}).click();
  assert.ok(parseFloat(await scaleText.innerText()) > parseFloat(fit));
  await page.waitForFunction(() => Number(new URLSearchParams(location.hash.slice(1)).get('zoom')) > 1);
  const canvas = page.locator('canvas').first();
  await canvas.focus();
  await page.keyboard.press('ArrowRight');
  assert.equal((await numbers(page)).corner, 'pixel 11,20');
  await page.keyboard.press('ArrowUp');
  assert.equal((await numbers(page)).corner, 'pixel 11,21');
  assert.equal(await page.evaluate(() => document.activeElement.tagName), 'CANVAS', 'the focus stays');
  const before = await scaleText.innerText();
  await page.keyboard.press('+');
  assert.equal(parseFloat(await scaleText.innerText()), Math.min(64, 2 * parseFloat(before)));
  await page.keyboard.press('0');
  assert.equal(await scaleText.innerText(), fit);
  const box = await canvas.boundingBox();
  await page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2);
  assert.equal(await scaleText.innerText(), '16 x');
  const from = (await numbers(page)).corner;
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 - 48, box.y + box.height / 2, {steps: 4});
  await page.mouse.up();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  assert.notEqual((await numbers(page)).corner, from, 'it was dragged');
  await done(page);
});

test('the slider lays one picture over the other', async () => {
  const page = await scenePage('coverage/snap_ties', '&picture=fragments');
  await page.getByRole('button', {name: 'slider'}).click();
  assert.equal(await page.locator('canvas').count(), 2, 'both in one, and the difference');
  const slider = page.getByRole('slider');
  const pictureAt = async (value) => {
    await slider.fill(String(value));
    return page.locator('canvas').first().evaluate((c) => c.toDataURL());
  };
  const [theirs, half, ours] = [await pictureAt(0), await pictureAt(50), await pictureAt(100)];
  assert.ok(theirs !== ours && half !== ours && half !== theirs);
  await page.waitForFunction(() => new URLSearchParams(location.hash.slice(1)).get('as') === 'slider');
  await page.reload();
  await page.waitForSelector('input[type=range]');
  await done(page);
});

test('flicker shows one after the other, by itself and by hand', async () => {
  const page = await scenePage('coverage/snap_ties', '&picture=fragments&as=flicker');
  const caption = page.locator('figcaption').first();
  const picture = () => page.locator('canvas').first().evaluate((c) => c.toDataURL());
  const first = await caption.innerText(), before = await picture();
  await page.waitForFunction((was) => document.querySelector('figcaption').innerText !== was, first);
  assert.notEqual(await picture(), before);
  await page.locator('canvas').first().focus();
  await page.keyboard.press('f');
  const paused = await caption.innerText();
  await page.waitForTimeout(1500);
  assert.equal(await caption.innerText(), paused, 'by hand it stays');
  await page.getByRole('button', {name: 'show the other'}).click();
  assert.notEqual(await caption.innerText(), paused);
  await done(page);
});

test('what is disputed, antialiased, of 12 bits or counted from the top is shown too', async () => {
  for (const scene of SCENES) {
    const page = await scenePage(scene);
    assert.ok(await page.locator('canvas').count() >= 2, scene);
    if (scene === 'texture/floor_in_fog') assert.match(await page.locator('.legend').innerText(), /disputed: \d+/);
    await done(page);
  }
});

test('an address of no scene says so', async () => {
  const page = await open(`${url}#scene=no%3Cb%3Ething`);
  assert.match(await page.locator('#unknown').innerText(), /no scene here is named no<b>thing/);
  await done(page);
});

// Every text against what is behind it (WCAG 2.1, 1.4.3): 4.5 to 1, the AA level of text of this size.
const faintTexts = (page) => page.evaluate(() => {
  const parse = (color) => (color.match(/[\d.]+/g) ?? []).map(Number);
  const light = ([r, g, b]) => [r, g, b].map((v) => v / 255).map((v) => (v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = (e) => {
    for (let at = e; at; at = at.parentElement) {
      const color = parse(getComputedStyle(at).backgroundColor);
      if (color.length === 3 || color[3] > 0) return color;
    }
    return parse(getComputedStyle(document.documentElement).backgroundColor);
  };
  const out = [];
  for (const e of document.querySelectorAll('body *')) {
    const own = [...e.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent.trim());
    if (!own || !e.checkVisibility() || ['SCRIPT', 'OPTION'].includes(e.tagName)) continue;
    const [a, b] = [light(parse(e.closest('svg') ? getComputedStyle(e).fill : getComputedStyle(e).color)), light(behind(e))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) out.push(`${e.tagName}.${e.className} "${e.textContent.slice(0, 20)}" ${ratio.toFixed(2)}`);
  }
  return out;
});
const nameless = (page) => page.evaluate(() => [...document.querySelectorAll('button, input, select, canvas, svg.histogram')]
  .filter((e) => e.checkVisibility())
  .filter((e) => !(e.ariaLabel || e.getAttribute('aria-label') || e.innerText?.trim() || e.labels?.length)).map((e) => e.outerHTML));

for (const colorScheme of ['light', 'dark']) {
  for (const width of [1280, 600]) {
    test(`${colorScheme}, ${width} wide: nothing is faint, nameless, or beyond the side`, async () => {
      const diagnose = pathToFileURL(at('diagnose/index.html')).href;
      for (const address of [url, `${url}#scene=coverage%2Fsnap_ties`, `${url}#scene=texture%2Ffloor_in_fog&as=slider`, diagnose]) {
        const page = await open(address, {width, colorScheme});
        if (address !== url) await page.waitForSelector('.viewer canvas');
        assert.deepEqual(await faintTexts(page), [], address);
        assert.deepEqual(await nameless(page), [], address);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${address} scrolls sideways`);
        await done(page);
      }
    });
  }
}

test('the theme is the system\'s, or chosen, and kept', async () => {
  const back = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await open(url), dark = await open(url, {colorScheme: 'dark'});
  const [white, black] = [await back(light), await back(dark)];
  assert.notEqual(white, black);
  await done(dark);
  await light.click('#theme');
  await light.click('#theme');
  assert.equal(await light.locator('#theme').innerText(), 'theme: dark');
  assert.equal(await back(light), black);
  await light.reload();
  assert.equal(await back(light), black);
  await done(light);
});

test('the diagnosis shows every stage to the pixel, from one file', async () => {
  const page = await open(pathToFileURL(at('diagnose/index.html')).href);
  await page.waitForSelector('.viewer canvas');
  assert.match(await page.locator('pre').first().innerText(), /wrong by itself: coverage/);
  assert.equal(await page.locator('.viewer button[aria-pressed=true]', {hasText: 'fragments'}).count(), 1, 'it begins there');
  assert.match(await page.locator('.legend').innerText(), /beyond the tolerance: \d+/);
  for (const name of ['depth', 'shaded', 'primitives', 'colour']) {
    await page.getByRole('button', {name, exact: true}).click();
    const texts = await page.locator('figcaption').allInnerTexts();
    assert.equal(texts.slice(0, 3).length, 3);
    assert.ok(texts.every((t) => !t.includes('inf')), texts.join());
  }
  await page.locator('canvas').first().hover();
  assert.match((await numbers(page)).corner, /^pixel \d+,\d+$/);
  await done(page);
});
