// The controls: each is one key of the spec, with its explanation and the error that the program finds in it.

import { html, useState, useEffect, useRef } from "./preact.js";
import { at, setValue, change, withValue } from "./state.js";
import { parsed, written } from "./quantity.js";

// What each control is called on the page, by its key: of a surface without `surface.NAME.KIND.`, of a material without its name.
export const LABELS = {
  path: "File",
  pixel: "Pixel size",
  unit: "Unit",
  "unit.xy": "Unit of x and y",
  "unit.z": "Unit of the heights",
  "crop.x": "Part along x",
  "crop.y": "Part along y",
  level: "Form removed",
  "filter.s": "S filter",
  "filter.l": "L filter",
  outliers: "Spikes",
  fit: "Find the preparation",
  "align-lines": "Align lines",
  tip: "Tip radius",
  missing: "Missing points",
  channel: "Channel",
  transpose: "Exchange x and y",
  neighbours: "Neighbours",
  "nominal-area": "Nominal area",
  "material.young": "Young's modulus",
  "material.poisson": "Poisson's ratio",
  "material.hardness": "Hardness",
  "compare.rough": "Rough body",
  "compare.flat": "Flat",
  "compare.law": "Contact law",
  "compare.layer.material": "Layer",
  "compare.layer.on": "on the",
  "compare.layer.thickness": "Thickness",
  "compare.kind-of-load": "Load",
  "compare.force": "Force",
  "compare.nominal-area": "on the area",
  "compare.pressure": "Pressure",
  "compare.separation": "Separation (σ)",
  "compare.accept.area": "Contact area",
  "compare.accept.separation": "Separation (σ)",
  "compare.accept.stiffness": "Stiffness",
  "compare.models": "Boundary elements",
  "compare.robustness": "Other treatments of the map",
  "compare.attribution": "Causes",
  "compare.rank-models": "Other statistical models",
  seed: "Seed",
};
const labelOf = path => LABELS[{ surface: path.slice(3).join("."), material: `material.${path.at(-1)}` }[path[0]] ?? path.join(".")];

// The units of length as options.
export const lengthUnits = vocabulary => vocabulary.lengths.map(unit => [unit, unit === "um" ? "µm" : unit]);

// What every control needs: the spec, what the keys mean, and the error of the last request.
const name = path => path.join(".");

// The key as the list of keys has it: with NAME for what the user names.
const meaningOf = (vocabulary, path) => {
  const generic = path.map((word, place) => (place === 1 && (path[0] === "surface" || path[0] === "material") ? "NAME" : word));
  return vocabulary.keys[name(generic)];
};

// A text with code between backticks.
export const Words = ({ text }) => html`${String(text ?? "").split("`").map((part, k) => (k % 2 ? html`<code>${part}</code>` : part))}`;

export const Explanation = ({ vocabulary, path, id }) => {
  const key = meaningOf(vocabulary, path);
  if (!key) return null;
  const row = (label, text) => text && html`<div><dt>${label}</dt><dd>${text}</dd></div>`;
  return html`<div class="meaning explanation" popover="auto" id=${id}>
    <code>${name(path)}</code>
    <p><${Words} text=${key.meaning} /></p>
    <dl>${row("type", key.kind)}${row("unit", key.unit)}${row("range", key.range)}${row("default", key.default)}${row("example", key.examples[0])}</dl>
    ${key.values.length > 0 && html`<ul>${key.values.map(([value, meaning]) => html`<li><code>${value}</code> <${Words} text=${meaning} /></li>`)}</ul>`}
  </div>`;
};

