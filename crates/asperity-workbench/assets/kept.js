// Kept states, laid over each other: up to eight.

import { html, useState, useEffect, useMemo, useRef } from "./preact.js";
import { events } from "./server.js";
import { change, state } from "./state.js";
import { coatedFirst } from "./results.js";
import { ChartOf } from "./surface.js";

export const MOST_KEPT = 8;
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f", "#000000"];
const QUANTITIES = {
  area_ratio: { label: "A/A_nom", isLog: true },
  separation_over_sigma: { label: "separation (σ)", isLog: false },
  mean_real_pressure_pa: { label: "mean pressure in the contacts (Pa)", isLog: true },
  contact_density_per_m2: { label: "contacts (1/m²)", isLog: true },
};

const chartOf = (all, quantity) => {
  const { label, isLog } = QUANTITIES[quantity];
  const places = [];
  const series = [];
  all.forEach(({ name, cases }, k) => {
    (cases ?? []).forEach(({ name: ofCase, curves }) => {
      for (const [model, dash] of [["deterministic", "solid"], ["statistical", "dashed"]]) {
        const curve = curves[model];
        if (!curve.pressure_pa.length) continue;
        places.push(curve.pressure_pa);
        const what = cases.length > 1 ? `${name}, ${ofCase}` : name;
        series.push({ name: `${what} (${model === "deterministic" ? "sum" : "integral"})`, kind: "line", colour: COLOURS[k], dash, width: 1, opacity: 1, x: places.length - 1, y: curve[quantity] });
      }
    });
  });
  return { panels: [{ title: "", height: 320, x: { log: true, units: [{ label: "p (MPa)", factor: 1e-6 }] }, y: { log: isLog, units: [{ label, factor: 1 }] }, places, series, marks: [] }] };
};

export const Kept = ({ kept, fail }) => {
  const [found, setFound] = useState({});
  const complete = useRef(new Set());
  const [quantity, setQuantity] = useState("area_ratio");
  useEffect(() => {
    const abort = new AbortController();
    const load = async () => {
      for (const { spec, folder } of kept) {
        const key = JSON.stringify([spec, folder]);
        if (complete.current.has(key)) continue;
        await events("/api/analyse", { spec, folder, last: "intervals" }, abort.signal, (name, value) => {
          // Of a thickness and none it is that which was asked for.
          if (name === "results") setFound(before => ({ ...before, [key]: coatedFirst(value.results.cases).slice(0, value.results.cases.length === 2 ? 1 : undefined) }));
        });
        complete.current.add(key);
      }
    };
    load().catch(error => error.name !== "AbortError" && fail(error));
    return () => abort.abort();
  }, [kept]);
  const all = kept.map(one => ({ ...one, cases: found[JSON.stringify([one.spec, one.folder])] }));
  const data = useMemo(() => chartOf(all, quantity), [kept, found, quantity]);
  const line = (one, key) => one.cases?.map(({ pieces }) => pieces.card.find(card => card.key === key)?.html).filter(text => text).join("");
  const remove = place => change({ kept: kept.filter((_, k) => k !== place) });
  const restore = ({ spec, folder }) => change({ spec, folder, saved: null, waits: [] });
  return html`<section class="kept" aria-label="Kept states">
    <h2>Compared</h2>
    <label>Quantity <select value=${quantity} onChange=${event => setQuantity(event.target.value)}>${Object.entries(QUANTITIES).map(([key, { label }]) => html`<option value=${key}>${label.replace("_nom", "ₙₒₘ")}</option>`)}</select></label>
    ${data.panels[0].series.length > 0 && html`<${ChartOf} id="kept" data=${data} caption="Kept states: sums as solid lines, integrals dashed." />`}
    <div class="table" role="region" aria-label="Kept states" tabindex="0"><table><thead><tr><th>State</th><th>Result</th><th>May the integral replace the sum?</th><th></th></tr></thead>
      <tbody>${all.map((one, place) => html`<tr><td><span class="sample" style=${{ background: COLOURS[place] }}></span>${one.name}</td>
        <td dangerouslySetInnerHTML=${{ __html: line(one, "result") ?? "…" }}></td><td dangerouslySetInnerHTML=${{  __html: line(one, "answer") ?? "" }}></td>
        <td><button type="button" onClick=${() => restore(one)}>Restore</button> <button type="button" onClick=${() => remove(place)} aria-label=${`Remove ${one.name}`}>Remove</button></td></tr>`)}</tbody></table></div>
  </section>`;
};

// What a state differs from the kept ones in, as its name.
export const nameOf = spec => {
  const { compare } = spec;
  const layer = compare.layer ? `${[compare.layer.thickness].flat().join(", ")} of ${compare.layer.material} on the ${compare.layer.on ?? "flat"}` : "bare";
  const filter = Object.values(spec.surface ?? {}).map(({ file }) => (file?.filter ? Object.entries(file.filter).map(([key, index]) => `${key.toUpperCase()} ${index}`).join(" ") : "")).filter(text => text);
  return [Object.keys(spec.surface ?? {}).join(" + "), `${compare.rough} on ${compare.flat}`, layer, ...filter, compare.force ?? ""].filter(text => text && typeof text === "string").join(", ");
};

export const keep = () => {
  const { spec, folder, kept } = state();
  const base = nameOf(spec);
  const count = kept.filter(({ name }) => name === base || name.startsWith(`${base} (`)).length;
  change({ kept: [...kept, { name: count ? `${base} (${count + 1})` : base, spec, folder }] });
};
