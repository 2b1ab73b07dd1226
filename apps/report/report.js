// Draws a report from the JSON in the page. It places, scales and colours; every number it shows was computed before.
'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const page = document.getElementById('page');
  const hidden = new Set(data.groups.filter((group) => !group.shown).map((group) => group.name));  // switched off
  let charts = [], plans = [];  // of this view: {graph, panel, look}, and functions that draw again

  const dashes = [[], [8, 3], [2, 3], [9, 3, 2, 3], [14, 4], [5, 5], [3, 3, 9, 3], [1, 5]];
  const dark = () => !document.documentElement.classList.contains('printing') && matchMedia('(prefers-color-scheme: dark)').matches;
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const neutral = new Map(data.groups.filter((group) => group.neutral).map(({name}, i) => [name, i ? '--ink' : '--grey']));
  const numberOf = (name) => data.groups.filter((group) => !group.neutral).findIndex((group) => group.name === name);
  const nameOf = (group, fallback = 0) => neutral.get(group) ?? `--colour-${(numberOf(group) < 0 ? fallback : numberOf(group)) % 8}`;
  const colour = (group, fallback) => `var(${nameOf(group, fallback)})`;  // a canvas wants css(nameOf(…))
  const dashOf = (curve, fallback) => dashes[(curve.dash ?? (curve.group ? Math.max(0, numberOf(curve.group)) : fallback)) % dashes.length];
  const finite = (value) => value !== null && value !== undefined;
  const rule = 'rgba(128, 128, 128, .35)';
  const views = new Map(data.views.map((view, i) => [view.name, i]));
  const shown = (value) => !finite(value) ? '–' : String(Number(value.toPrecision(5)));
  const momentOf = (panel, x) => finite(panel.clock) ? new Date(1000 * (panel.clock + x)).toISOString().replace('T', ' ').replace(/(\.000)?Z/, '') : shown(x);

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

  function swatch(paint, dash, shape = 'line') {
    const [path, stroke, width] = {line: ['M0,5H26', 2.5, 26], dots: ['M6,5h.01', 6, 12],
      crosses: ['M2,1L10,9M2,9L10,1', 1.6, 12], symbol: [dash, 0, 12]}[shape];
    const svg = d3.create('svg').attr('width', width).attr('height', 10).attr('aria-hidden', 'true');
    svg.append('path').attr('d', path).attr('stroke', paint).attr('stroke-width', stroke).attr('stroke-linecap', shape === 'dots' ? 'round' : null)
      .attr('fill', paint).attr('stroke-dasharray', shape === 'line' ? dash.join(' ') : null).attr('transform', shape === 'symbol' ? 'translate(6,5)' : null);
    return svg.node();
  }

  // A table that is made when it is opened: charts have many numbers.
  const folded = (title, make) =>
    element('details', {ontoggle: ({target}) => { if (target.open && target.children.length === 1) target.append(make()); }}, element('summary', {textContent: title}));

  function grid(headers, rows) {
    const row = (cells, name) => element('tr', {}, ...cells.map((textContent) => element(name, {textContent})));
    const table = element('table', {}, element('thead', {}, row(headers, 'th')), element('tbody', {}, ...rows.map((cells) => row(cells, 'td'))));
    return element('div', {className: 'rows', tabIndex: 0}, table);
  }

  function figure({kind, title, note}, ...children) {
    const saves = !['table', 'words'].includes(kind) && element('button', {type: 'button', className: 'save', textContent: 'Save as SVG', onclick: ({target}) => save(target.parentNode, title)});
    return element('figure', {className: kind}, saves, element('h2', {textContent: title}), ...children, note && element('p', {className: 'note', textContent: note}));
  }

  // A picture that needs no other file: what is drawn, canvases as images, and words where they stand.
  function save(whole, title) {
    const own = whole.getBoundingClientRect(), words = document.createTreeWalker(whole, NodeFilter.SHOW_TEXT), range = document.createRange();
    const frame = new DOMRect(own.x - 8, own.y - 8, own.width + 16, own.height + 16);  // numbers stand beyond the ends of axes
    const svg = d3.create('svg').attr('xmlns', 'http://www.w3.org/2000/svg').attr('viewBox', `${frame.x} ${frame.y} ${frame.width} ${frame.height}`);
    const put = (kind, {x, y, width, height}) => svg.append(kind).attr('x', x).attr('y', y).attr('width', width).attr('height', height);
    put('rect', frame).attr('fill', css('--paper'));
    for (const canvas of whole.querySelectorAll('canvas')) put('image', canvas.getBoundingClientRect()).attr('href', canvas.toDataURL());
    for (const one of whole.querySelectorAll('svg')) {
      const copy = put('svg', one.getBoundingClientRect()).node().appendChild(one.cloneNode(true)), parts = copy.querySelectorAll('*');
      for (const [i, part] of one.querySelectorAll('*').entries())
        for (const name of ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'opacity', 'paint-order', 'font', 'text-anchor'])
          parts[i].style.setProperty(name, getComputedStyle(part).getPropertyValue(name));
    }
    while (words.nextNode()) for (const {0: word, index} of words.currentNode.data.matchAll(/\S+/g)) {
      range.setStart(words.currentNode, index);
      range.setEnd(words.currentNode, index + word.length);
      const box = range.getBoundingClientRect(), own = words.currentNode.parentNode, {color, fontWeight, fontSize} = getComputedStyle(own);
      if (box.width && !own.closest('svg, button, details')) put('text', box).text(word).attr('fill', color).attr('y', box.bottom - box.height / 4).style('font', `${fontWeight} ${fontSize} sans-serif`);
    }
    const file = new Blob([new XMLSerializer().serializeToString(svg.node())], {type: 'image/svg+xml'});
    element('a', {href: URL.createObjectURL(file), download: `${title.replace(/\W+/g, '_').toLowerCase()}.svg`}).click();
  }

  // ---- Charts, by dygraphs

  function drawMarked(panel, canvas, area, graph) {
    const write = (text, x, y, ink = '--faint') => { canvas.fillStyle = css(ink); canvas.fillText(text, x, y); };
    const fill = (paint, left, right, top, bottom) => {
      canvas.fillStyle = css(paint);
      canvas.fillRect(left, top, Math.max(1, right - left), Math.max(1, bottom - top));
    };
    const {x: west, y: north} = area, east = west + area.w;
    canvas.save();
    canvas.beginPath();
    canvas.rect(west, north, area.w, area.h);
    canvas.clip();
    canvas.font = '11px system-ui, sans-serif';
    for (const {from, to, label} of panel.shaded) {
      fill('--shade', graph.toDomXCoord(from), graph.toDomXCoord(to), north, north + area.h);
      write(label, Math.max(graph.toDomXCoord(from), west) + 4, north + 12);
    }
    let end = -Infinity;  // of what stands above the points, as far as there is room
    panel.remarks?.forEach((text, k) => {
      const {width} = canvas.measureText(text), left = Math.max(west, Math.min(graph.toDomXCoord(panel.x[k]) - width / 2, east - width));
      if (!text || left < end) return;
      write(text, left, north + 10);
      end = left + width + 4;
    });
    for (const {from, to} of panel.expected) fill('--expected', west, east, graph.toDomYCoord(to), graph.toDomYCoord(from));
    visibleHistories(panel).forEach(({group, stays}, i) => {
      const top = graph.toDomYCoord(-historyStep * (i + 0.3)), bottom = graph.toDomYCoord(-historyStep * (i + 1));
      for (const {from, to, label, shade} of stays) {
        const left = Math.max(west, graph.toDomXCoord(from)), right = Math.min(east, graph.toDomXCoord(to));
        if (right <= left) continue;
        canvas.globalAlpha = [0.22, 0.75, 0.45, 0.95][shade % 4];
        fill(nameOf(group, i), left, right, top, bottom);
        canvas.globalAlpha = 1;
        if (canvas.measureText(label).width + 6 < right - left) write(label, left + 4, (top + bottom) / 2 + 4, shade % 2 ? '--paper' : '--ink');
      }
    });
    canvas.restore();
  }

  // Bands of histories stand below zero, each so high in the unit of the weights.
  const historyStep = 0.14;
  const visibleHistories = (panel) => (panel.histories ?? []).filter((band) => !hidden.has(band.group));
  const stayAt = (band, x) => band.stays.find(({from, to}) => x !== null && from <= x && x <= to)?.label;

  // What a chart's curves are called, and their numbers in a row: the legend of dygraphs.
  function legend(panel, row) {
    const all = new DocumentFragment(), chosen = finite(row);
    const say = (mark, text) => all.append(element('span', {}, mark, text));
    if (chosen) say(null, `${panel.x_label}: ${momentOf(panel, panel.x[row])}`);
    if (chosen && panel.remarks) say(null, panel.remarks[row]);
    panel.curves.forEach((curve, i) => {
      if (!hidden.has(curve.group)) say(swatch(colour(panel.coloured ? null : curve.group, i), dashOf(curve, i), curve.dots ? 'dots' : 'line'),
        ` ${curve.name}${chosen ? ` ${shown(curve.values[row])}` : ''}`);
    });
    for (const band of visibleHistories(panel))
      say(element('i', {className: 'history', style: `background: ${colour(band.group)}`}), ` ${band.name}${chosen ? ` ${stayAt(band, panel.x[row]) ?? '–'}` : ''}`);
    for (const {label} of panel.expected) say(element('i', {className: 'expected'}), ` ${label}`);
    return all;
  }

  // A line, after its band. They break at a row without a number or, where rows may be of other curves, if none has one for long; and where a turn is over.
  function drawCurve({joined, course}, event) {
    const {points, dygraph, setName, drawingContext: canvas, plotArea: area, strokeWidth, color} = event;
    const breaks = (last, next) => (joined ? next.xval - last.xval > joined : next.idx > last.idx + 1) || course && Math.abs(next.yval - last.yval) > 180;
    const trace = (shape, known) => {
      canvas.beginPath();
      shape.defined(finite).x((point) => point.canvasx).context(canvas)(points.filter(known).flatMap((point, i, all) => i && breaks(all[i - 1], point) ? [null, point] : [point]));
    };
    canvas.save();
    Object.assign(canvas, {fillStyle: color, strokeStyle: color, lineWidth: strokeWidth, lineCap: 'round', globalAlpha: 0.18});
    trace(d3.area().y0(({y_bottom}) => area.y + area.h * y_bottom).y1(({y_top}) => area.y + area.h * y_top), ({y_bottom, y_top}) => Number.isFinite(y_bottom + y_top));
    canvas.fill();
    canvas.globalAlpha = 1;
    canvas.setLineDash(dygraph.getOption('strokePattern', setName) ?? []);
    trace(d3.line().y((point) => point.canvasy), ({yval, canvasy}) => Number.isFinite(yval) && Number.isFinite(canvasy));
    if (strokeWidth) canvas.stroke(); else Dygraph.Plotters.linePlotter(event);
    canvas.restore();
  }

  // Of many points each is small and light, and a line thin, so that one sees where most are.
  const dense = (curve) => curve.values.filter(finite).length > 1000;
  const colours = (panel) => panel.curves.map((curve, i) => {
    const paint = d3.color(css(nameOf(panel.coloured ? null : curve.group, i)));
    if (curve.dots && dense(curve)) paint.opacity = 0.4;
    return String(paint);
  });

  function drawLines(panel, place) {
    const cell = ({values, lower, upper}, k) => finite(values[k]) ? [lower?.[k] ?? values[k], values[k], upper?.[k] ?? values[k]] : null;
    const box = element('div', {className: 'chart', role: 'img', ariaLabel: `${panel.title}, ${panel.y_label}; the table below has the numbers`});
    const values = element('div', {className: 'readout'});
    const histories = panel.histories ?? [], remarks = (k) => panel.remarks ? [panel.remarks[k]] : [];
    const table = folded('Table', () => grid([panel.x_label, ...panel.curves.map((curve) => curve.name), ...histories.map((band) => band.name),
      ...remarks(0).fill('')], panel.x.map((x, k) => [momentOf(panel, x), ...panel.curves.map((curve) => shown(curve.values[k])),
      ...histories.map((band) => stayAt(band, x) ?? '–'), ...remarks(k)])));
    const yLabel = element('div', {className: 'y-label', textContent: panel.y_label});
    place.append(figure(panel, yLabel, box, element('div', {className: 'x-label', textContent: panel.x_label}), values, table));
    const roll = (made) => {  // lines that go up and down in more rows than pixels would be a bar code: means of neighbours, until one zooms in
      const [from, to] = made.xAxisRange(), rows = panel.x.filter((x) => from <= x && x <= to).length;
      const period = Math.max(1, Math.round(1.5 * rows / made.getArea().w));
      yLabel.textContent = panel.y_label + (period > 1 ? `; means of ${period} rows, zoom in for each` : '');
      if (period !== made.rollPeriod()) made.adjustRoll(period);
    };

    const turns = panel.course ? {ticker: () => d3.range(0, 361, 45).map((v) => ({v, label: v % 90 ? '' : shown(v)}))} : {};
    const clock = finite(panel.clock) ? {pixelsPerLabel: 55, axisLabelFormatter: Dygraph.dateAxisLabelFormatter, ticker: (from, to, ...more) =>
      Dygraph.dateTicker(...[from, to].map((x) => 1000 * (panel.clock + x)), ...more).map(({v, label}) => ({v: v / 1000 - panel.clock, label}))} : {};
    const graph = new Dygraph(box, panel.x.map((x, k) => [x, ...panel.curves.map((curve) => cell(curve, k))]), {
      labels: ['x', ...panel.curves.map((_, i) => `c${i}`)],
      connectSeparatedPoints: panel.joined !== undefined, customBars: true, labelsUTC: true,
      logscale: panel.logarithmic === true, legend: 'always', labelsDiv: values, legendFormatter: ({i}) => legend(panel, i),
      colors: colours(panel), highlightCircleSize: 4, animatedZooms: false, pixelRatio: panel.x.length > 1000 ? null : Math.max(2, devicePixelRatio),  // for paper, where it costs little
      series: Object.fromEntries(panel.curves.map((curve, i) => [`c${i}`, {
        strokePattern: dashOf(curve, i).length ? dashOf(curve, i) : null, strokeWidth: curve.dots ? 0 : dense(curve) ? 1 : 1.8,
        drawPoints: curve.dots, pointSize: dense(curve) ? 1 : 2,
      }])),
      visibility: panel.curves.map((curve) => !hidden.has(curve.group)),
      includeZero: !panel.logarithmic, valueRange: rangeOf(panel),
      xRangePad: 4, yRangePad: 6, gridLineColor: rule, axisLineColor: rule, gridLineWidth: 0.5,
      axes: {x: {axisLabelFormatter: shown, pixelsPerLabel: 75, ...clock}, y: {...turns, axisLabelWidth: 52, axisLabelFormatter: (y) => histories.length && y < -1e-9 ? '' : shown(y)}},
      plotter: (event) => drawCurve(panel, event), rightGap: 10,
      underlayCallback: (canvas, area, made) => drawMarked(panel, canvas, area, made),
      zoomCallback: () => showReset(), ...(panel.coloured ? {drawCallback: roll} : {}),
      interactionModel: {...Dygraph.defaultInteractionModel, dblclick: () => showAll()},
    });
    const whole = box.closest('figure'), gone = () => panel.curves.length > 0 && panel.curves.every((curve) => hidden.has(curve.group));
    whole.hidden = gone();
    charts.push({graph, panel, look() {
      whole.hidden = gone();  // the chart of one filter is gone with it
      graph.updateOptions({colors: colours(panel), visibility: panel.curves.map((curve) => !hidden.has(curve.group))});
      if (!whole.hidden) graph.resize();
    }});
  }

  // ---- The map, by D3

  function drawPlan(panel, place) {
    const svg = d3.create('svg').attr('class', 'map').attr('role', 'img').attr('aria-label', panel.title);
    const groups = [...new Map(panel.traces.map((trace) => [trace.name, trace])).values()], crowded = groups.length > 12, clip = `clip${plans.length}`;
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
    whole.onclick = () => svg.call(zoom.transform, d3.zoomIdentity);

    function draw() {
      const {width, height} = svg.node().getBoundingClientRect();
      if (!width) return;
      if (width !== drawnWidth) [focused, drawnWidth] = [!panel.focus, width];
      const all = panel.traces.filter((trace) => !hidden.has(trace.group));
      const extent = (axis) => d3.extent((all.length ? all : panel.traces).flatMap((trace) => trace[axis]).filter(finite));
      const [[west, east], [south, north]] = ['x', 'y'].map(extent);
      if (west === undefined) return;
      const edge = {left: Math.max(56, 16 + 7.5 * d3.max([south, north], (y) => d3.format(',.0f')(y).length)), top: 10, right: 30, bottom: 24};
      const inner = {width: width - edge.left - edge.right, height: height - edge.top - edge.bottom};
      const metres = 1.06 * (Math.max((east - west) / inner.width, (north - south) / inner.height) || 0.01);
      const around = (from, to, pixels) => [-0.5, 0.5].map((part) => (from + to) / 2 + part * metres * pixels);
      const wholeX = d3.scaleLinear().range([edge.left, width - edge.right]).domain(around(west, east, inner.width));
      const wholeY = d3.scaleLinear().range([height - edge.bottom, edge.top]).domain(around(south, north, inner.height));
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
      svg.append('clipPath').attr('id', clip).append('rect').attr('x', edge.left).attr('y', edge.top)
        .attr('width', inner.width).attr('height', inner.height);
      svg.append('g').attr('transform', `translate(0,${height - edge.bottom})`).call(apart(d3.axisBottom(x), x, width));
      svg.append('g').attr('transform', `translate(${edge.left},0)`).call(d3.axisLeft(y).ticks(height / 60).tickSizeOuter(0));
      const body = svg.append('g').attr('clip-path', `url(#${clip})`);
      for (const ellipse of panel.ellipses.filter((one) => !hidden.has(one.group))) {
        const scale = Math.abs(x(1) - x(0)), paint = colour(ellipse.group);
        body.append('ellipse').attr('rx', ellipse.semi_major * scale).attr('ry', ellipse.semi_minor * scale).attr('fill', paint).attr('stroke', paint)
          .attr('fill-opacity', 0.15).attr('transform', `translate(${x(ellipse.x)},${y(ellipse.y)}) rotate(${-ellipse.angle_deg})`);
      }
      drawTraces(panel, body, (east, north) => [x(east), y(north)], crowded);
      if (!crowded) key.replaceChildren(...groups.filter((trace) => !hidden.has(trace.group)).map((trace) => element('span', {},
        swatch(colour(trace.group, panel.traces.indexOf(trace)), dashOf(trace, panel.traces.indexOf(trace)), trace.shape), ` ${trace.name}`)));
    }
    plans.push(draw);
    if (panel.traces.some((trace) => trace.z)) drawSpace(panel, place);
  }

  // Lines, dots and crosses where at(x, y, z) puts them.
  function drawTraces(panel, body, at, solid) {
    panel.traces.forEach((trace, i) => {
      if (hidden.has(trace.group)) return;
      const line = trace.shape === 'line', dots = trace.shape === 'dots', many = trace.x.length > 1000;
      const places = trace.x.map((x, k) => at(x ?? NaN, trace.y[k] ?? NaN, trace.z?.[k] ?? NaN).map((one) => Math.round(10 * one) / 10))
        .filter(([u, v]) => line || Number.isFinite(u + v));
      for (const look of line && views.has(trace.name) ? ['near', 'own'] : ['own'])  // a click near a line is one on it
        opening(body.append('path'), trace.name).attr('class', line ? look : 'points').attr('stroke', colour(trace.group, i)).attr('stroke-linecap', 'round')
          .attr('stroke-width', line ? null : dots ? (many ? 2 : 3.4) : 1.6).attr('opacity', line ? null : 0.8)
          .attr('stroke-dasharray', line && !solid ? dashOf(trace, i).join(' ') : null)
          .attr('d', line ? d3.line().defined(([u, v]) => Number.isFinite(u + v))(places) : places.map((place) => `M${place}${dots ? 'h.01' : 'm-4,-4l8,8m-8,0l8,-8'}`).join(''));
      const aside = places[0]?.[0] > body.node().closest('svg').clientWidth / 2 ? -8 : 8;
      if (neutral.has(trace.group) && places.length === 1) body.append('text').attr('x', places[0][0] + aside).attr('y', places[0][1] + 4)
        .attr('text-anchor', aside < 0 ? 'end' : 'start').text(trace.name);
    });
  }

  // The same in space, turned by dragging; heights are stretched. By hand: neither library draws in space.
  function drawSpace(panel, place) {
    const svg = d3.create('svg').attr('class', 'map').attr('role', 'img').attr('aria-label', `${panel.title} in space`);
    const names = [panel.x_label, panel.y_label, 'up'].map((label) => label.replace(', m', ''));
    const extents = ['x', 'y', 'z'].map((axis) => d3.extent(panel.traces.filter((trace) => trace.z).flatMap((trace) => trace[axis]).filter(finite)));
    const words = names.map((name, i) => `${name} ${extents[i].map(d3.format(',.3~r')).join(' to ')} m`).join(', ');
    place.append(figure({kind: 'plan', title: `${panel.title}, in space`, note: 'Drag to turn. Heights are stretched; below is the shadow.'},
      element('div', {className: 'y-label', textContent: words}), svg.node()));
    let yaw = -0.6, pitch = 0.5;
    const [xs, ys, zs] = extents, across = Math.max(xs[1] - xs[0], ys[1] - ys[0]) || 1, up = zs[1] - zs[0] || 1;
    const turned = ([x, y, z]) => {
      const [u, v, w] = [x / across, y / across, 0.45 * z / up];
      return [u * Math.cos(yaw) - v * Math.sin(yaw), -w * Math.cos(pitch) - (u * Math.sin(yaw) + v * Math.cos(yaw)) * Math.sin(pitch)];
    };

    function draw() {
      const {width, height} = svg.node().getBoundingClientRect();
      if (!width) return;
      const corners = d3.cross(xs, ys).flatMap((corner) => zs.map((z) => turned([...corner, z])));
      const [[left, right], [top, bottom]] = [0, 1].map((i) => d3.extent(corners, (corner) => corner[i]));
      const size = Math.min((width - 110) / (right - left || 1), (height - 70) / (bottom - top || 1));
      const at = (...place) => turned(place).map((one, i) => i ? height / 2 + size * (one - (top + bottom) / 2) : width / 2 + size * (one - (left + right) / 2));
      const path = (...places) => d3.line().defined(([u]) => Number.isFinite(u))(places.map((place) => at(...place)));
      svg.selectAll('*').remove();
      svg.append('path').attr('class', 'box').attr('d', path(...[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]].map(([i, j]) => [xs[i], ys[j], zs[0]]), [xs[0], ys[0], zs[1]]));
      for (const {x, y} of panel.traces.filter((trace) => trace.shape === 'line' && !hidden.has(trace.group)).slice(0, 1))
        svg.append('path').attr('class', 'shadow').attr('d', path(...x.map((east, k) => [east ?? NaN, y[k] ?? NaN, zs[0]])));
      drawTraces(panel, svg, at);
      extents.forEach(([from, to], axis) => {  // its name stands beyond the end of each axis
        const [px, py] = at(...extents.map(([first, last], i) => i !== axis ? first : last + 0.07 * (i === 2 ? up : across)));
        if (to > from) svg.append('text').attr('class', 'axis-name').attr('text-anchor', 'middle')
          .attr('x', Math.max(20, Math.min(px, width - 20))).attr('y', Math.max(14, Math.min(py, height - 8))).text(names[axis]);
      });
    }
    svg.call(d3.drag().on('drag', () => {
      [yaw, pitch] = [yaw + d3.event.dx / 150, Math.min(1.55, Math.max(0.02, pitch + d3.event.dy / 200))];
      draw();
    }));
    plans.push(draw);
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
      const height = panel.rows.length > 25 ? 16 : 26, narrowest = height > 20 ? 8 + d3.max(panel.shown.flat(), widthOf) : 12, longest = d3.max(panel.columns, widthOf);
      const wide = (space) => Math.max(narrowest, Math.min(90, space / panel.columns.length)), slant = longest > wide(room) - 1;
      const cell = {width: wide(slant ? room - 0.77 * longest : room), height};
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
      const left = 14 + d3.max(panel.rows, widthOf), right = width - 14;
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
        svg.append('text').text(name).attr('text-anchor', 'end')
          .attr('x', left - 6).attr('y', top + row / 2 + 4);
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
    const groups = [];  // each over its columns
    for (const {group} of panel.columns) {
      const last = groups[groups.length - 1];
      if (group && last?.textContent === group) ++last.colSpan; else groups.push(element('th', {textContent: group, scope: 'colgroup'}));
    }
    const head = groups.some((one) => one.textContent) ? [element('tr', {}, ...groups)] : [];
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
    const {title, text, folded} = panel, words = element('pre', {textContent: text});
    place.append(folded ? element('details', {className: 'words wide'}, element('summary', {textContent: title}), words) : figure(panel, words));
  }

  const draw = {lines: drawLines, plan: drawPlan, intervals: drawIntervals, heat: drawHeat, table: drawTable, words: drawWords};
  const drawAll = (panels, place) => {
    const before = plans.length;
    for (const panel of panels) draw[panel.kind](panel, place);
    plans.slice(before).forEach((again) => again());  // once each has its width
    charts.forEach(({graph}) => graph.resize());
  };

  // ---- The page

  const [first, place, last] = ['first', 'view', 'last'].map((id) => element('section', {className: 'panels', id}));
  const reset = element('button', {type: 'button', id: 'reset', textContent: 'Whole time', hidden: true, onclick: showAll});
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
    synchronized = d3.nest().key(({panel}) => panel.x_label).entries(charts).map(({values}) => values.map(({graph}) => graph)).filter((graphs) => graphs.length > 1)
      .map((graphs) => Dygraph.synchronize(graphs, {selection: true, zoom: true, range: false}));
  }

  function bar() {
    const made = element('div', {className: 'bar', role: 'toolbar', ariaLabel: 'What is shown'});
    if (data.views.length > 1) {
      const names = data.views.map((view, i) => element('option', {value: i, textContent: view.name}));
      made.append(element('label', {}, `${data.chooser} `, element('select', {id: 'view-selector', onchange: ({target}) => showView(Number(target.value))}, ...names)));
    }
    for (const {name} of data.groups) {
      const change = ({target}) => { hidden[target.checked ? 'delete' : 'add'](name); redraw(); };
      const box = element('input', {type: 'checkbox', checked: !hidden.has(name), onchange: change, 'data-group': name});
      made.append(element('label', {}, box, swatch(colour(name), dashOf({group: name}, 0)), name));
    }
    made.append(reset);
    return made;
  }

  const redraw = () => [...charts.map(({look}) => look), ...plans].forEach((again) => again());

  page.replaceChildren(element('h1', {textContent: data.title}));
  if (data.verdict.length) page.append(element('div', {className: 'verdict'}, ...data.verdict.map((text) => element('p', {textContent: text}))));
  const controls = data.groups.length || data.views.length > 1 ? bar() : '';
  page.append(first, controls, place, last, element('footer', {}, element('p', {}, 'Made by ', element('code', {textContent: data.command}),
    `, sigmax ${data.version}. Drawn with dygraphs (MIT licence) and D3 (BSD licence). Drag along a chart to zoom, double-click to see all; `
    + 'a map is dragged, and zoomed by double-click or Shift and the wheel.')));
  drawAll(data.panels, first);
  drawAll(data.last, last);
  const fixedPlans = plans.slice(), fixedCharts = charts.slice();
  if (data.views.length) showView(0); else synchronize();

  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
  // On paper charts are enlarged as they are: what a browser draws while it prints would be tens of thousands of shapes.
  const print = (begins) => {
    document.documentElement.classList.toggle('printing', begins);
    plans.forEach((again) => again());
    for (const {graph, graph: {graphDiv: {parentNode: box}}} of charts)
      box.style.zoom = begins ? Math.min(box.parentNode.clientWidth / graph.size().width, 240 / graph.size().height) : '';
  };
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  let waiting = 0;
  addEventListener('resize', () => { clearTimeout(waiting); waiting = setTimeout(() => plans.forEach((again) => again()), 100); });
  page.dataset.drawn = 'yes';
})();