// A label with a button that explains the key, the control itself, and the error.
const Row = ({ context, path, explained = path, label, children }) => {
  const id = `key-${name(path).replaceAll(/[^\w-]/g, "-")}`;
  const { error, vocabulary } = context;
  const isOwn = error?.key && (error.key === name(path) || error.key.startsWith(`${name(path)}.`));
  return html`<div class=${`row${isOwn ? " wrong" : ""}`}>
    <label for=${id}>${label}</label>
    ${meaningOf(vocabulary, explained) && html`<button type="button" class="help" popovertarget=${`${id}-meaning`} aria-label=${`Explain ${label}`}>?</button>`}
    <div class="control">${children(id, isOwn ? `${id}-error` : undefined)}</div>
    ${isOwn && html`<p class="error" id=${`${id}-error`} role="alert"><${Words} text=${error.message} /></p>`}
    <${Explanation} vocabulary=${vocabulary} path=${explained} id=${`${id}-meaning`} />
  </div>`;
};

// Numbers of a text with at most six digits.
const shortened = value => String(value ?? "").replaceAll(/\d+\.\d{4,}(?!\d*e)/gi, number => String(Number(Number(number).toPrecision(6))));

// A text that is taken when it is left or Enter is pressed; in full while it is edited.
const Text = ({ id, value, set, placeholder, describedBy, list }) => {
  const [draft, setDraft] = useState(null);
  const take = () => {
    if (draft !== null && draft !== String(value ?? "")) set(draft.trim() === "" ? undefined : draft.trim());
    setDraft(null);
  };
  return html`<input id=${id} type="text" value=${draft ?? shortened(value)} placeholder=${placeholder} list=${list} autocomplete="off" spellcheck=${false}
    aria-describedby=${describedBy} aria-invalid=${describedBy ? "true" : undefined}
    onFocus=${() => setDraft(String(value ?? ""))} onInput=${event => setDraft(event.target.value)} onBlur=${take} onKeyDown=${event => event.key === "Enter" && take()} />`;
};

// A bare number in a field is a number of the spec.
const typed = text => (text !== undefined && /^[-+]?[\d.]+(e[-+]?\d+)?$/i.test(text) ? Number(text) : text);

// A quantity: a field with its unit and, where it has a value, a slider between `low` and `high` (SI).
export const Quantity = ({ context, path, label = labelOf(path), dimension, low, high, linear, placeholder, fallback, isList }) => {
  const value = at(context.spec, path);
  const set = next => setValue(path, isList ? listOf(next) : typed(next));
  const shown = parsed(value ?? fallback, dimension);
  const scale = linear ? number => number : Math.log10;
  const back = linear ? number => number : number => 10 ** number;
  const ends = [Math.min(low, shown || low), Math.max(high, shown || high)].map(scale);
  return html`<${Row} context=${context} path=${path} label=${label}>
    ${(id, describedBy) => html`<${Text} id=${id} value=${value} set=${set} placeholder=${placeholder ?? fallback ?? "none"} describedBy=${describedBy} />
      ${shown !== null && shown > (linear ? -Infinity : 0) && html`<input type="range" aria-label=${`${label}, slider`} aria-valuetext=${String(value ?? fallback)}
        min=${ends[0]} max=${ends[1]} step=${(ends[1] - ends[0]) / 400} value=${scale(shown)}
        onInput=${event => setValue(path, written(back(Number(event.target.value)), dimension))} />`}`}
  <//>`;
};

// A choice among some values; the first may be none.
export const Choice = ({ context, path, explained, label = labelOf(path), options, none, set, value }) => {
  const chosen = value ?? at(context.spec, path);
  const taken = set ?? (next => setValue(path, next));
  return html`<${Row} context=${context} path=${path} explained=${explained} label=${label}>
    ${(id, describedBy) => html`<select id=${id} value=${chosen ?? ""} aria-describedby=${describedBy} onChange=${event => taken(event.target.value || undefined)}>
      ${none !== undefined && html`<option value="">${none}</option>`}
      ${chosen && typeof chosen === "string" && !options.some(([one]) => one === chosen) && html`<option value=${chosen}>${chosen}</option>`}
      ${options.map(([one, text]) => html`<option value=${one}>${text}</option>`)}
    </select>`}
  <//>`;
};

