// SPDX-License-Identifier: Apache-2.0
// Opens the example reports in headless Chromium as a reader would:
//   node browser_test.mjs FOLDER CHROMIUM [SCREENSHOTS]
// FOLDER holds what write_example_reports wrote. Fails on console messages, on plots that are not
// drawn, on controls that do nothing, on pages wider than the window.
import {createRequire} from 'node:module';
import path from 'node:path';
import assert from 'node:assert/strict';

const require = createRequire(path.join(process.cwd(), 'package.json'));
const {chromium} = require('playwright-core');
const [folder, executablePath, screenshots] = process.argv.slice(2);
const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});

const open = async (file, width, colorScheme) => {
  const context = await browser.newContext({viewport: {width, height: 900}, colorScheme});
  const page = await context.newPage();
  const messages = [];
  page.on('console', (m) => messages.push(m.text()));
  page.on('pageerror', (e) => messages.push(String(e)));
  page.on('dialog', (d) => { messages.push('dialog: ' + d.message()); d.dismiss(); });
  page.on('request', (r) => { if (/^https?:/.test(r.url())) messages.push('loads ' + r.url()); });
  await page.goto('file://' + path.resolve(folder, file));
  return {page, done: async () => {
    if (screenshots) {
      await page.screenshot({path: path.join(screenshots, `${file}-${width}-${colorScheme}.png`)});
    }
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= width, `${file} at ${width} px is ${wide} px wide`);
    assert.deepEqual(messages, [], file);
    await context.close();
  }};
};

for (const width of [1280, 400]) {
  for (const scheme of ['light', 'dark']) {
    const {page, done} = await open('bench.html', width, scheme);
    assert.match(await page.textContent('#sentence'), /17 of 24 within 2 m and 2°/);
    await page.locator('#plots .js-plotly-plot').first().waitFor();

    const names = () => page.locator('.card .badge').allTextContents();
    assert.match((await names())[0], /wrong/, 'failures come first');
    await page.getByRole('button', {name: /^abstained/}).click();
    assert.equal((await names()).length, 2);
    await page.getByRole('button', {name: /^all/}).click();
    await page.fill('#find', 'Straße');
    assert.equal((await names()).length, 1);
    assert.match(await page.textContent('.card .name'), /<script>alert\(1\)<\/script>/);
    await page.fill('#find', '');
    await page.selectOption('#sort', 'confidence');

    await page.locator('.card').first().focus();
    await page.keyboard.press('Enter');
    const dialog = page.locator('#detail');
    await dialog.locator('.js-plotly-plot').first().waitFor();
    const slider = dialog.locator('.slider input');
    await slider.fill('30');
    assert.equal(await dialog.locator('.divider').evaluate((e) => e.style.left), '30%');
    const title = await page.textContent('#detail-title');
    await page.locator('#next').focus();
    await page.keyboard.press('ArrowRight');
    assert.notEqual(await page.textContent('#detail-title'), title);
    for (const image of await page.locator('img').all()) {
      assert.ok((await image.getAttribute('alt')).length > 5);
    }
    await page.keyboard.press('Escape');
    assert.equal(await dialog.evaluate((e) => e.open), false);
    const before = await page.evaluate(() => document.documentElement.dataset.theme);
    await page.click('#theme');
    assert.notEqual(await page.evaluate(() => document.documentElement.dataset.theme), before);
    await done();
  }
}

for (const file of ['one.html', 'none.html', 'bare.html', 'abstained.html']) {
  const {page, done} = await open(file, 400, 'light');
  await page.locator('h1').waitFor();
  await done();
}

for (const width of [1280, 400]) {
  const {page, done} = await open('study.html', width, 'dark');
  assert.match(await page.textContent('#sentence'), /maps have their minimum within 2 m and 2°/);
  assert.equal(await page.locator('#verdict table').count(), 1, 'figures come first');
  assert.doesNotMatch(await page.textContent('#plots'), /Reliability/);
  await page.locator('#plots .js-plotly-plot').first().waitFor();
  await page.locator('#plots figure').last().scrollIntoViewIfNeeded();
  await page.getByText('fld').first().waitFor();
  await page.locator('.card').first().click();
  await page.locator('#detail .js-plotly-plot').nth(1).waitFor();
  await done();
}

const {page, done} = await open('thousand.html', 1280, 'light');
assert.equal(await page.locator('.card').count(), 60);
await page.click('#more');
assert.equal(await page.locator('.card').count(), 120);
await done();
await browser.close();
console.log('reports look as they should');
