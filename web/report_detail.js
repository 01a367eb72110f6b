// SPDX-License-Identifier: Apache-2.0
// One run: photo with the edges before and after, map, figures.
'use strict';

const Detail = (() => {
  const SVG = 'http://www.w3.org/2000/svg';

  const read = (id) => {
    const element = document.getElementById(id);
    return element ? JSON.parse(element.textContent) : null;
  };

  const make = (tag, className, text) => {
    const element = document.createElement(tag);
    if (className) element.className = className;
    if (text !== undefined) element.textContent = text;
    return element;
  };

  // Lines in tenths of a pixel as an SVG over a photo.
  const edges = (layers, photo, width = 2) => {
    const svg = document.createElementNS(SVG, 'svg');
    svg.setAttribute('viewBox', `0 0 ${photo.width} ${photo.height}`);
    svg.setAttribute('aria-hidden', 'true');
    for (const layer of layers) {
      const d = layer.lines.map((line) => {
        let path = '';
        for (let i = 0; i < line.length; i += 2) {
          path += (i === 0 ? 'M' : 'L') + line[i] / 10 + ' ' + line[i + 1] / 10;
        }
        return path;
      }).join('');
      for (const [stroke, thickness] of [['#000', 2 * width], [layer.color, width]]) {
        const path = document.createElementNS(SVG, 'path');
        path.setAttribute('d', d);
        path.setAttribute('fill', 'none');
        path.setAttribute('stroke', stroke);
        path.setAttribute('stroke-width', thickness);
        path.setAttribute('stroke-linecap', 'round');
        path.setAttribute('vector-effect', 'non-scaling-stroke');
        svg.append(path);
      }
    }
    return svg;
  };

  const image = (photo, alt) => {
    const img = make('img');
    img.src = photo.url;
    img.alt = alt;
    return img;
  };

  const glyphs = {square: '■', circle: '●', star: '★', diamond: '◆'};

  // A line's sample, dashed, or the sign of a marker where an entry names one.
  const legend = (entries) => {
    const list = make('ul', 'legend');
    for (const entry of entries) {
      const item = make('li');
      const sample = make('i', entry.dash ? 'dash' : entry.symbol ? 'sign' : '', glyphs[entry.symbol]);
      sample.style.setProperty('--sample', entry.color);
      item.append(sample, entry.name);
      list.append(item);
    }
    return list;
  };

  // `pair`: names of the systems whose poses stand in the places of prior and result; else null.
  const overlay = (run, detail, photo, pair) => {
    const box = make('div');
    const frame = make('span', 'frame');
    frame.style.aspectRatio = `${photo.width} / ${photo.height}`;
    frame.style.maxHeight = '72vh';
    frame.style.maxWidth = `calc(72vh * ${photo.width / photo.height})`;
    frame.style.margin = '0 auto';
    frame.append(image(photo, `Photo of ${run.label} with the model's edges`));
    const before = edges(detail.priorLayers, photo);
    const after = edges(detail.resultLayers, photo);
    frame.append(before, after);
    box.append(frame);
    const both = detail.priorLayers.length > 0 && detail.resultLayers.length > 0;
    if (both) {
      const divider = make('span', 'divider');
      frame.append(divider);
      const row = make('label', 'slider');
      const range = make('input');
      range.type = 'range';
      range.min = 0;
      range.max = 100;
      const [left, right] = pair || ['prior', 'result'];
      range.setAttribute('aria-label', `Left of the line: ${left}; right of it: ${right}`);
      const show = () => {
        const at = Number(range.value);
        before.style.clipPath = `inset(0 ${100 - at}% 0 0)`;
        after.style.clipPath = `inset(0 0 0 ${at}%)`;
        divider.style.left = at + '%';
      };
      range.value = pair ? 50 : 0;
      range.addEventListener('input', show);
      show();
      row.append(`${left}: left of the line`, range, `${right}: right of it`);
      box.append(row);
    }
    if (detail.priorLayers.length === 0 && detail.prior && !pair) {
      box.append(make('p', 'dim', 'No edge of the model is in view from the prior.'));
    }
    const shown = detail.priorLayers.concat(detail.resultLayers).filter((l) => l.lines.length > 0);
    box.append(legend(shown));
    return box;
  };

  const metres = (list) => {
    const x = [];
    const y = [];
    for (let i = 0; i < list.length; i += 2) {
      x.push(list[i] / 100);
      y.push(list[i + 1] / 100);
    }
    return {x, y};
  };

  const relative = (pose, detail) =>
    [pose.position[0] - detail.origin[0], pose.position[1] - detail.origin[1]];

  const outline = (list, name, line) => {
    const {x, y} = metres(list);
    return {x, y, name, mode: 'lines', line, hoverinfo: 'name'};
  };

  const energyTrace = (map) => {
    const z = [];
    for (let r = 0; r < map.rows; ++r) {
      z.push(map.energies.slice(r * map.columns, (r + 1) * map.columns));
    }
    return {type: 'heatmap', z, x0: map.east, dx: map.spacing, y0: map.north, dy: map.spacing,
      colorscale: 'Viridis', reversescale: true, opacity: 0.72, name: 'energy',
      showscale: innerWidth > 600, colorbar: {title: {text: 'energy'}, thickness: 10, len: 0.7},
      hoverongaps: false,
      hovertemplate: '%{x:.1f} m E, %{y:.1f} m N: %{z:.2g}<extra>energy</extra>'};
  };

  const footprintTrace = (rings) => {
    const x = [];
    const y = [];
    for (const ring of rings) {
      const points = metres(ring.concat(ring.slice(0, 2)));
      x.push(...points.x, null);
      y.push(...points.y, null);
    }
    return {x, y, name: 'buildings', mode: 'lines', fill: 'toself', hoverinfo: 'skip',
      fillcolor: 'rgba(120,120,130,.35)', line: {color: Plots.color('dim'), width: 1}};
  };

  // A marker with a short line in the direction of view.
  const poseTrace = (pose, detail, name, color, symbol, reach) => {
    const [x, y] = relative(pose, detail);
    if (!pose.hasHeading) {
      return {x: [x], y: [y], name, mode: 'markers',
        marker: {color, symbol, size: 13, line: {color: '#fff', width: 1}},
        hovertemplate: `${name}: %{x:.2f} m E, %{y:.2f} m N, heading unknown<extra></extra>`};
    }
    const heading = pose.heading * Math.PI / 180;
    return {x: [x, x + reach * Math.sin(heading)], y: [y, y + reach * Math.cos(heading)], name,
      mode: 'lines+markers', line: {color, width: 2},
      marker: {color, symbol: [symbol, 'circle'], size: [13, 1], line: {color: '#fff', width: 1}},
      hovertemplate: `${name}: %{x:.2f} m E, %{y:.2f} m N, heading ${pose.heading.toFixed(1)}°` +
        '<extra></extra>'};
  };

  const bounds = (detail) => {
    const points = [];
    for (const pose of [detail.prior, detail.result, detail.truth]) {
      if (pose) points.push(relative(pose, detail));
    }
    if (detail.map) {
      const {east, north, spacing, columns, rows} = detail.map;
      points.push([east, north], [east + spacing * columns, north + spacing * rows]);
    }
    const box = metres(detail.box);
    box.x.forEach((x, i) => points.push([x, box.y[i]]));
    const low = [0, 1].map((k) => Math.min(...points.map((p) => p[k])) - 4);
    const high = [0, 1].map((k) => Math.max(...points.map((p) => p[k])) + 4);
    return [[low[0], high[0]], [low[1], high[1]]];
  };

  const mapPlot = (detail, pair) => () => {
    const [xRange, yRange] = bounds(detail);
    const reach = 0.12 * (xRange[1] - xRange[0]);
    const data = [];
    if (detail.footprints.length > 0) data.push(footprintTrace(detail.footprints));
    if (detail.map) data.push(energyTrace(detail.map));
    if (detail.box.length > 0) {
      data.push(outline(detail.box, 'search box', {color: Plots.color('dim'), dash: 'dash', width: 1.5}));
    }
    if (detail.ellipse) {
      data.push(outline(detail.ellipse, '95 % ellipse', {color: '#ff3d9a', width: 2}));
    }
    if (detail.modes.length > 1) {
      const places = detail.modes.slice(1).map((m) => relative(m.pose, detail));
      data.push({x: places.map((p) => p[0]), y: places.map((p) => p[1]), name: 'other modes',
        mode: 'markers', marker: {symbol: 'diamond', size: 9, color: '#ffb000',
          line: {color: '#000', width: 1}},
        text: detail.modes.slice(1).map((m) => m.energy.toPrecision(2)),
        hovertemplate: 'mode, energy %{text}<extra></extra>'});
    }
    if (detail.prior) {
      data.push(poseTrace(detail.prior, detail, pair ? pair[0] : 'prior', pair ? '#ffaa00' : '#8a94a0', 'square', reach));
    }
    if (detail.result) {
      data.push(poseTrace(detail.result, detail, pair ? pair[1] : 'result', pair ? '#00c8ff' : '#ff3d9a', 'circle', reach));
    }
    if (detail.truth) {
      data.push(poseTrace(detail.truth, detail, 'truth', '#00b86b', 'star', reach));
    }
    const look = Plots.layout(
      Plots.axis('east of the prior [m]', {range: xRange, constrain: 'domain'}),
      Plots.axis('north [m]', {range: yRange, scaleanchor: 'x', constrain: 'domain'}),
      {showlegend: false});
    if (detail.hillshade) {
      const {url, lower, upper} = detail.hillshade;
      look.images = [{source: url, xref: 'x', yref: 'y', x: lower[0], y: upper[1],
        sizex: upper[0] - lower[0], sizey: upper[1] - lower[1], sizing: 'stretch',
        layer: 'below', opacity: 0.8}];
    }
    return {data, layout: look};
  };

  // What the map's signs mean, below it.
  const mapLegend = (data) => legend(data.map(({name, fillcolor, marker, line}) => ({name,
    color: fillcolor || (marker && marker.color) || (line && line.color),
    symbol: fillcolor ? 'square' : marker && [marker.symbol].flat()[0], dash: line && line.dash}))
    .filter((entry) => entry.color));

  const tracePlot = (trace) => () => ({
    data: [{y: trace, x: trace.map((_, i) => i + 1), mode: 'lines',
      line: {color: Plots.color('accent'), shape: 'hv'}}],
    layout: Plots.layout(Plots.axis('evaluation'), Plots.axis('best energy so far'),
      {showlegend: false}),
  });

  const table = (rows, header) => {
    const scroll = make('div', 'scroll');
    const element = make('table');
    if (header) {
      const row = make('tr');
      for (const cell of header) row.append(make('th', '', cell));
      element.append(row);
    }
    for (const cells of rows) {
      const row = make('tr');
      cells.forEach((cell, i) => row.append(make(i === 0 && !header ? 'th' : 'td', '', cell)));
      element.append(row);
    }
    scroll.append(element);
    return scroll;
  };

  const poseRows = (detail, pair) => {
    const rows = [];
    const [first, second] = pair || ['prior', 'result'];
    for (const [name, key] of [[first, 'prior'], [second, 'result'], ['truth', 'truth']]) {
      const pose = detail[key];
      if (!pose) continue;
      const [east, north, height] = pose.position.map((v) => v.toFixed(2));
      const tilt = (angle) => angle.toFixed(2) + '°' + (pose.hasTilt ? '' : ' assumed');
      rows.push([name, east, north, height + (pose.hasHeight ? '' : ' assumed'),
        pose.hasHeading ? pose.heading.toFixed(2) + '°' : 'unknown',
        tilt(pose.pitch), tilt(pose.roll)]);
    }
    return rows;
  };

  // Where the result is, and a link that shows it on a map in the browser (nothing is loaded here).
  const placeOf = ([latitude, longitude]) => {
    const line = make('p', 'place');
    const words = `${Math.abs(latitude).toFixed(6)}° ${latitude < 0 ? 'S' : 'N'}, ` +
      `${Math.abs(longitude).toFixed(6)}° ${longitude < 0 ? 'W' : 'E'}`;
    const link = make('a', '', 'open in OpenStreetMap');
    link.href = `https://www.openstreetmap.org/?mlat=${latitude}&mlon=${longitude}` +
      `#map=19/${latitude}/${longitude}`;
    link.target = '_blank';
    link.rel = 'noopener noreferrer';
    line.append(words + ' · ', link);
    return line;
  };

  const show = (run, body, sentence, pair = null) => {
    Plots.forget(body);
    body.replaceChildren();
    const detail = read('run-' + run.index);
    const photo = run.photo >= 0 ? read('photo-' + run.photo) : null;
    const status = make('p');
    status.append(make('span', 'badge ' + run.outcome, sentence));
    if (run.reason) status.append(' ' + run.reason);
    body.append(status);
    if (detail.headline) body.append(make('p', 'headline', detail.headline));
    if (detail.latLon) body.append(placeOf(detail.latLon));
    if (photo) body.append(overlay(run, detail, photo, pair));
    const columns = make('div', 'columns');
    const drawable = typeof Plotly !== 'undefined' &&
      (detail.map || detail.prior || detail.result || detail.truth);
    if (drawable) {
      const note = pair ? 'Both poses.' : detail.map ? 'Least energy over all headings at each position; bright is best.' :
        'Positions; this search makes no map of the energy.';
      Plots.figure(columns, 'Map', note, mapPlot(detail, pair), true);
      columns.firstChild.append(mapLegend(mapPlot(detail, pair)().data));
    }
    const right = make('div');
    const poses = poseRows(detail, pair);
    if (poses.length > 0) {
      right.append(make('h3', '', 'Poses'),
        table(poses, ['', 'east', 'north', 'height', 'heading', 'pitch', 'roll']));
    }
    if (detail.facts.length > 0) right.append(make('h3', '', 'Figures'), table(detail.facts));
    columns.append(right);
    if (typeof Plotly !== 'undefined' && detail.trace.length > 1) {
      Plots.figure(columns, 'Search', 'Best energy after each evaluation.',
        tracePlot(detail.trace), true);
    }
    if (typeof Plotly !== 'undefined') {
      for (const plot of detail.plots) {
        Plots.figure(columns, plot.title, plot.note, Plots.generic(plot), true);
      }
    }
    body.append(columns);
  };

  return {show, read, edges, image, make, table};
})();