// A flag; `value` is written where it is on, nothing where it is off.
export const Flag = ({ context, path, label = labelOf(path), isOn, set }) => html`<${Row} context=${context} path=${path} label=${label}>
  ${(id, describedBy) => html`<input id=${id} type="checkbox" checked=${isOn} aria-describedby=${describedBy} onChange=${event => set(event.target.checked)} />`}
<//>`;

// A text of the spec.
export const Field = ({ context, path, label = labelOf(path), placeholder, set }) => {
  const value = at(context.spec, path);
  const isFlat = Array.isArray(value) && value.every(item => typeof item !== "object");
  const text = value === undefined || typeof value === "string" || typeof value === "number" ? value : isFlat ? value.join(", ") : JSON.stringify(value);
  return html`<${Row} context=${context} path=${path} label=${label}>
    ${(id, describedBy) => html`<${Text} id=${id} value=${text} set=${set ?? (next => setValue(path, typed(next)))} placeholder=${placeholder ?? ""} describedBy=${describedBy} />`}
  <//>`;
};

const LEVELS = ["none", "mean", "plane", "quadratic", "cubic"].map(level => [level, level]);

// A group of controls, folded or not.
const isWide = matchMedia("(min-width: 60rem)").matches;
const Group = ({ title, children, isOpen }) => html`<details class="group" open=${isOpen && isWide}><summary>${title}</summary>${children}</details>`;

// The keys of one surface.
const SurfaceControls = ({ context, surface }) => {
  const { spec, maps, vocabulary } = context;
  const kind = Object.keys(spec.surface[surface])[0];
  const path = (...keys) => ["surface", surface, kind, ...keys];
  const several = Object.keys(spec.surface).length > 1;
  const remove = () => {
    const { [surface]: _, ...surface_ } = spec.surface;
    change({ spec: { ...spec, surface: surface_ } });
  };
  const removal = several && html`<button type="button" onClick=${remove}>Remove ${surface}</button>`;
  if (kind === "file") {
    const map = maps[surface];
    const [nx, ny] = map?.points ?? [1000, 1000];
    const pixel = map?.pixel_m?.[0] ?? 1e-6;
    const side = Math.min(nx, ny) * pixel;
    const unit = at(spec, path("unit")) ?? "m";
    const setUnit = next => setValue(path("unit"), next === "two" ? { xy: unit, z: unit } : next);
    return html`<${Group} title=${`Surface ${surface}`} isOpen=${true}>
      <${Field} context=${context} path=${path("path")} />
      <${Field} context=${context} path=${path("pixel")} placeholder="in the file" set=${text => setValue(path("pixel"), listOf(text))} />
      ${typeof at(spec, path("unit")) === "object"
        ? html`<${Choice} context=${context} path=${path("unit", "xy")} options=${lengthUnits(vocabulary)} /><${Choice} context=${context} path=${path("unit", "z")} options=${lengthUnits(vocabulary)} />`
        : html`<${Choice} context=${context} path=${path("unit")} options=${[...lengthUnits(vocabulary), ["two", "two: of x and y, of the heights"]]} none="that of the file, or m" set=${setUnit} />`}
      <${Field} context=${context} path=${path("crop", "x")} placeholder="from, to: 10 um, 200 um" set=${text => setValue(path("crop", "x"), listOf(text))} />
      <${Field} context=${context} path=${path("crop", "y")} placeholder="from, to" set=${text => setValue(path("crop", "y"), listOf(text))} />
      <${Choice} context=${context} path=${path("level")} options=${LEVELS} none="plane (default)" />
      <${Quantity} context=${context} path=${path("filter", "s")} dimension="length" low=${pixel} high=${side / 8} />
      <${Quantity} context=${context} path=${path("filter", "l")} dimension="length" low=${8 * pixel} high=${side} />
      <${Choice} context=${context} path=${path("outliers")} options=${[["keep", "keep"], ["remove", "remove"]]} none="kept (default)" />
      <${Flag} context=${context} path=${path("fit")} isOn=${at(spec, path("fit")) === "auto"} set=${isOn => setValue(path("fit"), isOn ? "auto" : undefined)} />
      <details><summary>More of the file</summary>
        <${Choice} context=${context} path=${path("align-lines")} options=${[["x", "along x"], ["y", "along y"]]} none="no" />
        <${Quantity} context=${context} path=${path("tip")} dimension="length" low=${1e-9} high=${1e-5} />
        <${Field} context=${context} path=${path("missing")} placeholder="such as -9999, or a word" />
        <${Field} context=${context} path=${path("channel")} placeholder="the heights" />
        <${Flag} context=${context} path=${path("transpose")} isOn=${at(spec, path("transpose")) === true} set=${isOn => setValue(path("transpose"), isOn || undefined)} />
        <${Choice} context=${context} path=${path("neighbours")} options=${[["four", "four"], ["eight", "eight"]]} none="four (default)" />
      </details>
      ${removal}
    <//>`;
  }
  const fields = Object.entries(spec.surface[surface][kind]).filter(([, value]) => typeof value !== "object");
  const quantity = { radius: ["length", 1e-8, 1e-2], sigma: ["length", 1e-10, 1e-4], rms: ["length", 1e-10, 1e-4], count: ["number", 100, 1e6], "nominal-area": ["area", 1e-12, 1e-2] };
  return html`<${Group} title=${`Surface ${surface} (${kind})`} isOpen=${true}>
    ${fields.map(([key]) => {
      const [dimension, low, high] = quantity[key] ?? [];
      return dimension
        ? html`<${Quantity} context=${context} path=${path(key)} label=${key} dimension=${dimension} low=${low} high=${high} />`
        : html`<${Field} context=${context} path=${path(key)} label=${key} />`;
    })}
    ${context.waits.includes("nominal-area") && at(spec, path("nominal-area")) === undefined && html`<${Field} context=${context} path=${path("nominal-area")} placeholder="such as 1 mm^2" />`}
    ${removal}
  <//>`;
};

