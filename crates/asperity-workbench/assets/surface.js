// A surface: its height map with a profile along a line, its histogram, its checks with their remedies, its properties.

import { html, useState, useEffect, useLayoutEffect, useMemo, useRef } from "./preact.js";
import { bytes, events } from "./server.js";
import { change, setValue, withValue } from "./state.js";
import { length, parsed } from "./quantity.js";
import { LABELS, Words } from "./controls.js";

const MOST_POINTS = 1024;

// viridis (CC0), at equal steps.
const COLOURS = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
const colour = share => {
  const place = Math.min(0.99999, Math.max(0, share)) * (COLOURS.length - 1);
  const low = Math.floor(place);
  return COLOURS[low].map((part, k) => part + (place - low) * (COLOURS[low + 1][k] - part));
};

// What the server sends of a map.
export const read = buffer => {
  const view = new DataView(buffer);
  const [nx, ny, every] = [0, 4, 8].map(at => view.getUint32(at, true));
  const pixel = [16, 24].map(at => view.getFloat64(at, true));
  const heights = new Float32Array(buffer, 32);
  const sorted = Float32Array.from(heights.filter(height => !Number.isNaN(height))).sort();
  const quantile = share => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? 0;
  return { nx, ny, every, pixel, heights, range: [quantile(0.0025), quantile(0.9975)], ends: [sorted[0] ?? 0, sorted.at(-1) ?? 0], count: sorted.length };
};

