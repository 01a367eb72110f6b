// SPDX-License-Identifier: Apache-2.0
// The page: outcome, plots, gallery. All texts go in as text, never as markup.
'use strict';

(() => {
  const {make, read, table} = Detail;
  const $ = (id) => document.getElementById(id);
  const summary = read('summary');
  const marks = {right: '✓', wrong: '✗', abstained: '–', unknown: '?'};
  // A comparison of two systems says on which photos they disagree.
  const words = summary.pair ? {right: `only ${summary.pair[1]} is right`,
    wrong: `only ${summary.pair[0]} is right`, abstained: 'only one has a pose', unknown: 'poses apart'} :
    {right: 'right', wrong: 'wrong', abstained: 'abstained', unknown: 'without truth'};
  const outcomes = Object.keys(words);
  const PAGE = 60;

  summary.runs.forEach((run, index) => {
    run.index = index;
    const seeds = summary.runs.some((r) => r.id === run.id && r.seed !== run.seed) && run.seed > 0;
    run.label = seeds ? `${run.id}, seed ${run.seed}` : run.id;
  });

  const sentenceOf = (run) => {
    let text = `${marks[run.outcome]} ${words[run.outcome]}`;
    if (run.outcome === 'unknown') text = run.status;
    if (summary.pair) return text;
    if (run.translation !== null && run.rotation !== null && run.outcome !== 'abstained') {
      text += `: ${run.translation.toFixed(2)} m, ${run.rotation.toFixed(2)}°`;
    }
    return text;
  };

  // --- theme ---
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const setTheme = (theme) => {
    document.documentElement.dataset.theme = theme;
    if (typeof Plotly !== 'undefined') Plots.redraw();
  };
  setTheme(dark.matches ? 'dark' : 'light');
  dark.addEventListener('change', () => setTheme(dark.matches ? 'dark' : 'light'));
  $('theme').addEventListener('click', () =>
    setTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'));

  // --- head ---
  $('title').textContent = summary.title;
  $('subtitle').textContent = [summary.version, summary.crs].filter(Boolean).join(' · ');
  const count = (outcome) => summary.runs.filter((r) => r.outcome === outcome).length;
  const withTruth = summary.runs.length - count('unknown');
  // Score studies and skylines have no confidence: their figures and plots are their own.
  const isStudy = summary.isStudy || summary.pair !== null;
  const parts = [];
  if (summary.pair) {
    for (const outcome of outcomes) {
      if (count(outcome)) parts.push(`${words[outcome]} on ${count(outcome)}`);
    }
    if (parts.length === 0) parts.push('no disagreement to show');
  } else if (withTruth > 0) {
    parts.push(`${count('right')} of ${withTruth} ${summary.rightText}`);
    if (count('wrong')) parts.push(`${count('wrong')} wrong`);
  }
  if (!summary.pair && count('abstained')) parts.push(`${count('abstained')} abstained`);
  if (!summary.pair && count('unknown')) parts.push(`${count('unknown')} without truth`);
  if (summary.runs.length === 1 && !summary.pair) parts.length = 0;  // the run says it itself
  $('sentence').textContent = parts.join(', ');
  $('sentence').hidden = parts.length === 0;
  $('bar').setAttribute('aria-label', parts.join(', '));
  $('bar').hidden = summary.runs.length < 2;
  for (const outcome of outcomes) {
    if (count(outcome) === 0) continue;
    const piece = make('span', outcome);
    piece.style.flex = count(outcome);
    piece.title = `${count(outcome)} ${words[outcome]}`;
    $('bar').append(piece);
  }
  for (const [name, value] of summary.facts) {
    const box = make('div');
    box.append(make('dt', '', name), make('dd', '', value));
    $('facts').append(box);
  }

  // --- what stands before all else, e.g. the map of a track ---
  if (summary.lead >= 0) {
    const photo = read('photo-' + summary.lead);
    const figure = make('figure', 'lead');
    figure.append(Detail.image(photo, photo.name), make('figcaption', 'dim', photo.name));
    $('verdict').append(figure);
  }

  // --- plots ---
  if (typeof Plotly === 'undefined') {
    $('noplots').hidden = false;
  } else {
    if (withTruth > 1 && !isStudy && summary.recall.length > 0) {
      Plots.figure($('plots'), 'Recall',
        'Share of all runs within x metres and x degrees; abstained runs count as misses. ' +
        'Band: 95 % interval (Wilson, by the number of photos).', Plots.recall(summary.recall));
    }
    const judged = summary.runs.filter((r) => r.translation !== null && r.energy !== null);
    if (judged.length > 1 && !isStudy) {
      Plots.figure($('plots'), 'Score against error',
        'A score that can be trusted keeps the right poses low. Click a point to see its photo.',
        Plots.scatter(judged, (index) => open(summary.runs[index])));
    }
    if (withTruth > 1 && summary.reliability.length > 0) {
      Plots.figure($('plots'), 'Reliability',
        'On the dotted line, a confidence of 0.9 means right nine times in ten. ' +
        'Bars: 95 % Wilson intervals.', Plots.reliability(summary.reliability));
    }
    for (const plot of summary.plots) {
      Plots.figure($('plots'), plot.title, plot.note, Plots.generic(plot));
    }
  }

  // --- tables ---
  summary.tables.forEach((t, i) => {
    // Without plots of the localization the first table is what there is to see.
    const place = isStudy && i === 0 ? $('verdict') : $('tables');
    place.append(make('h2', '', t.title), table(t.rows, t.header));
  });

  // --- gallery ---
  let filter = 'all';
  let shown = [];
  let limit = PAGE;
  const rank = {wrong: 0, abstained: 1, unknown: 2, right: 3};
  const orders = {
    worst: (a, b) => rank[a.outcome] - rank[b.outcome] ||
      (b.translation ?? 0) - (a.translation ?? 0) || a.confidence - b.confidence,
    confidence: (a, b) => a.confidence - b.confidence,
    id: (a, b) => a.id.localeCompare(b.id) || a.seed - b.seed,
    slow: (a, b) => b.seconds - a.seconds,
  };

  // Photos are decoded when their card comes near the view.
  const fill = (card, run) => {
    const photo = run.photo >= 0 ? read('photo-' + run.photo) : null;
    const frame = card.querySelector('.frame');
    if (!photo) return;
    frame.append(Detail.image(photo, `Photo ${run.label} with the model's edges at the result`));
    if ($('edges').checked) {
      const detail = read('run-' + run.index);
      const layers = summary.pair ? detail.priorLayers.concat(detail.resultLayers) :
        detail.resultLayers.length > 0 ? detail.resultLayers : detail.priorLayers;
      frame.append(Detail.edges(layers, photo, 0.9));
    }
  };
  const runOfCard = new WeakMap();
  const near = typeof IntersectionObserver === 'function' ?
    new IntersectionObserver((entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting) continue;
        near.unobserve(entry.target);
        fill(entry.target, runOfCard.get(entry.target));
      }
    }, {rootMargin: '400px'}) : null;

  const cardOf = (run) => {
    const card = make('button', 'card ' + run.outcome);
    card.type = 'button';
    const text = make('span', 'text');
    text.append(make('span', 'name', run.label), make('span', 'badge', sentenceOf(run)));
    const more = run.confidence === null ? [] : [`confidence ${run.confidence.toFixed(2)}`];
    if (run.set) more.unshift(run.set);
    if ((run.outcome === 'abstained' || summary.pair) && run.reason) more.unshift(run.reason);
    const line = make('span', 'dim', more.join(' · '));
    line.style.display = 'block';
    text.append(line);
    card.append(make('span', 'frame'), text);
    card.addEventListener('click', () => open(run));
    runOfCard.set(card, run);
    return card;
  };

  const update = () => {
    const wanted = $('find').value.trim().toLowerCase();
    shown = summary.runs.filter((run) => (filter === 'all' || run.outcome === filter) &&
      (!wanted || run.label.toLowerCase().includes(wanted) || run.set.toLowerCase().includes(wanted)));
    shown.sort(orders[$('sort').value]);
    const page = shown.slice(0, limit);
    $('count').textContent = `${page.length} of ${shown.length} shown`;
    $('gallery').replaceChildren(...page.map(cardOf));
    for (const card of $('gallery').children) {
      if (near) near.observe(card); else fill(card, runOfCard.get(card));
    }
    $('more').hidden = shown.length <= limit;
  };

  for (const outcome of ['all', ...outcomes]) {
    const number = outcome === 'all' ? summary.runs.length : count(outcome);
    if (number === 0) continue;
    const button = make('button', '', `${outcome === 'all' ? 'all' : words[outcome]} ${number}`);
    button.type = 'button';
    button.setAttribute('aria-pressed', String(outcome === filter));
    button.addEventListener('click', () => {
      filter = outcome;
      limit = PAGE;
      for (const other of $('filters').children) other.setAttribute('aria-pressed', 'false');
      button.setAttribute('aria-pressed', 'true');
      update();
    });
    $('filters').append(button);
  }
  $('sort').addEventListener('change', update);
  $('find').addEventListener('input', () => { limit = PAGE; update(); });
  $('edges').addEventListener('change', update);
  if (isStudy) $('sort').querySelector('[value="confidence"]').remove();
  $('more').addEventListener('click', () => { limit += PAGE; update(); });
  $('photos').hidden = summary.runs.length < 2;
  if (summary.runs.length > 1) update();

  // --- one run ---
  let current = null;
  const fillDetail = (run) => {
    current = run;
    $('detail-title').textContent = run.label;
    Detail.show(run, $('detail-body'), sentenceOf(run), summary.pair);
    $('detail').scrollTop = 0;
  };
  const open = (run) => {
    if (!$('detail').open) $('detail').showModal();
    fillDetail(run);
  };
  const step = (by) => {
    const at = shown.indexOf(current);
    if (shown.length > 0) fillDetail(shown[(at + by + shown.length) % shown.length]);
  };
  $('previous').addEventListener('click', () => step(-1));
  $('next').addEventListener('click', () => step(1));
  $('close').addEventListener('click', () => $('detail').close());
  $('detail').addEventListener('keydown', (event) => {
    if (event.target.tagName === 'INPUT') return;
    if (event.key === 'ArrowLeft') step(-1);
    if (event.key === 'ArrowRight') step(1);
  });
  $('detail').addEventListener('click', (event) => {
    if (event.target === $('detail')) $('detail').close();
  });

  // --- about ---
  const fold = (title, content) => {
    const details = make('details');
    details.append(make('summary', '', title), content);
    $('about').append(details);
  };
  if (summary.warnings.length > 0) {
    fold(summary.warnings.length === 1 ? '1 warning' : `${summary.warnings.length} warnings`,
       table(summary.warnings.map((w) => [w]), ['']));
  }
  if (summary.command) fold('How to make this report again', make('pre', '', summary.command));
  if (summary.options) fold('Options', make('pre', '', summary.options));

  // A report of one run shows it at once.
  if (summary.runs.length === 1) {
    Detail.show(summary.runs[0], $('single'), sentenceOf(summary.runs[0]), summary.pair);
  }
})();
