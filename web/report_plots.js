// SPDX-License-Identifier: Apache-2.0
// The plots. Each is drawn when it comes into view, and again when the theme changes.
'use strict';

const Plots = (() => {
  const drawn = new Map();  // element -> function that makes {data, layout}

  const color = (name) =>
    getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

  const axis = (title, extra) => Object.assign({
    title: {text: title, font: {size: 13}, standoff: 10}, gridcolor: color('line'), linecolor: color('line'),
    zerolinecolor: color('line'), automargin: true,
  }, extra);

  const layout = (x, y, extra) => Object.assign({
    xaxis: x, yaxis: y, margin: {l: 50, r: 12, t: 8, b: 44}, hovermode: 'closest',
    paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)',
    font: {color: color('ink'), size: 12, family: 'system-ui, sans-serif'},
    legend: {orientation: 'h', y: -0.22, x: 0},
  }, extra);

  const config = {responsive: true, displayModeBar: false};

  const render = (element) => {
    const {data, layout: look, open} = drawn.get(element)();
    const first = !element.classList.contains('js-plotly-plot');
    Plotly.react(element, data, look, config);
    if (first && open) element.on('plotly_click', (event) => open(event.points[0].customdata));
  };

  const observer = typeof IntersectionObserver === 'function' ?
    new IntersectionObserver((entries) => {
      for (const entry of entries) {
        if (!entry.isIntersecting) continue;
        observer.unobserve(entry.target);
        render(entry.target);
      }
    }, {rootMargin: '300px'}) : null;

  // `make` gives {data, layout}; called again when the theme changes.
  const add = (element, make, now) => {
    drawn.set(element, make);
    if (observer && !now) {
      observer.observe(element);
    } else {
      requestAnimationFrame(() => { if (drawn.has(element)) render(element); });
    }
  };

  // `now`: not only when it comes into view.
  const figure = (parent, title, note, make, now = false) => {
    const box = document.createElement('figure');
    box.className = 'plot';
    const caption = document.createElement('figcaption');
    const heading = document.createElement('h3');
    heading.textContent = title;
    const text = document.createElement('p');
    text.className = 'dim';
    text.textContent = note;
    caption.append(heading, text);
    const chart = document.createElement('div');
    chart.className = 'chart';
    chart.setAttribute('role', 'img');
    chart.setAttribute('aria-label', title + '. ' + note);
    box.append(caption, chart);
    parent.append(box);
    add(chart, make, now);
  };

  const forget = (root) => {
    for (const element of [...drawn.keys()]) {
      if (!root.contains(element)) continue;
      drawn.delete(element);
      if (observer) observer.unobserve(element);
      Plotly.purge(element);
    }
  };

  const redraw = () => {
    for (const element of drawn.keys()) {
      if (element.classList.contains('js-plotly-plot')) render(element);
    }
  };

  const faint = (hex) => hex.startsWith('#') && hex.length === 7 ? hex + '33' : hex;

  const recall = (curve) => () => {
    const x = curve.map((c) => c[0]);
    return {
      data: [
        {x: x.concat([...x].reverse()), fill: 'toself', fillcolor: faint(color('accent')),
          y: curve.map((c) => c[3]).concat(curve.map((c) => c[2]).reverse()),
          line: {width: 0}, mode: 'lines', hoverinfo: 'skip', name: '95 % interval'},
        {x, y: curve.map((c) => c[1]), mode: 'lines', name: 'recall',
          line: {color: color('accent'), width: 3},
          hovertemplate: 'within %{x} m and %{x}°: %{y:.1%}<extra></extra>'},
      ],
      layout: layout(axis('limit: x m and x°'),
        axis('share of all runs', {range: [0, 1.02], tickformat: '.0%'}), {showlegend: false}),
    };
  };

  const reliability = (bins) => () => ({
    data: [
      {x: [0, 1], y: [0, 1], mode: 'lines', line: {dash: 'dot', color: color('dim')},
        hoverinfo: 'skip', name: 'honest'},
      {x: bins.map((b) => b[0]), y: bins.map((b) => b[1]), mode: 'markers',
        marker: {color: color('accent'), size: bins.map((b) => 8 + 3 * Math.sqrt(b[4]))},
        error_y: {type: 'data', symmetric: false, array: bins.map((b) => b[3] - b[1]),
          arrayminus: bins.map((b) => b[1] - b[2]), color: color('dim'), thickness: 1.5},
        customdata: bins.map((b) => b[4]),
        hovertemplate: 'confidence %{x:.2f}: %{y:.0%} right of %{customdata}<extra></extra>'},
    ],
    layout: layout(axis('reported confidence', {range: [-0.03, 1.03]}),
      axis('share that is right', {range: [-0.03, 1.03], tickformat: '.0%'}), {showlegend: false}),
  });

  const names = {right: 'right', wrong: 'wrong', abstained: 'abstained'};
  const symbols = {right: 'circle', wrong: 'x', abstained: 'diamond-open'};

  const leastOf = (runs) => Math.min(1, ...runs.map((r) => r.energy).filter((e) => e > 0));
  const log = {type: 'log', exponentformat: 'power'};

  // One point per run with truth; a click opens the run. Energies of 0 stand beside the least above.
  const scatter = (runs, open) => () => ({
    data: Object.keys(names).map((outcome) => {
      const some = runs.filter((r) => r.outcome === outcome && r.translation !== null);
      return {name: names[outcome], mode: 'markers', x: some.map((r) => Math.max(r.translation, 0.01)),
        y: some.map((r) => r.energy || leastOf(runs)), text: some.map((r) => r.label),
        customdata: some.map((r) => r.index),
        marker: {color: color(outcome), size: 9, symbol: symbols[outcome]},
        hovertemplate: '%{x:.2f} m, energy %{y:.2g}<extra></extra>'};
    }).filter((s) => s.x.length > 0),
    layout: layout(axis('position error [m]', log), axis('energy of the pose', log),
      {legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom'}}),
    open,
  });

  const generic = (plot) => () => ({
    data: plot.series.map((s) => ({name: s.name, x: s.x, y: s.y, text: s.labels,
      mode: !s.line ? 'markers' : plot.xNames.length > 0 ? 'lines+markers' : 'lines',
      marker: {size: s.line ? 8 : 6, opacity: s.line ? 1 : 0.65}})),
    layout: layout(
      axis(plot.x, plot.xNames.length > 0 ?
        {tickvals: plot.xNames.map((_, i) => i), ticktext: plot.xNames} :
        plot.xLog ? log : {}),
      axis(plot.y, plot.yLog ? log : {rangemode: 'tozero'}), {legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom'}}),
  });

  return {add, figure, forget, redraw, color, axis, layout, recall, reliability, scatter, generic};
})();