// A spec without the materials that no body names.
const used = spec => {
  const names = [spec.compare.rough, spec.compare.flat, spec.compare.layer?.material];
  return { ...spec, material: Object.fromEntries(Object.entries(spec.material).filter(([material]) => names.includes(material))) };
};

const OWN = "(own values)";

// A body: a material of the library, or values of its own.
const Body = ({ context, path, label = labelOf(path), ownName, none, extra }) => {
  const { spec, vocabulary } = context;
  const chosen = at(spec, path);
  const own = chosen !== undefined && spec.material?.[chosen]?.young !== undefined;
  const library = spec.material?.[chosen]?.from;
  // Values of a material that both bodies are of stand once.
  const isFirst = name(path) === "compare.rough" || chosen !== spec.compare.rough;
  const choose = next => {
    if (next === undefined) return change({ spec: used(withValue(spec, path.slice(0, 2), undefined)) });
    if (next === OWN) {
      const from = vocabulary.materials.find(material => material.name === library);
      const values = from ? { young: from.young, poisson: from.poisson, ...(from.hardness ? { hardness: from.hardness } : {}) } : { young: "210 GPa", poisson: 0.3 };
      const named = withValue(withValue(spec, ["material", ownName], values), path, ownName);
      return change({ spec: used(named) });
    }
    const named = withValue(withValue(withValue(spec, ["material", next], { from: next }), path, next), ["material", next], spec.material?.[next]?.young === undefined ? { from: next } : spec.material[next]);
    return change({ spec: used(extra ? extra(named) : named) });
  };
  const options = [...vocabulary.materials.map(({ name: one, description }) => [one, `${one}: ${description}`]), [OWN, "own values"]];
  const inSpec = Object.keys(spec.material ?? {}).filter(one => !vocabulary.materials.some(material => material.name === one) && one !== ownName).map(one => [one, one]);
  return html`<${Choice} context=${context} path=${path} label=${label} options=${[...inSpec, ...options]} none=${none} value=${own && chosen === ownName ? OWN : chosen} set=${choose} />
    ${own && isFirst && html`<${Quantity} context=${context} path=${["material", chosen, "young"]} dimension="pressure" low=${1e8} high=${1e12} />
      <${Quantity} context=${context} path=${["material", chosen, "poisson"]} dimension="number" low=${0} high=${0.5} linear=${true} />
      <${Quantity} context=${context} path=${["material", chosen, "hardness"]} dimension="pressure" low=${1e7} high=${1e11} placeholder="never yields" />`}`;
};