export const draw = (canvas, { nx, ny, heights, range: [low, high] }) => {
  canvas.width = nx;
  canvas.height = ny;
  const context = canvas.getContext("2d");
  const image = context.createImageData(nx, ny);
  for (let ix = 0; ix < nx; ix++) {
    for (let iy = 0; iy < ny; iy++) {
      const height = heights[ix * ny + iy];
      const at = 4 * ((ny - 1 - iy) * nx + ix);
      if (Number.isNaN(height)) continue;
      const [r, g, b] = colour((height - low) / (high - low || 1));
      image.data[at] = r;
      image.data[at + 1] = g;
      image.data[at + 2] = b;
      image.data[at + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
};

const axis = (label, factor, more = {}) => ({ log: false, units: [{ label, factor }], ...more });
const panel = (x, y, places, series) => ({ panels: [{ title: "", height: 215, x, y, places: [places], series, marks: [] }] });
const line = (name, y) => ({ name, kind: "line", colour: "#0072b2", dash: "solid", width: 1, opacity: 1, x: 0, y });

// A chart of data that change.
export const ChartOf = ({ data, caption, id }) => {
  const figure = useRef(null);
  const chart = useRef(null);
  useLayoutEffect(() => {
    if (!chart.current) chart.current = new Chart(figure.current, data);
    else chart.current.update(data);
  }, [data]);
  return html`<figure id=${id} ref=${figure} class=${data.panels.length > 1 ? "wide" : ""}><figcaption dangerouslySetInnerHTML=${{ __html: caption }}></figcaption></figure>`;
};

// Heights along a line between two shares of the map, at points of the map.
const profileOf = ({ nx, ny, pixel, heights }, [[x0, y0], [x1, y1]]) => {
  const count = Math.max(2, Math.ceil(Math.hypot((x1 - x0) * nx, (y1 - y0) * ny)));
  const places = [];
  const values = [];
  const far = Math.hypot((x1 - x0) * nx * pixel[0], (y1 - y0) * ny * pixel[1]);
  for (let k = 0; k <= count; k++) {
    const share = k / count;
    const ix = Math.min(nx - 1, Math.floor((x0 + share * (x1 - x0)) * nx));
    const iy = Math.min(ny - 1, Math.floor((y0 + share * (y1 - y0)) * ny));
    const height = heights[ix * ny + iy];
    places.push(share * far);
    values.push(Number.isNaN(height) ? null : height);
  }
  return panel(axis("distance (µm)", 1e6), axis("height (µm)", 1e6), places, [line("profile", values)]);
};

const histogramOf = ({ heights, ends: [low, high], count }) => {
  const BINS = 80;
  const counts = new Array(BINS).fill(0);
  for (const height of heights) {
    if (!Number.isNaN(height)) counts[Math.min(BINS - 1, Math.floor((BINS * (height - low)) / (high - low || 1)))]++;
  }
  const places = counts.map((_, k) => low + ((k + 0.5) * (high - low)) / BINS);
  return panel(axis("height (µm)", 1e6), axis("share of the points (%)", 100, { zero: true }), places, [line("heights", counts.map(one => one / count))]);
};

const Scale = ({ range: [low, high] }) => {
  const steps = Array.from({ length: 24 }, (_, k) => colour(k / 23).map(Math.round).join(" "));
  return html`<div class="scale" aria-hidden="true"><span>${length(low)}</span><span class="bar" style=${{ background: `linear-gradient(to right, ${steps.map(rgb => `rgb(${rgb})`).join(", ")})` }}></span><span>${length(high)}</span></div>`;
};

// With `cut` the pointer draws a rectangle instead of the line of the profile.
export const MapPicture = ({ map, name, spikes = [], profile, setProfile, cut }) => {
  const canvas = useRef(null);
  const [from, setFrom] = useState(null);
  const [to, setTo] = useState(null);
  useEffect(() => draw(canvas.current, map), [map]);
  const sides = [map.nx * map.pixel[0], map.ny * map.pixel[1]];
  const place = event => {
    const box = canvas.current.getBoundingClientRect();
    const inside = share => Math.min(1, Math.max(0, share));
    return [inside((event.clientX - box.left) / box.width), inside(1 - (event.clientY - box.top) / box.height)];
  };
  const move = event => {
    const by = { ArrowUp: [0, 0.02], ArrowDown: [0, -0.02], ArrowLeft: [-0.02, 0], ArrowRight: [0.02, 0] }[event.key];
    if (event.key === "r") return setProfile(profile[0][0] === profile[1][0] ? [[0, 0.5], [1, 0.5]] : [[0.5, 0], [0.5, 1]]);
    if (!by) return undefined;
    event.preventDefault();
    const moved = profile.map(end => end.map((share, k) => share + by[k]));
    return moved.flat().every(share => share >= -1e-9 && share <= 1 + 1e-9) || profile[0][0] === profile[1][0] || profile[0][1] === profile[1][1]
      ? setProfile(moved.map(end => end.map(share => Math.min(1, Math.max(0, share)))))
      : undefined;
  };
  const [[x0, y0], [x1, y1]] = profile ?? [[0, 0], [0, 0]];
  return html`<div class="map">
    <div class="heights" style=${{ aspectRatio: `${sides[0]} / ${sides[1]}` }}>
      <canvas ref=${canvas} tabindex=${setProfile ? 0 : undefined} role="img"
        aria-label=${`Height map of ${name}, ${length(sides[0])} x ${length(sides[1])}, heights from ${length(map.range[0])} to ${length(map.range[1])}.${setProfile ? " Arrow keys move the line of the profile, r turns it." : ""}`}
        onPointerDown=${setProfile && (event => { canvas.current.setPointerCapture(event.pointerId); setFrom(place(event)); setTo(null); })}
        onPointerMove=${setProfile && (event => from && (cut ? setTo(place(event)) : setProfile([from, place(event)])))}
        onPointerUp=${setProfile && (event => { setFrom(null); setTo(null); if (cut && to) cut([from, place(event)]); })} onKeyDown=${setProfile && move}></canvas>
      <svg viewBox="0 0 1 1" preserveAspectRatio="none" aria-hidden="true">
        ${profile && html`<line x1=${x0} y1=${1 - y0} x2=${x1} y2=${1 - y1} vector-effect="non-scaling-stroke" />`}
        ${from && to && html`<rect x=${Math.min(from[0], to[0])} y=${1 - Math.max(from[1], to[1])} width=${Math.abs(to[0] - from[0])} height=${Math.abs(to[1] - from[1])} vector-effect="non-scaling-stroke" />`}
        ${spikes.slice(0, 200).map(([x, y]) => html`<ellipse cx=${x / sides[0]} cy=${1 - y / sides[1]} rx="0.015" ry=${(0.015 * sides[0]) / sides[1]} vector-effect="non-scaling-stroke" />`)}
      </svg>
    </div>
    <p class="size">${length(sides[0])} × ${length(sides[1])}, ${map.every > 1 ? `every ${map.every}th point` : `${map.nx} × ${map.ny} points`}</p>
    <${Scale} range=${map.range} />
  </div>`;
};

// A surface and its heights for a spec.
export const fetchSurface = async (request, signal, progress) => {
  let view = null;
  await events("/api/surface", request, signal, (name, value) => {
    if (name === "surface") view = value;
    else if (name === "progress") progress?.(value);
  });
  const map = view.map ? read(await bytes("/api/heights", { ...request, most: MOST_POINTS }, signal)) : null;
  return { view, map };
};

// The keys of a remedy beside those that are there.
const remedied = (spec, surface, keys) =>
  Object.entries(keys).reduce((next, [key, value]) => {
    const path = ["surface", surface, "file", key];
    const before = spec.surface[surface].file[key];
    const merged = typeof value === "object" && typeof before === "object" ? { ...before, ...value } : value;
    return withValue(next, path, merged);
  }, spec);

const FIT = { fit: "auto" };

const Fitness = ({ rows, others, attempt, isFitting }) => {
  const other = check => others?.find(row => row.check === check);
  const number = value => Number(value.toPrecision(3));
  return html`<div class="table" role="region" aria-label="Checks of the map" tabindex="0"><table>
    <thead><tr><th>Check</th><th>What is measured</th><th>Value</th>${others && html`<th>After</th>`}<th>Allowed</th><th>${others ? "Before" : "Result"}</th><th>Remedy</th></tr></thead>
    <tbody>${rows.map(row => html`<tr>
      <td>${row.check}</td><td>${row.measured}</td><td>${number(row.value)}</td>
      ${others && html`<td>${other(row.check) ? `${number(other(row.check).value)} (${other(row.check).result})` : ""}</td>`}
      <td>${row.allowed}</td><td class=${{ passed: "within", failed: "beyond" }[row.result] ?? "open"}>${row.result}</td>
      <td>${row.keys && attempt ? html`<button type="button" onClick=${() => attempt(row.keys, row.setting)}>Try <code>${row.setting.replaceAll("`", "")}</code></button>` : html`<${Words} text=${row.remedy} />`}</td></tr>`)}
    </tbody></table>
    ${attempt && !isFitting && rows.some(row => row.result === "failed") && html`<p><button type="button" onClick=${() => attempt(FIT, "fit = \"auto\"")}>Find the preparation for me</button></p>`}
  </div>`;
};

// Of one surface of the spec. It waits until `ready`, so that the surface that the contact has made is there.
export const Surface = ({ name, spec, folder, ready, inputs, onView, fail, isCancelled }) => {
  const key = JSON.stringify([spec.surface[name], folder, spec.seed, inputs]);
  const [shown, setShown] = useState(null);
  const [attempt, setAttempt] = useState(null);
  const [profile, setProfile] = useState([[0, 0.5], [1, 0.5]]);
  const [status, setStatus] = useState("");
  const [failure, setFailure] = useState(null);
  const [isCutting, setCutting] = useState(false);
  useEffect(() => {
    setFailure(null);
    if (!ready || shown?.key === key) return undefined;
    const abort = new AbortController();
    fetchSurface({ spec, folder, surface: name }, abort.signal, ({ stage }) => setStatus(stage)).then(
      found => { setShown({ ...found, key }); setStatus(""); onView(name, found.view.map); },
      error => {
        setStatus("");
        if (error.name !== "AbortError" && error.message !== "cancelled") setFailure(error);
      },
    );
    return () => abort.abort();
  }, [key, ready]);
  const tryRemedy = (keys, words) => {
    const next = remedied(spec, name, keys);
    setAttempt({ words, next });
    fetchSurface({ spec: next, folder, surface: name }).then(found => setAttempt({ words, next, ...found }), error => { setAttempt(null); fail(error); });
  };
  // A preparation that was found is written as the keys that do the same.
  const kept = () => {
    const found = attempt.view.found && remedied(spec, name, attempt.view.found);
    change({ spec: found ?? attempt.next });
    setAttempt(null);
  };
  const histogram = useMemo(() => shown?.map && histogramOf(shown.map), [shown?.map]);
  const line = useMemo(() => shown?.map && profileOf(shown.map, profile), [shown?.map, profile]);
  // What is wrong with a key the contact has said already, at its control.
  const failed = failure && html`<p class="error" role=${failure.key ? undefined : "alert"}><${Words} text=${failure.message} /></p>`;
  const waiting = isCancelled ? "Cancelled." : `${status || "Waiting for the surface"} …`;
  if (!shown) return html`<section class="surface"><h2>Surface ${name}</h2>${failed || html`<p role="status">${waiting}</p>`}</section>`;
  const { view, map } = shown;
  const isFile = Boolean(spec.surface[name]?.file);
  const cropPath = ["surface", name, "file", "crop"];
  const crop = spec.surface[name]?.file?.crop;
  // A rectangle on the picture of a part lies in that part; an end at its border is its end.
  const cut = corners => {
    setCutting(false);
    const ends = [0, 1].map(axis => {
      const [before, pixel] = [crop?.["xy"[axis]], view.map.pixel_m[axis]];
      const [first, side] = [parsed(before?.[0], "length") ?? 0, view.map.points[axis] * pixel];
      const [low, high] = corners.map(corner => corner[axis] * map.pixel[axis] * (axis ? map.ny : map.nx)).sort((a, b) => a - b);
      const [isFirst, isLast] = [low, side - high].map(gap => gap < Math.max(pixel, side / 100));
      if (isFirst && isLast) return before;
      const written = metres => `${Number((1e6 * metres).toPrecision(4))} um`;
      return [isFirst ? before?.[0] ?? "0 um" : written(first + low), isLast ? before?.[1] ?? `${1e6 * side} um` : written(first + high)];
    });
    const [x, y] = ends;
    setValue(cropPath, x || y ? { ...(x && { x }), ...(y && { y }) } : undefined);
  };
  return html`<section class=${`surface${shown.key === key ? "" : " outdated"}`}>
    <h2>Surface ${name}</h2>
    ${failed}
    <p>${view.asperities.toLocaleString("en")} asperities${status && html`, <span role="status">${status} …</span>`}</p>
    ${map && html`<div class="beside">
      <div><${MapPicture} map=${map} name=${name} spikes=${view.map.spikes_m} profile=${profile} setProfile=${setProfile} cut=${isCutting && cut} />
        ${isFile && html`<p class="buttons"><button type="button" aria-pressed=${isCutting} onClick=${() => setCutting(!isCutting)}>Crop by a rectangle</button>
          ${crop && html`<button type="button" onClick=${() => setValue(cropPath, undefined)}>Whole map</button>`}
          ${isCutting && html`<span role="status">Draw it on the map; the fields “${LABELS["crop.x"]}” and “${LABELS["crop.y"]}” do the same.</span>`}</p>`}</div>
      <div><${ChartOf} id=${`${name}-profile`} data=${line} caption="Profile along the line; draw another on the map." />
      <${ChartOf} id=${`${name}-histogram`} data=${histogram} caption="Heights of the map." /></div>
    </div>`}
    ${view.fitness.length > 0 && html`<h3 id=${`checks-${name}`}>May this map carry a verdict? ${view.map.is_blocked ? "Not yet." : "Yes."}</h3>
      <${Fitness} rows=${view.fitness} others=${attempt?.view?.fitness} attempt=${isFile && !attempt && tryRemedy} isFitting=${spec.surface[name]?.file?.fit === "auto"} />`}
    ${attempt && html`<section class="attempt" aria-label="A remedy">
      <h3>After <code>${attempt.words.replaceAll("`", "")}</code></h3>
      ${attempt.view
        ? html`${attempt.map && html`<div class="beside"><div><h4>Before</h4><${MapPicture} map=${map} name=${`${name} before`} spikes=${view.map.spikes_m} /></div><div><h4>After</h4><${MapPicture} map=${attempt.map} name=${`${name} after`} spikes=${attempt.view.map.spikes_m} /></div></div>`}
          <p>${attempt.view.map?.is_blocked ? "The map still fails a check." : "The map passes."} ${attempt.view.asperities.toLocaleString("en")} asperities.</p>
          <button type="button" class="main" onClick=${kept}>Apply</button> <button type="button" onClick=${() => setAttempt(null)}>Discard</button>`
        : html`<p role="status">Preparing the map …</p>`}
    </section>`}
    ${view.warnings.length > 0 && html`<details><summary>${view.warnings.length === 1 ? "1 warning" : `${view.warnings.length} warnings`} about the surface</summary><ul>${view.warnings.map(warning => html`<li><${Words} text=${warning} /></li>`)}</ul></details>`}
    <details><summary>Asperities, properties and spectrum</summary><${Html} html=${view.page.sections} /></details>
  </section>`;
};

// HTML of a report, with its charts.
export const Html = ({ html: content }) => {
  const place = useRef(null);
  useEffect(() => {
    place.current.innerHTML = content;
    Chart.watch(place.current);
  }, [content]);
  return html`<div class="of-report" ref=${place}></div>`;
};
