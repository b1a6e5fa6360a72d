// Makes interactive charts of the figures that carry their data. Without it the page shows their pictures.
"use strict";
const Chart = (() => {
  const DASHES = { solid: [], dashed: [9, 5], dotted: [1, 4], "dash-dot": [10, 4, 2, 4] };
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const ink = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const shade = colour => (dark.matches && DARK_COLOURS.get(colour)) || colour;
  const faint = (colour, opacity) => shade(colour) + Math.round(255 * opacity).toString(16).padStart(2, "0");

  const element = (tag, properties = {}, ...children) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  };

  // Four significant digits, as the tables of the page have three.
  const number = value => {
    if (value === 0) return "0";
    const size = Math.abs(value);
    const text = size < 1e-3 || size >= 1e5 ? value.toExponential(3) : String(Number(value.toPrecision(4)));
    return text.replace("-", "−").replace("e−", "e-").replace("e+", "e");
  };

  // Of a tick: powers of ten where it is very small or large.
  const tick = value => {
    const text = number(value);
    const [, factor, power] = /^(.*?)(?:\.0+)?e(-?\d+)$/.exec(text.replace(/(\.\d*?)0+e/, "$1e").replace(".e", "e")) || [];
    if (power === undefined) return text;
    const raised = [...power].map(digit => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit])).join("");
    return factor === "1" ? `10${raised}` : `${factor}·10${raised}`;
  };

  // Symbols of one letter have subscripts: A_nom.
  const typeset = text => {
    const parts = text.split(/(?<=(?:^|[^\p{L}\p{N}])\p{L})_([\p{L}\p{N}]+)/u);
    return parts.map((part, place) => (place % 2 ? element("sub", {}, part) : part));
  };

  // All places of a panel in growing order, and each series along them: undefined where it has none, null where its line breaks. A place
  // that a series has several times is there as often.
  const aligned = (panel, unitX, unitY, logX, logY) => {
    const shown = (value, unit, log) => (value === null || (log && value <= 0) ? null : value * unit.factor);
    const places = panel.places.map(list => list.map(value => shown(value, unitX, logX)));
    const times = new Map();
    const numbered = places.map(list => {
      const seen = new Map();
      return list.map(place => {
        const number = seen.get(place) || 0;
        seen.set(place, number + 1);
        if (place !== null) times.set(place, Math.max(times.get(place) || 0, number + 1));
        return number;
      });
    });
    const all = [];
    const first = new Map();
    for (const place of [...times.keys()].sort((a, b) => a - b)) {
      first.set(place, all.length);
      for (let k = 0; k < times.get(place); k++) all.push(place);
    }
    const columns = [];
    for (const series of panel.series) {
      for (const values of series.kind === "band" ? [series.y, series.top] : [series.y]) {
        const column = new Array(all.length).fill(undefined);
        places[series.x].forEach((place, k) => {
          if (place !== null) column[first.get(place) + numbered[series.x][k]] = shown(values[k], unitY, logY);
        });
        columns.push(column);
      }
    }
    return [all, ...columns];
  };

  // The range of an axis: its own, or that of its values, with zero where it is marked; a band may widen it by half as much.
  const range = (axis, unit, log, columns, bands) => {
    const fits = value => Number.isFinite(value) && (!log || value > 0);
    if (axis.range) {
      const ends = axis.range.map(value => value * unit.factor);
      if (ends.every(fits)) return ends;
    }
    const measure = log ? Math.log10 : value => value;
    const back = log ? value => 10 ** value : value => value;
    const of = lists => {
      const values = lists.flat().filter(fits).map(measure);
      return values.length ? [values.reduce((a, b) => Math.min(a, b)), values.reduce((a, b) => Math.max(a, b))] : null;
    };
    let [low, high] = of(columns) || of(bands) || [0, 1];
    if (axis.zero && !log) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
    const wide = of(bands);
    if (wide && high > low) {
      const room = 0.5 * (high - low);
      [low, high] = [Math.min(low, Math.max(wide[0], low - room)), Math.max(high, Math.min(wide[1], high + room))];
    }
    const room = high > low ? 0.03 * (high - low) : log ? 0.5 : Math.abs(low) / 2 || 1;
    return [back(low - room), back(high + room)];
  };

  // Ticks of a logarithmic axis: decades, or as much finer as gives three.
  const logTicks = (plot, axis, low, high) => {
    const up = (from, to) => Array.from({ length: to - from + 1 }, (_, k) => from + k);
    let ticks = [low, high];
    for (const digits of [[1], [1, 2, 5], [1, 2, 3, 5, 7], up(1, 9), up(10, 99).map(digit => digit / 10)]) {
      const decades = up(Math.floor(Math.log10(low)), Math.floor(Math.log10(high)));
      const all = decades.flatMap(decade => digits.map(digit => Number(`${digit}e${decade}`)));
      ticks = all.filter(tick => tick >= low && tick <= high);
      if (ticks.length > 2) break;
    }
    // Numbers along x need room.
    const most = plot.axes[axis].side % 2 ? 8 : Math.max(3, Math.floor(plot.bbox.width / devicePixelRatio / 48));
    const every = Math.ceil(ticks.length / Math.min(8, most));
    return ticks.filter((_, k) => k % every === 0);
  };

  // The markers of a curve, of a size in CSS pixels; a cross and a ring are not filled.
  const MARKERS = {
    circle: (path, x, y, r) => { path.moveTo(x + r, y); path.arc(x, y, r, 0, 2 * Math.PI); },
    ring: (path, x, y, r) => MARKERS.circle(path, x, y, 2 * r),
    square: (path, x, y, r) => path.rect(x - r, y - r, 2 * r, 2 * r),
    triangle: (path, x, y, r) => { path.moveTo(x, y - r); path.lineTo(x + r, y + r); path.lineTo(x - r, y + r); path.closePath(); },
    cross: (path, x, y, r) => { path.moveTo(x - r, y - r); path.lineTo(x + r, y + r); path.moveTo(x - r, y + r); path.lineTo(x + r, y - r); },
  };
  const isFilled = kind => kind !== "ring" && kind !== "cross";
  const markers = kind => (plot, series, from, to) => {
    const path = new Path2D();
    for (let at = from; at <= to; at++) {
      const value = plot.data[series][at];
      if (value === null || value === undefined) continue;
      MARKERS[kind](path, plot.valToPos(plot.data[0][at], "x", true), plot.valToPos(value, "y", true), 3 * devicePixelRatio);
    }
    return { stroke: path, fill: isFilled(kind) ? path : null, flags: 3 };
  };
  // The same as an element of the legend.
  const SAMPLES = {
    circle: '<circle cx="15" cy="6" r="4"/>',
    ring: '<circle cx="15" cy="6" r="5"/>',
    square: '<rect x="11" y="2" width="8" height="8"/>',
    triangle: '<path d="M15 1l5 10h-10z"/>',
    cross: '<path d="M11 2l8 8m-8 0l8-8"/>',
  };

  // Width of a plot beside the label of its axis.
  const room = holder => Math.max(220, holder.clientWidth - 22);

  class Chart {
    constructor(figure, data) {
      this.figure = figure;
      this.data = data;
      this.hidden = new Set();
      this.units = { x: 0, y: data.panels.map(() => 0) };
      this.log = { x: data.panels.map(panel => panel.x.log), y: data.panels.map(panel => panel.y.log) };
      this.plots = [];
      this.panels = element("div", { className: "panels" });
      this.said = element("span", { className: "said" });
      this.said.setAttribute("role", "status");
      this.names = this.legend();
      this.box = element("div", { className: "chart" }, this.panels, this.names, this.tools());
      // A figure without a picture has its chart above its caption.
      const picture = figure.querySelector(".picture");
      if (picture) picture.after(this.box);
      else figure.prepend(this.box);
      figure.classList.add("drawn");
      this.draw();
      new ResizeObserver(() => this.resize()).observe(this.panels);
      dark.addEventListener("change", () => this.draw());
    }

    // The same chart of other data; what was hidden, and units that are still there, stay as they were chosen.
    update(data) {
      const { panels } = data;
      const isAlike = panels.length === this.data.panels.length;
      const known = (unit, units) => (unit < units.length ? unit : 0);
      const form = ({ panels }) => JSON.stringify(panels.map(({ title, height, x, y, series }) => [title, height, x.units, y.units, x.log, y.log, series.map(({ name, kind, colour, dash, width, opacity }) => [name, kind, colour, dash, width, opacity])]));
      const isSame = form(data) === form(this.data);
      this.data = data;
      // Other values of the same curves, as a slider gives them.
      if (isSame) {
        for (const { plot, held, k, showWhole } of this.plots) {
          Object.assign(held, this.content(panels[k], k));
          plot.batch(() => { plot.setData(held.data, false); showWhole(); });
        }
        return;
      }
      this.units = { x: known(this.units.x, panels[0].x.units), y: panels.map((panel, k) => known(isAlike ? this.units.y[k] : 0, panel.y.units)) };
      if (!isAlike) this.log = { x: panels.map(panel => panel.x.log), y: panels.map(panel => panel.y.log) };
      const names = this.legend();
      this.names.replaceWith(names);
      this.names = names;
      this.draw();
    }

    tools() {
      const tools = element("div", { className: "tools" });
      const choice = (label, units, choose) => {
        if (units.length < 2) return;
        const select = element("select", {}, ...units.map((unit, k) => element("option", { value: k }, unit.label.replace("_nom", "ₙₒₘ"))));
        select.addEventListener("change", () => { choose(Number(select.value)); this.draw(); });
        tools.append(element("label", {}, label, select));
      };
      const { panels } = this.data;
      choice("x: ", panels[0].x.units, unit => { this.units.x = unit; });
      panels.forEach((panel, k) => {
        const name = panels.length > 1 && panel.y.units[0] ? `y${k + 1}: ` : "y: ";
        choice(name, panel.y.units, unit => { this.units.y[k] = unit; });
      });
      for (const axis of ["x", "y"]) {
        const box = element("input", { type: "checkbox", checked: this.log[axis][0] });
        box.addEventListener("change", () => { this.log[axis].fill(box.checked); this.draw(); });
        tools.append(element("label", {}, box, `log ${axis}`));
      }
      const button = (text, act) => {
        const made = element("button", { type: "button" }, text);
        made.addEventListener("click", act);
        tools.append(made);
      };
      button("Whole range", () => this.draw());
      button("Copy CSV", () => this.copy());
      if (this.figure.querySelector(".picture")) {
        button("Save SVG", () => this.save("svg"));
        button("Save PNG", () => this.save("png"));
      }
      tools.append(this.said);
      return tools;
    }

    // A button for each name, which shows and hides what bears it.
    legend() {
      const names = element("div", { className: "names" });
      names.setAttribute("role", "group");
      names.setAttribute("aria-label", "Curves");
      const seen = new Map();
      for (const series of this.data.panels.flatMap(panel => panel.series)) {
        const known = seen.get(series.name);
        // A line says more of how it is drawn than the band around it.
        if (series.name && (!known || (known.kind === "band" && series.kind !== "band"))) seen.set(series.name, series);
      }
      for (const [name, series] of seen) {
        const dash = DASHES[series.dash].join(" ");
        const sample = series.kind === "band"
          ? `<rect width="30" height="12" fill="${series.colour}" opacity="${series.opacity}"/>`
          : series.kind === "line"
            ? `<path d="M0 6H30" stroke="${series.colour}" stroke-width="2.5" stroke-dasharray="${dash}"/>`
            : `<g stroke="${series.colour}" stroke-width="1.5" fill="${isFilled(series.kind) ? series.colour : "none"}">${SAMPLES[series.kind]}</g>`;
        const button = element("button", { type: "button" });
        button.innerHTML = `<svg viewBox="0 0 30 12" aria-hidden="true">${sample}</svg>`;
        button.append(...typeset(name));
        button.setAttribute("aria-pressed", String(!this.hidden.has(name)));
        button.addEventListener("click", () => {
          const show = this.hidden.delete(name);
          if (!show) this.hidden.add(name);
          button.setAttribute("aria-pressed", String(show));
          for (const { plot, keys } of this.plots) {
            keys.forEach((key, k) => { if (key.name === name) plot.setSeries(k + 1, { show }); });
          }
        });
        names.append(button);
      }
      return names;
    }

    draw() {
      this.plots.forEach(({ plot }) => plot.destroy());
      this.panels.replaceChildren();
      const sync = uPlot.sync(this.figure.id);
      // All panels stand before the first is drawn, so that each has its width.
      const holders = this.data.panels.map(panel => {
        const holder = element("div", panel.height ? {} : { className: "blank" });
        if (panel.title) holder.append(element("h4", {}, ...typeset(panel.title)));
        this.panels.append(holder);
        return holder;
      });
      // An empty cell has no height.
      this.plots = this.data.panels.flatMap((panel, k) => (panel.height ? [this.panel(panel, k, holders[k], sync)] : []));
    }

    // What is drawn of a panel: its values as columns, what each column is, and the whole range of its axes.
    content(panel, k) {
      const unitX = panel.x.units[Math.min(this.units.x, panel.x.units.length - 1)];
      const unitY = panel.y.units[this.units.y[k]];
      const [logX, logY] = [this.log.x[k], this.log.y[k]];
      const data = aligned(panel, unitX, unitY, logX, logY);
      const keys = panel.series.flatMap(series => (series.kind === "band" ? [series, series] : [series]));
      const isBand = key => key.kind === "band" && key.opacity < 1;
      const columns = keys.flatMap((key, at) => (isBand(key) ? [] : [data[at + 1]]));
      const widening = keys.flatMap((key, at) => (isBand(key) ? [data[at + 1]] : []));
      const whole = {
        x: range(panel.x, unitX, logX, [data[0]], []),
        y: range(panel.y, unitY, logY, columns, widening),
      };
      return { panel, unitX, unitY, data, keys, whole };
    }

    panel(panel, k, holder, sync) {
      // Other values take the place of these.
      const held = this.content(panel, k);
      const { unitX, unitY, data, keys, whole } = held;
      const [logX, logY] = [this.log.x[k], this.log.y[k]];
      const bands = [];
      const series = keys.map((key, at) => {
        const show = !this.hidden.has(key.name);
        if (key.kind === "band") {
          if (keys[at + 1] === key) bands.push({ series: [at + 2, at + 1], fill: () => faint(key.colour, key.opacity) });
          return { show, stroke: "transparent", width: 0, points: { show: false } };
        }
        if (key.kind !== "line") {
          const colour = () => shade(key.colour);
          return { show, stroke: colour, paths: () => null, points: { show: true, size: 6, width: 1.5, fill: colour, stroke: colour, paths: markers(key.kind) } };
        }
        return { show, stroke: () => shade(key.colour), width: 2 * key.width, dash: DASHES[key.dash], points: { show: false } };
      });
      const axis = (log, across) => ({
        stroke: () => ink("ink"),
        font: "12px system-ui, sans-serif",
        grid: { stroke: () => ink("rule"), width: 1 },
        ticks: { stroke: () => ink("rule"), width: 1 },
        values: (plot, splits) => splits.map(value => (value === null ? "" : tick(value))),
        ...(log ? { splits: logTicks, filter: (plot, ticks) => ticks } : { space: across ? 55 : 30 }),
        size: across ? 30 : 56,
      });
      const values = element("div", { className: "values" });
      // A range that an axis cannot show, such as one that is not yet known, is the whole one.
      const scale = (log, axis) => ({
        time: false,
        distr: log ? 3 : 1,
        auto: false,
        range: (plot, low, high) => (Number.isFinite(low) && high > low && (!log || low > 0) ? [low, high] : held.whole[axis]),
      });
      const options = {
        width: room(holder),
        height: Math.round(Math.min(360, Math.max(215, panel.height))),
        scales: { x: { ...scale(logX, "x"), min: whole.x[0], max: whole.x[1] }, y: { ...scale(logY, "y"), min: whole.y[0], max: whole.y[1] } },
        series: [{}, ...series],
        bands,
        axes: [axis(logX, true), axis(logY, false)],
        legend: { show: false },
        cursor: {
          sync: { key: sync.key, setSeries: false },
          drag: { x: true, y: true, uni: 20 },
          points: { size: 7 },
          // The point of each curve that is nearest along x.
          dataIdx: (plot, at, hovered) => {
            const column = held.data[at];
            if (at === 0 || column[hovered] !== undefined) return hovered;
            for (let away = 1; away < column.length; away++) {
              for (const near of [hovered - away, hovered + away]) {
                if (column[near] !== undefined && column[near] !== null) return near;
              }
            }
            return hovered;
          },
        },
        hooks: {
          drawClear: [plot => this.regions(plot, held.panel, held.unitX, held.unitY)],
          draw: [plot => this.levels(plot, held.panel, held.unitX, held.unitY)],
          setCursor: [plot => this.read(plot, values, held.panel, held.keys, held.data)],
        },
      };
      // Labels are text of the page, since a canvas knows no subscripts.
      const place = element("div");
      holder.append(
        element("div", { className: "axes" }, element("div", { className: "along-y" }, ...typeset(unitY.label)), place),
        element("div", { className: "along-x" }, ...typeset(unitX.label)),
      );
      const plot = new uPlot(options, data, place);
      const showWhole = () => {
        for (const axis of ["x", "y"]) plot.setScale(axis, { min: held.whole[axis][0], max: held.whole[axis][1] });
      };
      showWhole();
      plot.over.append(values);
      plot.over.addEventListener("dblclick", showWhole);
      return { plot, keys, holder, held, k, showWhole };
    }

    // Shaded regions, below the curves.
    regions(plot, panel, unitX, unitY) {
      const { left, top, width, height } = plot.bbox;
      for (const mark of panel.marks.filter(mark => mark.from !== mark.to)) {
        const unit = mark.axis === "x" ? unitX : unitY;
        // Places grow to the right and down; what has no logarithm lies below all that has.
        const towardsHigh = mark.axis === "x" ? Infinity : -Infinity;
        const ends = [mark.from, mark.to].map((end, k) => {
          if (end === null) return k ? towardsHigh : -towardsHigh;
          const place = plot.valToPos(end * unit.factor, mark.axis, true);
          return Number.isFinite(place) ? place : -towardsHigh;
        });
        const [first, last] = mark.axis === "x" ? [left, left + width] : [top, top + height];
        const from = Math.max(first, Math.min(...ends));
        const to = Math.min(last, Math.max(...ends));
        if (!(to > from)) continue;
        plot.ctx.fillStyle = faint(mark.colour, mark.opacity);
        if (mark.axis === "x") plot.ctx.fillRect(from, top, to - from, height);
        else plot.ctx.fillRect(left, from, width, to - from);
        const [across, down] = mark.axis === "x" ? [to - from, height] : [width, to - from];
        this.label(plot, mark.label, (mark.axis === "x" ? from : left) + 6, (mark.axis === "x" ? top : from) + 4, across, down);
      }
    }

    // Levels across the plot, above the curves.
    levels(plot, panel, unitX, unitY) {
      const { ctx, bbox: { left, top, width, height } } = plot;
      for (const mark of panel.marks.filter(mark => mark.from === mark.to && mark.from !== null)) {
        const unit = mark.axis === "x" ? unitX : unitY;
        const place = plot.valToPos(mark.from * unit.factor, mark.axis, true);
        const inside = mark.axis === "x" ? place >= left && place <= left + width : place >= top && place <= top + height;
        if (!inside) continue;
        ctx.save();
        ctx.strokeStyle = shade(mark.colour);
        ctx.lineWidth = devicePixelRatio;
        ctx.setLineDash([5 * devicePixelRatio, 3 * devicePixelRatio]);
        ctx.beginPath();
        if (mark.axis === "x") { ctx.moveTo(place, top); ctx.lineTo(place, top + height); }
        else { ctx.moveTo(left, place); ctx.lineTo(left + width, place); }
        ctx.stroke();
        ctx.restore();
        this.label(plot, mark.label, mark.axis === "x" ? place + 4 : left + 6, mark.axis === "x" ? top + 6 : place + 3, width, height);
      }
    }

    // A name where there is room for it, across and down.
    label({ ctx }, text, x, y, across, down) {
      const size = 11 * devicePixelRatio;
      ctx.save();
      ctx.font = `${size}px system-ui, sans-serif`;
      ctx.fillStyle = ink("dim");
      ctx.textAlign = "left";
      ctx.textBaseline = "top";
      if (text && ctx.measureText(text).width + size < across && 1.5 * size < down) ctx.fillText(text, x, y);
      ctx.restore();
    }

    // The values under the cursor.
    read(plot, values, panel, keys, data) {
      const { left, top, idx, idxs } = plot.cursor;
      if (left === undefined || left < 0 || idx === null || idx === undefined) {
        values.style.display = "none";
        return;
      }
      const lines = [];
      let place = null;
      keys.forEach((key, k) => {
        const at = idxs[k + 1];
        const value = at === null || at === undefined ? undefined : data[k + 1][at];
        if (!plot.series[k + 1].show || value === undefined || value === null) return;
        place = place === null ? data[0][at] : place;
        if (key.kind === "band" && keys[k + 1] === key) return;
        const isHere = (other, j) => data[0][j] === data[0][at] && other !== undefined && other !== null;
        const text = key.kind === "band" ? `${number(data[k][at])} to ${number(value)}` : data[k + 1].filter(isHere).map(number).join(", ");
        const row = element("div", {}, ...typeset(key.name ? `${key.name}: ` : ""), text);
        row.style.borderLeft = `4px solid ${shade(key.colour)}`;
        row.style.paddingLeft = "4px";
        lines.push(row);
      });
      if (!lines.length) {
        values.style.display = "none";
        return;
      }
      values.replaceChildren(element("div", {}, `at ${number(place)}`), ...lines.slice(0, 14));
      values.style.display = "block";
      const width = values.offsetWidth;
      const room = plot.over.clientWidth;
      values.style.left = `${left + 14 + width > room ? Math.max(0, left - width - 14) : left + 14}px`;
      values.style.top = `${Math.max(0, Math.min(top + 10, plot.over.clientHeight - values.offsetHeight))}px`;
    }

    resize() {
      for (const { plot, holder } of this.plots) {
        const width = room(holder);
        if (width !== plot.width) plot.setSize({ width, height: plot.height });
      }
    }

    // One row for each point of each curve, in the units shown.
    csv() {
      const quoted = text => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
      const rows = [["panel", "curve", "x quantity", "x", "y quantity", "y", "y upper"]];
      this.data.panels.forEach((panel, k) => {
        const unitX = panel.x.units[Math.min(this.units.x, panel.x.units.length - 1)];
        const unitY = panel.y.units[this.units.y[k]];
        const shown = (value, unit) => (value === null || value === undefined ? "" : Number((value * unit.factor).toPrecision(7)));
        for (const series of panel.series.filter(one => !this.hidden.has(one.name))) {
          series.y.forEach((value, at) => {
            const x = panel.places[series.x][at];
            rows.push([panel.title || panel.y.units[0].label, series.name, unitX.label, shown(x, unitX), unitY.label, shown(value, unitY), shown(series.top && series.top[at], unitY)]);
          });
        }
      });
      return rows.map(row => row.map(cell => quoted(String(cell))).join(",")).join("\n") + "\n";
    }

    async copy() {
      const text = this.csv();
      try {
        await navigator.clipboard.writeText(text);
      } catch {
        const area = element("textarea", { value: text });
        document.body.append(area);
        area.select();
        document.execCommand("copy");
        area.remove();
      }
      this.say("copied");
    }

    // The figure as it stands in print: as large as its picture.
    save(kind) {
      const picture = this.figure.querySelector(".picture > svg");
      const text = new XMLSerializer().serializeToString(picture);
      const blob = new Blob([text], { type: "image/svg+xml" });
      const download = (content, name) => {
        const link = element("a", { href: URL.createObjectURL(content), download: name });
        link.click();
        URL.revokeObjectURL(link.href);
        this.say("saved");
      };
      if (kind === "svg") {
        download(blob, `${this.figure.id}.svg`);
        return;
      }
      const image = new Image();
      const address = URL.createObjectURL(blob);
      image.onload = () => {
        const [, , width, height] = picture.getAttribute("viewBox").split(" ").map(Number);
        const canvas = element("canvas", { width, height });
        canvas.getContext("2d").drawImage(image, 0, 0, width, height);
        URL.revokeObjectURL(address);
        canvas.toBlob(content => download(content, `${this.figure.id}.png`), "image/png");
      };
      image.src = address;
    }

    say(text) {
      this.said.textContent = text;
      setTimeout(() => { this.said.textContent = ""; }, 2000);
    }
  }

  // A map whose patches change with something: a slider puts others into its picture.
  const slider = (figure, { label, names, shown, circles, images }) => {
    const patches = figure.querySelector(".patches");
    const input = element("input", { type: "range", min: 0, max: names.length - 1, value: shown });
    const said = element("output", {}, names[shown]);
    const show = () => {
      const at = Number(input.value);
      if (images) patches.firstElementChild.setAttribute("href", images[at]);
      else patches.innerHTML = circles[1][at].map((r, k) => `<circle cx="${circles[0][k][0]}" cy="${circles[0][k][1]}" r="${r}"/>`).join("");
      for (const text of [figure.querySelector(".frame-name text"), said]) text.textContent = names[at];
      input.setAttribute("aria-valuetext", names[at]);
    };
    input.setAttribute("aria-valuetext", names[shown]);
    input.addEventListener("input", show);
    figure.querySelector(".picture").after(element("label", { className: "slider" }, `${label}: `, input, said));
  };

  // A chart is made when its figure comes near the screen.
  const watcher = new IntersectionObserver(entries => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      watcher.unobserve(target);
      const data = JSON.parse(target.querySelector("script[type='application/json']").textContent);
      if (!data.frames) new Chart(target, data);
      else if (data.frames.names.length > 1) slider(target, data.frames);
    }
  }, { rootMargin: "600px" });
  const watch = root => {
    for (const data of root.querySelectorAll("figure > script[type='application/json']")) watcher.observe(data.parentElement);
  };
  watch(document);

  // A link into folded details opens them.
  const open = () => {
    const target = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
    for (let place = target; place; place = place.parentElement) if (place.tagName === "DETAILS") place.open = true;
    if (target) target.scrollIntoView();
  };
  addEventListener("hashchange", open);
  open();
  return Object.assign(Chart, { slider, watch });
})();