// How the load is given.
const Load = ({ context }) => {
  const { compare } = context.spec;
  const one = key => compare[key] !== undefined && typeof compare[key] !== "object";
  const kind = one("force") ? "force" : one("pressure") ? "pressure" : "";
  const choose = next => {
    const { force, pressure, "nominal-area": area, ...rest } = compare;
    const kept = { ...(one("force") ? {} : force !== undefined ? { force } : {}), ...(one("pressure") ? {} : pressure !== undefined ? { pressure } : {}) };
    const given = next === "force" ? { force: "1 N", "nominal-area": "1 mm^2" } : next === "pressure" ? { pressure: "1 MPa" } : {};
    change({ spec: { ...context.spec, compare: { ...rest, ...kept, ...given } } });
  };
  return html`<${Choice} context=${context} path=${["compare", "kind-of-load"]} explained=${["compare", kind || "force"]} value=${kind} options=${[["force", "force on an area"], ["pressure", "nominal pressure"]]} none="no load of your own" set=${choose} />
    ${kind === "force" && html`<${Quantity} context=${context} path=${["compare", "force"]} dimension="force" low=${1e-3} high=${1e3} />
      <${Quantity} context=${context} path=${["compare", "nominal-area"]} dimension="area" low=${1e-10} high=${1e-3} placeholder="that of the map" />`}
    ${kind === "pressure" && html`<${Quantity} context=${context} path=${["compare", "pressure"]} dimension="pressure" low=${1e3} high=${1e9} />`}`;
};

// A sweep from, to and points, where it is one.
const Sweep = ({ context, path, label = labelOf(path), dimension, low, high, linear }) => {
  const sweep = at(context.spec, path);
  if (typeof sweep !== "object" || sweep === null || Array.isArray(sweep) || sweep.values) return null;
  return html`<${Quantity} context=${context} path=${[...path, "from"]} label=${`${label}, from`} dimension=${dimension} low=${low} high=${high} linear=${linear} />
    <${Quantity} context=${context} path=${[...path, "to"]} label="to" dimension=${dimension} low=${low} high=${high} linear=${linear} />
    <${Quantity} context=${context} path=${[...path, "points"]} label="points" dimension="number" low=${5} high=${101} linear=${true} />`;
};

export const WITH_REFERENCE = ["statistical", "deterministic", "reference"];

