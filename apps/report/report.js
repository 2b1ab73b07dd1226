// Draws a report from the JSON in the page. It places, scales and colours; every number it shows was computed before.
'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const page = document.getElementById('page');
  const hidden = new Set(data.groups.filter((group) => !group.shown).map((group) => group.name));  // switched off
  let charts = [];           // of this view: {graph, resize}
  let plans = [];            // functions that draw again

  // Okabe and Ito's colours, which the colour-blind tell apart; lighter on dark paper. Dashes tell more than colours on paper.
  const palettes = {
    light: ['#0072b2', '#d55e00', '#009e73', '#b0508a', '#a87400', '#3d8fc4', '#5d3fa0', '#6b6b00'],
    dark: ['#56b4e9', '#ff8c42', '#2fc49a', '#e39ac6', '#f0c03a', '#a5d8ff', '#b79cff', '#d4d45a'],
  };
  const dashes = [[], [8, 3], [2, 3], [9, 3, 2, 3], [14, 4], [5, 5], [3, 3, 9, 3], [1, 5]];
  const printing = () => document.documentElement.classList.contains('printing');
  const dark = () => !printing() && matchMedia('(prefers-color-scheme: dark)').matches;
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const numberOf = (name) => data.groups.filter((group) => !group.neutral).findIndex((group) => group.name === name);
  const colour = (name, fallback = 0) => {
    const group = data.groups.find((one) => one.name === name);
    const palette = palettes[dark() ? 'dark' : 'light'];
    if (group && group.neutral) return data.groups.indexOf(group) ? css('--ink') : (dark() ? '#9aa0a6' : '#7a7a7a');
    return palette[(group ? numberOf(name) : fallback) % palette.length];
  };
  const dashOf = (curve, fallback) => {
    const number = curve.dash ?? (curve.group ? Math.max(0, numberOf(curve.group)) : fallback);
    return dashes[number % dashes.length];
  };
  const views = new Map(data.views.map((view, i) => [view.name, i]));
  const told = (panel, value) => shown(panel.period && finite(value) ? (value % panel.period + panel.period) % panel.period : value);
  const shown = (value) => value === null || value === undefined ? '–' : String(Number(value.toPrecision(5)));

  function element(name, properties = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(properties))
      if (key in made) made[key] = value; else made.setAttribute(key, value);
    made.append(...children.filter((child) => child));
    return made;
  }

  const ruler = document.createElement('canvas').getContext('2d');
  ruler.font = '12px system-ui, sans-serif';
  const widthOf = (text) => ruler.measureText(text).width;
  const symbolOf = (i) => d3.symbol().type(d3.symbols[i % d3.symbols.length]).size(44)();
  const crossed = 'M-4,-4L4,4M-4,4L4,-4';

  function swatch(colourOf, dash, shape = 'line') {
    const svg = d3.create('svg').attr('width', shape === 'line' ? 26 : 12).attr('height', 10).attr('aria-hidden', 'true');
    if (shape === 'crosses') svg.append('path').attr('d', crossed).attr('transform', 'translate(6,5)').attr('stroke', colourOf).attr('stroke-width', 1.6);
    else if (shape === 'symbol') svg.append('path').attr('d', dash).attr('transform', 'translate(6,5)').attr('fill', colourOf);
    else if (shape === 'dots') svg.append('circle').attr('cx', 6).attr('cy', 5).attr('r', 3).attr('fill', colourOf);
    else svg.append('line').attr('x1', 0).attr('x2', 26).attr('y1', 5).attr('y2', 5).attr('stroke', colourOf)
      .attr('stroke-width', 2.5).attr('stroke-dasharray', dash.join(' '));
    return svg.node();
  }

  // A table that is made when it is opened: charts have many numbers.
  function folded(title, make) {
    const details = element('details', {}, element('summary', {textContent: title}));
    details.addEventListener('toggle', () => { if (details.open && details.children.length === 1) details.append(make()); });
    return details;
  }

  function grid(headers, rows) {
    const head = element('tr', {}, ...headers.map((text) => element('th', {textContent: text, scope: 'col'})));
    const body = element('tbody');
    for (const row of rows) body.append(element('tr', {}, ...row.map((cell) => element('td', {textContent: cell}))));
    return element('div', {className: 'rows', tabIndex: 0}, element('table', {}, element('thead', {}, head), body));
  }

  const figure = (panel, ...children) =>
    element('figure', {className: panel.kind}, element('h2', {textContent: panel.title}), ...children,
      panel.note && element('p', {className: 'note', textContent: panel.note}));

  // ---- Charts, by dygraphs

  function drawMarked(panel, canvas, area, graph) {
    canvas.save();
    canvas.beginPath();
    canvas.rect(area.x, area.y, area.w, area.h);
    canvas.clip();
    canvas.font = '11px system-ui, sans-serif';
    canvas.fillStyle = css('--shade');
    for (const {from, to, label} of panel.shaded) {
      const left = graph.toDomXCoord(from), right = graph.toDomXCoord(to);
      canvas.fillRect(left, area.y, Math.max(1, right - left), area.h);
      canvas.fillStyle = css('--faint');
      canvas.fillText(label, Math.max(left, area.x) + 4, area.y + 12);
      canvas.fillStyle = css('--shade');
    }
    let end = -Infinity;  // of what stands above the points, as far as there is room
    panel.remarks?.forEach((text, k) => {
      const at = graph.toDomXCoord(panel.x[k]), half = canvas.measureText(text).width / 2;
      if (!text || at - half < end) return;
      canvas.fillStyle = css('--faint');
      canvas.fillText(text, Math.max(area.x, Math.min(at - half, area.x + area.w - 2 * half)), area.y + 10);
      end = at + half + 4;
    });
    for (const {from, to} of panel.expected) {
      const top = graph.toDomYCoord(to), bottom = graph.toDomYCoord(from);
      canvas.fillStyle = css('--expected');
      canvas.fillRect(area.x, top, area.w, Math.max(1, bottom - top));
    }
    visibleHistories(panel).forEach(({group, stays}, i) => {
      const top = graph.toDomYCoord(-historyStep * (i + 0.3)), bottom = graph.toDomYCoord(-historyStep * (i + 1));
      for (const {from, to, label, shade} of stays) {
        const left = Math.max(area.x, graph.toDomXCoord(from)), right = Math.min(area.x + area.w, graph.toDomXCoord(to));
        if (right <= left) continue;
        canvas.globalAlpha = [0.22, 0.75, 0.45, 0.95][shade % 4];
        canvas.fillStyle = colour(group, i);
        canvas.fillRect(left, top, Math.max(1, right - left), bottom - top);
        canvas.globalAlpha = 1;
        canvas.fillStyle = shade % 2 ? css('--paper') : css('--ink');
        canvas.font = '11px system-ui, sans-serif';
        if (canvas.measureText(label).width + 6 < right - left) canvas.fillText(label, left + 4, (top + bottom) / 2 + 4);
      }
    });
    canvas.restore();
  }

  // Bands of histories stand below zero, each so high in the unit of the weights.
  const historyStep = 0.14;
  const visibleHistories = (panel) => (panel.histories ?? []).filter((band) => !hidden.has(band.group));
  const stayAt = (band, x) => band.stays.find(({from, to}) => x !== null && from <= x && x <= to)?.label;

  function readout(panel, holder, options) {
    const show = (row) => {
      holder.replaceChildren();
      if (row !== null) holder.append(element('span', {textContent: `${panel.x_label}: ${shown(panel.x[row])}`}));
      if (row !== null && panel.remarks) holder.append(element('span', {textContent: panel.remarks[row]}));
      panel.curves.forEach((curve, i) => {
        if (hidden.has(curve.group)) return;
        const value = row === null ? '' : ` ${told(panel, curve.values[row])}`;
        holder.append(element('span', {}, swatch(options.colors[i], options.dash[i], curve.dots ? 'dots' : 'line'), ` ${curve.name}${value}`));
      });
      for (const band of visibleHistories(panel))
        holder.append(element('span', {}, element('i', {className: 'history', style: `background: ${colour(band.group)}`}),
          ` ${band.name}${row === null ? '' : ` ${stayAt(band, panel.x[row]) ?? '–'}`}`));
      for (const {label} of panel.expected)
        holder.append(element('span', {}, element('i', {className: 'expected'}), ` ${label}`));
    };
    show(null);
    return {show, plugin: {activate: () => ({select: (event) => show(event.dygraph.lastRow_), deselect: () => show(null)})}};
  }

  // A band that goes on over gaps, as the line does: those of dygraphs end there.
  function drawBand({points, dygraph, setName, drawingContext: canvas, plotArea: area, color}) {
    const known = points.filter((point) => Number.isFinite(point.y_top) && Number.isFinite(point.y_bottom));
    if (!known.length) return;
    canvas.save();
    canvas.beginPath();
    known.forEach((point, i) => canvas[i ? 'lineTo' : 'moveTo'](point.canvasx, area.y + area.h * point.y_top));
    known.reverse().forEach((point) => canvas.lineTo(point.canvasx, area.y + area.h * point.y_bottom));
    canvas.fillStyle = color;
    canvas.globalAlpha = dygraph.getNumericOption('fillAlpha', setName);
    canvas.fill();
    canvas.restore();
  }

  function style(panel) {
    return {
      colors: panel.curves.map((curve, i) => colour(panel.stacked ? null : curve.group, i)),
      dash: panel.curves.map((curve, i) => dashOf(curve, i)),
    };
  }

  function drawLines(panel, place) {
    const banded = panel.curves.some((curve) => curve.lower);
    const cell = (curve, k) => {
      const value = curve.values[k];
      if (!banded) return value;
      return value === null ? [null, null, null] : [curve.lower?.[k] ?? value, value, curve.upper?.[k] ?? value];
    };
    const looks = style(panel);
    const box = element('div', {className: 'chart', role: 'img', ariaLabel: `${panel.title}, ${panel.y_label}; the table below has the numbers`});
    const values = element('div', {className: 'readout'});
    const histories = panel.histories ?? [], remarks = (k) => panel.remarks ? [panel.remarks[k]] : [];
    const table = folded('Table', () => grid([panel.x_label, ...panel.curves.map((curve) => curve.name), ...histories.map((band) => band.name),
      ...remarks(0).fill('')], panel.x.map((x, k) => [shown(x), ...panel.curves.map((curve) => told(panel, curve.values[k])),
      ...histories.map((band) => stayAt(band, x) ?? '–'), ...remarks(k)])));
    const yLabel = element('div', {className: 'y-label', textContent: panel.y_label});
    place.append(figure(panel, yLabel, box, element('div', {className: 'x-label', textContent: panel.x_label}), values, table));
    const roll = (made) => {  // stacked areas of more rows than pixels would be a bar code: means of neighbours, until one zooms in
      const [from, to] = made.xAxisRange(), rows = panel.x.filter((x) => from <= x && x <= to).length;
      const period = Math.max(1, Math.round(3 * rows / made.getArea().w));
      yLabel.textContent = panel.y_label + (period > 1 ? `; means of ${period} rows, zoom in for each` : '');
      if (period !== made.rollPeriod()) made.adjustRoll(period);
    };

    const turns = (from, to) => {  // the numbers along an axis that begins again after a period
      const step = [15, 30, 45, 90, 180].find((one) => (to - from) / one <= 8) ?? 360 * Math.ceil((to - from) / 2880);
      return d3.range(Math.ceil(from / step) * step, to, step).map((v) => ({v, label: told(panel, v)}));
    };
    const reading = readout(panel, values, looks);
    const graph = new Dygraph(box, panel.x.map((x, k) => [x, ...panel.curves.map((curve) => cell(curve, k))]), {
      labels: ['x', ...panel.curves.map((_, i) => `c${i}`)],
      connectSeparatedPoints: panel.joined === true, customBars: banded, fillAlpha: panel.stacked ? 0.7 : 0.18, stackedGraph: panel.stacked === true,
      logscale: panel.logarithmic === true, legend: 'never', plugins: [reading.plugin],
      colors: looks.colors, strokeWidth: panel.stacked ? 0.5 : 1.8, highlightCircleSize: 4, animatedZooms: false,
      series: Object.fromEntries(panel.curves.map((curve, i) => [`c${i}`, {
        strokePattern: looks.dash[i].length ? looks.dash[i] : null,
        ...(curve.dots ? {strokeWidth: 0, drawPoints: true, pointSize: 2} : {}),
      }])),
      visibility: panel.curves.map((curve) => !hidden.has(curve.group)),
      includeZero: !panel.logarithmic, valueRange: rangeOf(panel),
      xRangePad: 4, yRangePad: 6, gridLineColor: css('--line'), axisLineColor: css('--line'), gridLineWidth: 0.5,
      axes: {x: {axisLabelFormatter: shown, pixelsPerLabel: 75}, y: {...(panel.period ? {ticker: turns} : {}), axisLabelWidth: 52, axisLabelFormatter: (y) => histories.length && y < -1e-9 ? '' : told(panel, y)}},
      ...(banded && panel.joined ? {plotter: [drawBand, Dygraph.Plotters.linePlotter]} : {}), rightGap: 10,
      underlayCallback: (canvas, area, made) => drawMarked(panel, canvas, area, made),
      zoomCallback: () => showReset(), ...(panel.stacked ? {drawCallback: roll} : {}),
      interactionModel: {...Dygraph.defaultInteractionModel, dblclick: () => showAll()},
    });
    charts.push({graph, panel, reading, looks});
    hideIfEmpty(graph, panel);
  }

  // The chart of one filter is gone with it.
  const hideIfEmpty = (graph, panel) => {
    graph.graphDiv.closest('figure').hidden = panel.curves.length > 0 && panel.curves.every((curve) => hidden.has(curve.group));
  };

  function restyle({graph, panel, reading, looks}) {
    Object.assign(looks, style(panel));
    hideIfEmpty(graph, panel);
    const options = {colors: looks.colors, gridLineColor: css('--line'), axisLineColor: css('--line'),
      visibility: panel.curves.map((curve) => !hidden.has(curve.group))}, before = graph.getArea().w;
    graph.updateOptions(options, true);
    reading.show(null);
    if (graph.graphDiv.closest('figure').hidden) return;
    graph.resize();  // which draws if there is another width
    if (graph.getArea().w === before) graph.updateOptions(options);
  }

  // ---- The map, by D3

  const finite = (value) => value !== null && value !== undefined;

  function drawPlan(panel, place) {
    const svg = d3.create('svg').attr('class', 'map').attr('role', 'img').attr('aria-label', panel.title);
    const groups = [...new Map(panel.traces.map((trace) => [trace.name, trace])).values()], crowded = groups.length > 12;
    const key = element('div', {className: 'readout'});
    const points = (trace) => trace.x.map((x, k) => [shown(x), shown(trace.y[k]), ...(trace.z ? [shown(trace.z[k])] : [])]);
    const table = folded('Table', () => grid(['', panel.x_label, panel.y_label, 'up, m'].slice(0, panel.traces.some((t) => t.z) ? 4 : 3),
      panel.traces.flatMap((trace) => points(trace).map((row) => [trace.name, ...row]))));
    const whole = element('button', {type: 'button', className: 'whole', textContent: 'Whole track', hidden: !panel.focus});
    place.append(figure(panel, element('div', {className: 'y-label', textContent: panel.y_label}), svg.node(),
      element('div', {className: 'x-label', textContent: panel.x_label}), whole, key, table));

    let transform = d3.zoomIdentity, focused, drawnWidth = 0;
    const zoom = d3.zoom().scaleExtent([1, 500]).filter(() => d3.event.type !== 'wheel' || d3.event.ctrlKey || d3.event.shiftKey)
      .on('zoom', () => { transform = d3.event.transform; whole.hidden = transform.k === 1; draw(); });
    svg.call(zoom);
    whole.addEventListener('click', () => svg.call(zoom.transform, d3.zoomIdentity));

    function draw() {
      const {width, height} = svg.node().getBoundingClientRect();
      if (!width) return;
      if (width !== drawnWidth) focused = !panel.focus;
      drawnWidth = width;
      const edge = {left: 56, right: 30, top: 10, bottom: 24};  // the left one is wider where coordinates are long
      const all = panel.traces.filter((trace) => !hidden.has(trace.group));
      const extent = (axis) => d3.extent((all.length ? all : panel.traces).flatMap((trace) => trace[axis]).filter(finite));
      const [west, east] = extent('x'), [south, north] = extent('y');
      if (west === undefined) return;
      edge.left = Math.max(edge.left, 16 + 7.5 * d3.max([south, north], (y) => d3.format(',.0f')(y).length));
      const inner = {width: width - edge.left - edge.right, height: height - edge.top - edge.bottom};
      const metres = 1.06 * (Math.max((east - west) / inner.width, (north - south) / inner.height) || 0.01);
      const wholeX = d3.scaleLinear().range([edge.left, width - edge.right])
        .domain([(west + east - metres * inner.width) / 2, (west + east + metres * inner.width) / 2]);
      const wholeY = d3.scaleLinear().range([height - edge.bottom, edge.top])
        .domain([(south + north - metres * inner.height) / 2, (south + north + metres * inner.height) / 2]);
      if (!focused) {
        focused = true;
        const [left, right, bottom, top] = [wholeX(panel.focus[0]), wholeX(panel.focus[1]), wholeY(panel.focus[2]), wholeY(panel.focus[3])];
        const k = Math.max(1, Math.min(inner.width / (right - left), inner.height / (bottom - top)));
        svg.call(zoom.transform, d3.zoomIdentity.translate(edge.left + inner.width / 2, edge.top + inner.height / 2)
          .scale(k).translate(-(left + right) / 2, -(bottom + top) / 2));
        return;
      }
      const x = transform.rescaleX(wholeX), y = transform.rescaleY(wholeY);
      svg.selectAll('*').remove();
      const clip = `clip${plans.length}${Math.round(width)}`;
      svg.append('clipPath').attr('id', clip).append('rect').attr('x', edge.left).attr('y', edge.top)
        .attr('width', inner.width).attr('height', inner.height);
      svg.append('g').attr('transform', `translate(0,${height - edge.bottom})`).call(apart(d3.axisBottom(x), x, width));
      svg.append('g').attr('transform', `translate(${edge.left},0)`).call(d3.axisLeft(y).ticks(height / 60).tickSizeOuter(0));
      const body = svg.append('g').attr('clip-path', `url(#${clip})`);
      const line = (xs, ys) => d3.line().defined((k) => finite(xs[k]) && finite(ys[k])).x((k) => x(xs[k])).y((k) => y(ys[k]))(d3.range(xs.length));
      const labels = [drawScaleBar(body, x, width, height, edge)];  // left, right and bottom: where one stands there is room for no other
      for (const one of panel.graticule) {
        body.append('path').attr('class', 'graticule').attr('d', line(one.x, one.y));
        const room = ([left, right, bottom]) => left > edge.left && right < width - edge.right && bottom > edge.top + 12
          && bottom < height - edge.bottom - 2 && !labels.some(([from, to, low]) => left < to + 8 && from < right + 8 && Math.abs(low - bottom) < 16);
        const found = one.x.map((east, k) => [x(east) + 3, x(east) + 3 + widthOf(one.label), y(one.y[k]) - 3]).find(room);
        if (!found) continue;
        labels.push(found);
        body.append('text').attr('class', 'graticule-label').attr('x', found[0]).attr('y', found[2]).text(one.label);
      }
      for (const ellipse of panel.ellipses.filter((one) => !hidden.has(one.group))) {
        const scale = Math.abs(x(1) - x(0));
        body.append('ellipse').attr('rx', ellipse.semi_major * scale).attr('ry', ellipse.semi_minor * scale)
          .attr('transform', `translate(${x(ellipse.x)},${y(ellipse.y)}) rotate(${-ellipse.angle_deg})`)
          .attr('fill', colour(ellipse.group)).attr('fill-opacity', 0.15).attr('stroke', colour(ellipse.group));
      }
      panel.traces.forEach((trace, i) => {
        if (hidden.has(trace.group)) return;
        const stroke = colour(trace.group, i);
        if (trace.shape === 'line') {
          for (const look of views.has(trace.name) ? ['near', 'own'] : ['own'])  // a click near a line is one on it
            opening(body.append('path'), trace.name).attr('class', look).attr('stroke', stroke)
              .attr('stroke-dasharray', crowded ? null : dashOf(trace, i).join(' ')).attr('d', line(trace.x, trace.y));
          return;
        }
        const dots = trace.shape === 'dots', at = (k) => `M${x(trace.x[k]).toFixed(1)},${y(trace.y[k]).toFixed(1)}${dots ? 'h.01' : 'm-4,-4l8,8m-8,0l8,-8'}`;
        opening(body.append('path'), trace.name).attr('d', d3.range(trace.x.length).filter((k) => finite(trace.x[k])).map(at).join(''))
          .attr('fill', 'none').attr('stroke', stroke).attr('stroke-width', dots ? 3.4 : 1.6).attr('stroke-linecap', 'round').attr('opacity', 0.8);
      });
      if (!crowded) key.replaceChildren(...groups.filter((trace) => !hidden.has(trace.group)).map((trace) => element('span', {},
        swatch(colour(trace.group, panel.traces.indexOf(trace)), dashOf(trace, panel.traces.indexOf(trace)), trace.shape), ` ${trace.name}`)));
    }
    plans.push(draw);
    if (panel.traces.some((trace) => trace.z)) drawSpace(panel, place);
  }

  // The same in space, turned by dragging; heights are stretched. By hand: neither library draws in space.
  function drawSpace(panel, place) {
    const svg = d3.create('svg').attr('class', 'map').attr('role', 'img').attr('aria-label', `${panel.title} in space`);
    const names = [panel.x_label, panel.y_label, 'up'].map((label) => label.replace(', m', ''));
    const extents = ['x', 'y', 'z'].map((axis) => d3.extent(panel.traces.flatMap((trace) => trace[axis]).filter(finite)));
    place.append(figure({kind: 'plan', title: `${panel.title}, in space`, note: 'Drag to turn. Heights are stretched.'},
      element('div', {className: 'y-label', textContent: names.map((name, i) => `${name} from ${shown(extents[i][0])} to ${shown(extents[i][1])} m`).join(', ')}), svg.node()));
    let yaw = -0.6, pitch = 0.5;
    const [xs, ys, zs] = extents, centre = extents.map(([from, to]) => (from + to) / 2);
    const across = Math.max(xs[1] - xs[0], ys[1] - ys[0]) || 1, up = zs[1] - zs[0] || 1;

    function draw() {
      const {width, height} = svg.node().getBoundingClientRect();
      if (!width) return;
      const size = 0.62 * Math.min(width, 1.5 * height);
      const at = (x, y, z) => {
        const [u, v, w] = [(x - centre[0]) / across, (y - centre[1]) / across, 0.45 * (z - centre[2]) / up];
        const right = u * Math.cos(yaw) - v * Math.sin(yaw), away = u * Math.sin(yaw) + v * Math.cos(yaw);
        return [width / 2 + size * right, height / 2 - size * (w * Math.cos(pitch) + away * Math.sin(pitch))];
      };
      svg.selectAll('*').remove();
      const path = (corners) => `M${corners.map(([x, y, z]) => at(x, y, z).join(',')).join('L')}`;
      const floor = [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]].map(([i, j]) => [xs[i], ys[j], zs[0]]);
      svg.append('path').attr('class', 'graticule').attr('d', path(floor));
      svg.append('path').attr('class', 'graticule').attr('d', path([[xs[0], ys[0], zs[0]], [xs[0], ys[0], zs[1]]]));
      [0, 1, 2].forEach((axis) => {  // its name stands beyond the end of each axis
        const [px, py] = at(...extents.map(([from, to], i) => i === axis ? to + 0.1 * (i === 2 ? up : across) : from));
        if (extents[axis][1] > extents[axis][0]) svg.append('text').attr('class', 'graticule-label').attr('text-anchor', 'middle')
          .attr('x', Math.max(20, Math.min(px, width - 20))).attr('y', Math.max(14, Math.min(py, height - 8))).text(names[axis]);
      });
      panel.traces.forEach((trace, i) => {
        if (hidden.has(trace.group)) return;
        const all = d3.range(trace.x.length).filter((k) => finite(trace.x[k]) && finite(trace.z[k]));
        if (trace.shape === 'line')
          svg.append('path').attr('d', path(all.map((k) => [trace.x[k], trace.y[k], trace.z[k]]))).attr('fill', 'none')
            .attr('stroke', colour(trace.group, i)).attr('stroke-width', 1.8).attr('stroke-dasharray', dashOf(trace, i).join(' '));
        else
          svg.append('path').attr('d', all.map((k) => `M${at(trace.x[k], trace.y[k], trace.z[k]).map((c) => c.toFixed(1)).join(',')}h.01`).join(''))
            .attr('stroke', colour(trace.group, i)).attr('stroke-width', 3.5).attr('stroke-linecap', 'round').attr('opacity', 0.7);
      });
    }
    svg.call(d3.drag().on('drag', () => {
      yaw += d3.event.dx / 150;
      pitch = Math.min(1.55, Math.max(0.02, pitch + d3.event.dy / 200));
      draw();
    }));
    plans.push(draw);
  }

  function drawScaleBar(body, x, width, height, edge) {
    const [from, to] = x.domain();
    const length = d3.tickStep(0, (to - from) / 3, 1) || 1;
    const pixels = x(from + length) - x(from);
    const bar = body.append('g').attr('transform', `translate(${width - edge.right - pixels - 12},${height - edge.bottom - 12})`);
    bar.append('path').attr('d', `M0,-4V0H${pixels}V-4`).attr('fill', 'none').attr('stroke', css('--ink')).attr('stroke-width', 1.5);
    const text = length >= 1000 ? `${length / 1000} km` : `${length} m`, spare = Math.max(0, (widthOf(text) - pixels) / 2);
    bar.append('text').attr('x', pixels / 2 - spare).attr('y', -5).attr('text-anchor', 'middle').text(text);
    return [width - edge.right - pixels - 12 - 2 * spare, width - edge.right - 12, height - edge.bottom - 12];
  }

  // Numbers along an axis, so few that they do not touch.
  function apart(axis, scale, width) {
    const [from, to] = scale.range(), fits = (count) => scale.ticks(count).length
      * (d3.max(scale.ticks(count), (tick) => widthOf(scale.tickFormat(count)(tick))) + 16) < to - from;
    return axis.ticks(d3.range(Math.ceil(width / 90), 1, -1).find(fits) ?? 1).tickSizeOuter(0);
  }

  // ---- Heat maps, by D3

  function drawHeat(panel, place) {
    const hint = panel.texts?.length ? 'Point at a cell: it says what its number comes from.' : '';
    const values = element('div', {className: 'readout', textContent: hint});
    const box = element('div', {className: 'scroll'});
    const table = folded('Table', () => grid([`${panel.row_label} \\ ${panel.column_label}`, ...panel.columns],
      panel.rows.map((name, r) => [name, ...panel.shown[r]])));
    place.append(figure(panel, element('div', {className: 'y-label', textContent: `${panel.value_label}; rows: ${panel.row_label}, columns: ${panel.column_label}`}), box,
      values, table));
    const draw = () => {
      let [least, greatest] = d3.extent(panel.values.flat().filter(finite));
      if (panel.most) [least, greatest] = [panel.diverging ? -panel.most : least, panel.most];
      const end = Math.max(Math.abs(least), Math.abs(greatest)) || 1;
      const scale = panel.diverging ? d3.scaleSequential(d3.interpolatePuOr).domain([end, -end])
        : d3.scaleSequential(dark() ? d3.interpolateViridis : (t) => d3.interpolateYlGnBu(0.05 + 0.9 * t)).domain([Math.min(0, least), greatest]);
      const left = 12 + d3.max(panel.rows, widthOf);
      const room = (box.getBoundingClientRect().width || 500) - left - 6;
      const height = panel.rows.length > 25 ? 16 : 26, narrowest = height > 20 ? 8 + d3.max(panel.shown.flat(), widthOf) : 12;
      const cell = {width: Math.max(narrowest, Math.min(90, room / panel.columns.length)), height};
      const longest = d3.max(panel.columns, widthOf), slant = longest > cell.width - 4;
      const top = slant ? 20 + 0.65 * longest : 22, width = left + cell.width * panel.columns.length + (slant ? 0.77 * longest : 4);
      const svg = d3.create('svg').attr('class', 'heat').attr('role', 'img').attr('aria-label', panel.title)
        .attr('width', width).attr('viewBox', `0 0 ${width} ${top + cell.height * panel.rows.length + 4}`);
      panel.columns.forEach((name, c) => svg.append('text').text(name).attr('text-anchor', slant ? 'start' : 'middle')
        .attr('transform', `translate(${left + (c + 0.5) * cell.width},${top - 7})${slant ? ' rotate(-40)' : ''}`));
      panel.rows.forEach((name, r) => {
        svg.append('text').text(name).attr('text-anchor', 'end').attr('x', left - 6).attr('y', top + (r + 0.5) * cell.height + 4);
        panel.columns.forEach((column, c) => {
          const value = panel.values[r][c];
          const fill = finite(value) ? d3.color(scale(value)) : null;
          const words = [`${name}, ${column}: ${panel.shown[r][c]}`, panel.texts?.[r]?.[c]].filter((text) => text).join('; ');
          const box = svg.append('g').attr('class', 'cell').on('mouseenter', () => { values.textContent = words; })
            .on('mouseleave', () => { values.textContent = hint; });
          box.append('title').text(words);
          box.append('rect').attr('x', left + c * cell.width).attr('y', top + r * cell.height).attr('width', cell.width - 1)
            .attr('height', cell.height - 1).attr('fill', fill || 'none');
          const light = fill && d3.lab(fill).l > 60;
          if (cell.height > 20) box.append('text').text(panel.shown[r][c]).attr('text-anchor', 'middle').attr('x', left + (c + 0.5) * cell.width)
            .attr('y', top + (r + 0.5) * cell.height + 4).style('fill', fill ? (light ? '#111' : '#fff') : null);
        });
      });
      box.replaceChildren(svg.node());
    };
    plans.push(draw);
  }

  // ---- Numbers with their intervals, by D3: a row for each, the series below each other in it

  const fitting = (text, width) => {
    let cut = text;
    while (cut.length > 1 && widthOf(cut === text ? cut : `${cut}…`) > width) cut = cut.slice(0, -1);
    return cut === text ? text : `${cut}…`;
  };

  function drawIntervals(panel, place) {
    const values = element('div', {className: 'readout'});
    const svg = d3.create('svg').attr('class', 'intervals').attr('role', 'img').attr('aria-label', `${panel.title}, ${panel.x_label}`);
    const table = folded('Table', () => grid(['', ...panel.series.map((series) => series.name)],
      panel.rows.map((name, r) => [name, ...panel.series.map((series) => series.shown[r])])));
    place.append(figure(panel, svg.node(), element('div', {className: 'x-label', textContent: panel.x_label}), values, table));
    const key = (words) => values.replaceChildren(...(words ? [element('span', {textContent: words})] : [
      ...panel.series.map((series, i) => [series, colour(series.group, i), i]).filter(([series]) => !hidden.has(series.group))
        .map(([series, paint, i]) => element('span', {}, swatch(paint, symbolOf(i), 'symbol'), ` ${series.name}`)),
      panel.wanted_label && element('span', {}, element('i', {className: 'expected'}), ` ${panel.wanted_label}`),
    ].filter((one) => one)));
    const draw = () => {
      const {width} = svg.node().getBoundingClientRect();
      if (!width) return;
      const shownSeries = panel.series.map((series, i) => [series, i]).filter(([series]) => !hidden.has(series.group));
      const slot = shownSeries.length > 3 ? 9 : 12, row = Math.max(24, slot * shownSeries.length + 8);
      const left = Math.min(14 + d3.max(panel.rows, widthOf), 0.5 * width), right = width - 14;
      const above = panel.rows.length > 12 ? 20 : 6, bottom = above + row * panel.rows.length;
      const ends = shownSeries.flatMap(([series]) => series.values.flat()
        .concat(series.wanted.flatMap((one) => [one.from, one.to]))).concat(panel.reference ?? null).filter(finite);
      const [least, greatest] = ends.length ? d3.extent(ends) : [0, 1];
      const spare = 0.04 * (greatest - least || 1);
      const x = d3.scaleLinear().domain([least - spare, greatest + spare]).range([left, right]);
      svg.attr('height', bottom + 24).selectAll('*').remove();
      svg.append('g').attr('transform', `translate(0,${bottom})`).call(apart(d3.axisBottom(x), x, width).tickSizeInner(above - bottom));
      if (panel.rows.length > 12)
        svg.append('g').attr('transform', 'translate(0,18)').call(apart(d3.axisTop(x), x, width).tickSize(0));
      if (finite(panel.reference))
        svg.append('path').attr('class', 'reference').attr('d', `M${x(panel.reference)},${above}V${bottom}`);
      panel.rows.forEach((name, r) => {
        const top = above + row * r;
        if (r) svg.append('path').attr('class', 'between').attr('d', `M0,${top}H${right}`);
        svg.append('text').text(fitting(name, left - 10)).attr('text-anchor', 'end')
          .attr('x', left - 6).attr('y', top + row / 2 + 4).append('title').text(name);
        shownSeries.forEach(([series, i], s) => {
          const [mean, lower, upper] = series.values[r], wanted = series.wanted[r];
          const y = top + row / 2 + slot * (s - (shownSeries.length - 1) / 2);
          const paint = colour(series.group, i), words = `${name}, ${series.name}: ${series.shown[r]}`;
          const box = svg.append('g').attr('class', 'interval').on('mouseenter', () => key(words)).on('mouseleave', () => key());
          if (wanted && (finite(wanted.from) || finite(wanted.to))) {
            const from = finite(wanted.from) ? x(wanted.from) : left, to = finite(wanted.to) ? x(wanted.to) : right;
            svg.insert('rect', 'g').attr('class', 'expected').attr('x', from).attr('y', y - slot / 2).attr('width', Math.max(1, to - from)).attr('height', slot);
          }
          box.append('rect').attr('x', left).attr('y', y - slot / 2).attr('width', right - left).attr('height', slot).attr('fill', 'transparent');
          box.append('title').text(words);
          if (!finite(mean)) return;
          if (finite(lower)) box.append('path').attr('d', `M${x(lower)},${y}H${x(upper)}M${x(lower)},${y - 3}v6M${x(upper)},${y - 3}v6`).attr('stroke', paint).attr('stroke-width', 1.6);
          box.append('path').attr('d', symbolOf(i)).attr('transform', `translate(${x(mean)},${y})`).attr('fill', paint);
        });
      });
      key();
    };
    plans.push(draw);
  }

  // ---- Tables and words

  function drawTable(panel, place) {
    const head = [];
    if (panel.columns.some((column) => column.group)) {
      const groups = element('tr');
      for (let i = 0; i < panel.columns.length;) {
        let end = i + 1;
        while (end < panel.columns.length && panel.columns[i].group && panel.columns[end].group === panel.columns[i].group) ++end;
        groups.append(element('th', {textContent: panel.columns[i].group, colSpan: end - i, scope: 'colgroup'}));
        i = end;
      }
      head.push(groups);
    }
    head.push(element('tr', {}, ...panel.columns.map((column, i) =>
      element('th', {textContent: column.header, className: column.left ? 'left' : '', scope: 'col', onclick: ({target}) => sort(target, i)}))));
    const body = element('tbody');
    let ruled = false;
    for (const row of panel.rows) {
      if (!row.length) { ruled = true; continue; }
      body.append(element('tr', {className: ruled ? 'ruled' : ''}, ...row.map((cell, i) => {
        const made = element('td', {className: panel.columns[i].left ? (cell.text.length > 30 ? 'left long' : 'left') : ''},
          i === 0 && views.has(cell.text) ? element('button', {type: 'button', textContent: cell.text, onclick: () => open(cell.text)}) : cell.text);
        if (panel.columns[i].key) made.dataset.key = panel.columns[i].key;
        if (typeof cell.value === 'number') made.dataset.value = cell.value;
        return made;
      })));
      ruled = false;
    }
    function sort(head, i) {
      const down = head.ariaSort === 'ascending', of = (row) => Number(row.children[i].dataset.value ?? -Infinity);
      for (const one of head.parentNode.children) one.ariaSort = null;
      head.ariaSort = down ? 'descending' : 'ascending';
      body.append(...[...body.children].sort((a, b) => (down ? -1 : 1) * (of(a) - of(b)
        || a.children[i].textContent.localeCompare(b.children[i].textContent, undefined, {numeric: true}))));
    }
    place.append(figure(panel, panel.rows.length > 12 && searchOf(body),
      element('div', {className: 'scroll', tabIndex: 0}, element('table', {}, element('thead', {}, ...head), body))));
  }

  // What is typed is looked for in the rows: a cell that is just that, or else all of its words.
  function searchOf(body) {
    const count = element('span', {className: 'note'}), box = element('input', {type: 'search', placeholder: 'Search the rows', oninput: look});
    const text = (row) => [...row.children].map((cell) => cell.textContent.toLowerCase());
    function look() {
      const wanted = box.value.trim().toLowerCase(), rows = [...body.children];
      const exact = rows.filter((row) => text(row).includes(wanted));
      const found = new Set(wanted && exact.length ? exact : rows.filter((row) => wanted.split(' ').every((word) => text(row).join(' ').includes(word))));
      rows.forEach((row) => { row.hidden = !found.has(row); });
      count.textContent = `${found.size} of ${rows.length} rows`;
    }
    look();
    return element('div', {className: 'filter'}, box, count);
  }

  function drawWords(panel, place) {
    const text = element('pre', {textContent: panel.text});
    place.append(panel.folded ? element('details', {className: 'words wide'}, element('summary', {textContent: panel.title}), text)
      : figure(panel, text));
  }

  const draw = {lines: drawLines, plan: drawPlan, intervals: drawIntervals, heat: drawHeat, table: drawTable, words: drawWords};
  const drawAll = (panels, place) => {
    const before = plans.length;
    for (const panel of panels) draw[panel.kind](panel, place);
    plans.slice(before).forEach((again) => again());  // once each has its width
    charts.forEach(({graph}) => graph.resize());
  };

  // ---- The page

  const place = element('section', {className: 'panels', id: 'view'});
  const reset = element('button', {type: 'button', id: 'reset', textContent: 'Whole time', hidden: true});
  let synchronized = [];

  const showReset = () => { reset.hidden = !charts.some(({graph}) => graph.isZoomed('x')); };

  const rangeOf = ({range, histories}) => range ? [range[0] - historyStep * (histories ?? []).length, range[1]] : null;

  function showAll() {
    charts.forEach(({graph, panel}) => graph.updateOptions({dateWindow: null, valueRange: rangeOf(panel)}));
    showReset();
  }

  // Whatever has the name of a view opens it.
  const opening = (made, name) => {
    if (views.has(name)) made.classed('opens', true).on('click', () => open(name)).append('title').text(name);
    return made;
  };
  function open(name) {
    showView(document.getElementById('view-selector').value = views.get(name));
    controls.scrollIntoView({behavior: 'smooth'});
  }

  function showView(index) {
    const zoomed = charts.find(({graph}) => graph.isZoomed('x')), window = zoomed?.graph.xAxisRange();
    synchronized.forEach((one) => one.detach());
    charts.slice(fixedCharts.length).forEach(({graph}) => graph.destroy());
    charts = fixedCharts.slice(); plans = fixedPlans.slice();
    place.replaceChildren();
    drawAll(data.views[index].panels, place);
    synchronize();
    charts.filter(({panel}) => panel.x_label === zoomed?.panel.x_label).forEach(({graph}) => graph.updateOptions({dateWindow: window}));
    showReset();
  }

  function synchronize() {
    const axes = d3.nest().key(({panel}) => panel.x_label).entries(charts);
    synchronized = axes.map(({values}) => values.map(({graph}) => graph)).filter((graphs) => graphs.length > 1)
      .map((graphs) => Dygraph.synchronize(graphs, {selection: true, zoom: true, range: false}));
  }

  function bar() {
    const made = element('div', {className: 'bar', role: 'toolbar', ariaLabel: 'What is shown'});
    if (data.views.length > 1) {
      const select = element('select', {id: 'view-selector'},
        ...data.views.map((view, i) => element('option', {value: i, textContent: view.name})));
      select.addEventListener('change', () => showView(Number(select.value)));
      made.append(element('label', {}, `${data.chooser} `, select));
    }
    for (const {name} of data.groups) {
      const box = element('input', {type: 'checkbox', checked: !hidden.has(name)});
      box.dataset.group = name;
      box.addEventListener('change', () => {
        if (box.checked) hidden.delete(name); else hidden.add(name);
        redraw();
      });
      made.append(element('label', {}, box, swatch(colour(name), dashOf({group: name}, 0)), name));
    }
    made.append(reset);
    return made;
  }

  function redraw() {
    charts.forEach(restyle);
    plans.forEach((again) => again());
  }

  reset.addEventListener('click', showAll);
  page.replaceChildren(element('h1', {textContent: data.title}));
  if (data.verdict.length) page.append(element('div', {className: 'verdict'}, ...data.verdict.map((text) => element('p', {textContent: text}))));
  const first = element('section', {className: 'panels', id: 'first'});
  const last = element('section', {className: 'panels', id: 'last'});
  page.append(first);
  let controls = null;
  if (data.groups.length || data.views.length > 1) page.append(controls = bar());
  page.append(place, last, element('footer', {}, element('p', {}, 'Made by ', element('code', {textContent: data.command}),
    `, sigmax ${data.version}. Drawn with dygraphs (MIT licence) and D3 (BSD licence). Drag along a chart to zoom, double-click to see all; `
    + 'a map is dragged, and zoomed by double-click or Shift and the wheel.')));
  drawAll(data.panels, first);
  drawAll(data.last, last);
  const fixedPlans = plans.slice(), fixedCharts = charts.slice();
  if (data.views.length) showView(0); else synchronize();

  const relook = () => {
    if (controls) { const again = bar(); const chosen = controls.querySelector('select')?.value;
      if (chosen) again.querySelector('select').value = chosen;
      controls.replaceWith(again); controls = again; }
    redraw();
  };
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', relook);
  // On paper charts are enlarged as they are: what a browser draws while it prints would be tens of thousands of shapes.
  const print = (begins) => {
    document.documentElement.classList.toggle('printing', begins);
    plans.forEach((again) => again());
    charts.forEach(({graph}) => {
      const box = graph.graphDiv.parentNode;
      box.style.zoom = begins ? box.parentNode.clientWidth / graph.size().width : '';
    });
  };
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  let waiting = 0;
  addEventListener('resize', () => { clearTimeout(waiting); waiting = setTimeout(() => plans.forEach((again) => again()), 100); });
  page.dataset.drawn = 'yes';
})();