// All controls of a comparison.
export const Controls = ({ context }) => {
  const { spec, vocabulary } = context;
  const compare = spec.compare;
  const hasReference = Array.isArray(compare.models) && compare.models.includes("reference");
  // A new layer says which body it is on.
  const withThickness = named => (named.compare.layer.thickness === undefined ? withValue(withValue(named, ["compare", "layer", "on"], "flat"), ["compare", "layer", "thickness"], "1 um") : named);
  // What is wrong is shown, also where its group is folded.
  useEffect(() => {
    for (const row of document.querySelectorAll(".row.wrong")) {
      for (let place = row; place; place = place.parentElement) if (place.tagName === "DETAILS") place.open = true;
    }
  }, [context.error]);
  const isOneThickness = compare.layer && (typeof compare.layer.thickness !== "object" || compare.layer.thickness === undefined);
  return html`<form class="controls" aria-label="Controls" onSubmit=${event => event.preventDefault()}>
    ${Object.keys(spec.surface ?? {}).map(surface => html`<${SurfaceControls} key=${surface} context=${context} surface=${surface} />`)}
    <${Group} title="Bodies" isOpen=${true}>
      <${Body} context=${context} path=${["compare", "rough"]} ownName="rough-body" />
      <${Body} context=${context} path=${["compare", "flat"]} ownName="flat-body" />
      <${Choice} context=${context} path=${["compare", "law"]} options=${vocabulary.laws} value=${typeof compare.law === "string" ? compare.law : Array.isArray(compare.law) ? compare.law.join(", ") : Object.keys(compare.law ?? {})[0]} />
    <//>
    <${Group} title="Layer" isOpen=${true}>
      <${Body} context=${context} path=${["compare", "layer", "material"]} ownName="layer" none="none" extra=${withThickness} />
      ${compare.layer && html`<${Choice} context=${context} path=${["compare", "layer", "on"]} options=${[["flat", `flat (${compare.flat})`], ["rough", `rough body (${compare.rough})`]]} />`}
      ${isOneThickness && html`<${Quantity} context=${context} path=${["compare", "layer", "thickness"]} dimension="length" low=${1e-9} high=${1e-4} isList=${true} placeholder="1 um, or 0.1 um, 1 um" />`}
      ${compare.layer && !isOneThickness && html`<${Field} context=${context} path=${["compare", "layer", "thickness"]} set=${text => setValue(["compare", "layer", "thickness"], listOf(text))} />`}
    <//>
    <${Group} title="Load" isOpen=${true}>
      <${Load} context=${context} />
      <details><summary>Range</summary>
        <${Sweep} context=${context} path=${["compare", "separation"]} dimension="number" low=${0} high=${5} linear=${true} />
        <${Sweep} context=${context} path=${["compare", "pressure"]} dimension="pressure" low=${1e3} high=${1e9} />
        <${Sweep} context=${context} path=${["compare", "force"]} dimension="force" low=${1e-3} high=${1e3} />
      </details>
    <//>
    <${Group} title="What you accept" isOpen=${false}>
      <${Quantity} context=${context} path=${["compare", "accept", "area"]} dimension="share" low=${0.01} high=${1} fallback="10 %" />
      <${Quantity} context=${context} path=${["compare", "accept", "separation"]} dimension="number" low=${0.01} high=${1} fallback="0.1" />
      <${Quantity} context=${context} path=${["compare", "accept", "stiffness"]} dimension="share" low=${0.01} high=${1} fallback="20 %" />
    <//>
    <${Group} title="What is computed" isOpen=${false}>
      <${Flag} context=${context} path=${["compare", "models"]} isOn=${hasReference} set=${isOn => setValue(["compare", "models"], isOn ? WITH_REFERENCE : undefined)} />
      <${Flag} context=${context} path=${["compare", "robustness"]} isOn=${compare.robustness !== false} set=${isOn => setValue(["compare", "robustness"], isOn ? undefined : false)} />
      <${Flag} context=${context} path=${["compare", "attribution"]} isOn=${compare.attribution !== false} set=${isOn => setValue(["compare", "attribution"], isOn ? undefined : false)} />
      <${Flag} context=${context} path=${["compare", "rank-models"]} isOn=${compare["rank-models"] !== false} set=${isOn => setValue(["compare", "rank-models"], isOn ? undefined : false)} />
      <${Field} context=${context} path=${["seed"]} placeholder="0" />
    <//>
  </form>`;
};

// A list of quantities as a user writes it: with commas, brackets and quotes or without.
const listOf = text => {
  if (text === undefined) return undefined;
  const items = text.replaceAll(/[[\]"']/g, "").split(",").map(item => item.trim()).filter(item => item);
  return items.length === 1 ? typed(items[0]) : items.map(typed);
};

// Keeps the focus in a dialog and opens it where it is shown.
export const Dialog = ({ title, children, close }) => {
  const dialog = useRef(null);
  useEffect(() => dialog.current.showModal(), []);
  return html`<dialog ref=${dialog} aria-label=${title} onClose=${close}>
    <form method="dialog" class="dialog-head"><h2>${title}</h2><button aria-label="Close">×</button></form>
    ${children}
  </dialog>`;
};
